// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_GAP_LINE_H
#define ABUT_SOLVE_GAP_LINE_H

#include <deal.II/base/types.h>

#include <vector>

namespace abut::solve
{
  /** Change of the gap of a row in addition to its coefficients, by unknowns.
   */
  struct GapLine
  {
    int row = 0;
    std::vector<dealii::types::global_dof_index> column;
    std::vector<double> value; ///< equal places add up
    /** Unknowns of the node that the row belongs to. */
    std::vector<dealii::types::global_dof_index> own;
  };
} // namespace abut::solve

#endif
