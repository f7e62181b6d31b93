// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_ELIMINATION_H
#define ABUT_SOLVE_ELIMINATION_H

#include "pivots.h"

namespace abut::solve
{
  /** T Z + Y^T (T + T Z): what (I + Y)^T T (I + Z) has beyond T. Z has lines
   * for pivots alone,
   *     Z_qq = -1,  Z_qj = -B_ij / B_iq,    q the pivot of row i,
   * or with friction what the maps of the condensate say, and Y is Z but for
   * friction; so that the result is empty but for the neighbours of pivots and
   * the unknowns that rows tie them to. @p matrix needs an entry (i, j)
   * wherever it has an entry (j, i). Collective. */
  la::Matrix elimination_terms(const la::Matrix &matrix,
                               const PointOperator &rows,
                               const Condensate &condensate);
} // namespace abut::solve

#endif
