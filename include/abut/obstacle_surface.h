/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_OBSTACLE_SURFACE_H
#define ABUT_OBSTACLE_SURFACE_H

/** @file
 * Rigid obstacles made of facets: the signed distance to the nearest facet,
 * which a tree of boxes finds however far away it is.
 *
 * The sign comes from the normal at the nearest point: within a facet its
 * own, on an edge the sum of the two facets', at a corner the sum of those of
 * all facets there, weighted by their angles; with this choice, and with few
 * others, the sign of a closed surface is right everywhere (Baerentzen and
 * Aanaes, Signed distance computation using the angle weighted pseudonormal,
 * IEEE Trans. Vis. Comput. Graph. 11 (2005) 243).
 */

#include <abut/obstacle.h>
#include <abut/surface.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** How a surface is an obstacle. */
  typedef struct abut_obstacle_surface
  {
    size_t struct_size; /**< sizeof(abut_obstacle_surface) */
    /** Length > 0 up to which distances are looked for: a point farther from
     * the surface, on either side, counts as outside the material at this
     * distance, with a gradient away from the surface's middle, and is counted
     * (abut_obstacle_view). 0 (default): none. */
    double limit;
    /** Whether the surface may have borders: a sheet with the material behind
     * it. The sign beyond a border is that of the half space of the nearest
     * facet. Default false: closed. */
    bool open;
    bool hollow; /**< the material is outside of the surface. Default false */
  } abut_obstacle_surface;

  /** Defaults: a closed surface, no limit. */
  static inline abut_obstacle_surface abut_obstacle_surface_defaults(void)
  {
    abut_obstacle_surface options;
    memset(&options, 0, sizeof(options));
    options.struct_size = sizeof(abut_obstacle_surface);
    return options;
  }

  /** Create an obstacle from a surface in the obstacle's own frame, of facets
   * of any kind, which must outlive it; its outward normals point out of the
   * material (with hollow: into it). After abut_surface_update() the distances
   * are those of the new positions. @p options may be NULL.
   *
   * INVALID_MESH, with the number of a facet, for a surface without facets,
   * with a border although it is to be closed, with more than two facets at a
   * side, or closed and turned inside out. O(n log n). */
  ABUT_API abut_status abut_obstacle_create_surface(
      abut_context *context, abut_surface *surface,
      const abut_obstacle_surface *options, abut_obstacle **obstacle);

#ifdef __cplusplus
}
#endif

#endif
