// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHART_CHART_ROWS_H
#define ABUT_APP_CHART_CHART_ROWS_H

/** @file
 * What came out of the runs of a chart.
 */

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** One setting of the scene: a point of a curve. Numbers that are not known
   * are NaN. */
  struct ChartRow
  {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    std::size_t curve = 0;
    std::string value;  /**< along the axis */
    double x = unknown; /**< as a number, or the axis quantity */
    std::string ended, reason;
    int code = 0;
    double quantity = unknown;
    double error = unknown;
    double time = unknown; /**< median of the repeats, as are the next two */
    double processor_seconds = unknown;
    double wall_seconds = unknown;
    double fastest = unknown, slowest = unknown; /**< of time */
    unsigned int repeats = 0;
    double matvecs = unknown;
    double linear_iterations = unknown;
    double nonlinear_iterations = unknown;
    double dofs = unknown;
    double constraints = unknown;
    double active = unknown;
    double peak_memory_mb = unknown;
    bool time_front = false; /**< no other run has less error in less time */
    bool work_front = false; /**< likewise with matrix-vector products */
    std::string key;         /**< of its folder in `runs` */

    bool ok() const
    {
      return ended == "ok";
    }
  };

  /** Middle value, or the mean of the two in the middle; NaN of none. */
  double median(std::vector<double> values);

  /** Which of the points (cost, error) no other one beats: none has both at
   * most as large and one of them smaller. Points with NaN are beaten.
   * O(n log n). */
  std::vector<bool>
  pareto_front(const std::vector<std::pair<double, double>> &points);

  /** Set time_front and work_front, among the rows that are ok. Errors are
   * compared in two digits: less does not tell methods from each other. */
  void mark_fronts(std::vector<ChartRow> &rows);

  /** Whether @p row was, in its fastest repeat, not slower than @p best was in
   * its slowest: the two are not told apart. */
  bool is_as_fast(const ChartRow &row, const ChartRow &best);

  /** The row of least time whose error is at most @p target, among those of
   * curve @p curve or (if that is not a curve) all; null if there is none. */
  const ChartRow *cheapest(const std::vector<ChartRow> &rows, double target,
                           std::size_t curve = std::size_t(-1));
} // namespace abut::app

#endif
