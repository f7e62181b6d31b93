/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "row_solver.h"

namespace abut::solve
{
  std::vector<double> row_stiffness(const la::Matrix &stiffness,
                                    const abut_rows_view &rows)
  {
    const std::vector<double> diagonal =
        la::diagonal(la::local_rows(stiffness));
    const dealii::IndexSet owned = stiffness.locally_owned_range_indices();
    std::vector<double> result(rows.n_rows, 0.);
    for (int i = 0; i < rows.n_rows; ++i)
    {
      for (std::int64_t k = rows.row_start[i]; k < rows.row_start[i + 1]; ++k)
        result[i] += rows.coefficient[k] * rows.coefficient[k]
                     * diagonal[owned.index_within_set(rows.column[k])];
      result[i] /= rows.weight[i];
    }
    return result;
  }
} // namespace abut::solve
