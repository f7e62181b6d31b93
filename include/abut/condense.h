/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONDENSE_H
#define ABUT_CONDENSE_H

/** @file
 * The local algebra of contact: eliminate the pressures of a point.
 *
 * A linearised law ties the pressures p of a point to its gaps g, k numbers
 * each (the normal ones, with friction the tangential ones, too),
 *
 *     A dp + B dg = -c,
 *
 * with k x k blocks that need not be symmetric; k = 1: a dp + b dg = -c. A
 * component is *held* (H) if its row of A vanishes, *sprung* (S) otherwise.
 * Eliminated, sprung pressures leave springs, and held components constraints
 * whose pressure L = (p + dp)_H only the whole system determines:
 *
 *     dg_H + B_HH^-1 B_HS dg_S = -B_HH^-1 c_H              trial . dg = value
 *     force on the gaps: test^T w L + f - Z dg,   test = (1 on H, -A_SS^-1
 * A_SH) Z = w A_SS^-1 B_S,   f = w (p_S - A_SS^-1 (c_S - A_SH p_H)), dp_S =
 * -A_SS^-1 (c_S + B_S dg + A_SH dp_H)
 *
 * (Hueber, Stadler and Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572, sections
 * 4 and 5, where slip leaves a held normal component whose test direction is
 * not that of its trial: the friction that grows with the pressure.) Which
 * unknowns the gaps depend on, and by which stencil a force acts on them, is
 * the business of the caller; the two may differ.
 */

#include <abut/export.h>
#include <abut/status.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Components of a point at most. */
#define ABUT_CONDENSE_COMPONENTS 3

  /** Linearised laws of n points; arrays are owned by the caller. Components of
   * a point stand together, points in their order: [m] numbers, m the sum of k.
   * Blocks likewise, row by row: [M] numbers, M the sum of k^2. */
  typedef struct abut_condense_points
  {
    size_t struct_size;          /**< sizeof(abut_condense_points) */
    int32_t n;                   /**< number of points */
    const uint8_t *n_components; /**< [n] k, 1 to 3; NULL: 1 each */
    const double *weight;        /**< [n] w > 0, area; NULL: 1 each */
    const double *pressure;      /**< [m] p, force per area */
    const double *residual;      /**< [m] c */
    const double *d_pressure;    /**< [M] A = dc/dp */
    const double *d_gap;         /**< [M] B = dc/dg */
  } abut_condense_points;

  /** Terms that replace the pressures; arrays are owned by the caller. */
  typedef struct abut_condensed
  {
    size_t struct_size; /**< sizeof(abut_condensed) */
    uint8_t *held;      /**< [m] 1 where held, else 0 */
    double *value;      /**< [m] of trial . dg, length; 0 where sprung */
    double *force;      /**< [m] f, force; 0 where held */
    double *spring;     /**< [M] Z, force per length; rows of held ones are 0 */
    double *trial;      /**< [M] a row for each held component, 0 for others;
                             NULL: not wanted */
    double *test;       /**< [M] likewise */
  } abut_condensed;

  /** Eliminate the pressures of all points. Does not allocate; O(n k^3).
   * UNSUPPORTED if a law determines neither the pressure nor the gap (B_HH or
   * A_SS is singular), NOT_FINITE for NaN or infinity; what was written is then
   * of no use. */
  ABUT_API abut_status abut_condense(const abut_condense_points *points,
                                     const abut_condensed *result);

  /** The change of sprung pressures, once that of the gaps is known.
   * @param gap_change [m] dg
   * @param pressure_change [m] dp; those of held components are read, -p
   *   standing for L = 0 as long as L is unknown, and those of sprung ones are
   *   written.
   * Errors and cost as of abut_condense(). */
  ABUT_API abut_status abut_condense_recover(const abut_condense_points *points,
                                             const double *gap_change,
                                             double *pressure_change);

#ifdef __cplusplus
}
#endif

#endif
