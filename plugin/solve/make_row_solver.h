// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_MAKE_ROW_SOLVER_H
#define ABUT_SOLVE_MAKE_ROW_SOLVER_H

#include "row_solver.h"

#include <abut/dealii/method_parameters.h>

#include <memory>

namespace abut::solve
{
  /** Whether each row is one owned unknown alone, on all ranks. Collective. */
  bool are_nodal(const PointOperator &rows);

  /** The solver for a set of rows: by elimination unless the user's word @p
   * system is the saddle point, which needs a matrix, as elimination does not.
   * Collective. */
  std::unique_ptr<RowSolver> make_row_solver(System system,
                                             const SolverParameters &parameters,
                                             const PointOperator &rows,
                                             bool has_matrix = true);
} // namespace abut::solve

#endif
