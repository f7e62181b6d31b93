/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_DENSE_MODEL_H
#define ABUT_DENSE_MODEL_H

/** @file
 * The smallest host of the contact strategies: a quadratic program with a
 * dense matrix,
 *
 *     minimise 1/2 u'Ku - f'u  subject to  g = g0 + B u >= 0 (or = 0),
 *
 * with friction where it is given; for a point mass on a spring, for chains of
 * masses, for examples, and for tests.
 */

#include <abut/points.h>
#include <abut/strategy.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** A dense model; arrays are owned by the caller and not changed. */
  typedef struct abut_dense_model
  {
    size_t struct_size;      /**< sizeof(abut_dense_model) */
    int32_t n;               /**< unknowns, at most a few hundred */
    const double *stiffness; /**< [n*n] K, symmetric positive definite on
                                  the null space of the constraints */
    const double *force;     /**< [n] f */
    /** Unknown k of node l is number l * dimension + k, below n. */
    const abut_points *points;
    /** Friction of contact points with more than one component; NULL: none, and
     * there must be no such points. Its rows are the components of the points.
     */
    const abut_strategy_friction *friction;
  } abut_dense_model;

  /** One line of the history of a solve. */
  typedef void (*abut_dense_monitor)(void *user, const abut_progress *progress,
                                     const double *displacement,
                                     const double *pressure);

  /** Solve the model with the method of @p options. Penalties are multiples of
   * the stiffness of a component, sum_k B_k^2 K_kk / ((sum_k B_k^2)^2 w), which
   * for one unknown is K B^-2 / w. Costs O((n + n_components)^3) per linear
   * system. SINGULAR if K is singular with what is closed in some step:
   * then begin with a state that holds the body. If points slip then, that is
   * the reason UNHELD instead, unless @p reason is NULL: friction does not hold
   * the body, and u is that of the step before. In the rows of tangents the
   * pressure is the traction, and the gap is the slip since the last accepted
   * step.
   * @param displacement [n] in: start; out: solution
   * @param pressure [n_components] in: start (may be all 0); out: pressure
   * @param state [n_components] starting set on entry, final set on return;
   * NULL to start from the set that p and g call for
   * @param monitor called after each step, may be NULL; progress->outer is the
   * number of the outer step */
  ABUT_API abut_status abut_dense_model_solve_sized(
      abut_context *context, const abut_dense_model *model,
      const abut_strategy_options *options, double *displacement,
      double *pressure, uint8_t *state, abut_dense_monitor monitor, void *user,
      abut_progress *progress, abut_reason *reason);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_dense_model_solve(abut_context *context, const abut_dense_model *model,
                         const abut_strategy_options *options,
                         double *displacement, double *pressure, uint8_t *state,
                         abut_dense_monitor monitor, void *user,
                         abut_progress *progress, abut_reason *reason)
  {
    if (progress != NULL)
      progress->struct_size = sizeof(*progress);
    return abut_dense_model_solve_sized(context, model, options, displacement,
                                        pressure, state, monitor, user,
                                        progress, reason);
  }

#ifdef __cplusplus
}
#endif

#endif
