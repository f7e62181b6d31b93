// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SAMPLING_H
#define ABUT_SHIM_SAMPLING_H

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace abut::shim
{
  /** Points in each direction to look at between nodes of @p n_cells cells or
   * facets of dimension @p dim: many where there are few cells, as narrow
   * things are missed on coarse meshes, and at least the middle. */
  inline unsigned int samples_per_direction(const double n_cells, const int dim,
                                            const double least = 1.,
                                            const double most = 400.)
  {
    constexpr double most_in_all = 2e5;
    const double n = std::pow(most_in_all / std::max(1., n_cells), 1. / dim);
    return static_cast<unsigned int>(std::clamp(n, least, most));
  }

  /** A regular grid of points with equal weights in the unit cube or simplex,
   * @p n in each direction or along each edge: the middle for one. */
  template <int dim>
  dealii::Quadrature<dim> regular_points(const unsigned int n,
                                         const bool of_simplex)
  {
    std::vector<dealii::Point<dim>> points;
    unsigned int n_in_cube = 1;
    double size = 1.;
    for (unsigned int d = 0; d < dim; ++d)
    {
      n_in_cube *= n;
      size /= of_simplex ? d + 1 : 1;
    }
    const double first = of_simplex ? 1. / (dim + 1) : 0.5;
    for (unsigned int i = 0; i < n_in_cube; ++i)
    {
      dealii::Point<dim> point;
      double sum = 0.;
      for (unsigned int d = 0, k = i; d < dim; ++d, k /= n)
        sum += point[d] = (k % n + first) / n;
      if (!of_simplex || sum < 1.)
        points.push_back(point);
    }
    const std::vector<double> weights(points.size(), size / points.size());
    return {points, weights};
  }
} // namespace abut::shim

#endif
