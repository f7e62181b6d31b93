/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The table of known failures, and which of them ends of strategies name. */
#include "fixture.h"

#include <abut/failure.h>
#include <abut/strategy.h>

#include <stdio.h>
#include <string.h>

static void
codes_are_numbers_in_order(void **state)
{
  (void)state;
  int last = 0, n = 0;
  for (; abut_failure_at(n) != NULL; ++n)
  {
    const abut_failure_entry *entry = abut_failure_at(n);
    char code[16];
    (void)snprintf(code, sizeof(code), "ABUT-F%02d", (int)entry->failure);
    assert_string_equal(entry->code, code);
    assert_true((int)entry->failure > last);
    assert_true(strlen(entry->name) > 0 && strlen(entry->remedy) > 0);
    assert_ptr_equal(abut_failure_get(entry->failure), entry);
    /* Parameters are the program's, 'Section/Name'. */
    assert_null(strchr(entry->remedy, '/'));
    last = (int)entry->failure;
  }
  assert_true(n > 0);
  assert_null(abut_failure_at(-1));
  assert_null(abut_failure_get(ABUT_FAILURE_NONE));
}

static void
ends_of_strategies_name_what_was_measured(void **state)
{
  (void)state;
  static const struct
  {
    abut_reason reason;
    const char *law;
    int32_t step, fallback_steps;
    double penalty;
    abut_failure seen, failure;
  } cases[] = {
      {ABUT_REASON_CONVERGED, "lagrange", 5, 0, 0, 0, ABUT_FAILURE_NONE},
      {ABUT_REASON_CONVERGED, "lagrange", 5, 1, 0, 0, ABUT_FAILURE_CYCLE},
      /* A limit is a limit, and no more, unless something else was seen. */
      {ABUT_REASON_STEP_LIMIT, "lagrange", 1, 0, 0, 0, ABUT_FAILURE_STEP_LIMIT},
      {ABUT_REASON_STEP_LIMIT, "lagrange", 12, 0, 0, 0,
       ABUT_FAILURE_STEP_LIMIT},
      {ABUT_REASON_STEP_LIMIT, "lagrange", 13, 0, 0, 0,
       ABUT_FAILURE_COLD_START},
      {ABUT_REASON_STEP_LIMIT, "lagrange", 50, 0, 0, 0,
       ABUT_FAILURE_COLD_START},
      {ABUT_REASON_STEP_LIMIT, "lagrange", 50, 3, 0, 0, ABUT_FAILURE_CYCLE},
      {ABUT_REASON_STEP_LIMIT, "quadratic penalty", 3, 0, 10, 0,
       ABUT_FAILURE_STEP_LIMIT},
      {ABUT_REASON_STEP_LIMIT, "quadratic penalty", 30, 0, 1e6,
       ABUT_FAILURE_PENALTY, ABUT_FAILURE_PENALTY},
      {ABUT_REASON_STAGNATION, "augmented lagrangian", 9, 0, 20,
       ABUT_FAILURE_MULTIPLIERS_STALL, ABUT_FAILURE_MULTIPLIERS_STALL},
      {ABUT_REASON_INFEASIBLE, "barrier", 1, 0, 0, 0,
       ABUT_FAILURE_INFEASIBLE_START},
      {ABUT_REASON_STEP_LIMIT, "interior point", 3, 0, 0, 0,
       ABUT_FAILURE_STEP_LIMIT},
      {ABUT_REASON_STAGNATION, "interior point", 30, 0, 0,
       ABUT_FAILURE_INTERIOR, ABUT_FAILURE_INTERIOR},
      {ABUT_REASON_STEP_LIMIT, "nitsche", 1, 0, 10, 0, ABUT_FAILURE_STEP_LIMIT},
      {ABUT_REASON_STEP_LIMIT, "nitsche", 60, 1, 0.1, 0, ABUT_FAILURE_NITSCHE},
      {ABUT_REASON_STEP_LIMIT, "nitsche", 60, 1, 10, 0, ABUT_FAILURE_CYCLE},
      /* From 1 on nitsche may be stable; 0 is no penalty, and other laws have
       * small ones. */
      {ABUT_REASON_STEP_LIMIT, "nitsche", 9, 0, 1, 0, ABUT_FAILURE_STEP_LIMIT},
      {ABUT_REASON_STEP_LIMIT, "nitsche", 9, 0, 0, 0, ABUT_FAILURE_STEP_LIMIT},
      {ABUT_REASON_STEP_LIMIT, "penalty", 9, 0, 0.5, 0,
       ABUT_FAILURE_STEP_LIMIT},
      {ABUT_REASON_NOT_FINITE, "penalty", 1, 0, 50, 0, ABUT_FAILURE_NOT_FINITE},
      {ABUT_REASON_UNHELD, "penalty", 1, 0, 50, 0, ABUT_FAILURE_FREE_SLIDING},
  };
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i)
  {
    abut_progress progress = {.struct_size = sizeof(progress)};
    progress.step = cases[i].step;
    progress.fallback_steps = cases[i].fallback_steps;
    progress.penalty = cases[i].penalty;
    progress.seen = cases[i].seen;
    assert_int_equal(abut_reason_failure(cases[i].reason,
                                         abut_law_find(cases[i].law),
                                         &progress),
                     cases[i].failure);
  }
  assert_int_equal(abut_reason_failure(ABUT_REASON_CONVERGED, NULL, NULL),
                   ABUT_FAILURE_NONE);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(codes_are_numbers_in_order),
      cmocka_unit_test(ends_of_strategies_name_what_was_measured)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
