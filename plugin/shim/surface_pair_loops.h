// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_PAIR_LOOPS_H
#define ABUT_SHIM_SURFACE_PAIR_LOOPS_H

// Loops over the rows of a pair and the nodes of their points; included by the
// class that has them, at its end.
#include "surface_pair_rows.h"

namespace abut::shim
{
  template <int dim>
  typename SurfacePairRows<dim>::Component
  SurfacePairRows<dim>::component(const std::size_t point,
                                  const std::int32_t row) const
  {
    const double sign =
        abut_point_sign(view_.kind[point], row - view_.component_start[point]);
    Direction direction;
    for (unsigned int d = 0; d < dim; ++d)
      direction[d] = -sign * view_.frame[row * std::size_t(dim) + d];
    return {point, static_cast<std::size_t>(row), places_[point], direction};
  }

  template <int dim>
  template <typename Function>
  void SurfacePairRows<dim>::for_each_row(const Function &function) const
  {
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (std::int32_t row = view_.component_start[i];
           row < view_.component_start[i + 1]; ++row)
        function(component(i, row));
  }

  template <int dim>
  template <typename Function>
  void SurfacePairRows<dim>::for_each_component(const Function &function) const
  {
    for_each_row(
        [&](const Component &row)
        {
          if (!is_tangent(row))
            function(row);
        });
  }

  template <int dim>
  template <typename Function>
  void SurfacePairRows<dim>::for_each_secondary(const std::size_t point,
                                                const Function &function) const
  {
    const std::int64_t first = view_.start[point];
    for (auto e = first; e < first + view_.n_secondary[point]; ++e)
      function(view_.node[e], view_.coefficient[e]);
  }

  template <int dim>
  template <typename Function>
  void SurfacePairRows<dim>::for_each_primary(const std::size_t point,
                                              const Function &function) const
  {
    for (auto e = view_.start[point] + view_.n_secondary[point];
         e < view_.start[point + 1]; ++e)
      function(view_.node[e], view_.coefficient[e]);
  }
} // namespace abut::shim

#endif
