// SPDX-License-Identifier: LGPL-2.1-or-later
#include "row_stiffness.h"

#include <algorithm>

namespace abut::solve
{
  la::Vector compliance(const Stiffness &stiffness)
  {
    const std::vector<double> &diagonal = stiffness.diagonal();
    la::Vector result = stiffness.make_vector();
    std::transform(diagonal.begin(), diagonal.end(), la::data(result),
                   [](const double k) { return 1. / k; });
    return result;
  }

  std::vector<double> row_stiffness(const la::Vector &compliance,
                                    const PointOperator &rows)
  {
    std::vector<double> result = rows.squares(compliance);
    for (int i = 0; i < rows.n_rows(); ++i)
      // A point that supports hold along a tangent has the stiffness of its
      // normal there.
      result[i] = result[i] > 0. || !rows.is_tangent(i) || i == 0
                      ? 1. / (rows.weight(i) * result[i])
                      : result[i - 1];
    return result;
  }

  std::vector<double> row_stiffness(const Stiffness &stiffness,
                                    const PointOperator &rows)
  {
    return row_stiffness(compliance(stiffness), rows);
  }
} // namespace abut::solve
