/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STRATEGY_H
#define ABUT_STRATEGY_H

/** @file
 * The outer methods of contact as one state machine over arrays: active set
 * with protection against cycling, penalty growth, method of multipliers,
 * barrier continuation, primal-dual interior point.
 *
 * The strategy owns pressure, slack and state of each row; the host owns the
 * displacement and the linear solver. The host calls abut_strategy_next() and
 * carries out the returned action:
 *
 *     SOLVE        solve  K du - sum w dp B = -R,  a dp + b dg = -c
 *                  with dg = B du for du; return dg and dp in the arrays of
 *                  the request
 *     SOLVE_AGAIN  the same matrix (a and b did not change), a new c
 *     MOVE         u += step_length du; pressures were moved by the strategy;
 *                  return the gap at the new u
 *     STOP         done; see reason
 *
 * R = internal - external - sum w p B is the residual with the strategy's
 * present pressure. abut_strategy_run() does this loop over callbacks. The
 * core knows no MPI: sums over ranks go through the callback reduce.
 */

#include <abut/failure.h>
#include <abut/friction.h>
#include <abut/law.h>
#include <stdbool.h>
#include <string.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Opaque strategy. */
  typedef struct abut_strategy abut_strategy;

  /** The next action of the host. */
  typedef enum abut_action
  {
    ABUT_ACTION_SOLVE,
    ABUT_ACTION_SOLVE_AGAIN,
    ABUT_ACTION_MOVE,
    ABUT_ACTION_STOP
  } abut_action;

  /** Why a strategy stopped. */
  typedef enum abut_reason
  {
    ABUT_REASON_NONE,       /**< not stopped */
    ABUT_REASON_CONVERGED,  /**< all tolerances met */
    ABUT_REASON_STEP_LIMIT, /**< max_steps or max_outer reached */
    ABUT_REASON_STAGNATION, /**< outer iteration does not contract */
    ABUT_REASON_INFEASIBLE, /**< barrier: no start with all gaps open */
    ABUT_REASON_NOT_FINITE, /**< NaN or infinity in a gap or increment */
    /** Told by hosts, as abut_dense_model_solve(): what is closed slips, and
     * neither it nor anything else holds a body. */
    ABUT_REASON_UNHELD
  } abut_reason;

  /** English text of a reason, with what to try; never NULL. */
  ABUT_API const char *abut_reason_text(abut_reason reason);

  /** Reduction over ranks. */
  typedef enum abut_reduction
  {
    ABUT_REDUCTION_SUM,
    ABUT_REDUCTION_MAX
  } abut_reduction;

  /** Options; set by abut_strategy_defaults(). Their legal ranges are those of
   * abut_strategy_limit() (abut/limits.h). All are free of units: pressures
   * are measured by pressure_scale, lengths by length_scale, stiffnesses by the
   * rows' stiffness given to abut_strategy_start(). */
  typedef struct abut_strategy_options
  {
    size_t struct_size;    /**< sizeof(abut_strategy_options) */
    const abut_law *law;   /**< NULL (default): lagrange */
    double length_scale;   /**< > 0, length; default 1 */
    double pressure_scale; /**< > 0, force per area; default 1 */
    /** eps = penalty * stiffness. Default 0, the law's own: penalty 50,
     * augmented lagrangian 20, nitsche 10, quadratic penalty starts at 1. */
    double penalty;
    double penalty_growth; /**< factor of quadratic penalty; default 10 */
    double penalty_cap;    /**< largest eps/stiffness; default 1e8 */
    /** Augmented Lagrangian: grow eps by 5 (up to penalty_cap) where the gap
     * error does not fall by 10 in an outer step, and let the multipliers
     * follow while the set still changes. False: the textbook's method, each
     * outer step solved to its end with the same eps. Default true. */
    bool adaptive_penalty;
    double allowed_penetration; /**< e / length_scale of the penalty law; 0 */
    /** c / stiffness of the complementarity function; default 1. It only acts
     * on the first set, where abut_strategy_start() is given none: afterwards
     * closed rows are judged by their pressure and open ones by their gap. */
    double complementarity;
    /** First mu/(pressure_scale length_scale) of the barrier, if there is no
     * starting pressure to estimate a better one; default 0.1. */
    double barrier_start;
    double barrier_factor; /**< reduction per continuation step; default 0.1 */
    double barrier_end;    /**< last mu, same unit; default 1e-8 */
    double gap_tolerance;  /**< penetration / length_scale; default 1e-6 */
    double pressure_tolerance; /**< weighted relative change; default 1e-3 */
    /** Relative tolerance that SOLVE requires of the linear solver while the
     * set still changes; default 1e-2. The interior point tightens it with mu.
     */
    double linear_tolerance;
    /** The same for the last solve; default 1e-10. If it is not below
     * linear_tolerance there is no last solve of its own. */
    double final_linear_tolerance;
    /** Error of the law of friction that may remain at slipping points,
     * relative to the largest pressure; default 1e-10, which one more solve
     * then lowers to round-off. */
    double traction_tolerance;
    int32_t max_steps; /**< linear systems in all; default 200 */
    int32_t max_outer; /**< outer steps; default 60 */
    /** Sums (or maximum) over ranks of n values in place; NULL in serial. */
    abut_status (*reduce)(void *user, abut_reduction op, double *values,
                          int32_t n);
    void *user; /**< handed to reduce */
    /** Augmented Lagrangian: replace [n] values on this rank's rows by those of
     * the nearest function in the space of the multipliers, in the weighted
     * mean square over all ranks; collective. NULL (default): each row has a
     * multiplier of its own. With more rows than the bodies have unknowns
     * there, such as quadrature points, multipliers of their own are not
     * unique and do not settle. Gaps are then closed in the weighted means of
     * that space; what is left of them at single rows stays a penalty. */
    abut_status (*project)(void *project_user, int32_t n, double *values);
    void *project_user;         /**< handed to project */
    const void *law_parameters; /**< handed to the law's functions; may be NULL,
                                     the built-in laws have none */
    /** How stick and slip are found; default ABUT_FRICTION_PRIMAL_DUAL. */
    abut_friction_iteration friction_iteration;
  } abut_strategy_options;

  /** Default options. */
  static inline abut_strategy_options abut_strategy_defaults(void)
  {
    abut_strategy_options options;
    memset(&options, 0, sizeof(options));
    options.struct_size = sizeof(abut_strategy_options);
    options.length_scale = 1.;
    options.pressure_scale = 1.;
    options.penalty_growth = 10.;
    options.penalty_cap = 1e8;
    options.adaptive_penalty = true;
    options.complementarity = 1.;
    options.barrier_start = 0.1;
    options.barrier_factor = 0.1;
    options.barrier_end = 1e-8;
    options.gap_tolerance = 1e-6;
    options.pressure_tolerance = 1e-3;
    options.linear_tolerance = 1e-2;
    options.final_linear_tolerance = 1e-10;
    options.traction_tolerance = 1e-10;
    options.max_steps = 200;
    options.max_outer = 60;
    return options;
  }

  /** eps / stiffness that a run with these options starts from:
   * options->penalty or, where that is 0, the law's own. 0 for laws without
   * eps, as lagrange, and if @p options is NULL. */
  ABUT_API double
  abut_strategy_first_penalty(const abut_strategy_options *options);

  /** The next action of the host, and its data. */
  typedef struct abut_request
  {
    size_t struct_size; /**< sizeof(abut_request) */
    abut_action action; /**< what to do */
    abut_reason reason; /**< at STOP */
    /** SOLVE, and the SOLVE_AGAIN after it: relative tolerance for the linear
     * system. */
    double linear_tolerance;
    /** SOLVE: nonzero when a or b changed on any rank since the last SOLVE. */
    int matrix_changed;
    /** SOLVE: nonzero for the confirming solve of a settled active set. */
    int final_solve;
    /** MOVE: factor of the displacement increment, in (0, 1]. */
    double step_length;
    const double *pressure;   /**< [n] p, present */
    const uint8_t *state;     /**< [n] abut_state of the linearisation */
    const double *residual;   /**< [n] c */
    const double *d_pressure; /**< [n] a */
    const double *d_gap;      /**< [n] b */
    double *pressure_change;  /**< [n] out at SOLVE(_AGAIN): dp */
    double *gap_change;       /**< [n] out at SOLVE(_AGAIN): dg = B du */
    /** With friction, a and b are blocks as abut_condense() takes them:
     * d_pressure and d_gap have the sum of block_size^2 numbers, and pressure,
     * residual and changes of the tangents are tractions and slips. NULL
     * without friction: one number for each row. */
    const uint8_t *block_size; /**< [n_blocks] rows of each block, in order */
    int32_t n_blocks;          /**< blocks; without friction 0 */
  } abut_request;

  /** Progress, for logs and tables; global over ranks. */
  typedef struct abut_progress
  {
    size_t struct_size;     /**< sizeof(abut_progress) */
    int32_t step;           /**< linear systems (SOLVE) requested so far */
    int32_t outer;          /**< outer steps so far: times that the set
                                 settled, values of mu done, or interior point
                                 iterations */
    int64_t n_rows;         /**< rows */
    int64_t n_active;       /**< rows in contact */
    int64_t n_changes;      /**< rows that changed state in the last step */
    double penalty;         /**< present eps/stiffness, 0 if none */
    double barrier;         /**< present mu/(pressure_scale length_scale) */
    double penetration;     /**< max of -g, length, >= 0 */
    double complementarity; /**< max |p g| */
    double pressure_change; /**< of the last outer step, relative */
    int32_t
        cycle_length; /**< of the last detected cycle of active sets, or 0 */
    int32_t fallback_steps; /**< steps in which only one row was flipped */
    /** Cause of its end that the iteration itself has measured: the penalty at
     * its cap, multipliers whose gaps do not fall, very short steps of an
     * interior point, a law that further solves do not meet; else NONE. */
    abut_failure seen;
    int64_t n_slipping; /**< points in contact whose traction is at its bound */
    /** How far sets of stick and slip that came back were cured: 0 not needed,
     * 1 by another derivative of the bound, 2 by a coefficient that grew in
     * quarters, 3 by Tresca's problems with frozen bounds, 4 not at all. With
     * ABUT_FRICTION_TRESCA it is 3 from the start. */
    int32_t friction_rung;
  } abut_progress;

  /** The known failure behind the end of a strategy with this law, by what was
   * measured: progress->seen, sets that come back, a penalty of nitsche below
   * any that is stable, a set that still moves after a dozen of steps;
   * STEP_LIMIT where a limit was reached and nothing else is known. CYCLE, too,
   * where it converged only by changing rows one by one; else NONE. NULL
   * arguments give NONE. */
  ABUT_API abut_failure abut_reason_failure(abut_reason reason,
                                            const abut_law *law,
                                            const abut_progress *progress);

  /** Create a strategy. */
  ABUT_API abut_status abut_strategy_create(
      abut_context *context, const abut_strategy_options *options,
      abut_strategy **strategy);

  /** Destroy a strategy and set the handle to NULL. */
  ABUT_API abut_status abut_strategy_destroy(abut_strategy **strategy);

  /** Freedom that supports leave along a tangent: where they fix the node of a
   * point, stick is no constraint, but friction remains. Along such tangents a
   * point that sticks has springs of 1e4 times the stiffness of its row from
   * the traction at the last accepted step, then from the one found, until it
   * stays; laws that keep their penalty have their own. */
  typedef enum abut_tangent
  {
    ABUT_TANGENT_FREE,
    /** Stick would be a condition for what other points fix already. */
    ABUT_TANGENT_GUIDED,
    /** The slip is prescribed: it does not change with the unknowns. */
    ABUT_TANGENT_PRESCRIBED
  } abut_tangent;

  /** Points with friction; arrays are owned by the caller. The rows of such a
   * point stand together, the normal first; in the tangents' rows gap means
   * slip since the last accepted step and pressure means traction. */
  typedef struct abut_strategy_friction
  {
    size_t struct_size;        /**< sizeof(abut_strategy_friction) */
    const abut_friction *law;  /**< NULL: coulomb */
    int32_t n;                 /**< points with friction on this rank */
    const int32_t *first;      /**< [n] row of the normal, ascending */
    const uint8_t *n_tangents; /**< [n] 1 or 2 */
    const double *coefficient; /**< [n] mu >= 0 */
    const double *cap;         /**< [n] largest bound; NULL: none */
    /** [m] traction at the last accepted step, which the springs of penalty
     * laws start from; NULL: 0 */
    const double *reference_traction;
    const void *parameters; /**< handed to the friction law */
    /** Where contacts share a node, which has no more ways to go than its
     * dimensions: [n_rivals] points that stick by springs while the other
     * contact's normal, a row, is closed or touches. Springs need none. */
    int32_t n_rivals;
    const int32_t *rival_point; /**< [n_rivals] index of a point, ascending */
    const int32_t *rival_row;   /**< [n_rivals] row */
    /** [m] abut_tangent of each tangent; NULL: all are free. */
    const uint8_t *tangent;
  } abut_strategy_friction;

  /** Friction for all starts that follow, copied; NULL: none. Where it is given
   * it must be given on all ranks, be it for no point. Laws that
   * are given the stress of the body take no reference_traction: it remembers
   * by itself. UNSUPPORTED for interior laws. */
  ABUT_API abut_status abut_strategy_set_friction(
      abut_strategy *strategy, const abut_strategy_friction *friction);

  /** Begin a solve with @p n rows on this rank. Collective if reduce is set.
   * @param id [n] global number of each row, 0 <= id < 2^53 and used once over
   *   all ranks, or NULL for 0..n-1 (serial)
   * @param weight [n] w > 0
   * @param stiffness [n] > 0, pressure per length: the local stiffness that
   *   penalties and c are multiples of
   * @param bilateral [n] or NULL
   * @param gap [n] at the starting displacement
   * @param pressure [n] starting pressure, or NULL for 0. Augmented
   *   Lagrangian takes it as the first multiplier, replaced by options.project;
   * interior point makes a warm start of it if some pressure is positive
   * @param state [n] starting set, or NULL for the one that p and g call for
   * Arrays are copied. O(n). A rank whose arguments are wrong makes all
   * others return FAILED_ELSEWHERE. UNSUPPORTED for bilateral rows under an
   * interior law. */
  ABUT_API abut_status abut_strategy_start(
      abut_strategy *strategy, int32_t n, const int64_t *id,
      const double *weight, const double *stiffness, const uint8_t *bilateral,
      const double *gap, const double *pressure, const uint8_t *state);

  /** Go on: after SOLVE and SOLVE_AGAIN with the changes written into the last
   * request's arrays (@p gap is ignored), after MOVE with the gap at the new
   * displacement. The first call after start ignores @p gap; after STOP the
   * same answer is given again. Collective. O(n) and no memory; about five
   * reductions of a few numbers per linear system. After a failure only a new
   * start is legal. Where the reason is not CONVERGED, abut_context_message()
   * has the cause. */
  ABUT_API abut_status abut_strategy_next_sized(abut_strategy *strategy,
                                                const double *gap,
                                                abut_request *request);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_strategy_next(abut_strategy *strategy,
                                               const double *gap,
                                               abut_request *request)
  {
    if (request != NULL)
      request->struct_size = sizeof(*request);
    return abut_strategy_next_sized(strategy, gap, request);
  }

  /** Progress so far. */
  ABUT_API abut_status abut_strategy_progress_sized(
      const abut_strategy *strategy, abut_progress *progress);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_strategy_progress(const abut_strategy *strategy, abut_progress *progress)
  {
    if (progress != NULL)
      progress->struct_size = sizeof(*progress);
    return abut_strategy_progress_sized(strategy, progress);
  }

  /** Functions of a host for abut_strategy_run(). */
  typedef struct abut_host
  {
    size_t struct_size; /**< sizeof(abut_host) */
    void *user;         /**< handed to all functions */
    /** SOLVE and SOLVE_AGAIN: write pressure_change and gap_change. */
    abut_status (*solve)(void *user, const abut_request *request);
    /** MOVE: move the displacement and write the new gap. */
    abut_status (*move)(void *user, const abut_request *request, double *gap);
    /** Called after each step, when its outcome is known; may be NULL. The
     * request is the next one, and progress->outer is the number of the outer
     * step. */
    void (*monitor)(void *user, const abut_progress *progress,
                    const abut_request *request);
  } abut_host;

  /** Run a started strategy to its end. @p reason may be NULL. Where a method
   * ends without convergence, that is a reason and not a failure;
   * abut_context_message() then has the cause. A failure of the host's
   * functions is returned as CALLBACK_FAILED, on all ranks. */
  ABUT_API abut_status abut_strategy_run(abut_strategy *strategy,
                                         const abut_host *host,
                                         abut_reason *reason);

#ifdef __cplusplus
}
#endif

#endif
