// SPDX-License-Identifier: LGPL-2.1-or-later
// The sides of pairs, from the facets that a rank knows; and when these do not
// reach any further.
#include "agree.h"
#include "fnv_hash.h"
#include "pair_diagnosis.h"
#include "stopwatch.h"
#include "surface_pair_rows.h"

#include <abut/dealii/coded.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  namespace
  {
    /** As run_everywhere(), with the name of the pair before the core's
     * message. */
    template <typename Function>
    void run_for_pair(const MPI_Comm communicator, const std::string &name,
                      const Function &function)
    {
      run_everywhere<ContactError>(communicator,
                                   [&] { run_named(name, function); });
    }
  } // namespace

  template <int dim>
  std::set<global_dof_index> SurfacePairRows<dim>::used_nodes() const
  {
    std::set<global_dof_index> used;
    const auto add = [&](const Node node)
    { used.insert(surface_.nodes[node].dof[0]); };
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      for (auto e = view_.start[i]; e < view_.start[i + 1]; ++e)
        add(view_.node[e]);
      for (const auto *list :
           {&places_[i].opposite, &places_[i].lines, &places_[i].columns})
        std::for_each(list->begin(), list->end(), add);
    }
    return used;
  }

  template <int dim>
  void SurfacePairRows<dim>::gather(const la::Vector *const place)
  {
    origins_.clear();
    partners_place_.reset();
    std::vector<typename SurfaceExchange<dim>::Link> links;
    for (const Pair &pair : pairs_)
      links.push_back({pair.data.name, pair.data.secondary, pair.data.primary,
                       pair.reach, pair.margin, pair.has_displaced_sides()});
    const abut_search_options &search = settings_.search.detection.search;
    surface_ = place == nullptr ? exchange_->gather(context_, links, search)
                                : exchange_->gather_at(*place, used_nodes(),
                                                       context_, links, search);
    gathered_ = exchange_->displacements_as_given(surface_, exchange_->place());
    for (std::size_t i = 0; i < pairs_.size(); ++i)
    {
      pairs_[i].reach = links[i].reach;
      pairs_[i].margin = links[i].margin;
    }
    for (Pair &pair : pairs_)
      create_sides(pair);
  }

  template <int dim>
  void SurfacePairRows<dim>::look_at_sides(const la::Vector &displacement)
  {
    if (exchange_->self_contact().any())
      sides_place_ = displacement;
  }

  template <int dim> void SurfacePairRows<dim>::renew_sides()
  {
    if (!sides_place_.has_value())
      return;
    const la::Vector place = std::move(*sides_place_);
    sides_place_.reset();
    la::Vector way(place);
    if (sides_seen_.size() > 0)
      way -= sides_seen_;
    sides_seen_ = place;
    // Two sides that come as near in this step as in the last one, and again.
    if (exchange_->renew_sides(place, 4. * way.linfty_norm(), context_))
      assign_sides(&place);
  }

  template <int dim>
  void SurfacePairRows<dim>::assign_sides(const la::Vector *const place)
  {
    for (Pair &pair : pairs_)
      if (SelfContact<dim>::is_split(pair.data))
        pair.secondary.everywhere = pair.primary.everywhere = SideMeasures();
    const bool is_displaced = std::any_of(
        pairs_.begin(), pairs_.end(),
        [](const Pair &pair) { return pair.has_displaced_sides(); });
    renew(is_displaced ? place : nullptr);
    ++detection_.gatherings;
  }

  template <int dim> void SurfacePairRows<dim>::load_sides(std::istream &stream)
  {
    sides_place_.reset();
    if (exchange_->load_sides(stream))
      assign_sides(nullptr);
  }

  template <int dim> std::uint64_t SurfacePairRows<dim>::mesh_signature() const
  {
    // Hashes of facets are added: sums do not depend on the order.
    const auto me = MPI::this_mpi_process(communicator_);
    std::uint64_t sum = 0;
    for (const auto &facet : surface_.facets)
    {
      if (facet.owner != me)
        continue;
      FnvHash hash;
      hash.mix(facet.number);
      for (const auto word : facet.cell)
        hash.mix(word);
      hash.mix(facet.face);
      hash.mix(SelfContact<dim>::of_mesh(facet.boundary_id));
      sum += hash.value;
    }
    FnvHash hash;
    hash.mix(MPI::sum(sum, communicator_));
    // Rules that number points on facets; nodes are numbered by the mesh alone.
    std::set<bool> kinds;
    for (const Pair &pair : pairs_)
      if (discretisation_info(pair.discretisation).row_per_point)
        kinds.insert(has_lasting_numbers(pair));
    if (!kinds.empty())
      hash.mix(settings_.method.quadrature_degree);
    for (const bool kind : kinds)
      hash.mix(kind ? 1 : 2);
    return std::max<std::uint64_t>(hash.value, 1);
  }

  template <int dim> void SurfacePairRows<dim>::create_sides(Pair &pair)
  {
    const ContactPair<dim> &data = pair.data;
    pair.coupling.reset();
    // The same whatever a rank knows of other ranks' facets.
    const bool is_measured = pair.secondary.everywhere.n_facets > 0;
    const SideMeasures secondary = pair.secondary.everywhere,
                       primary = pair.primary.everywhere;
    run_for_pair(communicator_, data.name,
                 [&]
                 {
                   pair.secondary = make_side(context_, surface_,
                                              data.secondary, settings_.search);
                   pair.primary = make_side(context_, surface_, data.primary,
                                            settings_.search);
                 });
    if (is_measured)
    {
      pair.secondary.everywhere = secondary;
      pair.primary.everywhere = primary;
    }
    else
    {
      for (auto *side : {&pair.secondary, &pair.primary})
        side->everywhere = measure_everywhere(*side, surface_, communicator_);
      find_thickness(pair);
    }
    run_for_pair(communicator_, data.name,
                 [&]
                 {
                   check_sides(pair);
                   pair.coupling = make_coupling(pair, pair.discretisation);
                 });
  }

  template <int dim>
  double SurfacePairRows<dim>::find_thickness(
      const Pair &pair, const std::set<dealii::types::boundary_id> &ids,
      const SurfaceSide<dim> &side) const
  {
    const double given = given_thickness(settings_.search, ids);
    if (given > 0.)
      return given;
    double found = INFINITY;
    run_for_pair(communicator_, pair.data.name,
                 [&]
                 {
                   found = found_thickness(context_, side, settings_.search,
                                           pair.data.reach);
                 });
    found = MPI::min(found, communicator_);
    return std::isfinite(found) ? found : 0.;
  }

  template <int dim> void SurfacePairRows<dim>::find_thickness(Pair &pair)
  {
    const ContactPair<dim> &data = pair.data;
    if (SelfContact<dim>::is_split(data))
    {
      const double found = exchange_->self_contact().thickness(data);
      pair.thickness =
          found > 0. ? found : given_thickness(settings_.search, data.primary);
      return;
    }
    if (data.tied)
      return;
    pair.own_thickness = find_thickness(pair, data.secondary, pair.secondary);
    pair.thickness = data.obstacle
                         ? pair.own_thickness
                         : find_thickness(pair, data.primary, pair.primary);
  }

  template <int dim>
  void SurfacePairRows<dim>::renew(const la::Vector *const where)
  {
    // Data that refer to nodes and facets do so by their numbers meanwhile.
    const auto number_of = [](const auto &list, const std::int32_t index)
    { return index < 0 ? std::int64_t(-1) : list[index].number; };
    std::vector<std::int64_t> nodes, facets;
    for (const auto &node : surface_.nodes)
      nodes.push_back(node.number);
    for (const Place &place : places_)
      facets.push_back(number_of(surface_.facets, place.facet));
    using Dropped = std::pair<std::int64_t, std::uint8_t>;
    std::vector<std::vector<Dropped>> dropped(pairs_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      for (std::size_t n = 0; n < pairs_[p].dropped.size(); ++n)
        if (pairs_[p].dropped[n] != 0)
          dropped[p].emplace_back(
              number_of(surface_.nodes, pairs_[p].secondary.node[n]),
              pairs_[p].dropped[n]);

    gather(where);
    // Nodes have other numbers; points stay where they were made. Ranks without
    // nodes take part.
    if (points_ != nullptr && (moves() || has_steps()))
      record_place(exchange_->displacements_as_given(surface_, made_place_));

    const auto index_of = [](const auto &list, const std::int64_t number)
    {
      const auto it =
          std::lower_bound(list.begin(), list.end(), number,
                           [](const auto &entry, const std::int64_t n)
                           { return entry.number < n; });
      return number < 0 || it == list.end() || it->number != number
                 ? -1 // not known any more
                 : static_cast<std::int32_t>(it - list.begin());
    };
    std::vector<Node> now;
    for (const std::int64_t number : nodes)
      now.push_back(index_of(surface_.nodes, number));
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      places_[i].node = places_[i].node < 0 ? -1 : now[places_[i].node];
      places_[i].facet = index_of(surface_.facets, facets[i]);
      for (auto *list :
           {&places_[i].opposite, &places_[i].lines, &places_[i].columns})
        for (Node &node : *list)
          node = now[node];
    }
    if (points_ != nullptr)
      check(context_,
            abut_points_renumber(points_, static_cast<std::int32_t>(now.size()),
                                 now.data()));
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      Pair &pair = pairs_[p];
      if (!pair.dropped.empty())
        pair.dropped.assign(pair.secondary.n_nodes(), 0);
      for (const auto &[number, why] : dropped[p])
        if (const int node =
                pair.secondary.local_node(index_of(surface_.nodes, number));
            node >= 0)
          pair.dropped[node] = why;
    }
  }

  template <int dim> bool SurfacePairRows<dim>::is_owned(const Node node) const
  {
    return dof_handler_.locally_owned_dofs().is_element(
        surface_.nodes[node].dof[0]);
  }

  template <int dim>
  double SurfacePairRows<dim>::motion(const Pair &pair,
                                      const std::vector<Direction> &u) const
  {
    // Common translations of both sides do not count; obstacles stand still.
    const double start =
        pair.data.obstacle ? 0. : std::numeric_limits<double>::infinity();
    std::vector<double> range(2 * dim, -start);
    for (const auto *side : {&pair.secondary, &pair.primary})
      for (const Node node : side->node)
        for (unsigned int d = 0; d < dim; ++d)
        {
          range[d] = std::max(range[d], u[node][d]);
          range[dim + d] = std::max(range[dim + d], -u[node][d]);
        }
    MPI::max(range, communicator_, range);
    Direction size;
    for (unsigned int d = 0; d < dim; ++d)
      size[d] = range[d] + range[dim + d];
    const bool is_given = pair.data.tied || pair.data.reach > 0.
                          || pair.data.secondary == pair.data.primary;
    return std::max(size.norm(), is_given ? 0. : foreseen_);
  }

  template <int dim>
  bool SurfacePairRows<dim>::is_in_reach(const Pair &pair,
                                         const Motions &motions) const
  {
    if (pair.data.obstacle)
      return true;
    const abut_search_options &search = settings_.search.detection.search;
    const double smallest = std::min(pair.secondary.everywhere.smallest,
                                     pair.primary.everywhere.smallest);
    return 1.5 * motions.searched <= std::max(
               {pair.reach, search.reach, search.relative_reach * smallest})
           && motions.gathered
                  <= pair.margin
                         + SurfaceExchange<dim>::relative_margin * smallest;
  }

  template <int dim>
  void SurfacePairRows<dim>::check_displacements(
      const std::vector<Direction> &u) const
  {
    Message message;
    for (const Pair &pair : pairs_)
      for (const auto *side : {&pair.secondary, &pair.primary})
        for (const Node node : side->node)
          if (!std::isfinite(u[node].norm_square()) && message.empty())
          {
            std::ostringstream text;
            text << "the displacement of the node at ("
                 << surface_.nodes[node].point
                 << ") is infinite or not a number. Look for loads, supports "
                    "and stiffnesses that are not finite, or off by many "
                    "powers of ten.";
            message = about_pair(pair.data.name,
                                 coded(ABUT_FAILURE_NOT_FINITE, text.str()));
          }
    throw_everywhere<ContactError>(communicator_, message);
  }

  template <int dim> const la::Vector &SurfacePairRows<dim>::last_commit() const
  {
    // Empty unless points move.
    return !moves() && has_steps() && committed_ != nullptr ? *committed_
                                                            : searched_from_;
  }

  template <int dim>
  std::vector<typename SurfacePairRows<dim>::Motions>
  SurfacePairRows<dim>::motions_since_gathering(const std::vector<Direction> &u)
  {
    std::vector<Motions> result(pairs_.size());
    if (pairs_.empty())
      return result;
    // Points are made, and slips measured, there, too.
    const std::vector<Direction> then =
        exchange_->displacements_as_given(surface_, last_commit());
    const std::vector<Direction> since = difference(u, then),
                                 there = difference(then, gathered_),
                                 here = difference(u, gathered_);
    // The reach of the search follows from these.
    const std::vector<double> searched = motions(has_steps() ? since : u);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      const Pair &pair = pairs_[p];
      if (pair.data.obstacle)
        continue;
      if (!pair.has_displaced_sides())
        result[p].searched = result[p].gathered = motion(pair, u);
      else
        result[p] = {std::max(searched[p], motion(pair, since)),
                     std::max(motion(pair, there), motion(pair, here))};
    }
    return result;
  }

  template <int dim>
  void SurfacePairRows<dim>::set_distances(Pair &pair,
                                           const Motions &motions) const
  {
    if (!pair.has_displaced_sides())
    {
      if (is_in_reach(pair, motions))
        return;
      // As far again before it has to be done again.
      pair.reach = std::max(pair.reach, 2. * 1.5 * motions.searched);
      pair.margin = std::max(pair.margin, 2. * motions.gathered);
      return;
    }
    pair.reach = std::max(
        {pair.data.reach, 2. * 1.5 * motions.searched, facet_size(pair)});
    pair.margin = 2. * motions.searched + facet_size(pair);
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  SurfacePairRows<dim>::displacements_in_reach(const la::Vector &displacement)
  {
    const Stopwatch watch(detection_.seconds);
    std::vector<Direction> u = exchange_->displacements(surface_, displacement);
    check_displacements(u);
    const std::vector<Motions> motions = motions_since_gathering(u);
    bool is_far = false, is_displaced = false;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (!is_in_reach(pairs_[p], motions[p]))
      {
        is_far = true;
        is_displaced = is_displaced || pairs_[p].has_displaced_sides();
      }
    if (!is_far)
      return u;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (is_displaced || !pairs_[p].has_displaced_sides())
        set_distances(pairs_[p], motions[p]);
    renew(is_displaced ? &displacement : nullptr);
    ++detection_.gatherings;
    return exchange_->displacements(surface_, displacement);
  }

  template <int dim>
  bool SurfacePairRows<dim>::is_prescribed(const Pair &pair) const
  {
    const bool any_free =
        std::any_of(pair.dropped.begin(), pair.dropped.end(),
                    [](const auto mark) { return mark != of_supports; });
    return !MPI::logical_or(any_free, communicator_);
  }

  template <int dim>
  Message SurfacePairRows<dim>::explain_no_rows(const std::size_t number)
  {
    // Nothing but this message needs facets from so far.
    Pair &pair = pairs_[number];
    const abut_search_options &search = settings_.search.detection.search;
    const double reach =
        std::max({search.reach, pair.data.reach,
                  search.relative_reach * pair.primary.everywhere.largest});
    pair.reach = std::max(pair.reach, exchange_->distance_bound(number));
    renew(nullptr);
    return why_no_rows(context_, pair.secondary, pair.primary, settings_.search,
                       reach, communicator_);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template bool SurfacePairRows<dim>::is_prescribed(const Pair &) const;       \
  template std::set<global_dof_index> SurfacePairRows<dim>::used_nodes()       \
      const;                                                                   \
  template void SurfacePairRows<dim>::gather(const la::Vector *);              \
  template void SurfacePairRows<dim>::look_at_sides(const la::Vector &);       \
  template void SurfacePairRows<dim>::renew_sides();                           \
  template void SurfacePairRows<dim>::load_sides(std::istream &);              \
  template void SurfacePairRows<dim>::find_thickness(Pair &);                  \
  template double SurfacePairRows<dim>::find_thickness(                        \
      const Pair &, const std::set<dealii::types::boundary_id> &,              \
      const SurfaceSide<dim> &) const;                                         \
  template std::uint64_t SurfacePairRows<dim>::mesh_signature() const;         \
  template const la::Vector &SurfacePairRows<dim>::last_commit() const;        \
  template bool SurfacePairRows<dim>::is_owned(Node) const;                    \
  template double SurfacePairRows<dim>::motion(                                \
      const Pair &, const std::vector<Direction> &) const;                     \
  template void SurfacePairRows<dim>::check_displacements(                     \
      const std::vector<Direction> &) const;                                   \
  template std::vector<dealii::Tensor<1, dim>>                                 \
  SurfacePairRows<dim>::displacements_in_reach(const la::Vector &);            \
  template Message SurfacePairRows<dim>::explain_no_rows(std::size_t);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim
