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

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(corrector_follows_from_the_predictor),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
