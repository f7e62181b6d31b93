/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The textbooks' iterations for stick and slip: what they linearise, where they
 * fail by formulas, and that what they find is an answer. */
#include "fixture.h"
#include "frictional.h"

#include <stdlib.h>
#include <string.h>

enum
{
  MANY = 500
};

/* Points that slip, with 1 and 2 tangents in turn, evaluated by themselves. */
typedef struct slipping
{
  uint8_t n_tangents;
  double slip[2], traction[2], reference[2], scale, compliance, bound, d_bound;
  double residual[2], d_traction[4], d_slip[4], d_pressure[2];
} slipping;

static void
linearise(slipping *s)
{
  const uint8_t state = ABUT_STATE_SLIP;
  const abut_friction_points points = {
      .struct_size = sizeof(points),
      .n = 1,
      .n_tangents = &s->n_tangents,
      .slip = s->slip,
      .traction = s->traction,
      .reference_traction = s->reference,
      .compliance = &s->compliance,
      .scale = &s->scale,
      .bound = &s->bound,
      .d_bound = &s->d_bound,
      .radial_return = 1,
  };
  const abut_friction_linearisation result = {sizeof(result), s->residual,
                                              s->d_traction,  s->d_slip,
                                              s->d_pressure,  NULL};
  assert_ok(abut_friction_linearise(&points, &state, &result));
}

/* |x|, to stay away from its zero. */
static double
length_of(const slipping *s)
{
  double square = 0;
  for (int k = 0; k < s->n_tangents; ++k)
  {
    const double shifted =
        s->slip[k] + (s->traction[k] - s->reference[k]) * s->compliance;
    const double x = s->traction[k] - s->scale * shifted;
    square += x * x;
  }
  return sqrt(square);
}

static double
between(uint64_t *seed, double low, double high)
{
  return low + (high - low) * fixture_random(seed);
}

static void
draw(slipping *s, int i, uint64_t *seed)
{
  memset(s, 0, sizeof(*s));
  s->n_tangents = (uint8_t)(1 + i % 2);
  s->scale = between(seed, 0.1, 3);
  s->compliance = i % 3 == 0 ? 0 : between(seed, 0, 2) / s->scale;
  s->d_bound = between(seed, 0, 2);
  for (int k = 0; k < s->n_tangents; ++k)
  {
    s->slip[k] = between(seed, -1, 1);
    s->traction[k] = between(seed, -3, 3);
    s->reference[k] = between(seed, -1, 1);
  }
  s->bound = between(seed, 0.1, 0.9) * length_of(s);
}

/* All blocks are the derivatives of tau - rho x/|x| itself, wherever the
 * traction is. */
static void
the_return_map_is_linearised(void **unused)
{
  (void)unused;
  const double h = 1e-6;
  uint64_t seed = 3;
  int n = 0;
  for (int i = 0; i < MANY; ++i)
  {
    slipping s;
    draw(&s, i, &seed);
    if (length_of(&s) < 0.3)
      continue;
    linearise(&s);
    const int t = s.n_tangents;
    for (int c = 0; c < t; ++c)
      for (int by_slip = 0; by_slip < 2; ++by_slip)
      {
        slipping up = s, down = s;
        (by_slip != 0 ? up.slip : up.traction)[c] += h;
        (by_slip != 0 ? down.slip : down.traction)[c] -= h;
        linearise(&up);
        linearise(&down);
        for (int r = 0; r < t; ++r, ++n)
          assert_close((up.residual[r] - down.residual[r]) / (2 * h),
                       (by_slip != 0 ? s.d_slip : s.d_traction)[r * t + c],
                       1e-7);
      }
    slipping up = s, down = s;
    up.bound += h * s.d_bound;
    down.bound -= h * s.d_bound;
    linearise(&up);
    linearise(&down);
    for (int r = 0; r < t; ++r)
      assert_close((up.residual[r] - down.residual[r]) / (2 * h),
                   s.d_pressure[r], 1e-8);
  }
  assert_true(n > 2 * MANY);
}

/* A mass of two directions, normal and tangential. */
static frictional
mass(double normal, double coupling, double coefficient)
{
  frictional problem;
  memset(&problem, 0, sizeof(problem));
  problem.dimension = problem.n = 2;
  problem.n_points = 1;
  problem.stiffness[0] = normal;
  problem.stiffness[1] = problem.stiffness[2] = coupling;
  problem.stiffness[3] = 1;
  problem.coefficient[0] = coefficient;
  problem.cap[0] = INFINITY;
  return problem;
}

