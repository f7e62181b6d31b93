// SPDX-License-Identifier: LGPL-2.1-or-later
// Checks of pairs when their points are made.
#include "pair_inspection.h"

#include "agree.h"
#include "bodies.h"
#include "coordinates.h"
#include "obstacle_in_bodies.h"
#include "obstacle_width.h"
#include "pair_diagnosis.h"
#include "passage_check.h"

#include <abut/dealii/coded.h>
#include <abut/pair_checks.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

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
    constexpr double visible_depth = 0.1;
    /** Surfaces that meet on less of a facet's width are between nodes. */
    constexpr double narrow_zone = 0.5;

    template <typename Number> std::string text(const Number number)
    {
      std::ostringstream out;
      out << number;
      return out.str();
    }

    /** Put an obstacle in a place. */
    template <int dim>
    void put(const abut_context *context, const RigidObstacle<dim> &obstacle,
             const RigidPose<dim> &pose)
    {
      std::vector<dealii::Tensor<1, dim>> rows;
      for (unsigned int d = 0; d < dim; ++d)
        rows.push_back(pose.rotation[d]);
      check(context, obstacle,
            abut_obstacle_set_pose(obstacle.handle(), data_of(rows),
                                   &pose.translation[0]));
    }
  } // namespace

  template <int dim>
  std::string
  PairInspection<dim>::turning_facets(const SurfacePair<dim> &pair) const
  {
    // Only what is near the other side: facets at the nodes of rows.
    std::vector<std::uint8_t> near(surface_.nodes.size(), 0);
    const auto mark = [&](const NodeIndex node, double) { near[node] = 1; };
    for (std::int32_t i = 0; i < points_.view().n_points; ++i)
      if (&pairs_[points_.places().pair[i]] == &pair)
        points_.for_each_node(i, mark);
    const auto turns = [&](const SurfaceSide<dim> &side)
    {
      std::vector<std::uint8_t> marked;
      for (const NodeIndex node : side.node)
        marked.push_back(near[node]);
      bool found = false;
      check(host_.context,
            abut_surface_bends(side.surface.get(),
                               large_rotation * M_PI / 180. - 1e-6,
                               marked.data(), &found));
      return MPI::max(found ? 1 : 0, host_.communicator) != 0;
    };
    const bool secondary = turns(pair.secondary);
    const bool primary = !pair.data.obstacle && turns(pair.primary);
    return secondary && primary ? "two surfaces"
           : secondary          ? "secondary surface"
           : primary            ? "primary surface"
                                : "";
  }

  template <int dim>
  double PairInspection<dim>::first_overlap(const std::size_t number,
                                            const double overlap)
  {
    SurfacePair<dim> &pair = pairs_[number];
    if (!pair.data.obstacle)
      return pair.has_current_directions() ? pair.first_inside.depth : overlap;
    // At rest obstacles are moved into bodies on purpose.
    if (!pair.data.may_be_apart || !pair.data.geometric_gap)
      return 0.;
    // Points that move are later those of a step on its way, and a force has
    // moved the obstacle before the first.
    if (!is_first_)
      return pair.first_inside.depth;
    const RigidPose<dim> now = pair.data.obstacle->pose();
    const RigidPose<dim> first = pair.data.first_pose.value_or(now);
    std::vector<dealii::Point<dim>> nodes;
    points_.for_each_row(
        [&](const PointRow<dim> &row)
        {
          if (row.place.pair != number)
            return;
          const dealii::Point<dim> place =
              row.place.node < 0 ? row.place.position
                                 : surface_.nodes[row.place.node].point;
          nodes.push_back(
              place - ObstaclePoses<dim>::displacement(place, now, first));
        });
    std::vector<double> distance;
    run_everywhere<ContactError>(
        host_.communicator,
        [&] { pair.data.obstacle->distance(nodes, distance); });
    double depth = 0.;
    for (const double value : distance)
      depth = std::max(depth, -value);
    pair.first_inside.depth = MPI::max(depth, host_.communicator);
    return pair.first_inside.depth;
  }

  template <int dim>
  Message PairInspection<dim>::overlap_at_start(SurfacePair<dim> &pair,
                                                const PairCheck &found) const
  {
    const double depth = found.first_overlap;
    const bool is_large = depth > large_overlap * found.facet_size;
    if (pair.data.may_be_apart && !is_large && depth > 0.
        && pair.least_extent == 0.)
      pair.least_extent = std::min(
          least_extent(host_.mapping, host_.dof_handler, pair.data.secondary),
          least_extent(host_.mapping, host_.dof_handler, pair.data.primary));
    const double body = pair.least_extent;
    if (!is_large && (body == 0. || depth <= visible_depth * body))
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
            + (is_obstacle
                   ? "In dynamics the first step removes this penetration and "
                     "adds energy; in equilibrium its force moves the obstacle "
                     "out. Start with the two apart."
                   : "Move the bodies apart, unless interference is meant."),
        {{"overlap", depth}, {"thickness", body}, {"facet", found.facet_size}});
  }

  template <int dim>
  bool PairInspection<dim>::is_prescribed(const std::size_t pair) const
  {
    const std::vector<std::uint8_t> &dropped = points_.dropped(pair);
    const bool any_free =
        std::any_of(dropped.begin(), dropped.end(),
                    [](const auto mark) { return mark != of_supports; });
    return !MPI::logical_or(any_free, host_.communicator);
  }

  template <int dim>
  Message PairInspection<dim>::explain_no_rows(const std::size_t number)
  {
    // Nothing but this message needs facets from so far.
    SurfacePair<dim> &pair = pairs_[number];
    const abut_search_options &search = host_.search.detection.search;
    const double reach =
        std::max({search.reach, pair.data.reach,
                  search.relative_reach * pair.primary.everywhere.largest});
    pair.reach =
        std::max(pair.reach, points_.exchange().distance_bound(number));
    points_.renew(nullptr);
    return why_no_rows(host_.context, pair.secondary, pair.primary,
                       host_.search, reach, host_.communicator);
  }

  template <int dim>
  bool PairInspection<dim>::is_at_start(const std::size_t number) const
  {
    // Motions commit what they begin with.
    const std::vector<double> &times =
        points_.set().obstacles().committed_times();
    return is_first_
           && (times.empty()
               || (pairs_[number].data.first_pose && times[number] == 0.));
  }

  template <int dim>
  std::string PairInspection<dim>::wrong_side(SurfacePair<dim> &pair) const
  {
    const SurfaceSide<dim> &side = pair.secondary;
    std::vector<std::uint8_t> owned;
    for (const NodeIndex node : side.node)
      owned.push_back(points_.set().is_owned(node));
    const RigidObstacle<dim> &obstacle = *pair.data.obstacle;
    const RigidPose<dim> now = obstacle.pose();
    // The first step may be too long.
    const bool moves = pair.data.may_be_apart && pair.data.first_pose;
    if (moves)
      put(host_.context, obstacle, *pair.data.first_pose);
    // Nodes; those where both normals point the same way; of these, those with
    // the obstacle's material behind them, in their body.
    double count[3];
    const auto look = [&](const double depth)
    {
      std::int32_t same = 0, material = 0;
      run_everywhere<ContactError>(
          host_.communicator,
          [&]
          {
            check(host_.context, obstacle,
                  abut_obstacle_faces_away(obstacle.handle(),
                                           side.surface.get(), owned.data(),
                                           depth, &same, &material));
          });
      const double mine[3] = {double(std::count(owned.begin(), owned.end(), 1)),
                              double(same), double(material)};
      MPI::sum(mine, host_.communicator, count);
      return 2. * count[2] > count[0];
    };
    // Thin obstacles are near, others may be anywhere in this half of the body.
    const double half =
        0.5
        * least_extent(host_.mapping, host_.dof_handler, pair.data.secondary);
    const bool is_in_body =
        look(std::min(side.everywhere.median, half)) || look(half);
    if (moves)
      put(host_.context, obstacle, now);
    if (count[1] == 0.)
      return "";
    std::ostringstream text;
    text << "the outward normals of the surface and of the obstacle point in "
            "the same direction at "
         << count[1] << " of " << count[0] << " nodes";
    if (!is_in_body)
      return text.str() + ".";
    text << ", and behind " << count[2]
         << " of them, inside the body, there is the obstacle's material. "
            "Reverse the obstacle (Normal, sign of a distance, Axis or "
            "Hollow), or use the side of the body that faces it. A thin "
            "obstacle may have passed through the surface.";
    points_.set().refuse(pair, coded(ABUT_FAILURE_WRONG_SIDE, text.str()));
    return text.str();
  }

  template <int dim>
  void PairInspection<dim>::add_check(const std::size_t number,
                                      const unsigned int n_dropped)
  {
    SurfacePair<dim> &pair = pairs_[number];
    points_.add_node_areas(pair);
    abut_coupling_statistics statistics;
    check(host_.context,
          abut_coupling_get_statistics(
              abut_interface_coupling(pair.interface.get()), &statistics));
    const SideMeasures &sizes = pair.secondary.everywhere;

    PairCheck result;
    result.name = pair.data.name;
    result.secondary_facets = sizes.n_facets;
    result.primary_facets = pair.primary.everywhere.n_facets;
    result.history_by_place = !points_.set().has_lasting_numbers(pair);
    result.n_dropped = n_dropped;
    result.area = MPI::sum(statistics.full_area, host_.communicator);
    if (result.area == 0.)
      result.area = sizes.area;
    result.facet_size = sizes.median;
    if (!pair.data.obstacle)
      result.size_ratio = sizes.median / pair.primary.everywhere.median;
    double covered = 0., deepest = 0.;
    dealii::types::global_dof_index n_rows = 0;
    points_.for_each_component(
        [&](const PointRow<dim> &row)
        {
          if (row.place.pair != number)
            return;
          ++n_rows;
          covered +=
              points_.view().weight[row.point] / (pair.data.tied ? dim : 1.);
          deepest = std::max(
              deepest, pair.data.tied ? 0. : -points_.view().gap[row.row]);
        });
    result.n_rows = MPI::sum(n_rows, host_.communicator);
    result.covered_area = MPI::sum(covered, host_.communicator);
    result.overlap = MPI::max(deepest, host_.communicator);

    if (result.size_ratio > coarse_secondary)
      result.warnings.push_back(coded(
          ABUT_FAILURE_COARSE_SECONDARY,
          "The secondary surface is " + text(result.size_ratio)
              + " times as coarse as the primary, whose nodes can pass between "
                "its nodes. Exchange the two sides, or refine the secondary.",
          {{"ratio of facets", result.size_ratio}}));
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
        result.warnings.push_back(
            coded(ABUT_FAILURE_UNSEEN,
                  "The surfaces meet on a width of " + text(width)
                      + ", where the smallest facet of one of them is "
                      + text(smallest)
                      + ": the load acts on single nodes, and the indentation "
                        "is far too small. Refine this surface there.",
                  {{"width", width}, {"facet", smallest}}));
    }
    const std::string bends = turning_facets(pair);
    if (!bends.empty())
      result.warnings.push_back(
          coded(ABUT_FAILURE_COARSE_CURVE,
                "Facets of the " + bends + " bend by more than "
                    + text(large_rotation)
                    + " degrees at a node in the contact zone: normals, gaps "
                      "and pressures are those of a polygon. Refine the "
                      "surface, or leave the corner out of the pair.",
                {{"degrees", large_rotation}}));
    const bool may_come_near = pair.has_current_points() && !pair.data.obstacle;
    if (result.n_rows == 0 && (pair.data.may_be_apart || may_come_near))
    {
      if (pair.data.obstacle && is_at_start(number))
        wrong_side(pair);
      result.warnings.insert(result.warnings.end(), pair.refused.begin(),
                             pair.refused.end());
      points_.checks().push_back(result);
      return;
    }
    // The width of others is unknown.
    if (result.n_rows == 0 && pair.data.obstacle
        && std::isfinite(pair.data.obstacle->depth()))
      pair.narrowest = narrowest_width(points_, pair, points_.made());
    if (result.n_rows == 0 && pair.data.obstacle
        && pair.narrowest.is_below_facets())
      result.warnings.push_back(coded(
          ABUT_FAILURE_UNSEEN, "no node of the surface is within reach of the "
                               "obstacle: "
                                   + pair.narrowest.text()));
    else if (result.n_rows == 0 && pair.data.obstacle)
    {
      const std::string side = wrong_side(pair);
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
        && is_prescribed(number))
      result.warnings.back() =
          coded(ABUT_FAILURE_HELD_NODES,
                "the normal displacement of all nodes of the secondary surface "
                "is prescribed, and contact cannot move them. Exchange the two "
                "sides, or leave nodes free along the normal.");
    points_.checks().push_back(result);
    // Rigid obstacles may come nearer in later steps; the reference
    // configuration of bodies stays as it is.
    if (result.n_rows == 0 && !pair.data.obstacle)
      points_.set().refuse(pair, result.warnings.back());
    std::vector<Message> &said = points_.checks().back().warnings;
    for (const Message &refused : pair.refused)
      if (std::none_of(said.begin(), said.end(),
                       [&](const Message &warning)
                       { return warning.failure == refused.failure; }))
        said.push_back(refused);
  }

  template <int dim>
  void PairInspection<dim>::refuse_inside(const std::size_t number,
                                          const la::Vector &displacement) const
  {
    SurfacePair<dim> &pair = pairs_[number];
    if (!pair.data.geometric_gap)
      return;
    const double facet = pair.secondary.everywhere.median;
    const ObstacleInBodies<dim> found = find_obstacle_in_bodies(
        host_.mapping, host_.dof_handler, displacement, pair.data);
    if (!found.is_inside(facet) || found.is_met(facet))
      return;
    std::ostringstream depth;
    depth.precision(3);
    depth << found.elsewhere;
    // How far that place of the obstacle has come in this step.
    const double way = found.place.distance(
        points_.set().obstacles().place_before(number, found.place));
    const ObstacleWidth width = passed_between(points_, number, found.place);
    if (pair.data.may_be_apart && way > 2. * pair.data.obstacle->depth())
      points_.set().refuse(
          pair, too_long_a_step(
                    pair.data, way,
                    "ends inside of it, beyond the surface of the pair, by "
                        + depth.str() + "."));
    else if (width.is_below_facets())
      points_.set().refuse(
          pair, coded(ABUT_FAILURE_UNSEEN,
                      found.between_nodes(depth.str()) + width.text()));
    else
      points_.set().refuse(
          pair, coded(ABUT_FAILURE_WRONG_SIDE, found.text(depth.str())));
  }

  template <int dim>
  void PairInspection<dim>::refuse_overlap(const std::size_t number)
  {
    SurfacePair<dim> &pair = pairs_[number];
    if (!is_first_ || pair.first_inside.depth == 0.)
      return;
    std::ostringstream place;
    place << pair.first_inside.place;
    const Message why = explain_no_rows(number);
    points_.set().refuse(
        pair, why.failure == ABUT_FAILURE_OVERLAP
                  ? why
                  : coded(ABUT_FAILURE_OVERLAP,
                          "the bodies overlap: the node of a surface at ("
                              + place.str()
                              + ") lies inside of the other body, and no "
                                "facet faces another one within reach. "
                                "Move the bodies apart."));
  }

  template <int dim>
  void
  PairInspection<dim>::check_pairs_without_rows(const la::Vector &displacement)
  {
    for (std::size_t p = 0; p < points_.pairs().size(); ++p)
      if (points_.checks()[p].n_rows > 0)
        continue;
      else if (points_.pairs()[p].data.obstacle)
        refuse_inside(p, displacement);
      else
        refuse_overlap(p);
  }

  template <int dim>
  void look_inside(PairSet<dim> &set, const la::Vector &start)
  {
    // A displacement to start with may have taken them apart.
    const double way = 2. * std::sqrt(double(dim)) * start.linfty_norm();
    for (SurfacePair<dim> &pair : set.pairs())
    {
      const ContactPair<dim> &data = pair.data;
      if (data.obstacle || !data.geometric_gap
          || !(pair.has_current_directions() || data.may_be_apart))
        continue;
      pair.first_inside =
          deepest_inside(set.host().mapping, set.host().dof_handler,
                         data.secondary, data.primary);
      if (pair.first_inside.depth <= way)
        pair.first_inside.depth = 0.;
    }
  }

  template class PairInspection<2>;
  template class PairInspection<3>;
  template void look_inside(PairSet<2> &, const la::Vector &);
  template void look_inside(PairSet<3> &, const la::Vector &);
} // namespace abut::shim
