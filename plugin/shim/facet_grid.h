// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_FACET_GRID_H
#define ABUT_SHIM_FACET_GRID_H

#include "sampling.h"

#include <abut/facet.h>

#include <map>

namespace abut::shim
{
  /** A regular grid of points in facets, @p n along each edge. */
  template <int dim> class FacetGrid
  {
  public:
    explicit FacetGrid(const unsigned int n) : n_(n)
    {
    }

    /** The points of a facet whose node a is at place_of(a). */
    template <typename PlaceOf>
    std::vector<dealii::Point<dim>> points(const abut_facet_kind kind,
                                           const PlaceOf &place_of)
    {
      Shape &shape = shape_[kind];
      if (shape.empty())
        shape = tabulate(kind);
      std::vector<dealii::Point<dim>> result(shape.size());
      for (std::size_t q = 0; q < shape.size(); ++q)
        for (unsigned int a = 0; a < shape[q].size(); ++a)
          result[q] += shape[q][a] * dealii::Tensor<1, dim>(place_of(a));
      return result;
    }

  private:
    using Shape = std::vector<std::vector<double>>; // [points][nodes]

    Shape tabulate(const abut_facet_kind kind) const
    {
      Shape shape;
      const auto coordinate = [&](const unsigned int k)
      { return (2. * k + 1.) / n_ - 1.; };
      const auto add = [&](const double xi, const double eta)
      {
        const double local[2] = {xi, eta};
        shape.emplace_back(abut_facet_n_nodes(kind));
        abut_facet_shape(kind, local, shape.back().data(), nullptr, nullptr);
      };
      if (kind == ABUT_FACET_TRI3 || kind == ABUT_FACET_TRI6)
        for (const dealii::Point<2> &point : simplex_points<2>(n_))
          add(point[0], point[1]);
      else
        for (unsigned int j = 0; j < (dim == 2 ? 1 : n_); ++j)
          for (unsigned int i = 0; i < n_; ++i)
            add(coordinate(i), coordinate(j));
      return shape;
    }

    const unsigned int n_;
    std::map<abut_facet_kind, Shape> shape_;
  };
} // namespace abut::shim

#endif
