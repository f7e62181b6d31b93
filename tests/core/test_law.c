/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Laws: linearisations against finite differences at random states of all
 * branches, classification, and checks of arguments. */
#include "fixture.h"

#include <string.h>

enum
{
  N = 1000
};

/* Random rows, and room for what a law returns. */
typedef struct sample
{
  double gap[N], pressure[N], slack[N], reference[N], compliance[N], scale[N];
  uint8_t bilateral[N], state[N];
  double c[N], a[N], b[N];
  abut_law_points points;
  abut_law_linearisation result;
} sample;

static double
between(uint64_t *seed, double low, double high)
{
  return low + (high - low) * fixture_random(seed);
}

static void
fill(sample *s, uint64_t seed, bool interior)
{
  for (int i = 0; i < N; ++i)
  {
    s->gap[i] = interior ? between(&seed, 0.01, 1) : between(&seed, -1, 1);
    s->pressure[i] = interior ? between(&seed, 0.01, 3) : between(&seed, -3, 3);
    s->slack[i] = between(&seed, 0.01, 1);
    s->reference[i] = between(&seed, 0, 3);
    s->compliance[i] = between(&seed, 0.001, 0.5);
    s->scale[i] = between(&seed, 0.1, 10);
    s->bilateral[i] = !interior && i % 7 == 0;
  }
  const abut_law_points points = {.struct_size = sizeof(points),
                                  .n = N,
                                  .gap = s->gap,
                                  .pressure = s->pressure,
                                  .slack = s->slack,
                                  .reference_pressure = s->reference,
                                  .compliance = s->compliance,
                                  .scale = s->scale,
                                  .bilateral = s->bilateral,
                                  .allowed_penetration = 0.125,
                                  .barrier = 0.0625};
  const abut_law_linearisation result = {sizeof(result), s->c, s->a, s->b};
  s->points = points;
  s->result = result;
}

/* c at p + t dp, g + t dg in the states of the sample. A slack moves by
 * dz = dg + (g - z), the Newton step of z = g. */
static void
residual_at(const abut_law *law, const sample *s, const double *dp,
            const double *dg, double t, double *c)
{
  static double gap[N], pressure[N], slack[N], a[N], b[N];
  for (int i = 0; i < N; ++i)
  {
    gap[i] = s->gap[i] + t * dg[i];
    pressure[i] = s->pressure[i] + t * dp[i];
    slack[i] = s->slack[i] + t * (dg[i] + s->gap[i] - s->slack[i]);
  }
  abut_law_points points = s->points;
  points.pressure = pressure;
  points.slack = slack;
  /* With a slack the residual p z - mu is that of g = z. */
  points.gap = (law->flags & ABUT_LAW_SLACK) != 0 ? slack : gap;
  abut_law_linearisation result = {sizeof(result), c, a, b};
  assert_ok(law->linearise(&points, s->state, &result));
}

/* Two-sided differences of c in a random direction against a dp + b dg. The
 * constant p (g - z) of a law with slack belongs to its derivative. */
static void
check_derivative(const abut_law *law, const sample *s, uint64_t seed)
{
  static double dp[N], dg[N], plus[N], minus[N];
  const double t = 1e-6;
  for (int i = 0; i < N; ++i)
  {
    dp[i] = between(&seed, -1, 1);
    dg[i] = between(&seed, -1, 1);
  }
  residual_at(law, s, dp, dg, t, plus);
  residual_at(law, s, dp, dg, -t, minus);
  for (int i = 0; i < N; ++i)
  {
    double expected = s->a[i] * dp[i] + s->b[i] * dg[i];
    if ((law->flags & ABUT_LAW_SLACK) != 0)
      expected += s->pressure[i] * (s->gap[i] - s->slack[i]);
    assert_close((plus[i] - minus[i]) / (2 * t), expected, 1e-6);
  }
}

