/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The front of the strategies: checks, order of calls, memory, reasons to
 * stop, a user's own law. */
#include "fixture.h"
#include "membrane.h"

#include <abut/limits.h>
#include <math.h>
#include <string.h>

static const double one = 1, zero = 0;

typedef struct fixture
{
  abut_context *context;
  abut_strategy *strategy;
} fixture;

static fixture
open_scene(const abut_strategy_options *options)
{
  fixture s = {fixture_context(), NULL};
  assert_ok(abut_strategy_create(s.context, options, &s.strategy));
  return s;
}

static void
close_scene(fixture *s)
{
  assert_ok(abut_strategy_destroy(&s->strategy));
  assert_null(s->strategy);
  assert_int_equal(abut_context_memory(s->context).live_bytes, 0);
  assert_ok(abut_context_destroy(&s->context));
}

/* The penalties that the header names for laws without one of the user's. */
static void
laws_have_first_penalties(void **unused)
{
  (void)unused;
  static const struct
  {
    const char *law;
    double own, given; /* with the option 0, and with 7 */
  } expected[] = {{"penalty", 50, 7},      {"augmented lagrangian", 20, 7},
                  {"nitsche", 10, 7},      {"quadratic penalty", 1, 7},
                  {"lagrange", 0, 0},      {"barrier", 0, 0},
                  {"interior point", 0, 0}};
  abut_strategy_options options = abut_strategy_defaults();
  for (size_t i = 0; i < sizeof(expected) / sizeof(expected[0]); ++i)
  {
    options.law = abut_law_find(expected[i].law);
    assert_non_null(options.law);
    options.penalty = 0;
    assert_true(abut_strategy_first_penalty(&options) == expected[i].own);
    options.penalty = 7;
    assert_true(abut_strategy_first_penalty(&options) == expected[i].given);
  }
  options.law = NULL;
  assert_true(abut_strategy_first_penalty(&options) == 0);
  assert_true(abut_strategy_first_penalty(NULL) == 0);
}

static void
options_are_checked(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  abut_strategy *none = NULL;
  abut_strategy_options options = abut_strategy_defaults();
  assert_int_equal(abut_strategy_create(NULL, &options, &none),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_strategy_create(context, NULL, &none),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_strategy_create(context, &options, NULL),
                   ABUT_INVALID_ARGUMENT);
  double *const numbers[] = {
      &options.length_scale,     &options.pressure_scale,
      &options.penalty,          &options.penalty_growth,
      &options.penalty_cap,      &options.allowed_penetration,
      &options.complementarity,  &options.barrier_start,
      &options.barrier_factor,   &options.barrier_end,
      &options.gap_tolerance,    &options.pressure_tolerance,
      &options.linear_tolerance, &options.final_linear_tolerance};
  for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); ++i)
  {
    const double kept = *numbers[i];
    *numbers[i] = NAN;
    assert_int_equal(abut_strategy_create(context, &options, &none),
                     ABUT_NOT_FINITE);
    *numbers[i] = -1;
    assert_int_equal(abut_strategy_create(context, &options, &none),
                     ABUT_INVALID_ARGUMENT);
    *numbers[i] = kept;
  }
  options.max_steps = 0;
  assert_int_equal(abut_strategy_create(context, &options, &none),
                   ABUT_INVALID_ARGUMENT);
  assert_string_equal(
      abut_context_message(context),
      "abut_strategy_create: max_steps = 0 is not between 1 and 2.14748e9");
  options = abut_strategy_defaults();
  options.struct_size -= 1;
  assert_int_equal(abut_strategy_create(context, &options, &none),
                   ABUT_INVALID_ARGUMENT);
  options = abut_strategy_defaults();
  for (int missing = 0; missing < 5; ++missing)
  {
    abut_law incomplete = *abut_law_find("lagrange");
    if (missing == 0)
      incomplete.linearise = NULL;
    else if (missing == 1)
      incomplete.classify = NULL;
    else if (missing == 2)
      incomplete.name = NULL;
    else if (missing == 3)
      incomplete.struct_size -= 1;
    else
      incomplete.outer = (abut_outer)77;
    options.law = &incomplete;
    assert_int_equal(abut_strategy_create(context, &options, &none),
                     ABUT_INVALID_ARGUMENT);
  }
  assert_null(none);
  assert_ok(abut_strategy_destroy(&none));
  assert_int_equal(abut_strategy_destroy(NULL), ABUT_INVALID_ARGUMENT);
  assert_ok(abut_context_destroy(&context));
}

