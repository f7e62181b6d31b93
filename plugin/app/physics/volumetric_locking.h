// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_VOLUMETRIC_LOCKING_H
#define ABUT_APP_VOLUMETRIC_LOCKING_H

#include "material.h"

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::app
{
  /** The part of the strain energy, in [0, 1], that is volume change which
   * varies within cells. In nearly incompressible bodies the volume of each
   * cell can be kept, but (bi)linear elements cannot keep it at each point:
   * what they pay for that stiffens them. Where stress follows from the mean
   * change of volume, none. Falls with the square of the cells' size where
   * nothing locks. @p displacement with ghosts. Collective. */
  template <int dim>
  double volumetric_locking(const dealii::Mapping<dim> &mapping,
                            const dealii::DoFHandler<dim> &dof_handler,
                            const la::Vector &displacement,
                            const Materials<dim> &materials);
} // namespace abut::app

#endif
