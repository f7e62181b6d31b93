/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_INTERFACE_H
#define ABUT_INTERFACE_H

/** @file
 * A pair: two surfaces, or a surface and an obstacle, whose points have one
 * kinematics. It knows the numbers that the caller has for the nodes and facets
 * of its surfaces, moves these to where points are made, and gives the points
 * their places.
 *
 * The caller numbers the nodes of all surfaces together; a side may be a part
 * of what it knows. Gaps, weights and directions are those of
 * abut_coupling_build().
 */

#include <abut/contact_measures.h>
#include <abut/contact_motion.h>
#include <abut/coupling.h>
#include <abut/detect.h>
#include <abut/places.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Options of a pair. */
  typedef struct abut_interface_options
  {
    size_t struct_size; /**< sizeof(abut_interface_options) */
    /** Coupling of the sides. Left to the interface are: interpolated gaps,
     * which points of bodies do not have that go on from the last step, and the
     * skin of a search where bodies are displaced: one facet, if it is 0. */
    abut_coupling_options coupling;
    abut_kinematics kinematics; /**< default: reference */
    int32_t number;             /**< of the pair, in places; default 0 */
    bool tangents;              /**< as in abut_coupling_target */
    bool flush;                 /**< likewise */
    double facet_size; /**< median of both surfaces, length; for the skin */
    /** Numbers of nodes and facets by the caller, copied; NULL: their own, and
     * nodes of the primary follow those of the secondary. */
    const int32_t *secondary_node;
    const int32_t *primary_node;    /**< [n_nodes of the primary] */
    const int32_t *secondary_facet; /**< [n_facets of the secondary] */
  } abut_interface_options;

  /** Default options. */
  static inline abut_interface_options abut_interface_defaults(void)
  {
    const abut_interface_options options = {sizeof(abut_interface_options),
                                            abut_coupling_defaults(),
                                            ABUT_KINEMATICS_REFERENCE,
                                            0,
                                            false,
                                            false,
                                            0.,
                                            NULL,
                                            NULL,
                                            NULL};
    return options;
  }

  /** Opaque pair. */
  typedef struct abut_interface abut_interface;

  /** Create a pair of a surface with another one, or with an obstacle: one of
   * the two is NULL. All must outlive it; the surfaces stand in the reference
   * configuration. Errors as abut_coupling_create(). */
  ABUT_API abut_status abut_interface_create(
      abut_context *context, abut_surface *secondary, abut_surface *primary,
      abut_obstacle *obstacle, const abut_interface_options *options,
      abut_interface **made);

  /** Destroy a pair and set the handle to NULL. The surfaces stay where they
   * are. */
  ABUT_API abut_status abut_interface_destroy(abut_interface **pair);

  /** The coupling of the two sides: its search and its statistics. */
  ABUT_API abut_coupling *abut_interface_coupling(abut_interface *pair);

  /** Move the surfaces to positions [n_nodes * dimension] of the caller's
   * nodes; NULL: back to the reference configuration. */
  ABUT_API abut_status abut_interface_move(abut_interface *pair,
                                           int32_t n_nodes,
                                           const double *position);

  /** Points to be made. */
  typedef struct abut_interface_target
  {
    size_t struct_size;               /**< sizeof(abut_interface_target) */
    abut_points *points;              /**< appended to */
    const abut_coupling_nodes *nodes; /**< NULL: defaults */
    const int64_t *id;                /**< as in abut_coupling_target */
    double motion;                    /**< as in abut_coupling_build() */
    double gap;                       /**< added to gaps, length */
    uint32_t tie_axes;                /**< as in abut_coupling_target */
    int32_t n_nodes;                  /**< of the caller */
    /** [n_nodes * dimension] displacements that points are made at: where gaps
     * do not refer to the reference configuration, their origin. The surfaces
     * stand there, unless partners are those of the reference configuration.
     * NULL: 0. */
    const double *displacement;
  } abut_interface_target;

  /** Points of contact, without displacement. */
  static inline abut_interface_target
  abut_interface_target_defaults(abut_points *points)
  {
    const abut_interface_target target = {
        sizeof(abut_interface_target), points, NULL, NULL, 0., 0., 0, 0, NULL};
    return target;
  }

  /** Append the points of the pair, with their places. Errors as
   * abut_coupling_build(); then nothing is appended. */
  ABUT_API abut_status abut_interface_build(
      abut_interface *pair, const abut_interface_target *target);

  /** Distance of the surfaces around the points of a pair of bodies, where the
   * surfaces stand: the least gap at the nodes of a point's stencil, those of
   * the secondary with the facets around them, and at its points of
   * integration. Nodes deeper than the facet size are on the other side of a
   * body and do not count.
   *
   * @param points with places; those of other pairs are left alone
   * @param detection options; the reach is at least @p reach, length
   * @param gap added to distances, length
   * @param n_nodes of the caller
   * @param clearance [n_components] out: of first components; infinite: not
   *   known */
  ABUT_API abut_status abut_interface_clearances(
      abut_interface *pair, const abut_points *points,
      const abut_detection_options *detection, double reach, double gap,
      int32_t n_nodes, double *clearance);

  /** Rotation of the directions of the forces of points since these were made:
   * between bodies that of the normals of the primary's facets for nearest
   * points, else of the secondary's; at an obstacle that of its gradient.
   * Points that are closed count, by the magnitude of their force; ties do not.
   * The surfaces are in the reference configuration afterwards.
   *
   * @param nodes with displacements; the numbers of their pairs are the pairs'
   * @param value [n_components] pressures
   * @param state [n_components] abut_state; NULL: nothing is closed
   * @param change out */
  ABUT_API abut_status abut_interface_rotation(abut_interface *pair,
                                               const abut_points *points,
                                               const abut_node_positions *nodes,
                                               const double *value,
                                               const uint8_t *state,
                                               abut_direction_change *change);

#ifdef __cplusplus
}
#endif

#endif
