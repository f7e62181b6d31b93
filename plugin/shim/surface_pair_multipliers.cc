// SPDX-License-Identifier: LGPL-2.1-or-later
// The space of the multipliers of rows at quadrature points. There are more
// points than unknowns of the surface, so that values of their own would not be
// unique; those of functions of the secondary's nodes are.
#include "surface_pair_rows.h"

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  using dealii::types::global_dof_index;

  namespace
  {
    /** The rows of one pair as an operator from nodal values to points. */
    struct Interpolation
    {
      struct Share
      {
        global_dof_index node;
        double value;
      };

      dealii::IndexSet owned, needed;
      MPI_Comm communicator;
      std::vector<double> weight;            ///< [points]
      std::vector<std::vector<Share>> share; ///< [points]

      /** Values at the points. Collective. */
      std::vector<double> apply(const la::Vector &nodal) const
      {
        la::Vector ghosted(owned, needed, communicator);
        ghosted = nodal;
        std::vector<double> result(share.size(), 0.);
        for (std::size_t q = 0; q < share.size(); ++q)
          for (const Share &s : share[q])
            result[q] += s.value * ghosted(s.node);
        return result;
      }

      /** Integrals of values at the points times the nodes' functions (or the
       * functions' squares). Collective. */
      la::Vector test(const std::vector<double> &value,
                      const bool squared = false) const
      {
        la::Vector result(owned, communicator);
        for (std::size_t q = 0; q < share.size(); ++q)
          for (const Share &s : share[q])
            result(s.node) +=
                weight[q] * value[q] * s.value * (squared ? s.value : 1.);
        result.compress(dealii::VectorOperation::add);
        return result;
      }
    };

    /** Nodal values of the nearest function: conjugate gradients, scaled by the
     * diagonal of the matrix of masses, whose condition does not depend on the
     * mesh. Collective. */
    la::Vector nearest(const Interpolation &points,
                       const std::vector<double> &value)
    {
      constexpr unsigned int most_steps = 100;
      constexpr double tolerance = 1e-13;
      la::Vector residual = points.test(value);
      la::Vector diagonal =
          points.test(std::vector<double>(value.size(), 1.), true);
      double *d = la::data(diagonal);
      for (int i = 0; i < la::n_owned(diagonal); ++i)
        d[i] = d[i] > 0. ? 1. / d[i] : 0.;
      la::Vector result(points.owned, points.communicator);
      la::Vector scaled(residual);
      scaled.scale(diagonal);
      la::Vector direction(scaled);
      double product = residual * scaled;
      const double first = product;
      for (unsigned int k = 0;
           k < most_steps && product > tolerance * tolerance * first; ++k)
      {
        const la::Vector image = points.test(points.apply(direction));
        const double step = product / (direction * image);
        result.add(step, direction);
        residual.add(-step, image);
        scaled = residual;
        scaled.scale(diagonal);
        const double next = residual * scaled;
        direction.sadd(next / product, 1., scaled);
        product = next;
      }
      return result;
    }
  } // namespace

  template <int dim> bool SurfacePairRows<dim>::has_points() const
  {
    return std::any_of(
        pairs_.begin(), pairs_.end(),
        [](const Pair &pair)
        { return discretisation_info(pair.discretisation).row_per_point; });
  }

  template <int dim>
  template <typename Function>
  void SurfacePairRows<dim>::for_each_point_pair(const Function &function) const
  {
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      if (!discretisation_info(pairs_[p].discretisation).row_per_point)
        continue;
      Interpolation points{dof_handler_.locally_owned_dofs(),
                           dealii::IndexSet(dof_handler_.n_dofs()),
                           communicator_,
                           {},
                           {}};
      std::vector<std::size_t> rows;
      std::vector<global_dof_index> others;
      for_each_component(
          [&](const Component &component)
          {
            if (component.place.pair != p)
              return;
            rows.push_back(component.row);
            points.weight.push_back(view_.weight[component.point]);
            points.share.emplace_back();
            for_each_secondary(component.point,
                               [&](const Node node, const double c)
                               {
                                 const auto dof = surface_.nodes[node].dof[0];
                                 points.share.back().push_back({dof, c});
                                 if (!points.owned.is_element(dof))
                                   others.push_back(dof);
                               });
          });
      std::sort(others.begin(), others.end());
      points.needed.add_indices(others.begin(), others.end());
      function(points, rows);
    }
  }

  template <int dim> void SurfacePairRows<dim>::project(double *value) const
  {
    const bool has_friction = std::any_of(
        pairs_.begin(), pairs_.end(),
        [](const Pair &pair) { return pair.data.friction != nullptr; });
    for_each_point_pair(
        [&](const Interpolation &points, const std::vector<std::size_t> &rows)
        {
          std::vector<double> values;
          for (const std::size_t row : rows)
            values.push_back(value[row]);
          values = points.apply(nearest(points, values));
          for (std::size_t k = 0; k < rows.size(); ++k)
            value[rows[k]] = values[k];
          if (has_friction)
            project_tractions(points, rows, value);
        });
  }

  template <int dim>
  template <typename Points>
  void
  SurfacePairRows<dim>::project_tractions(const Points &points,
                                          const std::vector<std::size_t> &rows,
                                          double *value) const
  {
    // As vectors: tangents of neighbours need not go together.
    const auto end = [&](const std::size_t row)
    {
      const std::int32_t *const first = view_.component_start;
      const auto next = std::upper_bound(first, first + view_.n_points + 1,
                                         static_cast<std::int32_t>(row));
      const bool slides = view_.kind[next - first - 1] == ABUT_POINT_CONTACT;
      return slides ? static_cast<std::size_t>(*next) : row + 1;
    };
    const auto along = [&](const std::size_t row, const unsigned int d)
    { return view_.frame[row * std::size_t(dim) + d]; };
    std::vector<Direction> projected(rows.size());
    for (unsigned int d = 0; d < dim; ++d)
    {
      std::vector<double> part(rows.size(), 0.);
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (std::size_t t = rows[k] + 1; t < end(rows[k]); ++t)
          part[k] += value[t] * along(t, d);
      part = points.apply(nearest(points, part));
      for (std::size_t k = 0; k < rows.size(); ++k)
        projected[k][d] = part[k];
    }
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (std::size_t t = rows[k] + 1; t < end(rows[k]); ++t)
      {
        value[t] = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          value[t] += projected[k][d] * along(t, d);
      }
  }

  template <int dim>
  void SurfacePairRows<dim>::spread_stiffness(std::vector<double> &value) const
  {
    // Points of a whole linear facet have about this part of a node's area.
    constexpr double regular = dim == 2 ? 0.5 : 0.25;
    for_each_point_pair(
        [&](const Interpolation &points, const std::vector<std::size_t> &rows)
        {
          const std::vector<double> area =
              points.apply(points.test(std::vector<double>(rows.size(), 1.)));
          // Functions that change sign may have a share without area.
          for (std::size_t k = 0; k < rows.size(); ++k)
            if (area[k] > 0.)
              value[rows[k]] *= points.weight[k] / (regular * area[k]);
        });
  }

  template bool SurfacePairRows<2>::has_points() const;
  template bool SurfacePairRows<3>::has_points() const;
  template void SurfacePairRows<2>::project(double *) const;
  template void SurfacePairRows<3>::project(double *) const;
  template void
  SurfacePairRows<2>::spread_stiffness(std::vector<double> &) const;
  template void
  SurfacePairRows<3>::spread_stiffness(std::vector<double> &) const;
} // namespace abut::shim
