/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Contexts: counted and replaceable memory, life cycle, messages. */
#include "base/memory.h"
#include "fixture.h"
#include "scarce.h"

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
  options.allocate = scarce_supply;
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
      cmocka_unit_test(arguments_are_checked),
      cmocka_unit_test(a_context_outlives_its_objects),
      cmocka_unit_test(memory_is_aligned_and_counted),
      cmocka_unit_test(arrays_grow_and_keep_their_contents),
      cmocka_unit_test(status_texts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
