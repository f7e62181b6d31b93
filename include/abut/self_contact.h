/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SELF_CONTACT_H
#define ABUT_SELF_CONTACT_H

/** @file
 * A surface that touches itself, as two surfaces.
 *
 * If every facet could be secondary and primary at once, contact would be
 * constrained twice over. So facets that face each other are put on different
 * sides, facets that hang together on the same side as far as that goes, and
 * the two sides are coupled like those of two bodies.
 */

#include <abut/context.h>
#include <abut/export.h>
#include <abut/surface.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Options of a split. */
  typedef struct abut_split_options
  {
    size_t struct_size;    /**< sizeof(abut_split_options) */
    double reach;          /**< length >= 0, as in abut_search_options; 0 */
    double relative_reach; /**< as in abut_search_options; 0.5 */
    /** Largest cosine of the angle between the normals of facets that face
     * each other, in [-1, 1]; -0.17 */
    double normal_cosine;
    /** Thickness of the thinnest part of the body, length: facets that are
     * deeper behind each other than half of it are its two skins. 0 (default):
     * the least depth, above a tenth of the facets' size, at which a facet
     * lies behind another one. */
    double thickness;
    /** [n_facets] sides so far, or NULL (default): they stay unless two facets
     * that face each other within @ref near are on one side. Then the surface
     * is split again, but only if the nearest of them are then twice as far
     * apart, and farther than relative_reach. The nearest facets that were on
     * different sides keep theirs, so that rows in contact stay on their nodes.
     */
    const uint8_t *previous;
    double near; /**< length >= 0; 0: facets that touch or overlap only */
  } abut_split_options;

  /** Default options. */
  static inline abut_split_options abut_split_defaults(void)
  {
    const abut_split_options options = {
        sizeof(abut_split_options), 0., 0.5, -0.17, 0., NULL, 0.};
    return options;
  }

  /** Findings of a split. */
  typedef struct abut_split_report
  {
    size_t struct_size;  /**< sizeof(abut_split_report) */
    int64_t n_pairs;     /**< pairs of facets that face each other in reach */
    int64_t n_skins;     /**< pairs left out: two skins of a thin part */
    int64_t n_conflicts; /**< of n_pairs, on one side all the same: three flanks
                              that face each other cannot be on two sides */
    double thickness;    /**< as given, or as found; 0: no thin part in reach */
    int64_t n_met;       /**< of n_pairs, within near and on one side so far */
  } abut_split_report;

  /** Put each facet of a surface on a side, at the current positions.
   *
   * Pairs of facets within reach with opposed normals and no common node, not
   * through the body, are taken in the order of their distance, what is beside
   * their normals counted twice; then facets with a common node in the order of
   * their numbers; each takes effect unless those before have settled the
   * matter. Among the parts that this leaves apart, the facet with the smallest
   * number is secondary. The result depends on numbers, positions and the sides
   * so far only.
   *
   * @param surface with numbers of nodes, or distinct nodes
   * @param side [n_facets] out: 0 secondary, 1 primary
   * @param report may be NULL
   *
   * O(n log n); not collective. */
  ABUT_API abut_status
  abut_surface_split_sized(abut_context *context, abut_surface *surface,
                           const abut_split_options *options, uint8_t *side,
                           abut_split_report *report);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_surface_split(abut_context *context, abut_surface *surface,
                     const abut_split_options *options, uint8_t *side,
                     abut_split_report *report)
  {
    if (report != NULL)
      report->struct_size = sizeof(*report);
    return abut_surface_split_sized(context, surface, options, side, report);
  }

#ifdef __cplusplus
}
#endif

#endif
