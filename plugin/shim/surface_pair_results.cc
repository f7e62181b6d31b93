// SPDX-License-Identifier: LGPL-2.1-or-later
// Checks of pairs of surfaces, and results of a solve there.
#include "pair_measures.h"
#include "surface_pair_rows.h"

#include "agree.h"
#include "bodies.h"

#include <abut/dealii/coded.h>
#include <abut/strategy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::Tensor;

  namespace
  {
    /** Facets of the secondary as a multiple of those of the primary, above
     * which nodes of the primary can pass between those of the secondary. */
    constexpr double coarse_secondary = 2.5;

    /** Angle between the normals of two facets that is too much for a smooth
     * surface, degrees: a circle of 12 facets. */
    constexpr double large_rotation = 30.;

    /** Initial overlap, in sizes of a facet, that is worth a word. */
    constexpr double large_overlap = 0.3;
    /** The same in thicknesses of the thinner body, of bodies that fly. */
    constexpr double visible_part = 0.1;
    /** Surfaces that meet on less of a facet's width are between nodes. */
    constexpr double narrow_zone = 0.5;

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

    template <typename Number> std::string text(const Number number)
    {
      std::ostringstream out;
      out << number;
      return out.str();
    }
  } // namespace

  template <int dim>
  std::string SurfacePairRows<dim>::turning_facets(const Pair &pair) const
  {
    // Only what is near the other side: facets at the nodes of rows.
    std::vector<std::uint8_t> near(surface_.nodes.size(), 0);
    const auto mark = [&](const Node node, double) { near[node] = 1; };
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (&pairs_[places_[i].pair] == &pair)
      {
        for_each_secondary(i, mark);
        for_each_primary(i, mark);
      }
    const auto turns = [&](const SurfaceSide<dim> &side)
    {
      std::vector<std::uint8_t> mask(side.n_facets());
      abut_surface_view view;
      check(context_, abut_surface_get(side.surface.get(), &view));
      if (side.n_facets() > 0)
        check(context_, abut_surface_features(
                            side.surface.get(),
                            large_rotation * M_PI / 180. - 1e-6, mask.data()));
      bool found = false;
      for (int f = 0; f < side.n_facets() && !found; ++f)
      {
        bool is_near = false;
        for (std::int32_t i = view.facet_start[f]; i < view.facet_start[f + 1];
             ++i)
          is_near = is_near || near[side.node[view.connectivity[i]]] != 0;
        for (int k = 0; k < 4 && is_near; ++k)
          found =
              found
              || ((mask[f] >> k & 1) != 0
                  && view.neighbour[4 * static_cast<std::size_t>(f) + k] >= 0);
      }
      return MPI::max(found ? 1 : 0, communicator_) != 0;
    };
    const bool secondary = turns(pair.secondary);
    const bool primary = !pair.data.obstacle && turns(pair.primary);
    return secondary && primary ? "two surfaces"
           : secondary          ? "secondary surface"
           : primary            ? "primary surface"
                                : "";
  }

  template <int dim>
  double SurfacePairRows<dim>::first_overlap(const std::size_t number,
                                             const double overlap)
  {
    Pair &pair = pairs_[number];
    if (!pair.data.obstacle)
      return pair.has_current_directions() ? pair.first_inside.depth : overlap;
    // At rest obstacles are moved into bodies on purpose.
    if (!pair.data.may_be_apart || !pair.data.geometric_gap)
      return 0.;
    // Points that move are later those of a step on its way, and a force has
    // moved the obstacle before the first.
    if (n_finds_ > 1)
      return pair.first_inside.depth;
    const RigidPose<dim> now = pair.data.obstacle->pose();
    const RigidPose<dim> first = pair.data.first_pose.value_or(now);
    std::vector<dealii::Point<dim>> nodes;
    for_each_row(
        [&](const Component &row)
        {
          if (row.place.pair != number)
            return;
          const dealii::Point<dim> place =
              row.place.node < 0 ? row.place.position
                                 : surface_.nodes[row.place.node].point;
          nodes.push_back(place - rigid_displacement(place, now, first));
        });
    std::vector<double> distance;
    run_everywhere<ContactError>(
        communicator_, [&] { pair.data.obstacle->distance(nodes, distance); });
    double depth = 0.;
    for (const double value : distance)
      depth = std::max(depth, -value);
    pair.first_inside.depth = MPI::max(depth, communicator_);
    return pair.first_inside.depth;
  }

  template <int dim>
  Message SurfacePairRows<dim>::overlap_at_start(Pair &pair,
                                                 const PairCheck &found)
  {
    const double depth = found.first_overlap;
    const bool is_large = depth > large_overlap * found.facet_size;
    if (pair.data.may_be_apart && !is_large && depth > 0.
        && pair.least_extent == 0.)
      pair.least_extent =
          std::min(least_extent(mapping_, dof_handler_, pair.data.secondary),
                   least_extent(mapping_, dof_handler_, pair.data.primary));
    const double body = pair.least_extent;
    if (!is_large && (body == 0. || depth <= visible_part * body))
      return "";
    const bool is_obstacle = pair.data.obstacle != nullptr;
    return coded(
        ABUT_FAILURE_OVERLAP,
        (is_obstacle ? "Nodes of the surface are inside of the obstacle by "
                     : "The surfaces overlap by ")
            + text(depth) + " before anything "
            + (is_obstacle ? "moves, " : "is loaded, ")
            + (is_large
                   ? text(depth / found.facet_size)
                         + " times the size of a facet. "
                   : text(depth / body) + " times the thickness of a body. ")
            + (is_obstacle ? "Motions throw them out in their first step, in "
                             "equilibrium its force moves the obstacle out: "
                             "begin where the two are apart."
                           : "If that is not meant as interference, move "
                             "the bodies apart."));
  }

  template <int dim>
  void SurfacePairRows<dim>::make_check(const std::size_t number,
                                        const unsigned int n_dropped)
  {
    Pair &pair = pairs_[number];
    abut_coupling_statistics statistics;
    check(context_,
          abut_coupling_get_statistics(pair.coupling.get(), &statistics));
    const SideMeasures &sizes = pair.secondary.everywhere;

    PairCheck result;
    result.name = pair.data.name;
    result.secondary_facets = sizes.n_facets;
    result.primary_facets = pair.primary.everywhere.n_facets;
    result.history_by_place = !has_lasting_numbers(pair);
    result.n_dropped = n_dropped;
    result.area = MPI::sum(statistics.full_area, communicator_);
    if (result.area == 0.)
      result.area = sizes.area;
    result.facet_size = sizes.median;
    if (!pair.data.obstacle)
      result.size_ratio = sizes.median / pair.primary.everywhere.median;
    double covered = 0., deepest = 0.;
    dealii::types::global_dof_index n_rows = 0;
    for_each_component(
        [&](const Component &row)
        {
          if (row.place.pair != number)
            return;
          ++n_rows;
          covered += view_.weight[row.point] / (pair.data.tied ? dim : 1.);
          deepest =
              std::max(deepest, pair.data.tied ? 0. : -view_.gap[row.row]);
        });
    result.n_rows = MPI::sum(n_rows, communicator_);
    result.covered_area = MPI::sum(covered, communicator_);
    result.overlap = MPI::max(deepest, communicator_);

    if (result.size_ratio > coarse_secondary)
      result.warnings.push_back(coded(
          ABUT_FAILURE_COARSE_SECONDARY,
          "The secondary surface is " + text(result.size_ratio)
              + " times as coarse as the primary, whose nodes can pass between "
                "those of the secondary: exchange the two sides, or refine the "
                "secondary."));
    result.first_overlap = first_overlap(number, result.overlap);
    const Message overlap = overlap_at_start(pair, result);
    if (!overlap.empty())
      result.warnings.push_back(overlap);
    if (!pair.data.obstacle && !pair.has_current_directions()
        && result.covered_area > 0.)
    {
      // In graded meshes the smallest facets are likely to be the ones in
      // contact.
      const double smallest =
          std::max(sizes.smallest, pair.primary.everywhere.smallest);
      const double width = std::pow(result.covered_area, 1. / (dim - 1));
      if (width < narrow_zone * smallest)
        result.warnings.push_back(coded(
            ABUT_FAILURE_UNSEEN,
            "The surfaces meet on a width of " + text(width)
                + ", where the smallest facet of one of them is "
                + text(smallest)
                + ": only its nodes feel that, and it sinks in far less than "
                  "it should. Refine this surface there."));
    }
    const std::string bends = turning_facets(pair);
    if (!bends.empty())
      result.warnings.push_back(coded(
          ABUT_FAILURE_COARSE_CURVE,
          "Facets of the " + bends + " turn by more than "
              + text(large_rotation)
              + " degrees at a node in the contact zone: normals and gaps "
                "there are those of a polygon, and so are the pressures. "
                "Refine the surface, or leave the corner out of the pair."));
    const bool may_come_near = pair.has_current_points() && !pair.data.obstacle;
    if (result.n_rows == 0 && (pair.data.may_be_apart || may_come_near))
    {
      checks_.push_back(result);
      return;
    }
    // The width of others is unknown.
    if (result.n_rows == 0 && pair.data.obstacle
        && std::isfinite(pair.data.obstacle->depth()))
      find_narrowest_width(pair, made());
    if (result.n_rows == 0 && pair.data.obstacle
        && pair.narrowest.is_below_facets())
      result.warnings.push_back(coded(
          ABUT_FAILURE_UNSEEN, "no node of the surface is within reach of the "
                               "obstacle: "
                                   + pair.narrowest.text()));
    else if (result.n_rows == 0 && pair.data.obstacle)
    {
      const std::string side = wrong_side(pairs_[number]);
      result.warnings.push_back(coded(
          side.empty() ? ABUT_FAILURE_NO_PARTNER : ABUT_FAILURE_WRONG_SIDE,
          "no node of the surface is within reach of the obstacle"
              + (side.empty()
                     ? ". Give the pair a larger reach if the surface is "
                       "to come to the obstacle."
                     : ": " + side)));
    }
    else if (result.n_rows == 0)
      result.warnings.push_back(explain_no_rows(number));
    // Nodes that supports prescribe have no rows, whatever is near them.
    if (result.n_rows == 0
        && result.warnings.back().failure == ABUT_FAILURE_NO_PARTNER
        && is_prescribed(pair))
      result.warnings.back() =
          coded(ABUT_FAILURE_HELD_NODES,
                "supports prescribe the displacement along the normal of all "
                "nodes of the secondary surface, so that contact cannot move "
                "them. Exchange the two sides, or leave some of the nodes free "
                "along the normal.");
    checks_.push_back(result);
    // Rigid obstacles may come nearer in later steps; the reference
    // configuration of bodies stays as it is.
    if (result.n_rows == 0 && !pair.data.obstacle)
      refuse(pairs_[number], result.warnings.back());
    std::vector<Message> &said = checks_.back().warnings;
    for (const Message &refused : pair.refused)
      if (std::none_of(said.begin(), said.end(),
                       [&](const Message &warning)
                       { return warning.failure == refused.failure; }))
        said.push_back(refused);
  }

  template <int dim>
  std::vector<PairResult<dim>>
  SurfacePairRows<dim>::results(const double *row_pressure,
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
    for_each_component(
        [&](const Component &row)
        {
          const std::size_t i = row.row;
          const bool tied = pairs_[row.place.pair].data.tied;
          PairResult<dim> &result = results[row.place.pair];
          ++result.n_rows;
          const double weight = view_.weight[row.point];
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
            result.initial_gap_work += weight * row_pressure[i] * view_.gap[i];
        });
    const bool is_examined = examined_.size() == surface_.nodes.size();
    for_each_row(
        [&](const Component &row)
        {
          PairResult<dim> &result = results[row.place.pair];
          const Direction total =
              -view_.weight[row.point] * row_pressure[row.row] * row.direction;
          const auto add = [&](dealii::Tensor<1, dim> &force,
                               Tensor<1, 3> &moment, Tensor<1, 3> &now)
          {
            return [&](const Node node, const double c)
            {
              const Direction part = c * total;
              const dealii::Point<dim> &place =
                  pairs_[row.place.pair].is_displaced()
                      ? present_[node]
                      : surface_.nodes[node].point;
              force += part;
              moment += cross(place, part);
              now += cross(is_examined
                               ? surface_.nodes[node].point + examined_[node]
                               : place,
                           part);
            };
          };
          for_each_secondary(row.point, add(result.secondary_force,
                                            result.secondary_moment,
                                            result.present_moment));
          for_each_primary(row.point,
                           add(result.primary_force, result.primary_moment,
                               result.present_primary_moment));
        });
    if (std::any_of(pairs_.begin(), pairs_.end(),
                    [](const Pair &pair)
                    { return pair.data.friction != nullptr; }))
      add_friction(row_pressure, row_gap, row_state, results);
    reduce(results, communicator_);
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

  template <int dim>
  void
  SurfacePairRows<dim>::find_forces(const std::vector<double> &row_pressure,
                                    la::Vector &forces) const
  {
    std::vector<Direction> force(surface_.nodes.size());
    for_each_row(
        [&](const Component &row)
        {
          const double p = view_.weight[row.point] * row_pressure[row.row];
          const auto add = [&](const Node node, const double c)
          { force[node] -= p * c * row.direction; };
          for_each_secondary(row.point, add);
          for_each_primary(row.point, add);
        });
    for (std::size_t n = 0; n < force.size(); ++n)
      for (const auto &parent : surface_.parents[n])
        force[parent.index] += parent.factor * force[n];
    for (std::size_t n = 0; n < force.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        if (surface_.parents[n].empty() && force[n][d] != 0.)
          forces(surface_.nodes[n].dof[d]) += force[n][d];
    forces.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void SurfacePairRows<dim>::make_uniform(std::vector<double> &value) const
  {
    std::vector<double> sum(pairs_.size(), 0.), count(pairs_.size(), 0.);
    for_each_component(
        [&](const Component &i)
        {
          sum[i.place.pair] += std::log(value[i.row]);
          count[i.place.pair] += 1.;
        });
    MPI::sum(sum, communicator_, sum);
    MPI::sum(count, communicator_, count);
    for_each_component(
        [&](const Component &i)
        { value[i.row] = std::exp(sum[i.place.pair] / count[i.place.pair]); });
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void SurfacePairRows<dim>::make_uniform(std::vector<double> &)      \
      const;                                                                   \
  template void SurfacePairRows<dim>::make_check(std::size_t, unsigned int);   \
  template void SurfacePairRows<dim>::find_forces(const std::vector<double> &, \
                                                  la::Vector &) const;         \
  template std::vector<PairResult<dim>> SurfacePairRows<dim>::results(         \
      const double *, const double *, const std::uint8_t *) const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim
