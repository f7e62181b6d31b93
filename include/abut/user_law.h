/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_USER_LAW_H
#define ABUT_USER_LAW_H

/** @file
 * A contact law of your own in a shared object, named in the parameter file:
 *
 *     subsection Method
 *       set Enforcement    = user
 *       set Law file       = libmylaw.so
 *       set Law parameters = pressure: 2, thickness: 0.01
 *     end
 *
 * The shared object includes this header, is linked to nothing, and ends with
 * one line that exports its law:
 *
 *     ABUT_USER_LAW(my_law, my_parameter_names, my_check)
 *
 * The law is an abut_law with outer = ABUT_OUTER_NONE and flags 0, or
 * ABUT_LAW_HARD if d_pressure may be 0. It may be nonlinear; Newton's method is
 * applied to it until residual / slope is below the gap tolerance as a length.
 * Its functions get the gap in the scene's unit of length and all parameters as
 * an array of double in the order of their names at abut_law_points.parameters.
 * They may leave out `compliance`, `scale`, `reference_pressure`, `barrier`,
 * `slack` and `bilateral`: a user's law is not offered for tied surfaces. They
 * may be called by several threads at once, must not keep pointers, and report
 * failure by returning a positive status.
 *
 * A friction law of your own, an abut_friction, is exported in the same way by
 *
 *     ABUT_USER_FRICTION(my_friction, my_parameter_names, my_check)
 *
 * and named by `Friction file` and `Friction parameters`; it takes the place of
 * Coulomb's law where pairs have friction. One shared object may export both.
 */

#include <abut/friction.h>
#include <abut/law.h>

#ifdef __cplusplus
extern "C"
{
#endif

/** Raised when this header or abut/law.h changes in a way that no size shows.
 */
#define ABUT_USER_LAW_ABI 1

/** Name of the function that ABUT_USER_LAW() defines. */
#define ABUT_USER_LAW_QUERY "abut_user_law_query"

  /** A user's law, and what it was compiled with. */
  typedef struct abut_user_law
  {
    uint32_t abi;                /**< ABUT_USER_LAW_ABI */
    uint32_t struct_size;        /**< sizeof(abut_user_law) */
    uint32_t law_size;           /**< sizeof(abut_law) */
    uint32_t points_size;        /**< sizeof(abut_law_points) */
    uint32_t linearisation_size; /**< sizeof(abut_law_linearisation) */
    const abut_law *law;         /**< the table of functions */
    /** Names of all parameters, then NULL; may be NULL itself. Each must be
     * given in the parameter file. */
    const char *const *parameter_names;
    /** Look at the parameters: NULL if they are good, else one sentence with
     * the error. May be NULL. */
    const char *(*check)(const double *parameters);
  } abut_user_law;

  /** Type of abut_user_law_query(). */
  typedef const abut_user_law *(*abut_user_law_query_function)(void);

/** Export the abut_law @p law with its parameters' names and their check, see
 * abut_user_law. Once per shared object, at the end of the file. */
#define ABUT_USER_LAW(law, parameter_names, check)                             \
  ABUT_API const abut_user_law *abut_user_law_query(void);                     \
  const abut_user_law *abut_user_law_query(void)                               \
  {                                                                            \
    static const abut_user_law user_law = {ABUT_USER_LAW_ABI,                  \
                                           sizeof(abut_user_law),              \
                                           sizeof(abut_law),                   \
                                           sizeof(abut_law_points),            \
                                           sizeof(abut_law_linearisation),     \
                                           &(law),                             \
                                           parameter_names,                    \
                                           check};                             \
    return &user_law;                                                          \
  }

/** Name of the function that ABUT_USER_FRICTION() defines. */
#define ABUT_USER_FRICTION_QUERY "abut_user_friction_query"

  /** A user's friction law, and what it was compiled with. */
  typedef struct abut_user_friction
  {
    uint32_t abi;             /**< ABUT_USER_LAW_ABI */
    uint32_t struct_size;     /**< sizeof(abut_user_friction) */
    uint32_t friction_size;   /**< sizeof(abut_friction) */
    uint32_t bounds_size;     /**< sizeof(abut_friction_bounds) */
    const abut_friction *law; /**< the table of functions */
    /** As those of abut_user_law; values are at
     * abut_friction_bounds.parameters, an array of double. */
    const char *const *parameter_names;
    const char *(*check)(const double *parameters); /**< as there */
  } abut_user_friction;

  /** Type of abut_user_friction_query(). */
  typedef const abut_user_friction *(*abut_user_friction_query_function)(void);

/** Export the abut_friction @p law, see ABUT_USER_LAW(). */
#define ABUT_USER_FRICTION(law, parameter_names, check)                        \
  ABUT_API const abut_user_friction *abut_user_friction_query(void);           \
  const abut_user_friction *abut_user_friction_query(void)                     \
  {                                                                            \
    static const abut_user_friction user_friction = {                          \
        ABUT_USER_LAW_ABI,                                                     \
        sizeof(abut_user_friction),                                            \
        sizeof(abut_friction),                                                 \
        sizeof(abut_friction_bounds),                                          \
        &(law),                                                                \
        parameter_names,                                                       \
        check};                                                                \
    return &user_friction;                                                     \
  }

#ifdef __cplusplus
}
#endif

#endif
