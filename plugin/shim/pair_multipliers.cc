// SPDX-License-Identifier: LGPL-2.1-or-later
// The space of the multipliers of rows at quadrature points. There are more
// points than unknowns of the surface, so that values of their own would not be
// unique; those of functions of the secondary's nodes are.
#include "pair_multipliers.h"

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
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

  template <int dim>
  template <typename Function>
  void PairMultipliers<dim>::for_each_point_pair(const Function &function) const
  {
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      if (!discretisation_info(pairs_[p].discretisation).row_per_point)
        continue;
      Interpolation points{host_.dof_handler.locally_owned_dofs(),
                           dealii::IndexSet(host_.dof_handler.n_dofs()),
                           host_.communicator,
                           {},
                           {}};
      std::vector<std::size_t> rows;
      std::vector<global_dof_index> others;
      points_.for_each_component(
          [&](const PointRow<dim> &component)
          {
            if (component.place.pair != p)
              return;
            rows.push_back(component.row);
            points.weight.push_back(points_.view().weight[component.point]);
            points.share.emplace_back();
            points_.for_each_secondary(
                component.point,
                [&](const NodeIndex node, const double c)
                {
                  const auto dof = points_.surface().nodes[node].dof[0];
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

  template <int dim> void PairMultipliers<dim>::project(double *value) const
  {
    const bool has_friction =
        std::any_of(pairs_.begin(), pairs_.end(),
                    [](const SurfacePair<dim> &pair)
                    { return pair.data.friction != nullptr; });
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
  PairMultipliers<dim>::project_tractions(const Points &points,
                                          const std::vector<std::size_t> &rows,
                                          double *value) const
  {
    // As vectors: tangents of neighbours need not go together.
    const auto end = [&](const std::size_t row)
    {
      const std::int32_t *const first = points_.view().component_start;
      const auto next =
          std::upper_bound(first, first + points_.view().n_points + 1,
                           static_cast<std::int32_t>(row));
      const bool slides =
          points_.view().kind[next - first - 1] == ABUT_POINT_CONTACT;
      return slides ? static_cast<std::size_t>(*next) : row + 1;
    };
    const auto along = [&](const std::size_t row, const unsigned int d)
    { return points_.view().frame[row * std::size_t(dim) + d]; };
    std::vector<Direction<dim>> projected(rows.size());
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
  void PairMultipliers<dim>::spread_stiffness(std::vector<double> &value) const
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

  template <int dim>
  void PairMultipliers<dim>::make_uniform(std::vector<double> &value) const
  {
    std::vector<double> sum(pairs_.size(), 0.), count(pairs_.size(), 0.);
    points_.for_each_component(
        [&](const PointRow<dim> &i)
        {
          sum[i.place.pair] += std::log(value[i.row]);
          count[i.place.pair] += 1.;
        });
    MPI::sum(sum, host_.communicator, sum);
    MPI::sum(count, host_.communicator, count);
    points_.for_each_component(
        [&](const PointRow<dim> &i)
        { value[i.row] = std::exp(sum[i.place.pair] / count[i.place.pair]); });
  }

  template <int dim>
  void PairMultipliers<dim>::copy_to_tangents(std::vector<double> &value) const
  {
    for (std::int32_t i = 0; i < points_.view().n_points; ++i)
      for (std::int32_t row = points_.view().component_start[i] + 1;
           row < points_.view().component_start[i + 1]
           && points_.view().kind[i] == ABUT_POINT_CONTACT;
           ++row)
        value[row] = value[points_.view().component_start[i]];
  }

  template <int dim>
  std::vector<std::uint8_t> PairMultipliers<dim>::first_contact(
      const std::vector<double> &gap, const std::vector<double> &pressure,
      const std::vector<double> &scale, const double touching) const
  {
    if (std::none_of(pairs_.begin(), pairs_.end(),
                     [](const auto &pair) { return pair.data.holds_body; }))
      return {};
    // Pressures of an earlier solve are better, and states of slip with them.
    const bool is_pressed = std::any_of(pressure.begin(), pressure.end(),
                                        [](const double p) { return p > 0.; });
    if (dealii::Utilities::MPI::logical_or(is_pressed, host_.communicator))
      return {};
    std::vector<std::uint8_t> state(points_.view().n_components);
    points_.for_each_component(
        [&](const PointRow<dim> &component)
        {
          const std::size_t i = component.row;
          const auto &pair = pairs_[component.place.pair].data;
          state[i] = pair.tied || scale[i] * gap[i] < 0.
                     || (pair.holds_body && gap[i] <= touching);
        });
    return state;
  }

  template class PairMultipliers<2>;
  template class PairMultipliers<3>;
} // namespace abut::shim
