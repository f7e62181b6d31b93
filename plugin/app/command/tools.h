// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_TOOLS_H
#define ABUT_APP_TOOLS_H

/** @file
 * The tools in Python: pictures and reports.
 */

#include "app/input/input_error.h"
#include "app/report/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** `abut draw ...`: start the tool with these words, its name first, and wait
   * for its end. Throws InputError where no Python has the packages. Not
   * collective. */
  ExitCode run_tool(const std::vector<std::string> &words);

  /** Draw the pictures of a finished run. A failure is a warning of the report.
   * Not collective, for rank 0; returns whether there is no warning. */
  bool draw_run(Report &report, const std::filesystem::path &folder);

  /** Write the page about the run in @p folder; a failure is a warning. Not
   * collective, for rank 0. */
  void write_page(const std::filesystem::path &folder);
} // namespace abut::app

#endif
