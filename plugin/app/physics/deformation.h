// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_DEFORMATION_H
#define ABUT_APP_DEFORMATION_H

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>

namespace abut::app
{
  /** How far bodies are deformed: the sum over all bodies of how much
   * displacements within one differ, or the largest displacement if that is
   * less. What a body travels does not count. Cells have their body as
   * material id, less than @p n_bodies. Collective. */
  template <int dim>
  double deformation(const dealii::DoFHandler<dim> &dof_handler,
                     unsigned int n_bodies, const la::Vector &displacement);
} // namespace abut::app

#endif
