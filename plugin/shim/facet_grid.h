// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_FACET_GRID_H
#define ABUT_SHIM_FACET_GRID_H

#include "sampling.h"

#include <abut/facet.h>

namespace abut::shim
{
  /** A regular grid of points in facets. */
  template <int dim> class FacetGrid
  {
  public:
    FacetGrid(const abut_facet_kind kind, const unsigned int n)
        : n_nodes_(static_cast<unsigned int>(abut_facet_n_nodes(kind)))
    {
      const auto coordinate = [&](const unsigned int k)
      { return (2. * k + 1.) / n - 1.; };
      const auto add = [&](const double xi, const double eta)
      {
        const double local[2] = {xi, eta};
        shape_.emplace_back(n_nodes_);
        abut_facet_shape(kind, local, shape_.back().data(), nullptr, nullptr);
      };
      if (kind == ABUT_FACET_TRI3 || kind == ABUT_FACET_TRI6)
        for (const dealii::Point<2> &point : simplex_points<2>(n))
          add(point[0], point[1]);
      else
        for (unsigned int j = 0; j < (dim == 2 ? 1 : n); ++j)
          for (unsigned int i = 0; i < n; ++i)
            add(coordinate(i), coordinate(j));
    }

    /** The points of a facet whose node a is at place_of(a). */
    template <typename PlaceOf>
    std::vector<dealii::Point<dim>> points(const PlaceOf &place_of) const
    {
      std::vector<dealii::Point<dim>> result(shape_.size());
      for (std::size_t q = 0; q < shape_.size(); ++q)
        for (unsigned int a = 0; a < n_nodes_; ++a)
          result[q] += shape_[q][a] * dealii::Tensor<1, dim>(place_of(a));
      return result;
    }

  private:
    unsigned int n_nodes_;
    std::vector<std::vector<double>> shape_; ///< [points][nodes]
  };
} // namespace abut::shim

#endif
