// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_ROW_LAWS_H
#define ABUT_TESTS_ROW_LAWS_H

/** @file
 * Laws of rows as the core's strategies hand them to solvers.
 */

#include <abut/strategy.h>

#include <cstdint>
#include <vector>

namespace abut::tests
{
  /** Linearised laws a dp + b dg = -c of a rank's rows, with the answers of a
   * solver. */
  struct RowLaws
  {
    std::vector<double> a, b, c, pressure, dp, dg; ///< [rows]
    std::vector<std::uint8_t> state;               ///< [rows]

    void resize_laws(const std::size_t n)
    {
      for (auto *values : {&a, &b, &c, &pressure, &dp, &dg})
        values->assign(n, 0.);
      state.assign(n, ABUT_STATE_OPEN);
    }

    /** A request of the core with these laws. */
    abut_request request(const double tolerance)
    {
      abut_request result = {};
      result.action = ABUT_ACTION_SOLVE;
      result.linear_tolerance = tolerance;
      result.matrix_changed = 1;
      result.pressure = pressure.data();
      result.state = state.data();
      result.residual = c.data();
      result.d_pressure = a.data();
      result.d_gap = b.data();
      result.pressure_change = dp.data();
      result.gap_change = dg.data();
      return result;
    }
  };
} // namespace abut::tests

#endif
