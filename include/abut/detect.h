/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_DETECT_H
#define ABUT_DETECT_H

/** @file
 * Contact detection: which facet of the primary surface each node of the
 * secondary surface may touch, and where.
 *
 * A node is paired with the nearest facet of the primary surface that is within
 * reach, faces it, is not its own neighbourhood, and does not lie on the far
 * side of a body. Both surfaces may be the same one (self contact). The pairing
 * is kept between calls, so that a change of connectivity can be distinguished
 * from mere sliding on the same facet.
 *
 * Signs: the gap is positive where the node is on the outward side of the
 * facet (open), negative where it has penetrated.
 */

#include <abut/search.h>
#include <abut/surface.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Opaque detection. */
  typedef struct abut_detection abut_detection;

  /** Options of a detection. */
  typedef struct abut_detection_options
  {
    size_t struct_size; /**< sizeof(abut_detection_options) */
    /** Reach, algorithm, skin. A facet that is farther than its reach is no
     * partner. */
    abut_search_options search;
    /** Largest cosine of the angle between the normals of node and facet, in
     * [-1, 1]; default -0.17: the surfaces face each other within 80 degrees.
     */
    double normal_cosine;
    /** How far, in sizes of the facet, a node may lie beyond the border of the
     * primary surface and still be paired with a facet there, >= 0; default
     * 0.1. Sides with a neighbour are no border. */
    double extension;
    /** Exclude, beside the facets of the node itself, those that share a node
     * with them; always done when both surfaces are one. Default false. */
    bool self_contact;
    /** Groups of the primary surface whose bodies have a thickness, and the
     * thickness of each, length > 0: a node deeper than half of it is on the
     * wrong side and not paired. Copied. Other groups have no limit. */
    int32_t n_thicknesses;
    const int32_t *thickness_group; /**< [n_thicknesses] */
    const double *thickness;        /**< [n_thicknesses] */
  } abut_detection_options;

  /** Default options. */
  static inline abut_detection_options abut_detection_defaults(void)
  {
    const abut_detection_options options = {sizeof(abut_detection_options),
                                            abut_search_defaults(),
                                            -0.17,
                                            0.1,
                                            false,
                                            0,
                                            NULL,
                                            NULL};
    return options;
  }

  /** Create a detection between two surfaces (or one and itself), which must
   * outlive it. Node numbers exclude own facets if both surfaces are the same
   * object or both were given numbers. */
  ABUT_API abut_status abut_detection_create(
      abut_context *context, abut_surface *secondary, abut_surface *primary,
      const abut_detection_options *options, abut_detection **detection);

  /** Destroy a detection and set the handle to NULL. */
  ABUT_API abut_status abut_detection_destroy(abut_detection **detection);

  /** Pair two groups: nodes of facets of @p secondary_group with facets of @p
   * primary_group. Without any call all groups are paired; the first call
   * leaves only the named ones. At most 64 different primary groups
   * (UNSUPPORTED). O(n). */
  ABUT_API abut_status abut_detection_pair_groups(abut_detection *detection,
                                                  int32_t secondary_group,
                                                  int32_t primary_group);

  /** Detect at the current positions.
   *
   * @param motion length >= 0: largest relative motion of the surfaces since
   *   the last call (over all processes); the reach is at least 1.5 times as
   *   large. 0 if unknown.
   *
   * About 200 ns per node; allocates nothing once warmed up. */
  ABUT_API abut_status abut_detection_run(abut_detection *detection,
                                          double motion);

