/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Contexts: counted and replaceable memory, life cycle, messages. */
#include "base/memory.h"
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

/* A supplier of memory that fails after so many allocations and counts what
 * is out. */
typedef struct supplier
{
  int64_t allowed, n_live;
  uint64_t bytes_live;
} supplier;

static void *
supply(void *user, size_t bytes, size_t alignment)
{
  supplier *s = user;
  if (s->allowed == 0)
    return NULL;
  s->allowed -= 1;
  s->n_live += 1;
  s->bytes_live += bytes;
  return aligned_alloc(alignment,
                       (bytes + alignment - 1) / alignment * alignment);
}

static void
take_back(void *user, void *memory, size_t bytes)
{
  supplier *s = user;
  s->n_live -= 1;
  s->bytes_live -= bytes;
  free(memory);
}

static abut_context_options
options_of(supplier *s)
{
  abut_context_options options = abut_context_defaults();
  options.user = s;
  options.allocate = supply;
  options.release = take_back;
  return options;
}

/* A whole solve, from rows to answer. */
static abut_status
solve_something(abut_context *context)
{
  const double k[] = {2, -1, -1, 2}, f[] = {-1, -1}, one = 1;
  const int32_t nodes[] = {0, 1};
  abut_points *points = NULL;
  abut_status status = abut_points_create(context, 1, &points);
  for (int i = 0; i < 2 && status == ABUT_SUCCESS; ++i)
    status = abut_points_append_scalar(points, i, 1, 0.1, ABUT_POINT_CONTACT, 1,
                                       &nodes[i], &one);
  const abut_dense_model model = {sizeof(model), 2, k, f, points};
  const abut_strategy_options options = exact_options();
  double u[2] = {0, 0}, p[2] = {0, 0};
  if (status == ABUT_SUCCESS)
    status = abut_dense_model_solve(context, &model, &options, u, p, NULL, NULL,
                                    NULL, NULL, NULL);
  if (points != NULL)
    assert_ok(abut_points_destroy(&points));
  if (status == ABUT_SUCCESS)
  {
    /* Symmetric: u = -0.1 on both, reaction k u - f = -0.1 + 1. */
    assert_close(u[0], -0.1, 1e-14);
    assert_close(p[1], 0.9, 1e-14);
  }
  return status;
}

static void
every_lack_of_memory_is_reported(void **unused)
{
  (void)unused;
  abut_status status = ABUT_OUT_OF_MEMORY;
  int64_t allowed = 1;
  for (; status != ABUT_SUCCESS; ++allowed)
  {
    supplier memory = {allowed, 0, 0};
    const abut_context_options options = options_of(&memory);
    abut_context *context = NULL;
    assert_ok(abut_context_create(&options, &context));
    status = solve_something(context);
    assert_true(status == ABUT_SUCCESS || status == ABUT_OUT_OF_MEMORY);
    if (status != ABUT_SUCCESS)
      assert_true(strlen(abut_context_message(context)) > 0);
    assert_int_equal(abut_context_memory(context).live_bytes, 0);
    assert_ok(abut_context_destroy(&context));
    assert_int_equal(memory.n_live, 0);
    assert_int_equal(memory.bytes_live, 0);
  }
  assert_true(allowed > 5);
}

static void
creation_without_memory_fails(void **unused)
{
  (void)unused;
  supplier memory = {0, 0, 0};
  const abut_context_options options = options_of(&memory);
  abut_context *context = NULL;
  assert_int_equal(abut_context_create(&options, &context), ABUT_OUT_OF_MEMORY);
  assert_null(context);
}

static void
arguments_are_checked(void **unused)
{
  (void)unused;
  abut_context *context = NULL;
  assert_int_equal(abut_context_create(NULL, NULL), ABUT_INVALID_ARGUMENT);
  abut_context_options options = abut_context_defaults();
  options.struct_size = 1;
  assert_int_equal(abut_context_create(&options, &context),
                   ABUT_INVALID_ARGUMENT);
  options = abut_context_defaults();
  options.allocate = supply;
  assert_int_equal(abut_context_create(&options, &context),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_context_destroy(NULL), ABUT_INVALID_ARGUMENT);
  assert_ok(abut_context_destroy(&context));
  assert_string_equal(abut_context_message(NULL), "");
  assert_int_equal(abut_context_memory(NULL).n_allocations, 0);
}

static void
a_context_outlives_its_objects(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  assert_int_equal(abut_context_destroy(&context), ABUT_INVALID_ARGUMENT);
  assert_non_null(context);
  assert_string_equal(
      abut_context_message(context),
      "abut_context_destroy: 1 objects of this context are still alive");
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
  assert_null(context);
}

static void
memory_is_aligned_and_counted(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  void *a = abut_allocate(context, 100), *b = abut_allocate(context, 1);
  assert_int_equal((uintptr_t)a % ABUT_ALIGNMENT, 0);
  assert_int_equal((uintptr_t)b % ABUT_ALIGNMENT, 0);
  abut_release(context, a, 100);
  abut_memory_usage usage = abut_context_memory(context);
  assert_int_equal(usage.live_bytes, 1);
  assert_int_equal(usage.peak_bytes, 101);
  assert_int_equal(usage.n_allocations, 2);
  abut_release(context, b, 1);
  abut_release(context, NULL, 7);
  assert_int_equal(abut_context_memory(context).live_bytes, 0);
  assert_ok(abut_context_destroy(&context));
}

static void
arrays_grow_and_keep_their_contents(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  abut_array array = {NULL, 0, sizeof(int64_t)};
  const int64_t n = 1000;
  for (int64_t i = 0; i < n; ++i)
  {
    assert_ok(abut_array_reserve(context, &array, i, i + 1));
    ((int64_t *)array.data)[i] = i;
  }
  for (int64_t i = 0; i < n; ++i)
    assert_int_equal(((int64_t *)array.data)[i], i);
  /* Doubling: at most log2(1000) + 1 allocations. */
  assert_true(abut_context_memory(context).n_allocations <= 11);
  assert_int_equal(abut_array_reserve(context, &array, n, INT64_MAX),
                   ABUT_OUT_OF_MEMORY);
  abut_array_release(context, &array);
  assert_int_equal(abut_context_memory(context).live_bytes, 0);
  assert_ok(abut_context_destroy(&context));
}

static void
status_texts(void **unused)
{
  (void)unused;
  assert_string_equal(abut_status_text(ABUT_SUCCESS), "success");
  assert_string_equal(abut_status_text(ABUT_OUT_OF_MEMORY), "out of memory");
  assert_string_equal(abut_status_text((abut_status)77), "unknown status");
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_lack_of_memory_is_reported),
      cmocka_unit_test(creation_without_memory_fails),
      cmocka_unit_test(arguments_are_checked),
      cmocka_unit_test(a_context_outlives_its_objects),
      cmocka_unit_test(memory_is_aligned_and_counted),
      cmocka_unit_test(arrays_grow_and_keep_their_contents),
      cmocka_unit_test(status_texts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
