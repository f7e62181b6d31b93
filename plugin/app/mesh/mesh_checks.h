// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MESH_CHECKS_H
#define ABUT_APP_MESH_CHECKS_H

/** @file
 * What coarse meshes must be to be computed on. Nothing here is collective.
 */

#include "mesh.h"

namespace abut::app
{
  /** Throw InputError that names @p parameter for cells without volume, and
   * for folded or concave ones, which have corners where they are inside
   * out. */
  template <int dim>
  void check_cells(const std::string &parameter,
                   const dealii::Triangulation<dim> &triangulation);

  /** Throw InputError for repetitions of a generator that the machine cannot
   * hold, before the mesh is made. */
  template <int dim> void check_repetitions(const MeshParameters &parameters);

  /** Throw InputError for a body of revolution that reaches beyond its axis, to
   * x < 0. */
  void check_axis(const MeshParameters &parameters,
                  const dealii::Triangulation<2> &triangulation);
} // namespace abut::app

#endif
