// SPDX-License-Identifier: LGPL-2.1-or-later
#include "between_corners.h"

#include <deal.II/fe/fe.h>
#include <deal.II/grid/reference_cell.h>

#include <vector>

namespace abut::app
{
  namespace
  {
    /** Weights of the corners of a face in a node of it; empty: the node is in
     * none of its faces, or a corner. */
    template <int dim, class Cell>
    std::vector<std::pair<unsigned int, double>>
    corners_around(const Cell &cell, const unsigned int f,
                   const unsigned int node)
    {
      std::set<unsigned int> of_face;
      for (const unsigned int v : cell->face(f)->vertex_indices())
        of_face.insert(cell->face(f)->vertex_index(v));
      const dealii::Point<dim> at =
          cell->get_fe().base_element(0).unit_support_point(node);
      std::vector<std::pair<unsigned int, double>> result;
      for (const unsigned int v : cell->vertex_indices())
      {
        const double share =
            cell->reference_cell().d_linear_shape_function(at, v);
        if (share < 0.1)
          continue;
        if (of_face.count(cell->vertex_index(v)) == 0)
          return {};
        result.emplace_back(v, share);
      }
      return result;
    }
  } // namespace

  template <int dim>
  void fill_between_corners(const dealii::DoFHandler<dim> &dof_handler,
                            const std::set<dealii::types::boundary_id> &surface,
                            const bool is_linear, const la::Vector &status,
                            const la::Vector &ghosted, la::Vector &field)
  {
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      const bool has_linear_facets =
          is_linear || (dim == 3 && cell->reference_cell().is_simplex());
      if (cell->is_artificial() || !cell->at_boundary()
          || cell->get_fe().degree != 2 || !has_linear_facets)
        continue;
      const auto &fe = cell->get_fe();
      dofs.resize(fe.n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      const auto dof =
          [&](const unsigned int component, const unsigned int node)
      { return dofs[fe.component_to_system_index(component, node)]; };
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary()
            || surface.count(cell->face(f)->boundary_id()) == 0)
          continue;
        for (unsigned int node = cell->n_vertices();
             node < fe.base_element(0).n_dofs_per_cell(); ++node)
        {
          if (!owned.is_element(dof(0, node)) || status(dof(0, node)) >= 0.)
            continue;
          const auto corners = corners_around<dim>(cell, f, node);
          bool have_rows = false;
          for (const auto &[v, share] : corners)
            have_rows = have_rows || status(dof(0, v)) >= 0.;
          for (unsigned int c = 0; c < fe.n_components() && have_rows; ++c)
          {
            double value = 0.;
            for (const auto &[v, share] : corners)
              value += share * ghosted(dof(c, v));
            la::data(field)[owned.index_within_set(dof(c, node))] = value;
          }
        }
      }
    }
  }

  template void
  fill_between_corners(const dealii::DoFHandler<2> &,
                       const std::set<dealii::types::boundary_id> &, bool,
                       const la::Vector &, const la::Vector &, la::Vector &);
  template void
  fill_between_corners(const dealii::DoFHandler<3> &,
                       const std::set<dealii::types::boundary_id> &, bool,
                       const la::Vector &, const la::Vector &, la::Vector &);
} // namespace abut::app
