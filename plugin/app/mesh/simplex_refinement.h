// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SIMPLEX_REFINEMENT_H
#define ABUT_APP_SIMPLEX_REFINEMENT_H

/** @file
 * Refinement of triangles and tetrahedra, without hanging nodes.
 */

#include "mesh_description.h"

namespace abut::app
{
  /** Refine all cells of a mesh of triangles or tetrahedra: triangles into four
   * similar ones, tetrahedra into four similar ones at the corners and four
   * around the shortest diagonal of the octahedron between them, which keeps
   * their quality. (deal.II up to 9.5 takes the same diagonal in all cells, and
   * cells become flatter with each refinement.)
   *
   * Boundary ids, material ids and manifolds are those of the parents. New
   * vertices are the middles of edges, on curved sides the points that the
   * manifolds of @p mesh, from which @p description is, have between their
   * ends. Curved edges are cut at their middles; the edges of their children
   * have middles on the same parabolas. The new
   * vertices have the next level as their origin. Deterministic. Not
   * collective. */
  template <int dim>
  void refine_red(const dealii::Triangulation<dim> &mesh,
                  MeshDescription<dim> &description);

  /** Bisect the marked cells of such a mesh at the middles of their longest
   * edges, and the parts likewise, dim times, so that edges are about half as
   * long, and as many others as are needed for a mesh without hanging nodes.
   * Otherwise as refine_red().
   * @return for each new cell the number of the old one that it is a part of */
  template <int dim>
  std::vector<unsigned int> bisect(const dealii::Triangulation<dim> &mesh,
                                   const std::vector<bool> &marked,
                                   MeshDescription<dim> &description);
} // namespace abut::app

#endif
