// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_VALUES_ALONG_MESH_H
#define ABUT_APP_VALUES_ALONG_MESH_H

/** @file
 * Nodal fields by numbers that do not depend on ranks, on meshes of which all
 * ranks have all cells: those of vertices, then those of edges. For elements
 * with nodes nowhere else.
 */

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace abut::app
{
  /** Values of a field without ghosts: number times components plus component.
   * Collective; all ranks have all values. */
  template <int dim>
  std::vector<double>
  values_along_mesh(const dealii::DoFHandler<dim> &dof_handler,
                    const la::Vector &field);

  /** Put such values into a field without ghosts. Not collective. */
  template <int dim>
  void set_values_along_mesh(const dealii::DoFHandler<dim> &dof_handler,
                             const std::vector<double> &values,
                             la::Vector &field);

  /** Numbers of the nodes of a cell, in the order of its scalar element. */
  template <int dim>
  std::vector<std::size_t> nodes_along_mesh(
      const typename dealii::Triangulation<dim>::cell_iterator &cell,
      unsigned int degree);
} // namespace abut::app

#endif