static void
linearisations_match_differences(void **unused)
{
  (void)unused;
  static sample s;
  const abut_law *law;
  for (int32_t l = 0; (law = abut_law_get(l)) != NULL; ++l)
  {
    const bool interior = (law->flags & ABUT_LAW_INTERIOR) != 0;
    fill(&s, 17 + (uint64_t)l, interior);
    assert_ok(law->classify(&s.points, s.state));
    int n_closed = 0;
    for (int i = 0; i < N; ++i)
      n_closed += s.state[i] == ABUT_STATE_CLOSED;
    assert_true(n_closed > N / 10 && n_closed < N - N / 10);
    assert_ok(law->linearise(&s.points, s.state, &s.result));
    check_derivative(law, &s, 99);
    /* A law must also linearise in a state that it would not choose. */
    for (int i = 0; i < N; ++i)
      s.state[i] = !s.state[i];
    assert_ok(law->linearise(&s.points, s.state, &s.result));
    check_derivative(law, &s, 101);
  }
}

/* The shifted gap that each law is documented to have. */
static double
shifted_gap(const char *name, const sample *s, int i)
{
  const double g = s->gap[i], p = s->pressure[i], ieps = s->compliance[i];
  if (strcmp(name, "lagrange") == 0)
    return g;
  if (strcmp(name, "penalty") == 0)
    return g + (s->bilateral[i] ? 0 : 0.125) + p * ieps;
  if (strcmp(name, "quadratic penalty") == 0 || strcmp(name, "nitsche") == 0)
    return g + p * ieps;
  return g + (p - s->reference[i]) * ieps;
}

static void
states_and_residuals_are_those_of_the_family(void **unused)
{
  (void)unused;
  static sample s;
  const abut_law *law;
  fill(&s, 5, false);
  for (int32_t l = 0; (law = abut_law_get(l)) != NULL; ++l)
  {
    if ((law->flags & ABUT_LAW_INTERIOR) != 0)
      continue;
    assert_ok(law->classify(&s.points, s.state));
    assert_ok(law->linearise(&s.points, s.state, &s.result));
    for (int i = 0; i < N; ++i)
    {
      const double gap = shifted_gap(law->name, &s, i);
      const bool closed =
          s.bilateral[i] || s.pressure[i] - s.scale[i] * gap > 0;
      assert_int_equal(s.state[i], closed);
      assert_close(s.c[i], closed ? gap : s.pressure[i], 1e-14);
      const bool hard = (law->flags & ABUT_LAW_HARD) != 0;
      assert_true(!closed || (s.a[i] == 0) == hard);
      assert_true(closed || s.b[i] == 0);
    }
  }
}

static void
interior_laws_solve_their_equation(void **unused)
{
  (void)unused;
  const double mu = 0.5, p = 2, g = 0.25, c = 1;
  uint8_t state;
  double residual, a, b;
  abut_law_points points = {.struct_size = sizeof(points),
                            .n = 1,
                            .gap = &g,
                            .pressure = &p,
                            .slack = &g,
                            .scale = &c,
                            .barrier = mu};
  abut_law_linearisation result = {sizeof(result), &residual, &a, &b};
  const char *names[] = {"barrier", "interior point"};
  for (int i = 0; i < 2; ++i)
  {
    const abut_law *law = abut_law_find(names[i]);
    assert_ok(law->classify(&points, &state));
    assert_int_equal(state, ABUT_STATE_CLOSED);
    assert_ok(law->linearise(&points, &state, &result));
    assert_close(residual, p * g - mu, 1e-15);
    assert_close(a, g, 0);
    assert_close(b, p, 0);
  }
}

static void
touching_without_pressure_is_open(void **unused)
{
  (void)unused;
  const double zero = 0, one = 1;
  uint8_t state = 1;
  const abut_law_points points = {.struct_size = sizeof(points),
                                  .n = 1,
                                  .gap = &zero,
                                  .pressure = &zero,
                                  .scale = &one};
  assert_ok(abut_law_find("lagrange")->classify(&points, &state));
  assert_int_equal(state, ABUT_STATE_OPEN);
}

static void
names(void **unused)
{
  (void)unused;
  const char *words[] = {"lagrange",
                         "penalty",
                         "quadratic penalty",
                         "augmented lagrangian",
                         "barrier",
                         "interior point",
                         "nitsche"};
  for (int32_t i = 0; i < 7; ++i)
  {
    assert_string_equal(abut_law_get(i)->name, words[i]);
    assert_ptr_equal(abut_law_get(i), abut_law_find(words[i]));
    assert_int_equal(abut_law_get(i)->struct_size, sizeof(abut_law));
  }
  assert_null(abut_law_get(7));
  assert_null(abut_law_get(-1));
  assert_null(abut_law_find("lagrangian"));
  assert_null(abut_law_find(NULL));
}

