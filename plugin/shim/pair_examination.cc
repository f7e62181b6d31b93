// SPDX-License-Identifier: LGPL-2.1-or-later
// Measures of an answer at the points of pairs: slips, rotations of directions,
// errors of gaps, and sums.
#include "pair_examination.h"

#include "agree.h"
#include "obstacle_width.h"
#include "pair_friction.h"
#include "pair_measures.h"

#include <abut/strategy.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::Tensor;

  namespace
  {
    /** A side's forces as results have them. */
    template <int dim>
    void copy_forces(const abut_side_forces &from, Tensor<1, dim> &force,
                     Tensor<1, 3> &moment, Tensor<1, 3> &now)
    {
      for (unsigned int d = 0; d < dim; ++d)
        force[d] = from.force[d];
      for (unsigned int d = 0; d < 3; ++d)
      {
        moment[d] = from.moment[d];
        now[d] = from.present_moment[d];
      }
    }
  } // namespace

  template <int dim>
  void PairExamination<dim>::find_rotations(const NodePositions<dim> &nodes,
                                            const double *row_pressure,
                                            const std::uint8_t *row_state)
  {
    run_everywhere<ContactError>(
        host_.communicator,
        [&]
        {
          for (SurfacePair<dim> &pair : pairs_)
          {
            pair.rotation = {};
            // A tie's force has any direction.
            if (pair.data.tied)
              continue;
            const abut_status status = abut_interface_rotation(
                pair.interface.get(), points_.handle(), &nodes.view,
                row_pressure, row_state, &pair.rotation);
            if (pair.data.obstacle)
              check(host_.context, *pair.data.obstacle, status);
            check(host_.context, status);
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
    const NodePositions<dim> nodes(points_, u);
    find_rotations(nodes, row_pressure, row_state);
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
    // Motion in this step, and since the point was made there.
    std::vector<Direction<dim>> motions(points_.view().n_points),
        since(motions.size());
    check(host_.context, abut_points_motion(points_.handle(), &nodes.view,
                                            data_of(motions), data_of(since)));
    points_.for_each_component(
        [&](const PointRow<dim> &row)
        {
          SurfacePair<dim> &pair = pairs_[row.place.pair];
          if (pair.data.tied || row_state == nullptr
              || row_state[row.row] == ABUT_STATE_OPEN)
            return;
          const Direction<dim> way =
              pair.data.obstacle ? ObstaclePoses<dim>::displacement(
                  row.place.position, poses.slip_start()[row.place.pair],
                  now[row.place.pair])
                                 : Direction<dim>();
          const Direction<dim> motion = motions[row.point] - way;
          const Direction<dim> tangential =
              motion - (motion * row.direction) * row.direction;
          pair.measured.slip = std::max(pair.measured.slip, tangential.norm());
          if (!pair.data.obstacle)
            return;
          Distances &looked_at = distances[row.place.pair];
          if (pair.data.geometric_gap && !pair.has_mean_gaps())
          {
            looked_at.to.push_back(row.place.position + since[row.point]);
            looked_at.expected.push_back(row_gap[row.row] - pair.data.gap);
            return;
          }
          // Gaps that are means, or no distances, are judged by their change,
          // at the node if there is one.
          const NodeIndex node = row.place.node;
          const Direction<dim> moved = node < 0 ? since[row.point]
                                       : pair.is_displaced()
                                           ? u[node] - points_.made_at(node)
                                           : u[node];
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
    const std::vector<double> oscillation =
        oscillations(points_, row_pressure, row_state);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      pairs_[p].measured.oscillation = oscillation[p];
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
    const auto force_of = [&](const PointRow<dim> &row)
    {
      return row_state == nullptr || row_state[row.row] == ABUT_STATE_OPEN
                 ? 0.
                 : points_.view().weight[row.point] * row_pressure[row.row];
    };
    // Where points of integration are near, there is nothing to search for.
    std::vector<int> wanted(pairs_.size(), 0);
    points_.for_each_component(
        [&](const PointRow<dim> &row)
        {
          const SurfacePair<dim> &pair = pairs_[row.place.pair];
          const double least = points_.places().least[row.point];
          const bool is_near =
              least > -pair.facet_size()
              && least + pair.data.gap - std::max(0., row_gap[row.row])
                     <= visible[row.place.pair];
          if (!is_near && force_of(row) > 0.)
            wanted[row.place.pair] = 1;
        });
    MPI::max(wanted, host_.communicator, wanted);
    const std::vector<double> clearance =
        clearances(points_, examined_, wanted);
    points_.for_each_component(
        [&](const PointRow<dim> &row)
        {
          const double force = force_of(row);
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
  std::vector<PairResult<dim>> PairExamination<dim>::results(
      const la::Vector *displacement, const double *row_pressure,
      const double *row_gap, const std::uint8_t *row_state,
      const std::vector<double> &late_force) const
  {
    std::vector<PairResult<dim>> results(pairs_.size());
    std::vector<Direction<dim>> moved;
    if (displacement != nullptr)
      moved = points_.displacements_in_reach(*displacement);
    else if (examined_.size() == surface_.nodes.size())
      moved = examined_;
    const NodePositions<dim> nodes(points_, moved);
    std::vector<abut_contact_sums> sums(pairs_.size());
    check(host_.context,
          abut_points_measure(points_.handle(), &nodes.view, row_pressure,
                              row_gap, row_state, sums.data()));
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      PairResult<dim> &result = results[p] = pairs_[p].measured;
      const abut_contact_sums &sum = sums[p];
      result.name = pairs_[p].data.name;
      result.n_rows = sum.n_rows;
      result.n_active = sum.n_active;
      result.covered_area = sum.covered_area;
      result.contact_area = sum.contact_area;
      result.pressure = sum.pressure;
      result.least_pressure = sum.least_pressure;
      result.largest_tension = sum.largest_tension;
      result.penetration = sum.penetration;
      result.initial_gap_work = sum.initial_gap_work;
      result.late_force = late_force[p];
      copy_forces(sum.secondary, result.secondary_force,
                  result.secondary_moment, result.present_moment);
      copy_forces(sum.primary, result.primary_force, result.primary_moment,
                  result.present_primary_moment);
      const abut_direction_change &rotation = pairs_[p].rotation;
      result.rotation =
          rotation.force > 0. ? rotation.sum / rotation.force : 0.;
      result.largest_rotation = rotation.largest;
      for (unsigned int d = 0; d < dim; ++d)
        result.rotated_force[d] = rotation.change[d];
    }
    if (std::any_of(pairs_.begin(), pairs_.end(),
                    [](const SurfacePair<dim> &pair)
                    { return pair.data.friction != nullptr; }))
      add_friction(points_, row_pressure, row_gap, row_state, results);
    reduce(results, host_.communicator);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      PairResult<dim> &result = results[p];
      if (std::isinf(result.least_pressure))
        result.least_pressure = 0.;
      if (result.n_slipping == result.n_active)
        result.late_force = 0.;
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
