// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_ELIMINATION_H
#define ABUT_SOLVE_ELIMINATION_H

#include "pivots.h"

#include <functional>

namespace abut::solve
{
  /** Takes a part of a row of a matrix: its number, columns and values. */
  using VisitLine =
      std::function<void(dealii::types::global_dof_index,
                         const std::vector<dealii::types::global_dof_index> &,
                         const std::vector<double> &)>;

  /** T Z + Y^T (T + T Z): what (I + Y)^T T (I + Z) has beyond T. Z has lines
   * for pivots alone,
   *     Z_qq = -1,  Z_qj = -B_ij / B_iq,    q the pivot of row i,
   * or with friction the maps of the condensate, and Y is Z but for friction;
   * so that the result is empty but for the neighbours of pivots and the
   * unknowns that rows tie them to; line by line, of which some may be parts of
   * one row, or of rows of other ranks. On several ranks @p matrix needs an
   * entry (i, j) wherever it has an entry (j, i). Entries of 0 have no part.
   * Collective. */
  void for_each_elimination_term(const la::Matrix &matrix,
                                 const PointOperator &rows,
                                 const Condensate &condensate,
                                 const VisitLine &visit);
} // namespace abut::solve

#endif
