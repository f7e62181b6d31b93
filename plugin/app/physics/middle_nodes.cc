// SPDX-License-Identifier: LGPL-2.1-or-later
#include "middle_nodes.h"

#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>

namespace abut::app
{
  namespace
  {
    /** Part of an edge below which a middle node is in the middle, as in mesh
     * files. */
    constexpr double straight_part = 1e-9;

    template <int dim>
    dealii::Point<dim> between(const dealii::Point<dim> &a,
                               const dealii::Point<dim> &b)
    {
      return a + 0.5 * (b - a);
    }
  } // namespace

  template <int dim>
  void add_middle(const unsigned int v, const dealii::Point<dim> &a,
                  const unsigned int w, const dealii::Point<dim> &b,
                  const dealii::Point<dim> &x, EdgeMiddles<dim> &middles)
  {
    if (x.distance(between(a, b)) > straight_part * a.distance(b))
      middles.emplace(std::minmax(v, w), x);
  }

  template <int dim>
  MiddleNodes<dim>::MiddleNodes(std::shared_ptr<const EdgeMiddles<dim>> middles)
      : dealii::MappingFE<dim>(dealii::FE_SimplexP<dim>(2)),
        middles(std::move(middles))
  {
  }

  template <int dim>
  std::unique_ptr<dealii::Mapping<dim>> MiddleNodes<dim>::clone() const
  {
    return std::make_unique<MiddleNodes<dim>>(middles);
  }

  template <int dim>
  const dealii::Point<dim> *
  MiddleNodes<dim>::middle_of(const unsigned int v, const unsigned int w) const
  {
    const auto found = middles->find(std::minmax(v, w));
    return found == middles->end() ? nullptr : &found->second;
  }

  template <int dim>
  typename MiddleNodes<dim>::SupportPoints
  MiddleNodes<dim>::compute_mapping_support_points(const Cell &cell) const
  {
    SupportPoints points;
    for (const unsigned int v : cell->vertex_indices())
      points.push_back(cell->vertex(v));
    for (unsigned int l = 0; l < cell->n_lines(); ++l)
    {
      const auto line = cell->line(l);
      const dealii::Point<dim> *const middle =
          middle_of(line->vertex_index(0), line->vertex_index(1));
      points.push_back(middle != nullptr
                           ? *middle
                           : between(line->vertex(0), line->vertex(1)));
    }
    return points;
  }

  template <int dim>
  dealii::BoundingBox<dim>
  MiddleNodes<dim>::get_bounding_box(const Cell &cell) const
  {
    const SupportPoints nodes = compute_mapping_support_points(cell);
    std::vector<dealii::Point<dim>> points(nodes.begin(), nodes.end());
    for (unsigned int l = 0; l < cell->n_lines(); ++l)
    {
      const auto line = cell->line(l);
      dealii::Point<dim> &middle = points[cell->n_vertices() + l];
      middle += middle - between(line->vertex(0), line->vertex(1));
    }
    return dealii::BoundingBox<dim>(points);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void add_middle<dim>(unsigned int, const dealii::Point<dim> &,      \
                                unsigned int, const dealii::Point<dim> &,      \
                                const dealii::Point<dim> &,                    \
                                EdgeMiddles<dim> &);                           \
  template class MiddleNodes<dim>;
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app