static void
solve(const frictional *problem, const abut_strategy_options *options,
      bool from_state, frictional_answer *answer, char *message, size_t size)
{
  abut_context *context = fixture_context();
  frictional_solve(context, problem, options, from_state, answer);
  assert_ok(answer->status);
  if (message != NULL)
  {
    strncpy(message, abut_context_message(context), size - 1);
    message[size - 1] = '\0';
  }
  assert_ok(abut_context_destroy(&context));
}

/* The mass, without load along the plane, on a spring of stiffness 1, starts
 * from slip against it: rho/K aside with friction rho. There x = -rho + c
 * rho/K, which is beyond the disc on its other side for c > 2 K, and so on for
 * ever. */
static frictional_answer
slipped_back(double c, abut_friction_iteration iteration, const char *law)
{
  frictional problem = mass(1, 0, 0.5);
  problem.force[0] = 3;
  abut_strategy_options options = exact_options();
  options.law = abut_law_find(law);
  options.friction_iteration = iteration;
  options.complementarity = options.penalty = c;
  if (strcmp(law, "lagrange") == 0)
  {
    options.complementarity = c / 0.3;
    options.penalty = 0;
  }
  frictional_answer answer;
  memset(&answer, 0, sizeof(answer));
  answer.p[0] = 3;
  answer.p[1] = -1.5;
  answer.u[1] = -1.5;
  answer.state[0] = answer.state[1] = ABUT_STATE_SLIP;
  solve(&problem, &options, true, &answer, NULL, 0);
  return answer;
}

static void
the_return_map_goes_to_and_fro(void **unused)
{
  (void)unused;
  /* With springs of stiffness eps from no traction, x = -eps s is beyond the
   * disc for eps > K. */
  const char *laws[] = {"lagrange", "penalty"};
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k)
    {
      const double limit = i == 0 ? 2 : 1, c = limit + (k == 0 ? -0.1 : 0.1);
      const frictional_answer returned =
          slipped_back(c, ABUT_FRICTION_RADIAL_RETURN, laws[i]);
      const frictional_answer meant =
          slipped_back(c, ABUT_FRICTION_PRIMAL_DUAL, laws[i]);
      assert_int_equal(meant.reason, ABUT_REASON_CONVERGED);
      assert_close(meant.p[1], 0, 1e-12);
      assert_int_equal(returned.reason,
                       k == 0 ? ABUT_REASON_CONVERGED : ABUT_REASON_STAGNATION);
      assert_int_equal(returned.progress.seen,
                       k == 0 ? ABUT_FAILURE_NONE : ABUT_FAILURE_STICK_SLIP);
      assert_int_equal(returned.progress.friction_rung, k == 0 ? 0 : 4);
      if (k == 0)
        assert_close(returned.p[1], 0, 1e-12);
      else
        assert_int_equal(returned.progress.cycle_length, 2);
    }
}

/* Without springs friction takes from what presses: with k = -coupling,
 * p = f_n + k f_t - k mu p. Frozen bounds change by k mu of their last change
 * in each round: after n rounds from p = 0 by r^(n-1) (1 + r)/(1 - (-r)^n) of
 * themselves, r = k mu. */
static void
tresca_contracts_by_the_coupling(void **unused)
{
  (void)unused;
  const double ratios[] = {0.1, 0.5, 0.9, 0.999, 1.5};
  for (int i = 0; i < 5; ++i)
  {
    const double r = ratios[i], k = 2;
    frictional problem = mass(2 * k * k, -k, r / k);
    problem.force[0] = -7;
    problem.force[1] = 4;
    const double p = (-7 + 4 * k) / (1 + r);
    abut_strategy_options options = exact_options();
    options.max_steps = 1000;
    frictional_answer answer;
    memset(&answer, 0, sizeof(answer));
    solve(&problem, &options, false, &answer, NULL, 0);
    assert_int_equal(answer.reason, ABUT_REASON_CONVERGED);
    assert_true(answer.progress.step <= 6);
    assert_close(answer.p[0], p, 1e-12);
    options.friction_iteration = ABUT_FRICTION_TRESCA;
    memset(&answer, 0, sizeof(answer));
    char message[300];
    solve(&problem, &options, false, &answer, message, sizeof(message));
    if (r < 0.8)
    {
      assert_int_equal(answer.reason, ABUT_REASON_CONVERGED);
      assert_int_equal(answer.progress.seen, ABUT_FAILURE_NONE);
      assert_int_equal(answer.progress.friction_rung, 3);
      assert_close(answer.p[0], p, 1e-8);
      assert_true(answer.progress.step >= log(1e-10) / log(r));
      continue;
    }
    const double change = pow(r, 99) * (1 + r) / (1 - pow(r, 100));
    assert_int_equal(answer.reason, ABUT_REASON_STAGNATION);
    assert_int_equal(answer.progress.seen, ABUT_FAILURE_STICK_SLIP);
    assert_int_equal(answer.progress.friction_rung, 4);
    if (r > 1)
    {
      /* In the second round friction lifts the mass, and there is none then. */
      assert_non_null(strstr(message, "after 1 iterations"));
      assert_non_null(strstr(message, "no state of stick and slip is found"));
      assert_true(answer.progress.step < 70);
      continue;
    }
    const char *told = strstr(message, "after 100 iterations");
    assert_non_null(told);
    told = strstr(told, "change by ");
    assert_non_null(told);
    assert_float_equal(strtod(told + strlen("change by "), NULL) / change, 1,
                       1e-3);
  }
}

