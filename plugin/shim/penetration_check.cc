// SPDX-License-Identifier: LGPL-2.1-or-later
// The search on the deformed surfaces that finds what no row holds.
#include "pair_examination.h"

#include "agree.h"
#include "coordinates.h"
#include "obstacle_width.h"
#include "pair_interface.h"
#include "passage_check.h"
#include "stopwatch.h"

#include <abut/dealii/rigid_obstacle.h>
#include <abut/missed_contact.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
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
                           found.on_primary, found.same_direction,
                           found.same_side);
      std::vector<Penetration<dim>> result;
      for (const auto &some : MPI::all_gather(communicator, items))
        for (const auto &[pair, point, depth, on_primary, same_direction,
                          same_side] : some)
          result.push_back(
              {pair, point, depth, on_primary, same_direction, same_side});
      return result;
    }

    /** Search for missed contact at one displacement. */
    template <int dim> class MissedCheck
    {
    public:
      using Points = std::vector<dealii::Point<dim>>;

      /** Positions of all nodes at the last commit() and now, and their
       * displacements, which must outlive this object, as the rows must.
       * Collective. */
      MissedCheck(PairPoints<dim> &points, const Points &committed,
                  const Points &present,
                  const std::vector<Direction<dim>> &displacement,
                  const double tolerance)
          : points_(points),
            committed_(committed),
            present_(present),
            displacement_(displacement),
            tolerance_(tolerance),
            held_(points.held_nodes())
      {
      }

      /** Check a pair that has moved so far since its points were made. */
      void check_pair(const std::size_t p, const double moved,
                      const double reach)
      {
        SurfacePair<dim> &pair = points_.pairs()[p];
        pair.measured.between_rows = pair.measured.held_inside = 0.;
        pair.held_in_the_mean = 0.;
        if (pair.data.tied || !pair.data.geometric_gap)
          return;
        held_of_pair_ = held_.data() + p * present_.size();
        if (!pair.data.obstacle)
        {
          check_surfaces(pair, moved, reach);
          return;
        }
        const std::size_t before = missed.size();
        check_obstacle(pair);
        if (missed.size() > before)
          return;
        // Where points do not step, those on straight ways round a corner are
        // no failure: only what comes out on the far side is.
        if (!pair.has_committed_points() && pair.data.may_be_apart)
          check_path_past_obstacle(p, committed_);
        if (!pair.has_committed_points() || points_.present().empty())
          return;
        check_path_past_obstacle(p, points_.present());
        check_changing_obstacle(p);
      }

      std::vector<Penetration<dim>> missed;

    private:
      void add(const SurfacePair<dim> &pair, const dealii::Point<dim> &point,
               const double depth)
      {
        missed.push_back({pair.data.name, point, depth, false, false});
      }

      bool is_held(const NodeIndex node) const
      {
        return held_of_pair_[node] != 0;
      }

      /** Whether a support keeps node @p n of the secondary from having a row.
       */
      bool is_supported(const SurfacePair<dim> &pair, const std::size_t n) const
      {
        const std::vector<std::uint8_t> &dropped =
            points_.dropped(&pair - points_.pairs().data());
        return n < dropped.size() && dropped[n] == of_supports;
      }

      void check_obstacle(SurfacePair<dim> &pair)
      {
        const double *normal = nullptr;
        check(points_.host().context,
              abut_surface_normals(pair.secondary.surface.get(), &normal));
        Points points;
        std::vector<Direction<dim>> outward;
        std::vector<bool> supported;
        for (std::size_t n = 0; n < pair.secondary.node.size(); ++n)
        {
          const NodeIndex node = pair.secondary.node[n];
          const bool support = is_supported(pair, n);
          if (!points_.set().is_owned(node) || (is_held(node) && !support))
            continue;
          points.push_back(present_[node]);
          supported.push_back(support);
          outward.emplace_back();
          for (unsigned int d = 0; d < dim; ++d)
            outward.back()[d] = normal[n * dim + d];
        }
        std::vector<double> distance;
        std::vector<Direction<dim>> gradient;
        pair.data.obstacle->distance(points, distance, &gradient);
        for (std::size_t n = 0; n < points.size(); ++n)
        {
          const double depth = -distance[n] - pair.data.gap;
          if (supported[n])
            pair.measured.held_inside =
                std::max(pair.measured.held_inside, depth);
          else if (depth > tolerance_)
            missed.push_back({pair.data.name, points[n], depth, false,
                              outward[n] * gradient[n] > 0.});
        }
      }

      /** Marks of abut_missed_contact(). */
      std::vector<std::uint8_t> marks_of(const SurfacePair<dim> &pair,
                                         const SurfaceSide<dim> &side) const
      {
        std::vector<std::uint8_t> marks(side.n_nodes(), 0);
        for (std::size_t n = 0; n < marks.size(); ++n)
        {
          if (points_.set().is_owned(side.node[n]))
            marks[n] |= ABUT_NODE_OWNED;
          if (is_held(side.node[n]))
            marks[n] |= ABUT_NODE_HELD;
          if (&side == &pair.secondary && is_supported(pair, n))
            marks[n] |= ABUT_NODE_PRESCRIBED;
        }
        return marks;
      }

      abut_missed_options options_of(const SurfacePair<dim> &pair,
                                     const double reach) const
      {
        abut_missed_options options = abut_missed_defaults();
        options.detection = points_.host().search.detection;
        options.detection.search.reach =
            std::max(options.detection.search.reach, reach);
        options.gap = pair.data.gap;
        options.tolerance = tolerance_;
        options.primary_thickness = pair.thickness;
        options.secondary_thickness = pair.own_thickness;
        const auto kind = discretisation_info(pair.discretisation);
        options.covers_facets = kind.is_weighted || kind.row_per_point;
        if (SelfContact<dim>::is_split(pair.data))
          for (const bool primary : {false, true})
            // Another skin of the body is deeper.
            options.side_thickness[primary] =
                pair.thickness > 0.
                    ? pair.thickness
                    : 2.
                          * (primary ? pair.primary : pair.secondary)
                                .everywhere.largest;
        return options;
      }

      /** Whether it goes farther than what had a row from the start. */
      bool goes_far(const SurfacePair<dim> &pair, const double moved) const
      {
        const abut_search_options &search =
            points_.host().search.detection.search;
        const double smallest = std::min(pair.secondary.everywhere.smallest,
                                         pair.primary.everywhere.smallest);
        return pair.has_committed_points() && !points_.present().empty()
               && moved > std::max({search.reach, pair.data.reach,
                                    search.relative_reach * smallest});
      }

      void check_surfaces(SurfacePair<dim> &pair, const double moved,
                          const double reach)
      {
        const DisplacedSides<dim> sides(points_.host(), pair, present_);
        abut_missed_options options = options_of(pair, reach);
        std::vector<double> start, primary_start;
        if (goes_far(pair, moved))
        {
          start = places_of(pair.secondary.node, points_.present());
          primary_start = places_of(pair.primary.node, points_.present());
          options.secondary_start = start.data();
          options.primary_start = primary_start.data();
        }
        std::vector<abut_missed_node> found(
            2 * (pair.secondary.node.size() + pair.primary.node.size()));
        abut_missed_report report;
        check(points_.host().context,
              abut_missed_contact(points_.host().context,
                                  pair.secondary.surface.get(),
                                  pair.primary.surface.get(),
                                  marks_of(pair, pair.secondary).data(),
                                  marks_of(pair, pair.primary).data(), &options,
                                  found.data(), &report));
        pair.measured.held_inside = report.prescribed;
        pair.measured.between_rows = report.between_points;
        pair.held_in_the_mean = report.held_in_mean;
        for (std::int32_t k = 0; k < report.n; ++k)
        {
          const bool of_primary = found[k].on_primary != 0;
          const auto &side = of_primary ? pair.primary : pair.secondary;
          // On the side itself it is of no other surface.
          const bool same_side = found[k].same_side != 0;
          missed.push_back({pair.data.name, present_[side.node[found[k].node]],
                            found[k].depth, of_primary && !same_side, false,
                            same_side});
        }
      }

      /** From the positions @p begin at the beginning of the step. */
      void check_path_past_obstacle(const std::size_t p, const Points &begin)
      {
        const SurfacePair<dim> &pair = points_.pairs()[p];
        const RigidObstacle<dim> &obstacle = *pair.data.obstacle;
        const RigidPose<dim> now = obstacle.pose();
        const RigidPose<dim> then = points_.set().obstacles().before(true)[p];
        // Where a node was, seen from the obstacle.
        Points from, to;
        for (const NodeIndex node : pair.secondary.node)
        {
          const Direction<dim> own =
              transpose(then.rotation) * (begin[node] - then.translation);
          from.emplace_back(now.rotation * own + now.translation);
          to.push_back(present_[node]);
        }
        const std::vector<double> start = coordinates(from),
                                  end = coordinates(to);
        std::vector<abut_obstacle_path> met(to.size());
        check(points_.host().context, obstacle,
              abut_obstacle_follow(obstacle.handle(),
                                   static_cast<std::int32_t>(to.size()),
                                   start.data(), end.data(), met.data()));
        double way = 0.;
        for (std::size_t n = 0; n < to.size(); ++n)
        {
          const NodeIndex node = pair.secondary.node[n];
          const double depth = met[n].depth - pair.data.gap;
          if (!points_.set().is_owned(node))
            continue;
          if (met[n].through != 0)
            way = std::max(way, (to[n] - from[n]).norm());
          else if (pair.has_committed_points() && !is_held(node)
                   && depth > tolerance_)
            add(pair, to[n], depth);
        }
        // An obstacle smaller than facets passes between nodes.
        constexpr double most = 16.; // in each direction
        const double n_widths =
            pair.secondary.everywhere.largest / obstacle.depth();
        if (n_widths > 1.)
        {
          FacetSamples<dim> samples(points_, pair, displacement_);
          samples.view.n =
              static_cast<std::int32_t>(std::ceil(std::min(n_widths, most)));
          double between = 0.;
          check(points_.host().context, obstacle,
                abut_obstacle_passes_facets(
                    obstacle.handle(), pair.secondary.surface.get(),
                    &samples.view, start.data(), &between));
          way = std::max(way, between);
        }
        // No search finds surfaces that are apart again, and rows belong to the
        // far side.
        if (way > 0.)
          throw ContactError(
              too_long_a_step(pair.data, way,
                              "passes through it: they are apart again at the "
                              "end, without any contact force."));
      }

      /** The check for an obstacle that is a function of time. */
      void check_changing_obstacle(const std::size_t p)
      {
        // A node with a row does not penetrate at the end of the step: between,
        // the rest is that of a step in time, unless it is seen next to a
        // facet.
        constexpr double visible = 0.05;
        const SurfacePair<dim> &pair = points_.pairs()[p];
        const RigidObstacle<dim> &obstacle = *pair.data.obstacle;
        const std::vector<double> &times =
            points_.set().obstacles().committed_times();
        if (obstacle.view().kind != ABUT_OBSTACLE_FUNCTION || p >= times.size()
            || times[p] == obstacle.time())
          return;
        Points from, to;
        std::vector<double> bearable;
        for (const NodeIndex node : pair.secondary.node)
          if (points_.set().is_owned(node))
          {
            from.push_back(points_.present()[node]);
            to.push_back(present_[node]);
            bearable.push_back(is_held(node)
                                   ? visible * pair.secondary.everywhere.median
                                   : tolerance_);
          }
        const std::vector<double> depth =
            deepest_between(pair.data.obstacle, times[p],
                            points_.set().obstacles().committed()[p], from, to);
        for (std::size_t i = 0; i < to.size(); ++i)
          if (depth[i] - pair.data.gap > bearable[i])
            add(pair, to[i], depth[i] - pair.data.gap);
      }

      PairPoints<dim> &points_;
      const Points &committed_, &present_;
      const std::vector<Direction<dim>> &displacement_;
      const double tolerance_;
      const std::vector<std::uint8_t> held_; ///< [pairs][nodes]
      const std::uint8_t *held_of_pair_ = nullptr;
    };
  } // namespace

  template <int dim>
  std::vector<Penetration<dim>> penetrations(PairPoints<dim> &points,
                                             const la::Vector &displacement,
                                             const double tolerance)
  {
    const std::vector<Direction<dim>> u =
        points.displacements_in_reach(displacement);
    const Stopwatch watch(points.host().detection.seconds);
    std::vector<dealii::Point<dim>> committed, present;
    for (std::size_t n = 0; n < u.size(); ++n)
    {
      committed.push_back(points.surface().nodes[n].point);
      present.push_back(committed[n] + u[n]);
    }
    PairSet<dim> &set = points.set();
    if (set.moves() && set.searched_from().size() > 0)
    {
      const std::vector<Direction<dim>> then =
          set.displacements_as_given(set.searched_from());
      for (std::size_t n = 0; n < present.size(); ++n)
        committed[n] += then[n];
    }
    const std::vector<double> moved =
        set.motions(set.has_steps() ? points.displacement_since(u) : u);

    MissedCheck<dim> missed(points, committed, present, u, tolerance);
    Message message;
    for (std::size_t p = 0; p < points.pairs().size() && message.empty(); ++p)
      try
      {
        // A node that was missed earlier may be deeper than the last step went.
        const SurfacePair<dim> &pair = points.pairs()[p];
        const double all = pair.has_current_points()
                               ? std::min(1.5 * set.motion(pair, u), pair.reach)
                               : 0.;
        missed.check_pair(p, moved[p],
                          std::max({pair.data.reach, 1.5 * moved[p], all}));
      }
      catch (const std::exception &error)
      {
        message = about_pair(points.pairs()[p].data.name, message_of(error));
      }
    throw_everywhere<ContactError>(points.host().communicator, message);
    for (SurfacePair<dim> &pair : points.pairs())
      pair.held_in_the_mean =
          MPI::max(pair.held_in_the_mean, points.host().communicator);
    const auto result = everywhere(missed.missed, points.host().communicator);
    // The next find() splits a surface again where one of its sides has met
    // itself.
    if (std::any_of(result.begin(), result.end(),
                    [](const Penetration<dim> &node)
                    { return node.same_side; }))
      set.look_at_sides(displacement);
    return result;
  }

  template std::vector<Penetration<2>> penetrations(PairPoints<2> &,
                                                    const la::Vector &, double);
  template std::vector<Penetration<3>> penetrations(PairPoints<3> &,
                                                    const la::Vector &, double);
} // namespace abut::shim
