/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_HISTORY_H
#define ABUT_HISTORY_H

/** @file
 * History of contact from one solve to the next: pressure and state by number
 * of the point, in two versions.
 *
 * The committed version is that of the last step that was accepted, the trial
 * version that of the current step:
 *
 *     abut_history_begin_step(history);         // the trial version is empty
 *     abut_history_set(history, &entries);      // values that were reached
 *     abut_history_commit(history);             // the step was accepted, or
 *     abut_history_rollback(history);           // it failed: as before it
 *
 * Numbers of points are the caller's, and last as long as the mesh does: the
 * number of a node along the mesh, or one made of a facet's number and that of
 * the point in a rule. Where points are renumbered while the facet stays, their
 * position on it determines the nearest old point: abut_history_nearest().
 *
 * With friction, the number of a tangent has the traction as its pressure: what
 * the next step's slip begins with (abut_strategy_friction).
 *
 * The multiplier that the method of multipliers begins with is the pressure,
 * so that it needs no entry of its own.
 *
 * A version is written as one block of bytes, for files and for other
 * processes, see abut_history_pack(). Nothing here is collective.
 */

#include <abut/context.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Opaque history. */
  typedef struct abut_history abut_history;

  /** Which of the two versions. */
  typedef enum abut_history_version
  {
    ABUT_HISTORY_COMMITTED, /**< of the last accepted step */
    ABUT_HISTORY_TRIAL      /**< of the current step */
  } abut_history_version;

  /** Values by point. */
  typedef struct abut_history_entries
  {
    size_t struct_size;     /**< sizeof(abut_history_entries) */
    int64_t n;              /**< points */
    const int64_t *id;      /**< [n] strictly ascending, >= 0 */
    const double *pressure; /**< [n] */
    const uint8_t *state;   /**< [n] an abut_state; NULL: 0 */
    /** [3 n] where each point sits; NULL: at 0. Only abut_history_nearest()
     * looks at it. */
    const double *place;
  } abut_history_entries;

  /** Places for what abut_history_get() finds; NULL where it is not wanted. */
  typedef struct abut_history_values
  {
    size_t struct_size; /**< sizeof(abut_history_values) */
    double *pressure;   /**< [n] 0 where there is no entry */
    uint8_t *state;     /**< [n] 0 where there is no entry */
    uint8_t *found;     /**< [n] nonzero where there is an entry */
  } abut_history_values;

  /** Most bytes of the name of a law, with the end. */
  enum
  {
    ABUT_HISTORY_LAW_BYTES = 64
  };

  /** Data of a version about the problem as a whole. */
  typedef struct abut_history_problem
  {
    size_t struct_size;               /**< sizeof(abut_history_problem) */
    uint64_t mesh;                    /**< the caller's mark of the mesh that
                                           the numbers belong to; 0: none */
    char law[ABUT_HISTORY_LAW_BYTES]; /**< name, cut off if it is longer */
    double first_penalty; /**< that an outer iteration starts from */
    double penalty;       /**< that it has reached; 0: none */
    int32_t resumes;      /**< nonzero: the next solve goes on with
                               that penalty */
  } abut_history_problem;

  /** Create an empty history. Fails without memory. */
  ABUT_API abut_status abut_history_create(abut_context *context,
                                           abut_history **history);

  /** Destroy a history and set the handle to NULL. */
  ABUT_API abut_status abut_history_destroy(abut_history **history);

  /** Empty both versions and keep the memory. */
  ABUT_API abut_status abut_history_clear(abut_history *history);

  /** Empty the trial version: a point that is not set from here on has no past
   * once the step is committed. The data about the problem stay. */
  ABUT_API abut_status abut_history_begin_step(abut_history *history);

  /** Put entries into the trial version; those of points that it has are
   * replaced. NOT_FINITE for pressures and places that are not numbers. O(n) if
   * all numbers are larger than those that are there, else O(n + entries); no
   * memory once the arrays are as large as ever. */
  ABUT_API abut_status abut_history_set(abut_history *history,
                                        const abut_history_entries *entries);

  /** Look up the points @p id [n], in any order. O(n log(entries)). */
  ABUT_API abut_status abut_history_get(const abut_history *history,
                                        abut_history_version version, int64_t n,
                                        const int64_t *id,
                                        const abut_history_values *past);

  /** For each place [3 n] the nearest of the entries with first_id <= number <
   * end_id ([n] each), of two equally near the one with the smaller number.
   * O(log(entries)) and the entries in the range. */
  ABUT_API abut_status abut_history_nearest(const abut_history *history,
                                            abut_history_version version,
                                            int64_t n, const int64_t *first_id,
                                            const int64_t *end_id,
                                            const double *place,
                                            const abut_history_values *past);

  /** All entries of a version, ascending; valid until the next change, places
   * NULL if no entry was given with places. Fills as much as fits in
   * entries->struct_size. */
  ABUT_API abut_status abut_history_view_sized(const abut_history *history,
                                               abut_history_version version,
                                               abut_history_entries *entries);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_history_view(const abut_history *history,
                                              abut_history_version version,
                                              abut_history_entries *entries)
  {
    if (entries != NULL)
      entries->struct_size = sizeof(*entries);
    return abut_history_view_sized(history, version, entries);
  }

  /** Set a version's data about the problem. */
  ABUT_API abut_status
  abut_history_set_problem(abut_history *history, abut_history_version version,
                           const abut_history_problem *problem);

  /** Data of a version about the problem. Fills as much as fits in
   * problem->struct_size. */
  ABUT_API abut_status abut_history_get_problem_sized(
      const abut_history *history, abut_history_version version,
      abut_history_problem *problem);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_history_get_problem(const abut_history *history,
                           abut_history_version version,
                           abut_history_problem *problem)
  {
    if (problem != NULL)
      problem->struct_size = sizeof(*problem);
    return abut_history_get_problem_sized(history, version, problem);
  }

  /** The trial version becomes the committed one, and stays as it is.
   * O(entries).
   */
  ABUT_API abut_status abut_history_commit(abut_history *history);

  /** The trial version becomes the committed one again, bit for bit.
   * O(entries). */
  ABUT_API abut_status abut_history_rollback(abut_history *history);

  /** Write a version into @p buffer of *bytes bytes; NULL: none. *bytes becomes
   * the number needed; INVALID_ARGUMENT if there are less. The head has the
   * version of the format, byte order, sizes, and a sum over all bytes. */
  ABUT_API abut_status abut_history_pack(const abut_history *history,
                                         abut_history_version version,
                                         void *buffer, size_t *bytes);

  /** Make both versions what abut_history_pack() wrote. INVALID_ARGUMENT, with
   * the reason in the context and without any change, for bytes that it did not
   * write: of something else, of a later version, of a machine with another
   * order of bytes, cut off, or altered. */
  ABUT_API abut_status abut_history_unpack(abut_history *history,
                                           const void *buffer, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif
