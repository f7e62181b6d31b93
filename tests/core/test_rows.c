/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "fixture.h"

#include <string.h>

typedef struct scene
{
  abut_context *context;
  abut_rows *rows;
} scene;

static scene
open_scene(void)
{
  scene s = {fixture_context(), NULL};
  assert_ok(abut_rows_create(s.context, &s.rows));
  return s;
}

static void
close_scene(scene *s)
{
  assert_ok(abut_rows_destroy(&s->rows));
  assert_null(s->rows);
  assert_int_equal(abut_context_memory(s->context).live_bytes, 0);
  assert_ok(abut_context_destroy(&s->context));
}

/* Row i: g = i/10 + 2 u_i - u_(i+1), weight i + 1. */
static void
append_chain(abut_rows *rows, int n)
{
  for (int i = 0; i < n; ++i)
  {
    const int64_t column[] = {100 + i, 101 + i};
    const double coefficient[] = {2, -1};
    assert_ok(abut_rows_append(rows, 10 * i, i + 1, 0.1 * i, i % 2, 2, column,
                               coefficient));
  }
}

static void
view_shows_what_was_appended(void **unused)
{
  (void)unused;
  scene s = open_scene();
  append_chain(s.rows, 50);
  abut_rows_view view;
  assert_ok(abut_rows_get(s.rows, &view));
  assert_int_equal(view.n_rows, 50);
  assert_int_equal(view.row_start[0], 0);
  for (int i = 0; i < 50; ++i)
  {
    assert_int_equal(view.id[i], 10 * i);
    assert_int_equal(view.bilateral[i], i % 2);
    assert_int_equal(view.row_start[i + 1], 2 * i + 2);
    assert_int_equal(view.column[2 * i + 1], 101 + i);
    assert_close(view.weight[i], i + 1, 0);
    assert_close(view.initial_gap[i], 0.1 * i, 0);
    assert_close(view.coefficient[2 * i], 2, 0);
  }
  close_scene(&s);
}

static void
gap_and_force_are_transposed(void **unused)
{
  (void)unused;
  scene s = open_scene();
  append_chain(s.rows, 50);
  double u[51], gap[50], p[50], force[51] = {0};
  uint64_t seed = 1;
  for (int i = 0; i < 51; ++i)
    u[i] = fixture_random(&seed) - 0.5;
  for (int i = 0; i < 50; ++i)
    p[i] = fixture_random(&seed);
  assert_ok(abut_rows_gap(s.rows, u, 100, 51, gap));
  assert_ok(abut_rows_add_force(s.rows, p, 100, 51, force));
  double work_of_force = 0, work_of_pressure = 0;
  for (int i = 0; i < 50; ++i)
  {
    assert_close(gap[i], 0.1 * i + 2 * u[i] - u[i + 1], 1e-15);
    work_of_pressure += (i + 1) * p[i] * (gap[i] - 0.1 * i);
  }
  for (int i = 0; i < 51; ++i)
    work_of_force += force[i] * u[i];
  assert_close(work_of_force, work_of_pressure, 1e-13);
  close_scene(&s);
}

static void
clear_keeps_the_memory(void **unused)
{
  (void)unused;
  scene s = open_scene();
  append_chain(s.rows, 50);
  const abut_memory_usage before = abut_context_memory(s.context);
  assert_ok(abut_rows_clear(s.rows));
  abut_rows_view view;
  assert_ok(abut_rows_get(s.rows, &view));
  assert_int_equal(view.n_rows, 0);
  append_chain(s.rows, 50);
  const abut_memory_usage after = abut_context_memory(s.context);
  assert_int_equal(before.n_allocations, after.n_allocations);
  close_scene(&s);
}

static void
reserved_rows_need_no_memory(void **unused)
{
  (void)unused;
  scene s = open_scene();
  assert_ok(abut_rows_reserve(s.rows, 50, 100));
  const abut_memory_usage before = abut_context_memory(s.context);
  append_chain(s.rows, 50);
  const abut_memory_usage after = abut_context_memory(s.context);
  assert_int_equal(before.n_allocations, after.n_allocations);
  close_scene(&s);
}

