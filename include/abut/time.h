/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TIME_H
#define ABUT_TIME_H

/** @file
 * Time schemes for M a + C v + K u = f + contact, as coefficients and updates
 * of arrays; matrices and solvers are the host's. All updates are entry by
 * entry: each process calls them with its own part of the vectors.
 *
 * One family has them all. With x(al) = (1 - al) x_new + al x_old,
 *
 *     M a(alpha_m) + C v(alpha_f) + K u(alpha_f) = f(alpha_f) + contact
 *     u_new = u + dt v + dt^2 ((1/2 - beta) a + beta a_new)
 *     v_new = v + dt ((1 - gamma) a + gamma a_new)
 *
 * Loads and damping are weighted as K u is. The contact force never is: it is
 * that of the step, and gap and pressure fit at its end. Midpoint has beta =
 * 1/2, gamma = 1, alpha_f = 1/2: its a is that of the middle of the step and no
 * step needs the one before. beta = 0 is explicit.
 *
 * A step of an implicit scheme, from (u, v, a) at the old time:
 *
 *     abut_time_begin(&state, predicted);
 *     if (scheme.projects)
 *       {
 *         // contact problem with matrix M / dt^2 (the weights of
 *         // ABUT_TIME_PROJECTION): minimise |w - predicted|^2 with w such that
 *         // no gap is negative; its pressures are a part of the step's
 *         abut_time_project(&state, predicted, projected);
 *       }
 *     // contact problem with the tangent cm M + cc C + ck K (the weights of
 *     // ABUT_TIME_STEP) and, at any displacement u_new of its iteration, the
 *     // residual M am + C vf + K uf - f(alpha_f) - contact, where
 *     abut_time_evaluate(&state, u_new, &arguments);  // gives am, vf, uf
 *     abut_time_end(&state, u_new);                   // u, v, a are new
 *
 * An explicit step has the new displacement after abut_time_begin() and, where
 * the scheme projects, after the projection; with the forces there,
 *
 *     M a_new = f - C vf - K uf + contact    (vf, uf from
 *                                             abut_time_evaluate())
 *     abut_time_end(&state, a_new);
 *
 * begin() changes nothing, project() the velocity, end() all three: a host that
 * may repeat a step keeps copies.
 *
 * Sources: Newmark (1959); Hilber, Hughes, Taylor (1977); Chung, Hulbert
 * (1993); Deuflhard, Krause, Ertel (2008) for the projection; Khenous, Laborde,
 * Renard (2008) for the modified mass; Paoli, Schatzman (2002) for the explicit
 * projection; Moreau (1988) for impulses; Laursen, Chawla (1997) for springs
 * that keep the energy.
 */

