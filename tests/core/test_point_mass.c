/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The textbook's scalar examples: a mass on a spring above a floor, and two
 * unknowns with an equality. All expected numbers are closed forms. */
#include "fixture.h"

#include <string.h>

/* min 1/2 k u^2 - m g u subject to u <= h, that is g = h - u. */
static const double k = 1, h = 1, weight = 3;

typedef struct history
{
  int32_t outer, n;
  double u[16], p[16];
} history;

static void
record(void *user, const abut_progress *progress, const double *displacement,
       const double *pressure)
{
  history *past = user;
  if (progress->outer == past->outer || past->n == 16)
    return;
  past->outer = progress->outer;
  past->u[past->n] = displacement[0];
  past->p[past->n] = pressure[0];
  past->n += 1;
}

typedef struct outcome
{
  double u, p;
  abut_progress progress;
  abut_reason reason;
  history past;
} outcome;

static outcome
point_mass(abut_strategy_options options, const char *law)
{
  abut_context *context = fixture_context();
  const int32_t node = 0;
  const double minus_one = -1;
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  assert_ok(abut_points_append_scalar(points, 0, 1, h, ABUT_POINT_CONTACT, 1,
                                      &node, &minus_one));
  const abut_dense_model model = {sizeof(model), 1, &k, &weight, points, NULL};
  outcome out = {0};
  options.law = abut_law_find(law);
  assert_ok(abut_dense_model_solve(context, &model, &options, &out.u, &out.p,
                                   NULL, record, &out.past, &out.progress,
                                   &out.reason));
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
  return out;
}

static void
lagrange_multiplier(void **unused)
{
  (void)unused;
  const outcome out = point_mass(exact_options(), "lagrange");
  assert_int_equal(out.reason, ABUT_REASON_CONVERGED);
  assert_close(out.u, h, 1e-12);
  assert_close(out.p, weight - k * h, 1e-12);
  /* One solve finds the contact, the next the answer. */
  assert_int_equal(out.progress.step, 2);
  assert_int_equal(out.progress.n_active, 1);
}

static void
penalty(void **unused)
{
  (void)unused;
  const double values[] = {1, 10, 1e3, 1e6};
  for (int i = 0; i < 4; ++i)
  {
    const double eps = values[i];
    abut_strategy_options options = exact_options();
    options.penalty = eps;
    const outcome out = point_mass(options, "penalty");
    assert_int_equal(out.reason, ABUT_REASON_CONVERGED);
    assert_close(out.u, (weight + eps * h) / (k + eps), 1e-12);
    assert_close(out.p, eps * (weight - k * h) / (k + eps), 1e-12);
  }
}

static void
penalty_with_allowed_penetration(void **unused)
{
  (void)unused;
  const double eps = 10, e = 0.25;
  abut_strategy_options options = exact_options();
  options.penalty = eps;
  options.allowed_penetration = e;
  const outcome out = point_mass(options, "penalty");
  /* The floor is e lower. */
  assert_close(out.u, (weight + eps * (h + e)) / (k + eps), 1e-12);
}

static void
quadratic_penalty(void **unused)
{
  (void)unused;
  abut_strategy_options options = exact_options();
  options.gap_tolerance = 2.5e-4;
  const outcome out = point_mass(options, "quadratic penalty");
  assert_int_equal(out.reason, ABUT_REASON_CONVERGED);
  /* Penetration (m g - k h)/(k + eps): 2/11, 2/101, 2/1001, 2/10001. */
  assert_close(out.progress.penalty, 1e4, 1e-12);
  assert_int_equal(out.progress.outer, 5);
  assert_int_equal(out.past.n, 5);
  for (int i = 0; i < 5; ++i)
  {
    const double eps = pow(10, i);
    assert_close(out.past.u[i], (weight + eps * h) / (k + eps), 1e-12);
  }
}

static void
quadratic_penalty_reports_its_cap(void **unused)
{
  (void)unused;
  abut_strategy_options options = exact_options();
  options.penalty_cap = 500;
  const outcome out = point_mass(options, "quadratic penalty");
  assert_int_equal(out.reason, ABUT_REASON_STEP_LIMIT);
  assert_close(out.progress.penalty, 500, 1e-12);
  assert_close(out.u, (weight + 500 * h) / (k + 500), 1e-12);
}

static void
augmented_lagrangian(void **unused)
{
  (void)unused;
  const double eps = 10;
  abut_strategy_options options = exact_options();
  options.penalty = eps;
  options.adaptive_penalty = false;
  options.gap_tolerance = 1e-13;
  const outcome out = point_mass(options, "augmented lagrangian");
  assert_int_equal(out.reason, ABUT_REASON_CONVERGED);
  assert_true(out.past.n >= 4);
  /* p_n = p* (1 - q^n) with p* = m g - k h and q = k/(k + eps). */
  for (int n = 1; n <= out.past.n; ++n)
  {
    const double p = (weight - k * h) * (1 - pow(k / (k + eps), n));
    assert_close(out.past.p[n - 1], p, 1e-12);
    assert_close(out.past.u[n - 1], (weight - p) / k, 1e-12);
  }
}

