/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Problems of several points with friction: random ones, all laws against each
 * other, what is refused. */
#include "fixture.h"
#include "frictional.h"

#include <string.h>

static const frictional_ranges mild = {{.05, 1}, {3, 100}},
                               harsh = {{1, 4}, {10, 1000}};

/* An answer to each, from zero and from five random starts, and exact. */
static void
random_problems(void **unused)
{
  (void)unused;
  for (int32_t dimension = 2; dimension <= 3; ++dimension)
  {
    const frictional_count count =
        frictional_survey(dimension, &mild, 200, FRICTIONAL_STARTS, 1);
    assert_int_equal(count.n_runs, 1200);
    assert_int_equal(count.n_lost, 0);
    assert_int_equal(count.answers[1], 200);
    assert_true(count.worst_violation <= 1e-9);
    assert_true(count.mean_steps < 6);
  }
}

/* Beyond what theory promises: what is found is exact, and nearly all is. */
static void
harsh_problems(void **unused)
{
  (void)unused;
  for (int32_t dimension = 2; dimension <= 3; ++dimension)
  {
    const frictional_count count =
        frictional_survey(dimension, &harsh, 200, 0, 1);
    assert_true(count.n_lost <= 4);
    /* Each rung has cured some. */
    for (int rung = 1; rung <= 3; ++rung)
      assert_true(count.cured[rung] > 0);
    assert_true(count.worst_violation <= 1e-8);
  }
}

static frictional_answer
solve(const frictional *problem, const abut_strategy_options *options)
{
  abut_context *context = fixture_context();
  frictional_answer answer;
  memset(&answer, 0, sizeof(answer));
  frictional_solve(context, problem, options, false, &answer);
  assert_ok(answer.status);
  assert_int_equal(answer.reason, ABUT_REASON_CONVERGED);
  assert_ok(abut_context_destroy(&context));
  return answer;
}

static double
difference(const frictional *problem, const frictional_answer *a,
           const frictional_answer *b)
{
  double most = 0;
  for (int32_t i = 0; i < problem->n; ++i)
    most = fmax(most, fabs(a->u[i] - b->u[i]));
  return most;
}

/* Springs of stiffness eps leave an error of 1/eps. */
static void
check_penalty(const frictional *problem, const frictional_answer *exact)
{
  abut_strategy_options options = exact_options();
  options.law = abut_law_find("penalty");
  double error[2];
  for (int i = 0; i < 2; ++i)
  {
    options.penalty = i == 0 ? 1e5 : 1e6;
    const frictional_answer soft = solve(problem, &options);
    error[i] = difference(problem, &soft, exact);
  }
  assert_true(error[0] < 1e-3);
  if (exact->progress.n_active > 0)
    assert_close(error[0] / error[1], 10, 0.01);
}

static void
check_others(const frictional *problem, const frictional_answer *exact)
{
  abut_strategy_options options = exact_options();
  options.law = abut_law_find("augmented lagrangian");
  options.gap_tolerance = options.pressure_tolerance = 1e-11;
  frictional_answer other = solve(problem, &options);
  assert_true(difference(problem, &other, exact) < 1e-8);
  /* Its penalty is all of the law that is not met. */
  options.law = abut_law_find("quadratic penalty");
  options.gap_tolerance = 1e-5;
  other = solve(problem, &options);
  assert_true(difference(problem, &other, exact) < 1e-3);
}

static void
all_laws_agree(void **unused)
{
  (void)unused;
  uint64_t seed = 11;
  int32_t slipping = 0, sticking = 0;
  for (int i = 0; i < 40; ++i)
  {
    const frictional problem = frictional_draw(2 + i % 2, &mild, &seed);
    const abut_strategy_options options = exact_options();
    const frictional_answer exact = solve(&problem, &options);
    check_penalty(&problem, &exact);
    check_others(&problem, &exact);
    slipping += (int32_t)exact.progress.n_slipping;
    sticking += (int32_t)(exact.progress.n_active - exact.progress.n_slipping);
  }
  assert_true(slipping > 20 && sticking > 5);
}

/* Rows without tangents beside points with friction: as with a coefficient of 0
 * there. */
