/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_MISSED_CONTACT_H
#define ABUT_MISSED_CONTACT_H

/** @file
 * Missed contact: nodes of one surface that are inside the body of the other
 * one, or behind it, although no constraint keeps them out.
 *
 * Detection finds nodes near the other surface. A node that has gone through a
 * thin body within one step is far from the facet that it went through, or near
 * the wrong skin; it is found by the path of the node relative to the facet.
 */

#include <abut/context.h>
#include <abut/detect.h>
#include <abut/export.h>
#include <abut/obstacle.h>
#include <abut/surface.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Properties of a node, bits. */
  typedef enum abut_node_mark
  {
    ABUT_NODE_OWNED = 1, /**< is reported; others are of other processes */
    ABUT_NODE_HELD = 2,  /**< has a constraint, or needs none */
    /** Has no constraint, because supports prescribe its displacement. */
    ABUT_NODE_PRESCRIBED = 4
  } abut_node_mark;

  /** Options. */
  typedef struct abut_missed_options
  {
    size_t struct_size; /**< sizeof(abut_missed_options) */
    /** Detection on the deformed surfaces, with its reach. The
     * extension is not used: nodes beyond a border are outside. */
    abut_detection_options detection;
    /** Added to the distance of the surfaces, length: > 0 clearance, < 0
     * interference. Default 0. */
    double gap;
    double tolerance; /**< allowed depth, length >= 0; default 0 */
    /** Thickness of the primary's body, length >= 0. Nodes deeper than half of
     * it are near the wrong skin. 0 (default): not known. */
    double primary_thickness;
    double secondary_thickness; /**< the same of the secondary's body */
    /** Constraints cover whole facets of the secondary: nodes of the primary
     * in a facet without one are missed. Default false: constraints at single
     * nodes, between which the primary may enter. */
    bool covers_facets;
    /** Thickness of the body behind each side (secondary, primary) of a surface
     * that touches itself, length > 0: then each side is also compared with
     * itself. 0 (default): it is not. */
    double side_thickness[2];
    /** [n_nodes * dimension] Positions at the beginning of the step. If no node
     * is found inside, paths from there through a facet are looked for. NULL
     * (default): they are not. */
    const double *secondary_start;
    const double *primary_start; /**< the same of the primary */
  } abut_missed_options;

  /** Default options. */
  static inline abut_missed_options abut_missed_defaults(void)
  {
    const abut_missed_options options = {sizeof(abut_missed_options),
                                         abut_detection_defaults(),
                                         0.,
                                         0.,
                                         0.,
                                         0.,
                                         false,
                                         {0., 0.},
                                         NULL,
                                         NULL};
    return options;
  }

  /** A node without a constraint that is inside the other body, or behind it.
   */
  typedef struct abut_missed_node
  {
    int32_t node;       /**< of its surface */
    int32_t on_primary; /**< nonzero: of the primary surface */
    int32_t same_side;  /**< nonzero: inside the side that it belongs to */
    int32_t reserved;   /**< 0 */
    double depth;       /**< beyond the gap of the pair, length */
  } abut_missed_node;

  /** Number of nodes found, and depths of owned nodes that are not missed,
   * length >= 0. */
  typedef struct abut_missed_report
  {
    size_t struct_size;    /**< sizeof(abut_missed_report) */
    int32_t n;             /**< missed nodes */
    double prescribed;     /**< of prescribed nodes of the secondary */
    double held_in_mean;   /**< of held nodes of the secondary */
    double between_points; /**< of nodes of the primary between constraints */
  } abut_missed_report;

  /** Find the missed nodes of a pair of surfaces in the current configuration.
   *
   * Nodes of the secondary are missed if they are owned, not held, and deeper
   * than the tolerance. Nodes of the primary are missed if they are owned, and
   * deeper than that in a facet of the secondary without a held node, where
   * constraints cover facets.
   *
   * Paths: nodes go on straight lines past each facet as it is at the start, by
   * their displacement relative to the mean of its corners. This is exact for
   * facets that do not rotate. A node counts if it goes in through the facet,
   * against its own normal, and ends deeper than the tolerance behind the
   * plane of the facet.
   *
   * @param secondary_marks [n_nodes] sums of abut_node_mark
   * @param primary_marks [n_nodes]
   * @param nodes out, room for twice the nodes of both surfaces: first of the
   *   secondary, then of the primary, then of sides inside themselves, each
   *   ascending
   * @param report out
   *
   * O((n + m) log m). Not collective; surfaces only read. */
  ABUT_API abut_status abut_missed_contact_sized(
      abut_context *context, abut_surface *secondary, abut_surface *primary,
      const uint8_t *secondary_marks, const uint8_t *primary_marks,
      const abut_missed_options *options, abut_missed_node *nodes,
      abut_missed_report *report);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_missed_contact(abut_context *context, abut_surface *secondary,
                      abut_surface *primary, const uint8_t *secondary_marks,
                      const uint8_t *primary_marks,
                      const abut_missed_options *options,
                      abut_missed_node *nodes, abut_missed_report *report)
  {
    if (report != NULL)
      report->struct_size = sizeof(*report);
    return abut_missed_contact_sized(context, secondary, primary,
                                     secondary_marks, primary_marks, options,
                                     nodes, report);
  }

  /** Result for a point on a straight path past an obstacle. */
  typedef struct abut_obstacle_path
  {
    double depth; /**< largest depth in the obstacle, length >= 0 */
    /** Nonzero: the path enters the obstacle and leaves it on another side:
     * the outward directions there are more than a right angle apart. */
    int32_t through;
    int32_t reserved; /**< 0 */
  } abut_obstacle_path;

  /** Follow n points on straight paths past an obstacle at its present pose.
   * Steps along a path are as long as the distance from the surface, and at
   * least a quarter of the obstacle's depth or 1/64 of the path, whichever is
   * less. A path that is shorter than the distance at its end meets nothing.
   *
   * @param from [n * dimension], as abut_obstacle_distance()
   * @param to [n * dimension]
   * @param path out, [n]
   *
   * Errors as abut_obstacle_distance(), with the number of the point among
   * those that are still followed. */
  ABUT_API abut_status abut_obstacle_follow(abut_obstacle *obstacle, int32_t n,
                                            const double *from,
                                            const double *to,
                                            abut_obstacle_path *path);

#ifdef __cplusplus
}
#endif

#endif