/* The table of limits is what the check goes by, open ends included. */
static void
limits_are_those_of_the_check(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  abut_strategy *strategy = NULL;
  abut_strategy_options options = abut_strategy_defaults();
  const struct
  {
    const char *name;
    double *number;
    bool low_open, high_open;
  } numbers[] = {
      {"penalty", &options.penalty, false, false},
      {"penalty_growth", &options.penalty_growth, true, false},
      {"barrier_factor", &options.barrier_factor, false, true},
      {"linear_tolerance", &options.linear_tolerance, false, true},
      {"final_linear_tolerance", &options.final_linear_tolerance, false, true},
      {"traction_tolerance", &options.traction_tolerance, false, true},
      {"gap_tolerance", &options.gap_tolerance, false, false},
  };
  for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); ++i)
  {
    const abut_limit *limit = abut_strategy_limit(numbers[i].name);
    assert_non_null(limit);
    assert_string_equal(limit->name, numbers[i].name);
    assert_int_equal(limit->low_open, numbers[i].low_open);
    assert_int_equal(limit->high_open, numbers[i].high_open);
    const double kept = *numbers[i].number;
    const double tries[] = {limit->low, limit->high,
                            nextafter(limit->low, -INFINITY),
                            nextafter(limit->high, INFINITY)};
    for (int k = 0; k < 4; ++k)
    {
      *numbers[i].number = tries[k];
      const bool legal = k == 0   ? !limit->low_open
                         : k == 1 ? !limit->high_open
                                  : false;
      assert_int_equal(abut_limit_contains(limit, tries[k]), legal);
      assert_int_equal(abut_strategy_create(context, &options, &strategy),
                       legal ? ABUT_SUCCESS : ABUT_INVALID_ARGUMENT);
      assert_ok(abut_strategy_destroy(&strategy));
    }
    assert_false(abut_limit_contains(limit, NAN));
    *numbers[i].number = kept;
  }
  assert_null(abut_strategy_limit("no such option"));
  assert_null(abut_strategy_limit(NULL));
  options.penalty_growth = 1;
  assert_int_equal(abut_strategy_create(context, &options, &strategy),
                   ABUT_INVALID_ARGUMENT);
  assert_string_equal(abut_context_message(context),
                      "abut_strategy_create: penalty_growth = 1 is not between "
                      "1 and 1e300, the first excluded");
  options = abut_strategy_defaults();
  options.barrier_end = 1;
  assert_int_equal(abut_strategy_create(context, &options, &strategy),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_context_destroy(&context));
}

