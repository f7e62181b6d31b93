// SPDX-License-Identifier: LGPL-2.1-or-later
// Measures of an answer at the points of pairs: slips, rotations of directions,
// errors of gaps, and sums.
#include "pair_examination.h"

#include "agree.h"
#include "coordinates.h"
#include "obstacle_width.h"
#include "pair_friction.h"
#include "pair_measures.h"

#include <abut/obstacle_edge.h>
#include <abut/strategy.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::Tensor;

  namespace
  {
    template <int dim>
    Tensor<1, 3> cross(const dealii::Point<dim> &x, const Tensor<1, dim> &f)
    {
      Tensor<1, 3> a, b;
      for (unsigned int d = 0; d < dim; ++d)
      {
        a[d] = x[d];
        b[d] = f[d];
      }
      return dealii::cross_product_3d(a, b);
    }

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

    /** The points of a pair that carry a force. */
    template <int dim> class PressedPoints
    {
    public:
      PressedPoints(const PairPoints<dim> &points, const std::size_t pair,
                    const double *row_pressure, const std::uint8_t *row_state)
          : points_(points)
      {
        points.for_each_component(
            [&](const PointRow<dim> &row)
            {
              const double force = points.view().weight[row.point]
                                   * std::abs(row_pressure[row.row]);
              if (row.place.pair != pair || !(force > 0.)
                  || row_state == nullptr
                  || row_state[row.row] == ABUT_STATE_OPEN)
                return;
              point_.push_back(static_cast<std::int32_t>(row.point));
              force_.push_back(force);
              position_.push_back(row.place.position);
            });
      }

      /** Where nodes are displaced by @p u. */
      abut_direction_change
      rotation_at_obstacle(const SurfacePair<dim> &pair,
                           const std::vector<Direction<dim>> &u) const
      {
        const std::size_t n_nodes = points_.surface().nodes.size();
        std::vector<double> into, size;
        std::vector<Direction<dim>> displacement(u);
        for (std::size_t n = 0; n < n_nodes && pair.is_displaced(); ++n)
          displacement[n] -= points_.made_at(static_cast<NodeIndex>(n));
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
              points_.view().frame
              + points_.view().component_start[point_[i]] * dim;
          into.insert(into.end(), frame, frame + dim);
          size.push_back(
              std::pow(points_.view().weight[point_[i]], 1. / (dim - 1)));
        }
        std::vector<double> before =
            directions_at(*pair.data.obstacle, position_, into, size);
        for (std::size_t i = 0; i < before.size(); i += dim)
          // Rows in a thin obstacle go back the way they came, not through it:
          // the frame's first vector is into the material.
          if (std::inner_product(&before[i], &before[i] + dim, &into[i], 0.)
              > 0.)
            std::transform(&before[i], &before[i] + dim, &before[i],
                           std::negate<double>());
        return change(before,
                      directions_at(*pair.data.obstacle, now, into, size));
      }

      abut_direction_change
      rotation_of_bodies(SurfacePair<dim> &pair,
                         const std::vector<Direction<dim>> &u) const
      {
        const std::size_t n_nodes = points_.surface().nodes.size();
        std::vector<dealii::Point<dim>> reference(n_nodes), now(n_nodes);
        for (std::size_t n = 0; n < n_nodes; ++n)
        {
          reference[n] = points_.surface().nodes[n].point;
          now[n] = reference[n] + u[n];
        }
        // Nearest points have the direction of the primary's facets, all others
        // that of the secondary, see abut/coupling.h.
        const auto kind = discretisation_info(pair.discretisation);
        const bool of_primary = !kind.is_weighted && !kind.row_per_point;
        const SurfaceSide<dim> &side =
            of_primary ? pair.primary : pair.secondary;
        const auto directions_of = [&](const auto &place)
        {
          const DisplacedSides<dim> displaced(points_.host().context,
                                              pair.secondary, pair.primary,
                                              reference, place);
          return sums(of_primary ? ABUT_SIDE_PRIMARY : ABUT_SIDE_SECONDARY,
                      inward_normals(points_.host().context, side, n_nodes));
        };
        return change(
            directions_of(pair.is_displaced() ? points_.present() : reference),
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
        check(points_.host().context,
              abut_points_sum(points_.handle(), sides, n_points(),
                              point_.data(),
                              static_cast<std::int32_t>(value.size() / dim),
                              value.data(), result.data()));
        return result;
      }

      abut_direction_change change(const std::vector<double> &before,
                                   const std::vector<double> &after) const
      {
        abut_direction_change result = {};
        check(points_.host().context,
              abut_direction_change_add(dim, n_points(), force_.data(),
                                        before.data(), after.data(), &result));
        return result;
      }

      const PairPoints<dim> &points_;
      std::vector<std::int32_t> point_;
      std::vector<double> force_; ///< magnitude
      std::vector<dealii::Point<dim>> position_;
    };
  } // namespace

  template <int dim>
  void
  PairExamination<dim>::find_rotations(const std::vector<Direction<dim>> &u,
                                       const double *row_pressure,
                                       const std::uint8_t *row_state)
  {
    run_everywhere<ContactError>(
        host_.communicator,
        [&]
        {
          for (std::size_t p = 0; p < pairs_.size(); ++p)
          {
            SurfacePair<dim> &pair = pairs_[p];
            pair.rotation = {};
            // A tie's force has any direction.
            if (pair.data.tied)
              continue;
            const PressedPoints<dim> pressed(points_, p, row_pressure,
                                             row_state);
            pair.rotation = pair.data.obstacle
                                ? pressed.rotation_at_obstacle(pair, u)
                                : pressed.rotation_of_bodies(pair, u);
          }
        });
    for (SurfacePair<dim> &pair : pairs_)
    {
      abut_direction_change &rotation = pair.rotation;
      for (double *value : {&rotation.force, &rotation.sum, rotation.change,
                            rotation.change + 1, rotation.change + 2})
        *value = MPI::sum(*value, host_.communicator);
      rotation.largest = MPI::max(rotation.largest, host_.communicator);
    }
  }

  template <int dim>
  void PairExamination<dim>::examine(
      const la::Vector &displacement, const double *row_pressure,
      const double *row_gap, const std::uint8_t *row_state,
      const std::vector<FacetPenetration> &facet_penetrations)
  {
    const std::vector<Direction<dim>> u =
        points_.displacements_in_reach(displacement);
    examined_ = u;
    const ObstaclePoses<dim> &poses = points_.set().obstacles();
    const std::vector<RigidPose<dim>> now = poses.now();
    find_rotations(u, row_pressure, row_state);
    // Distances from an obstacle, or their changes on a path.
    struct Distances
    {
      std::vector<dealii::Point<dim>> from, to;
      std::vector<double> expected;
    };
    std::vector<Distances> distances(pairs_.size());
    for (SurfacePair<dim> &pair : pairs_)
    {
      PairResult<dim> &measured = pair.measured;
      measured.slip = measured.gap_error = measured.missed_depth = 0.;
      if (!pair.data.obstacle)
        continue;
      measured.between_rows = 0.;
      pair.narrowest = narrowest_width(points_, pair, u);
    }
    points_.for_each_component(
        [&](const PointRow<dim> &row)
        {
          SurfacePair<dim> &pair = pairs_[row.place.pair];
          if (pair.data.tied || row_state == nullptr
              || row_state[row.row] == ABUT_STATE_OPEN)
            return;
          const auto since_made = [&](const NodeIndex node)
          {
            return u[node]
                   - (pair.is_displaced() ? points_.made_at(node)
                                          : Direction<dim>());
          };
          // Motion in this step, and since the point was made there.
          Direction<dim> motion = points_.relative_displacement(row, u), since;
          points_.for_each_node(row.point,
                                [&](const NodeIndex node, const double c)
                                { since += c * since_made(node); });
          const Direction<dim> way =
              pair.data.obstacle ? ObstaclePoses<dim>::displacement(
                  row.place.position, poses.slip_start()[row.place.pair],
                  now[row.place.pair])
                                 : Direction<dim>();
          motion -= way;
          const Direction<dim> tangential =
              motion - (motion * row.direction) * row.direction;
          pair.measured.slip = std::max(pair.measured.slip, tangential.norm());
          if (!pair.data.obstacle)
            return;
          Distances &looked_at = distances[row.place.pair];
          if (pair.data.geometric_gap && !pair.has_mean_gaps())
          {
            looked_at.to.push_back(row.place.position + since);
            looked_at.expected.push_back(row_gap[row.row] - pair.data.gap);
            return;
          }
          // Gaps that are means, or no distances, are judged by their change,
          // at the node if there is one.
          const Direction<dim> moved =
              row.place.node < 0 ? since : since_made(row.place.node);
          looked_at.from.push_back(row.place.position + way);
          looked_at.to.push_back(row.place.position + moved);
          looked_at.expected.push_back(-(row.direction * (moved - way)));
        });
    run_everywhere<ContactError>(
        host_.communicator,
        [&]
        {
          std::vector<double> from, to;
          for (std::size_t p = 0; p < pairs_.size(); ++p)
          {
            if (distances[p].to.empty())
              continue;
            pairs_[p].data.obstacle->distance(distances[p].to, to);
            from.assign(to.size(), 0.);
            if (!distances[p].from.empty())
              pairs_[p].data.obstacle->distance(distances[p].from, from);
            for (std::size_t i = 0; i < to.size(); ++i)
            {
              const double error =
                  std::abs(to[i] - from[i] - distances[p].expected[i]);
              if (error <= pairs_[p].measured.gap_error)
                continue;
              pairs_[p].measured.gap_error = error;
              pairs_[p].gap_error_place = distances[p].to[i];
            }
          }
        });
    for (const FacetPenetration &found : facet_penetrations)
    {
      SurfacePair<dim> &pair = pairs_[found.pair];
      pair.measured.between_rows =
          std::max(pair.measured.between_rows, found.depth);
      if (found.is_missed)
        pair.measured.missed_depth =
            std::max(pair.measured.missed_depth, found.depth);
    }
    for (SurfacePair<dim> &pair : pairs_)
      for (const auto &[error, place] : MPI::all_gather(
               host_.communicator,
               std::make_pair(pair.measured.gap_error, pair.gap_error_place)))
        if (error > pair.measured.gap_error)
        {
          pair.measured.gap_error = error;
          pair.gap_error_place = place;
        }
  }

  template <int dim>
  std::vector<SeparatedRows>
  PairExamination<dim>::apart(const std::vector<double> &visible,
                              const double *row_pressure, const double *row_gap,
                              const std::uint8_t *row_state) const
  {
    std::vector<SeparatedRows> result(pairs_.size());
    const std::vector<double> clearance = clearances(points_, examined_, false);
    points_.for_each_component(
        [&](const PointRow<dim> &row)
        {
          const double force =
              row_state == nullptr || row_state[row.row] == ABUT_STATE_OPEN
                  ? 0.
                  : points_.view().weight[row.point] * row_pressure[row.row];
          if (!(force > 0.))
            return;
          SeparatedRows &found = result[row.place.pair];
          found.all += force;
          // The gap that the law leaves is not an error of the row.
          const double gap =
              clearance[row.row] - std::max(0., row_gap[row.row]);
          if (!std::isfinite(gap) || gap <= visible[row.place.pair])
            return;
          found.force += force;
          found.gap = std::max(found.gap, gap);
        });
    for (SeparatedRows &found : result)
    {
      found.force = MPI::sum(found.force, host_.communicator);
      found.all = MPI::sum(found.all, host_.communicator);
      found.gap = MPI::max(found.gap, host_.communicator);
    }
    return result;
  }

  template <int dim>
  std::vector<PairResult<dim>>
  PairExamination<dim>::results(const double *row_pressure,
                                const double *row_gap,
                                const std::uint8_t *row_state) const
  {
    std::vector<PairResult<dim>> results(pairs_.size());
    constexpr double none = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      results[p] = pairs_[p].measured;
      results[p].name = pairs_[p].data.name;
      results[p].least_pressure = none;
      const abut_direction_change &rotation = pairs_[p].rotation;
      results[p].rotation =
          rotation.force > 0. ? rotation.sum / rotation.force : 0.;
      results[p].largest_rotation = rotation.largest;
      for (unsigned int d = 0; d < dim; ++d)
        results[p].rotated_force[d] = rotation.change[d];
    }
    points_.for_each_component(
        [&](const PointRow<dim> &row)
        {
          const std::size_t i = row.row;
          const bool tied = pairs_[row.place.pair].data.tied;
          PairResult<dim> &result = results[row.place.pair];
          ++result.n_rows;
          const double weight = points_.view().weight[row.point];
          const double area = weight / (tied ? dim : 1.);
          result.covered_area += area;
          const bool is_closed = row_state == nullptr
                                     ? row_pressure[i] != 0.
                                     : row_state[i] != ABUT_STATE_OPEN;
          if (row_state != nullptr && is_closed)
          {
            ++result.n_active;
            result.contact_area += area;
          }
          result.penetration = std::max(
              result.penetration, tied ? std::abs(row_gap[i]) : -row_gap[i]);
          result.pressure = std::max(result.pressure, row_pressure[i]);
          if (!tied)
          {
            result.largest_tension =
                std::max(result.largest_tension, -row_pressure[i]);
            if (is_closed)
              result.least_pressure =
                  std::min(result.least_pressure, row_pressure[i]);
          }
          // Points that move have no gaps at displacement 0.
          if (row.place.hessian.empty())
            result.initial_gap_work +=
                weight * row_pressure[i] * points_.view().gap[i];
        });
    const bool is_examined = examined_.size() == surface_.nodes.size();
    points_.for_each_row(
        [&](const PointRow<dim> &row)
        {
          PairResult<dim> &result = results[row.place.pair];
          const Direction<dim> total = -points_.view().weight[row.point]
                                       * row_pressure[row.row] * row.direction;
          const auto add = [&](dealii::Tensor<1, dim> &force,
                               Tensor<1, 3> &moment, Tensor<1, 3> &now)
          {
            return [&](const NodeIndex node, const double c)
            {
              const Direction<dim> part = c * total;
              const dealii::Point<dim> &place =
                  pairs_[row.place.pair].is_displaced()
                      ? points_.present()[node]
                      : surface_.nodes[node].point;
              force += part;
              moment += cross(place, part);
              now += cross(is_examined
                               ? surface_.nodes[node].point + examined_[node]
                               : place,
                           part);
            };
          };
          points_.for_each_secondary(row.point, add(result.secondary_force,
                                                    result.secondary_moment,
                                                    result.present_moment));
          points_.for_each_primary(
              row.point, add(result.primary_force, result.primary_moment,
                             result.present_primary_moment));
        });
    if (std::any_of(pairs_.begin(), pairs_.end(),
                    [](const SurfacePair<dim> &pair)
                    { return pair.data.friction != nullptr; }))
      add_friction(points_, row_pressure, row_gap, row_state, results);
    reduce(results, host_.communicator);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      PairResult<dim> &result = results[p];
      if (result.least_pressure == none)
        result.least_pressure = 0.;
      if (pairs_[p].data.obstacle)
      {
        result.primary_force = -result.secondary_force;
        result.primary_moment = -result.secondary_moment;
        result.present_primary_moment = -result.present_moment;
      }
      const double force = result.secondary_force.norm();
      if (force > 0.)
      {
        result.force_imbalance =
            (result.secondary_force + result.primary_force).norm() / force;
        const double size = force * pairs_[p].secondary.everywhere.extent;
        result.moment_imbalance =
            (result.secondary_moment + result.primary_moment).norm() / size;
        result.present_moment_imbalance =
            (result.present_moment + result.present_primary_moment).norm()
            / size;
      }
    }
    return results;
  }

  template class PairExamination<2>;
  template class PairExamination<3>;
} // namespace abut::shim