static void
plain_rows_beside_friction(void **unused)
{
  (void)unused;
  uint64_t seed = 17;
  for (int i = 0; i < 20; ++i)
  {
    frictional problem = frictional_draw(2 + i % 2, &mild, &seed);
    const int32_t n_plain = problem.n_points > 2 ? 2 : 1;
    memset(problem.coefficient, 0, sizeof(double) * (size_t)n_plain);
    for (int law = 0; law < 2; ++law)
    {
      abut_strategy_options options = exact_options();
      options.law = abut_law_find(law == 0 ? "lagrange" : "penalty");
      problem.n_plain = 0;
      const frictional_answer with = solve(&problem, &options);
      problem.n_plain = n_plain;
      const frictional_answer beside = solve(&problem, &options);
      assert_true(difference(&problem, &with, &beside) < 1e-10);
    }
  }
}

static void
no_friction_is_frictionless(void **unused)
{
  (void)unused;
  uint64_t seed = 13;
  for (int i = 0; i < 20; ++i)
  {
    frictional problem = frictional_draw(2 + i % 2, &mild, &seed);
    memset(problem.coefficient, 0, sizeof(problem.coefficient));
    const abut_strategy_options options = exact_options();
    const frictional_answer with = solve(&problem, &options);
    problem.n_plain = problem.n_points;
    const frictional_answer without = solve(&problem, &options);
    assert_true(difference(&problem, &with, &without) < 1e-12);
    for (int32_t k = 0; k < problem.n; ++k)
      assert_close(with.p[k],
                   k % problem.dimension == 0 ? without.p[k / problem.dimension]
                                              : 0,
                   1e-12);
  }
}

/* With caps that nothing reaches the answer stays; with small ones all that
 * slips does so at them. */
static void
caps(void **unused)
{
  (void)unused;
  uint64_t seed = 17;
  int32_t capped = 0;
  for (int i = 0; i < 20; ++i)
  {
    frictional problem = frictional_draw(3, &mild, &seed);
    const abut_strategy_options options = exact_options();
    const frictional_answer free = solve(&problem, &options);
    for (int32_t k = 0; k < problem.n_points; ++k)
      problem.cap[k] = 1e6;
    const frictional_answer wide = solve(&problem, &options);
    assert_true(difference(&problem, &free, &wide) < 1e-12);
    for (int32_t k = 0; k < problem.n_points; ++k)
      problem.cap[k] = 0.2;
    const frictional_answer tight = solve(&problem, &options);
    assert_true(frictional_violation(&problem, tight.u, tight.p) < 1e-9);
    for (int32_t k = 0; k < problem.n; k += 3)
      capped += fabs(hypot(tight.p[k + 1], tight.p[k + 2]) - 0.2) < 1e-9;
  }
  assert_true(capped > 10);
}

/* A bound that flattens, rho = mu p / (1 + p/P). */
static abut_status
flattening(const abut_friction_bounds *points, double *bound, double *d_bound)
{
  const double limit = *(const double *)points->parameters;
  for (int32_t i = 0; i < points->n; ++i)
  {
    const double p = fmax(points->pressure[i], 0), part = 1 + p / limit;
    bound[i] = points->coefficient[i] * p / part;
    d_bound[i] = points->coefficient[i] / (part * part);
  }
  return ABUT_SUCCESS;
}

static abut_status
spoiled(const abut_friction_bounds *points, double *bound, double *d_bound)
{
  for (int32_t i = 0; i < points->n; ++i)
    bound[i] = d_bound[i] = NAN;
  return ABUT_SUCCESS;
}

static abut_status
failing(const abut_friction_bounds *points, double *bound, double *d_bound)
{
  (void)points;
  bound[0] = d_bound[0] = 0;
  return ABUT_UNSUPPORTED;
}

/* A block that slides: normal and tangential spring 1, pressed by 3. */
static frictional
block(void)
{
  frictional problem;
  memset(&problem, 0, sizeof(problem));
  problem.dimension = problem.n = 2;
  problem.n_points = 1;
  problem.stiffness[0] = problem.stiffness[3] = 1;
  problem.force[0] = 3;
  problem.force[1] = 4;
  problem.coefficient[0] = 0.5;
  problem.cap[0] = INFINITY;
  return problem;
}

static void
a_law_of_the_users_own(void **unused)
{
  (void)unused;
  const double limit = 5;
  const abut_friction own = {sizeof(own), "flattening", flattening};
  frictional problem = block();
  problem.law = &own;
  problem.parameters = &limit;
  const abut_strategy_options options = exact_options();
  const frictional_answer answer = solve(&problem, &options);
  const double bound = 0.5 * 3 / (1 + 3. / 5);
  assert_close(answer.p[0], 3, 1e-12);
  assert_close(answer.p[1], -bound, 1e-10);
  assert_close(answer.u[1], 4 - bound, 1e-10);
}

static void
refuses(const abut_friction *law, abut_status status)
{
  abut_context *context = fixture_context();
  const abut_strategy_options options = exact_options();
  frictional problem = block();
  problem.law = law;
  frictional_answer answer;
  memset(&answer, 0, sizeof(answer));
  frictional_solve(context, &problem, &options, false, &answer);
  assert_int_equal(answer.status, status);
  assert_true(strlen(abut_context_message(context)) > 0);
  assert_ok(abut_context_destroy(&context));
}

static void
bad_laws(void **unused)
{
  (void)unused;
  const abut_friction without = {sizeof(without), "none", NULL},
                      unnamed = {sizeof(unnamed), NULL, flattening},
                      other = {8, "old", flattening},
                      nan = {sizeof(nan), "nan", spoiled},
                      failed = {sizeof(failed), "failing", failing};
  refuses(&without, ABUT_INVALID_ARGUMENT);
  refuses(&unnamed, ABUT_INVALID_ARGUMENT);
  refuses(&other, ABUT_INVALID_ARGUMENT);
  refuses(&nan, ABUT_NOT_FINITE);
  refuses(&failed, ABUT_UNSUPPORTED);
}

/* Arrays of two points with one tangent each. */
typedef struct given
{
  int32_t first[2];
  uint8_t n_tangents[2];
  double coefficient[2], cap[2], traction[2];
} given;

static const given good = {{0, 2}, {1, 1}, {.5, .5}, {1, 1}, {.1, .1}};

static abut_strategy_friction
friction_of(const given *numbers)
{
  abut_strategy_friction friction = {.struct_size = sizeof(friction)};
  friction.n = 2;
  friction.first = numbers->first;
  friction.n_tangents = numbers->n_tangents;
  friction.coefficient = numbers->coefficient;
  friction.cap = numbers->cap;
  friction.reference_traction = numbers->traction;
  return friction;
}

static void
bad_points(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  const abut_strategy_options options = exact_options();
  abut_strategy *s = NULL;
  assert_ok(abut_strategy_create(context, &options, &s));
  assert_int_equal(abut_strategy_set_friction(NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  abut_strategy_friction friction = friction_of(&good);
  assert_ok(abut_strategy_set_friction(s, &friction));
  friction.n = -1;
  assert_int_equal(abut_strategy_set_friction(s, &friction),
                   ABUT_INVALID_ARGUMENT);
  friction = friction_of(&good);
  friction.first = NULL;
  assert_int_equal(abut_strategy_set_friction(s, &friction),
                   ABUT_INVALID_ARGUMENT);
  given wrong[7] = {good, good, good, good, good, good, good};
  wrong[0].n_tangents[1] = 3;
  wrong[1].first[1] = 1; /* a row of the point before */
  wrong[2].coefficient[1] = -1;
  wrong[3].cap[0] = -1;
  wrong[4].first[0] = -1;
  wrong[5].coefficient[0] = NAN;
  wrong[6].traction[1] = INFINITY;
  for (int i = 0; i < 7; ++i)
  {
    friction = friction_of(&wrong[i]);
    assert_int_equal(abut_strategy_set_friction(s, &friction),
                     i < 5 ? ABUT_INVALID_ARGUMENT : ABUT_NOT_FINITE);
  }
  assert_ok(abut_strategy_destroy(&s));
  assert_ok(abut_context_destroy(&context));
}

/* Without states to begin with, what presses tells who slips; before anything
 * presses, all that has friction sticks. */
static void
first_states(void **unused)
{
  (void)unused;
  static const struct
  {
    double coefficient, pressure;
    uint8_t expected;
  } cases[] = {{.5, 0, ABUT_STATE_CLOSED},
               {.5, 1, ABUT_STATE_SLIP},
               {0, 0, ABUT_STATE_SLIP}};
  const double ones[2] = {1, 1}, gap[2] = {-.1, 10};
  for (int i = 0; i < 3; ++i)
  {
    abut_context *context = fixture_context();
    const abut_strategy_options options = exact_options();
    given numbers = good;
    numbers.coefficient[0] = cases[i].coefficient;
    numbers.traction[0] = 0;
    abut_strategy_friction friction = friction_of(&numbers);
    friction.n = 1;
    friction.cap = NULL;
    const double pressure[2] = {cases[i].pressure, 0};
    abut_strategy *s = NULL;
    abut_request request;
    assert_ok(abut_strategy_create(context, &options, &s));
    assert_ok(abut_strategy_set_friction(s, &friction));
    assert_ok(
        abut_strategy_start(s, 2, NULL, ones, ones, NULL, gap, pressure, NULL));
    assert_ok(abut_strategy_next(s, NULL, &request));
    assert_int_equal(request.state[0], cases[i].expected);
    assert_int_equal(request.state[1], cases[i].expected);
    assert_ok(abut_strategy_destroy(&s));
    assert_ok(abut_context_destroy(&context));
  }
}

static void
bad_rows(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  const abut_strategy_options options = exact_options();
  const double ones[4] = {1, 1, 1, 1}, gap[4] = {0};
  const uint8_t tie[4] = {0, 0, 0, 1}, slip[4] = {2, 2, 0, 0},
                none[4] = {3, 0, 0, 0};
  abut_strategy *s = NULL;
  assert_ok(abut_strategy_create(context, &options, &s));
  /* A state of slip without friction. */
  assert_int_equal(
      abut_strategy_start(s, 4, NULL, ones, ones, NULL, gap, NULL, slip),
      ABUT_INVALID_ARGUMENT);
  const abut_strategy_friction friction = friction_of(&good);
  assert_ok(abut_strategy_set_friction(s, &friction));
  assert_int_equal(
      abut_strategy_start(s, 3, NULL, ones, ones, NULL, gap, NULL, NULL),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_strategy_start(s, 4, NULL, ones, ones, tie, gap, NULL, NULL),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_strategy_start(s, 4, NULL, ones, ones, NULL, gap, NULL, none),
      ABUT_INVALID_ARGUMENT);
  assert_ok(abut_strategy_start(s, 4, NULL, ones, ones, NULL, gap, NULL, slip));
  abut_request request;
  assert_ok(abut_strategy_next(s, NULL, &request));
  assert_int_equal(request.n_blocks, 2);
  assert_int_equal(request.block_size[0], 2);
  assert_int_equal(request.state[0], ABUT_STATE_SLIP);
  assert_int_equal(request.state[1], ABUT_STATE_SLIP);
  assert_int_equal(request.state[2], ABUT_STATE_OPEN);
  /* Taken back: rows are rows again. */
  assert_ok(abut_strategy_set_friction(s, NULL));
  assert_ok(abut_strategy_start(s, 3, NULL, ones, ones, NULL, gap, NULL, NULL));
  assert_ok(abut_strategy_next(s, NULL, &request));
  assert_null(request.block_size);
  assert_ok(abut_strategy_destroy(&s));
  assert_ok(abut_context_destroy(&context));
}

static void
laws_without_friction(void **unused)
{
  (void)unused;
  const char *laws[] = {"barrier", "interior point"};
  for (int i = 0; i < 2; ++i)
  {
    abut_context *context = fixture_context();
    abut_strategy_options options = exact_options();
    options.law = abut_law_find(laws[i]);
    abut_strategy *s = NULL;
    assert_ok(abut_strategy_create(context, &options, &s));
    const abut_strategy_friction friction = friction_of(&good);
    assert_int_equal(abut_strategy_set_friction(s, &friction),
                     ABUT_UNSUPPORTED);
    assert_non_null(strstr(abut_context_message(context), laws[i]));
    assert_ok(abut_strategy_destroy(&s));
    assert_ok(abut_context_destroy(&context));
  }
}

/* A node on a floor and beside a wall on its left, both with friction, and its
 * two contacts. */
static abut_points *
corner_points(abut_context *context, double clearance)
{
  const double frame[2][4] = {{0, -1, 1, 0}, {-1, 0, 0, 1}};
  const double gap[2][2] = {{0, 0}, {clearance, 0}}, one = 1;
  const int32_t node = 0;
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 2, &points));
  for (int i = 0; i < 2; ++i)
  {
    abut_point point = abut_point_defaults();
    point.id = (int64_t)i * 2;
    point.n_components = 2;
    point.frame = frame[i];
    point.gap = gap[i];
    point.n_nodes = point.n_secondary = 1;
    point.node = &node;
    point.coefficient = &one;
    assert_ok(abut_points_append(points, &point));
  }
  return points;
}

