// SPDX-License-Identifier: LGPL-2.1-or-later
// How far the directions of contact have turned since the rows were made, and
// what that is worth as a force.
#include "surface_pair_rows.h"

#include "agree.h"

#include <abut/dealii/rigid_obstacle.h>
#include <abut/obstacle_edge.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    template <int dim>
    dealii::Tensor<1, dim> unit(const dealii::Tensor<1, dim> &vector)
    {
      const double length = vector.norm();
      return length > 0. ? vector / length : vector;
    }

    /** Outward normals of a side's nodes. */
    template <int dim>
    std::vector<dealii::Tensor<1, dim>> normals_of(const abut_context *context,
                                                   const SurfaceSide<dim> &side)
    {
      const double *normal = nullptr;
      check(context, abut_surface_normals(side.surface.get(), &normal));
      std::vector<dealii::Tensor<1, dim>> result(side.n_nodes());
      for (int n = 0; n < side.n_nodes(); ++n)
        for (unsigned int d = 0; d < dim; ++d)
          result[n][d] = normal[n * dim + d];
      return result;
    }

    /** Directions out of an obstacle at points of a body; at its edges the
     * body's, which are those of the rows' first frame vectors @p into. */
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    directions_at(const RigidObstacle<dim> &obstacle,
                  const std::vector<dealii::Point<dim>> &points,
                  const std::vector<double> &into,
                  const std::vector<double> &size)
    {
      std::vector<double> distance, place, gradient;
      std::vector<dealii::Tensor<1, dim>> result;
      obstacle.distance(points, distance, &result);
      for (std::size_t i = 0; i < points.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
        {
          place.push_back(points[i][d]);
          gradient.push_back(result[i][d]);
        }
      if (abut_obstacle_face(obstacle.handle(), false,
                             static_cast<std::int32_t>(points.size()),
                             place.data(), into.data(), size.data(),
                             distance.data(), gradient.data(), nullptr)
          != ABUT_SUCCESS)
        throw ContactError(obstacle.failure());
      for (std::size_t i = 0; i < points.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          result[i][d] = gradient[dim * i + d];
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<typename SurfacePairRows<dim>::Pressed>
  SurfacePairRows<dim>::pressed_points(const std::size_t pair,
                                       const double *row_pressure,
                                       const std::uint8_t *row_state) const
  {
    std::vector<Pressed> result;
    for_each_component(
        [&](const Component &row)
        {
          const double force =
              view_.weight[row.point] * std::abs(row_pressure[row.row]);
          if (row.place.pair == pair && force > 0. && row_state != nullptr
              && row_state[row.row] != ABUT_STATE_OPEN)
            result.push_back({row.point, force, row.place.position});
        });
    return result;
  }

  template <int dim>
  typename SurfacePairRows<dim>::Turn
  SurfacePairRows<dim>::turn_at_obstacle(const Pair &pair,
                                         const std::vector<Pressed> &pressed,
                                         const std::vector<Direction> &u) const
  {
    std::vector<dealii::Point<dim>> made, now;
    for (const Pressed &point : pressed)
    {
      Direction since;
      for_each_secondary(
          point.point,
          [&](const Node node, const double c)
          {
            since += c
                     * (u[node]
                        - (pair.is_displaced() ? made_at(node) : Direction()));
          });
      made.push_back(point.position);
      now.push_back(point.position + since);
    }
    // For a height along an axis, too, whose force is along the axis by choice:
    // the change of its slope does not count.
    std::vector<double> into, size;
    for (const Pressed &point : pressed)
    {
      const double *frame =
          view_.frame + view_.component_start[point.point] * dim;
      into.insert(into.end(), frame, frame + dim);
      size.push_back(std::pow(view_.weight[point.point], 1. / (dim - 1)));
    }
    const std::vector<Direction> before =
        directions_at(*pair.data.obstacle, made, into, size);
    const std::vector<Direction> after =
        directions_at(*pair.data.obstacle, now, into, size);
    Turn turn;
    for (std::size_t i = 0; i < pressed.size(); ++i)
    {
      // Rows in a thin obstacle go back the way they came, not through it: the
      // frame's first vector is into the material.
      double cosine = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        cosine += into[i * dim + d] * before[i][d];
      const double way = cosine > 0. ? -1. : 1.;
      turn.add(pressed[i].force, way * unit(before[i]), unit(after[i]));
    }
    return turn;
  }

  template <int dim>
  typename SurfacePairRows<dim>::Turn
  SurfacePairRows<dim>::turn_of_bodies(Pair &pair,
                                       const std::vector<Pressed> &pressed,
                                       const std::vector<Direction> &u) const
  {
    std::vector<dealii::Point<dim>> undeformed(surface_.nodes.size());
    std::vector<dealii::Point<dim>> now(undeformed);
    for (std::size_t n = 0; n < now.size(); ++n)
    {
      undeformed[n] = surface_.nodes[n].point;
      now[n] = undeformed[n] + u[n];
    }
    // Nearest points have the direction of the primary's facets, all others
    // that of the secondary, see abut/coupling.h.
    const abut_discretisation_info kind =
        discretisation_info(pair.discretisation);
    const bool of_primary = !kind.is_weighted && !kind.row_per_point;
    const SurfaceSide<dim> &side = of_primary ? pair.primary : pair.secondary;
    const auto normals_at = [&](const std::vector<dealii::Point<dim>> &place)
    {
      const DisplacedSides<dim> displaced(context_, pair.secondary,
                                          pair.primary, undeformed, place);
      return normals_of(context_, side);
    };
    const std::vector<Direction> before =
        pair.is_displaced() ? normals_at(present_) : normals_of(context_, side);
    const std::vector<Direction> after = normals_at(now);
    Turn turn;
    for (const Pressed &point : pressed)
    {
      Direction mean_before, mean_after;
      const auto add = [&](const Node node, const double c)
      {
        const int n = side.local_node(node);
        mean_before += c * before[n];
        mean_after += c * after[n];
      };
      // Outward normals of the other side are the way of the force.
      if (of_primary)
        for_each_primary(point.point, [&](const Node node, const double c)
                         { add(node, -c); });
      else
        for_each_secondary(point.point, [&](const Node node, const double c)
                           { add(node, -c); });
      turn.add(point.force, unit(mean_before), unit(mean_after));
    }
    return turn;
  }

  template <int dim>
  void SurfacePairRows<dim>::find_turns(const std::vector<Direction> &u,
                                        const double *row_pressure,
                                        const std::uint8_t *row_state)
  {
    run_everywhere<ContactError>(
        communicator_,
        [&]
        {
          for (std::size_t p = 0; p < pairs_.size(); ++p)
          {
            Pair &pair = pairs_[p];
            pair.turn = Turn();
            // A tie's force has any direction.
            if (pair.data.tied)
              continue;
            const std::vector<Pressed> pressed =
                pressed_points(p, row_pressure, row_state);
            pair.turn = pair.data.obstacle ? turn_at_obstacle(pair, pressed, u)
                                           : turn_of_bodies(pair, pressed, u);
          }
        });
    for (Pair &pair : pairs_)
    {
      Turn &turn = pair.turn;
      turn.force = MPI::sum(turn.force, communicator_);
      turn.sum = MPI::sum(turn.sum, communicator_);
      turn.largest = MPI::max(turn.largest, communicator_);
      turn.change = MPI::sum(turn.change, communicator_);
    }
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void SurfacePairRows<dim>::find_turns(                              \
      const std::vector<Direction> &, const double *, const std::uint8_t *);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim
