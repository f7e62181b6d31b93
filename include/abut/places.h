/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_PLACES_H
#define ABUT_PLACES_H

/** @file
 * Where contact points belong: the pair of surfaces, the node or facet of the
 * secondary, the position, and what their forces change by as nodes move.
 *
 * Places are given after their points (abut_interface_build() does so), and
 * follow them: abut_points_filter(), abut_points_renumber() and
 * abut_points_clear() change both. Either all points of a set have a place, or
 * none.
 */

#include <abut/points.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** The place of a point; arrays are copied. */
  typedef struct abut_place
  {
    size_t struct_size;     /**< sizeof(abut_place) */
    int32_t pair;           /**< number of the pair, >= 0 */
    int32_t node;           /**< node of the secondary; -1: quadrature point */
    int32_t facet;          /**< facet of a quadrature point; else -1 */
    int32_t n_lines;        /**< see block */
    const double *position; /**< [dimension] where the point sits */
    double least; /**< see abut_coupling_view::least; infinite: not known */
    const int32_t *line;   /**< [n_lines] nodes */
    const int32_t *column; /**< [n_columns] nodes */
    int32_t n_columns;     /**< 0: the block is square */
    int32_t reserved;      /**< 0 */
    /** Derivatives of the derivatives of each component, one matrix after the
     * other, or NULL: the point is fixed. With columns: dimension rows for each
     * node of line, dimension columns for each node of column. Without: square,
     * by the position of the point, which is the sum of the secondary's part of
     * the stencil, then by the nodes of line. */
    const double *block;
  } abut_place;

  /** A fixed point of pair 0 at no node. */
  static inline abut_place abut_place_defaults(void)
  {
    const abut_place place = {sizeof(abut_place), 0,    -1,   -1, 0, NULL,
                              1e300 * 1e300,      NULL, NULL, 0,  0, NULL};
    return place;
  }

  /** Give the first point that has no place one. */
  ABUT_API abut_status abut_points_append_place(abut_points *points,
                                                const abut_place *place);

  /** Read-only view of the places of all points; valid until the next change.
   * The nodes of lines of point i are line[line_start[i]] .., and likewise of
   * columns; its blocks have together block_start[i + 1] - block_start[i]
   * entries. */
  typedef struct abut_places_view
  {
    size_t struct_size;          /**< sizeof(abut_places_view) */
    int32_t n_points;            /**< points with places */
    int32_t n_pairs;             /**< all pairs are below */
    int32_t n_nodes;             /**< all nodes of points are below */
    int32_t reserved;            /**< 0 */
    const int32_t *pair;         /**< [n_points] */
    const int32_t *node;         /**< [n_points] */
    const int32_t *facet;        /**< [n_points] */
    const double *position;      /**< [n_points * dimension] */
    const double *least;         /**< [n_points] */
    const int64_t *line_start;   /**< [n_points + 1] */
    const int32_t *line;         /**< [line_start[n_points]] */
    const int64_t *column_start; /**< [n_points + 1] */
    const int32_t *column;       /**< [column_start[n_points]] */
    const int64_t *block_start;  /**< [n_points + 1] */
    const double *block;         /**< [block_start[n_points]] */
  } abut_places_view;

  /** View of the places. INVALID_ARGUMENT if some point has none. O(points). */
  ABUT_API abut_status abut_points_get_places_sized(const abut_points *points,
                                                    abut_places_view *view);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_points_get_places(const abut_points *points,
                                                   abut_places_view *view)
  {
    if (view != NULL)
      view->struct_size = sizeof(*view);
    return abut_points_get_places_sized(points, view);
  }

  /** Give the facets of quadrature points new numbers: facet f becomes
   * @p number [n_facets] [f], -1: not known any more. */
  ABUT_API abut_status abut_points_renumber_facets(abut_points *points,
                                                   int32_t n_facets,
                                                   const int32_t *number);

  /** Derivative of the force of a point by its nodes, up to the sign: the sum
   * of its blocks, times its weight and @p value [n_components] (NULL: of the
   * blocks alone).
   *
   * @param sum [entries of a block] out
   * @param n out, entries; 0: there is no block, or all values are 0 */
  ABUT_API abut_status abut_points_force_block(const abut_points *points,
                                               int32_t point,
                                               const double *value, double *sum,
                                               int64_t *n);

  /** Changes of points from one set to a later one. */
  typedef struct abut_place_changes
  {
    int64_t lost;   /**< points that the later set does not have */
    int64_t jumped; /**< points that have another side opposite: no node of the
                         facet in common, or normals 30 degrees apart */
  } abut_place_changes;

  /** Count the changes of points with a nearest point on a facet whose first
   * component @p wanted [n_points of before] is nonzero. Points are known by
   * the number of their first component. O(n log n). */
  ABUT_API abut_status abut_points_count_changes(const abut_points *before,
                                                 const abut_points *now,
                                                 const uint8_t *wanted,
                                                 abut_place_changes *changes);

#ifdef __cplusplus
}
#endif

#endif
