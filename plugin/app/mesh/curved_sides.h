// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CURVED_SIDES_H
#define ABUT_APP_CURVED_SIDES_H

/** @file
 * Curved boundaries of meshes whose description knows corners only, as files.
 */

#include "app/input/boundary_names.h"

#include <deal.II/grid/tria.h>

#include <string>

namespace abut::app
{
  /** Let refinement follow surfaces: `3: circle: 0, 0; 4: flat` in 2D, `3:
   * sphere: 0, 0, 0; 4, 5: cylinder: 0, 0, 0: 0, 0, 1` (a point of the axis,
   * its direction) in 3D; ids may be @p names. The nodes of the faces with a
   * boundary id tell its radius. `flat` faces are what they seem to be.
   *
   * Throws InputError that names @p parameter where an entry cannot be read, an
   * id does not exist, or a node is not on the surface. Not collective. */
  template <int dim>
  void set_curved_sides(const std::string &text, const std::string &parameter,
                        const BoundaryNames &names,
                        dealii::Triangulation<dim> &triangulation);
} // namespace abut::app

#endif
