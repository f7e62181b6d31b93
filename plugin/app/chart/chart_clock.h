// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHART_CHART_CLOCK_H
#define ABUT_APP_CHART_CHART_CLOCK_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace abut::app
{
  /** How long the rest of a chart will take, from what its finished points
   * took. A point that is still to be made is taken to cost as much more than
   * the one before it on its curve as this step has cost on other curves. */
  class ChartClock
  {
  public:
    /** @param n_points of each curve */
    explicit ChartClock(const std::vector<std::size_t> &n_points);

    /** A point is done; @p seconds that its runs took, now or earlier. */
    void set(std::size_t curve, std::size_t point, double seconds);

    /** Seconds left. */
    double left() const;

    /** "about 3 min left", or "" at the end. */
    std::string text() const;

  private:
    double growth(std::size_t point) const;
    double mean(std::size_t point) const;
    double expected(std::size_t curve, std::size_t point) const;

    std::vector<std::vector<std::optional<double>>> seconds;
  };
} // namespace abut::app

#endif
