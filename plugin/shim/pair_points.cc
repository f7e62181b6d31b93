// SPDX-License-Identifier: LGPL-2.1-or-later
// Points of pairs: their rows, and the numbers of their nodes when others are
// gathered.
#include "pair_points.h"

#include "fnv_hash.h"
#include "stopwatch.h"

#include <abut/strategy.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  namespace
  {
    /** Surfaces that have moved against each other by no more than this part of
     * their smallest facet keep their points: gaps of flat surfaces are right
     * all the same, the error for curved ones is the square of it. */
    constexpr double skin = 1e-2;
  } // namespace

  template <int dim> std::vector<Direction<dim>> PairPoints<dim>::made() const
  {
    std::vector<Direction<dim>> u(surface().nodes.size());
    for (std::size_t n = 0; n < present_.size(); ++n)
      u[n] = made_at(static_cast<NodeIndex>(n));
    return u;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> PairPoints<dim>::displacement_since(
      const std::vector<Direction<dim>> &u) const
  {
    std::vector<Direction<dim>> result(u);
    for (std::size_t n = 0; n < u.size() && !present_.empty(); ++n)
      result[n] -= made_at(static_cast<NodeIndex>(n));
    return result;
  }

  template <int dim>
  NodePositions<dim>::NodePositions(const PairPoints<dim> &points,
                                    const std::vector<Direction<dim>> &u)
      : made_(coordinates(points.present())), displacement_(coordinates(u))
  {
    for (const auto &node : points.surface().nodes)
      for (unsigned int d = 0; d < dim; ++d)
        reference_.push_back(node.point[d]);
    for (const SurfacePair<dim> &pair : points.pairs())
      kinematics_.push_back(pair.kinematics);
    view = {sizeof(view),
            static_cast<std::int32_t>(points.surface().nodes.size()),
            static_cast<std::int32_t>(kinematics_.size()),
            reference_.data(),
            made_.empty() ? nullptr : made_.data(),
            displacement_.empty() ? nullptr : displacement_.data(),
            kinematics_.data()};
  }

  template <int dim>
  void PairPoints<dim>::start(abut_points *const points,
                              const std::vector<Direction<dim>> &u)
  {
    points_ = points;
    node_area_ = la::Vector();
    checks_.clear();
    clear();
    record_place(u);
  }

  template <int dim> void PairPoints<dim>::clear()
  {
    check(host().context, abut_points_clear(points_));
    update_view();
  }

  template <int dim>
  void PairPoints<dim>::add_node_areas(const SurfacePair<dim> &pair)
  {
    abut_coupling_view made;
    check(host().context,
          abut_coupling_get(abut_interface_coupling(pair.interface.get()),
                            &made));
    // Quadrature points are made on the facets of each rank, those of nodes on
    // all facets around the nodes that it owns.
    const bool adds_up = discretisation_info(pair.discretisation).row_per_point;
    la::Vector area(host().dof_handler.locally_owned_dofs(),
                    host().communicator);
    for (std::size_t n = 0; n < pair.secondary.node.size(); ++n)
      if (adds_up || set_->is_owned(pair.secondary.node[n]))
        area(surface().nodes[pair.secondary.node[n]].dof[0]) +=
            made.full_of_node[n];
    area.compress(dealii::VectorOperation::add);
    if (node_area_.size() == 0)
      node_area_ = area;
    else
      for (int k = 0; k < la::n_owned(area); ++k)
        la::data(node_area_)[k] =
            std::max(la::data(node_area_)[k], la::data(area)[k]);
  }

  template <int dim>
  double PairPoints<dim>::node_area(const NodeIndex node) const
  {
    const dealii::IndexSet &owned = host().dof_handler.locally_owned_dofs();
    return la::data(
        node_area_)[owned.index_within_set(surface().nodes[node].dof[0])];
  }

  template <int dim>
  void PairPoints<dim>::filter(const std::vector<std::uint8_t> &keep)
  {
    check(host().context, abut_points_filter(points_, keep.data()));
    update_view();
  }

  template <int dim>
  void PairPoints<dim>::record_place(const std::vector<Direction<dim>> &u)
  {
    present_.clear();
    reference_.clear();
    present_displacement_.clear();
    if (!set_->moves() && !set_->has_steps())
      return;
    for (std::size_t n = 0; n < u.size(); ++n)
    {
      reference_.push_back(surface().nodes[n].point);
      present_.push_back(reference_.back() + u[n]);
      for (unsigned int d = 0; d < dim; ++d)
        present_displacement_.push_back(u[n][d]);
    }
  }

  template <int dim>
  bool
  PairPoints<dim>::is_where_made(const std::vector<Direction<dim>> &place) const
  {
    if (!set_->has_steps())
      return true;
    const std::vector<Direction<dim>> way = displacement_since(place);
    return std::all_of(pairs().begin(), pairs().end(),
                       [&](const SurfacePair<dim> &pair)
                       {
                         const double facet =
                             std::min(pair.secondary.everywhere.smallest,
                                      pair.primary.everywhere.smallest);
                         return !pair.has_committed_points()
                                || set_->motion(pair, way) <= skin * facet;
                       });
  }

  template <int dim>
  bool PairPoints<dim>::is_made_at(const std::vector<Direction<dim>> &u) const
  {
    bool same = present_displacement_.size() == dim * u.size();
    for (std::size_t n = 0; n < u.size() && same; ++n)
      for (unsigned int d = 0; d < dim; ++d)
        same = same && present_displacement_[dim * n + d] == u[n][d];
    return !MPI::logical_or(!same, set_->host().communicator);
  }

  template <int dim>
  std::set<global_dof_index> PairPoints<dim>::used_nodes() const
  {
    std::set<global_dof_index> used;
    const auto add = [&](const std::int32_t *const node, const std::int64_t n)
    {
      for (std::int64_t i = 0; i < n; ++i)
        used.insert(surface().nodes[node[i]].dof[0]);
    };
    const std::int32_t n = view_.n_points;
    if (n == 0)
      return used;
    add(view_.node, view_.start[n]);
    add(places_.line, places_.line_start[n]);
    add(places_.column, places_.column_start[n]);
    return used;
  }

  template <int dim> void PairPoints<dim>::renew(const la::Vector *const where)
  {
    // Data that refer to nodes and facets do so by their numbers meanwhile.
    const auto number_of = [](const auto &list, const std::int32_t index)
    { return index < 0 ? std::int64_t(-1) : list[index].number; };
    std::vector<std::int64_t> nodes, facets;
    for (const auto &node : surface().nodes)
      nodes.push_back(node.number);
    for (const auto &facet : surface().facets)
      facets.push_back(facet.number);
    using Dropped = std::pair<std::int64_t, std::uint8_t>;
    std::vector<std::vector<Dropped>> dropped(pairs().size());
    for (std::size_t p = 0; p < pairs().size(); ++p)
      for (std::size_t n = 0; n < dropped_[p].size(); ++n)
        if (dropped_[p][n] != 0)
          dropped[p].emplace_back(
              number_of(surface().nodes, pairs()[p].secondary.node[n]),
              dropped_[p][n]);

    origins.clear();
    set_->gather(where, where == nullptr ? std::set<global_dof_index>()
                                         : used_nodes());
    // Nodes have other numbers; points stay where they were made. Ranks without
    // nodes take part.
    if (points_ != nullptr && (set_->moves() || set_->has_steps()))
      record_place(set_->displacements_as_given(made_place));

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
    const auto renumbered = [&](const auto &list, const auto &numbers)
    {
      std::vector<std::int32_t> now;
      for (const std::int64_t number : numbers)
        now.push_back(index_of(list, number));
      return now;
    };
    if (points_ != nullptr)
    {
      const auto node = renumbered(surface().nodes, nodes),
                 facet = renumbered(surface().facets, facets);
      check(host().context,
            abut_points_renumber(
                points_, static_cast<std::int32_t>(node.size()), node.data()));
      check(host().context,
            abut_points_renumber_facets(points_,
                                        static_cast<std::int32_t>(facet.size()),
                                        facet.data()));
    }
    for (std::size_t p = 0; p < pairs().size(); ++p)
    {
      SurfacePair<dim> &pair = pairs()[p];
      if (!dropped_[p].empty())
        dropped_[p].assign(pair.secondary.n_nodes(), 0);
      for (const auto &[number, why] : dropped[p])
        if (const int node =
                pair.secondary.local_node(index_of(surface().nodes, number));
            node >= 0)
          dropped_[p][node] = why;
    }
  }

  template <int dim>
  std::vector<Direction<dim>>
  PairPoints<dim>::displacements_in_reach(const la::Vector &displacement)
  {
    const Stopwatch watch(host().detection.seconds);
    std::vector<Direction<dim>> u = set_->displacements(displacement);
    set_->check_displacements(u);
    const auto gathering = set_->extend_reach(u);
    if (gathering == PairSet<dim>::Gathering::none)
      return u;
    renew(gathering == PairSet<dim>::Gathering::displaced ? &displacement
                                                          : nullptr);
    ++host().detection.gatherings;
    return set_->displacements(displacement);
  }

  template <int dim> std::vector<PlacedRow> PairPoints<dim>::placed_rows() const
  {
    std::vector<PlacedRow> result;
    for_each_component(
        [&](const PointRow<dim> &component)
        {
          if (set_->has_lasting_numbers(pairs()[component.place.pair]))
            return;
          PlacedRow placed = {static_cast<std::int32_t>(component.row), {}};
          for (unsigned int d = 0; d < dim; ++d)
            placed.place[d] = component.place.position[d];
          result.push_back(placed);
        });
    return result;
  }

  template <int dim>
  ContactElements::Table PairPoints<dim>::contact_elements() const
  {
    ContactElements::Table result;
    for (std::int32_t i = 0; i < view_.n_points; ++i)
    {
      if (!set_->has_lasting_numbers(pairs()[places_.pair[i]]))
        continue;
      std::vector<std::int64_t> opposite;
      for_each_primary(i, [&](const NodeIndex node, double)
                       { opposite.push_back(surface().nodes[node].number); });
      std::sort(opposite.begin(), opposite.end());
      FnvHash hash;
      hash.mix(places_.pair[i]);
      for (const std::int64_t number : opposite)
        hash.mix(number);
      result[view_.component_id[view_.component_start[i]]] = hash.value;
    }
    return result;
  }

  template <int dim> std::vector<int> PairPoints<dim>::row_pairs() const
  {
    std::vector<int> result(view_.n_components);
    for_each_row([&](const PointRow<dim> &row)
                 { result[row.row] = static_cast<int>(row.place.pair); });
    return result;
  }

  template <int dim>
  void PairPoints<dim>::mark_nodes(const std::uint8_t *row_state,
                                   std::vector<std::uint8_t> &marks) const
  {
    if (points_ == nullptr)
      return;
    check(host().context,
          abut_points_mark_nodes(
              points_, row_state, static_cast<std::int32_t>(pairs().size()),
              static_cast<std::int32_t>(surface().nodes.size()), marks.data()));
  }

  template <int dim>
  std::vector<std::uint8_t>
  PairPoints<dim>::touching_nodes(const std::uint8_t *row_state) const
  {
    const std::size_t n_nodes = surface().nodes.size();
    std::vector<std::uint8_t> touching(n_nodes * pairs().size(), 0);
    if (row_state != nullptr)
      mark_nodes(row_state, touching);
    for (std::size_t p = 0; p < pairs().size(); ++p)
      for (std::size_t n = 0; n < dropped_[p].size(); ++n)
        if (dropped_[p][n] != 0)
          touching[p * n_nodes + pairs()[p].secondary.node[n]] = 1;
    set_->exchange()->merge_marks(surface(), touching);
    for (std::size_t p = 0; p < pairs().size(); ++p)
    {
      std::uint8_t *marks = touching.data() + p * n_nodes;
      for (const NodeIndex node : pairs()[p].secondary.node)
        for (const auto &parent : surface().parents[node])
          marks[node] |= marks[parent.index];
    }
    return touching;
  }

  template <int dim>
  std::vector<std::uint8_t> PairPoints<dim>::held_nodes() const
  {
    const std::size_t n_nodes = surface().nodes.size();
    std::vector<std::uint8_t> held(n_nodes * pairs().size(), 0);
    mark_nodes(nullptr, held);
    // Owners of nodes know all facets around them.
    for (std::size_t p = 0; p < pairs().size(); ++p)
      for (std::size_t n = 0; n < dropped_[p].size(); ++n)
      {
        const NodeIndex node = pairs()[p].secondary.node[n];
        if (dropped_[p][n] != 0 && set_->is_owned(node))
          held[p * n_nodes + node] = 1;
      }
    set_->exchange()->merge_marks(surface(), held);
    for (std::size_t p = 0; p < pairs().size(); ++p)
    {
      std::uint8_t *marks = held.data() + p * n_nodes;
      for (const NodeIndex node : pairs()[p].secondary.node)
      {
        bool parents = !surface().parents[node].empty();
        for (const auto &parent : surface().parents[node])
          parents = parents && marks[parent.index] != 0;
        if (parents)
          marks[node] = 1;
      }
    }
    return held;
  }

  template class NodePositions<2>;
  template class NodePositions<3>;
  template class PairPoints<2>;
  template class PairPoints<3>;
} // namespace abut::shim
