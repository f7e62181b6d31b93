// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LOCKING_H
#define ABUT_APP_LOCKING_H

#include "material.h"

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::app
{
  /** Parts of the strain energy that bilinear and trilinear elements add by
   * strains that they cannot avoid, in [0, 1]. Both fall with the square of the
   * cells' size where nothing locks. */
  struct Locking
  {
    /** By volume change that varies within cells: nearly incompressible bodies
     * can keep the volume of each cell, but not at each point. 0 where stress
     * follows from the mean change of volume. */
    double volumetric = 0.;
    /** By shear strain between two directions of a cell's edges that varies
     * along one of them: what is bent keeps its angles, but its cells cannot
     * bend their edges (Prathap, The Finite Element Method in Structural
     * Mechanics, 1993, ch. 6). For rectangles of length l in a beam of height
     * H without lateral contraction it is G l^2 / (G l^2 + E H^2), and the
     * deflection is too small by that part. */
    double shear = 0.;
  };

  /** Locking of the linear quadrilaterals and hexahedra of a mesh; other cells
   * do not count. @p displacement with ghosts. @param large_strain strains are
   * Green's, so that rotations are none. One pass over the cells; collective.
   */
  template <int dim>
  Locking locking(const dealii::Mapping<dim> &mapping,
                  const dealii::DoFHandler<dim> &dof_handler,
                  const la::Vector &displacement,
                  const Materials<dim> &materials, bool large_strain);
} // namespace abut::app

#endif
