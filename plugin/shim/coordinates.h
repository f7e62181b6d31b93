// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_COORDINATES_H
#define ABUT_SHIM_COORDINATES_H

#include <deal.II/base/point.h>

#include <vector>

namespace abut::shim
{
  /** Points or vectors as the C core has them, [n * dim]. */
  template <typename Vector>
  std::vector<double> coordinates(const std::vector<Vector> &vectors)
  {
    std::vector<double> result;
    result.reserve(vectors.size() * Vector::dimension);
    for (const Vector &vector : vectors)
      for (unsigned int d = 0; d < Vector::dimension; ++d)
        result.push_back(vector[d]);
    return result;
  }

  /** Room for the core to put vectors in, [n * dim]; null: none. */
  template <int dim>
  double *data_of(std::vector<dealii::Tensor<1, dim>> &vectors)
  {
    static_assert(sizeof(vectors[0]) == dim * sizeof(double), "no padding");
    return vectors.empty() ? nullptr : &vectors[0][0];
  }
} // namespace abut::shim

#endif
