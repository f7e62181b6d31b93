/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_ROWS_H
#define ABUT_ROWS_H

/** @file
 * Constraint rows: what every discretisation of contact produces and every
 * way of enforcing it consumes.
 *
 * Row i has a weight w_i (tributary area of its node, or volume for a volume
 * obstacle), a gap at displacement zero g0_i, and sparse coefficients
 * B_i = dg_i/du over unknowns: g_i(u) = g0_i + sum_k B_ik u_k. The contact
 * force on the unknowns is sum_i w_i p_i B_i.
 */

#include <abut/context.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Opaque set of rows; grows by appending. */
  typedef struct abut_rows abut_rows;

  /** Read-only view of the arrays of a set of rows; valid until the next
   * change. Row i has the entries row_start[i] .. row_start[i+1]-1. */
  typedef struct abut_rows_view
  {
    size_t struct_size;        /**< sizeof(abut_rows_view) */
    int32_t n_rows;            /**< number of rows */
    const int64_t *id;         /**< [n_rows] global number, unique and sorted */
    const double *weight;      /**< [n_rows] w > 0 */
    const double *initial_gap; /**< [n_rows] g0, length */
    const uint8_t *bilateral;  /**< [n_rows] nonzero: equality */
    const int64_t *row_start;  /**< [n_rows + 1] */
    const int64_t *column;     /**< [row_start[n_rows]] number of the unknown */
    const double *coefficient; /**< [row_start[n_rows]] dg/du */
  } abut_rows_view;

  /** Create an empty set. */
  ABUT_API abut_status abut_rows_create(abut_context *context,
                                        abut_rows **rows);

  /** Destroy a set and set the handle to NULL. */
  ABUT_API abut_status abut_rows_destroy(abut_rows **rows);

  /** Remove all rows and keep the memory. */
  ABUT_API abut_status abut_rows_clear(abut_rows *rows);

  /** Make room for @p n_rows rows with @p n_entries entries in all. */
  ABUT_API abut_status abut_rows_reserve(abut_rows *rows, int32_t n_rows,
                                         int64_t n_entries);

  /** Append a row; @p id must be larger than that of the last row, weight > 0,
   * all numbers finite. Amortised O(n_entries). */
  ABUT_API abut_status abut_rows_append(abut_rows *rows, int64_t id,
                                        double weight, double initial_gap,
                                        int bilateral, int32_t n_entries,
                                        const int64_t *column,
                                        const double *coefficient);

  /** View of the arrays. */
  ABUT_API abut_status abut_rows_get_sized(const abut_rows *rows,
                                           abut_rows_view *view);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_rows_get(const abut_rows *rows,
                                          abut_rows_view *view)
  {
    if (view != NULL)
      view->struct_size = sizeof(*view);
    return abut_rows_get_sized(rows, view);
  }

  /** gap_i = g0_i + sum_k B_ik u[column_k - offset]; all columns must lie in
   * [offset, offset + n_unknowns). */
  ABUT_API abut_status abut_rows_gap(const abut_rows *rows,
                                     const double *displacement, int64_t offset,
                                     int64_t n_unknowns, double *gap);

  /** force[column - offset] += w_i p_i B_i: the contact force on the unknowns.
   */
  ABUT_API abut_status abut_rows_add_force(const abut_rows *rows,
                                           const double *pressure,
                                           int64_t offset, int64_t n_unknowns,
                                           double *force);

#ifdef __cplusplus
}
#endif

#endif
