// SPDX-License-Identifier: LGPL-2.1-or-later
// From pairs of surfaces to points.
#include "surface_pair_rows.h"

#include "agree.h"
#include "fnv_hash.h"
#include "host_cells.h"
#include "pair_diagnosis.h"
#include "stopwatch.h"

#include <abut/coupling_search.h>
#include <abut/dealii/coded.h>
#include <abut/dealii/rigid_obstacle.h>
#include <abut/dealii/versions.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  namespace
  {
    /** A node that can move along a normal only this little (1: freely) has no
     * contact of its own. */
    constexpr double least_freedom = 0.5;

    /** Lists of candidates where bodies are are too long by this part of a
     * facet, unless the parameters have a length: the longer they are, the
     * longer they serve. */
    constexpr double skin_of_displaced = 1.;

    /** Discretisation of a pair, if the parameters leave it open. */
    abut_discretisation
    automatic_discretisation(const abut_law &law,
                             const abut_kinematics_info &kinematics,
                             const bool at_nodes, const abut_facet_kind kind)
    {
      if (abut_law_needs_stress(&law))
        return ABUT_DISCRETISATION_QUADRATURE_POINT;
      // The corners of quadratic triangles have no weight.
      if (kind == ABUT_FACET_TRI6)
        return at_nodes && !kinematics.weighted_obstacle
                       && !abut_law_is_exact(&law)
                       && !abut_law_is_primal_dual(&law)
                   ? ABUT_DISCRETISATION_QUADRATURE_POINT
                   : ABUT_DISCRETISATION_MORTAR;
      return at_nodes ? ABUT_DISCRETISATION_NODE_TO_SEGMENT
                      : ABUT_DISCRETISATION_DUAL_MORTAR;
    }

    template <int dim>
    std::set<dealii::types::boundary_id>
    all_ids(const std::vector<ContactPair<dim>> &pairs)
    {
      std::set<dealii::types::boundary_id> ids;
      for (const auto &pair : pairs)
      {
        ids.insert(pair.secondary.begin(), pair.secondary.end());
        ids.insert(pair.primary.begin(), pair.primary.end());
      }
      return ids;
    }

    bool have_common(const std::set<dealii::types::boundary_id> &a,
                     const std::set<dealii::types::boundary_id> &b)
    {
      return std::any_of(a.begin(), a.end(),
                         [&](const auto id) { return b.count(id) > 0; });
    }

    /** Whether two pairs have facets of both sides in common. */
    template <int dim>
    bool are_the_same(const ContactPair<dim> &a, const ContactPair<dim> &b)
    {
      return have_common(a.secondary, b.secondary)
             && (have_common(a.primary, b.primary)
                 || (a.obstacle != nullptr && a.obstacle == b.obstacle));
    }

    /** Whether two pairs are one with its sides exchanged. */
    template <int dim>
    bool are_both_sides(const ContactPair<dim> &a, const ContactPair<dim> &b)
    {
      return have_common(a.secondary, b.primary)
             && have_common(a.primary, b.secondary);
    }
  } // namespace

  template <int dim>
  SurfacePairRows<dim>::SurfacePairRows(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler,
      const dealii::AffineConstraints<double> &constraints,
      const std::vector<ContactPair<dim>> &given, const Settings &settings,
      abut_context *context, std::shared_ptr<SurfaceExchange<dim>> exchange,
      DetectionReport &detection)
      : mapping_(mapping),
        dof_handler_(dof_handler),
        constraints_(constraints),
        communicator_(versions::communicator(dof_handler)),
        settings_(settings),
        context_(context),
        exchange_(std::move(exchange)),
        detection_(detection)
  {
    const Message reason = displacement_refusal(dof_handler.get_fe());
    if (!reason.empty())
      throw ContactError(reason);
    const auto pairs = SelfContact<dim>::with_sides(given);
    const auto ids = all_ids(pairs);
    if (exchange_ != nullptr && exchange_->boundary_ids() == ids)
      exchange_->refresh();
    else
      exchange_ = std::make_shared<SurfaceExchange<dim>>(
          mapping, dof_handler, constraints, ids,
          SelfContact<dim>(mapping, dof_handler, given, settings.search,
                           context));
    for (const auto &pair : pairs)
      create_pair(pair);
    gather(nullptr);
  }

  template <int dim>
  void SurfacePairRows<dim>::create_pair(const ContactPair<dim> &data)
  {
    Pair pair;
    pair.data = data;
    const abut_law &law = *settings_.method.options.law;
    const abut_kinematics kinematics =
        settings_.method.kinematics.value_or(ABUT_KINEMATICS_REFERENCE);
    if (!data.tied)
      pair.set_kinematics(kinematics);
    pair.discretisation = settings_.method.discretisation.value_or(
        automatic_discretisation(law, kinematics_info(kinematics),
                                 data.obstacle != nullptr, exchange_->kind()));
    const Message reason =
        refusal(law, pair.discretisation, settings_.method.system, data.tied);
    if (!reason.empty())
      refuse(pair, reason);
    std::string no_friction =
        data.friction == nullptr
            ? ""
            : friction_refusal(law, pair.discretisation, settings_.method,
                               data.tied, data.obstacle != nullptr);
    // Where its two sides meet, a node would be held by its own side, too.
    if (data.friction != nullptr && SelfContact<dim>::is_split(data)
        && !abut_law_has_penalty(&law))
      no_friction = "a surface that touches itself has friction with penalty, "
                    "quadratic penalty and augmented lagrangian only, not with "
                    "Method/Enforcement = "
                    + std::string(law.name)
                    + ". Use one of these, or give its two sides boundary ids "
                      "of their own.";
    if (!no_friction.empty())
      throw ContactError(
          about_pair(data.name, no_friction, PairField::friction));
    for (const Pair &other : pairs_)
      if (are_the_same(data, other.data))
        refuse(pair, "some of its surface touches what it touches in pair '"
                         + other.data.name
                         + "', too, and would be held there twice. Leave one "
                           "of the pairs out, or name each boundary id in one "
                           "of them only.");
      else if (are_both_sides(data, other.data)
               && (data.tied || !abut_law_has_penalty(&law)))
        refuse(pair,
               coded(ABUT_FAILURE_BOTH_SIDES,
                     "it has the sides of pair '" + other.data.name
                         + "' exchanged. Conditions on both sides say the same "
                           "twice, and their pressures are not determined. "
                           "Leave one pair out, or use penalty or augmented "
                           "lagrangian."));
    pair.reach = data.reach;
    const std::string fixed =
        data.tied
            ? ""
            : kinematics_refusal(kinematics, law, pair.discretisation,
                                 {data.obstacle != nullptr, data.geometric_gap,
                                  exchange_->kind() != ABUT_FACET_TRI6});
    if (!fixed.empty())
      throw ContactError(about_pair(data.name, fixed, PairField::kinematics));
    pairs_.push_back(std::move(pair));
  }

  template <int dim>
  void SurfacePairRows<dim>::refuse(Pair &pair, const Message &message) const
  {
    if (!settings_.method.solve_known_failures
        || message.failure == ABUT_FAILURE_NONE)
      throw ContactError(about_pair(pair.data.name, message));
    const bool is_recorded = std::any_of(
        pair.refused.begin(), pair.refused.end(),
        [&](const Message &each) { return each.failure == message.failure; });
    if (!is_recorded)
      pair.refused.push_back(message);
  }

  template <int dim>
  void SurfacePairRows<dim>::check_sides(const Pair &pair) const
  {
    const auto &data = pair.data;
    const auto refuse = [&](const std::string &what)
    { throw ContactError(about_pair(data.name, what)); };
    if (data.obstacle && !data.primary.empty())
      refuse("it has both a primary surface and an obstacle; leave one out.");
    if (!data.obstacle && data.primary.empty())
      refuse("it has neither a primary surface nor an obstacle.");
    if (data.obstacle && data.tied)
      refuse("a body cannot be tied to an obstacle; prescribe its displacement "
             "there instead.");
    const auto refuse_side = [&](const std::string &side, const auto &ids)
    {
      std::string list;
      for (const auto id : ids)
        list += (list.empty() ? "" : ", ") + std::to_string(id);
      refuse("no facet of the mesh has a boundary id of the " + side
             + " surface ("
             + (list.empty() ? "which has none; give it ids" : list) + ").");
    };
    if (pair.secondary.everywhere.n_facets == 0)
      refuse_side("secondary", data.secondary);
    if (!data.obstacle && pair.primary.everywhere.n_facets == 0)
      refuse_side("primary", data.primary);
    for (const auto id : data.secondary)
      if (data.primary.count(id) != 0)
        refuse(
            "boundary id " + std::to_string(id)
            + " is on both sides; give the two surfaces ids of their own, or "
              "the same ids to both where a surface touches itself.");
  }

  template <int dim>
  Handle<abut_coupling> SurfacePairRows<dim>::make_coupling(
      const Pair &pair, const abut_discretisation discretisation) const
  {
    abut_coupling_options options = abut_coupling_defaults();
    options.discretisation = discretisation;
    if (discretisation_info(discretisation).has_degree)
      options.multiplier_degree =
          surface_.kind == ABUT_FACET_TRI6
              ? 1
              : static_cast<std::int32_t>(settings_.method.multiplier_degree);
    options.quadrature_degree =
        static_cast<std::int32_t>(settings_.method.quadrature_degree);
    options.segments = settings_.method.segments;
    options.axisymmetric = settings_.axisymmetric;
    options.interpolated_gaps =
        !pair.has_committed_points() || pair.data.obstacle != nullptr;
    options.normal_cosine = settings_.search.detection.normal_cosine;
    options.search = settings_.search.detection.search;
    options.search.reach = std::max(options.search.reach, pair.data.reach);
    if (options.search.skin == 0. && pair.has_displaced_sides()
        && !pair.data.obstacle)
      options.search.skin = skin_of_displaced * facet_size(pair);
    options.thickness = pair.thickness;
    abut_coupling *made = nullptr;
    check(context_, pair.data.obstacle
                        ? abut_coupling_create_obstacle(
                            context_, pair.secondary.surface.get(),
                            pair.data.obstacle->handle(), &options, &made)
                        : abut_coupling_create(
                            context_, pair.secondary.surface.get(),
                            pair.primary.surface.get(), &options, &made));
    return Handle<abut_coupling>(made);
  }

  template <int dim>
  double SurfacePairRows<dim>::freedom(const Node node,
                                       const Direction &direction) const
  {
    std::map<global_dof_index, Direction> columns;
    for (unsigned int d = 0; d < dim; ++d)
      surface_.map.for_each_term(
          node, d,
          [&](const global_dof_index unknown, const double factor)
          { columns[unknown][d] += factor; });
    double sum = 0.;
    for (const auto &column : columns)
      if (column.second.norm_square() > 0.)
      {
        const double along = column.second * direction;
        sum += along * along / column.second.norm_square();
      }
    return sum;
  }

  template <int dim>
  std::vector<std::uint8_t>
  SurfacePairRows<dim>::dropped_nodes(const Pair &pair,
                                      const std::vector<std::uint8_t> &taken,
                                      const int component) const
  {
    const SurfaceSide<dim> &side = pair.secondary;
    const double *normal = nullptr;
    check(context_, abut_surface_normals(side.surface.get(), &normal));
    std::vector<std::uint8_t> dropped(side.n_nodes(), 0);
    for (int n = 0; n < side.n_nodes(); ++n)
    {
      const Node node = side.node[n];
      if (!surface_.parents[node].empty())
        continue;
      Direction direction;
      for (unsigned int d = 0; d < dim; ++d)
        direction[d] = component < 0 ? normal[n * dim + d]
                                     : (d == static_cast<unsigned>(component));
      if (taken[node] != 0)
        dropped[n] = 1;
      else if (direction.norm_square() > 0.
               && freedom(node, direction) < least_freedom)
        dropped[n] = of_supports;
    }
    return dropped;
  }

  template <int dim>
  void SurfacePairRows<dim>::build(const Pair &pair, abut_coupling *coupling,
                                   const std::vector<std::uint8_t> &dropped,
                                   const double motion,
                                   const abut_coupling_target &target) const
  {
    const SurfaceSide<dim> &side = pair.secondary;
    const auto me = MPI::this_mpi_process(communicator_);
    std::vector<std::uint8_t> wanted(side.n_nodes()), facets(side.n_facets());
    for (int n = 0; n < side.n_nodes(); ++n)
      wanted[n] = is_owned(side.node[n]);
    for (int f = 0; f < side.n_facets(); ++f)
      facets[f] = surface_.facets[side.facet[f]].owner == me;

    abut_coupling_nodes nodes = abut_coupling_nodes_defaults();
    nodes.wanted = wanted.data();
    nodes.wanted_facet = facets.data();
    nodes.dropped = dropped.data();
    nodes.n_hanging = static_cast<std::int32_t>(side.hanging_node.size());
    nodes.hanging_node = side.hanging_node.data();
    nodes.hanging_start = side.hanging_start.data();
    nodes.hanging_parent = side.hanging_parent.data();
    nodes.hanging_weight = side.hanging_weight.data();
    const abut_status status =
        abut_coupling_build(coupling, &nodes, motion, &target);
    Message message;
    if (status != ABUT_SUCCESS)
    {
      const bool of_obstacle =
          pair.data.obstacle
          && (status == ABUT_CALLBACK_FAILED || status == ABUT_NOT_FINITE);
      message = about_pair(
          pair.data.name,
          of_obstacle ? "its obstacle: " + pair.data.obstacle->failure()
                      : message_of(context_, status),
          of_obstacle ? PairField::obstacle : PairField::surfaces);
    }
    throw_everywhere<ContactError>(communicator_, message);
  }

  template <int dim>
  std::vector<std::int64_t>
  SurfacePairRows<dim>::point_numbers(const std::size_t number,
                                      const int shift) const
  {
    // The k-th point at a node, as in a corner between obstacles, or on a facet
    // of several pairs, has a number of its own. All are on the same rank.
    const Pair &pair = pairs_[number];
    const std::int64_t end_of_nodes = surface_.node_number_end * dim;
    const std::int64_t end_of_facets =
        surface_.n_facets_everywhere * PointNumber::points_per_facet;
    std::unordered_map<std::int32_t, std::set<std::size_t>> before;
    const bool at_points =
        discretisation_info(pair.discretisation).row_per_point;
    for (const Place &place : places_)
      if (place.pair != number && (place.node < 0) == at_points)
        before[at_points ? place.facet : place.node].insert(place.pair);
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
      for (const Node node : pair.secondary.node)
        id.push_back(surface_.nodes[node].number * dim + shift
                     + n_before(node) * end_of_nodes);
    return id;
  }

  template <int dim>
  void SurfacePairRows<dim>::append(const std::size_t number,
                                    const std::vector<std::uint8_t> &dropped,
                                    const double motion,
                                    const std::uint32_t tie_axes,
                                    const int shift)
  {
    const Pair &pair = pairs_[number];
    const SurfaceSide<dim> &side = pair.secondary;
    const std::vector<std::int64_t> id = point_numbers(number, shift);
    abut_coupling_target target = abut_coupling_target_defaults(points_);
    target.secondary_node = side.node.data();
    target.primary_node = pair.primary.node.data();
    target.id = id.data();
    target.tie_axes = tie_axes;
    target.gap = pair.data.gap;
    target.tangents = pair.data.friction != nullptr;
    target.flush = !pair.data.geometric_gap;
    target.kinematics = pair.kinematics;
    std::vector<double> reference, current, current_primary;
    if (pair.has_displaced_sides())
    {
      reference = places_of(side.node, reference_);
      target.reference = reference.data();
    }
    else if (pair.keeps_partners())
    {
      current = places_of(side.node, present_);
      current_primary = places_of(pair.primary.node, present_);
      target.current = current.data();
      target.current_primary = current_primary.data();
    }
    build(pair, pair.coupling.get(), dropped, motion, target);

    abut_coupling_view view;
    check(context_, abut_coupling_get(pair.coupling.get(), &view));
    for (std::int32_t i = 0; i < view.n_points; ++i)
    {
      Place place;
      place.pair = number;
      place.node = view.node[i] < 0 ? -1 : side.node[view.node[i]];
      place.facet = view.node[i] < 0 ? side.facet[view.facet[i]] : -1;
      for (unsigned int d = 0; d < dim; ++d)
        place.position[d] = view.position[i * dim + d];
      places_.push_back(place);
    }
    if (pair.has_current_directions())
      copy_hessians(pair, view);
    if (pair.is_displaced())
      check(context_,
            abut_points_set_origin(points_, view.first, view.n_points,
                                   static_cast<std::int32_t>(present_.size()),
                                   present_displacement_.data()));
    check(context_, abut_points_get(points_, &view_));
  }

  template <int dim>
  std::vector<typename SurfacePairRows<dim>::TieGroup>
  SurfacePairRows<dim>::tie_groups(const Pair &pair,
                                   const std::vector<std::uint8_t> &taken) const
  {
    // Supports may hold a node in some directions only.
    std::vector<TieGroup> groups;
    for (unsigned int d = 0; d < dim; ++d)
    {
      TieGroup group;
      group.dropped = dropped_nodes(pair, taken, d);
      for (auto g = groups.begin(); g != groups.end();)
        if (MPI::logical_or(g->dropped != group.dropped, communicator_))
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
  void SurfacePairRows<dim>::search(const Pair &pair, const double motion)
  {
    const Stopwatch watch(detection_.seconds);
    const auto statistics = [&]
    {
      abut_search_statistics result;
      check(context_,
            abut_search_get_statistics(
                abut_coupling_searcher(pair.coupling.get()), &result));
      return result;
    };
    run_everywhere<ContactError>(
        communicator_,
        [&]
        {
          run_named(pair.data.name,
                    [&]
                    {
                      const abut_search_statistics before = statistics();
                      check(context_,
                            abut_coupling_search(pair.coupling.get(), motion));
                      const abut_search_statistics after = statistics();
                      detection_.searches +=
                          after.n_searches - before.n_searches;
                      detection_.reuses += after.n_reuses - before.n_reuses;
                      detection_.rebuilds += after.n_builds - before.n_builds;
                      detection_.refits += after.n_refits - before.n_refits;
                    });
        });
  }

  template <int dim>
  ContactElements::Table SurfacePairRows<dim>::contact_elements() const
  {
    ContactElements::Table result;
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      if (!has_lasting_numbers(pairs_[places_[i].pair]))
        continue;
      std::vector<std::int64_t> opposite;
      for_each_primary(i, [&](const Node node, double)
                       { opposite.push_back(surface_.nodes[node].number); });
      std::sort(opposite.begin(), opposite.end());
      FnvHash hash;
      hash.mix(places_[i].pair);
      for (const std::int64_t number : opposite)
        hash.mix(number);
      result[view_.component_id[view_.component_start[i]]] = hash.value;
    }
    return result;
  }

  template <int dim>
  unsigned int SurfacePairRows<dim>::make_points(
      const std::size_t number, const double motion,
      const std::vector<std::uint8_t> &taken, Displaced &displaced)
  {
    Pair &pair = pairs_[number];
    unsigned int n_dropped = 0;
    int shift = 0;
    if (pair.has_displaced_sides() && !displaced)
      displaced.emplace(context_, pair.secondary, pair.primary, reference_,
                        present_);
    if (!pair.data.obstacle)
      search(pair, motion);
    auto groups =
        pair.data.tied
            ? tie_groups(pair, taken)
            : std::vector<TieGroup>{{0, dropped_nodes(pair, taken, -1)}};
    for (TieGroup &group : groups)
    {
      pair.dropped = std::move(group.dropped);
      unsigned int n = 0;
      for (std::size_t i = 0; i < pair.dropped.size(); ++i)
        n += pair.dropped[i] != 0 && is_owned(pair.secondary.node[i]);
      n_dropped = std::max(n_dropped, MPI::sum(n, communicator_));
      append(number, pair.dropped, motion, group.axes, shift);
      for (unsigned int d = 0; d < dim; ++d)
        shift += group.axes >> d & 1;
    }
    return n_dropped;
  }

  template <int dim>
  void SurfacePairRows<dim>::find_pair(const std::size_t number,
                                       const double motion,
                                       std::vector<std::uint8_t> &taken,
                                       Displaced &displaced)
  {
    const std::size_t first = places_.size();
    const unsigned int n_dropped =
        make_points(number, motion, taken, displaced);
    displaced.reset();

    // A node has points of one pair only: two would constrain it twice. Several
    // obstacles may hold one node in a corner.
    if (!pairs_[number].data.obstacle)
      for (std::size_t i = first; i < places_.size(); ++i)
        if (places_[i].node >= 0)
          taken[places_[i].node] = 1;
    exchange_->merge_marks(surface_, taken);
    make_check(number, n_dropped);
  }

  template <int dim>
  void SurfacePairRows<dim>::find_pairs(const std::vector<double> &moved)
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
  bool SurfacePairRows<dim>::has_lasting_numbers(const Pair &pair) const
  {
    // Against obstacles, where they move, and if the parameters require it,
    // points are those of a rule over the whole facet.
    return !discretisation_info(pair.discretisation).row_per_point
           || pair.has_current_points() || pair.data.obstacle != nullptr
           || !settings_.method.segments;
  }

  template <int dim>
  std::vector<PlacedRow> SurfacePairRows<dim>::placed_rows() const
  {
    std::vector<PlacedRow> result;
    for_each_component(
        [&](const Component &component)
        {
          if (has_lasting_numbers(pairs_[component.place.pair]))
            return;
          PlacedRow placed = {static_cast<std::int32_t>(component.row), {}};
          for (unsigned int d = 0; d < dim; ++d)
            placed.place[d] = component.place.position[d];
          result.push_back(placed);
        });
    return result;
  }

  template <int dim>
  std::vector<typename SurfacePairRows<dim>::Origin>
  SurfacePairRows<dim>::origins(const std::vector<Direction> &u) const
  {
    const abut_search_options &search = settings_.search.detection.search;
    std::vector<Origin> result;
    for (const Pair &pair : pairs_)
    {
      // Obstacles move and are functions that anything may have changed.
      if (pair.data.obstacle)
        return {};
      const double smallest = std::min(pair.secondary.everywhere.smallest,
                                       pair.primary.everywhere.smallest);
      const double reach =
          std::max({search.reach, pair.data.reach, 1.5 * motion(pair, u)});
      result.push_back({reach <= search.relative_reach * smallest ? 0. : reach,
                        pair.data.gap});
    }
    return result;
  }

  template <int dim>
  void
  SurfacePairRows<dim>::set_gaps(const std::vector<ContactPair<dim>> &pairs)
  {
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      pairs_[p].data.gap = pairs[p].gap;
  }

  template <int dim>
  RowSource::Change SurfacePairRows<dim>::find(const la::Vector &displacement,
                                               abut_points *points)
  {
    renew_sides();
    const bool has_new_constants = exchange_->update_constants(surface_);
    const std::vector<Direction> u = displacements_in_reach(displacement);
    ++n_finds_;
    check_gaps();
    slip_poses_ = poses_before(poses(), false);
    const std::vector<Direction> place = place_of_step();
    const std::vector<Direction> way = difference(u, place);
    std::vector<Origin> wanted = origins(way);
    if (!wanted.empty() && wanted == origins_ && points == points_
        && is_where_made(place) && (!moves() || is_made_at(u)))
    {
      ++n_kept_;
      return has_new_constants ? Change::constants : Change::none;
    }
    origins_.clear();
    points_ = points;
    places_.clear();
    checks_.clear();
    check(context_, abut_points_clear(points_));
    record_place(moves() ? u : place);
    made_place_ = moves() ? displacement : last_commit();
    if (n_finds_ == 1)
      look_inside(displacement);
    find_pairs(motions(way));
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (checks_[p].n_rows > 0)
        continue;
      else if (pairs_[p].data.obstacle)
        refuse_inside(pairs_[p], displacement);
      else
        refuse_overlap(p);
    origins_ = std::move(wanted);
    return Change::points;
  }

  template <int dim>
  void
  SurfacePairRows<dim>::drop_needless(std::vector<std::uint8_t> &keep) const
  {
    for (std::int32_t i = 0; i < view_.n_points; ++i)
      if (view_.kind[i] == ABUT_POINT_CONTACT)
        for (auto row = view_.component_start[i] + 1;
             row < view_.component_start[i + 1]; ++row)
          keep[row] = keep[view_.component_start[i]];
    drop_covered(keep);
  }

  template <int dim>
  void SurfacePairRows<dim>::filter(const std::vector<std::uint8_t> &keep)
  {
    std::size_t n = 0;
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      const auto first = keep.begin() + view_.component_start[i],
                 last = keep.begin() + view_.component_start[i + 1];
      if (std::all_of(first, last, [](const std::uint8_t k) { return k == 0; }))
        continue;
      places_[i].keep_components({first, last});
      if (n != i)
        places_[n] = std::move(places_[i]);
      ++n;
    }
    places_.resize(n);
    check(context_, abut_points_filter(points_, keep.data()));
    check(context_, abut_points_get(points_, &view_));
  }

  template class SurfacePairRows<2>;
  template class SurfacePairRows<3>;
} // namespace abut::shim
