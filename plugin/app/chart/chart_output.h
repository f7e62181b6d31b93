// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHART_CHART_OUTPUT_H
#define ABUT_APP_CHART_CHART_OUTPUT_H

/** @file
 * Tables and pictures of a chart.
 */

#include "chart_file.h"
#include "chart_rows.h"

#include "app/report/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** The names of a curve's axis, "Method/Penalty factor". */
  std::string axis_name(const ChartCurve &curve);

  /** `runs.csv`: a row for each point, failed ones included. */
  std::string runs_csv(const ChartFile &chart,
                       const std::vector<ChartRow> &rows);

  /** `cheapest.md`: the least time in which each curve comes to each target,
   * with the value along its axis; the best, and what cannot be told from
   * it, in bold. */
  std::string cheapest_table(const ChartFile &chart,
                             const std::vector<ChartRow> &rows);

  /** The pictures that the chart asks for. */
  void draw_chart(Report &report, const std::filesystem::path &folder,
                  const ChartFile &chart, const std::vector<ChartRow> &rows);
} // namespace abut::app

#endif
