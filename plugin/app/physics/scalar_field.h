// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SCALAR_FIELD_H
#define ABUT_APP_SCALAR_FIELD_H

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/hp/fe_collection.h>

namespace abut::app
{
  /** Let each cell of a field have the element of its kind of cells. Before
   * distribute_dofs(). */
  template <int dim>
  void choose_elements(const dealii::hp::FECollection<dim> &elements,
                       dealii::DoFHandler<dim> &dof_handler);

  /** Number the unknowns of a scalar field that is linear in each cell, on the
   * mesh of @p scalar with the elements in the order of @p field. Collective.
   */
  template <int dim>
  void distribute_linear(const dealii::DoFHandler<dim> &field,
                         dealii::DoFHandler<dim> &scalar);
} // namespace abut::app

#endif
