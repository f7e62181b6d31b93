/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_FRICTION_H
#define ABUT_FRICTION_H

/** @file
 * Friction: the relation between traction, slip and pressure of a point.
 *
 * Conventions (everywhere in Abut): s is the slip of the secondary relative to
 * the primary since the last accepted step, tau the traction on the secondary,
 * both in the tangents of the point; so a body that slides in +t1 has
 * tau1 < 0. With the bound rho of the traction, Coulomb's law is
 *
 *     |tau| <= rho,   tau = -rho s / |s| where s is not 0,
 *
 * and as one equation C = 0, with s~ = s + (tau - taubar)/eps, x = tau - c s~
 * and e = x/|x|,
 *
 *     stick  C = s~             where rho > 0 and |x| <= rho
 *     slip   C = tau - rho e    elsewhere
 *
 * (Hueber, Stadler and Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572). 1/eps = 0
 * is exact stick, taubar the traction at the last accepted step (penalty) or
 * the last multiplier (augmented Lagrangian). The linearisation
 *
 *     A dtau + B ds + c_p dp = -C
 *
 * is theirs, with tau held inside the disc in the derivative of e, a factor
 * that keeps A regular where traction and direction oppose each other, and c_p
 * such that A^-1 c_p = -(drho/dp) e, which is its value at the solution.
 */

#include <abut/context.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** How an answer of stick and slip is looked for. The first is what Abut
   * means to be used. The other two are the textbooks', to see where they fail;
   * they change no answer, only whether and how fast it is found. */
  typedef enum abut_friction_iteration
  {
    /** Newton's method with the linearisation of the head of this file, and
     * the cures of abut_progress.friction_rung where sets come back. */
    ABUT_FRICTION_PRIMAL_DUAL,
    /** Newton's method on the return map itself: the traction is the trial
     * traction x returned to the disc, in the derivative, too, and the bound
     * has no derivative where p <= 0 (Alart and Curnier, Comput. Methods Appl.
     * Mech. Engrg. 92 (1991) 353; with springs c = eps, the radial return of
     * Simo and Laursen, Comput. Struct. 42 (1992) 97). No cures. */
    ABUT_FRICTION_RADIAL_RETURN,
    /** Tresca's problem again and again, its bounds those of the pressures that
     * the one before has found: a fixed point, which contracts only where
     * pressures depend little enough on friction. */
    ABUT_FRICTION_TRESCA
  } abut_friction_iteration;

  /** Points at which the bound of the traction is wanted; arrays of n entries,
   * owned by the caller. */
  typedef struct abut_friction_bounds
  {
    size_t struct_size;        /**< sizeof(abut_friction_bounds) */
    int32_t n;                 /**< number of points */
    const double *pressure;    /**< [n] p, force per area; of any sign */
    const double *coefficient; /**< [n] mu >= 0 */
    const double *cap;         /**< [n] largest bound; NULL: none */
    const void *parameters;    /**< of a user's own law */
  } abut_friction_bounds;

  /** A friction law: a table of functions. */
  typedef struct abut_friction
  {
    size_t struct_size; /**< sizeof(abut_friction) */
    const char *name;   /**< word in the parameter file */
    /** The bound rho [n] >= 0 and its derivative by the pressure [n]. Where p
     * <= 0 the bound should be 0 and the derivative still that of p > 0: it
     * acts on a point that has just closed. Does not allocate; O(n). */
    abut_status (*bound)(const abut_friction_bounds *points, double *bound,
                         double *d_bound);
  } abut_friction;

  /** Built-in law number i, or NULL from the number of laws on. The first is
   * the default, "coulomb": rho = min(mu max(p, 0), cap). With a cap alone in
   * mind (Tresca's law, plastic surfaces) give a large mu. */
  ABUT_API const abut_friction *abut_friction_get(int32_t i);

  /** Built-in law by its name, or NULL. */
  ABUT_API const abut_friction *abut_friction_find(const char *name);

  /** Points at which friction is evaluated; arrays owned by the caller.
   * Tangents of a point stand together, points in their order: [m] numbers, m
   * the sum of all n_tangents. */
  typedef struct abut_friction_points
  {
    size_t struct_size;               /**< sizeof(abut_friction_points) */
    int32_t n;                        /**< number of points */
    const uint8_t *n_tangents;        /**< [n] 1 or 2 */
    const double *slip;               /**< [m] s, length */
    const double *traction;           /**< [m] tau, force per area */
    const double *reference_traction; /**< [m] taubar; NULL: 0 */
    const double *compliance;         /**< [n] 1/eps >= 0; NULL: 0 */
    const double *scale;              /**< [n] c > 0, pressure per length */
    const double *bound;              /**< [n] rho >= 0 */
    const double *d_bound;            /**< [n] drho/dp */
    /** Nonzero: linearise tau - rho x/|x| as it stands, with nothing held in
     * the disc and nothing kept regular (ABUT_FRICTION_RADIAL_RETURN). */
    int32_t radial_return;
    /** [m] 1/eps of each tangent, instead of compliance; NULL: that of the
     * point. */
    const double *tangent_compliance;
  } abut_friction_points;

  /** The linearisation of the head of the file; arrays owned by the caller. M
   * is the sum of n_tangents^2; blocks row by row. */
  typedef struct abut_friction_linearisation
  {
    size_t struct_size; /**< sizeof(abut_friction_linearisation) */
    double *residual;   /**< [m] C */
    double *d_traction; /**< [M] A */
    double *d_slip;     /**< [M] B */
    double *d_pressure; /**< [m] c_p */
    double *direction;  /**< [m] e, 0 where x is 0; NULL: not wanted */
  } abut_friction_linearisation;

  /** Whether closed points stick or slip: replaces each entry of state [n] that
   * is not ABUT_STATE_OPEN. O(n). */
  ABUT_API abut_status
  abut_friction_classify(const abut_friction_points *points, uint8_t *state);

  /** Linearise in the given state (which need not be that of classify); where
   * it is ABUT_STATE_OPEN, C = tau. NOT_FINITE for values that are not finite.
   * Does not allocate; O(n). */
  ABUT_API abut_status abut_friction_linearise(
      const abut_friction_points *points, const uint8_t *state,
      const abut_friction_linearisation *result);

#ifdef __cplusplus
}
#endif

#endif
