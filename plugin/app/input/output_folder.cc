// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_folder.h"

#include "input_error.h"

#include <fstream>

namespace abut::app
{
  void make_output_folder(const std::filesystem::path &folder)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
      throw InputError("", "cannot make the output folder '" + folder.string()
                               + "'" + (error ? ": " + error.message() : "")
                               + ". Choose another one with --output DIR.");
    const fs::path probe = folder / ".abut-can-write";
    const bool writable =
        static_cast<bool>(std::ofstream(probe) << "x" << std::flush);
    fs::remove(probe, error);
    if (!writable)
      throw InputError("", "cannot write into the output folder '"
                               + folder.string()
                               + "'. Choose another one with --output DIR.");
  }
} // namespace abut::app
