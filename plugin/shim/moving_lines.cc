// SPDX-License-Identifier: LGPL-2.1-or-later
// Derivatives of the forces and gaps of points that move with the bodies.
#include "moving_lines.h"

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

    std::vector<NodeIndex> lines_of(const abut_places_view &v,
                                    const std::size_t i)
    {
      return {v.line + v.line_start[i], v.line + v.line_start[i + 1]};
    }

    std::vector<NodeIndex> columns_of(const abut_places_view &v,
                                      const std::size_t i)
    {
      return {v.column + v.column_start[i], v.column + v.column_start[i + 1]};
    }

    Terms nodes_by_unknowns(const solve::NodeMap &map,
                            const std::vector<std::int32_t> &nodes)
    {
      Terms terms(map.dimension() * nodes.size());
      for (std::size_t a = 0; a < nodes.size(); ++a)
        add_terms(map, nodes[a], 1., a, terms);
      return terms;
    }

    /** Add what the gap of a point of mortar changes by because directions and
     * coefficients do: - sum_l d(n c_l) . x_l, wherever the origin is. */
    template <int dim>
    void add_gap_change(const PairPoints<dim> &points, const PointRow<dim> &row,
                        solve::GapLine &line)
    {
      const abut_places_view &v = points.places();
      const Terms columns =
          nodes_by_unknowns(points.surface().map, columns_of(v, row.point));
      const std::vector<NodeIndex> lines = lines_of(v, row.point);
      const std::size_t n = columns.size();
      std::vector<double> change(n, 0.);
      for (std::size_t l = 0; l < lines.size(); ++l)
      {
        const auto way =
            points.present()[lines[l]] - points.present()[row.place.node];
        for (unsigned int d = 0; d < dim; ++d)
          for (std::size_t b = 0; b < n; ++b)
            change[b] +=
                way[d]
                * v.block[v.block_start[row.point] + (l * dim + d) * n + b];
      }
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
    const abut_places_view &places = points.places();
    std::vector<double> hessian;
    for (std::int32_t i = 0; i < points.view().n_points; ++i)
    {
      std::int64_t size = places.block_start[i + 1] - places.block_start[i];
      if (size == 0)
        continue;
      hessian.resize(size);
      check(points.host().context,
            abut_points_force_block(points.handle(), i, row_pressure,
                                    hessian.data(), &size));
      if (size == 0)
        continue;
      const std::vector<NodeIndex> nodes = columns_of(places, i);
      Terms terms =
          nodes_by_unknowns(points.surface().map, lines_of(places, i));
      if (nodes.empty())
      {
        Terms position(dim);
        points.for_each_secondary(
            i, [&](const NodeIndex node, const double c)
            { add_terms(points.surface().map, node, c, 0, position); });
        terms.insert(terms.begin(), position.begin(), position.end());
      }
      const Terms columns =
          nodes.empty() ? terms
                        : nodes_by_unknowns(points.surface().map, nodes);
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
          if (wanted[row.row] != 0
              && !columns_of(points.places(), row.point).empty())
            add_gap_change(points, row, line);
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
