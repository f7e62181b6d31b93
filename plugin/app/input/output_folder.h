// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_OUTPUT_FOLDER_H
#define ABUT_APP_OUTPUT_FOLDER_H

#include <filesystem>

namespace abut::app
{
  /** Make @p folder with its parents and make sure that files can be written
   * there; throws InputError. To be called on one rank. */
  void make_output_folder(const std::filesystem::path &folder);

  /** Throw InputError if make_output_folder() would, as far as can be told
   * without making anything. */
  void check_output_folder(const std::filesystem::path &folder);
} // namespace abut::app

#endif