#include <abut/context.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Form of the mass matrix. */
  typedef enum abut_time_mass
  {
    ABUT_TIME_MASS_CONSISTENT, /**< that of the elements */
    ABUT_TIME_MASS_LUMPED,     /**< diagonal */
    ABUT_TIME_MASS_MODIFIED    /**< none at nodes that may come into contact,
                                    see abut_mass_modify() */
  } abut_time_mass;

  /** Options of abut_time_scheme_make(). */
  typedef struct abut_time_options
  {
    size_t struct_size; /**< sizeof(abut_time_options) */
    /** A word: `hht` (default), `trapezoid`, `midpoint`, `newmark`,
     * `generalised alpha`, `contact stabilised`, `central difference`,
     * `central difference with projection`, `velocity level`,
     * `energy momentum`. */
    const char *name;
    double alpha;        /**< of hht, in [-1/3, 0]; default -0.1 */
    double rho_infinity; /**< of generalised alpha: what is left in a step of
                              the highest frequencies, in [0, 1]; 0.8 */
    double beta;         /**< of newmark, > 0; 1/4 */
    double gamma;        /**< of newmark, >= 1/2; 1/2 */
  } abut_time_options;

  /** The default scheme. */
  static inline abut_time_options abut_time_defaults(void)
  {
    abut_time_options options = {
        sizeof(abut_time_options), "hht", -0.1, 0.8, 0.25, 0.5};
    return options;
  }

  /** A scheme; see the head of the file. */
  typedef struct abut_time_scheme
  {
    size_t struct_size; /**< sizeof(abut_time_scheme) */
    const char *name;   /**< the word; constant */
    double alpha_m;     /**< weight of the old acceleration */
    double alpha_f;     /**< weight of the old forces */
    double beta;        /**< 0: explicit */
    double gamma;       /**< weight of the new acceleration in v */
    /** Largest relative gain of the energy balance by one impact that is the
     * scheme's nature, see abut_time_judge(). */
    double growth;
    int32_t projects;        /**< a contact problem with M before the step */
    int32_t contact_in_step; /**< contact acts in the step itself, by gaps */
    int32_t impulses; /**< contact acts in the step by velocities: closed points
                           have v_new >= -restitution v_old along the normal */
    int32_t mass;     /**< abut_time_mass that it is made for */
    /** Contact is that of springs, whose force in a step is abut_time_spring():
     * the step loses what they store. */
    int32_t keeps_springs;
  } abut_time_scheme;

  /** Name number @p index >= 0 of the schemes; NULL behind the last. The first
   * is the default. */
  ABUT_API const char *abut_time_scheme_name(int32_t index);

  /** The scheme of the options; NULL: the defaults. UNSUPPORTED for an unknown
   * name, INVALID_ARGUMENT for numbers out of range. */
  ABUT_API abut_status abut_time_scheme_make_sized(
      const abut_time_options *options, abut_time_scheme *scheme);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_time_scheme_make(const abut_time_options *options,
                        abut_time_scheme *scheme)
  {
    if (scheme != NULL)
      scheme->struct_size = sizeof(*scheme);
    return abut_time_scheme_make_sized(options, scheme);
  }

  /** Which of the problems of a step. */
  typedef enum abut_time_stage
  {
    ABUT_TIME_PROJECTION, /**< before the step, of schemes that project */
    ABUT_TIME_STEP        /**< the step itself */
  } abut_time_stage;

  /** Factors of matrices and loads of a step. In the step of an explicit scheme
   * the unknown is the acceleration, else a displacement. */
  typedef struct abut_time_weights
  {
    size_t struct_size; /**< sizeof(abut_time_weights) */
    double mass;        /**< cm */
    double damping;     /**< cc */
    double stiffness;   /**< ck */
    double load;        /**< of the load at the new time, 1 - alpha_f; in a
                             projection 0 */
    double load_before; /**< of the load at the old time, alpha_f */
  } abut_time_weights;

  /** Weights of a stage for time steps of length @p dt > 0. UNSUPPORTED for the
   * projection of a scheme that has none. */
  ABUT_API abut_status abut_time_weigh_sized(const abut_time_scheme *scheme,
                                             double dt, abut_time_stage stage,
                                             abut_time_weights *weights);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_time_weigh(const abut_time_scheme *scheme,
                                            double dt, abut_time_stage stage,
                                            abut_time_weights *weights)
  {
    if (weights != NULL)
      weights->struct_size = sizeof(*weights);
    return abut_time_weigh_sized(scheme, dt, stage, weights);
  }

  /** Whether a scheme goes on from the acceleration, so that the first step
   * needs M a = f - C v - K u + contact; at nodes without mass a = 0. */
  static inline int32_t
  abut_time_needs_acceleration(const abut_time_scheme *scheme)
  {
    return scheme->beta != 0.5 || scheme->gamma != 1 || scheme->alpha_m != 0;
  }

  /** The limit of an explicit scheme by power iteration: 2 / omega with the
   * largest omega^2 of M^-1 K, M diagonal, K with the springs of closed contact
   * if it has such. It ends where omega^2 changes by less than 1e-7 of itself,
   * or after 2000 products. Vectors are spread over processes in any way:
   *
   *     abut_time_limit limit;
   *     abut_time_limit_begin(&limit, first, n, x);
   *     do
   *       {
   *         // y = K x, 0 at unknowns that do not move
   *         abut_time_limit_sums(n, mass, x, y, sums);
   *         // add the two sums of all processes
   *         abut_time_limit_next(&limit, sums, n, mass, y, x);
   *       }
   *     while (limit.goes_on);
   *     // limit.step
   *
   * Power iteration comes from below, so that the step may be a little too
   * long: keep a tenth away from it. */
  typedef struct abut_time_limit
  {
    size_t struct_size; /**< sizeof(abut_time_limit) */
    int32_t n_products; /**< so far */
    int32_t goes_on;    /**< whether another one is needed */
    double square;      /**< omega^2 as far as is known */
    double step;        /**< 2 / omega; infinite where nothing resists */
  } abut_time_limit;

  /** Begin: @p x [n] becomes a vector with a part of every vibration, the same
   * for any distribution of the unknowns. This process has those with the
   * numbers @p first to @p first + @p n - 1. */
  ABUT_API abut_status abut_time_limit_begin(abut_time_limit *limit,
                                             int64_t first, int64_t n,
                                             double *x);

  /** The two sums of this process. Unknowns whose @p mass [n] is 0 do not move;
   * their entries of @p stiffness_times_x [n] are not used. */
  ABUT_API abut_status abut_time_limit_sums(int64_t n, const double *mass,
                                            const double *x,
                                            const double *stiffness_times_x,
                                            double sums[2]);

  /** Take the sums of all processes; @p x [n] becomes the next vector. */
  ABUT_API abut_status abut_time_limit_next(abut_time_limit *limit,
                                            const double sums[2], int64_t n,
                                            const double *mass,
                                            const double *stiffness_times_x,
                                            double *x);

  /** Force of a spring of contact over a step of a scheme that keeps_springs,
   * and its derivative by the gap at the end. With the energy psi(g) = 1/2
   * stiffness g^2 of a gap g < 0, and 0 of one that is open, the force is
   *
   *     (psi(before) - psi(after)) / (after - before),
   *
   * so that its work on the way between them is what the spring gives, to
   * round-off. It is continuous with its derivative, which is <= 0, and convex
   * in @p after. INVALID_ARGUMENT unless @p stiffness >= 0 and all are finite.
   */
  ABUT_API abut_status abut_time_spring(double stiffness, double before,
                                        double after, double *force,
                                        double *derivative);

  /** Motion, and the length of the step from it; arrays of n entries, owned by
   * the caller. */
  typedef struct abut_time_state
  {
    size_t struct_size;             /**< sizeof(abut_time_state) */
    const abut_time_scheme *scheme; /**< of the step */
    double dt;                      /**< length of the step > 0 */
    int64_t n;                      /**< unknowns that are here, >= 0 */
    double *displacement;           /**< [n] u */
    double *velocity;               /**< [n] v */
    double *acceleration;           /**< [n] a */
    /** [n] nonzero where an unknown has no mass (abut_time_mass): its velocity
     * is then the difference of displacements and its acceleration 0. NULL: all
     * have mass. */
    const uint8_t *massless;
  } abut_time_state;

  /** Where the step leads without forces at its end: predicted = u + dt v +
   * dt^2 (1/2 - beta) a, [n]. It is the new displacement of an explicit scheme,
   * what is to be projected where the scheme projects, and else a start of the
   * iteration. The state is not changed. */
  ABUT_API abut_status abut_time_begin(const abut_time_state *state,
                                       double *predicted);

  /** Take over the result of the projection of @p predicted: the velocity
   * becomes the one that leads to @p projected, both [n]. WRONG_ORDER if the
   * scheme has no projection. */
  ABUT_API abut_status abut_time_project(const abut_time_state *state,
                                         const double *predicted,
                                         const double *projected);

  /** Places for what the matrices of a residual act on; NULL where it is not
   * wanted. */
  typedef struct abut_time_arguments
  {
    size_t struct_size; /**< sizeof(abut_time_arguments) */
    double *inertia;    /**< [n] a(alpha_m), for M */
    double *damping;    /**< [n] v(alpha_f), for C; of explicit schemes
                             v + (1 - gamma) dt a */
    double *elastic;    /**< [n] u(alpha_f), for K */
  } abut_time_arguments;

  /** Arguments of the residual at @p unknown [n]: the new displacement, or of
   * an explicit scheme the new acceleration. */
  ABUT_API abut_status abut_time_evaluate(const abut_time_state *state,
                                          const double *unknown,
                                          const abut_time_arguments *arguments);

  /** End the step with @p unknown [n], as above: displacement, velocity and
   * acceleration become those at its end. NOT_FINITE, and nothing changed, if
   * one of the new values is not finite. */
  ABUT_API abut_status abut_time_end(const abut_time_state *state,
                                     const double *unknown);

  /** Energies at the end of a step. */
  typedef struct abut_time_energy
  {
    size_t struct_size;   /**< sizeof(abut_time_energy) */
    double kinetic;       /**< 1/2 v'Mv with the scheme's own mass */
    double strain;        /**< 1/2 u'Ku */
    double contact;       /**< in penalty springs */
    double dissipated;    /**< by friction and damping, since the start */
    double external_work; /**< of loads and of prescribed motions, since the
                             start */
  } abut_time_energy;

  /** Verdict on the energy balance. */
  typedef enum abut_time_verdict
  {
    ABUT_TIME_STEADY,   /**< within what the scheme may gain */
    ABUT_TIME_GAINS,    /**< more: warn, ABUT_FAILURE_ENERGY_GAIN */
    ABUT_TIME_BLOWS_UP, /**< beyond a hundred times all energy that there was,
                           or not finite: stop, ABUT_FAILURE_BLOW_UP */
    ABUT_TIME_LOSES     /**< a twentieth and more is gone that friction and
                             damping have not taken: warn,
                             ABUT_FAILURE_ENERGY_LOSS. Not of schemes with
                             impulses, whose restitution takes energy */
  } abut_time_verdict;

  /** The balance B = kinetic + strain + contact + dissipated - external work
   * over the steps. Begins with zeros behind the size. */
  typedef struct abut_time_balance
  {
    size_t struct_size; /**< sizeof(abut_time_balance) */
    int64_t n;          /**< energies so far; the first is that of the start */
    double first;       /**< B at the start */
    double last;        /**< B now */
    double highest;     /**< largest B */
    double scale;       /**< largest energy that start and loads have given:
                             first and largest external work so far */
    double gain;        /**< (highest - first) / scale of now, at least 0 */
    double loss;        /**< (first - last) / scale, at least 0 */
    double fall;        /**< what B has fallen by in one step at the most */
    int64_t fall_at;    /**< number of the energy at the end of that step */
  } abut_time_balance;

  /** Add the energies of the start (first call) or of the end of a step, and
   * judge the balance. */
  ABUT_API abut_status abut_time_judge(const abut_time_scheme *scheme,
                                       const abut_time_energy *energy,
                                       abut_time_balance *balance,
                                       abut_time_verdict *verdict);

  /** How the mass of nodes that may come into contact is handed on. */
  typedef enum abut_mass_rule
  {
    /** To neighbours that are no candidates, in proportion to the entries of
     * the mass matrix: least noise of the pressure. */
    ABUT_MASS_NEIGHBOURS,
    /** The same, and then the least change (in squares, as parts of what was
     * there) of the diagonal of these nodes and of their neighbours that are no
     * candidates such that the centre of mass stays. */
    ABUT_MASS_CENTRE
  } abut_mass_rule;

  /** A mass matrix of scalars, one row for each node, symmetric with symmetric
   * pattern, in compressed rows; arrays owned by the caller. */
  typedef struct abut_mass_matrix
  {
    size_t struct_size;    /**< sizeof(abut_mass_matrix) */
    int32_t n;             /**< nodes */
    int32_t dimension;     /**< of the places, 1 to 3 */
    const int64_t *start;  /**< [n + 1] where rows begin, start[0] = 0 */
    const int32_t *column; /**< [start[n]] with the diagonal in each row */
    double *value;         /**< [start[n]] */
    const double *place;   /**< [n * dimension]; only for ABUT_MASS_CENTRE, else
                                may be NULL */
  } abut_mass_matrix;

  /** Take all mass from the nodes with a nonzero entry of @p candidate [n], the
   * nodes of secondary surfaces that may come into contact, and hand it on:
   * rows and columns of these nodes become 0, the sum of all entries stays.
   * UNSUPPORTED, with the node in the context and nothing changed, where one
   * has no neighbour that is no candidate (a body that is one element thick):
   * `contact stabilised` needs none. UNSUPPORTED, too, where the centre of mass
   * cannot be kept so, or a diagonal entry would not be positive.
   * O(entries + n). */
  ABUT_API abut_status abut_mass_modify(abut_context *context,
                                        const abut_mass_matrix *mass,
                                        const uint8_t *candidate,
                                        abut_mass_rule rule);

  /** The rule ABUT_MASS_NEIGHBOURS within one element, before its matrix @p
   * mass [n * n] is assembled: what bodies on many processes use. UNSUPPORTED,
   * and nothing changed, where all nodes of the element are candidates. */
  ABUT_API abut_status abut_mass_modify_element(int32_t n,
                                                const uint8_t *candidate,
                                                double *mass);

#ifdef __cplusplus
}
#endif

#endif
