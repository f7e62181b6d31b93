// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHART_CHART_H
#define ABUT_APP_CHART_CHART_H

/** @file
 * `abut chart`: one scene run in many ways, errors against time and work.
 *
 * chart_file reads what is asked for, run_store keeps finished runs,
 * run_maker makes one, chart_rows what came out, chart_tables and
 * chart_pictures show it.
 */

#include "app/input/input_error.h"
#include "app/report/report.h"

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace abut::app
{
  /** Make the chart that @p file asks for in @p folder, reusing the finished
   * runs that are there.
   * @param plan_only print the points and stop before the first run. Throws
   * InputError before the first run for all mistakes that can be found without
   * a run. On one rank. */
  ExitCode make_chart(const std::string &file,
                      const std::vector<std::string> &overrides,
                      const std::filesystem::path &folder, bool plan_only,
                      Report &report);

  /** The parameters of a chart file as Markdown. */
  void write_chart_reference(std::ostream &out);
} // namespace abut::app

#endif
