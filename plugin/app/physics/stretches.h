// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_STRETCHES_H
#define ABUT_APP_STRETCHES_H

#include "material.h"

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::app
{
  /** How far bodies are from being squeezed to nothing. The same on all ranks.
   */
  struct Stretches
  {
    /** Least length of a line as a part of its undeformed one. */
    double least = 1.;
    /** Least volume of the same kind, det F. */
    double least_volume = 1.;
    /** The same at corners of cells, which no integral sees. */
    double least_at_corners = 1.;
    /** By how much the former is below the material's least_stretch(), at most;
     * not positive if it is nowhere. */
    double excess = -1.;
    dealii::types::material_id where = 0; ///< the material of that
    /** Least stretch that this material may have. */
    double allowed = 0.;
  };

  /** At the points of quadrature, and at corners. @p displacement with ghosts.
   * Collective. */
  template <int dim>
  Stretches find_stretches(const dealii::Mapping<dim> &mapping,
                           const dealii::DoFHandler<dim> &dof_handler,
                           const la::Vector &displacement,
                           const Materials<dim> &materials);
} // namespace abut::app

#endif
