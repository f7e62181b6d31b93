/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_LAW_H
#define ABUT_LAW_H

/** @file
 * Contact laws: the relation between pressure and gap of a constraint row.
 *
 * Conventions (everywhere in Abut): gap g > 0 is open, pressure p > 0 is
 * compression. Every law is a member of one family,
 *
 *     0 <= p  _|_  g~ >= 0,   g~ = g + e + (p - pbar) / eps,
 *
 * (Lagrange multiplier: 1/eps = 0; penalty: pbar = 0; augmented Lagrangian:
 * pbar = the last multiplier) or of its interior approximation p s = mu with
 * s = g (barrier) or s = a slack z of its own (interior point). A law gives,
 * for each row, the state and the linearisation
 *
 *     a dp + b dg = -c
 *
 * of its complementarity residual c (Hueber, Stadler and Wohlmuth, SIAM J.
 * Sci. Comput. 30, 2008; Nocedal and Wright, Numerical Optimization, ch. 19).
 * a = 0 is a constraint on the gap, b = 0 a prescribed pressure, and where a
 * never vanishes the pressure can be condensed row by row.
 */

#include <abut/context.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** State of a row. */
  typedef enum abut_state
  {
    ABUT_STATE_OPEN = 0,   /**< no contact, p = 0 */
    ABUT_STATE_CLOSED = 1, /**< contact (with friction: stick) */
    ABUT_STATE_SLIP = 2    /**< contact, and the traction at its bound */
  } abut_state;

  /** Requirements of a law and properties of its linearisation. */
  typedef enum abut_law_flag
  {
    ABUT_LAW_HARD = 1,     /**< a vanishes on closed rows: a true constraint */
    ABUT_LAW_INTERIOR = 2, /**< needs p > 0 and s > 0; the state is not used */
    ABUT_LAW_SLACK = 4,    /**< s is an unknown of its own (field slack) */
    ABUT_LAW_STRESS = 8    /**< the gap that the law is given is g + sigma_n/eps
                                with the body's normal stress (Nitsche), and
                                with friction the slip s - sigma_t/eps with its
                                traction along the surface */
  } abut_law_flag;

  /** Outer iteration that a law needs. */
  typedef enum abut_outer
  {
    ABUT_OUTER_NONE,       /**< Newton (active set) only */
    ABUT_OUTER_PENALTY,    /**< eps grows, warm-started */
    ABUT_OUTER_MULTIPLIER, /**< pbar <- p (method of multipliers) */
    ABUT_OUTER_BARRIER,    /**< mu -> 0 by continuation, feasible start */
    ABUT_OUTER_PRIMAL_DUAL /**< mu -> 0, predictor-corrector, any start */
  } abut_outer;

  /** Rows at which a law is evaluated; arrays have n entries and are owned by
   * the caller. */
  typedef struct abut_law_points
  {
    size_t struct_size;               /**< sizeof(abut_law_points) */
    int32_t n;                        /**< number of rows */
    const double *gap;                /**< g, length */
    const double *pressure;           /**< p, force per area */
    const double *slack;              /**< z > 0, length; NULL if unused */
    const double *reference_pressure; /**< pbar; NULL is 0 */
    const double *compliance;         /**< 1/eps >= 0; NULL is 0 */
    const double *scale;              /**< c > 0, pressure per length */
    const uint8_t *bilateral;         /**< nonzero: g~ = 0 always; NULL: none */
    double allowed_penetration;       /**< e >= 0, length */
    double barrier;                   /**< mu >= 0, pressure times length */
    const void *parameters;           /**< of a user's own law */
  } abut_law_points;

  /** Linearisation a dp + b dg = -c; arrays of n entries, owned by the caller.
   */
  typedef struct abut_law_linearisation
  {
    size_t struct_size; /**< sizeof(abut_law_linearisation) */
    double *residual;   /**< c */
    double *d_pressure; /**< a = dc/dp */
    double *d_gap;      /**< b = dc/dg */
  } abut_law_linearisation;

  /** A law: a table of functions. Both functions work on all rows at once, do
   * not allocate, and cost O(n). */
  typedef struct abut_law
  {
    size_t struct_size; /**< sizeof(abut_law) */
    const char *name;   /**< word in the parameter file */
    uint32_t flags;     /**< sum of abut_law_flag */
    abut_outer outer;   /**< outer iteration that belongs to it */
    /** The state that the current p and g call for, sign of p - c g~. */
    abut_status (*classify)(const abut_law_points *points, uint8_t *state);
    /** Linearise in the given state (which need not be that of classify). */
    abut_status (*linearise)(const abut_law_points *points,
                             const uint8_t *state,
                             abut_law_linearisation *result);
  } abut_law;

  /** Whether the law is a true constraint on closed rows: no penetration, and
   * pressures that are unknowns of their own. */
  static inline bool abut_law_is_exact(const abut_law *law)
  {
    return (law->flags & ABUT_LAW_HARD) != 0;
  }

  /** Whether pressures and gaps (or slacks) must be positive all the time. */
  static inline bool abut_law_is_interior(const abut_law *law)
  {
    return (law->flags & ABUT_LAW_INTERIOR) != 0;
  }

  /** Whether each pressure follows from its gap by a stiffness eps: neither
   * exact nor interior. */
  static inline bool abut_law_has_penalty(const abut_law *law)
  {
    return !abut_law_is_exact(law) && !abut_law_is_interior(law);
  }

  /** Whether the law needs the body's normal stress (Nitsche). */
  static inline bool abut_law_needs_stress(const abut_law *law)
  {
    return (law->flags & ABUT_LAW_STRESS) != 0;
  }

  /** Whether the law has no outer iteration around Newton's. */
  static inline bool abut_law_solves_once(const abut_law *law)
  {
    return law->outer == ABUT_OUTER_NONE;
  }

  /** Whether the outer iteration updates multipliers. */
  static inline bool abut_law_updates_multipliers(const abut_law *law)
  {
    return law->outer == ABUT_OUTER_MULTIPLIER;
  }

  /** Whether all gaps must be open at the start, and stay so. */
  static inline bool abut_law_needs_open_start(const abut_law *law)
  {
    return law->outer == ABUT_OUTER_BARRIER;
  }

  /** Whether pressures, slacks and gaps are solved for together. */
  static inline bool abut_law_is_primal_dual(const abut_law *law)
  {
    return law->outer == ABUT_OUTER_PRIMAL_DUAL;
  }

  /** Built-in law by its name ("lagrange", "penalty", "quadratic penalty",
   * "augmented lagrangian", "barrier", "interior point", "nitsche"), or NULL.
   */
  ABUT_API const abut_law *abut_law_find(const char *name);

  /** Built-in law number @p i, counted from 0; NULL past the end. */
  ABUT_API const abut_law *abut_law_get(int32_t i);

#ifdef __cplusplus
}
#endif

#endif
