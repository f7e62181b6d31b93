// SPDX-License-Identifier: LGPL-2.1-or-later
#include "row_stiffness.h"

#include <algorithm>

namespace abut::solve
{
  la::Vector compliance(const la::Matrix &stiffness)
  {
    const std::vector<double> diagonal =
        la::diagonal(la::local_rows(stiffness));
    la::Vector result(stiffness.locally_owned_range_indices(),
                      stiffness.get_mpi_communicator());
    std::transform(diagonal.begin(), diagonal.end(), la::data(result),
                   [](const double k) { return 1. / k; });
    return result;
  }

  std::vector<double> row_stiffness(const la::Vector &compliance,
                                    const PointOperator &rows)
  {
    std::vector<double> result = rows.squares(compliance);
    for (int i = 0; i < rows.n_rows(); ++i)
      result[i] = 1. / (rows.weight(i) * result[i]);
    return result;
  }

  std::vector<double> row_stiffness(const la::Matrix &stiffness,
                                    const PointOperator &rows)
  {
    return row_stiffness(compliance(stiffness), rows);
  }
} // namespace abut::solve
