/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Callers of other versions: structs that are shorter or longer than this
 * library's. They lie in memory of exactly their size, so that the sanitizer
 * sees what is touched beyond. */
#include "surface_fixture.h"

#include <abut/abut.h>
#include <stddef.h>
#include <stdio.h>

/* A struct as a caller of another version has it. */
static void *
resized(const void *present, size_t size, size_t stated)
{
  unsigned char *copy = malloc(stated);
  assert_non_null(copy);
  memset(copy, 0, stated);
  memcpy(copy, present, size < stated ? size : stated);
  memcpy(copy, &stated, sizeof(stated));
  return copy;
}

static void
older_options_get_defaults(void **unused)
{
  (void)unused;
  /* A caller from before pressure_scale and all that follows it: its run is
   * that of the defaults. */
  abut_strategy_options o = abut_strategy_defaults();
  o.length_scale = 2;
  o.max_steps = 0; /* not legal: must not be read */
  abut_strategy_options *old =
      resized(&o, sizeof(o), offsetof(abut_strategy_options, pressure_scale));
  abut_strategy *s = NULL;
  require(abut_strategy_create(context, old, &s));
  require(abut_strategy_destroy(&s));
  free(old);
}

static void
older_surfaces_get_defaults(void **unused)
{
  (void)unused;
  scene_mesh m = scene_square(ABUT_FACET_QUAD4, 1, 0., false);
  abut_surface_data d = scene_data(&m);
  d.feature_angle = -1; /* not legal: must not be read */
  abut_surface_data *old =
      resized(&d, sizeof(d), offsetof(abut_surface_data, feature_angle));
  abut_surface *s = NULL;
  require(abut_surface_create(context, old, &s));
  abut_surface_sizes z;
  require(abut_surface_measure(s, &z));
  assert_true(fabs(z.area - 1.) < 1e-14);
  require(abut_surface_destroy(&s));
  free(old);
  scene_free(&m);
}

static void
newer_options_may_not_ask_for_the_unknown(void **unused)
{
  (void)unused;
  scene_mesh m = scene_square(ABUT_FACET_QUAD4, 1, 0., false);
  abut_surface *s = surface_of(&m);
  const abut_detection_options o = abut_detection_defaults();
  const size_t stated = sizeof(o) + 16;
  unsigned char *newer = resized(&o, sizeof(o), stated);
  abut_detection *d = NULL;
  require(abut_detection_create(context, s, s, (abut_detection_options *)newer,
                                &d));
  require(abut_detection_destroy(&d));
  newer[stated - 1] = 1;
  assert_int_equal(
      abut_detection_create(context, s, s, (abut_detection_options *)newer, &d),
      ABUT_INVALID_ARGUMENT);
  assert_non_null(strstr(abut_context_message(context), "does not have"));
  free(newer);
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

static void
sizes_of_no_version_are_refused(void **unused)
{
  (void)unused;
  const size_t wrong[] = {0, 1, 8, 20, 5000, (size_t)-8};
  for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); ++i)
  {
    abut_strategy_options o = abut_strategy_defaults();
    abut_strategy *s = NULL;
    o.struct_size = wrong[i];
    assert_int_equal(abut_strategy_create(context, &o, &s),
                     ABUT_INVALID_ARGUMENT);
    abut_memory_usage usage = {.struct_size = wrong[i], .live_bytes = 77};
    assert_int_equal(abut_context_memory_sized(context, &usage),
                     ABUT_INVALID_ARGUMENT);
    assert_int_equal(usage.live_bytes, 77);
  }
}

static void
searches_within_other_options_keep_their_room(void **unused)
{
  (void)unused;
  scene_mesh m = scene_square(ABUT_FACET_QUAD4, 1, 0., false);
  abut_surface *s = surface_of(&m);
  abut_coupling_options o = abut_coupling_defaults();
  abut_coupling *c = NULL;
  o.search.reserved[3] = 1.;
  assert_int_equal(abut_coupling_create(context, s, s, &o, &c),
                   ABUT_INVALID_ARGUMENT);
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

static void
older_results_are_filled_as_far_as_they_go(void **unused)
{
  (void)unused;
  scene_mesh m = scene_square(ABUT_FACET_QUAD4, 3, 0., false);
  abut_surface *s = surface_of(&m);
  const size_t stated = offsetof(abut_surface_view, connectivity);
  abut_surface_view *old = malloc(stated);
  old->struct_size = stated;
  require(abut_surface_get_sized(s, old));
  assert_int_equal(old->struct_size, stated);
  assert_int_equal(old->n_nodes, 16);
  assert_int_equal(old->n_facets, 9);
  assert_int_equal(old->facet_start[9], 36);
  free(old);
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

static void
newer_results_have_zeros_at_their_ends(void **unused)
{
  (void)unused;
  const size_t stated = sizeof(abut_memory_usage) + 16;
  unsigned char *newer = malloc(stated);
  memset(newer, 255, stated);
  memcpy(newer, &stated, sizeof(stated));
  require(abut_context_memory_sized(context, (abut_memory_usage *)newer));
  assert_int_equal(((abut_memory_usage *)newer)->live_bytes,
                   abut_context_memory(context).live_bytes);
  for (size_t i = sizeof(abut_memory_usage); i < stated; ++i)
    assert_int_equal(newer[i], 0);
  free(newer);
}

/* A strategy without rows stops at its first request. */
static void
older_requests_and_progress(void **unused)
{
  (void)unused;
  const abut_strategy_options o = abut_strategy_defaults();
  abut_strategy *s = NULL;
  require(abut_strategy_create(context, &o, &s));
  require(abut_strategy_start(s, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL));
  const size_t stated = offsetof(abut_request, linear_tolerance);
  abut_request *request = malloc(stated);
  request->struct_size = stated;
  abut_progress *progress =
      malloc(offsetof(abut_progress, n_active)); /* steps and rows only */
  progress->struct_size = offsetof(abut_progress, n_active);
  require(abut_strategy_next_sized(s, NULL, request));
  assert_int_equal(request->action, ABUT_ACTION_SOLVE);
  require(abut_strategy_progress_sized(s, progress));
  assert_int_equal(progress->step, 1);
  assert_int_equal(progress->n_rows, 0);
  assert_int_equal(abut_reason_failure(ABUT_REASON_INFEASIBLE,
                                       abut_law_find("barrier"), progress),
                   ABUT_FAILURE_INFEASIBLE_START);
  free(request);
  free(progress);
  require(abut_strategy_destroy(&s));
}

/* Friction's structs: what is beyond the caller's end is not read. */
static void
older_and_newer_friction(void **unused)
{
  (void)unused;
  const uint8_t n_tangents = 1;
  const double one = 1, slip = 2, traction = 3;
  double c = 0, a = 0, b = 0, c_p = 0;
  const abut_friction_points points = {sizeof(points), 1,    &n_tangents, &slip,
                                       &traction,      NULL, NULL,        &one,
                                       &one,           &one};
  const abut_friction_linearisation places = {sizeof(places), &c,  &a, &b,
                                              &c_p,           NULL};
  abut_friction_linearisation *old =
      resized(&places, sizeof(places),
              offsetof(abut_friction_linearisation, direction));
  const uint8_t state = ABUT_STATE_CLOSED;
  require(abut_friction_linearise(&points, &state, old));
  assert_true(c == 2 && a == 0 && b == 1 && c_p == 0);
  /* The bound's derivative comes last. */
  abut_friction_points *cut =
      resized(&points, sizeof(points), offsetof(abut_friction_points, d_bound));
  assert_int_equal(abut_friction_linearise(cut, &state, old),
                   ABUT_INVALID_ARGUMENT);
  abut_friction_points *newer =
      resized(&points, sizeof(points), sizeof(points) + 8);
  require(abut_friction_linearise(newer, &state, old));
  ((unsigned char *)newer)[sizeof(points)] = 1;
  assert_int_equal(abut_friction_linearise(newer, &state, old),
                   ABUT_INVALID_ARGUMENT);
  free(old);
  free(cut);
  free(newer);
}

/* A strategy's friction from before the traction it starts from. */
static void
older_friction_of_a_strategy(void **unused)
{
  (void)unused;
  const int32_t first = 0;
  const uint8_t n_tangents = 1;
  const double mu = 0.5, wrong = NAN;
  const abut_strategy_options o = abut_strategy_defaults();
  abut_strategy *s = NULL;
  require(abut_strategy_create(context, &o, &s));
  const abut_strategy_friction friction = {.struct_size = sizeof(friction),
                                           .n = 1,
                                           .first = &first,
                                           .n_tangents = &n_tangents,
                                           .coefficient = &mu,
                                           .reference_traction = &wrong};
  assert_int_equal(abut_strategy_set_friction(s, &friction), ABUT_NOT_FINITE);
  abut_strategy_friction *old =
      resized(&friction, sizeof(friction),
              offsetof(abut_strategy_friction, reference_traction));
  require(abut_strategy_set_friction(s, old));
  free(old);
  require(abut_strategy_destroy(&s));
}

/* A law p = 2 g + 3 at p = 0, g = 0 that is not held: dp = 3 + 2 dg. Trial and
 * test are the last fields of the result. */
static void
older_callers_condense(void **unused)
{
  (void)unused;
  const double p = 0, c = -3, a = 1, b = -2, dg = 5;
  const abut_condense_points given = {.struct_size = sizeof(given),
                                      .n = 1,
                                      .pressure = &p,
                                      .residual = &c,
                                      .d_pressure = &a,
                                      .d_gap = &b};
  uint8_t held;
  double value, force, spring, wrong = 77, dp = 0;
  const abut_condensed places = {.struct_size = sizeof(places),
                                 .held = &held,
                                 .value = &value,
                                 .force = &force,
                                 .spring = &spring,
                                 .trial = &wrong, /* must not be read */
                                 .test = &wrong};
  abut_condensed *old =
      resized(&places, sizeof(places), offsetof(abut_condensed, trial));
  abut_condense_points *newer =
      resized(&given, sizeof(given), sizeof(given) + 16);
  require(abut_condense(newer, old));
  require(abut_condense_recover(newer, &dg, &dp));
  assert_int_equal(held, 0);
  assert_true(force == 3 && spring == -2 && wrong == 77 && dp == 13);
  ((unsigned char *)newer)[sizeof(given) + 3] = 1;
  assert_int_equal(abut_condense(newer, old), ABUT_INVALID_ARGUMENT);
  old->struct_size = 1;
  assert_int_equal(abut_condense(&given, old), ABUT_INVALID_ARGUMENT);
  free(newer);
  free(old);
}

static void
older_callers_remember(void **unused)
{
  (void)unused;
  abut_history *h = NULL;
  require(abut_history_create(context, &h));
  const int64_t id = 4;
  const double pressure = 2, far[3] = {NAN, NAN, NAN};
  const uint8_t state = 1;
  const abut_history_entries entries = {
      sizeof(entries), 1, &id, &pressure, &state, far /* must not be read */};
  abut_history_entries *old =
      resized(&entries, sizeof(entries), offsetof(abut_history_entries, place));
  require(abut_history_set(h, old));
  uint8_t found = 77;
  double p = 0;
  const abut_history_values past = {sizeof(past), &p, NULL, &found};
  abut_history_values *old_past =
      resized(&past, sizeof(past), offsetof(abut_history_values, found));
  require(abut_history_get(h, ABUT_HISTORY_TRIAL, 1, &id, old_past));
  assert_true(p == 2 && found == 77);
  old->struct_size = 8;
  assert_int_equal(abut_history_set(h, old), ABUT_INVALID_ARGUMENT);
  assert_non_null(strstr(abut_context_message(context), "abut_history_set: "));
  assert_non_null(strstr(abut_context_message(context), "to no version"));
  old_past->struct_size = 8;
  assert_int_equal(abut_history_get(h, ABUT_HISTORY_TRIAL, 1, &id, old_past),
                   ABUT_INVALID_ARGUMENT);
  assert_non_null(strstr(abut_context_message(context), "to no version"));
  free(old);
  free(old_past);
  require(abut_history_destroy(&h));
}

static void
the_library_tells_its_version(void **unused)
{
  (void)unused;
  char text[32];
  (void)snprintf(text, sizeof(text), "%d.%d.%d", abut_version() / 10000,
                 abut_version() / 100 % 100, abut_version() % 100);
  assert_string_equal(text, ABUT_VERSION);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(older_options_get_defaults, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(older_surfaces_get_defaults, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(newer_options_may_not_ask_for_the_unknown,
                                      set_up, tear_down),
      cmocka_unit_test_setup_teardown(sizes_of_no_version_are_refused, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(
          searches_within_other_options_keep_their_room, set_up, tear_down),
      cmocka_unit_test_setup_teardown(
          older_results_are_filled_as_far_as_they_go, set_up, tear_down),
      cmocka_unit_test_setup_teardown(newer_results_have_zeros_at_their_ends,
                                      set_up, tear_down),
      cmocka_unit_test_setup_teardown(older_requests_and_progress, set_up,
                                      tear_down),
      cmocka_unit_test(older_callers_condense),
      cmocka_unit_test(older_and_newer_friction),
      cmocka_unit_test_setup_teardown(older_friction_of_a_strategy, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(older_callers_remember, set_up,
                                      tear_down),
      cmocka_unit_test(the_library_tells_its_version),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
