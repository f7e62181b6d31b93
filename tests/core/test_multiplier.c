/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* When the method of multipliers stops: by which gaps it is measured, and how
 * its penalty grows where they do not fall. */
#include "fixture.h"

/* A mass on a spring of stiffness 1 is pulled by 3 to two floors, each of half
 * an area. */
enum
{
  N_FLOORS = 2
};
static const double pull = 3;

static abut_status
take_mean(void *user, int32_t n, double *values)
{
  double mean = 0;
  (void)user;
  for (int32_t i = 0; i < n; ++i)
    mean += values[i] / n;
  for (int32_t i = 0; i < n; ++i)
    values[i] = mean;
  return ABUT_SUCCESS;
}

typedef struct outcome
{
  double u;
  int32_t outer;
} outcome;

/* To the gap tolerance alone. */
static outcome
pull_mass(const double *floors, abut_point_kind kind,
          abut_strategy_options options)
{
  const double stiffness = 1, minus_one = -1;
  const int32_t node = 0;
  abut_context *context = fixture_context();
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  for (int i = 0; i < N_FLOORS; ++i)
    assert_ok(abut_points_append_scalar(points, i, 0.5, floors[i], kind, 1,
                                        &node, &minus_one));
  const abut_dense_model model = {sizeof(model), 1,      &stiffness,
                                  &pull,         points, NULL};
  options.law = abut_law_find("augmented lagrangian");
  options.adaptive_penalty = false;
  options.pressure_tolerance = 1;
  double p[N_FLOORS] = {0};
  outcome out = {0, 0};
  abut_progress progress;
  abut_reason reason;
  assert_ok(abut_dense_model_solve(context, &model, &options, &out.u, p, NULL,
                                   NULL, NULL, &progress, &reason));
  assert_int_equal(reason, ABUT_REASON_CONVERGED);
  out.outer = progress.outer;
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
  return out;
}

/* The first outer step whose error, which falls by 1 / (1 + eps) in each, is
 * within the tolerance; the error then. */
static int
steps_to(double tolerance, double error, double eps, double *left)
{
  int n = 1;
  for (; error > tolerance; ++n)
    error /= 1 + eps;
  *left = error;
  return n;
}

/* Two ties that cannot both be met, with one multiplier: the mean gap counts,
 * and neither gap vanishes. The rows' stiffness is that of the spring over
 * their weight. */
static void
projected_gaps_are_lengths(void **unused)
{
  (void)unused;
  static const double floors[] = {1, 1.02}, lengths[] = {1, 20, 0.001};
  abut_strategy_options options = exact_options();
  options.penalty = 5;
  options.gap_tolerance = 1e-3;
  options.project = take_mean;
  const double eps = options.penalty / 0.5,
               middle = (floors[0] + floors[1]) / 2;
  for (int i = 0; i < 3; ++i)
  {
    options.length_scale = lengths[i];
    double left;
    const int n =
        steps_to(1e-3 * lengths[i], (pull - middle) / (1 + eps), eps, &left);
    const outcome out = pull_mass(floors, ABUT_POINT_TIE, options);
    assert_int_equal(out.outer, n);
    assert_close(out.u, middle + left, 1e-12);
  }
}

/* What counts is the gap of the floor at 1, which has half an area of its own
 * spring; that of the far one does not. */
static void
open_rows_have_no_gap_to_close(void **unused)
{
  (void)unused;
  static const double floors[] = {1, 9}, lengths[] = {1, 20, 0.001};
  abut_strategy_options options = exact_options();
  options.penalty = 5;
  options.gap_tolerance = 1e-3;
  const double eps = options.penalty / 0.5 * 0.5;
  for (int i = 0; i < 3; ++i)
  {
    options.length_scale = lengths[i];
    double left;
    const int n =
        steps_to(1e-3 * lengths[i], (pull - floors[0]) / (1 + eps), eps, &left);
    const outcome out = pull_mass(floors, ABUT_POINT_CONTACT, options);
    assert_int_equal(out.outer, n);
    assert_close(out.u, floors[0] + left, 1e-12);
  }
}

