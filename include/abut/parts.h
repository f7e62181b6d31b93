/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_PARTS_H
#define ABUT_PARTS_H

/** @file
 * Surfaces in parts: what processes that hold parts of two surfaces need to
 * detect contact as one. The library knows no network; it makes the boxes and
 * finds the facets that the caller sends.
 *
 * For each process, with its part of the secondary and the primary surface
 * (all facets and nodes with numbers that are unique over all parts, nodes over
 * both surfaces):
 *
 *   1  agree on the largest reach H = max(reach, relative_reach * largest
 *      facet size) over all parts;
 *   2  gather the bounds of all parts: abut_surface_bounds() of the secondary,
 *      inflated by H;
 *   3  for each peer abut_search_select() the primary facets near its bounds;
 *   4  exchange them, with nodes, numbers and positions, and create one surface
 *      of those received and the own ones, each facet and node once, arranged
 *      by number;
 *   5  likewise with the secondary surface and the bounds inflated by 0: the
 *      facets around the own nodes complete their normals;
 *   6  detect. For nodes of own facets the result is that of the undivided
 *      surfaces, bit for bit, if those were numbered in ascending order.
 */

#include <abut/search.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Box parallel to the axes; in 2D the third components are 0. */
  typedef struct abut_box
  {
    double lower[3]; /**< smallest coordinates */
    double upper[3]; /**< largest coordinates */
  } abut_box;

  /** Boxes that together contain all facets of a surface, inflated by @p
   * reach: facets are halved across the longest extent of their centres, until
   * there are @p max_boxes groups.
   * @param reach length >= 0
   * @param max_boxes >= 1
   * @param boxes [max_boxes] out
   * @param n_boxes out: number of boxes, 0 for an empty surface
   * O(n log max_boxes + max_boxes^2). */
  ABUT_API abut_status abut_surface_bounds(abut_surface *surface, double reach,
                                           int32_t max_boxes, abut_box *boxes,
                                           int32_t *n_boxes);

  /** Facets of the search whose box, inflated by their reach, touches any of
   * the boxes.
   * @param facets [number of facets of the surface] out: ascending
   * @param n_facets out */
  ABUT_API abut_status abut_search_select(abut_search *search, int32_t n_boxes,
                                          const abut_box *boxes,
                                          int32_t *facets, int32_t *n_facets);

#ifdef __cplusplus
}
#endif

#endif