/* Random problems, all of which have an answer: what the textbooks' iterations
 * find obeys the law, and each of them misses some. */
static void
textbooks_miss_some(void **unused)
{
  (void)unused;
  const frictional_ranges mild = {{.05, 1}, {3, 100}};
  const abut_friction_iteration iterations[] = {ABUT_FRICTION_RADIAL_RETURN,
                                                ABUT_FRICTION_TRESCA};
  for (int k = 0; k < 2; ++k)
    for (int32_t dimension = 2; dimension <= 3; ++dimension)
    {
      uint64_t seed = 1;
      int found = 0;
      for (int i = 0; i < 200; ++i)
      {
        const frictional problem = frictional_draw(dimension, &mild, &seed);
        abut_strategy_options options = exact_options();
        options.max_steps = 2000;
        options.friction_iteration = iterations[k];
        frictional_answer answer;
        memset(&answer, 0, sizeof(answer));
        solve(&problem, &options, false, &answer, NULL, 0);
        if (answer.reason != ABUT_REASON_CONVERGED)
          continue;
        found += 1;
        assert_true(frictional_violation(&problem, answer.u, answer.p) < 1e-8);
      }
      print_message("iteration %d in %d dimensions: %d of 200\n",
                    (int)iterations[k], (int)dimension, found);
      assert_in_range(found, 100, 199);
    }
}

static void
refused(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  abut_strategy_options options = exact_options();
  assert_int_equal(options.friction_iteration, ABUT_FRICTION_PRIMAL_DUAL);
  options.friction_iteration = (abut_friction_iteration)3;
  abut_strategy *s = NULL;
  assert_int_equal(abut_strategy_create(context, &options, &s),
                   ABUT_INVALID_ARGUMENT);
  assert_non_null(strstr(abut_context_message(context), "friction_iteration"));
  assert_null(s);
  assert_ok(abut_context_destroy(&context));
}

/* A law that may be missed by a part of the largest pressure is missed by no
 * more than that (the distance along the surface by which it is missed is
 * larger by the inverse of the stiffness, 0.1 or more), in fewer systems. */
static void
a_loose_law(void **unused)
{
  (void)unused;
  const frictional_ranges ranges = {{0.05, 0.5}, {2, 50}};
  abut_context *context = NULL;
  assert_ok(abut_context_create(NULL, &context));
  const double tolerance[2] = {1e-10, 1e-3};
  int32_t n_steps[2] = {0, 0};
  double worst[2] = {0, 0};
  uint64_t seed = 7;
  for (int problem = 0; problem < MANY; ++problem)
  {
    const frictional drawn = frictional_draw(3, &ranges, &seed);
    for (int k = 0; k < 2; ++k)
    {
      abut_strategy_options options = abut_strategy_defaults();
      options.linear_tolerance = options.final_linear_tolerance;
      options.traction_tolerance = tolerance[k];
      frictional_answer answer;
      memset(&answer, 0, sizeof(answer));
      frictional_solve(context, &drawn, &options, false, &answer);
      assert_ok(answer.status);
      assert_int_equal(answer.reason, ABUT_REASON_CONVERGED);
      double largest = 0;
      for (int32_t i = 0; i < drawn.n; ++i)
        largest = fmax(largest, fabs(answer.p[i]));
      n_steps[k] += answer.progress.step;
      if (largest > 0)
        worst[k] =
            fmax(worst[k],
                 frictional_violation(&drawn, answer.u, answer.p) / largest);
    }
  }
  assert_true(n_steps[1] < n_steps[0] - MANY / 4);
  assert_true(worst[0] <= 10 * tolerance[0]);
  assert_true(worst[1] <= 10 * tolerance[1]);
  assert_true(worst[1] > tolerance[0]);
  abut_context_destroy(&context);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_loose_law),
      cmocka_unit_test(the_return_map_is_linearised),
      cmocka_unit_test(the_return_map_goes_to_and_fro),
      cmocka_unit_test(tresca_contracts_by_the_coupling),
      cmocka_unit_test(textbooks_miss_some),
      cmocka_unit_test(refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