static abut_status
take_mean(void *user, int32_t n, double *values)
{
  double mean = 0;
  for (int32_t i = 0; i < n; ++i)
    mean += values[i] / n;
  for (int32_t i = 0; i < n; ++i)
    values[i] = mean;
  return *(const abut_status *)user;
}

/* Two floors at h = 1 and 1.2 under one mass, half the area each. Rows by
 * themselves hold it at the nearer one; with one multiplier for both, the mean
 * gap is closed, and each floor's spring adds eps times what is left of its
 * gap. */
static void
multipliers_of_a_space(void **unused)
{
  (void)unused;
  const double floors[] = {1, 1.2}, minus_one = -1, middle = 1.1;
  const int32_t node = 0;
  abut_context *context = fixture_context();
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  for (int i = 0; i < 2; ++i)
    assert_ok(abut_points_append_scalar(
        points, i, 0.5, floors[i], ABUT_POINT_CONTACT, 1, &node, &minus_one));
  const abut_dense_model model = {sizeof(model), 1, &k, &weight, points, NULL};
  abut_status answer = ABUT_SUCCESS;
  abut_strategy_options options = exact_options();
  options.law = abut_law_find("augmented lagrangian");
  options.penalty = 5;
  options.gap_tolerance = options.pressure_tolerance = 1e-13;
  options.adaptive_penalty = false;
  /* The rows' stiffness is k over their weight. */
  const double eps = options.penalty * k / 0.5;
  for (int one = 0; one < 2; ++one)
  {
    double u = 0, p[2] = {0, 0};
    abut_reason reason;
    options.project = one ? take_mean : NULL;
    options.project_user = &answer;
    assert_ok(abut_dense_model_solve(context, &model, &options, &u, p, NULL,
                                     NULL, NULL, NULL, &reason));
    assert_int_equal(reason, ABUT_REASON_CONVERGED);
    assert_close(u, one ? middle : 1, 1e-12);
    const double mean = weight - k * middle;
    for (int i = 0; i < 2; ++i)
      assert_close(p[i],
                   one ? mean + eps * (middle - floors[i])
                       : (1 - i) * (weight - k) / 0.5,
                   1e-11);
  }
  double u = 0, p[2] = {0, 0};
  abut_reason reason;
  answer = ABUT_UNSUPPORTED;
  assert_int_equal(abut_dense_model_solve(context, &model, &options, &u, p,
                                          NULL, NULL, NULL, NULL, &reason),
                   ABUT_CALLBACK_FAILED);
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
}

static void
barrier(void **unused)
{
  (void)unused;
  const double values[] = {1, 0.1, 1e-4};
  for (int i = 0; i < 3; ++i)
  {
    const double mu = values[i];
    abut_strategy_options options = exact_options();
    options.barrier_start = options.barrier_end = mu;
    const outcome out = point_mass(options, "barrier");
    assert_int_equal(out.reason, ABUT_REASON_CONVERGED);
    /* k (h - s) + mu / s = m g: k s^2 + (m g - k h) s - mu = 0. */
    const double excess = weight - k * h;
    const double s = 2 * mu / (excess + sqrt(excess * excess + 4 * k * mu));
    assert_close(out.p, mu / s, 1e-12);
    assert_close(out.u, h - s, 1e-12);
    assert_int_equal(out.progress.outer, 1);
  }
}

static void
interior_point(void **unused)
{
  (void)unused;
  const outcome out = point_mass(exact_options(), "interior point");
  assert_int_equal(out.reason, ABUT_REASON_CONVERGED);
  /* p g <= 1e-8 at the end. */
  assert_close(out.u, h, 1e-8);
  assert_close(out.p, weight - k * h, 1e-7);
  assert_true(out.progress.step <= 12);
}

/* min x1^2 + x2^2 with x1 + x2 = 1 by the method of multipliers. */
static history
two_unknowns(double c)
{
  abut_context *context = fixture_context();
  const double stiffness[] = {2, 0, 0, 2}, force[] = {0, 0};
  const int32_t nodes[] = {0, 1};
  const double ones[] = {1, 1};
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  assert_ok(abut_points_append_scalar(points, 0, 1, -1, ABUT_POINT_TIE, 2,
                                      nodes, ones));
  const abut_dense_model model = {sizeof(model), 2,      stiffness,
                                  force,         points, NULL};
  abut_strategy_options options = exact_options();
  options.law = abut_law_find("augmented lagrangian");
  options.penalty = c;
  options.adaptive_penalty = false;
  options.gap_tolerance = 1e-10;
  double x[2] = {0, 0}, p = 0;
  history past = {0};
  abut_reason reason;
  assert_ok(abut_dense_model_solve(context, &model, &options, x, &p, NULL,
                                   record, &past, NULL, &reason));
  assert_int_equal(reason, ABUT_REASON_CONVERGED);
  assert_close(x[0], 0.5, 1e-9);
  assert_close(x[1], x[0], 1e-12);
  assert_close(p, 1, 1e-9);
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
  return past;
}

