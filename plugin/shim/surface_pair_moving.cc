// SPDX-License-Identifier: LGPL-2.1-or-later
// Points of displaced bodies: where they are made, and what the forces of those
// that move with the bodies change by because directions do.
#include "surface_pair_rows.h"

#include <cmath>
#include <utility>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  namespace
  {
    /** Arguments of the Hessian of a point, by unknowns:
     * [components][terms]. */
    using Terms = std::vector<std::vector<std::pair<global_dof_index, double>>>;

    /** Add a factor times the unknowns of a node to a block of components. */
    void add_terms(const solve::NodeMap &map, const std::int32_t node,
                   const double factor, const std::size_t block, Terms &terms)
    {
      const unsigned int dim = map.dimension();
      for (unsigned int d = 0; d < dim; ++d)
        map.for_each_term(
            node, d,
            [&](const global_dof_index unknown, const double each)
            { terms[block * dim + d].emplace_back(unknown, factor * each); });
    }

    Terms nodes_by_unknowns(const solve::NodeMap &map,
                            const std::vector<std::int32_t> &nodes)
    {
      Terms terms(map.dimension() * nodes.size());
      for (std::size_t a = 0; a < nodes.size(); ++a)
        add_terms(map, nodes[a], 1., a, terms);
      return terms;
    }

    /** The derivative of a point's force, of pressures and tractions as in
     * geometric_lines(), by these; empty: 0. */
    template <int dim>
    std::vector<double> derivative_of_force(const abut_points_view &view,
                                            const std::size_t point,
                                            const PointPlace<dim> &place,
                                            const double *row_pressure)
    {
      if (place.hessian.empty())
        return {};
      // One matrix for each component.
      const std::size_t n = dim * (1 + place.opposite.size());
      const std::size_t size =
          place.lines.empty()
              ? n * n
              : dim * place.lines.size() * dim * place.columns.size();
      std::vector<double> sum(size, 0.);
      double force = 0.;
      for (std::int32_t row = view.component_start[point], k = 0;
           row < view.component_start[point + 1]; ++row, ++k)
      {
        const double each = row_pressure == nullptr
                                ? 1.
                                : view.weight[point] * row_pressure[row];
        for (std::size_t e = 0; e < size; ++e)
          sum[e] += each * place.hessian[k * size + e];
        force += std::abs(each);
      }
      return force > 0. ? sum : std::vector<double>();
    }

    /** Add what the gap of a point of mortar changes by because directions and
     * coefficients do: - sum_l d(n c_l) . x_l, wherever the origin is. */
    template <int dim>
    void add_gap_change(const solve::NodeMap &map, const PointPlace<dim> &place,
                        const std::vector<dealii::Point<dim>> &present,
                        solve::GapLine &line)
    {
      const std::size_t n = dim * place.columns.size();
      std::vector<double> change(n, 0.);
      for (std::size_t l = 0; l < place.lines.size(); ++l)
      {
        const auto way = present[place.lines[l]] - present[place.node];
        for (unsigned int d = 0; d < dim; ++d)
          for (std::size_t b = 0; b < n; ++b)
            change[b] += way[d] * place.hessian[(l * dim + d) * n + b];
      }
      const Terms columns = nodes_by_unknowns(map, place.columns);
      for (std::size_t b = 0; b < n; ++b)
        for (const auto &[unknown, factor] : columns[b])
        {
          line.column.push_back(unknown);
          line.value.push_back(change[b] * factor);
        }
    }
  } // namespace

  template <int dim> bool SurfacePairRows<dim>::moves() const
  {
    for (const Pair &pair : pairs_)
      if (pair.has_current_directions())
        return true;
    return false;
  }

  template <int dim>
  void SurfacePairRows<dim>::record_place(const std::vector<Direction> &u)
  {
    present_.clear();
    reference_.clear();
    present_displacement_.clear();
    if (!moves() && !has_steps())
      return;
    for (std::size_t n = 0; n < u.size(); ++n)
    {
      reference_.push_back(surface_.nodes[n].point);
      present_.push_back(reference_.back() + u[n]);
      for (unsigned int d = 0; d < dim; ++d)
        present_displacement_.push_back(u[n][d]);
    }
  }

  template <int dim>
  bool SurfacePairRows<dim>::is_made_at(const std::vector<Direction> &u) const
  {
    bool same = present_displacement_.size() == dim * u.size();
    for (std::size_t n = 0; n < u.size() && same; ++n)
      for (unsigned int d = 0; d < dim; ++d)
        same = same && present_displacement_[dim * n + d] == u[n][d];
    return !MPI::logical_or(!same, communicator_);
  }

  template <int dim>
  std::vector<double>
  SurfacePairRows<dim>::motions(const std::vector<Direction> &u)
  {
    std::vector<Direction> since(u);
    if (moves() && searched_from_.size() > 0)
      since = difference(u, exchange_->displacements(surface_, searched_from_));
    std::vector<double> result;
    // Lists of facets have a reach of their own; all of an obstacle is there,
    // and its interference is within reach.
    for (const Pair &pair : pairs_)
      result.push_back(
          pair.data.obstacle
              ? motion(pair, u) + std::max(0., -pair.data.gap)
              : motion(pair, pair.has_current_points() ? since : u));
    return result;
  }

  template <int dim>
  void SurfacePairRows<dim>::copy_hessians(const Pair &pair,
                                           const abut_coupling_view &view)
  {
    const std::size_t first = places_.size() - view.n_points;
    for (std::int32_t i = 0; i < view.n_points; ++i)
    {
      Place &place = places_[first + i];
      place.hessian.assign(view.hessian + view.hessian_start[i],
                           view.hessian + view.hessian_start[i + 1]);
      if (view.least != nullptr)
        place.least = view.least[i];
      if (view.line != nullptr)
      {
        place.lines.assign(view.line + view.line_start[i],
                           view.line + view.line_start[i + 1]);
        place.columns.assign(view.column + view.column_start[i],
                             view.column + view.column_start[i + 1]);
      }
      if (view.primary[i] < 0)
        continue;
      const auto &facet = surface_.facets[pair.primary.facet[view.primary[i]]];
      place.opposite.assign(facet.node.begin(),
                            facet.node.begin() + surface_.nodes_per_facet());
    }
  }

  template <int dim>
  std::vector<double>
  SurfacePairRows<dim>::places_of(const std::vector<Node> &nodes,
                                  const std::vector<dealii::Point<dim>> &place)
  {
    std::vector<double> result;
    for (const Node node : nodes)
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(place[node][d]);
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  SurfacePairRows<dim>::apart(const std::size_t point,
                              const std::vector<Direction> &u) const
  {
    Direction result;
    const auto add = [&](const Node node, const double c)
    { result += c * (Direction(surface_.nodes[node].point) + u[node]); };
    for_each_secondary(point, add);
    for_each_primary(point, add);
    return result;
  }

  template <int dim>
  std::vector<MatrixLine>
  SurfacePairRows<dim>::geometric_lines(const double *row_pressure) const
  {
    std::vector<MatrixLine> lines;
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      const Place &place = places_[i];
      const std::vector<double> hessian =
          derivative_of_force(view_, i, place, row_pressure);
      if (hessian.empty())
        continue;
      const bool is_square = place.lines.empty();
      Terms terms = nodes_by_unknowns(surface_.map,
                                      is_square ? place.opposite : place.lines);
      if (is_square)
      {
        Terms position(dim);
        for_each_secondary(i, [&](const Node node, const double c)
                           { add_terms(surface_.map, node, c, 0, position); });
        terms.insert(terms.begin(), position.begin(), position.end());
      }
      const Terms columns =
          is_square ? terms : nodes_by_unknowns(surface_.map, place.columns);
      const std::size_t n = columns.size();
      for (std::size_t a = 0; a < terms.size(); ++a)
        for (const auto &row : terms[a])
        {
          MatrixLine line;
          line.row = row.first;
          for (std::size_t b = 0; b < n; ++b)
            for (const auto &column : columns[b])
            {
              line.column.push_back(column.first);
              line.value.push_back(-hessian[a * n + b] * row.second
                                   * column.second);
            }
          lines.push_back(std::move(line));
        }
    }
    return lines;
  }

  template <int dim>
  std::vector<solve::GapLine>
  SurfacePairRows<dim>::gap_lines(const std::vector<std::uint8_t> &wanted) const
  {
    std::vector<solve::GapLine> lines;
    for_each_component(
        [&](const Component &row)
        {
          if (row.place.node < 0)
            return;
          solve::GapLine line;
          line.row = static_cast<int>(row.row);
          // Gaps at nearest points have all their derivatives.
          if (!row.place.lines.empty() && wanted[row.row] != 0)
            add_gap_change(surface_.map, row.place, present_, line);
          for (const auto &component :
               nodes_by_unknowns(surface_.map, {row.place.node}))
            for (const auto &[unknown, factor] : component)
              line.own.push_back(unknown);
          lines.push_back(std::move(line));
        });
    return lines;
  }

  template <int dim>
  void SurfacePairRows<dim>::make_isotropic(la::Vector &value) const
  {
    const dealii::IndexSet &owned = dof_handler_.locally_owned_dofs();
    double *const mine = la::data(value);
    for (std::size_t n = 0; n < surface_.nodes.size(); ++n)
    {
      if (!is_owned(static_cast<Node>(n)))
        continue;
      double sum = 0.;
      for (const auto dof : surface_.nodes[n].dof)
        sum += mine[owned.index_within_set(dof)];
      for (const auto dof : surface_.nodes[n].dof)
        mine[owned.index_within_set(dof)] = sum / dim;
    }
  }

  template <int dim>
  typename SurfacePairRows<dim>::SavedPoints SurfacePairRows<dim>::save_points()
  {
    SavedPoints kept;
    kept.points = points_;
    kept.places = places_;
    kept.checks = checks_;
    for (const Pair &pair : pairs_)
      kept.dropped.push_back(pair.dropped);
    kept.present = present_;
    kept.displacement = present_displacement_;
    return kept;
  }

  template <int dim> void SurfacePairRows<dim>::restore_points(SavedPoints kept)
  {
    points_ = kept.points;
    places_ = std::move(kept.places);
    checks_ = std::move(kept.checks);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      pairs_[p].dropped = std::move(kept.dropped[p]);
    present_ = std::move(kept.present);
    present_displacement_ = std::move(kept.displacement);
    origins_.clear();
    check(context_, abut_points_get(points_, &view_));
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template bool SurfacePairRows<dim>::moves() const;                           \
  template bool SurfacePairRows<dim>::is_made_at(                              \
      const std::vector<Direction> &) const;                                   \
  template std::vector<double> SurfacePairRows<dim>::motions(                  \
      const std::vector<Direction> &);                                         \
  template void SurfacePairRows<dim>::record_place(                            \
      const std::vector<Direction> &);                                         \
  template void SurfacePairRows<dim>::copy_hessians(                           \
      const Pair &, const abut_coupling_view &);                               \
  template std::vector<double> SurfacePairRows<dim>::places_of(                \
      const std::vector<Node> &, const std::vector<dealii::Point<dim>> &);     \
  template dealii::Tensor<1, dim> SurfacePairRows<dim>::apart(                 \
      std::size_t, const std::vector<Direction> &) const;                      \
  template std::vector<MatrixLine> SurfacePairRows<dim>::geometric_lines(      \
      const double *) const;                                                   \
  template std::vector<solve::GapLine> SurfacePairRows<dim>::gap_lines(        \
      const std::vector<std::uint8_t> &) const;                                \
  template void SurfacePairRows<dim>::make_isotropic(la::Vector &) const;      \
  template SurfacePairRows<dim>::SavedPoints                                   \
  SurfacePairRows<dim>::save_points();                                         \
  template void SurfacePairRows<dim>::restore_points(SavedPoints);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim
