/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The methods on deal.II's step-41. Active sets, energies and forces are those
 * of the discrete problem, computed by an independent program; the numbers of
 * solves of the plain active set are step-41's own. */
#include "fixture.h"
#include "membrane.h"

#include <string.h>

typedef struct reference
{
  int32_t level, active, steps;
  double energy, force;
} reference;

static const reference references[] = {
    {3, 38, 3, -12.0522185095, 18.67805454},
    {4, 103, 5, -11.6049152836, 19.22538172},
    {5, 395, 6, -11.2569240821, 19.76854801},
    {6, 1452, 11, -11.0644710680, 19.99859538},
};

enum
{
  N_LEVELS = sizeof(references) / sizeof(references[0]),
  N_CHEAP = N_LEVELS - 1 /* for sweeps under the sanitizers */
};

/* Run a law on the levels in turn, each from the last one's solution if nested
 * is set; steps[] receives the linear systems per level. */
static void
sweep(const char *law, bool nested, int n_levels,
      void (*adjust)(abut_strategy_options *), int32_t *steps,
      void (*check)(const reference *, const membrane *, const abut_progress *))
{
  abut_context *context = fixture_context();
  membrane coarse = {0};
  for (int l = 0; l < n_levels; ++l)
  {
    membrane scene = membrane_create(references[l].level, 1, 1);
    abut_strategy_options options = membrane_options(&scene, law);
    if (adjust != NULL)
      adjust(&options);
    const bool warm = nested && l > 0;
    if (warm)
      membrane_prolong(&coarse, &scene);
    abut_progress progress;
    assert_int_equal(membrane_run(context, &scene, &options, warm, &progress),
                     ABUT_REASON_CONVERGED);
    steps[l] = progress.step;
    if (check != NULL)
      check(&references[l], &scene, &progress);
    membrane_destroy(&coarse);
    coarse = scene;
  }
  membrane_destroy(&coarse);
  assert_ok(abut_context_destroy(&context));
}

static void
check_exact(const reference *r, const membrane *scene,
            const abut_progress *progress)
{
  assert_int_equal(progress->n_active, r->active);
  assert_close(membrane_energy(scene), r->energy, 1e-9);
  assert_close(membrane_force(scene), r->force, 1e-9);
  assert_int_equal(progress->fallback_steps, 0);
}

/* Up to the gap tolerance 1e-6 of the iterative methods. */
static void
check_close(const reference *r, const membrane *scene,
            const abut_progress *progress)
{
  assert_true(progress->penetration <= 1e-6);
  assert_close(membrane_energy(scene), r->energy, 2e-6);
  assert_close(membrane_force(scene), r->force, 1e-5);
}

static void
plain_active_set_takes_the_steps_of_step_41(void **unused)
{
  (void)unused;
  int32_t steps[N_LEVELS];
  sweep("lagrange", false, N_LEVELS, NULL, steps, check_exact);
  for (int l = 0; l < N_LEVELS; ++l)
    assert_int_equal(steps[l], references[l].steps);
}

static void
nested_active_set(void **unused)
{
  (void)unused;
  int32_t steps[N_LEVELS];
  sweep("lagrange", true, N_LEVELS, NULL, steps, check_exact);
  for (int l = 1; l < N_LEVELS; ++l)
    assert_true(steps[l] <= 5);
}

static void
use_loose_solves(abut_strategy_options *options)
{
  options->linear_tolerance = 1e-2;
}

static void
final_solve_is_counted(void **unused)
{
  (void)unused;
  int32_t steps[N_CHEAP];
  sweep("lagrange", false, N_CHEAP, use_loose_solves, steps, check_exact);
  for (int l = 0; l < N_CHEAP; ++l)
    assert_int_equal(steps[l], references[l].steps + 1);
}

static void
active_set_sizes_fall(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  membrane scene = membrane_create(5, 1, 1);
  const abut_strategy_options options = membrane_options(&scene, "lagrange");
  abut_progress progress;
  membrane_run(context, &scene, &options, false, &progress);
  /* Begins with the empty set and, after the first step, only shrinks: the
   * matrix is an M-matrix. */
  assert_int_equal(scene.n_sets, progress.step);
  assert_int_equal(scene.set_size[0], 0);
  for (int i = 2; i < scene.n_sets; ++i)
    assert_true(scene.set_size[i] <= scene.set_size[i - 1]);
  membrane_destroy(&scene);
  assert_ok(abut_context_destroy(&context));
}

