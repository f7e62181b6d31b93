/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GAP_RAISE_H
#define ABUT_GAP_RAISE_H

/** @file
 * Amounts by which gaps of rows are raised that press where surfaces are apart.
 *
 * Dual functions, negative on a part of each facet, make the weighted gap W of
 * mortar less than the least gap m around the row, its clearance. The law of
 * such a row is that of max(W, m), by a constant c = max(0, m - W) that is
 * added to W and renewed between solves: derivatives, forces and symmetry are
 * those of W.
 */

#include <abut/export.h>
#include <abut/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Amount of a row, and the result of the value before; 0: none. */
  typedef struct abut_gap_raise
  {
    double value;     /**< length >= 0 */
    double before;    /**< value before this one */
    double clearance; /**< with that value */
    double pressure;  /**< with that value */
  } abut_gap_raise;

  /** Rows after a solve. */
  typedef struct abut_raised_rows
  {
    size_t struct_size;      /**< sizeof(abut_raised_rows) */
    int32_t n_rows;          /**< number of rows */
    const double *clearance; /**< [n_rows] INFINITY: row stays as it is */
    const double *gap;       /**< [n_rows] with the present amounts */
    const double *pressure;  /**< [n_rows] */
    const uint8_t *presses;  /**< [n_rows] nonzero: closed, with a pressure */
    /** [n_rows] clearance from which on a row that is not raised is apart. */
    const double *apart;
    /** Clearance from which on rows that are raised are apart, minus which they
     * are inside; and least change of an amount. Length > 0. */
    double least;
    int32_t only_less; /**< nonzero: amounts may only be lowered */
  } abut_raised_rows;

  /** Renew the amounts of rows that press while apart, and of those that are
   * inside the other side because of theirs.
   *
   * A row that presses is raised by as much more as it is apart by, or by what
   * makes its pressure or its clearance 0, whichever is less, extrapolated from
   * the last two values. A row that is inside gets the amount at which its
   * clearance is 0, extrapolated from the last two values if it was apart with
   * the one before, else from the gap.
   *
   * @param raise [n_rows] changed
   * @param n_changed out
   *
   * INVALID_ARGUMENT for a NULL or a size that is negative. O(n_rows). */
  ABUT_API abut_status abut_gap_raise_renew(const abut_raised_rows *rows,
                                            abut_gap_raise *raise,
                                            int32_t *n_changed);

#ifdef __cplusplus
}
#endif

#endif
