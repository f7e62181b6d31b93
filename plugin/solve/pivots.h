// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_PIVOTS_H
#define ABUT_SOLVE_PIVOTS_H

#include "point_operator.h"

#include <cstdint>

namespace abut::solve
{
  /** What is condensed into a matrix: rows that are springs, and rows that
   * determine one of their unknowns. */
  struct Condensate
  {
    /** pivot[] of rows that determine nothing. */
    static constexpr std::int64_t none = -1;

    /** [rows] e >= 0 in K + B^T diag(e) B, force per length. */
    std::vector<double> stiffness;
    /** [rows] entry whose unknown the row determines, or none. */
    std::vector<std::int64_t> pivot;
  };

  /** Choose for each row with @p wanted nonzero the largest entry whose
   * unknown is owned and occurs in no other wanted row of any rank. Returns
   * on all ranks whether every wanted row has one; dual mortar rows, rows of
   * single nodes and ties component by component do. O(entries).
   * Collective. */
  bool choose_pivots(const PointOperator &rows,
                     const std::vector<std::uint8_t> &wanted,
                     std::vector<std::int64_t> &pivot);
} // namespace abut::solve

#endif
