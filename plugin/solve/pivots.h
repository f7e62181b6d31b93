// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_PIVOTS_H
#define ABUT_SOLVE_PIVOTS_H

#include "local_elimination.h"
#include "point_operator.h"

#include <cstdint>

namespace abut::solve
{
  /** Rows condensed into a matrix: springs, and rows that determine one of
   * their unknowns. */
  struct Condensate
  {
    /** pivot[] of rows that determine nothing. */
    static constexpr std::int64_t none = -1;

    Condensate() = default;

    /** Without friction. */
    Condensate(std::vector<double> springs, std::vector<std::int64_t> pivots)
        : stiffness(std::move(springs)), pivot(std::move(pivots))
    {
    }

    /** [rows] e >= 0 in K + B^T diag(e) B, force per length. */
    std::vector<double> stiffness;
    /** [rows] entry whose unknown the row determines, or none. */
    std::vector<std::int64_t> pivot;

    /** With friction, rows of a point go together: empty without. The unknowns
     * at the pivots q of a point with rows B are u_q = - trial B u, the other
     * ones zero there, and forces on them are handed on by - B^T test^T f_q;
     * springs are B^T spring B, and stiffness is their diagonal. Rows of the
     * maps without a pivot are 0. */
    RowBlocks blocks;
    std::vector<double> spring, trial, test; ///< [numbers]
  };

  /** Choose for each row with @p wanted nonzero the largest entry whose
   * unknown is owned and occurs in no other wanted row of any rank. Returns
   * on all ranks whether every wanted row has one; dual mortar rows, rows of
   * single nodes and ties component by component do. O(entries).
   * Collective. */
  bool choose_pivots(const PointOperator &rows,
                     const std::vector<std::uint8_t> &wanted,
                     std::vector<std::int64_t> &pivot);

  /** The same for points with friction: all that is to be known of what was
   * eliminated locally. A point with several constraints has as many pivots
   * among the unknowns that no other point with constraints has, of which no
   * combination is small. Returns on all ranks whether all points have theirs.
   * Collective. */
  bool choose_pivots(const PointOperator &rows, const LocalElimination &local,
                     Condensate &condensate);
} // namespace abut::solve

#endif
