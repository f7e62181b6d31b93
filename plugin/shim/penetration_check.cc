// SPDX-License-Identifier: LGPL-2.1-or-later
// The search on the deformed surfaces that finds what no row holds.
#include "surface_pair_rows.h"

#include "agree.h"
#include "passage_check.h"
#include "stopwatch.h"

#include <abut/dealii/rigid_obstacle.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** A node inside the other surface. */
    struct Inside
    {
      int node, facet; ///< of the two sides
      double depth;
    };

    /** Nodes of @p nodes deeper than @p tolerance in @p facets, but not than
     * half of the @p thickness (0: not known) of the body of these, which would
     * be its other skin. Only reads. */
    template <int dim>
    std::vector<Inside>
    penetrating_nodes(abut_context *context, const SurfaceSide<dim> &nodes,
                      const SurfaceSide<dim> &facets,
                      const SearchParameters &search, const double reach,
                      const double tolerance, const double thickness)
    {
      abut_detection_options options = search.detection;
      options.search.reach = std::max(options.search.reach, reach);
      options.extension = 0.;
      const auto detection = create_detection(context, nodes.surface.get(),
                                              facets.surface.get(), options);
      check(context, abut_detection_run(detection.get(), 0.));
      abut_detection_view view;
      check(context, abut_detection_get(detection.get(), &view));
      std::vector<Inside> found;
      for (std::int32_t n = 0; n < view.n_nodes; ++n)
        if (view.contact[n].facet >= 0 && view.contact[n].gap < -tolerance
            && !(thickness > 0. && view.contact[n].gap < -0.5 * thickness))
          found.push_back({n, view.contact[n].facet, -view.contact[n].gap});
      return found;
    }

    /** The lists of all ranks. Collective. */
    template <int dim>
    std::vector<Penetration<dim>>
    everywhere(const std::vector<Penetration<dim>> &mine,
               const MPI_Comm communicator)
    {
      using Item =
          std::tuple<std::string, dealii::Point<dim>, double, bool, bool, bool>;
      std::vector<Item> items;
      for (const auto &found : mine)
        items.emplace_back(found.pair, found.point, found.depth,
                           found.on_primary, found.same_way, found.same_side);
      std::vector<Penetration<dim>> result;
      for (const auto &some : MPI::all_gather(communicator, items))
        for (const auto &[pair, point, depth, on_primary, same_way, same_side] :
             some)
          result.push_back(
              {pair, point, depth, on_primary, same_way, same_side});
      return result;
    }

    /** Weights of the corners of a facet at points inside, as far apart as the
     * facet by @p n, and no more than 16 in each direction; none if n <= 1. */
    template <int dim>
    std::vector<std::vector<double>>
    samples_of_facet(const unsigned int nodes_per_facet, const double n)
    {
      constexpr double most = 16.;
      std::vector<std::vector<double>> result;
      if (!(n > 1.))
        return result;
      const double step = 1. / std::ceil(std::min(n, most));
      const bool is_triangle =
          dim == 3 && (nodes_per_facet == 3 || nodes_per_facet == 6);
      for (double x = 0.5 * step; x < 1.; x += step)
        for (double y = 0.5 * step; y < (dim == 2 ? step : 1.); y += step)
          if (dim == 2)
            result.push_back({1. - x, x});
          else if (!is_triangle)
            result.push_back(
                {(1. - x) * (1. - y), x * (1. - y), (1. - x) * y, x * y});
          else if (x + y < 1.)
            result.push_back({1. - x - y, x, y});
      return result;
    }

    /** Whether a support keeps node @p n of the secondary of @p pair from
     * having a row. */
    template <typename Pair>
    bool is_supported(const Pair &pair, const std::size_t n)
    {
      return n < pair.dropped.size() && pair.dropped[n] == of_supports;
    }
  } // namespace

  template <int dim>
  std::vector<std::uint8_t> SurfacePairRows<dim>::held_nodes()
  {
    const std::size_t n_nodes = surface_.nodes.size();
    std::vector<std::uint8_t> held(n_nodes * pairs_.size(), 0);
    for (std::size_t i = 0; i < places_.size(); ++i)
      for_each_secondary(i, [&](const Node node, double)
                         { held[places_[i].pair * n_nodes + node] = 1; });
    // Owners of nodes know all facets around them.
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      for (std::size_t n = 0; n < pairs_[p].dropped.size(); ++n)
      {
        const Node node = pairs_[p].secondary.node[n];
        if (pairs_[p].dropped[n] != 0 && is_owned(node))
          held[p * n_nodes + node] = 1;
      }
    exchange_->merge_marks(surface_, held);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      std::uint8_t *marks = held.data() + p * n_nodes;
      for (const Node node : pairs_[p].secondary.node)
      {
        bool parents = !surface_.parents[node].empty();
        for (const auto &parent : surface_.parents[node])
          parents = parents && marks[parent.index] != 0;
        if (parents)
          marks[node] = 1;
      }
    }
    return held;
  }

  template <int dim>
  void SurfacePairRows<dim>::check_obstacle(
      Pair &pair, const std::uint8_t *held,
      const std::vector<dealii::Point<dim>> &present, const double tolerance,
      std::vector<Penetration<dim>> &missed) const
  {
    const double *normal = nullptr;
    check(context_,
          abut_surface_normals(pair.secondary.surface.get(), &normal));
    std::vector<dealii::Point<dim>> points;
    std::vector<Direction> outward;
    std::vector<bool> supported;
    for (std::size_t n = 0; n < pair.secondary.node.size(); ++n)
    {
      const Node node = pair.secondary.node[n];
      const bool support = is_supported(pair, n);
      if (!is_owned(node) || (held[node] != 0 && !support))
        continue;
      points.push_back(present[node]);
      supported.push_back(support);
      outward.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        outward.back()[d] = normal[n * dim + d];
    }
    std::vector<double> distance;
    std::vector<Direction> gradient;
    pair.data.obstacle->distance(points, distance, &gradient);
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      const double depth = -distance[n] - pair.data.gap;
      if (supported[n])
        pair.measured.held_inside = std::max(pair.measured.held_inside, depth);
      else if (depth > tolerance)
        missed.push_back({pair.data.name, points[n], depth, false,
                          outward[n] * gradient[n] > 0.});
    }
  }

  template <int dim>
  void SurfacePairRows<dim>::check_surfaces(
      Pair &pair, const std::uint8_t *held,
      const std::vector<dealii::Point<dim>> &present, const double reach,
      const double tolerance, std::vector<Penetration<dim>> &missed)
  {
    const double depth = tolerance + pair.data.gap;
    for (const Inside &inside :
         penetrating_nodes(context_, pair.secondary, pair.primary,
                           settings_.search, reach, depth, pair.thickness))
    {
      const Node node = pair.secondary.node[inside.node];
      const double found = inside.depth - pair.data.gap;
      if (is_supported(pair, inside.node) && is_owned(node))
        pair.measured.held_inside = std::max(pair.measured.held_inside, found);
      else if (held[node] == 0 && is_owned(node))
        missed.push_back({pair.data.name, present[node], found, false, false});
      else if (is_owned(node))
        pair.held_in_the_mean = std::max(pair.held_in_the_mean, found);
    }
    for (const Inside &inside : penetrating_nodes(
             context_, pair.primary, pair.secondary, settings_.search, reach,
             pair.data.gap, pair.own_thickness))
    {
      const Node node = pair.primary.node[inside.node];
      if (!is_owned(node))
        continue;
      // Inside the secondary between its rows, or where it has none.
      const auto &facet = surface_.facets[pair.secondary.facet[inside.facet]];
      const auto kind = discretisation_info(pair.discretisation);
      bool between = !kind.is_weighted && !kind.row_per_point;
      for (unsigned int a = 0; a < surface_.nodes_per_facet(); ++a)
        between = between || held[facet.node[a]] != 0;
      const double found = inside.depth - pair.data.gap;
      if (between)
        pair.measured.between_rows =
            std::max(pair.measured.between_rows, found);
      else if (found > tolerance)
        missed.push_back({pair.data.name, present[node], found, true, false});
    }
  }

  template <int dim>
  void SurfacePairRows<dim>::check_same_sides(
      Pair &pair, const std::vector<dealii::Point<dim>> &present,
      const double reach, const double tolerance,
      std::vector<Penetration<dim>> &missed)
  {
    // An interference is between flanks that are opposite to each other.
    const double allowed = std::max(0., pair.data.gap);
    for (const SurfaceSide<dim> *side : {&pair.secondary, &pair.primary})
    {
      // Another skin of the body is deeper.
      const double thickness =
          pair.thickness > 0. ? pair.thickness : 2. * side->everywhere.largest;
      for (const Inside &inside :
           penetrating_nodes(context_, *side, *side, settings_.search, reach,
                             tolerance + allowed, thickness))
        if (is_owned(side->node[inside.node]))
          missed.push_back({pair.data.name, present[side->node[inside.node]],
                            inside.depth - allowed, false, false, true});
    }
  }

  template <int dim>
  void SurfacePairRows<dim>::check_passage_of_obstacle(
      const std::size_t p, const std::uint8_t *held,
      const std::vector<dealii::Point<dim>> &begin,
      const std::vector<dealii::Point<dim>> &present, const double tolerance,
      std::vector<Penetration<dim>> &missed) const
  {
    const Pair &pair = pairs_[p];
    const RigidObstacle<dim> &obstacle = *pair.data.obstacle;
    const RigidPose<dim> now = obstacle.pose();
    const RigidPose<dim> then = poses_before(poses(), true)[p];
    std::vector<dealii::Point<dim>> from, to;
    std::vector<bool> is_free;
    const auto add = [&](const dealii::Point<dim> &start,
                         const dealii::Point<dim> &end, const bool free)
    {
      // Where it was, seen from the obstacle.
      const Direction own =
          transpose(then.rotation) * (start - then.translation);
      from.emplace_back(now.rotation * own + now.translation);
      to.push_back(end);
      is_free.push_back(free);
    };
    for (const Node node : pair.secondary.node)
      if (is_owned(node))
        add(begin[node], present[node], held[node] == 0);
    // An obstacle smaller than facets passes between nodes.
    const auto me = MPI::this_mpi_process(communicator_);
    for (const std::int32_t f : pair.secondary.facet)
      if (surface_.facets[f].owner == me)
        for (const std::vector<double> &weight : samples_of_facet<dim>(
                 surface_.nodes_per_facet(),
                 pair.secondary.everywhere.largest / obstacle.depth()))
        {
          dealii::Point<dim> start, end;
          for (std::size_t a = 0; a < weight.size(); ++a)
          {
            const Node node = surface_.facets[f].node[a];
            start += weight[a] * begin[node];
            end += weight[a] * present[node];
          }
          add(start, end, false);
        }
    std::vector<double> end;
    obstacle.distance(to, end);
    const std::vector<OnTheWay> met = on_the_way(obstacle, from, to, end);
    double way = 0.;
    for (std::size_t i = 0; i < to.size(); ++i)
    {
      const double depth = met[i].depth - pair.data.gap;
      if (met[i].through)
        way = std::max(way, (to[i] - from[i]).norm());
      else if (pair.has_committed_points() && is_free[i] && depth > tolerance)
        missed.push_back({pair.data.name, to[i], depth, false, false});
    }
    // No search finds surfaces that are apart again, and rows belong to the far
    // side.
    if (way > 0.)
      throw ContactError(too_long_a_step(
          pair.data, way,
          "passes through it: they are apart again at the end, and nothing "
          "resists."));
  }

  template <int dim>
  void SurfacePairRows<dim>::check_passage_of_formula(
      const std::size_t p, const std::uint8_t *held,
      const std::vector<dealii::Point<dim>> &present, const double tolerance,
      std::vector<Penetration<dim>> &missed) const
  {
    // A node with a row does not penetrate at the end of the step: between, the
    // rest is that of a step in time, unless it is seen next to a facet.
    constexpr double visible = 0.05;
    const Pair &pair = pairs_[p];
    const RigidObstacle<dim> &obstacle = *pair.data.obstacle;
    if (obstacle.view().kind != ABUT_OBSTACLE_FUNCTION
        || p >= committed_times_.size()
        || committed_times_[p] == obstacle.time())
      return;
    std::vector<dealii::Point<dim>> from, to;
    std::vector<double> bearable;
    for (const Node node : pair.secondary.node)
      if (is_owned(node))
      {
        from.push_back(present_[node]);
        to.push_back(present[node]);
        bearable.push_back(held[node] == 0
                               ? tolerance
                               : visible * pair.secondary.everywhere.median);
      }
    const std::vector<double> depth = deepest_between(
        pair.data.obstacle, committed_times_[p], committed_poses_[p], from, to);
    for (std::size_t i = 0; i < to.size(); ++i)
      if (depth[i] - pair.data.gap > bearable[i])
        missed.push_back(
            {pair.data.name, to[i], depth[i] - pair.data.gap, false, false});
  }

  template <int dim>
  void SurfacePairRows<dim>::check_passage(
      const std::size_t p, const std::uint8_t *held,
      const std::vector<dealii::Point<dim>> &committed,
      const std::vector<dealii::Point<dim>> &present, const double motion,
      const double tolerance, std::vector<Penetration<dim>> &missed) const
  {
    const Pair &pair = pairs_[p];
    // Where points do not step, those on straight ways round a corner are no
    // failure: only what comes out on the far side is.
    if (!pair.has_committed_points() && pair.data.may_be_apart
        && pair.data.obstacle)
      check_passage_of_obstacle(p, held, committed, present, tolerance, missed);
    if (!pair.has_committed_points() || present_.empty())
      return;
    if (pair.data.obstacle)
    {
      check_passage_of_obstacle(p, held, present_, present, tolerance, missed);
      check_passage_of_formula(p, held, present, tolerance, missed);
      return;
    }
    // A node that moves no farther than this had a row from the start.
    const abut_search_options &search = settings_.search.detection.search;
    const double smallest = std::min(pair.secondary.everywhere.smallest,
                                     pair.primary.everywhere.smallest);
    if (motion <= std::max(
            {search.reach, pair.data.reach, search.relative_reach * smallest}))
      return;
    std::vector<Direction> way(present.size());
    for (std::size_t n = 0; n < way.size(); ++n)
      way[n] = present[n] - present_[n];
    const double depth = tolerance + pair.data.gap;
    for (const Passage &found :
         passing_nodes(context_, surface_, pair.secondary, pair.primary,
                       present_, way, depth))
    {
      const Node node = pair.secondary.node[found.node];
      if (is_owned(node) && held[node] == 0)
        missed.push_back({pair.data.name, present[node],
                          found.depth - pair.data.gap, false, false});
    }
    for (const Passage &found :
         passing_nodes(context_, surface_, pair.primary, pair.secondary,
                       present_, way, depth))
    {
      const Node node = pair.primary.node[found.node];
      const auto &facet = surface_.facets[pair.secondary.facet[found.facet]];
      bool between = false;
      for (unsigned int a = 0; a < surface_.nodes_per_facet(); ++a)
        between = between || held[facet.node[a]] != 0;
      if (is_owned(node) && !between)
        missed.push_back({pair.data.name, present[node],
                          found.depth - pair.data.gap, true, false});
    }
  }

  template <int dim>
  std::vector<Penetration<dim>>
  SurfacePairRows<dim>::penetrations(const la::Vector &displacement,
                                     const double tolerance)
  {
    const std::vector<Direction> u = displacements_in_reach(displacement);
    const Stopwatch watch(detection_.seconds);
    std::vector<dealii::Point<dim>> reference(surface_.nodes.size()),
        present(surface_.nodes.size());
    for (std::size_t n = 0; n < present.size(); ++n)
    {
      reference[n] = surface_.nodes[n].point;
      present[n] = reference[n] + u[n];
    }
    std::vector<dealii::Point<dim>> committed(reference);
    if (moves() && searched_from_.size() > 0)
    {
      const std::vector<Direction> then =
          exchange_->displacements_as_given(surface_, searched_from_);
      for (std::size_t n = 0; n < present.size(); ++n)
        committed[n] += then[n];
    }
    const std::vector<std::uint8_t> held = held_nodes();
    const std::vector<double> moved = motions(has_steps() ? way_since(u) : u);

    std::vector<Penetration<dim>> missed;
    Message message;
    for (std::size_t p = 0; p < pairs_.size() && message.empty(); ++p)
      try
      {
        Pair &pair = pairs_[p];
        pair.measured.between_rows = pair.measured.held_inside = 0.;
        pair.held_in_the_mean = 0.;
        if (pair.data.tied || !pair.data.geometric_gap)
          continue;
        const std::uint8_t *marks = held.data() + p * surface_.nodes.size();
        const std::size_t before = missed.size();
        if (pair.data.obstacle)
        {
          check_obstacle(pair, marks, present, tolerance, missed);
          if (missed.size() == before)
            check_passage(p, marks, committed, present, moved[p], tolerance,
                          missed);
          continue;
        }
        const DisplacedSides<dim> sides(context_, pair.secondary, pair.primary,
                                        reference, present);
        // A node that was missed earlier may be deeper than the last step went.
        const double all = std::min(1.5 * motion(pair, u), pair.reach);
        const double reach = std::max({pair.data.reach, 1.5 * moved[p],
                                       pair.has_current_points() ? all : 0.});
        check_surfaces(pair, marks, present, reach, tolerance, missed);
        if (SelfContact<dim>::is_split(pair.data))
          check_same_sides(pair, present, reach, tolerance, missed);
        if (missed.size() == before)
          check_passage(p, marks, committed, present, moved[p], tolerance,
                        missed);
      }
      catch (const std::exception &error)
      {
        message = about_pair(pairs_[p].data.name, message_of(error));
      }
    throw_everywhere<ContactError>(communicator_, message);
    for (Pair &pair : pairs_)
      pair.held_in_the_mean = MPI::max(pair.held_in_the_mean, communicator_);
    missed = everywhere(missed, communicator_);
    // The next find() splits a surface again where one of its sides has met
    // itself.
    if (std::any_of(missed.begin(), missed.end(),
                    [](const Penetration<dim> &node)
                    { return node.same_side; }))
      look_at_sides(displacement);
    return missed;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<std::uint8_t> SurfacePairRows<dim>::held_nodes();       \
  template void SurfacePairRows<dim>::check_obstacle(                          \
      Pair &, const std::uint8_t *, const std::vector<dealii::Point<dim>> &,   \
      double, std::vector<Penetration<dim>> &) const;                          \
  template void SurfacePairRows<dim>::check_surfaces(                          \
      Pair &, const std::uint8_t *, const std::vector<dealii::Point<dim>> &,   \
      double, double, std::vector<Penetration<dim>> &);                        \
  template void SurfacePairRows<dim>::check_same_sides(                        \
      Pair &, const std::vector<dealii::Point<dim>> &, double, double,         \
      std::vector<Penetration<dim>> &);                                        \
  template void SurfacePairRows<dim>::check_passage_of_obstacle(               \
      std::size_t, const std::uint8_t *,                                       \
      const std::vector<dealii::Point<dim>> &,                                 \
      const std::vector<dealii::Point<dim>> &, double,                         \
      std::vector<Penetration<dim>> &) const;                                  \
  template void SurfacePairRows<dim>::check_passage_of_formula(                \
      std::size_t, const std::uint8_t *,                                       \
      const std::vector<dealii::Point<dim>> &, double,                         \
      std::vector<Penetration<dim>> &) const;                                  \
  template void SurfacePairRows<dim>::check_passage(                           \
      std::size_t, const std::uint8_t *,                                       \
      const std::vector<dealii::Point<dim>> &,                                 \
      const std::vector<dealii::Point<dim>> &, double, double,                 \
      std::vector<Penetration<dim>> &) const;                                  \
  template std::vector<Penetration<dim>> SurfacePairRows<dim>::penetrations(   \
      const la::Vector &, double);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim
