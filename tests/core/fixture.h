/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_FIXTURE_H
#define ABUT_TESTS_CORE_FIXTURE_H

/* What the core's tests share: cmocka, checks of statuses and numbers, seeded
 * random numbers. */

#include <abut/abut.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
/* cmocka wants the above first. */
#include <cmocka.h>

#define assert_ok(call) assert_int_equal((call), ABUT_SUCCESS)

/* |value - expected| <= tolerance max(1, |expected|), with both numbers in the
 * message. */
#define assert_close(value, expected, tolerance)                               \
  fixture_assert_close((value), (expected), (tolerance), __FILE__, __LINE__)

static inline void
fixture_assert_close(double value, double expected, double tolerance,
                     const char *file, int line)
{
  if (fabs(value - expected) <= tolerance * fmax(1, fabs(expected)))
    return;
  print_error("%.17g is not %.17g (difference %.3g)\n", value, expected,
              value - expected);
  _fail(file, line);
}

static inline abut_context *
fixture_context(void)
{
  abut_context *context = NULL;
  assert_ok(abut_context_create(NULL, &context));
  return context;
}

/* Options for hosts with exact linear solves: no separate final solve. */
static inline abut_strategy_options
exact_options(void)
{
  abut_strategy_options options = abut_strategy_defaults();
  options.linear_tolerance = options.final_linear_tolerance;
  return options;
}

/* Seeded random number in [0, 1): a linear congruential generator with Knuth's
 * constants, the same on every machine. */
static inline double
fixture_random(uint64_t *seed)
{
  *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (double)(*seed >> 11) / 9007199254740992.0;
}

#endif
