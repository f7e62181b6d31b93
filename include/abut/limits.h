/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_LIMITS_H
#define ABUT_LIMITS_H

/** @file
 * Legal ranges of numbers that users choose. They stand once, in a table of the
 * core, which the calls that take the numbers and the parameters of files that
 * set them both go by.
 */

#include <abut/export.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Largest magnitude of a number: products of a few of them with lengths and
   * stiffnesses stay finite. */
#define ABUT_LARGEST_NUMBER 1e300
  /** Smallest magnitude of a number that is not zero, for the same reason. */
#define ABUT_SMALLEST_NUMBER 1e-300

  /** The legal range of a number. NaN is in none. */
  typedef struct abut_limit
  {
    const char *name; /**< of the number */
    double low;       /**< least value */
    double high;      /**< largest value */
    bool low_open;    /**< whether low itself is not legal */
    bool high_open;   /**< whether high itself is not legal */
  } abut_limit;

  /** Whether @p value is in the range. */
  static inline bool abut_limit_contains(const abut_limit *limit, double value)
  {
    return (limit->low_open ? value > limit->low : value >= limit->low)
           && (limit->high_open ? value < limit->high : value <= limit->high);
  }

  /** Range of the number of abut_strategy_options with this name; NULL if there
   * is none. It lives for ever. */
  ABUT_API const abut_limit *abut_strategy_limit(const char *name);

#ifdef __cplusplus
}
#endif

#endif