/* A host whose gap never changes, whatever the pressure. */
static abut_reason
push_in_vain(abut_strategy_options options, double gap, double pressure,
             abut_failure expected, double *penalty, int *n)
{
  const double unit = 1;
  const uint8_t closed = ABUT_STATE_CLOSED;
  abut_context *context = fixture_context();
  abut_strategy *strategy = NULL;
  abut_request request;
  abut_progress progress;
  options.law = abut_law_find("augmented lagrangian");
  assert_ok(abut_strategy_create(context, &options, &strategy));
  assert_ok(abut_strategy_start(strategy, 1, NULL, &unit, &unit, NULL, &gap,
                                &pressure, &closed));
  assert_ok(abut_strategy_next(strategy, NULL, &request));
  for (*n = 0; request.action == ABUT_ACTION_SOLVE && *n < 20; *n += 1)
  {
    assert_ok(abut_strategy_progress(strategy, &progress));
    penalty[*n] = progress.penalty;
    request.gap_change[0] = 0;
    request.pressure_change[0] = -request.residual[0] / request.d_pressure[0];
    assert_ok(abut_strategy_next(strategy, NULL, &request));
    assert_ok(abut_strategy_next(strategy, &gap, &request));
    assert_ok(abut_strategy_progress(strategy, &progress));
    assert_int_equal(progress.outer, *n + 1);
  }
  assert_int_equal(progress.seen, expected);
  assert_ok(abut_strategy_destroy(&strategy));
  assert_ok(abut_context_destroy(&context));
  return request.reason;
}

/* As long as eps may grow, gaps that stay are no reason to stop; then four
 * steps in vain are. */
static void
stagnation_counts_from_the_last_growth(void **unused)
{
  (void)unused;
  static const double expected[] = {1, 1, 5, 25, 100, 100, 100, 100};
  abut_strategy_options options = exact_options();
  options.penalty = 1;
  options.penalty_cap = 100;
  options.pressure_tolerance = 1;
  double penalty[20];
  int n = 0;
  assert_int_equal(push_in_vain(options, -0.1, 1,
                                ABUT_FAILURE_MULTIPLIERS_STALL, penalty, &n),
                   ABUT_REASON_STAGNATION);
  assert_int_equal(n, 8);
  for (int i = 0; i < n; ++i)
    assert_close(penalty[i], expected[i], 1e-15);
  options.adaptive_penalty = false;
  assert_int_equal(push_in_vain(options, -0.1, 1,
                                ABUT_FAILURE_MULTIPLIERS_STALL, penalty, &n),
                   ABUT_REASON_STAGNATION);
  assert_int_equal(n, 5);
  for (int i = 0; i < n; ++i)
    assert_true(penalty[i] == 1);
}

/* A pressure that grows by 1e-8 in each step, at a gap that is small enough: a
 * change of all of it, unless a hundred-thousandth of the load is so much that
 * it is a thousandth of that. */
static void
noise_of_the_load_is_no_pressure(void **unused)
{
  (void)unused;
  abut_strategy_options options = exact_options();
  options.penalty = 1;
  options.gap_tolerance = 1e-6;
  options.pressure_tolerance = 1e-3;
  double penalty[20];
  int n = 0;
  options.pressure_scale = 0.99;
  assert_int_equal(push_in_vain(options, -1e-8, 0,
                                ABUT_FAILURE_MULTIPLIERS_STALL, penalty, &n),
                   ABUT_REASON_STAGNATION);
  assert_int_equal(n, 5);
  options.pressure_scale = 1.01;
  assert_int_equal(
      push_in_vain(options, -1e-8, 0, ABUT_FAILURE_NONE, penalty, &n),
      ABUT_REASON_CONVERGED);
  assert_int_equal(n, 1);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(projected_gaps_are_lengths),
      cmocka_unit_test(open_rows_have_no_gap_to_close),
      cmocka_unit_test(stagnation_counts_from_the_last_growth),
      cmocka_unit_test(noise_of_the_load_is_no_pressure),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
