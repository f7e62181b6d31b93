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

static abut_failure
failure_of(abut_reason reason, const char *law, int32_t fallback_steps)
{
  abut_progress progress = {.struct_size = sizeof(progress)};
  progress.fallback_steps = fallback_steps;
  return abut_reason_failure(reason, abut_law_find(law), &progress);
}

static void
ends_of_strategies_name_their_failure(void **state)
{
  (void)state;
  static const struct
  {
    abut_reason reason;
    const char *law;
    int32_t fallback_steps;
    abut_failure failure;
  } cases[] = {
      {ABUT_REASON_CONVERGED, "lagrange", 0, ABUT_FAILURE_NONE},
      {ABUT_REASON_CONVERGED, "lagrange", 1, ABUT_FAILURE_CYCLE},
      {ABUT_REASON_STEP_LIMIT, "lagrange", 0, ABUT_FAILURE_COLD_START},
      {ABUT_REASON_STEP_LIMIT, "quadratic penalty", 0, ABUT_FAILURE_PENALTY},
      {ABUT_REASON_STAGNATION, "augmented lagrangian", 0,
       ABUT_FAILURE_MULTIPLIERS_STALL},
      {ABUT_REASON_INFEASIBLE, "barrier", 0, ABUT_FAILURE_INFEASIBLE_START},
      {ABUT_REASON_STEP_LIMIT, "interior point", 0, ABUT_FAILURE_INTERIOR},
      {ABUT_REASON_STEP_LIMIT, "nitsche", 1, ABUT_FAILURE_NITSCHE},
      {ABUT_REASON_NOT_FINITE, "penalty", 0, ABUT_FAILURE_FLOATING_BODY},
  };
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i)
    assert_int_equal(
        failure_of(cases[i].reason, cases[i].law, cases[i].fallback_steps),
        cases[i].failure);
  assert_int_equal(abut_reason_failure(ABUT_REASON_CONVERGED, NULL, NULL),
                   ABUT_FAILURE_NONE);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(codes_are_numbers_in_order),
      cmocka_unit_test(ends_of_strategies_name_their_failure)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
