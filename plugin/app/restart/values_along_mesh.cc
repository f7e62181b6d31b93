// SPDX-License-Identifier: LGPL-2.1-or-later
#include "values_along_mesh.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>

namespace abut::app
{
  namespace
  {
    /** Call @p visit with the position on this rank of each unknown that a cell
     * of it has and it owns, and the number of its value. */
    template <int dim, class Visit>
    void for_each_owned(const dealii::DoFHandler<dim> &dof_handler,
                        const Visit &visit)
    {
      const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
      std::vector<dealii::types::global_dof_index> dofs;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const auto &fe = cell->get_fe();
        const std::vector<std::size_t> nodes =
            nodes_along_mesh<dim>(cell, fe.degree);
        dofs.resize(fe.n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto [component, node] = fe.system_to_component_index(i);
          if (owned.is_element(dofs[i]))
            visit(owned.index_within_set(dofs[i]),
                  nodes[node] * fe.n_components() + component);
        }
      }
    }
  } // namespace

  template <int dim>
  std::vector<std::size_t> nodes_along_mesh(
      const typename dealii::Triangulation<dim>::cell_iterator &cell,
      const unsigned int degree)
  {
    std::vector<std::size_t> nodes;
    for (const unsigned int v : cell->vertex_indices())
      nodes.push_back(cell->vertex_index(v));
    if (degree == 1)
      return nodes;
    const auto &mesh = cell->get_triangulation();
    std::size_t first = mesh.n_vertices();
    for (unsigned int l = 0; l < cell->n_lines(); ++l)
      nodes.push_back(first + cell->line(l)->index());
    if (!cell->reference_cell().is_hyper_cube())
      return nodes;
    first += mesh.n_raw_lines();
    if (dim == 3)
    {
      for (const unsigned int f : cell->face_indices())
        nodes.push_back(first + cell->face_index(f));
      first += mesh.n_raw_faces();
    }
    nodes.push_back(first + cell->active_cell_index());
    return nodes;
  }

  template <int dim>
  std::vector<double>
  values_along_mesh(const dealii::DoFHandler<dim> &dof_handler,
                    const la::Vector &field)
  {
    const auto &mesh = dof_handler.get_triangulation();
    std::size_t n_nodes = mesh.n_vertices() + mesh.n_raw_lines();
    if (!mesh.all_reference_cells_are_simplex())
      n_nodes += (dim == 3 ? mesh.n_raw_faces() : 0) + mesh.n_active_cells();
    std::vector<double> mine(n_nodes * dof_handler.get_fe().n_components());
    for_each_owned(dof_handler,
                   [&](const auto position, const std::size_t number)
                   { mine[number] = la::data(field)[position]; });
    std::vector<double> all(mine.size());
    dealii::Utilities::MPI::sum(mine, versions::communicator(dof_handler), all);
    return all;
  }

  template <int dim>
  void set_values_along_mesh(const dealii::DoFHandler<dim> &dof_handler,
                             const std::vector<double> &values,
                             la::Vector &field)
  {
    for_each_owned(dof_handler,
                   [&](const auto position, const std::size_t number)
                   { la::data(field)[position] = values.at(number); });
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<double> values_along_mesh(                              \
      const dealii::DoFHandler<dim> &, const la::Vector &);                    \
  template void set_values_along_mesh(const dealii::DoFHandler<dim> &,         \
                                      const std::vector<double> &,             \
                                      la::Vector &);                           \
  template std::vector<std::size_t> nodes_along_mesh<dim>(                     \
      const dealii::Triangulation<dim>::cell_iterator &, unsigned int);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app
