// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_BODIES_H
#define ABUT_SHIM_BODIES_H

#include "solve/near_null_space.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::shim
{
  /** Bodies are the connected parts of the mesh. Component, body and place of
   * each owned unknown of a field with support points. One pass over the
   * cells. Collective. */
  template <int dim>
  solve::NearNullSpace
  make_near_null_space(const dealii::Mapping<dim> &mapping,
                       const dealii::DoFHandler<dim> &dof_handler);
} // namespace abut::shim

#endif
