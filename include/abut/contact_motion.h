/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONTACT_MOTION_H
#define ABUT_CONTACT_MOTION_H

/** @file
 * Motion of contact since its points were made: displacements of the two sides
 * at the points, and rotations of directions and of facets.
 */

#include <abut/export.h>
#include <abut/points.h>
#include <abut/surface.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Sides of the stencil of a point, bits. */
  typedef enum abut_point_sides
  {
    ABUT_SIDE_SECONDARY = 1, /**< c_l = D_l / W */
    ABUT_SIDE_PRIMARY = 2,   /**< c_l = -M_l / W */
    ABUT_SIDE_BOTH = 3
  } abut_point_sides;

  /** sum_l c_l v_l over nodes of the stencils of @p n points: of displacements
   * of one side, its displacement at the point (the primary's with the opposite
   * sign); of both, the secondary's relative to the primary.
   *
   * @param point [n] numbers of points
   * @param value [n_nodes * dimension] v_l; all nodes are below n_nodes
   * @param sum [n * dimension] out */
  ABUT_API abut_status abut_points_sum(const abut_points *points,
                                       abut_point_sides sides, int32_t n,
                                       const int32_t *point, int32_t n_nodes,
                                       const double *value, double *sum);

  /** Change of the directions of forces. */
  typedef struct abut_direction_change
  {
    double force;     /**< sum of the magnitudes */
    double sum;       /**< of force times angle, radian */
    double largest;   /**< angle, radian in [0, pi] */
    double change[3]; /**< of the resultant of the forces */
  } abut_direction_change;

  /** Add @p n forces.
   *
   * @param magnitude [n] >= 0
   * @param before [n * dimension] directions of any length
   * @param after [n * dimension]
   * @param change accumulated; zero at first
   *
   * INVALID_ARGUMENT for a NULL, n < 0 or a dimension other than 2, 3. */
  ABUT_API abut_status abut_direction_change_add(int32_t dimension, int32_t n,
                                                 const double *magnitude,
                                                 const double *before,
                                                 const double *after,
                                                 abut_direction_change *change);

  /** Largest angle between the normals of a facet at two sets of positions, by
   * its first corners, radian in [0, pi]. Only facets with a marked node count;
   * 0 without one.
   *
   * @param marked [n_nodes]
   * @param before [n_nodes * dimension]
   * @param after [n_nodes * dimension]
   * @param angle out */
  ABUT_API abut_status abut_surface_rotation(const abut_surface *surface,
                                             const uint8_t *marked,
                                             const double *before,
                                             const double *after,
                                             double *angle);

#ifdef __cplusplus
}
#endif

#endif
