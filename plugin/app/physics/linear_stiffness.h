// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LINEAR_STIFFNESS_H
#define ABUT_APP_LINEAR_STIFFNESS_H

#include "material.h"

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::app
{
  /** Estimate of the squared error in energy norm of linear triangles or
   * tetrahedra, as a part of the squared norm of the solution, in [0, 1): under
   * loads the part of the strain energy, and so of displacements, that their
   * stiffness takes away. Recovered strains are means at vertices of those of
   * cells, weighted by volume (Zienkiewicz and Zhu, Int. J. Numer. Methods Eng.
   * 24, 1987): small strains, or Green's where @p large_strain, so that
   * rotations are no error. The energy of their differences is that of a
   * symmetric displacement gradient. There may be other cells, too, which do
   * not count. @p displacement with ghosts. Collective. */
  template <int dim>
  double linear_stiffness_error(const dealii::Mapping<dim> &mapping,
                                const dealii::DoFHandler<dim> &dof_handler,
                                const la::Vector &displacement,
                                const Materials<dim> &materials,
                                bool large_strain);
} // namespace abut::app

#endif
