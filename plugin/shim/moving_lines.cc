// SPDX-License-Identifier: LGPL-2.1-or-later
// Derivatives of the forces and gaps of points that move with the bodies.
#include "moving_lines.h"

#include <cmath>
#include <utility>

namespace abut::shim
{
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

  template <int dim>
  std::vector<MatrixLine> geometric_lines(const PairPoints<dim> &points,
                                          const double *row_pressure)
  {
    std::vector<MatrixLine> lines;
    for (std::size_t i = 0; i < points.places().size(); ++i)
    {
      const PointPlace<dim> &place = points.places()[i];
      const std::vector<double> hessian =
          derivative_of_force(points.view(), i, place, row_pressure);
      if (hessian.empty())
        continue;
      const bool is_square = place.lines.empty();
      Terms terms = nodes_by_unknowns(points.surface().map,
                                      is_square ? place.opposite : place.lines);
      if (is_square)
      {
        Terms position(dim);
        points.for_each_secondary(
            i, [&](const NodeIndex node, const double c)
            { add_terms(points.surface().map, node, c, 0, position); });
        terms.insert(terms.begin(), position.begin(), position.end());
      }
      const Terms columns =
          is_square ? terms
                    : nodes_by_unknowns(points.surface().map, place.columns);
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
  std::vector<solve::GapLine> gap_lines(const PairPoints<dim> &points,
                                        const std::vector<std::uint8_t> &wanted)
  {
    std::vector<solve::GapLine> lines;
    points.for_each_component(
        [&](const PointRow<dim> &row)
        {
          if (row.place.node < 0)
            return;
          solve::GapLine line;
          line.row = static_cast<int>(row.row);
          // Gaps at nearest points have all their derivatives.
          if (!row.place.lines.empty() && wanted[row.row] != 0)
            add_gap_change(points.surface().map, row.place, points.present(),
                           line);
          for (const auto &component :
               nodes_by_unknowns(points.surface().map, {row.place.node}))
            for (const auto &[unknown, factor] : component)
              line.own.push_back(unknown);
          lines.push_back(std::move(line));
        });
    return lines;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<MatrixLine> geometric_lines(const PairPoints<dim> &,    \
                                                   const double *);            \
  template std::vector<solve::GapLine> gap_lines(                              \
      const PairPoints<dim> &, const std::vector<std::uint8_t> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim
