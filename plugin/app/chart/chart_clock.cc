// SPDX-License-Identifier: LGPL-2.1-or-later
#include "chart_clock.h"

#include "app/input/short_number.h"
#include "app/report/report.h"

#include <cmath>

namespace abut::app
{
  ChartClock::ChartClock(const std::vector<std::size_t> &n_points)
  {
    for (const std::size_t n : n_points)
      seconds.emplace_back(n);
  }

  void ChartClock::set(const std::size_t curve, const std::size_t point,
                       const double value)
  {
    seconds[curve][point] = value;
  }

  /** Cost of point @p point beside the one before, over the curves that have
   * both; else that of the step before; else 1. */
  double ChartClock::growth(const std::size_t point) const
  {
    for (std::size_t k = point; k > 0; --k)
    {
      double now = 0, before = 0;
      for (const auto &curve : seconds)
        if (k < curve.size() && curve[k] && curve[k - 1])
        {
          now += *curve[k];
          before += *curve[k - 1];
        }
      if (before > 0)
        return now / before;
    }
    return 1;
  }

  double ChartClock::mean(const std::size_t point) const
  {
    double sum = 0;
    unsigned int n = 0;
    for (const auto &curve : seconds)
      if (point < curve.size() && curve[point])
      {
        sum += *curve[point];
        ++n;
      }
    return n > 0 ? sum / n : 0;
  }

  double ChartClock::expected(const std::size_t curve,
                              const std::size_t point) const
  {
    if (seconds[curve][point])
      return *seconds[curve][point];
    if (point > 0)
      return expected(curve, point - 1) * growth(point);
    return mean(0);
  }

  double ChartClock::left() const
  {
    double sum = 0;
    for (std::size_t c = 0; c < seconds.size(); ++c)
      for (std::size_t p = 0; p < seconds[c].size(); ++p)
        if (!seconds[c][p])
          sum += expected(c, p);
    return sum;
  }

  std::string ChartClock::text() const
  {
    const double s = left();
    if (s <= 0)
      return "";
    return "about "
           + (s < 100 ? short_number(std::ceil(s), 3) + " s"
                      : short_number(std::ceil(s / 60), 6) + " min")
           + " left";
  }
} // namespace abut::app
