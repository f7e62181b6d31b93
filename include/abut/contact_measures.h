/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONTACT_MEASURES_H
#define ABUT_CONTACT_MEASURES_H

/** @file
 * Measures of the points of pairs: forces, moments, areas and extremes; motion
 * of the two sides against each other; and marks of the nodes that points are
 * at. Sums and extremes over processes are the caller's.
 */

#include <abut/kinematics.h>
#include <abut/places.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Where the nodes of points are. */
  typedef struct abut_node_positions
  {
    size_t struct_size;      /**< sizeof(abut_node_positions) */
    int32_t n_nodes;         /**< all nodes are below */
    int32_t n_pairs;         /**< all pairs are below */
    const double *reference; /**< [n_nodes * dimension] */
    /** [n_nodes * dimension] where points were made of pairs whose kinematics
     * displaces them; NULL: the reference. */
    const double *made;
    /** [n_nodes * dimension] of the present; NULL: as where points were made.
     */
    const double *displacement;
    const abut_kinematics *kinematics; /**< [n_pairs] */
  } abut_node_positions;

  /** Forces on a side of a pair. */
  typedef struct abut_side_forces
  {
    double force[3];          /**< sum of the forces */
    double moment[3];         /**< about the origin, where points were made */
    double present_moment[3]; /**< the same in the current configuration */
  } abut_side_forces;

  /** Sums over the points of a pair. */
  typedef struct abut_contact_sums
  {
    int64_t n_rows;          /**< components but for tangents */
    int64_t n_active;        /**< of these, not open */
    double covered_area;     /**< sum of weights */
    double contact_area;     /**< of points that are not open */
    double pressure;         /**< largest, >= 0 */
    double least_pressure;   /**< of closed points, ties left out; infinite */
    double largest_tension;  /**< >= 0, ties left out */
    double penetration;      /**< largest, length >= 0; ties: of both signs */
    double initial_gap_work; /**< of pressures of fixed points on their gaps */
    abut_side_forces secondary; /**< on the secondary surface */
    abut_side_forces primary;   /**< on the primary surface */
  } abut_contact_sums;

  /** Measure the points of each pair.
   *
   * @param value [n_components] pressures, and tractions on the secondary
   * @param gap [n_components] length
   * @param state [n_components] abut_state; NULL: nothing is solved, points
   *   with a pressure are closed
   * @param sums out, [n_pairs]
   *
   * O(components + entries). */
  ABUT_API abut_status abut_points_measure(const abut_points *points,
                                           const abut_node_positions *nodes,
                                           const double *value,
                                           const double *gap,
                                           const uint8_t *state,
                                           abut_contact_sums *sums);

  /** Motion at points.
   *
   * @param relative [n_points * dimension] out: of the secondary against the
   *   primary since they were paired, or since the step began: from the
   *   configuration that points are made in; where partners stay while
   *   directions change, how far the two are apart, for a rotation of both
   *   sides is no slip. NULL: not wanted
   * @param since [n_points * dimension] out: since the point was made. NULL:
   * not wanted */
  ABUT_API abut_status abut_points_motion(const abut_points *points,
                                          const abut_node_positions *nodes,
                                          double *relative, double *since);

  /** Mark the nodes of the secondary in the stencils of points.
   *
   * @param state [n_components]: of points with a component that is not open;
   *   NULL: of all
   * @param marks [n_pairs * n_nodes] set to 1 there, else unchanged */
  ABUT_API abut_status abut_points_mark_nodes(const abut_points *points,
                                              const uint8_t *state,
                                              int32_t n_pairs, int32_t n_nodes,
                                              uint8_t *marks);

#ifdef __cplusplus
}
#endif

#endif
