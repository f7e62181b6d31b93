// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_HOST_CELLS_H
#define ABUT_SHIM_HOST_CELLS_H

#include <abut/dealii/coded.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::shim
{
  /** Why there is no contact with the cells, elements and mapping of a host;
   * empty: there is. The same on all ranks. Collective for tetrahedra only, of
   * which it passes over the cells. */
  template <int dim>
  Message cell_refusal(const dealii::Mapping<dim> &mapping,
                       const dealii::DoFHandler<dim> &dof_handler);

  /** Why pairs of surfaces cannot have the displacement of a field; empty:
   * they can. Not collective. */
  template <int dim>
  Message displacement_refusal(const dealii::DoFHandler<dim> &dof_handler);

  /** Why there can be no obstacle for a scalar field; empty: there can. Not
   * collective. */
  template <int dim>
  Message obstacle_refusal(const dealii::DoFHandler<dim> &dof_handler,
                           bool on_boundary);
} // namespace abut::shim

#endif
