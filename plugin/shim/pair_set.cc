// SPDX-License-Identifier: LGPL-2.1-or-later
// Pairs that make sense together, and their sides from the facets that a rank
// knows.
#include "pair_set.h"

#include "agree.h"
#include "fnv_hash.h"
#include "host_cells.h"
#include "pair_diagnosis.h"
#include "pair_interface.h"

#include <abut/dealii/coded.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  namespace
  {
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

    /** As run_everywhere(), with the name of the pair before the core's
     * message. */
    template <typename Function>
    void run_for_pair(const MPI_Comm communicator, const std::string &name,
                      const Function &function)
    {
      run_everywhere<ContactError>(communicator,
                                   [&] { run_named(name, function); });
    }

    template <int dim> void check_sides(const SurfacePair<dim> &pair)
    {
      const auto &data = pair.data;
      const auto refuse = [&](const std::string &what)
      { throw ContactError(about_pair(data.name, what)); };
      if (data.obstacle && !data.primary.empty())
        refuse("it has a primary surface and an obstacle; leave one out.");
      if (!data.obstacle && data.primary.empty())
        refuse("it has neither a primary surface nor an obstacle.");
      if (data.obstacle && data.tied)
        refuse(
            "a body cannot be tied to an obstacle; prescribe its displacement "
            "there instead.");
      const auto refuse_side = [&](const std::string &side, const auto &ids)
      {
        std::string list;
        for (const auto id : ids)
          list += (list.empty() ? "" : ", ") + std::to_string(id);
        refuse("no facet of the mesh has a boundary id of the " + side
               + " surface ("
               + (list.empty() ? "which has no ids; give it some" : list)
               + ").");
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

    /** First unknowns, of the wanted ones, of vertices around which cells do
     * not hang together by faces: two bodies have the vertex in common, but no
     * face. At the tip of a crack cells hang together. */
    template <int dim>
    std::vector<global_dof_index>
    hinges(const dealii::DoFHandler<dim> &dof_handler,
           const std::map<global_dof_index, NodeIndex> &wanted)
    {
      using Cell = std::pair<int, int>; // level and index
      const auto name = [](const auto &cell)
      { return Cell(cell->level(), cell->index()); };
      // By vertex, cells and those beyond their faces at it, and of each the
      // number of its part.
      std::map<global_dof_index, std::map<Cell, std::size_t>> parts;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        for (const unsigned int v : cell->vertex_indices())
        {
          const global_dof_index dof =
              cell->vertex_dof_index(v, 0, cell->active_fe_index());
          if (wanted.count(dof) == 0)
            continue;
          std::map<Cell, std::size_t> &part = parts[dof];
          const std::size_t mine =
              part.emplace(name(cell), part.size()).first->second;
          for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            bool has_vertex = false;
            for (const unsigned int w : face->vertex_indices())
              has_vertex =
                  has_vertex || face->vertex_index(w) == cell->vertex_index(v);
            if (!has_vertex || cell->at_boundary(f))
              continue;
            const std::size_t other =
                part.emplace(name(cell->neighbor(f)), part.size())
                    .first->second;
            for (auto &each : part)
              if (each.second == other)
                each.second = mine;
          }
        }
      }
      std::vector<global_dof_index> result;
      for (const auto &[dof, part] : parts)
        if (std::any_of(part.begin(), part.end(),
                        [&](const auto &each)
                        { return each.second != part.begin()->second; }))
          result.push_back(dof);
      return result;
    }

    template <int dim>
    double thickness_of(const PairHost<dim> &host, const SurfacePair<dim> &pair,
                        const std::set<dealii::types::boundary_id> &ids,
                        const SurfaceSide<dim> &side)
    {
      const double given = given_thickness(host.search, ids);
      if (given > 0.)
        return given;
      double found = INFINITY;
      run_for_pair(host.communicator, pair.data.name,
                   [&] {
                     found = found_thickness(host.context, side, host.search,
                                             pair.data.reach);
                   });
      found = MPI::min(found, host.communicator);
      return std::isfinite(found) ? found : 0.;
    }
  } // namespace

  template <int dim>
  PairSet<dim>::PairSet(const PairHost<dim> &host,
                        const std::vector<ContactPair<dim>> &given,
                        std::shared_ptr<SurfaceExchange<dim>> exchange)
      : host_(host), exchange_(std::move(exchange))
  {
    const Message reason = displacement_refusal(host.dof_handler);
    if (!reason.empty())
      throw ContactError(reason);
    const auto pairs = SelfContact<dim>::with_sides(given);
    const auto ids = all_ids(pairs);
    if (exchange_ != nullptr && exchange_->boundary_ids() == ids)
      exchange_->refresh();
    else
      exchange_ = std::make_shared<SurfaceExchange<dim>>(
          host.mapping, host.dof_handler, host.constraints, ids,
          SelfContact<dim>(host.mapping, host.dof_handler, given, host.search,
                           host.context));
    for (const auto &pair : pairs)
      create_pair(pair);
    gather(nullptr, {});
    for (SurfacePair<dim> &pair : pairs_)
      check_hinges(pair);
  }

  template <int dim>
  void PairSet<dim>::check_hinges(SurfacePair<dim> &pair) const
  {
    if (pair.data.obstacle || pair.data.tied
        || SelfContact<dim>::is_split(pair.data))
      return;
    std::map<global_dof_index, NodeIndex> common;
    for (const NodeIndex node : pair.secondary.node)
      if (is_owned(node) && pair.primary.local_node(node) >= 0)
        common.emplace(surface_.nodes[node].dof[0], node);
    if (!MPI::logical_or(!common.empty(), host_.communicator))
      return;
    std::uint64_t n[] = {0, 0, 0};
    for (const SurfaceSide<dim> *side : {&pair.secondary, &pair.primary})
      for (const NodeIndex node : side->node)
        n[side == &pair.primary] += is_owned(node);
    std::pair<std::int64_t, dealii::Point<dim>> first(surface_.node_number_end,
                                                      dealii::Point<dim>());
    for (const global_dof_index dof : hinges(host_.dof_handler, common))
    {
      const auto &node = surface_.nodes[common.at(dof)];
      first = std::min(first, std::make_pair(node.number, node.point),
                       [](const auto &a, const auto &b)
                       { return a.first < b.first; });
      ++n[2];
    }
    MPI::sum(n, host_.communicator, n);
    if (n[2] == 0)
      return;
    for (const auto &other : MPI::all_gather(host_.communicator, first))
      if (other.first < first.first)
        first = other;
    std::ostringstream text;
    text << n[2] << " of the " << n[0] << " nodes of the secondary surface and "
         << n[1] << " of the primary are the same ones, the first at ("
         << first.second
         << "): bodies without a common face cannot part or slide there. "
            "Give each body vertices of its own, as "
            "GridGenerator::merge_triangulations() does with a "
            "duplicated_vertex_tolerance of 0.";
    throw ContactError(about_pair(pair.data.name, text.str()));
  }

  template <int dim>
  void PairSet<dim>::create_pair(const ContactPair<dim> &data)
  {
    SurfacePair<dim> pair;
    pair.data = data;
    if (!(data.reach >= 0. && data.reach <= ABUT_FACET_LIMIT))
      refuse(pair, "its reach must be between 0, which finds one, and 1e40.");
    pair.has_quadratic_triangles =
        exchange_->has_quadratic_triangles(data.secondary);
    pair.multiplier_degree =
        pair.has_quadratic_triangles ? 1 : host_.method.multiplier_degree;
    const abut_law &law = *host_.method.options.law;
    const abut_kinematics kinematics =
        host_.method.kinematics.value_or(ABUT_KINEMATICS_REFERENCE);
    if (!data.tied)
      pair.set_kinematics(kinematics);
    pair.discretisation = host_.method.discretisation_of(
        data.obstacle != nullptr, pair.has_quadratic_triangles);
    const Message reason =
        refusal(law, pair.discretisation, host_.method.system, data.tied);
    if (!reason.empty())
      refuse(pair, reason);
    std::string no_friction =
        data.friction == nullptr ? ""
        : !data.friction->coefficient
            ? "friction without a coefficient: set Friction::coefficient. A "
              "cap limits its traction, and does not replace it."
            : friction_refusal(law, pair.discretisation, host_.method,
                               data.tied, data.obstacle != nullptr);
    // Where its two sides meet, a node would be held by its own side, too.
    if (data.friction != nullptr && SelfContact<dim>::is_split(data)
        && !abut_law_has_penalty(&law))
      no_friction = "a surface that touches itself has friction with penalty, "
                    "quadratic penalty and augmented lagrangian only, not with "
                    "Method/Enforcement = "
                    + std::string(law.name)
                    + ". Use one of these, or give its two sides different "
                      "boundary ids.";
    if (!no_friction.empty())
      throw ContactError(
          about_pair(data.name, no_friction, PairField::friction));
    for (const SurfacePair<dim> &other : pairs_)
      if (are_the_same(data, other.data))
        refuse(pair,
               "part of its surface touches the same surface in pair '"
                   + other.data.name
                   + "' and would be constrained twice. Remove one of the "
                     "pairs, or assign each boundary id to one of them.");
      else if (are_both_sides(data, other.data)
               && (data.tied || !abut_law_has_penalty(&law)))
        refuse(
            pair,
            coded(ABUT_FAILURE_BOTH_SIDES,
                  "it has the sides of pair '" + other.data.name
                      + "' exchanged. Conditions on both sides are the same "
                        "twice, and pressures are not unique. Leave one pair "
                        "out, or use penalty or augmented lagrangian."));
    pair.reach = data.reach;
    const std::string fixed =
        data.tied
            ? ""
            : kinematics_refusal(kinematics, law, pair.discretisation,
                                 {data.obstacle != nullptr, data.geometric_gap,
                                  !pair.has_quadratic_triangles});
    if (!fixed.empty())
      throw ContactError(about_pair(data.name, fixed, PairField::kinematics));
    pairs_.push_back(std::move(pair));
  }

  template <int dim>
  void PairSet<dim>::refuse(SurfacePair<dim> &pair,
                            const Message &message) const
  {
    if (!host_.method.solve_known_failures
        || message.failure == ABUT_FAILURE_NONE)
      throw ContactError(about_pair(pair.data.name, message));
    const bool is_recorded = std::any_of(
        pair.refused.begin(), pair.refused.end(),
        [&](const Message &each) { return each.failure == message.failure; });
    if (!is_recorded)
      pair.refused.push_back(message);
  }

  template <int dim>
  double PairSet<dim>::freedom(const NodeIndex node,
                               const Direction<dim> &direction) const
  {
    std::map<global_dof_index, Direction<dim>> columns;
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
  bool PairSet<dim>::has_lasting_numbers(const SurfacePair<dim> &pair) const
  {
    // Against obstacles, where they move, and if the parameters require it,
    // points are those of a rule over the whole facet.
    return !discretisation_info(pair.discretisation).row_per_point
           || pair.has_current_points() || pair.data.obstacle != nullptr
           || !host_.method.segments;
  }

  template <int dim>
  void PairSet<dim>::set_gaps(const std::vector<ContactPair<dim>> &pairs)
  {
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      pairs_[p].data.gap = pairs[p].gap;
  }

  template <int dim> double PairSet<dim>::facet_size() const
  {
    double size = 0.;
    for (const SurfacePair<dim> &pair : pairs_)
      size = std::max(size, pair.secondary.everywhere.median);
    return size;
  }

  template <int dim> bool PairSet<dim>::moves() const
  {
    return std::any_of(pairs_.begin(), pairs_.end(),
                       [](const auto &pair)
                       { return pair.has_current_directions(); });
  }

  template <int dim> bool PairSet<dim>::has_steps() const
  {
    return std::any_of(pairs_.begin(), pairs_.end(),
                       [](const SurfacePair<dim> &pair)
                       { return pair.has_committed_points(); });
  }

  template <int dim> bool PairSet<dim>::has_points() const
  {
    return std::any_of(
        pairs_.begin(), pairs_.end(),
        [](const SurfacePair<dim> &pair)
        { return discretisation_info(pair.discretisation).row_per_point; });
  }

  template <int dim>
  void PairSet<dim>::gather(const la::Vector *const place,
                            const std::set<global_dof_index> &used)
  {
    std::vector<typename SurfaceExchange<dim>::Link> links;
    for (const SurfacePair<dim> &pair : pairs_)
      links.push_back({pair.data.name, pair.data.secondary, pair.data.primary,
                       pair.reach, pair.margin, pair.has_displaced_sides()});
    const abut_search_options &search = host_.search.detection.search;
    surface_ =
        place == nullptr
            ? exchange_->gather(host_.context, links, search)
            : exchange_->gather_at(*place, used, host_.context, links, search);
    ++n_gatherings_;
    gathered_ = displacements_as_given(exchange_->place());
    for (std::size_t i = 0; i < pairs_.size(); ++i)
    {
      pairs_[i].reach = links[i].reach;
      pairs_[i].margin = links[i].margin;
    }
    for (SurfacePair<dim> &pair : pairs_)
      create_sides(pair);
  }

  template <int dim>
  void PairSet<dim>::record_commit(const la::Vector &displacement)
  {
    searched_from_ = moves() ? displacement : la::Vector();
    look_at_sides(displacement);
  }

  template <int dim>
  void PairSet<dim>::look_at_sides(const la::Vector &displacement)
  {
    if (exchange_->self_contact().any())
      sides_place_ = displacement;
  }

  template <int dim> std::optional<la::Vector> PairSet<dim>::renew_sides()
  {
    if (!sides_place_.has_value())
      return {};
    la::Vector place = std::move(*sides_place_);
    sides_place_.reset();
    la::Vector way(place);
    if (sides_seen_.size() > 0)
      way -= sides_seen_;
    sides_seen_ = place;
    // Two sides that come as near in this step as in the last one, and again.
    if (!exchange_->renew_sides(place, 4. * way.linfty_norm(), host_.context))
      return {};
    forget_sides();
    return place;
  }

  template <int dim> bool PairSet<dim>::load_sides(std::istream &stream)
  {
    sides_place_.reset();
    if (!exchange_->load_sides(stream))
      return false;
    forget_sides();
    return true;
  }

  template <int dim> void PairSet<dim>::forget_sides()
  {
    for (SurfacePair<dim> &pair : pairs_)
      if (SelfContact<dim>::is_split(pair.data))
        pair.secondary.everywhere = pair.primary.everywhere = SideMeasures();
  }

  template <int dim> std::uint64_t PairSet<dim>::mesh_signature() const
  {
    // Hashes of facets are added: sums do not depend on the order.
    const auto me = MPI::this_mpi_process(host_.communicator);
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
    hash.mix(MPI::sum(sum, host_.communicator));
    // Rules that number points on facets; nodes are numbered by the mesh alone.
    std::set<bool> kinds;
    for (const SurfacePair<dim> &pair : pairs_)
      if (discretisation_info(pair.discretisation).row_per_point)
        kinds.insert(has_lasting_numbers(pair));
    if (!kinds.empty())
      hash.mix(host_.method.quadrature_degree);
    for (const bool kind : kinds)
      hash.mix(kind ? 1 : 2);
    return std::max<std::uint64_t>(hash.value, 1);
  }

  template <int dim> void PairSet<dim>::create_sides(SurfacePair<dim> &pair)
  {
    const ContactPair<dim> &data = pair.data;
    pair.interface.reset();
    // The same whatever a rank knows of other ranks' facets.
    const bool is_measured = pair.secondary.everywhere.n_facets > 0;
    const SideMeasures secondary = pair.secondary.everywhere,
                       primary = pair.primary.everywhere;
    run_for_pair(host_.communicator, data.name,
                 [&]
                 {
                   pair.secondary = make_side(host_.context, surface_,
                                              data.secondary, host_.search);
                   pair.primary = make_side(host_.context, surface_,
                                            data.primary, host_.search);
                 });
    if (is_measured)
    {
      pair.secondary.everywhere = secondary;
      pair.primary.everywhere = primary;
    }
    else
    {
      for (auto *side : {&pair.secondary, &pair.primary})
        side->everywhere =
            measure_everywhere(*side, surface_, host_.communicator);
      find_thickness(pair);
    }
    run_for_pair(host_.communicator, data.name,
                 [&]
                 {
                   check_sides(pair);
                   pair.interface =
                       make_interface(host_, pair, &pair - pairs_.data(),
                                      pair.discretisation, pair.kinematics);
                 });
  }

  template <int dim> void PairSet<dim>::find_thickness(SurfacePair<dim> &pair)
  {
    const ContactPair<dim> &data = pair.data;
    if (SelfContact<dim>::is_split(data))
    {
      const double found = exchange_->self_contact().thickness(data);
      pair.thickness =
          found > 0. ? found : given_thickness(host_.search, data.primary);
      return;
    }
    if (data.tied)
      return;
    pair.own_thickness =
        thickness_of(host_, pair, data.secondary, pair.secondary);
    pair.thickness =
        data.obstacle ? pair.own_thickness
                      : thickness_of(host_, pair, data.primary, pair.primary);
  }

  template <int dim> bool PairSet<dim>::is_owned(const NodeIndex node) const
  {
    return host_.dof_handler.locally_owned_dofs().is_element(
        surface_.nodes[node].dof[0]);
  }

  template <int dim>
  double PairSet<dim>::motion(const SurfacePair<dim> &pair,
                              const std::vector<Direction<dim>> &u) const
  {
    // Common translations of both sides do not count; obstacles stand still.
    const double start =
        pair.data.obstacle ? 0. : std::numeric_limits<double>::infinity();
    std::vector<double> range(2 * dim, -start);
    for (const auto *side : {&pair.secondary, &pair.primary})
      for (const NodeIndex node : side->node)
        for (unsigned int d = 0; d < dim; ++d)
        {
          range[d] = std::max(range[d], u[node][d]);
          range[dim + d] = std::max(range[dim + d], -u[node][d]);
        }
    MPI::max(range, host_.communicator, range);
    Direction<dim> size;
    for (unsigned int d = 0; d < dim; ++d)
      size[d] = range[d] + range[dim + d];
    const bool is_given = pair.data.tied || pair.data.reach > 0.
                          || pair.data.secondary == pair.data.primary;
    return std::max(size.norm(), is_given ? 0. : foreseen_);
  }

  template <int dim>
  std::vector<double>
  PairSet<dim>::motions(const std::vector<Direction<dim>> &u) const
  {
    std::vector<Direction<dim>> since(u);
    if (moves() && searched_from_.size() > 0)
      since = difference(u, exchange_->displacements(surface_, searched_from_));
    std::vector<double> result;
    // Lists of facets have a reach of their own; all of an obstacle is there,
    // and its interference is within reach.
    for (const SurfacePair<dim> &pair : pairs_)
      result.push_back(
          pair.data.obstacle
              ? motion(pair, u) + std::max(0., -pair.data.gap)
              : motion(pair, pair.has_current_points() ? since : u));
    return result;
  }

  template <int dim>
  bool PairSet<dim>::is_in_reach(const SurfacePair<dim> &pair,
                                 const Motions &motions) const
  {
    if (pair.data.obstacle)
      return true;
    const abut_search_options &search = host_.search.detection.search;
    const double smallest = std::min(pair.secondary.everywhere.smallest,
                                     pair.primary.everywhere.smallest);
    return 1.5 * motions.searched <= std::max(
               {pair.reach, search.reach, search.relative_reach * smallest})
           && motions.gathered
                  <= pair.margin
                         + SurfaceExchange<dim>::relative_margin * smallest;
  }

  template <int dim>
  void
  PairSet<dim>::check_displacements(const std::vector<Direction<dim>> &u) const
  {
    Message message;
    for (const SurfacePair<dim> &pair : pairs_)
      for (const auto *side : {&pair.secondary, &pair.primary})
        for (const NodeIndex node : side->node)
          if (!std::isfinite(u[node].norm_square()) && message.empty())
          {
            std::ostringstream text;
            text
                << "the displacement of the node at ("
                << surface_.nodes[node].point
                << ") is not finite. Check loads, supports and stiffnesses for "
                   "values that are not finite or wrong by many powers of ten.";
            message = about_pair(pair.data.name,
                                 coded(ABUT_FAILURE_NOT_FINITE, text.str()));
          }
    throw_everywhere<ContactError>(host_.communicator, message);
  }

  template <int dim> const la::Vector &PairSet<dim>::last_commit() const
  {
    // Empty unless points move.
    return !moves() && has_steps() && committed_ != nullptr ? *committed_
                                                            : searched_from_;
  }

  template <int dim>
  std::vector<typename PairSet<dim>::Motions>
  PairSet<dim>::motions_since_gathering(
      const std::vector<Direction<dim>> &u) const
  {
    std::vector<Motions> result(pairs_.size());
    if (pairs_.empty())
      return result;
    // Points are made, and slips measured, there, too.
    const std::vector<Direction<dim>> then =
        exchange_->displacements_as_given(surface_, last_commit());
    const std::vector<Direction<dim>> since = difference(u, then),
                                      there = difference(then, gathered_),
                                      here = difference(u, gathered_);
    // The reach of the search follows from these.
    const std::vector<double> searched = motions(has_steps() ? since : u);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      const SurfacePair<dim> &pair = pairs_[p];
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
  void PairSet<dim>::set_distances(SurfacePair<dim> &pair,
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
        {pair.data.reach, 2. * 1.5 * motions.searched, pair.facet_size()});
    pair.margin = 2. * motions.searched + pair.facet_size();
  }

  template <int dim>
  typename PairSet<dim>::Gathering
  PairSet<dim>::extend_reach(const std::vector<Direction<dim>> &u)
  {
    const std::vector<Motions> motions = motions_since_gathering(u);
    bool is_far = false, is_displaced = false;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (!is_in_reach(pairs_[p], motions[p]))
      {
        is_far = true;
        is_displaced = is_displaced || pairs_[p].has_displaced_sides();
      }
    if (!is_far)
      return Gathering::none;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (is_displaced || !pairs_[p].has_displaced_sides())
        set_distances(pairs_[p], motions[p]);
    return is_displaced ? Gathering::displaced : Gathering::reference;
  }

  template class PairSet<2>;
  template class PairSet<3>;
} // namespace abut::shim