static void
method_of_multipliers(void **unused)
{
  (void)unused;
  const double values[] = {1, 10};
  for (int i = 0; i < 2; ++i)
  {
    const double c = values[i];
    const history past = two_unknowns(c);
    assert_true(past.n >= 5);
    for (int n = 1; n <= past.n; ++n)
    {
      /* The textbook's lambda is minus the pressure: -1 (1 - (1/(1+c))^n). */
      const double p = 1 - pow(1 / (1 + c), n);
      assert_close(past.p[n - 1], p, 1e-12);
      assert_close(past.u[n - 1], p / 2, 1e-12);
    }
  }
}

/* The same two unknowns with x1 + x2 = sum. An equality may pull: p < 0 where
 * the sum is negative. */
static void
check_equality(const char *law, double sum)
{
  const double stiffness[] = {2, 0, 0, 2}, force[] = {0, 0}, eps = 10;
  const int32_t nodes[] = {0, 1};
  const double ones[] = {1, 1};
  const bool soft = strcmp(law, "penalty") == 0;
  abut_context *context = fixture_context();
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  assert_ok(abut_points_append_scalar(points, 0, 1, -sum, ABUT_POINT_TIE, 2,
                                      nodes, ones));
  const abut_dense_model model = {sizeof(model), 2,      stiffness,
                                  force,         points, NULL};
  abut_strategy_options options = exact_options();
  options.law = abut_law_find(law);
  options.penalty = eps;
  options.gap_tolerance = 1e-13;
  options.allowed_penetration = 0.1; /* of unilateral rows only */
  double x[2] = {0, 0}, p = 0;
  abut_reason reason;
  abut_progress progress;
  assert_ok(abut_dense_model_solve(context, &model, &options, x, &p, NULL, NULL,
                                   NULL, &progress, &reason));
  assert_int_equal(reason, ABUT_REASON_CONVERGED);
  const double expected = soft ? sum / 2 * eps / (1 + eps) : sum / 2;
  assert_close(x[0], expected, 1e-12);
  assert_close(x[1], expected, 1e-12);
  assert_close(p, 2 * expected, 1e-12);
  assert_close(progress.penetration, soft ? fabs(sum) / (1 + eps) : 0, 1e-12);
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
}

static void
equality(void **unused)
{
  (void)unused;
  const char *laws[] = {"lagrange", "penalty", "augmented lagrangian"};
  for (int law = 0; law < 3; ++law)
  {
    check_equality(laws[law], 1);
    check_equality(laws[law], -1);
  }
}

/* A mass between a floor and a ceiling: two rows on one unknown. */
static void
channel(void **unused)
{
  (void)unused;
  const double loads[] = {3, -3, 0.5}, eps = 10;
  const int32_t node = 0;
  const double up = 1, down = -1;
  for (int i = 0; i < 6; ++i)
  {
    const bool hard = i < 3;
    const double load = loads[i % 3];
    abut_context *context = fixture_context();
    abut_points *points = NULL;
    assert_ok(abut_points_create(context, 1, &points));
    assert_ok(abut_points_append_scalar(points, 0, 1, h, ABUT_POINT_CONTACT, 1,
                                        &node, &down));
    assert_ok(abut_points_append_scalar(points, 1, 1, h, ABUT_POINT_CONTACT, 1,
                                        &node, &up));
    const abut_dense_model model = {sizeof(model), 1, &k, &load, points, NULL};
    abut_strategy_options options = exact_options();
    options.law = abut_law_find(hard ? "lagrange" : "penalty");
    options.penalty = eps;
    double u = 0, p[2] = {0, 0};
    abut_reason reason;
    assert_ok(abut_dense_model_solve(context, &model, &options, &u, p, NULL,
                                     NULL, NULL, NULL, &reason));
    assert_int_equal(reason, ABUT_REASON_CONVERGED);
    const double excess = fmax(fabs(load) - k * h, 0);
    const double force = hard ? excess : excess * eps / (k + eps);
    assert_close(p[0], load > 0 ? force : 0, 1e-12);
    assert_close(p[1], load < 0 ? force : 0, 1e-12);
    assert_close(k * u, load - p[0] + p[1], 1e-12);
    assert_ok(abut_points_destroy(&points));
    assert_ok(abut_context_destroy(&context));
  }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lagrange_multiplier),
      cmocka_unit_test(penalty),
      cmocka_unit_test(penalty_with_allowed_penetration),
      cmocka_unit_test(quadratic_penalty),
      cmocka_unit_test(quadratic_penalty_reports_its_cap),
      cmocka_unit_test(augmented_lagrangian),
      cmocka_unit_test(multipliers_of_a_space),
      cmocka_unit_test(barrier),
      cmocka_unit_test(interior_point),
      cmocka_unit_test(method_of_multipliers),
      cmocka_unit_test(equality),
      cmocka_unit_test(channel),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
