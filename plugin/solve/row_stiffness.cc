// SPDX-License-Identifier: LGPL-2.1-or-later
#include "row_stiffness.h"

#include <algorithm>

namespace abut::solve
{
  std::vector<double> row_stiffness(const la::Matrix &stiffness,
                                    const PointOperator &rows)
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
} // namespace abut::solve
