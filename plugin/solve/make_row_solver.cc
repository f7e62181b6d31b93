// SPDX-License-Identifier: LGPL-2.1-or-later
#include "make_row_solver.h"

#include "condensation.h"
#include "free_motion_solver.h"
#include "nodal_condensation.h"
#include "saddle_point.h"

namespace abut::solve
{
  bool are_nodal(const PointOperator &rows)
  {
    bool others = false;
    for (int i = 0; i < rows.n_rows() && !others; ++i)
      others = rows.end(i) - rows.begin(i) != 1
               || rows.column(rows.begin(i)) >= rows.n_owned();
    return !dealii::Utilities::MPI::logical_or(others, rows.communicator());
  }

  namespace
  {
    std::unique_ptr<RowSolver> make_inner(const System system,
                                          const SolverParameters &parameters,
                                          const PointOperator &rows,
                                          const bool has_matrix)
    {
      if (system == System::saddle_point)
        return std::make_unique<SaddlePoint>(parameters);
      const bool has_friction = dealii::Utilities::MPI::logical_or(
          rows.has_tangents(), rows.communicator());
      if (has_matrix && are_nodal(rows) && !has_friction)
        return std::make_unique<NodalCondensation>(parameters);
      return std::make_unique<Condensation>(parameters, has_matrix);
    }
  } // namespace

  std::unique_ptr<RowSolver> make_row_solver(const System system,
                                             const SolverParameters &parameters,
                                             const PointOperator &rows,
                                             const bool has_matrix)
  {
    return std::make_unique<FreeMotionSolver>(
        make_inner(system, parameters, rows, has_matrix));
  }
} // namespace abut::solve
