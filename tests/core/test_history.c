/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

typedef struct scene
{
  abut_context *context;
  abut_history *history;
} scene;

static scene
open_scene(void)
{
  scene s = {fixture_context(), NULL};
  assert_ok(abut_history_create(s.context, &s.history));
  return s;
}

static void
close_scene(scene *s)
{
  assert_ok(abut_history_destroy(&s->history));
  assert_null(s->history);
  assert_int_equal(abut_context_memory(s->context).live_bytes, 0);
  assert_ok(abut_context_destroy(&s->context));
}

enum
{
  most = 200
};

/* Entries and the arrays that they point to. */
typedef struct values
{
  int64_t id[most];
  double pressure[most];
  uint8_t state[most];
  double place[3 * most];
  abut_history_entries entries;
} values;

/* Points first, first + stride, ...: pressures and places by chance. */
static void
make_values(values *v, int n, int64_t first, int64_t stride, uint64_t seed)
{
  for (int i = 0; i < n; ++i)
  {
    v->id[i] = first + i * stride;
    v->pressure[i] = fixture_random(&seed);
    v->state[i] = fixture_random(&seed) > 0.5;
    for (int d = 0; d < 3; ++d)
      v->place[3 * i + d] = fixture_random(&seed);
  }
  const abut_history_entries entries = {sizeof(entries), n,        v->id,
                                        v->pressure,     v->state, v->place};
  v->entries = entries;
}

static abut_history_entries
view_of(const abut_history *history, abut_history_version version)
{
  abut_history_entries view = {.struct_size = sizeof(view)};
  assert_ok(abut_history_view(history, version, &view));
  return view;
}

static void
assert_same(const abut_history_entries *a, const abut_history_entries *b)
{
  assert_int_equal(a->n, b->n);
  const size_t n = (size_t)a->n;
  assert_memory_equal(a->id, b->id, n * sizeof(int64_t));
  assert_memory_equal(a->pressure, b->pressure, n * sizeof(double));
  assert_memory_equal(a->state, b->state, n);
  if (a->place != NULL || b->place != NULL)
    assert_memory_equal(a->place, b->place, 3 * n * sizeof(double));
}

static abut_history_problem
some_problem(void)
{
  abut_history_problem problem = {.struct_size = sizeof(problem),
                                  .mesh = 77,
                                  .law = "augmented lagrangian",
                                  .first_penalty = 20,
                                  .penalty = 500,
                                  .resumes = 1};
  return problem;
}

static void
rollback_gives_the_committed_version_bit_for_bit(void **unused)
{
  (void)unused;
  scene s = open_scene();
  values first, second;
  make_values(&first, 100, 5, 3, 1);
  make_values(&second, 150, 0, 2, 2);
  abut_history_problem problem = some_problem();
  assert_ok(abut_history_set(s.history, &first.entries));
  assert_ok(abut_history_set_problem(s.history, ABUT_HISTORY_TRIAL, &problem));
  assert_ok(abut_history_commit(s.history));

  problem.penalty = 2500;
  assert_ok(abut_history_begin_step(s.history));
  assert_ok(abut_history_set(s.history, &second.entries));
  assert_ok(abut_history_set_problem(s.history, ABUT_HISTORY_TRIAL, &problem));
  abut_history_entries trial = view_of(s.history, ABUT_HISTORY_TRIAL);
  assert_same(&trial, &second.entries);
  abut_history_entries committed = view_of(s.history, ABUT_HISTORY_COMMITTED);
  assert_same(&committed, &first.entries);

  assert_ok(abut_history_rollback(s.history));
  trial = view_of(s.history, ABUT_HISTORY_TRIAL);
  assert_same(&trial, &first.entries);
  abut_history_problem found = {.struct_size = sizeof(found)};
  assert_ok(abut_history_get_problem(s.history, ABUT_HISTORY_TRIAL, &found));
  assert_close(found.penalty, 500, 0);
  assert_int_equal(found.mesh, 77);
  assert_string_equal(found.law, "augmented lagrangian");

  assert_ok(abut_history_clear(s.history));
  assert_int_equal(view_of(s.history, ABUT_HISTORY_COMMITTED).n, 0);
  assert_ok(
      abut_history_get_problem(s.history, ABUT_HISTORY_COMMITTED, &found));
  assert_int_equal(found.mesh, 0);
  close_scene(&s);
}