/* Pushed into the corner it does not slip, and has no friction in a first step;
 * drawn away from the wall, or up to it, it slips on the floor. */
static void
node_in_a_corner(void **unused)
{
  (void)unused;
  const int32_t first[2] = {0, 2}, point[2] = {0, 1}, row[2] = {2, 0};
  const uint8_t n_tangents[2] = {1, 1};
  const double mu[2] = {0.25, 0.25}, stiffness[4] = {1, 0, 0, 1};
  const abut_strategy_friction friction = {.struct_size = sizeof(friction),
                                           .n = 2,
                                           .first = first,
                                           .n_tangents = n_tangents,
                                           .coefficient = mu,
                                           .n_rivals = 2,
                                           .rival_point = point,
                                           .rival_row = row};
  const double forces[3][2] = {{-3, -4}, {2, -4}, {-3, -4}};
  const double clearance[3] = {0, 0, 0.1};
  const double u[3][2] = {{0, 0}, {1, 0}, {-0.1, 0}};
  const double p[3][4] = {{4, 0, 3, 0}, {4, -1, 0, 0}, {4, 1, 1.9, 0}};
  abut_context *context = fixture_context();
  for (int i = 0; i < 3; ++i)
  {
    abut_points *points = corner_points(context, clearance[i]);
    const abut_dense_model model = {sizeof(model), 2,      stiffness,
                                    forces[i],     points, &friction};
    const abut_strategy_options options = exact_options();
    double x[2] = {0, 0}, pressure[4] = {0};
    /* All sticks, which is more than the node can do. */
    uint8_t state[4] = {ABUT_STATE_CLOSED, ABUT_STATE_CLOSED, ABUT_STATE_CLOSED,
                        ABUT_STATE_CLOSED};
    abut_progress progress;
    abut_reason reason = ABUT_REASON_NONE;
    assert_ok(abut_dense_model_solve(context, &model, &options, x, pressure,
                                     state, NULL, NULL, &progress, &reason));
    assert_int_equal(reason, ABUT_REASON_CONVERGED);
    for (int k = 0; k < 2; ++k)
      assert_float_equal(x[k], u[i][k], 1e-12);
    for (int k = 0; k < 4; ++k)
      assert_float_equal(pressure[k], p[i][k], 1e-12);
    assert_ok(abut_points_destroy(&points));
  }
  assert_ok(abut_context_destroy(&context));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(random_problems),
      cmocka_unit_test(harsh_problems),
      cmocka_unit_test(all_laws_agree),
      cmocka_unit_test(plain_rows_beside_friction),
      cmocka_unit_test(no_friction_is_frictionless),
      cmocka_unit_test(caps),
      cmocka_unit_test(a_law_of_the_users_own),
      cmocka_unit_test(bad_laws),
      cmocka_unit_test(bad_points),
      cmocka_unit_test(first_states),
      cmocka_unit_test(bad_rows),
      cmocka_unit_test(laws_without_friction),
      cmocka_unit_test(node_in_a_corner),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