static double complementarity;

static void
use_complementarity(abut_strategy_options *options)
{
  options->complementarity = complementarity;
}

static void
complementarity_does_not_matter(void **unused)
{
  (void)unused;
  const double values[] = {1e-2, 1e2, 1e6};
  for (int i = 0; i < 3; ++i)
  {
    int32_t steps[N_CHEAP];
    complementarity = values[i];
    sweep("lagrange", false, N_CHEAP, use_complementarity, steps, check_exact);
    for (int l = 0; l < N_CHEAP; ++l)
      assert_int_equal(steps[l], references[l].steps);
    sweep("lagrange", true, N_CHEAP, use_complementarity, steps, check_exact);
    for (int l = 1; l < N_CHEAP; ++l)
      assert_true(steps[l] <= 5);
  }
}

static void
augmented_lagrangian(void **unused)
{
  (void)unused;
  int32_t steps[N_LEVELS];
  sweep("augmented lagrangian", true, N_LEVELS, NULL, steps, check_close);
  for (int l = 1; l < N_LEVELS; ++l)
    assert_true(steps[l] <= 8);
}

static void
use_fixed_penalty(abut_strategy_options *options)
{
  options->adaptive_penalty = false;
}

static void
augmented_lagrangian_with_fixed_penalty(void **unused)
{
  (void)unused;
  int32_t steps[N_LEVELS];
  sweep("augmented lagrangian", true, N_LEVELS, use_fixed_penalty, steps,
        check_close);
  for (int l = 1; l < N_LEVELS; ++l)
    assert_true(steps[l] <= 12);
}

static void
quadratic_penalty(void **unused)
{
  (void)unused;
  int32_t steps[N_CHEAP];
  sweep("quadratic penalty", true, N_CHEAP, NULL, steps, check_close);
}

static void
interior_point(void **unused)
{
  (void)unused;
  int32_t steps[N_LEVELS];
  sweep("interior point", false, N_LEVELS, NULL, steps, check_close);
  for (int l = 0; l < N_LEVELS; ++l)
    assert_true(steps[l] <= 12);
  sweep("interior point", true, N_LEVELS, NULL, steps, check_close);
  for (int l = 1; l < N_LEVELS; ++l)
    assert_true(steps[l] <= 8);
}

static void
barrier(void **unused)
{
  (void)unused;
  int32_t steps[N_CHEAP];
  sweep("barrier", false, N_CHEAP, NULL, steps, check_close);
}

/* The error of a method's parameter: of first order in 1/eps and in mu. */
static void
parameters_have_their_orders(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  const char *laws[] = {"penalty", "barrier"};
  for (int law = 0; law < 2; ++law)
  {
    double error[2];
    for (int i = 0; i < 2; ++i)
    {
      membrane scene = membrane_create(4, 1, 1);
      abut_strategy_options options = membrane_options(&scene, laws[law]);
      options.penalty = i == 0 ? 1e4 : 1e5;
      options.barrier_end = i == 0 ? 1e-5 : 1e-6;
      abut_progress progress;
      membrane_run(context, &scene, &options, false, &progress);
      error[i] = fabs(membrane_energy(&scene) - references[1].energy);
      membrane_destroy(&scene);
    }
    assert_close(log10(error[0] / error[1]), 1, 0.1);
  }
  assert_ok(abut_context_destroy(&context));
}

/* Other units: the same steps and the same numbers. */
static void
units_divide_out(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  const double length = 1e3, force = 1e-6;
  const abut_law *law;
  for (int32_t i = 0; (law = abut_law_get(i)) != NULL; ++i)
  {
    membrane scenes[2] = {membrane_create(4, 1, 1),
                          membrane_create(4, length, force)};
    abut_progress progress[2];
    for (int unit = 0; unit < 2; ++unit)
    {
      abut_strategy_options options =
          membrane_options(&scenes[unit], law->name);
      assert_int_equal(membrane_run(context, &scenes[unit], &options, false,
                                    &progress[unit]),
                       ABUT_REASON_CONVERGED);
    }
    assert_int_equal(progress[0].step, progress[1].step);
    assert_int_equal(progress[0].outer, progress[1].outer);
    assert_int_equal(progress[0].n_active, progress[1].n_active);
    assert_close(membrane_energy(&scenes[1]) / (length * force),
                 membrane_energy(&scenes[0]), 1e-8);
    assert_close(membrane_force(&scenes[1]) / force, membrane_force(&scenes[0]),
                 1e-8);
    membrane_destroy(&scenes[0]);
    membrane_destroy(&scenes[1]);
  }
  assert_ok(abut_context_destroy(&context));
}

static void
barrier_refuses_a_closed_start(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  membrane scene = membrane_create(3, 1, 1);
  const abut_strategy_options options = membrane_options(&scene, "barrier");
  for (int32_t i = 0; i < scene.n; ++i)
    scene.u[i] = -0.7;
  abut_progress progress;
  assert_int_equal(membrane_run(context, &scene, &options, false, &progress),
                   ABUT_REASON_INFEASIBLE);
  assert_int_equal(progress.step, 0);
  /* Of 7 x 7 nodes the columns x = -0.75 .. 0.25 have psi > -0.7, and the
   * worst has psi = -0.2. */
  const char *text = abut_context_message(context);
  assert_non_null(strstr(text, "35 constraints"));
  assert_non_null(strstr(text, "-0.5"));
  membrane_destroy(&scene);
  assert_ok(abut_context_destroy(&context));
}

/* At the end p g = mu in every row of the barrier, and no less than that is
 * open; rows in contact are those of the discrete problem. */
static void
interior_methods_tell_where_they_are(void **unused)
{
  (void)unused;
  const char *const laws[] = {"barrier", "interior point"};
  abut_context *context = fixture_context();
  for (int k = 0; k < 2; ++k)
  {
    membrane scene = membrane_create(references[0].level, 1, 1);
    const abut_strategy_options options = membrane_options(&scene, laws[k]);
    abut_progress progress;
    assert_int_equal(membrane_run(context, &scene, &options, false, &progress),
                     ABUT_REASON_CONVERGED);
    assert_int_equal(progress.n_rows, scene.n);
    assert_int_equal(progress.n_active, references[0].active);
    assert_int_equal(progress.n_changes, 0);
    double penetration = 0, largest = 0;
    for (int32_t i = 0; i < scene.n; ++i)
    {
      const double gap = scene.u[i] - scene.psi[i];
      penetration = fmax(penetration, -gap);
      largest = fmax(largest, fabs(scene.pressure[i] * gap));
    }
    assert_true(progress.penetration == penetration);
    assert_true(progress.complementarity == largest);
    assert_true(largest <= 1.1e-8 * scene.load);
    membrane_destroy(&scene);
  }
  /* Before the end, from a start within the obstacle. */
  membrane scene = membrane_create(references[0].level, 1, 1);
  abut_strategy_options options = membrane_options(&scene, laws[1]);
  options.max_steps = 1;
  for (int32_t i = 0; i < scene.n; ++i)
    scene.u[i] = -0.5;
  abut_progress progress;
  assert_int_equal(membrane_run(context, &scene, &options, false, &progress),
                   ABUT_REASON_STEP_LIMIT);
  double penetration = 0;
  for (int32_t i = 0; i < scene.n; ++i)
    penetration = fmax(penetration, scene.psi[i] - scene.u[i]);
  assert_true(penetration > 0);
  assert_close(progress.penetration / penetration, 1, 1e-14);
  membrane_destroy(&scene);
  assert_ok(abut_context_destroy(&context));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(interior_methods_tell_where_they_are),
      cmocka_unit_test(plain_active_set_takes_the_steps_of_step_41),
      cmocka_unit_test(nested_active_set),
      cmocka_unit_test(final_solve_is_counted),
      cmocka_unit_test(active_set_sizes_fall),
      cmocka_unit_test(complementarity_does_not_matter),
      cmocka_unit_test(augmented_lagrangian),
      cmocka_unit_test(augmented_lagrangian_with_fixed_penalty),
      cmocka_unit_test(quadratic_penalty),
      cmocka_unit_test(interior_point),
      cmocka_unit_test(barrier),
      cmocka_unit_test(parameters_have_their_orders),
      cmocka_unit_test(units_divide_out),
      cmocka_unit_test(barrier_refuses_a_closed_start),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