static void
later_entries_replace_and_interleave(void **unused)
{
  (void)unused;
  scene s = open_scene();
  values even, thirds;
  make_values(&even, 100, 0, 2, 3);
  make_values(&thirds, 60, 0, 3, 4);
  assert_ok(abut_history_set(s.history, &even.entries));
  assert_ok(abut_history_set(s.history, &thirds.entries));
  int n = 0;
  int64_t id[most];
  for (int i = 0; i < 200; ++i)
  {
    id[i] = i;
    n += i % 2 == 0 || (i % 3 == 0 && i < 180);
  }
  double pressure[most];
  uint8_t state[most], known[most];
  const abut_history_values past = {sizeof(past), pressure, state, known};
  assert_ok(abut_history_get(s.history, ABUT_HISTORY_TRIAL, 200, id, &past));
  assert_int_equal(view_of(s.history, ABUT_HISTORY_TRIAL).n, n);
  for (int i = 0; i < 200; ++i)
  {
    const values *from = i % 3 == 0 && i < 180 ? &thirds : &even;
    const int k = from == &thirds ? i / 3 : i / 2;
    const bool is_known = from == &thirds || i % 2 == 0;
    assert_int_equal(known[i], is_known);
    assert_close(pressure[i], is_known ? from->pressure[k] : 0, 0);
    assert_int_equal(state[i], is_known ? from->state[k] : 0);
  }
  /* In any order, and of the other version: nothing. */
  const int64_t two[] = {9, 4};
  assert_ok(abut_history_get(s.history, ABUT_HISTORY_TRIAL, 2, two, &past));
  assert_close(pressure[0], thirds.pressure[3], 0);
  assert_close(pressure[1], even.pressure[2], 0);
  assert_ok(abut_history_get(s.history, ABUT_HISTORY_COMMITTED, 2, two, &past));
  assert_int_equal(known[0] + known[1], 0);
  close_scene(&s);
}

static void
places_are_kept_from_the_first_that_is_given(void **unused)
{
  (void)unused;
  scene s = open_scene(), other = open_scene();
  values nodes, points;
  make_values(&nodes, 40, 0, 2, 6);
  make_values(&points, 30, 1, 2, 7);
  nodes.entries.place = NULL;
  assert_ok(abut_history_set(s.history, &nodes.entries));
  assert_null(view_of(s.history, ABUT_HISTORY_TRIAL).place);
  assert_ok(abut_history_commit(s.history));

  /* Points between the nodes: the places of the nodes are 0. */
  assert_ok(abut_history_set(s.history, &points.entries));
  const abut_history_entries view = view_of(s.history, ABUT_HISTORY_TRIAL);
  assert_int_equal(view.n, 70);
  for (int64_t i = 0; i < view.n; ++i)
    for (int d = 0; d < 3; ++d)
    {
      const bool is_point = view.id[i] % 2 == 1;
      assert_close(view.place[3 * i + d],
                   is_point ? points.place[3 * (view.id[i] / 2) + d] : 0, 0);
    }

  /* Bytes hold both kinds of versions. */
  const abut_history_version versions[] = {ABUT_HISTORY_TRIAL,
                                           ABUT_HISTORY_COMMITTED};
  for (int v = 0; v < 2; ++v)
  {
    char bytes[8192];
    size_t size = sizeof(bytes);
    assert_ok(abut_history_pack(s.history, versions[v], bytes, &size));
    assert_ok(abut_history_unpack(other.history, bytes, size));
    const abut_history_entries a = view_of(s.history, versions[v]),
                               b = view_of(other.history, ABUT_HISTORY_TRIAL);
    assert_int_equal(a.place == NULL, v);
    assert_int_equal(b.place == NULL, v);
    assert_same(&a, &b);
  }
  close_scene(&s);
  close_scene(&other);
}

static void
nearest_looks_among_the_points_of_a_facet(void **unused)
{
  (void)unused;
  scene s = open_scene();
  values v;
  make_values(&v, 100, 1000, 1, 5);
  assert_ok(abut_history_set(s.history, &v.entries));
  const int64_t begin[] = {1000, 1020, 1020, 1200};
  const int64_t end[] = {1100, 1040, 1040, 1300};
  const double place[] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0, 0, 0, 0.5, 0.5, 0.5};
  double pressure[4];
  uint8_t found[4];
  const abut_history_values past = {sizeof(past), pressure, NULL, found};
  assert_ok(abut_history_nearest(s.history, ABUT_HISTORY_TRIAL, 4, begin, end,
                                 place, &past));
  for (int k = 0; k < 3; ++k)
  {
    int best = -1;
    double least = 10;
    for (int i = (int)begin[k] - 1000; i < (int)end[k] - 1000; ++i)
    {
      double sum = 0;
      for (int d = 0; d < 3; ++d)
        sum += pow(v.place[3 * i + d] - place[3 * k + d], 2);
      if (sum < least)
      {
        least = sum;
        best = i;
      }
    }
    assert_int_equal(found[k], 1);
    assert_close(pressure[k], v.pressure[best], 0);
  }
  assert_int_equal(found[3], 0);
  assert_close(pressure[3], 0, 0);
  close_scene(&s);
}

static char *
pack(const abut_history *history, abut_history_version version, size_t *bytes)
{
  *bytes = 0;
  assert_ok(abut_history_pack(history, version, NULL, bytes));
  char *blob = malloc(*bytes);
  assert_non_null(blob);
  assert_ok(abut_history_pack(history, version, blob, bytes));
  return blob;
}

static void
bytes_make_the_same_history_again(void **unused)
{
  (void)unused;
  scene s = open_scene(), other = open_scene();
  values v;
  make_values(&v, 120, 7, 11, 6);
  const abut_history_problem problem = some_problem();
  assert_ok(abut_history_set(s.history, &v.entries));
  assert_ok(abut_history_set_problem(s.history, ABUT_HISTORY_TRIAL, &problem));
  size_t bytes;
  char *blob = pack(s.history, ABUT_HISTORY_TRIAL, &bytes);
  assert_true(bytes > 120 * 41 && bytes < 120 * 41 + 256);
  size_t less = bytes - 1;
  assert_int_equal(
      abut_history_pack(s.history, ABUT_HISTORY_TRIAL, blob, &less),
      ABUT_INVALID_ARGUMENT);

  assert_ok(abut_history_unpack(other.history, blob, bytes));
  for (int version = 0; version < 2; ++version)
  {
    const abut_history_entries view =
        view_of(other.history, (abut_history_version)version);
    assert_same(&view, &v.entries);
    abut_history_problem found = {.struct_size = sizeof(found)};
    assert_ok(abut_history_get_problem(other.history,
                                       (abut_history_version)version, &found));
    assert_memory_equal(found.law, problem.law, sizeof(found.law));
    assert_close(found.first_penalty, 20, 0);
    assert_close(found.penalty, 500, 0);
    assert_int_equal(found.resumes, 1);
  }
  free(blob);

  /* One without entries. */
  blob = pack(s.history, ABUT_HISTORY_COMMITTED, &bytes);
  assert_ok(abut_history_unpack(other.history, blob, bytes));
  assert_int_equal(view_of(other.history, ABUT_HISTORY_TRIAL).n, 0);
  free(blob);
  close_scene(&other);
  close_scene(&s);
}

/* Refused, with a text, and without any change. */
static void
assert_refused(const scene *s, const values *kept, const char *blob,
               size_t bytes, const char *text)
{
  assert_int_equal(abut_history_unpack(s->history, blob, bytes),
                   ABUT_INVALID_ARGUMENT);
  if (strstr(abut_context_message(s->context), text) == NULL)
    fail_msg("'%s' does not contain '%s'", abut_context_message(s->context),
             text);
  const abut_history_entries trial = view_of(s->history, ABUT_HISTORY_TRIAL);
  assert_same(&trial, &kept->entries);
}

static void
damaged_bytes_are_refused(void **unused)
{
  (void)unused;
  scene s = open_scene(), other = open_scene();
  values v, kept;
  make_values(&v, 10, 7, 11, 6);
  make_values(&kept, 20, 1, 1, 8);
  assert_ok(abut_history_set(other.history, &kept.entries));
  assert_ok(abut_history_set(s.history, &v.entries));
  size_t bytes;
  char *blob = pack(s.history, ABUT_HISTORY_TRIAL, &bytes);

  /* Copies of their own, so that a sanitizer sees a byte read too much. */
  for (size_t n = 0; n < bytes; ++n)
  {
    char *prefix = malloc(n > 0 ? n : 1);
    assert_non_null(prefix);
    memcpy(prefix, blob, n);
    assert_refused(&other, &kept, prefix, n, "cut off");
    free(prefix);
  }
  for (size_t i = 0; i < bytes; ++i)
    for (int bit = 0; bit < 8; ++bit)
    {
      blob[i] = (char)(blob[i] ^ (1 << bit));
      assert_refused(&other, &kept, blob, bytes, "histor");
      blob[i] = (char)(blob[i] ^ (1 << bit));
    }
  assert_ok(abut_history_unpack(other.history, blob, bytes));
  free(blob);
  close_scene(&other);
  close_scene(&s);
}

static void
foreign_bytes_are_named(void **unused)
{
  (void)unused;
  scene s = open_scene();
  values kept;
  make_values(&kept, 3, 1, 1, 8);
  assert_ok(abut_history_set(s.history, &kept.entries));
  size_t bytes;
  char *blob = pack(s.history, ABUT_HISTORY_TRIAL, &bytes);
  char text[300];
  memset(text, 'x', sizeof(text));
  assert_refused(&s, &kept, text, sizeof(text), "not a contact history");
  const uint32_t order = 0x01020304, swapped = 0x04030201, later = 2;
  assert_memory_equal(blob + 8, &order, 4);
  memcpy(blob + 8, &swapped, 4);
  assert_refused(&s, &kept, blob, bytes, "another byte order");
  memcpy(blob + 8, &order, 4);
  memcpy(blob + 12, &later, 4);
  assert_refused(&s, &kept, blob, bytes, "another version");
  free(blob);
  close_scene(&s);
}

static void
wrong_arguments_are_refused(void **unused)
{
  (void)unused;
  scene s = open_scene();
  values v;
  make_values(&v, 3, 1, 1, 9);
  v.id[2] = v.id[1];
  assert_int_equal(abut_history_set(s.history, &v.entries),
                   ABUT_INVALID_ARGUMENT);
  v.id[2] = 100;
  v.pressure[1] = NAN;
  assert_int_equal(abut_history_set(s.history, &v.entries), ABUT_NOT_FINITE);
  v.pressure[1] = 1;
  v.place[8] = INFINITY;
  assert_int_equal(abut_history_set(s.history, &v.entries), ABUT_NOT_FINITE);
  v.place[8] = 0;
  v.id[0] = -1;
  assert_int_equal(abut_history_set(s.history, &v.entries),
                   ABUT_INVALID_ARGUMENT);
  v.id[0] = 0;
  v.entries.struct_size = 1;
  assert_int_equal(abut_history_set(s.history, &v.entries),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(view_of(s.history, ABUT_HISTORY_TRIAL).n, 0);
  abut_history_problem problem = some_problem();
  memset(problem.law, 'a', sizeof(problem.law));
  assert_int_equal(
      abut_history_set_problem(s.history, ABUT_HISTORY_TRIAL, &problem),
      ABUT_INVALID_ARGUMENT);
  const abut_history_values past = {sizeof(past), NULL, NULL, NULL};
  assert_int_equal(
      abut_history_get(s.history, (abut_history_version)2, 0, NULL, &past),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_history_unpack(s.history, NULL, 0),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_history_create(NULL, &s.history),
                   ABUT_INVALID_ARGUMENT);
  close_scene(&s);
}

static void
steps_allocate_nothing_once_warm(void **unused)
{
  (void)unused;
  scene s = open_scene();
  values v, some;
  make_values(&v, 150, 0, 2, 1);
  make_values(&some, 30, 0, 7, 2);
  uint64_t before = 0;
  for (int step = 0; step < 10; ++step)
  {
    if (step == 2)
      before = abut_context_memory(s.context).n_allocations;
    assert_ok(abut_history_begin_step(s.history));
    assert_ok(abut_history_set(s.history, &v.entries));
    assert_ok(abut_history_set(s.history, &some.entries));
    if (step % 3 == 2)
      assert_ok(abut_history_rollback(s.history));
    else
      assert_ok(abut_history_commit(s.history));
  }
  assert_true(before > 0);
  assert_int_equal(abut_context_memory(s.context).n_allocations, before);
  close_scene(&s);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rollback_gives_the_committed_version_bit_for_bit),
      cmocka_unit_test(later_entries_replace_and_interleave),
      cmocka_unit_test(places_are_kept_from_the_first_that_is_given),
      cmocka_unit_test(nearest_looks_among_the_points_of_a_facet),
      cmocka_unit_test(bytes_make_the_same_history_again),
      cmocka_unit_test(damaged_bytes_are_refused),
      cmocka_unit_test(foreign_bytes_are_named),
      cmocka_unit_test(wrong_arguments_are_refused),
      cmocka_unit_test(steps_allocate_nothing_once_warm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
