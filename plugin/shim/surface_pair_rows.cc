// SPDX-License-Identifier: LGPL-2.1-or-later
// From pairs of surfaces to rows.
#include "surface_pair_rows.h"

#include "agree.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/rigid_obstacle.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  namespace
  {
    /** A node that can move along a direction only this little (1: freely)
     * is held there. */
    constexpr double least_freedom = 0.5;

    /** What suits a pair, if the parameters leave it to choose. */
    abut_discretisation automatic_discretisation(const abut_law &law,
                                                 const bool is_obstacle)
    {
      return abut_law_needs_stress(&law) ? ABUT_DISCRETISATION_QUADRATURE_POINT
             : is_obstacle               ? ABUT_DISCRETISATION_NODE_TO_SEGMENT
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
      abut_context *context, std::shared_ptr<SurfaceExchange<dim>> exchange)
      : mapping_(mapping),
        dof_handler_(dof_handler),
        constraints_(constraints),
        communicator_(dof_handler.get_communicator()),
        settings_(settings),
        context_(context),
        exchange_(std::move(exchange))
  {
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
    gather();
  }

  template <int dim>
  void SurfacePairRows<dim>::create_pair(const ContactPair<dim> &data)
  {
    Pair pair;
    pair.data = data;
    const abut_law &law = *settings_.method.options.law;
    pair.discretisation = settings_.method.discretisation.value_or(
        automatic_discretisation(law, data.obstacle != nullptr));
    const std::string reason =
        refusal(law, pair.discretisation, settings_.method.system, data.tied);
    if (!reason.empty())
      throw ContactError("Pair '" + data.name + "': " + reason);
    for (const Pair &other : pairs_)
      if (are_both_sides(data, other.data)
          && (data.tied || !abut_law_has_penalty(&law)))
        throw ContactError(
            "Pair '" + data.name + "': "
            + coded(ABUT_FAILURE_BOTH_SIDES,
                    "it has the sides of pair '" + other.data.name
                        + "' exchanged. Conditions on both sides say the same "
                          "twice, and their pressures are not determined. "
                          "Leave one pair out, or use penalty or augmented "
                          "lagrangian."));
    pair.reach = data.reach;
    pairs_.push_back(std::move(pair));
  }

  template <int dim>
  void SurfacePairRows<dim>::check_sides(const Pair &pair) const
  {
    const auto &data = pair.data;
    const auto refuse = [&](const std::string &what)
    { throw ContactError("Pair '" + data.name + "': " + what); };
    if (data.obstacle && !data.primary.empty())
      refuse("it has both a primary surface and an obstacle; leave one out.");
    if (!data.obstacle && data.primary.empty())
      refuse("it has neither a primary surface nor an obstacle.");
    if (data.obstacle && data.tied)
      refuse("a body cannot be tied to an obstacle; prescribe its displacement "
             "there instead.");
    if (pair.secondary.everywhere.n_facets == 0)
      refuse("no facet of the mesh has a boundary id of the secondary "
             "surface.");
    if (!data.obstacle && pair.primary.everywhere.n_facets == 0)
      refuse("no facet of the mesh has a boundary id of the primary surface.");
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
    options.multiplier_degree =
        discretisation_info(discretisation).has_degree
            ? static_cast<std::int32_t>(settings_.method.multiplier_degree)
            : 0;
    options.quadrature_degree =
        static_cast<std::int32_t>(settings_.method.quadrature_degree);
    options.segments = settings_.method.segments;
    options.axisymmetric = settings_.axisymmetric;
    options.normal_cosine = settings_.search.detection.normal_cosine;
    options.search = settings_.search.detection.search;
    options.search.reach = std::max(options.search.reach, pair.data.reach);
    const double found = exchange_->self_contact().thickness(pair.data);
    options.thickness =
        found > 0. ? found
                   : given_thickness(settings_.search, pair.data.primary);
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
      for (const auto &term : surface_.lines[node * dim + d].terms)
        columns[term.index][d] += term.factor;
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
        dropped[n] = 2;
    }
    return dropped;
  }

  template <int dim>
  void SurfacePairRows<dim>::build(const Pair &pair, abut_coupling *coupling,
                                   const std::vector<std::uint8_t> &dropped,
                                   const double motion) const
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
    const abut_status status = abut_coupling_build(coupling, &nodes, motion);
    std::string message;
    if (status != ABUT_SUCCESS)
    {
      const bool of_obstacle =
          pair.data.obstacle
          && (status == ABUT_CALLBACK_FAILED || status == ABUT_NOT_FINITE);
      message =
          "Pair '" + pair.data.name + "': "
          + (of_obstacle ? "its obstacle: " + pair.data.obstacle->failure()
                         : message_of(context_, status));
    }
    throw_everywhere<ContactError>(communicator_, message);
  }

  template <int dim>
  void SurfacePairRows<dim>::take_rows(const std::size_t number,
                                       const int component)
  {
    const Pair &pair = pairs_[number];
    abut_coupling_view view;
    check(context_, abut_coupling_get(pair.coupling.get(), &view));
    for (std::int32_t i = 0; i < view.n_rows; ++i)
    {
      Row row;
      row.pair = number;
      row.node = view.node[i] < 0 ? -1 : pair.secondary.node[view.node[i]];
      row.facet = row.node < 0 ? pair.secondary.facet[view.facet[i]] : -1;
      row.id = row.node >= 0 ? surface_.nodes[row.node].number * dim
                                   + std::max(component, 0)
                             : PointNumber::first_of_facets
                                   + surface_.facets[row.facet].number
                                         * PointNumber::points_per_facet
                                   + view.point[i];
      for (unsigned int d = 0; d < dim; ++d)
        row.position[d] = view.position[i * dim + d];
      row.weight = view.weight[i];
      row.gap = 0.;
      if (component < 0)
        row.gap = pair.data.gap + (pair.data.geometric_gap ? view.gap[i] : 0.);
      for (unsigned int d = 0; d < dim; ++d)
        row.direction[d] = component < 0
                               ? view.normal[i * dim + d]
                               : (d == static_cast<unsigned>(component));
      row.first = entries_.size();
      for (auto e = view.secondary_start[i]; e < view.secondary_start[i + 1];
           ++e)
        entries_.push_back({pair.secondary.node[view.secondary_node[e]],
                            -view.secondary_coefficient[e]});
      row.first_primary = entries_.size();
      for (auto e = view.primary_start[i]; e < view.primary_start[i + 1]; ++e)
        entries_.push_back({pair.primary.node[view.primary_node[e]],
                            view.primary_coefficient[e]});
      row.end = entries_.size();
      rows_.push_back(row);
    }
  }

  template <int dim>
  void SurfacePairRows<dim>::find_pair(const std::size_t number,
                                       const double motion,
                                       std::vector<std::uint8_t> &taken)
  {
    Pair &pair = pairs_[number];
    const std::size_t first = rows_.size();
    std::vector<std::uint8_t> &dropped = pair.dropped;
    dropped.clear();
    unsigned int n_dropped = 0;
    const auto count = [&]
    {
      unsigned int n = 0;
      for (std::size_t i = 0; i < dropped.size(); ++i)
        n += dropped[i] != 0 && is_owned(pair.secondary.node[i]);
      return MPI::sum(n, communicator_);
    };
    if (!pair.data.tied)
    {
      dropped = dropped_nodes(pair, taken, -1);
      n_dropped = count();
      build(pair, pair.coupling.get(), dropped, motion);
      take_rows(number, -1);
    }
    else
      for (unsigned int d = 0; d < dim; ++d)
      {
        const auto now = dropped_nodes(pair, taken, d);
        if (MPI::logical_or(d == 0 || now != dropped, communicator_))
        {
          dropped = now;
          n_dropped = std::max<unsigned int>(n_dropped, count());
          build(pair, pair.coupling.get(), dropped, motion);
        }
        take_rows(number, d);
      }
    std::sort(rows_.begin() + first, rows_.end(),
              [](const Row &a, const Row &b) { return a.id < b.id; });

    // A node has rows of one pair only: two would constrain it twice. Several
    // obstacles may hold one node in a corner.
    if (!pair.data.obstacle)
      for (std::size_t i = first; i < rows_.size(); ++i)
        if (rows_[i].node >= 0)
          taken[rows_[i].node] = 1;
    exchange_->merge_marks(surface_, taken);
    make_check(number, n_dropped);
  }

  template <int dim> void SurfacePairRows<dim>::number_again()
  {
    if (pairs_.size() == 1)
      return;
    // The k-th point at a node, as in a corner between obstacles, or on a
    // facet of several pairs. All are on the same rank.
    const std::int64_t end_of_nodes = surface_.node_number_end * dim;
    const std::int64_t end_of_facets =
        surface_.n_facets_everywhere * PointNumber::points_per_facet;
    std::unordered_map<std::int64_t, std::int64_t> n_met;
    for (Row &row : rows_)
      row.id +=
          n_met[row.id]++ * (row.node >= 0 ? end_of_nodes : end_of_facets);
    std::sort(rows_.begin(), rows_.end(),
              [](const Row &a, const Row &b) { return a.id < b.id; });
  }

  template <int dim>
  bool SurfacePairRows<dim>::has_lasting_numbers(const Pair &pair) const
  {
    // Against obstacles, and if they are told so, points are those of a rule
    // over the whole facet.
    return pair.discretisation != Discretisation::quadrature_point
           || pair.data.obstacle != nullptr || !settings_.method.segments;
  }

  template <int dim>
  std::vector<PlacedRow> SurfacePairRows<dim>::placed_rows() const
  {
    std::vector<PlacedRow> result;
    for (std::size_t i = 0; i < rows_.size(); ++i)
    {
      if (has_lasting_numbers(pairs_[rows_[i].pair]))
        continue;
      PlacedRow placed = {static_cast<std::int32_t>(i), {}};
      for (unsigned int d = 0; d < dim; ++d)
        placed.place[d] = rows_[i].position[d];
      result.push_back(placed);
    }
    return result;
  }

  template <int dim>
  bool SurfacePairRows<dim>::append(const Row &row, abut_rows *rows,
                                    std::string &message) const
  {
    std::map<global_dof_index, double> terms;
    double gap = row.gap;
    for (std::size_t e = row.first; e < row.end; ++e)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double factor = entries_[e].coefficient * row.direction[d];
        const auto &line = surface_.lines[entries_[e].node * dim + d];
        gap += factor * line.constant;
        for (const auto &term : line.terms)
          terms[term.index] += factor * term.factor;
      }
    std::vector<std::int64_t> column;
    std::vector<double> coefficient;
    for (const auto &term : terms)
      if (std::abs(term.second) > 1e-14)
      {
        column.push_back(static_cast<std::int64_t>(term.first));
        coefficient.push_back(term.second);
      }
    if (column.empty())
      return false;
    const abut_status status = abut_rows_append(
        rows, row.id, row.weight, gap, pairs_[row.pair].data.tied ? 1 : 0,
        static_cast<std::int32_t>(column.size()), column.data(),
        coefficient.data());
    if (status != ABUT_SUCCESS && message.empty())
      message = "Pair '" + pairs_[row.pair].data.name
                + "': " + message_of(context_, status);
    return true;
  }

  template <int dim>
  void SurfacePairRows<dim>::find(const la::Vector &displacement,
                                  abut_rows *rows)
  {
    rows_.clear();
    entries_.clear();
    checks_.clear();
    const std::vector<Direction> u = displacements_in_reach(displacement);
    std::vector<std::uint8_t> taken(surface_.nodes.size(), 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      find_pair(p, motion(pairs_[p], u), taken);
    number_again();

    // Rows between nodes that cannot move say nothing.
    std::string message;
    abut_rows_clear(rows);
    std::size_t n_kept = 0;
    for (const Row &row : rows_)
      if (append(row, rows, message))
        rows_[n_kept++] = row;
    rows_.resize(n_kept);
    throw_everywhere<ContactError>(communicator_, message);
  }

  template class SurfacePairRows<2>;
  template class SurfacePairRows<3>;
} // namespace abut::shim
