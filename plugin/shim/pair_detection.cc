// SPDX-License-Identifier: LGPL-2.1-or-later
// From pairs of surfaces to points. A node belongs to one pair only that may be
// in the secondary of several: step 3 of the detection
// (plugin/core/contact/detect.c) for pairs between bodies. The nearest partner
// is taken whatever pair it is of, so that nothing depends on the order of the
// pairs but ties by round-off.
#include "pair_detection.h"

#include "agree.h"
#include "pair_diagnosis.h"
#include "pair_friction.h"
#include "stopwatch.h"

#include <abut/coupling_search.h>
#include <abut/pair_checks.h>

#include <algorithm>
#include <unordered_map>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** A node that can move along a normal only this little (1: freely) has no
     * contact of its own. */
    constexpr double least_freedom = 0.5;

    /** Whether a node may belong to the pair or not: obstacles and ties have
     * all theirs. */
    template <int dim> bool is_group(const SurfacePair<dim> &pair)
    {
      return !pair.data.obstacle && !pair.data.tied;
    }
  } // namespace

  template <int dim>
  std::vector<std::uint8_t>
  PairDetection<dim>::dropped_nodes(const SurfacePair<dim> &pair,
                                    const std::vector<std::uint8_t> &taken,
                                    const int component) const
  {
    const SurfaceSide<dim> &side = pair.secondary;
    const double *normal = nullptr;
    check(host_.context, abut_surface_normals(side.surface.get(), &normal));
    std::vector<std::uint8_t> dropped(side.n_nodes(), 0);
    for (int n = 0; n < side.n_nodes(); ++n)
    {
      const NodeIndex node = side.node[n];
      if (!surface_.parents[node].empty())
        continue;
      Direction<dim> direction;
      for (unsigned int d = 0; d < dim; ++d)
        direction[d] = component < 0 ? normal[n * dim + d]
                                     : (d == static_cast<unsigned>(component));
      if (taken[node] != 0)
        dropped[n] = 1;
      else if (direction.norm_square() > 0.
               && points_.set().freedom(node, direction) < least_freedom)
        dropped[n] = of_supports;
    }
    return dropped;
  }

  template <int dim>
  std::vector<std::int64_t>
  PairDetection<dim>::point_numbers(const std::size_t number,
                                    const int shift) const
  {
    // The k-th point at a node, as in a corner between obstacles, or on a facet
    // of several pairs, has a number of its own. All are on the same rank.
    const SurfacePair<dim> &pair = pairs_[number];
    const std::int64_t end_of_nodes = surface_.node_number_end * dim;
    const std::int64_t end_of_facets =
        surface_.n_facets_everywhere * PointNumber::points_per_facet;
    std::unordered_map<std::int32_t, std::set<std::size_t>> before;
    const bool at_points =
        discretisation_info(pair.discretisation).row_per_point;
    for (std::int32_t i = 0; i < points_.view().n_points; ++i)
    {
      const PointPlace<dim> place = points_.place(i);
      if (place.pair != number && (place.node < 0) == at_points)
        before[at_points ? place.facet : place.node].insert(place.pair);
    }
    const auto n_before = [&](const std::int32_t index)
    {
      const auto it = before.find(index);
      return it == before.end() ? 0
                                : static_cast<std::int64_t>(it->second.size());
    };
    std::vector<std::int64_t> id;
    if (at_points)
      for (const std::int32_t facet : pair.secondary.facet)
        id.push_back(PointNumber::first_of_facets
                     + surface_.facets[facet].number
                           * PointNumber::points_per_facet
                     + n_before(facet) * end_of_facets);
    else
      for (const NodeIndex node : pair.secondary.node)
        id.push_back(surface_.nodes[node].number * dim + shift
                     + n_before(node) * end_of_nodes);
    return id;
  }

  template <int dim>
  void PairDetection<dim>::append(const std::size_t number,
                                  const std::vector<std::uint8_t> &dropped,
                                  const double motion,
                                  const std::uint32_t tie_axes, const int shift)
  {
    const SurfacePair<dim> &pair = pairs_[number];
    const std::vector<std::int64_t> id = point_numbers(number, shift);
    abut_interface_target target =
        abut_interface_target_defaults(points_.handle());
    target.id = id.data();
    target.tie_axes = tie_axes;
    target.gap = pair.data.gap;
    target.motion = motion;
    if (pair.is_displaced())
    {
      target.n_nodes = static_cast<std::int32_t>(points_.present().size());
      target.displacement = points_.present_displacement().data();
    }
    build_points(points_.set(), pair, pair.interface.get(), dropped, target);
    points_.update_view();
  }

  template <int dim>
  std::vector<TiedAxes>
  PairDetection<dim>::tie_groups(const SurfacePair<dim> &pair,
                                 const std::vector<std::uint8_t> &taken) const
  {
    // Supports may hold a node in some directions only.
    std::vector<TiedAxes> groups;
    for (unsigned int d = 0; d < dim; ++d)
    {
      TiedAxes group;
      group.dropped = dropped_nodes(pair, taken, d);
      for (auto g = groups.begin(); g != groups.end();)
        if (MPI::logical_or(g->dropped != group.dropped, host_.communicator))
          ++g;
        else
        {
          group.axes = g->axes;
          g = groups.erase(g);
        }
      group.axes |= 1u << d;
      groups.push_back(std::move(group));
    }
    return groups;
  }

  template <int dim>
  void PairDetection<dim>::search(const SurfacePair<dim> &pair,
                                  const double motion) const
  {
    const Stopwatch watch(host_.detection.seconds);
    abut_coupling *const coupling =
        abut_interface_coupling(pair.interface.get());
    const auto statistics = [&]
    {
      abut_search_statistics result;
      check(host_.context, abut_search_get_statistics(
                               abut_coupling_searcher(coupling), &result));
      return result;
    };
    run_everywhere<ContactError>(
        host_.communicator,
        [&]
        {
          run_named(
              pair.data.name,
              [&]
              {
                const abut_search_statistics before = statistics();
                check(host_.context, abut_coupling_search(coupling, motion));
                const abut_search_statistics after = statistics();
                host_.detection.searches +=
                    after.n_searches - before.n_searches;
                host_.detection.reuses += after.n_reuses - before.n_reuses;
                host_.detection.rebuilds += after.n_builds - before.n_builds;
                host_.detection.refits += after.n_refits - before.n_refits;
              });
        });
  }

  template <int dim>
  unsigned int
  PairDetection<dim>::make_points(const std::size_t number, const double motion,
                                  const std::vector<std::uint8_t> &taken,
                                  Displaced &displaced)
  {
    SurfacePair<dim> &pair = pairs_[number];
    unsigned int n_dropped = 0;
    int shift = 0;
    if (pair.has_displaced_sides() && !displaced)
      displaced.emplace(host_, pair, points_.present());
    if (!pair.data.obstacle)
      search(pair, motion);
    auto groups =
        pair.data.tied
            ? tie_groups(pair, taken)
            : std::vector<TiedAxes>{{0, dropped_nodes(pair, taken, -1)}};
    for (TiedAxes &group : groups)
    {
      std::vector<std::uint8_t> &dropped = points_.dropped(number);
      dropped = std::move(group.dropped);
      unsigned int n = 0;
      for (std::size_t i = 0; i < dropped.size(); ++i)
        n += dropped[i] != 0 && points_.set().is_owned(pair.secondary.node[i]);
      n_dropped = std::max(n_dropped, MPI::sum(n, host_.communicator));
      append(number, dropped, motion, group.axes, shift);
      for (unsigned int d = 0; d < dim; ++d)
        shift += group.axes >> d & 1;
    }
    return n_dropped;
  }

  template <int dim>
  void PairDetection<dim>::find_pair(const std::size_t number,
                                     const double motion,
                                     std::vector<std::uint8_t> &taken,
                                     Displaced &displaced)
  {
    const std::int32_t first = points_.view().n_points;
    const unsigned int n_dropped =
        make_points(number, motion, taken, displaced);
    displaced.reset();

    // A node has points of one pair only: two would constrain it twice. Several
    // obstacles may hold one node in a corner.
    if (!pairs_[number].data.obstacle)
      for (std::int32_t i = first; i < points_.view().n_points; ++i)
        if (points_.places().node[i] >= 0)
          taken[points_.places().node[i]] = 1;
    points_.exchange().merge_marks(surface_, taken);
    inspection_.add_check(number, n_dropped);
  }

  template <int dim>
  std::vector<unsigned int> PairDetection<dim>::share_nodes() const
  {
    std::vector<std::size_t> first(surface_.nodes.size(), pairs_.size());
    std::vector<unsigned int> share(pairs_.size(), 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (is_group(pairs_[p]))
        for (const NodeIndex node : pairs_[p].secondary.node)
        {
          if (first[node] < pairs_.size())
            share[p] = share[first[node]] = 1;
          first[node] = p;
        }
    MPI::max(share, host_.communicator, share);
    return share;
  }

  template <int dim>
  std::vector<std::vector<std::uint8_t>>
  PairDetection<dim>::nodes_of_nearer_pairs(const std::vector<double> &moved,
                                            std::vector<Displaced> &displaced)
  {
    const std::size_t n_nodes = surface_.nodes.size();
    std::vector<std::vector<std::uint8_t>> nearer(
        pairs_.size(), std::vector<std::uint8_t>(n_nodes, 0));
    const std::vector<unsigned int> share = share_nodes();
    if (std::find(share.begin(), share.end(), 1u) == share.end())
      return nearer;
    // The points that each of them would have if it were alone.
    const std::vector<std::uint8_t> taken(n_nodes, 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (share[p] != 0)
        make_points(p, moved[p], taken, displaced[p]);
    std::vector<double> made(points_.present_displacement()),
        gap(points_.view().n_components);
    made.resize(dim * n_nodes, 0.);
    check(host_.context,
          abut_points_gap(points_.handle(), static_cast<std::int32_t>(n_nodes),
                          made.data(), gap.data()));
    for (std::int32_t i = 0; i < points_.view().n_points; ++i)
    {
      const SurfacePair<dim> &pair = pairs_[points_.places().pair[i]];
      const std::int32_t row = points_.view().component_start[i];
      // Gaps are those of displacement 0.
      if (!pair.is_displaced())
        gap[row] = points_.view().gap[row];
      gap[row] -= pair.data.gap;
    }
    std::vector<std::int32_t> nearest(n_nodes);
    check(host_.context,
          abut_points_nearest_pair(points_.handle(), gap.data(),
                                   static_cast<std::int32_t>(n_nodes),
                                   nearest.data()));
    std::vector<std::uint8_t> marks(n_nodes * pairs_.size(), 0);
    for (std::size_t n = 0; n < n_nodes; ++n)
      if (nearest[n] >= 0)
        marks[nearest[n] * n_nodes + n] = 1;
    points_.exchange().merge_marks(surface_, marks);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      for (std::size_t q = 0; q < pairs_.size(); ++q)
        for (std::size_t n = 0; n < n_nodes && q != p && share[p] != 0; ++n)
          if (marks[q * n_nodes + n] != 0)
            nearer[p][n] = 1;
    points_.clear();
    return nearer;
  }

  template <int dim>
  void PairDetection<dim>::find(const std::vector<double> &moved)
  {
    std::vector<Displaced> displaced(pairs_.size());
    const std::vector<std::vector<std::uint8_t>> nearer =
        nodes_of_nearer_pairs(moved, displaced);
    // Obstacles hold nodes that bodies touch, too, whichever pair comes first.
    std::vector<std::uint8_t> taken(surface_.nodes.size(), 0), tied(taken);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      std::vector<std::uint8_t> others(pairs_[p].data.obstacle ? tied : taken);
      for (std::size_t n = 0; n < others.size(); ++n)
        others[n] = others[n] != 0 || nearer[p][n] != 0;
      const std::vector<std::uint8_t> before(others);
      find_pair(p, moved[p], others, displaced[p]);
      for (std::size_t n = 0; n < others.size(); ++n)
        if (others[n] != before[n])
        {
          taken[n] = 1;
          tied[n] = tied[n] != 0 || pairs_[p].data.tied;
        }
    }
  }

  template <int dim>
  void drop_needless(const PairPoints<dim> &points,
                     std::vector<std::uint8_t> &keep)
  {
    const abut_points_view &view = points.view();
    for (std::int32_t i = 0; i < view.n_points; ++i)
      if (view.kind[i] == ABUT_POINT_CONTACT)
        for (auto row = view.component_start[i] + 1;
             row < view.component_start[i + 1]; ++row)
          keep[row] = keep[view.component_start[i]];
    drop_covered(points, keep);
  }

  template class PairDetection<2>;
  template class PairDetection<3>;
  template void drop_needless(const PairPoints<2> &,
                              std::vector<std::uint8_t> &);
  template void drop_needless(const PairPoints<3> &,
                              std::vector<std::uint8_t> &);
} // namespace abut::shim