/** Why a candidate was not taken: name, text. Looked for in this order. */
#define ABUT_REJECTION_LIST(X)                                                 \
  X(GROUP, "groups are not paired")                                            \
  X(FACING_AWAY, "normals do not oppose each other")                           \
  X(OWN_NODE, "the facet has the node among its own")                          \
  X(NEIGHBOUR, "the facet is a neighbour of the node's own facets")            \
  X(BEYOND_REACH, "the nearest point is farther than the reach")               \
  X(BEYOND_BORDER, "the node lies beyond the border of the surface")           \
  X(WRONG_SIDE, "the node is deeper than half the body's thickness")           \
  X(COSTLIER, "another facet is nearer")

  /** Reasons. */
  typedef enum abut_rejection
  {
/** @cond */
#define ABUT_REJECTION_ENTRY(name, text) ABUT_REJECTION_##name,
    /** @endcond */
    ABUT_REJECTION_LIST(ABUT_REJECTION_ENTRY)
#undef ABUT_REJECTION_ENTRY
    /** Number of reasons; not a reason. */
    ABUT_REJECTION_N
  } abut_rejection;

  /** English text of a reason; never NULL. */
  ABUT_API const char *abut_rejection_text(abut_rejection reason);

  /** Contact element of a node: its facet and where on it. All but the facet
   * is zero for a node without one. */
  typedef struct abut_contact
  {
    double gap;       /**< signed normal distance, length */
    double distance;  /**< distance to the nearest point, >= 0 */
    double local[2];  /**< local coordinates of the nearest point in the facet
                           (2D: the second is 0) */
    double normal[3]; /**< unit outward normal of the facet there (2D: third
                           component 0) */
    int32_t facet;    /**< facet of the primary surface, or -1 */
    int32_t reserved; /**< 0 */
  } abut_contact;

  /** Read-only result of the last run; lives until the next run. */
  typedef struct abut_detection_view
  {
    size_t struct_size;          /**< sizeof(abut_detection_view) */
    int32_t n_nodes;             /**< nodes of the secondary surface */
    const abut_contact *contact; /**< [n_nodes] */
    int32_t changed;     /**< nonzero: some node's facet is another than in the
                              run before (in the first run: any node is paired) */
    int32_t n_paired;    /**< nodes with a facet */
    int32_t n_gained;    /**< nodes that had none before */
    int32_t n_lost;      /**< nodes that had one before */
    int32_t n_exchanged; /**< nodes with another one than before */
    int32_t searched;    /**< nonzero: lists were made, not reused */
    double reach;        /**< absolute part of the reach in use, length */
    const int64_t *rejected; /**< [ABUT_REJECTION_N] candidates not taken, by
                                  reason */
    int64_t n_candidates;    /**< candidates in all */
  } abut_detection_view;

  /** View of the result. */
  ABUT_API abut_status abut_detection_get_sized(const abut_detection *detection,
                                                abut_detection_view *view);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_detection_get(const abut_detection *detection,
                                               abut_detection_view *view)
  {
    if (view != NULL)
      view->struct_size = sizeof(*view);
    return abut_detection_get_sized(detection, view);
  }

  /** The search inside, for its statistics. */
  ABUT_API const abut_search *
  abut_detection_search(const abut_detection *detection);

  /** Report for a check before solving. */
  typedef struct abut_detection_report
  {
    size_t struct_size;    /**< sizeof(abut_detection_report) */
    int32_t n_nodes;       /**< secondary nodes in paired groups */
    int32_t n_paired;      /**< of these, with a facet */
    double area;           /**< secondary area that belongs to these nodes (each
                                node has an equal share of its facets) */
    double uncovered_area; /**< part of it at nodes without a facet */
    int32_t n_overlaps;    /**< paired nodes with a negative gap beyond 1e-10 of
                                the facet's size */
    double largest_overlap; /**< largest penetration, >= 0 */
    int32_t deepest_node;   /**< where, or -1 */
    /** Nodes without a facet although some were within reach, all of them with
     * normals that point the same way as the node's: inverted surfaces. */
    int32_t n_reversed;
    double size_ratio; /**< median facet size of secondary by primary; 0 if
                            either is empty. Far above 1: the secondary is
                            coarser, primary facets may pass between nodes */
  } abut_detection_report;

  /** Report on the last run. O(n). */
  ABUT_API abut_status abut_detection_make_report_sized(
      abut_detection *detection, abut_detection_report *report);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_detection_make_report(abut_detection *detection,
                             abut_detection_report *report)
  {
    if (report != NULL)
      report->struct_size = sizeof(*report);
    return abut_detection_make_report_sized(detection, report);
  }

#ifdef __cplusplus
}
#endif

#endif
