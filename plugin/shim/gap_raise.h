// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_GAP_RAISE_H
#define ABUT_SHIM_GAP_RAISE_H

#include "start_values.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace abut::shim
{
  /** Amount that the gap of a row with pressure is raised by where surfaces are
   * apart, and the result of the value before. */
  struct GapRaise
  {
    double value = 0.; ///< length >= 0
    double before = 0.;
    double clearance = 0., pressure = 0.; ///< with the value before

    /** The value for a row that still has a @p pressure at a @p clearance > 0:
     * as much more as the row is apart by, or where, by the last two values,
     * its pressure or the clearance comes to 0, whichever is nearer. */
    double more(const double present_clearance,
                const double present_pressure) const
    {
      constexpr double a_little = 1.05, most = 30.;
      const double last = value - before;
      const double slope = clearance - present_clearance,
                   fall = pressure - present_pressure;
      double step = present_clearance;
      if (last > 0. && slope > 0. && fall > 0.)
        step =
            std::max(step, std::min({a_little * present_pressure / fall * last,
                                     present_clearance / slope * last,
                                     most * present_clearance}));
      return value + step;
    }

    /** The value where surfaces are inside of each other by minus the @p
     * present_clearance < 0: that at which the clearance comes to 0, by the
     * last two values if it was open before, or, by that of the weighted gap,
     * @p gap without this value. */
    double less(const double present_clearance, const double gap,
                const bool presses) const
    {
      const double last = value - before;
      return presses && last > 0. && clearance > 0.
                 ? value
                       + present_clearance / (clearance - present_clearance)
                             * last
                 : std::max(0., present_clearance - (gap - value));
    }
  };

  /** Amounts that gaps of rows are raised by, since detect(). */
  struct GapRaises
  {
    std::map<std::int64_t, GapRaise> of; ///< length > 0, by number of the row
    unsigned int n = 0;                  ///< how often they have been changed
    /** The first of them if no row is opened altogether, values of rows before
     * that, and whether any row was opened. */
    std::map<std::int64_t, GapRaise> unopened;
    RowValues before;
    bool may_limit = false;
  };
} // namespace abut::shim

#endif
