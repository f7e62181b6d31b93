// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_ELIMINATION_H
#define ABUT_SOLVE_ELIMINATION_H

#include "pivots.h"

namespace abut::solve
{
  /** T Z + Z^T (T + T Z): what P^T T P has beyond T for P = I + Z. Z has lines
   * for pivots alone,
   *     Z_qq = -1,  Z_qj = -B_ij / B_iq,    q the pivot of row i,
   * so that the result is empty but for the neighbours of pivots and the
   * unknowns that rows tie them to. @p matrix needs an entry (i, j) wherever it
   * has an entry (j, i). Collective. */
  la::Matrix elimination_terms(const la::Matrix &matrix,
                               const PointOperator &rows,
                               const std::vector<std::int64_t> &pivot);
} // namespace abut::solve

#endif
