// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_TOOLS_H
#define ABUT_APP_TOOLS_H

/** @file
 * The tools in Python: pictures and reports.
 */

#include "app/input/input_error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** `abut draw ...`: start the tool with these words, its name first, and wait
   * for its end. Throws InputError where no Python has the packages. Not
   * collective. */
  ExitCode run_tool(const std::vector<std::string> &words);

  /** Let a tool, `draw` or `report`, read the folder of a run that has ended.
   * Returns warnings, also of a tool that failed. Not collective, for rank 0.
   */
  std::vector<std::string> read_run(const std::string &tool,
                                    const std::filesystem::path &folder);
} // namespace abut::app

#endif