static void
rows_are_checked(void **unused)
{
  (void)unused;
  const abut_strategy_options options = abut_strategy_defaults();
  fixture s = open_scene(&options);
  const double nan = NAN, minus = -1;
  const int64_t negative = -1, huge = INT64_C(1) << 53;
  const uint8_t bad_state = 2;
#define START(n, id, w, k, g, p, state)                                        \
  abut_strategy_start(s.strategy, n, id, w, k, NULL, g, p, state)
  assert_int_equal(
      abut_strategy_start(NULL, 1, NULL, &one, &one, NULL, &one, NULL, NULL),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(-1, NULL, &one, &one, &one, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(1, NULL, NULL, &one, &one, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(1, NULL, &one, NULL, &one, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(1, NULL, &one, &one, NULL, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(1, NULL, &nan, &one, &one, NULL, NULL),
                   ABUT_NOT_FINITE);
  assert_int_equal(START(1, NULL, &zero, &one, &one, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(1, NULL, &one, &minus, &one, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(1, NULL, &one, &one, &nan, NULL, NULL),
                   ABUT_NOT_FINITE);
  assert_int_equal(START(1, NULL, &one, &one, &one, &nan, NULL),
                   ABUT_NOT_FINITE);
  assert_int_equal(START(1, &negative, &one, &one, &one, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(1, &huge, &one, &one, &one, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(START(1, NULL, &one, &one, &one, NULL, &bad_state),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(START(1, NULL, &one, &one, &one, NULL, NULL));
  assert_ok(START(0, NULL, NULL, NULL, NULL, NULL, NULL));
#undef START
  close_scene(&s);
}

static void
equalities_have_no_interior(void **unused)
{
  (void)unused;
  const char *names[] = {"barrier", "interior point"};
  const uint8_t yes = 1;
  for (int i = 0; i < 2; ++i)
  {
    abut_strategy_options options = abut_strategy_defaults();
    options.law = abut_law_find(names[i]);
    fixture s = open_scene(&options);
    assert_int_equal(abut_strategy_start(s.strategy, 1, NULL, &one, &one, &yes,
                                         &one, NULL, NULL),
                     ABUT_UNSUPPORTED);
    close_scene(&s);
  }
}

static abut_status
fail_to_solve(void *user, const abut_request *request)
{
  (void)user;
  (void)request;
  return ABUT_UNSUPPORTED;
}

static abut_status
never_move(void *user, const abut_request *request, double *gap)
{
  (void)user;
  (void)request;
  (void)gap;
  return ABUT_SUCCESS;
}

static void
calls_have_an_order(void **unused)
{
  (void)unused;
  const abut_strategy_options options = exact_options();
  fixture s = open_scene(&options);
  abut_request request;
  abut_progress progress;
  abut_reason reason;
  const abut_host nobody = {.struct_size = sizeof(abut_host)};
  assert_int_equal(abut_strategy_next(s.strategy, NULL, &request),
                   ABUT_WRONG_ORDER);
  assert_int_equal(abut_strategy_progress(s.strategy, &progress),
                   ABUT_WRONG_ORDER);
  assert_int_equal(abut_strategy_run(s.strategy, &nobody, &reason),
                   ABUT_INVALID_ARGUMENT);
  const abut_host deaf = {sizeof(deaf), NULL, fail_to_solve, NULL, NULL},
                  idle = {sizeof(idle), NULL, NULL, never_move, NULL};
  assert_int_equal(abut_strategy_run(s.strategy, &deaf, &reason),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_strategy_run(s.strategy, &idle, &reason),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_strategy_run(s.strategy, NULL, &reason),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_strategy_run(NULL, &nobody, &reason),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_strategy_progress(NULL, &progress),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_strategy_progress(s.strategy, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_strategy_start(s.strategy, 1, NULL, &one, &one, NULL, &one,
                                NULL, NULL));
  assert_int_equal(abut_strategy_next(NULL, NULL, &request),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_strategy_next(s.strategy, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  assert_int_equal(request.action, ABUT_ACTION_SOLVE);
  assert_int_equal(request.matrix_changed, 1);
  request.gap_change[0] = request.pressure_change[0] = 0;
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  assert_int_equal(request.action, ABUT_ACTION_MOVE);
  assert_close(request.step_length, 1, 0);
  /* A forgotten gap changes nothing. */
  assert_int_equal(abut_strategy_next(s.strategy, NULL, &request),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_strategy_next(s.strategy, &one, &request));
  assert_int_equal(request.action, ABUT_ACTION_STOP);
  assert_int_equal(request.reason, ABUT_REASON_CONVERGED);
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  assert_int_equal(request.action, ABUT_ACTION_STOP);
  close_scene(&s);
}

static void
final_solve_follows_a_loose_one(void **unused)
{
  (void)unused;
  const abut_strategy_options options = abut_strategy_defaults();
  fixture s = open_scene(&options);
  abut_request request;
  assert_ok(abut_strategy_start(s.strategy, 1, NULL, &one, &one, NULL, &one,
                                NULL, NULL));
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  assert_close(request.linear_tolerance, options.linear_tolerance, 0);
  assert_false(request.final_solve);
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  assert_ok(abut_strategy_next(s.strategy, &one, &request));
  assert_int_equal(request.action, ABUT_ACTION_SOLVE);
  assert_true(request.final_solve);
  assert_false(request.matrix_changed);
  assert_close(request.linear_tolerance, options.final_linear_tolerance, 0);
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  assert_ok(abut_strategy_next(s.strategy, &one, &request));
  assert_int_equal(request.action, ABUT_ACTION_STOP);
  close_scene(&s);
}

static void
nan_stops(void **unused)
{
  (void)unused;
  const double nan = NAN;
  for (int where = 0; where < 3; ++where)
  {
    const abut_strategy_options options = exact_options();
    fixture s = open_scene(&options);
    abut_request request;
    assert_ok(abut_strategy_start(s.strategy, 1, NULL, &one, &one, NULL, &one,
                                  NULL, NULL));
    assert_ok(abut_strategy_next(s.strategy, NULL, &request));
    request.gap_change[0] = where == 0 ? NAN : 0;
    request.pressure_change[0] = where == 1 ? INFINITY : 0;
    assert_ok(abut_strategy_next(s.strategy, NULL, &request));
    if (where == 2)
      assert_ok(abut_strategy_next(s.strategy, &nan, &request));
    assert_int_equal(request.action, ABUT_ACTION_STOP);
    assert_int_equal(request.reason, ABUT_REASON_NOT_FINITE);
    close_scene(&s);
  }
}

static void
running_allocates_nothing(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  const abut_law *law;
  for (int32_t i = 0; (law = abut_law_get(i)) != NULL; ++i)
  {
    membrane scene = membrane_create(3, 1, 1);
    const abut_strategy_options options = membrane_options(&scene, law->name);
    const abut_host host = membrane_host(&scene);
    abut_strategy *strategy = NULL;
    abut_reason reason;
    for (int32_t k = 0; k < scene.n; ++k)
      scene.gap[k] = scene.u[k] - scene.psi[k];
    assert_ok(abut_strategy_create(context, &options, &strategy));
    uint64_t n_allocations = 0;
    for (int round = 0; round < 2; ++round)
    {
      /* The second start finds its memory, too. */
      assert_ok(abut_strategy_start(strategy, scene.n, NULL, scene.weight,
                                    scene.stiffness, NULL, scene.gap, NULL,
                                    NULL));
      if (round == 0)
        n_allocations = abut_context_memory(context).n_allocations;
      memset(scene.u, 0, (size_t)scene.n * sizeof(double));
      assert_ok(abut_strategy_run(strategy, &host, &reason));
      assert_int_equal(reason, ABUT_REASON_CONVERGED);
    }
    assert_int_equal(abut_context_memory(context).n_allocations, n_allocations);
    assert_ok(abut_strategy_destroy(&strategy));
    membrane_destroy(&scene);
  }
  assert_ok(abut_context_destroy(&context));
}

/* Run a law on the membrane of level 3 with changed options. */
static abut_reason
run_membrane(const char *law, void (*adjust)(abut_strategy_options *),
             abut_progress *progress)
{
  abut_context *context = fixture_context();
  membrane scene = membrane_create(3, 1, 1);
  abut_strategy_options options = membrane_options(&scene, law);
  adjust(&options);
  const abut_reason reason =
      membrane_run(context, &scene, &options, false, progress);
  /* Whoever does not converge says why. */
  assert_true((reason == ABUT_REASON_CONVERGED)
              == (strlen(abut_context_message(context)) == 0));
  membrane_destroy(&scene);
  assert_ok(abut_context_destroy(&context));
  return reason;
}

static void
two_steps(abut_strategy_options *options)
{
  options->max_steps = 2;
}

static void
two_outer(abut_strategy_options *options)
{
  options->max_outer = 2;
}

static void
weak_penalty(abut_strategy_options *options)
{
  options->penalty = 1e-3;
  options->adaptive_penalty = false;
  options->max_outer = 1000;
  options->max_steps = 1000;
}

static void
limits_stop(void **unused)
{
  (void)unused;
  abut_progress progress;
  const abut_law *law;
  for (int32_t i = 0; (law = abut_law_get(i)) != NULL; ++i)
  {
    assert_int_equal(run_membrane(law->name, two_steps, &progress),
                     ABUT_REASON_STEP_LIMIT);
    assert_int_equal(progress.step, 2);
    if (law->outer == ABUT_OUTER_NONE)
      continue;
    assert_int_equal(run_membrane(law->name, two_outer, &progress),
                     ABUT_REASON_STEP_LIMIT);
    assert_int_equal(progress.outer, 2);
  }
}

static void
multipliers_that_do_not_contract_stop(void **unused)
{
  (void)unused;
  abut_progress progress;
  assert_int_equal(
      run_membrane("augmented lagrangian", weak_penalty, &progress),
      ABUT_REASON_STAGNATION);
  assert_true(progress.outer <= 20);
}

static void
reasons_have_texts(void **unused)
{
  (void)unused;
  for (int reason = ABUT_REASON_NONE; reason <= ABUT_REASON_UNHELD; ++reason)
    assert_string_not_equal(abut_reason_text((abut_reason)reason),
                            "unknown reason");
  assert_string_equal(abut_reason_text((abut_reason)99), "unknown reason");
}

/* A user's own law: p = p0 exp(-g / h), always closed. */
typedef struct exponential
{
  double pressure, length;
} exponential;

static abut_status
exponential_classify(const abut_law_points *points, uint8_t *state)
{
  memset(state, ABUT_STATE_CLOSED, (size_t)points->n);
  return points->parameters != NULL ? ABUT_SUCCESS : ABUT_INVALID_ARGUMENT;
}

static abut_status
exponential_linearise(const abut_law_points *points, const uint8_t *state,
                      abut_law_linearisation *result)
{
  const exponential *law = points->parameters;
  (void)state;
  for (int32_t i = 0; i < points->n; ++i)
  {
    const double p = law->pressure * exp(-points->gap[i] / law->length);
    result->residual[i] = points->pressure[i] - p;
    result->d_pressure[i] = 1;
    result->d_gap[i] = p / law->length;
  }
  return ABUT_SUCCESS;
}

static const abut_law exponential_law = {
    .struct_size = sizeof(abut_law),
    .name = "exponential",
    .outer = ABUT_OUTER_NONE,
    .classify = exponential_classify,
    .linearise = exponential_linearise,
};

static void
a_users_law_is_iterated_to_its_solution(void **unused)
{
  (void)unused;
  const exponential parameters = {0.5, 0.25};
  const double k = 1, force = 3, minus_one = -1;
  const int32_t node = 0;
  abut_context *context = fixture_context();
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  assert_ok(abut_points_append_scalar(points, 0, 1, 1, ABUT_POINT_CONTACT, 1,
                                      &node, &minus_one));
  const abut_dense_model model = {sizeof(model), 1, &k, &force, points};
  abut_strategy_options options = exact_options();
  options.law = &exponential_law;
  options.law_parameters = &parameters;
  options.gap_tolerance = 1e-12;
  double u = 0, p = 0;
  abut_reason reason;
  abut_progress progress;
  assert_ok(abut_dense_model_solve(context, &model, &options, &u, &p, NULL,
                                   NULL, NULL, &progress, &reason));
  assert_int_equal(reason, ABUT_REASON_CONVERGED);
  /* Balance and law, both at the answer. */
  assert_close(k * u + p, force, 1e-12);
  assert_close(p, 0.5 * exp(-(1 - u) / 0.25), 1e-11);
  assert_true(progress.step > 3);
  options.law_parameters = NULL;
  assert_int_equal(abut_dense_model_solve(context, &model, &options, &u, &p,
                                          NULL, NULL, NULL, NULL, &reason),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
}

/* A law with faults that its parameters choose: the three numbers it gives. */
static abut_status
constant_classify(const abut_law_points *points, uint8_t *state)
{
  memset(state, ABUT_STATE_CLOSED, (size_t)points->n);
  return ABUT_SUCCESS;
}

static abut_status
constant_linearise(const abut_law_points *points, const uint8_t *state,
                   abut_law_linearisation *result)
{
  const double *numbers = points->parameters;
  (void)state;
  for (int32_t i = 0; i < points->n; ++i)
  {
    result->residual[i] = numbers[0];
    result->d_pressure[i] = numbers[1];
    result->d_gap[i] = numbers[2];
  }
  return ABUT_SUCCESS;
}

static void
a_useless_law_is_named_with_its_row(void **unused)
{
  (void)unused;
  static const struct
  {
    double numbers[3];
    uint32_t flags;
    const char *fault; /* or NULL */
  } cases[] = {
      {{NAN, 1, 1}, 0, "a value that is not finite"},
      {{0, INFINITY, 1}, 0, "a value that is not finite"},
      {{0, 1, NAN}, 0, "a value that is not finite"},
      {{0, 0, 1}, 0, "a derivative by the pressure that is zero"},
      {{0, 0, 1}, ABUT_LAW_HARD, NULL},
      {{0, 0, 0}, ABUT_LAW_HARD, "a derivative by the pressure that is zero"},
      {{0, 1, 0}, 0, NULL},
  };
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i)
  {
    const abut_law law = {sizeof(abut_law),  "constant",
                          cases[i].flags,    ABUT_OUTER_NONE,
                          constant_classify, constant_linearise};
    abut_strategy_options options = exact_options();
    options.law = &law;
    options.law_parameters = cases[i].numbers;
    fixture s = open_scene(&options);
    abut_request request;
    const double gap = -0.25, pressure = 2;
    assert_ok(abut_strategy_start(s.strategy, 1, NULL, &one, &one, NULL, &gap,
                                  &pressure, NULL));
    const abut_status status = abut_strategy_next(s.strategy, NULL, &request);
    assert_int_equal(status, cases[i].fault ? ABUT_NOT_FINITE : ABUT_SUCCESS);
    if (cases[i].fault != NULL)
    {
      const char *message = abut_context_message(s.context);
      assert_non_null(strstr(message, "the law 'constant' gives "));
      assert_non_null(strstr(message, cases[i].fault));
      assert_non_null(strstr(message, "at gap -0.25, pressure 2"));
    }
    close_scene(&s);
  }
}

/* Without a change of state the slopes of a user's law may change: the host
 * must be told, or it would keep a wrong matrix. */
static void
changed_slopes_are_reported(void **unused)
{
  (void)unused;
  const exponential parameters = {0.5, 0.25};
  abut_strategy_options options = exact_options();
  options.law = &exponential_law;
  options.law_parameters = &parameters;
  fixture s = open_scene(&options);
  abut_request request;
  assert_ok(abut_strategy_start(s.strategy, 1, NULL, &one, &one, NULL, &one,
                                NULL, NULL));
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  /* Same gap, then another: the pressure was 0 in the law's eyes. */
  const double gaps[] = {1, 0.75};
  for (int i = 0; i < 2; ++i)
  {
    assert_int_equal(request.action, ABUT_ACTION_SOLVE);
    assert_ok(abut_strategy_next(s.strategy, NULL, &request));
    assert_int_equal(request.action, ABUT_ACTION_MOVE);
    assert_ok(abut_strategy_next(s.strategy, &gaps[i], &request));
    assert_int_equal(request.action, ABUT_ACTION_SOLVE);
    assert_int_equal(request.matrix_changed, i);
  }
  close_scene(&s);
}

static void
a_hosts_failure_is_passed_on(void **unused)
{
  (void)unused;
  const abut_strategy_options options = exact_options();
  fixture s = open_scene(&options);
  const abut_host host = {sizeof(host), NULL, fail_to_solve, never_move, NULL};
  abut_reason reason;
  assert_ok(abut_strategy_start(s.strategy, 1, NULL, &one, &one, NULL, &one,
                                NULL, NULL));
  assert_int_equal(abut_strategy_run(s.strategy, &host, &reason),
                   ABUT_CALLBACK_FAILED);
  assert_string_equal(abut_context_message(s.context),
                      "abut_strategy_run: the host's solve failed: this "
                      "combination is not defined");
  close_scene(&s);
}

static void
no_rows_need_one_tight_solve(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  const double k = 2, force = 3;
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  const abut_dense_model model = {sizeof(model), 1, &k, &force, points};
  const abut_law *law;
  for (int32_t i = 0; (law = abut_law_get(i)) != NULL; ++i)
  {
    abut_strategy_options options = abut_strategy_defaults();
    options.law = law;
    double u = 0;
    abut_reason reason;
    abut_progress progress;
    assert_ok(abut_dense_model_solve(context, &model, &options, &u, NULL, NULL,
                                     NULL, NULL, &progress, &reason));
    assert_int_equal(reason, ABUT_REASON_CONVERGED);
    assert_close(u, force / k, 1e-14);
    assert_int_equal(progress.step, 1);
  }
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
}

/* Serve one SOLVE with the changes that lead to the pressures and gaps, and
 * the MOVE after it. */
static void
answer(fixture *s, int n, const double *p, const double *gap,
       abut_request *request)
{
  assert_int_equal(request->action, ABUT_ACTION_SOLVE);
  for (int i = 0; i < n; ++i)
  {
    request->pressure_change[i] = p[i] - request->pressure[i];
    request->gap_change[i] = 0;
  }
  assert_ok(abut_strategy_next(s->strategy, NULL, request));
  assert_ok(abut_strategy_next(s->strategy, gap, request));
}

/* A linear solver leaves a small gap on a closed row. Times a large c it would
 * outweigh the pressure, which alone must decide. */
static void
closed_rows_are_judged_by_pressure(void **unused)
{
  (void)unused;
  abut_strategy_options options = exact_options();
  options.complementarity = 1e6;
  fixture s = open_scene(&options);
  abut_request request;
  const double p = 0.25, gap = 5e-7;
  const uint8_t closed = ABUT_STATE_CLOSED;
  assert_ok(abut_strategy_start(s.strategy, 1, NULL, &one, &one, NULL, &one,
                                NULL, &closed));
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  /* p - c g = 0.25 - 0.5 < 0. */
  answer(&s, 1, &p, &gap, &request);
  assert_int_equal(request.action, ABUT_ACTION_STOP);
  assert_int_equal(request.reason, ABUT_REASON_CONVERGED);
  assert_int_equal(request.state[0], ABUT_STATE_CLOSED);
  close_scene(&s);
}

/* The second row has next to no pressure when closed and next to no gap when
 * open, of the wrong sign both times. */
static void
flicker_stops(void **unused)
{
  (void)unused;
  const abut_strategy_options options = exact_options();
  fixture s = open_scene(&options);
  abut_request request;
  const double ones[] = {1, 1}, start[] = {0, 0};
  const uint8_t state[] = {ABUT_STATE_CLOSED, ABUT_STATE_OPEN};
  assert_ok(abut_strategy_start(s.strategy, 2, NULL, ones, ones, NULL, start,
                                NULL, state));
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  int n_steps = 0;
  for (; request.action != ABUT_ACTION_STOP && n_steps < 20; ++n_steps)
  {
    const bool closed = request.state[1] == ABUT_STATE_CLOSED;
    const double p[] = {1, closed ? -5e-10 : 0};
    const double gap[] = {0, closed ? 0 : -5e-10};
    answer(&s, 2, p, gap, &request);
  }
  assert_true(n_steps < 10);
  assert_int_equal(request.reason, ABUT_REASON_CONVERGED);
  close_scene(&s);
}

/* Rows that are wrong in every state: first all of them change, and when sets
 * come back one by one. */
static void
rows_in_contact_are_counted(void **unused)
{
  (void)unused;
  const abut_strategy_options options = exact_options();
  fixture s = open_scene(&options);
  abut_request request;
  abut_progress progress;
  const double ones[] = {1, 1}, start[] = {0, 0};
  const uint8_t state[] = {ABUT_STATE_CLOSED, ABUT_STATE_OPEN};
  assert_ok(abut_strategy_start(s.strategy, 2, NULL, ones, ones, NULL, start,
                                NULL, state));
  assert_ok(abut_strategy_next(s.strategy, NULL, &request));
  int n_alone = 0;
  for (int step = 0; step < 12; ++step)
  {
    const bool first = request.state[0] == ABUT_STATE_CLOSED,
               second = request.state[1] == ABUT_STATE_CLOSED;
    const double p[] = {first ? -1 : 0, second ? -1 : 0},
                 gap[] = {first ? 0 : -1, second ? 0 : -1};
    answer(&s, 2, p, gap, &request);
    const int n_closed = (request.state[0] == ABUT_STATE_CLOSED)
                         + (request.state[1] == ABUT_STATE_CLOSED);
    assert_ok(abut_strategy_progress(s.strategy, &progress));
    assert_int_equal(progress.n_active, n_closed);
    n_alone += progress.n_changes == 1;
    assert_int_equal(progress.fallback_steps, n_alone);
  }
  assert_true(n_alone > 4);
  close_scene(&s);
}

/* Three rows, two of them closed, the deepest by 0.3: g = 1, -0.1, -0.3. */
static void
a_start_is_told_before_the_first_step(void **unused)
{
  (void)unused;
  const abut_strategy_options options = exact_options();
  fixture s = open_scene(&options);
  const double unit[3] = {1, 1, 1}, gap[3] = {1, -0.1, -0.3};
  const uint8_t state[3] = {ABUT_STATE_OPEN, ABUT_STATE_CLOSED,
                            ABUT_STATE_CLOSED};
  abut_progress progress;
  assert_ok(abut_strategy_start(s.strategy, 3, NULL, unit, unit, NULL, gap,
                                NULL, state));
  assert_ok(abut_strategy_progress(s.strategy, &progress));
  assert_int_equal(progress.n_rows, 3);
  assert_int_equal(progress.n_active, 2);
  assert_true(progress.penetration == 0.3);
  assert_int_equal(progress.step, 0);
  close_scene(&s);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_start_is_told_before_the_first_step),
      cmocka_unit_test(laws_have_first_penalties),
      cmocka_unit_test(options_are_checked),
      cmocka_unit_test(limits_are_those_of_the_check),
      cmocka_unit_test(rows_are_checked),
      cmocka_unit_test(equalities_have_no_interior),
      cmocka_unit_test(calls_have_an_order),
      cmocka_unit_test(final_solve_follows_a_loose_one),
      cmocka_unit_test(nan_stops),
      cmocka_unit_test(running_allocates_nothing),
      cmocka_unit_test(limits_stop),
      cmocka_unit_test(multipliers_that_do_not_contract_stop),
      cmocka_unit_test(reasons_have_texts),
      cmocka_unit_test(a_users_law_is_iterated_to_its_solution),
      cmocka_unit_test(a_useless_law_is_named_with_its_row),
      cmocka_unit_test(changed_slopes_are_reported),
      cmocka_unit_test(a_hosts_failure_is_passed_on),
      cmocka_unit_test(no_rows_need_one_tight_solve),
      cmocka_unit_test(closed_rows_are_judged_by_pressure),
      cmocka_unit_test(flicker_stops),
      cmocka_unit_test(rows_in_contact_are_counted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
