/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_OBSTACLE_FACETS_H
#define ABUT_OBSTACLE_FACETS_H

/** @file
 * Obstacles between the nodes of facets: how deep they are in facets, whether
 * they have passed through, and how wide they are there.
 *
 * Positions are given for the nodes of a surface, which itself stands in the
 * reference configuration. Errors are those of abut_obstacle_distance().
 */

#include <abut/obstacle.h>
#include <abut/surface.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Facets to look at. */
  typedef struct abut_facet_samples
  {
    size_t struct_size; /**< sizeof(abut_facet_samples) */
    /** [n_nodes * dimension] current positions; NULL: those of the surface. */
    const double *position;
    /** [n_nodes * dimension] where the gaps of nodes are those of the obstacle;
     * NULL: where the surface is. */
    const double *made;
    const uint8_t *wanted; /**< [n_facets] nonzero: looked at; NULL: all */
    double gap;            /**< added to distances, length; default 0 */
    int32_t n;             /**< points along each edge, >= 1; default 1 */
    int32_t reserved;      /**< 0 */
  } abut_facet_samples;

  /** The middle of each facet. */
  static inline abut_facet_samples abut_facet_samples_defaults(void)
  {
    const abut_facet_samples samples = {
        sizeof(abut_facet_samples), NULL, NULL, NULL, 0., 1, 0};
    return samples;
  }

  /** A facet that an obstacle is in. */
  typedef struct abut_facet_depth
  {
    int32_t facet;    /**< of the surface */
    int32_t reserved; /**< 0 */
    double depth;     /**< of the deepest point, length > 0 */
    double size;      /**< longest distance of the first node to another */
    /** The part of the depth that the nodes do not see: at the points the gap
     * is that much smaller than at all nodes, where gaps are made. A hollow
     * curve through the nodes, by their normals, is taken off. */
    double peak;
    double place[3]; /**< of the deepest point */
  } abut_facet_depth;

  /** Find the facets that an obstacle is in.
   *
   * @param found out, room for all facets, ascending
   * @param n_found out
   *
   * Facets that are farther from the obstacle at all nodes than their size are
   * passed over, but for functions, whose value may be no distance. */
  ABUT_API abut_status
  abut_obstacle_in_facets(abut_obstacle *obstacle, abut_surface *surface,
                          const abut_facet_samples *samples,
                          abut_facet_depth *found, int32_t *n_found);

  /** Whether points of facets on straight paths pass through an obstacle, see
   * abut_obstacle_follow().
   *
   * @param samples their position is the end of the path
   * @param begin [n_nodes * dimension]
   * @param way out: length of the longest such path; 0: none */
  ABUT_API abut_status abut_obstacle_passes_facets(
      abut_obstacle *obstacle, abut_surface *surface,
      const abut_facet_samples *samples, const double *begin, double *way);

  /** An obstacle beside a facet. */
  typedef struct abut_obstacle_beside
  {
    double width;    /**< abut_obstacle_width(); infinite: no facet is near */
    double size;     /**< of the facet, length; 1 without one */
    double distance; /**< of the point from the middle of the facet */
    /** Nonzero: the point is above the facet, or below it by no more than the
     * width, and no farther aside than half of the size. */
    int32_t is_over;
    int32_t reserved; /**< 0 */
  } abut_obstacle_beside;

  /** The facet, among those that are near the obstacle by their size, for which
   * it is narrowest in relation to the size. */
  ABUT_API abut_status abut_obstacle_narrowest(
      abut_obstacle *obstacle, abut_surface *surface,
      const abut_facet_samples *samples, abut_obstacle_beside *result);

  /** The facet whose middle is nearest to a point [dimension]. */
  ABUT_API abut_status
  abut_obstacle_beside_facet(abut_obstacle *obstacle, abut_surface *surface,
                             const abut_facet_samples *samples,
                             const double *point, abut_obstacle_beside *result);

#ifdef __cplusplus
}
#endif

#endif
