// SPDX-License-Identifier: LGPL-2.1-or-later
#include "chart_rows.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace abut::app
{
  double median(std::vector<double> values)
  {
    if (values.empty())
      return ChartRow::unknown;
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[n / 2] + values[(n - 1) / 2]);
  }

  std::vector<bool>
  pareto_front(const std::vector<std::pair<double, double>> &points)
  {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!std::isnan(points[i].first) && !std::isnan(points[i].second))
        order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j)
              { return points[i] < points[j]; });
    std::vector<bool> front(points.size(), false);
    const std::pair<double, double> *last = nullptr;
    for (const std::size_t i : order)
      if (last == nullptr || points[i].second < last->second
          || points[i] == *last)
      {
        front[i] = true;
        last = &points[i];
      }
    return front;
  }

  namespace
  {
    double two_digits(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.1e", value);
      return std::strtod(text, nullptr);
    }
  } // namespace

  void mark_fronts(std::vector<ChartRow> &rows)
  {
    std::vector<std::pair<double, double>> time, work;
    for (const ChartRow &row : rows)
    {
      const double error = row.ok() ? two_digits(row.error) : ChartRow::unknown;
      time.emplace_back(row.time, error);
      work.emplace_back(row.matvecs, error);
    }
    const std::vector<bool> in_time = pareto_front(time),
                            in_work = pareto_front(work);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      rows[i].time_front = in_time[i];
      rows[i].work_front = in_work[i];
    }
  }

  bool is_as_fast(const ChartRow &row, const ChartRow &best)
  {
    return row.fastest <= best.slowest;
  }

  const ChartRow *cheapest(const std::vector<ChartRow> &rows,
                           const double target, const std::size_t curve)
  {
    const ChartRow *best = nullptr;
    for (const ChartRow &row : rows)
      if (row.ok() && row.error <= target && !std::isnan(row.time)
          && (curve == std::size_t(-1) || row.curve == curve)
          && (best == nullptr || row.time < best->time))
        best = &row;
    return best;
  }
} // namespace abut::app