/* Both functions of all laws must refuse the points. */
static void
assert_refused(const abut_law_points *points, abut_status status)
{
  static uint8_t state[N];
  static double c[N], a[N], b[N];
  abut_law_linearisation result = {sizeof(result), c, a, b};
  const abut_law *law;
  for (int32_t l = 0; (law = abut_law_get(l)) != NULL; ++l)
  {
    assert_int_equal(law->classify(points, state), status);
    assert_int_equal(law->linearise(points, state, &result), status);
  }
}

static void
arguments_are_checked(void **unused)
{
  (void)unused;
  static sample s;
  fill(&s, 3, true);
  assert_refused(NULL, ABUT_INVALID_ARGUMENT);
  abut_law_points points = s.points;
  points.struct_size = 1;
  assert_refused(&points, ABUT_INVALID_ARGUMENT);
  points = s.points;
  points.n = -1;
  assert_refused(&points, ABUT_INVALID_ARGUMENT);
  points = s.points;
  points.gap = NULL;
  assert_refused(&points, ABUT_INVALID_ARGUMENT);
  points = s.points;
  points.barrier = NAN;
  assert_refused(&points, ABUT_INVALID_ARGUMENT);
  points = s.points;
  points.allowed_penetration = -1;
  assert_refused(&points, ABUT_INVALID_ARGUMENT);
  s.scale[N - 1] = 0;
  assert_refused(&s.points, ABUT_INVALID_ARGUMENT);
  s.scale[N - 1] = 1;
  s.gap[N / 2] = NAN;
  assert_refused(&s.points, ABUT_NOT_FINITE);
  s.gap[N / 2] = 1;
  s.pressure[0] = INFINITY;
  assert_refused(&s.points, ABUT_NOT_FINITE);
}

/* What follows the last row may be anything. */
static void
nothing_beyond_the_rows_is_read_or_written(void **unused)
{
  (void)unused;
  for (int32_t k = 0; abut_law_get(k) != NULL; ++k)
  {
    const abut_law *law = abut_law_get(k);
    static sample s;
    fill(&s, 5, (law->flags & ABUT_LAW_INTERIOR) != 0);
    s.points.n = 10;
    s.gap[10] = s.pressure[10] = s.slack[10] = s.reference[10] =
        s.compliance[10] = NAN;
    s.scale[10] = -1;
    s.c[10] = s.a[10] = s.b[10] = 77;
    s.state[10] = 77;
    assert_ok(law->classify(&s.points, s.state));
    assert_ok(law->linearise(&s.points, s.state, &s.result));
    assert_true(s.c[10] == 77 && s.a[10] == 77 && s.b[10] == 77);
    assert_int_equal(s.state[10], 77);
  }
}

static void
results_are_checked(void **unused)
{
  (void)unused;
  static sample s;
  fill(&s, 3, true);
  const abut_law *law;
  for (int32_t l = 0; (law = abut_law_get(l)) != NULL; ++l)
  {
    abut_law_linearisation result = s.result;
    assert_int_equal(law->classify(&s.points, NULL), ABUT_INVALID_ARGUMENT);
    assert_int_equal(law->linearise(&s.points, s.state, NULL),
                     ABUT_INVALID_ARGUMENT);
    result.d_gap = NULL;
    assert_int_equal(law->linearise(&s.points, s.state, &result),
                     ABUT_INVALID_ARGUMENT);
    result = s.result;
    result.struct_size = 0;
    assert_int_equal(law->linearise(&s.points, s.state, &result),
                     ABUT_INVALID_ARGUMENT);
  }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(linearisations_match_differences),
      cmocka_unit_test(states_and_residuals_are_those_of_the_family),
      cmocka_unit_test(interior_laws_solve_their_equation),
      cmocka_unit_test(touching_without_pressure_is_open),
      cmocka_unit_test(names),
      cmocka_unit_test(arguments_are_checked),
      cmocka_unit_test(nothing_beyond_the_rows_is_read_or_written),
      cmocka_unit_test(results_are_checked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
