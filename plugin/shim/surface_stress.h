// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_STRESS_H
#define ABUT_SHIM_SURFACE_STRESS_H

#include "pair_points.h"

#include <abut/dealii/surface_traction.h>

namespace abut::shim
{
  /** The bodies' own stress at quadrature points, for Nitsche's method. Replace
   * @p stress, of dimension 1, by what it does there: the same rows and
   * weights, of the normal n.sigma n, of tangents -t.sigma n (minus the
   * pressure or traction that it would be), with the derivatives as
   * coefficients over the unknowns of the cells, each of which is a node of
   * the map returned. Throws on all ranks. Collective. */
  template <int dim>
  solve::NodeMap find_stress(const PairPoints<dim> &points,
                             const SurfaceTraction<dim> &traction,
                             abut_points *stress);
} // namespace abut::shim

#endif