static void
appending_checks_its_row(void **unused)
{
  (void)unused;
  scene s = open_scene();
  const int64_t column[] = {0, -1};
  const double b[] = {1, NAN};
  assert_ok(abut_rows_append(s.rows, 5, 1, 0, 0, 1, column, b));
  assert_int_equal(abut_rows_append(s.rows, 5, 1, 0, 0, 1, column, b),
                   ABUT_INVALID_ARGUMENT);
  assert_non_null(strstr(abut_context_message(s.context), "row 5"));
  assert_int_equal(abut_rows_append(s.rows, 6, 0, 0, 0, 1, column, b),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_append(s.rows, 6, NAN, 0, 0, 1, column, b),
                   ABUT_NOT_FINITE);
  assert_int_equal(abut_rows_append(s.rows, 6, 1, INFINITY, 0, 1, column, b),
                   ABUT_NOT_FINITE);
  assert_int_equal(abut_rows_append(s.rows, 6, 1, 0, 0, 2, column, b),
                   ABUT_NOT_FINITE);
  assert_int_equal(abut_rows_append(s.rows, 6, 1, 0, 0, 1, column + 1, b),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_append(s.rows, 6, 1, 0, 0, 1, NULL, b),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_append(s.rows, 6, 1, 0, 0, -1, column, b),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_append(NULL, 6, 1, 0, 0, 1, column, b),
                   ABUT_INVALID_ARGUMENT);
  /* Nothing of all that was kept. */
  abut_rows_view view;
  assert_ok(abut_rows_get(s.rows, &view));
  assert_int_equal(view.n_rows, 1);
  close_scene(&s);
}

static void
products_check_their_range(void **unused)
{
  (void)unused;
  scene s = open_scene();
  append_chain(s.rows, 2);
  double u[3] = {0, 0, 0}, gap[2], p[2] = {NAN, 0};
  assert_int_equal(abut_rows_gap(s.rows, u, 100, 2, gap),
                   ABUT_INVALID_ARGUMENT);
  assert_non_null(strstr(abut_context_message(s.context), "column 102"));
  assert_int_equal(abut_rows_gap(s.rows, u, 101, 3, gap),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_gap(s.rows, NULL, 100, 3, gap),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_gap(s.rows, u, 100, 3, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_gap(NULL, u, 100, 3, gap), ABUT_INVALID_ARGUMENT);
  u[1] = INFINITY;
  assert_int_equal(abut_rows_gap(s.rows, u, 100, 3, gap), ABUT_NOT_FINITE);
  assert_int_equal(abut_rows_add_force(s.rows, p, 100, 3, u), ABUT_NOT_FINITE);
  assert_int_equal(abut_rows_add_force(s.rows, NULL, 100, 3, u),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_add_force(NULL, p, 100, 3, u),
                   ABUT_INVALID_ARGUMENT);
  close_scene(&s);
}

static void
other_arguments_are_checked(void **unused)
{
  (void)unused;
  scene s = open_scene();
  abut_rows *none = NULL;
  assert_int_equal(abut_rows_create(NULL, &none), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_create(s.context, NULL), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_destroy(NULL), ABUT_INVALID_ARGUMENT);
  assert_ok(abut_rows_destroy(&none));
  assert_int_equal(abut_rows_clear(NULL), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_reserve(NULL, 1, 1), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_reserve(s.rows, -1, 1), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_reserve(s.rows, 1, -1), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_rows_get(s.rows, NULL), ABUT_INVALID_ARGUMENT);
  abut_rows_view view;
  assert_int_equal(abut_rows_get(NULL, &view), ABUT_INVALID_ARGUMENT);
  close_scene(&s);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(view_shows_what_was_appended),
      cmocka_unit_test(gap_and_force_are_transposed),
      cmocka_unit_test(clear_keeps_the_memory),
      cmocka_unit_test(reserved_rows_need_no_memory),
      cmocka_unit_test(appending_checks_its_row),
      cmocka_unit_test(products_check_their_range),
      cmocka_unit_test(other_arguments_are_checked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
