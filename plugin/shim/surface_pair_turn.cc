// SPDX-License-Identifier: LGPL-2.1-or-later
// How far the directions of contact have turned since the rows were made, and
// what that is worth as a force.
#include "surface_pair_rows.h"

#include "agree.h"
#include "coordinates.h"

#include <abut/dealii/rigid_obstacle.h>
#include <abut/obstacle_edge.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Inward normals of a side's nodes, [nodes of the whole * dim]: where the
     * forces on the other side go. */
    template <int dim>
    std::vector<double> inward_normals(const abut_context *context,
                                       const SurfaceSide<dim> &side,
                                       const std::size_t n_nodes)
    {
      const double *normal = nullptr;
      check(context, abut_surface_normals(side.surface.get(), &normal));
      std::vector<double> result(n_nodes * dim, 0.);
      for (int n = 0; n < side.n_nodes(); ++n)
        for (unsigned int d = 0; d < dim; ++d)
          result[side.node[n] * std::size_t(dim) + d] = -normal[n * dim + d];
      return result;
    }

    /** Directions out of an obstacle at points of a body, [points * dim]; at
     * its edges the body's, which are those of the rows' first frame vectors @p
     * into. */
    template <int dim>
    std::vector<double>
    directions_at(const RigidObstacle<dim> &obstacle,
                  const std::vector<dealii::Point<dim>> &points,
                  const std::vector<double> &into,
                  const std::vector<double> &size)
    {
      std::vector<double> distance;
      std::vector<dealii::Tensor<1, dim>> gradient;
      obstacle.distance(points, distance, &gradient);
      std::vector<double> result = coordinates(gradient);
      if (abut_obstacle_face(obstacle.handle(), false,
                             static_cast<std::int32_t>(points.size()),
                             coordinates(points).data(), into.data(),
                             size.data(), distance.data(), result.data(),
                             nullptr)
          != ABUT_SUCCESS)
        throw ContactError(obstacle.failure());
      return result;
    }
  } // namespace

  /** The points of a pair that carry a force. */
  template <int dim> class SurfacePairRows<dim>::PressedPoints
  {
  public:
    PressedPoints(const SurfacePairRows &rows, const std::size_t pair,
                  const double *row_pressure, const std::uint8_t *row_state)
        : rows_(rows)
    {
      rows.for_each_component(
          [&](const Component &row)
          {
            const double force =
                rows.view_.weight[row.point] * std::abs(row_pressure[row.row]);
            if (row.place.pair != pair || !(force > 0.) || row_state == nullptr
                || row_state[row.row] == ABUT_STATE_OPEN)
              return;
            point_.push_back(static_cast<std::int32_t>(row.point));
            force_.push_back(force);
            position_.push_back(row.place.position);
          });
    }

    /** Where nodes are displaced by @p u. */
    abut_direction_change
    rotation_at_obstacle(const Pair &pair,
                         const std::vector<Direction> &u) const
    {
      const std::size_t n_nodes = rows_.surface_.nodes.size();
      std::vector<double> into, size;
      std::vector<Direction> displacement(u);
      for (std::size_t n = 0; n < n_nodes && pair.is_displaced(); ++n)
        displacement[n] -= rows_.made_at(static_cast<Node>(n));
      const std::vector<double> since =
          sums(ABUT_SIDE_SECONDARY, coordinates(displacement));
      std::vector<dealii::Point<dim>> now(position_);
      // For a height along an axis, too, whose force is along the axis by
      // choice: the change of its slope does not count.
      for (std::size_t i = 0; i < now.size(); ++i)
      {
        for (unsigned int d = 0; d < dim; ++d)
          now[i][d] += since[i * dim + d];
        const double *frame =
            rows_.view_.frame + rows_.view_.component_start[point_[i]] * dim;
        into.insert(into.end(), frame, frame + dim);
        size.push_back(std::pow(rows_.view_.weight[point_[i]], 1. / (dim - 1)));
      }
      std::vector<double> before =
          directions_at(*pair.data.obstacle, position_, into, size);
      for (std::size_t i = 0; i < before.size(); i += dim)
        // Rows in a thin obstacle go back the way they came, not through it:
        // the frame's first vector is into the material.
        if (std::inner_product(&before[i], &before[i] + dim, &into[i], 0.) > 0.)
          std::transform(&before[i], &before[i] + dim, &before[i],
                         std::negate<double>());
      return change(before,
                    directions_at(*pair.data.obstacle, now, into, size));
    }

    abut_direction_change
    rotation_of_bodies(Pair &pair, const std::vector<Direction> &u) const
    {
      const std::size_t n_nodes = rows_.surface_.nodes.size();
      std::vector<dealii::Point<dim>> reference(n_nodes), now(n_nodes);
      for (std::size_t n = 0; n < n_nodes; ++n)
      {
        reference[n] = rows_.surface_.nodes[n].point;
        now[n] = reference[n] + u[n];
      }
      // Nearest points have the direction of the primary's facets, all others
      // that of the secondary, see abut/coupling.h.
      const auto kind = discretisation_info(pair.discretisation);
      const bool of_primary = !kind.is_weighted && !kind.row_per_point;
      const SurfaceSide<dim> &side = of_primary ? pair.primary : pair.secondary;
      const auto directions_of = [&](const auto &place)
      {
        const DisplacedSides<dim> displaced(rows_.context_, pair.secondary,
                                            pair.primary, reference, place);
        return sums(of_primary ? ABUT_SIDE_PRIMARY : ABUT_SIDE_SECONDARY,
                    inward_normals(rows_.context_, side, n_nodes));
      };
      return change(
          directions_of(pair.is_displaced() ? rows_.present_ : reference),
          directions_of(now));
    }

  private:
    std::int32_t n_points() const
    {
      return static_cast<std::int32_t>(point_.size());
    }

    /** abut_points_sum() of values [nodes of the whole * dim]. */
    std::vector<double> sums(const abut_point_sides sides,
                             const std::vector<double> &value) const
    {
      std::vector<double> result(point_.size() * dim);
      check(rows_.context_,
            abut_points_sum(rows_.points_, sides, n_points(), point_.data(),
                            static_cast<std::int32_t>(value.size() / dim),
                            value.data(), result.data()));
      return result;
    }

    abut_direction_change change(const std::vector<double> &before,
                                 const std::vector<double> &after) const
    {
      abut_direction_change result = {};
      check(rows_.context_,
            abut_direction_change_add(dim, n_points(), force_.data(),
                                      before.data(), after.data(), &result));
      return result;
    }

    const SurfacePairRows &rows_;
    std::vector<std::int32_t> point_;
    std::vector<double> force_; ///< magnitude
    std::vector<dealii::Point<dim>> position_;
  };

  template <int dim>
  void SurfacePairRows<dim>::find_rotations(const std::vector<Direction> &u,
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
            pair.rotation = {};
            // A tie's force has any direction.
            if (pair.data.tied)
              continue;
            const PressedPoints pressed(*this, p, row_pressure, row_state);
            pair.rotation = pair.data.obstacle
                                ? pressed.rotation_at_obstacle(pair, u)
                                : pressed.rotation_of_bodies(pair, u);
          }
        });
    for (Pair &pair : pairs_)
    {
      abut_direction_change &rotation = pair.rotation;
      for (double *value : {&rotation.force, &rotation.sum, rotation.change,
                            rotation.change + 1, rotation.change + 2})
        *value = MPI::sum(*value, communicator_);
      rotation.largest = MPI::max(rotation.largest, communicator_);
    }
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void SurfacePairRows<dim>::find_rotations(                          \
      const std::vector<Direction> &, const double *, const std::uint8_t *);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim
