/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_PAIR_CHECKS_H
#define ABUT_PAIR_CHECKS_H

/** @file
 * Whether the two sides of a pair fit together: how near they are, which way
 * they face, whether they bend, and which pair a node belongs to.
 */

#include <abut/detect.h>
#include <abut/obstacle.h>
#include <abut/places.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Least distances of the nodes of a surface from the facets of another one
   * that face them, length; infinite where there is none.
   *
   * @param options the reach should be larger than the bodies
   * @param above out: of nodes outside
   * @param below out: of nodes inside */
  ABUT_API abut_status abut_surface_nearest(
      abut_context *context, abut_surface *secondary, abut_surface *primary,
      const abut_detection_options *options, double *above, double *below);

  /** Count the nodes of a surface at which its outward normal and that of an
   * obstacle point the same way, and those of them behind which, within
   * @p depth along the inward normal, the obstacle's material is.
   *
   * @param wanted [n_nodes] nonzero: counts; NULL: all
   * @param same out
   * @param material out
   *
   * Errors as abut_obstacle_distance(). 32 distances for each node. */
  ABUT_API abut_status abut_obstacle_faces_away(abut_obstacle *obstacle,
                                                abut_surface *surface,
                                                const uint8_t *wanted,
                                                double depth, int32_t *same,
                                                int32_t *material);

  /** Whether a surface bends by more than @p angle (radian in (0, pi]) between
   * two facets, one of which has a marked node [n_nodes]. O(n). */
  ABUT_API abut_status abut_surface_bends(abut_surface *surface, double angle,
                                          const uint8_t *marked, bool *bends);

  /** The pair whose point is nearest to each node of the secondary, by the
   * magnitude of the first component; of equal distances, to 1e-8, the first.
   *
   * @param gap [n_components]
   * @param n_nodes of the caller
   * @param pair [n_nodes] out; -1: no point is at the node */
  ABUT_API abut_status abut_points_nearest_pair(const abut_points *points,
                                                const double *gap,
                                                int32_t n_nodes, int32_t *pair);

#ifdef __cplusplus
}
#endif

#endif
