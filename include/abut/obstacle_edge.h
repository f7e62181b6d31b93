/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_OBSTACLE_EDGE_H
#define ABUT_OBSTACLE_EDGE_H

/** @file
 * Contact of a body near the convex edges, corners and tips of an obstacle.
 */

#include <abut/obstacle.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Whether the kind of an obstacle can have edges: all but planes and
   * spheres. */
  ABUT_API bool abut_obstacle_has_edges(const abut_obstacle *obstacle);

  /** Correct gaps and gradients of points of a body's surface that are near
   * convex edges, corners or tips of an obstacle, where the distance has no
   * continuous gradient. Contact there is that of a vertex with a face: the
   * direction is the projection of minus the body's outward normal onto the
   * cone of the flanks' normals, the gap is measured along it. Both are
   * continuous functions of the point: a weight of the edge's distance, across
   * the body's normal, is 1 up to an eighth of the facet's size and 0 from a
   * quarter on. All other points stay as they are, as do those near concave
   * edges, and those that are farther from the obstacle than the size.
   *
   * @param moving whether the values are those of abut_obstacle_gap(), else of
   *   abut_obstacle_distance()
   * @param points [n * dimension] in space
   * @param normals [n * dimension] unit, outward from the body
   * @param sizes [n] of the facets at the points, length > 0; 0: the point
   * stays as it is
   * @param gap [n] in and out
   * @param gradient [n * dimension] in and out, unit
   * @param hessian [n * dimension * dimension] in and out, scaled by what
   *   remains of the nearest flank; or NULL
   * Errors as there. O(n) distances, some tens for a point near an edge. */
  ABUT_API abut_status abut_obstacle_face(abut_obstacle *obstacle, bool moving,
                                          int32_t n, const double *points,
                                          const double *normals,
                                          const double *sizes, double *gap,
                                          double *gradient, double *hessian);

#ifdef __cplusplus
}
#endif

#endif
