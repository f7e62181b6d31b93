/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* One row of the interior point method, step by step: Mehrotra's corrector and
 * what is told after the step. */
#include "fixture.h"

static void
corrector_follows_from_the_predictor(void **unused)
{
  (void)unused;
  static const struct
  {
    double dp, dz, alpha; /* full changes, and the step that they allow */
  } cases[] = {{-1, -0.5, 1}, {-4, -0.5, 0.5}, {0.5, -2, 0.5}};
  const double weight = 3, stiffness = 1, gap = 1, pressure = 2;
  for (int i = 0; i < 3; ++i)
  {
    abut_context *context = fixture_context();
    abut_strategy_options options = exact_options();
    options.law = abut_law_find("interior point");
    abut_strategy *s = NULL;
    abut_request request;
    abut_progress progress;
    assert_ok(abut_strategy_create(context, &options, &s));
    assert_ok(abut_strategy_start(s, 1, NULL, &weight, &stiffness, NULL, &gap,
                                  &pressure, NULL));
    assert_ok(abut_strategy_next(s, NULL, &request));
    assert_int_equal(request.action, ABUT_ACTION_SOLVE);
    const double before = request.residual[0];
    const double dp = cases[i].dp, dz = cases[i].dz, alpha = cases[i].alpha;
    request.pressure_change[0] = dp;
    request.gap_change[0] = dz;
    assert_ok(abut_strategy_next(s, NULL, &request));
    assert_int_equal(request.action, ABUT_ACTION_SOLVE_AGAIN);
    /* The target is mu (mu_affine / mu)^3. */
    const double now = pressure * gap,
                 after = (pressure + alpha * dp) * (gap + alpha * dz);
    assert_close(request.residual[0] - before,
                 dp * dz - pow(after / now, 3) * now, 1e-14);
    assert_ok(abut_strategy_next(s, NULL, &request));
    assert_int_equal(request.action, ABUT_ACTION_MOVE);
    /* Nearly as far as pressure and slack stay positive. */
    assert_close(request.step_length, alpha < 1 ? 0.995 * alpha : 1, 1e-14);
    /* The host finds the row 0.25 deep. */
    const double deep = -0.25, p = pressure + request.step_length * dp;
    assert_ok(abut_strategy_next(s, &deep, &request));
    assert_ok(abut_strategy_progress(s, &progress));
    assert_true(progress.penetration == 0.25);
    assert_close(progress.complementarity, 0.25 * p, 1e-14);
    assert_int_equal(progress.outer, 1);
    assert_ok(abut_strategy_destroy(&s));
    assert_ok(abut_context_destroy(&context));
  }
}

/* A strategy of a law with its own scales, and its first request. */
typedef struct beginning
{
  abut_context *context;
  abut_strategy *strategy;
  abut_request request;
} beginning;

static const double length_scale = 10, pressure_scale = 100;

static beginning
begin(const char *law, int32_t n, const double *gap, const double *pressure)
{
  const double one[] = {1, 1};
  beginning b = {fixture_context(), NULL, {0}};
  abut_strategy_options options = exact_options();
  options.law = abut_law_find(law);
  options.length_scale = length_scale;
  options.pressure_scale = pressure_scale;
  assert_ok(abut_strategy_create(b.context, &options, &b.strategy));
  assert_ok(abut_strategy_start(b.strategy, n, NULL, one, one, NULL, gap,
                                pressure, NULL));
  assert_ok(abut_strategy_next(b.strategy, NULL, &b.request));
  assert_int_equal(b.request.action, ABUT_ACTION_SOLVE);
  return b;
}

static void
end(beginning *b)
{
  assert_ok(abut_strategy_destroy(&b->strategy));
  assert_ok(abut_context_destroy(&b->context));
}

/* With pressures to begin with: no pressure and no slack below a thousandth of
 * their scales. The residual is the product of pressure and gap, its derivative
 * by the pressure the slack. */
static void
warm_starts_are_lifted_off_the_boundary(void **unused)
{
  (void)unused;
  const double gap[] = {1, 1e-9}, pressure[] = {2, 0};
  beginning b = begin("interior point", 2, gap, pressure);
  const double p[] = {2, 0.1}, slack[] = {1, 0.01};
  for (int i = 0; i < 2; ++i)
  {
    assert_close(b.request.pressure[i], p[i], 1e-14);
    assert_close(b.request.d_pressure[i], slack[i], 1e-14);
    assert_close(b.request.residual[i], p[i] * gap[i], 1e-14);
  }
  end(&b);
}

/* Without any the first predictor only measures: pressure and slack become the
 * sizes that it would give them, and at least a tenth and three hundredths of
 * their scales. One row alone has no other to begin with. */
static void
cold_starts_take_sizes_from_the_first_predictor(void **unused)
{
  (void)unused;
  static const struct
  {
    double dp, dz, p, slack;
  } cases[] = {{-250, -3, 150, 2}, {-95, -0.9, 10, 0.3}, {7, 4, 107, 5}};
  const double gap = 1, none = 0;
  for (int i = 0; i < 3; ++i)
  {
    beginning b = begin("interior point", 1, &gap, &none);
    assert_close(b.request.pressure[0], pressure_scale, 1e-12);
    b.request.pressure_change[0] = cases[i].dp;
    b.request.gap_change[0] = cases[i].dz;
    assert_ok(abut_strategy_next(b.strategy, NULL, &b.request));
    assert_int_equal(b.request.action, ABUT_ACTION_SOLVE);
    assert_close(b.request.pressure[0], cases[i].p, 1e-12);
    assert_close(b.request.d_pressure[0], cases[i].slack, 1e-14);
    end(&b);
  }
}

/* Pressures of a barrier are at least those of its path, mu / g: there the
 * residual p g - mu is 0. Larger ones stay. */
static void
barriers_begin_on_their_path(void **unused)
{
  (void)unused;
  const double gap[] = {2, 4}, pressure[] = {0, 1e9};
  beginning b = begin("barrier", 2, gap, pressure);
  abut_progress progress;
  assert_ok(abut_strategy_progress(b.strategy, &progress));
  const double mu = progress.barrier * pressure_scale * length_scale;
  assert_true(mu > 0);
  assert_close(b.request.pressure[0], mu / gap[0], 1e-12 * mu);
  assert_close(b.request.residual[0], 0, 1e-12 * mu);
  assert_true(b.request.pressure[1] == 1e9);
  end(&b);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(corrector_follows_from_the_predictor),
      cmocka_unit_test(warm_starts_are_lifted_off_the_boundary),
      cmocka_unit_test(cold_starts_take_sizes_from_the_first_predictor),
      cmocka_unit_test(barriers_begin_on_their_path),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
