// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_options.h"

namespace abut::app
{
  std::filesystem::path RunOptions::input_file(const std::string &name) const
  {
    const std::filesystem::path beside = scene_file.parent_path() / name;
    return std::filesystem::exists(beside) ? beside
                                           : std::filesystem::path(name);
  }
} // namespace abut::app
