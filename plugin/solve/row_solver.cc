/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "row_solver.h"

#include "condensation.h"
#include "nodal_condensation.h"
#include "row_operator.h"
#include "saddle_point.h"

#include <algorithm>

namespace abut::solve
{
  bool are_nodal(const la::Matrix &stiffness, const abut_rows_view &rows)
  {
    const dealii::IndexSet owned = stiffness.locally_owned_range_indices();
    bool others = false;
    for (int i = 0; i < rows.n_rows && !others; ++i)
      others = rows.row_start[i + 1] - rows.row_start[i] != 1
               || !owned.is_element(rows.column[rows.row_start[i]]);
    return !dealii::Utilities::MPI::logical_or(
        others, stiffness.get_mpi_communicator());
  }
  std::vector<double> row_stiffness(const la::Matrix &stiffness,
                                    const RowOperator &rows)
  {
    const std::vector<double> diagonal =
        la::diagonal(la::local_rows(stiffness));
    la::Vector compliance(stiffness.locally_owned_range_indices(),
                          stiffness.get_mpi_communicator());
    std::transform(diagonal.begin(), diagonal.end(), la::data(compliance),
                   [](const double k) { return 1. / k; });
    std::vector<double> result = rows.squares(compliance);
    for (int i = 0; i < rows.n_rows(); ++i)
      result[i] = 1. / (rows.weight(i) * result[i]);
    return result;
  }

  std::vector<double> row_stiffness(const la::Matrix &stiffness,
                                    const abut_rows_view &rows)
  {
    return row_stiffness(stiffness,
                         RowOperator(stiffness.locally_owned_range_indices(),
                                     rows, stiffness.get_mpi_communicator()));
  }

  std::unique_ptr<RowSolver> make_row_solver(const System system,
                                             const SolverParameters &parameters,
                                             const la::Matrix &stiffness,
                                             const abut_rows_view &rows)
  {
    if (system == System::saddle_point)
      return std::make_unique<SaddlePoint>(parameters);
    if (are_nodal(stiffness, rows))
      return std::make_unique<NodalCondensation>(parameters);
    return std::make_unique<Condensation>(parameters);
  }
} // namespace abut::solve
