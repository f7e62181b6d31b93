// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simplex_transfer.h"

#include "app/restart/values_along_mesh.h"

#include <abut/dealii/versions.h>

#include <deal.II/fe/fe.h>

namespace abut::app
{
  template <int dim>
  SimplexTransfer<dim>::SimplexTransfer(
      const dealii::DoFHandler<dim> &dof_handler,
      const std::vector<la::Vector> &fields)
  {
    const auto &mesh = dof_handler.get_triangulation();
    cells.resize(mesh.n_cells(0));
    for (const auto &cell : mesh.cell_iterators_on_level(0))
    {
      Cell &copy = cells[cell->index()];
      for (const unsigned int v : cell->vertex_indices())
        copy.corners[v] = cell->vertex(v);
      copy.nodes = nodes_along_mesh<dim>(cell, dof_handler.get_fe().degree);
    }
    for (const la::Vector &field : fields)
      values.push_back(values_along_mesh(dof_handler, field));
  }

  template <int dim>
  std::vector<la::Vector> SimplexTransfer<dim>::interpolate(
      const dealii::DoFHandler<dim> &dof_handler,
      const std::vector<unsigned int> &origin) const
  {
    const auto &fe = dof_handler.get_fe();
    const dealii::FiniteElement<dim> &scalar = fe.base_element(0);
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    std::vector<la::Vector> result(values.size());
    for (la::Vector &field : result)
      field.reinit(owned, versions::communicator(dof_handler));
    std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
    std::vector<double> shape(scalar.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      cell->get_dof_indices(dofs);
      const Cell &old = cells.at(origin.at(cell->index()));
      dealii::Tensor<2, dim> edges; // columns
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          edges[i][d] = old.corners[d + 1][i] - old.corners[0][i];
      const dealii::Tensor<2, dim> inverse = invert(edges);
      for (unsigned int node = 0; node < scalar.n_dofs_per_cell(); ++node)
      {
        const auto first = dofs[fe.component_to_system_index(0, node)];
        if (!owned.is_element(first))
          continue;
        const dealii::Point<dim> &at = scalar.unit_support_point(node);
        dealii::Point<dim> x = cell->vertex(0);
        for (unsigned int d = 0; d < dim; ++d)
          x += at[d] * (cell->vertex(d + 1) - cell->vertex(0));
        const dealii::Point<dim> unit(inverse * (x - old.corners[0]));
        for (unsigned int k = 0; k < old.nodes.size(); ++k)
          shape[k] = scalar.shape_value(k, unit);
        for (unsigned int c = 0; c < fe.n_components(); ++c)
          for (std::size_t f = 0; f < values.size(); ++f)
          {
            double sum = 0.;
            for (unsigned int k = 0; k < old.nodes.size(); ++k)
              sum += shape[k] * values[f][old.nodes[k] * fe.n_components() + c];
            const auto dof = dofs[fe.component_to_system_index(c, node)];
            la::data(result[f])[owned.index_within_set(dof)] = sum;
          }
      }
    }
    return result;
  }

  template class SimplexTransfer<2>;
  template class SimplexTransfer<3>;
} // namespace abut::app
