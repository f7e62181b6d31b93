// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_VERTEX_ORIGIN_H
#define ABUT_DEALII_VERTEX_ORIGIN_H

#include <array>

namespace abut
{
  /** How a vertex came into a mesh whose triangulation does not record it:
   * triangles and tetrahedra that were refined by a program's own rules and
   * created again as a mesh of one level. */
  struct VertexOrigin
  {
    /** Number of the refinement that made it; 0: it is of the coarsest mesh. */
    unsigned int level = 0;
    /** Vertices, of the same or lower levels, that it was made between. */
    std::array<unsigned int, 2> ends = {};
  };
} // namespace abut

#endif
