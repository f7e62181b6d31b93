/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_FRICTION_POINTS_H
#define ABUT_FRICTION_POINTS_H

/** @file
 * Contact points with friction: forces and work of the pairs that they belong
 * to, and points of several pairs at one node, as in a corner. Points have
 * places (abut/places.h).
 */

#include <abut/export.h>
#include <abut/places.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Sums over the points of a pair, ties left out. */
  typedef struct abut_friction_sums
  {
    double normal_force;   /**< of the pressures */
    double friction_force; /**< of the magnitudes of the tractions */
    double traction;       /**< largest magnitude */
    double dissipation; /**< work of the tractions of slipping points, >= 0 */
    double force[3];    /**< of the tractions on the secondary */
    /** Normal force of sticking points with tangents at nodes where more than
     * one point is closed. */
    double shared_stick_force;
    int64_t n_slipping; /**< points */
  } abut_friction_sums;

  /** Sums of each pair.
   *
   * @param n_pairs the pairs of all points are below
   * @param value [n_components] pressures, and tractions on the secondary
   * @param slip [n_components] slips of tangents, length
   * @param state [n_components] abut_state of the normals; NULL: no point is
   *   closed
   * @param sums out, [n_pairs]
   *
   * O(components). */
  ABUT_API abut_status abut_points_friction(
      const abut_points *points, int32_t n_pairs, const double *value,
      const double *slip, const uint8_t *state, abut_friction_sums *sums);

  /** Properties of a pair, bits. */
  typedef enum abut_pair_mark
  {
    /** Points do not move along a rigid obstacle. */
    ABUT_PAIR_FIXED_POINTS = 1,
    ABUT_PAIR_FRICTION = 2 /**< points have friction */
  } abut_pair_mark;

  /** Mark points that are behind another point of the same node and normal, one
   * of which has friction: both gaps change by the same amount, so that one of
   * them never closes. The later one of points with equal gaps is behind. Both
   * pairs have fixed points.
   *
   * @param marks [n_pairs] sums of abut_pair_mark
   * @param keep [n_components] changed: 0 for the components of such points
   *
   * O(points), if few points share a node. */
  ABUT_API abut_status abut_points_cover(const abut_points *points,
                                         int32_t n_pairs, const uint8_t *marks,
                                         uint8_t *keep);

  /** Normals of other points of contact at the nodes of @p n points.
   *
   * @param first [n] components of their normals, ascending
   * @param n_rivals out, number of results
   * @param rival_point out, [n_rivals] place in @p first, ascending; NULL: only
   *   the number is found
   * @param rival_row out, [n_rivals] component of the normal; or NULL */
  ABUT_API abut_status abut_points_rivals(const abut_points *points, int32_t n,
                                          const int32_t *first,
                                          int32_t *n_rivals,
                                          int32_t *rival_point,
                                          int32_t *rival_row);

#ifdef __cplusplus
}
#endif

#endif
