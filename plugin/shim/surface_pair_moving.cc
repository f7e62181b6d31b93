// SPDX-License-Identifier: LGPL-2.1-or-later
// Points of displaced bodies: where they are made, and what the forces of those
// that move with the bodies change by because directions do.
#include "surface_pair_rows.h"

#include <array>
#include <utility>

namespace abut::shim
{
  using dealii::types::global_dof_index;

  template <int dim> bool SurfacePairRows<dim>::moves() const
  {
    for (const Pair &pair : pairs_)
      if (pair.moves)
        return true;
    return false;
  }

  template <int dim>
  void SurfacePairRows<dim>::note_place(const std::vector<Direction> &u)
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
  void SurfacePairRows<dim>::take_hessians(const abut_coupling_view &view)
  {
    constexpr std::size_t size = dim * dim;
    const std::size_t first = places_.size() - view.n_points;
    for (std::int32_t i = 0; i < view.n_points; ++i)
      places_[first + i].hessian.assign(view.hessian + i * size,
                                        view.hessian + (i + 1) * size);
  }

  template <int dim>
  std::vector<MatrixLine>
  SurfacePairRows<dim>::geometric_lines(const double *row_pressure) const
  {
    using Term = std::pair<global_dof_index, double>;
    std::vector<MatrixLine> lines;
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      const std::vector<double> &hessian = places_[i].hessian;
      const double force =
          row_pressure == nullptr
              ? 1.
              : view_.weight[i] * row_pressure[view_.component_start[i]];
      if (hessian.empty() || force == 0.)
        continue;
      // The place of the point as a function of the unknowns.
      std::array<std::vector<Term>, dim> terms;
      for_each_secondary(
          i,
          [&](const Node node, const double c)
          {
            for (unsigned int d = 0; d < dim; ++d)
              surface_.map.for_each_term(
                  node, d,
                  [&](const global_dof_index unknown, const double factor)
                  { terms[d].emplace_back(unknown, c * factor); });
          });
      for (unsigned int a = 0; a < dim; ++a)
        for (const Term &row : terms[a])
        {
          MatrixLine line;
          line.row = row.first;
          for (unsigned int b = 0; b < dim; ++b)
            for (const Term &column : terms[b])
            {
              line.column.push_back(column.first);
              line.value.push_back(-force * hessian[a * dim + b] * row.second
                                   * column.second);
            }
          lines.push_back(std::move(line));
        }
    }
    return lines;
  }

  template <int dim>
  typename SurfacePairRows<dim>::Kept SurfacePairRows<dim>::keep()
  {
    Kept kept;
    kept.points = points_;
    kept.places = places_;
    kept.checks = checks_;
    for (const Pair &pair : pairs_)
      kept.dropped.push_back(pair.dropped);
    kept.present = present_;
    kept.displacement = present_displacement_;
    return kept;
  }

  template <int dim> void SurfacePairRows<dim>::put_back(Kept kept)
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
  template void SurfacePairRows<dim>::note_place(                              \
      const std::vector<Direction> &);                                         \
  template void SurfacePairRows<dim>::take_hessians(                           \
      const abut_coupling_view &);                                             \
  template std::vector<MatrixLine> SurfacePairRows<dim>::geometric_lines(      \
      const double *) const;                                                   \
  template SurfacePairRows<dim>::Kept SurfacePairRows<dim>::keep();            \
  template void SurfacePairRows<dim>::put_back(Kept);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim
