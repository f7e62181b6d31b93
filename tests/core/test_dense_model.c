/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The dense model: elimination, floating bodies, arguments. */
#include "base/dense_lu.h"
#include "fixture.h"

#include <string.h>

enum
{
  N = 12
};

static void
elimination_inverts(void **unused)
{
  (void)unused;
  uint64_t seed = 6;
  for (int round = 0; round < 100; ++round)
  {
    double a[N * N], kept[N * N], x[N], b[N], scale[N];
    int32_t pivot[N];
    for (int i = 0; i < N * N; ++i)
      kept[i] = 2 * fixture_random(&seed) - 1;
    /* Zeros on the diagonal and rows of very different units. */
    for (int i = 0; i < N; ++i)
    {
      kept[i * N + i] = 0;
      for (int j = 0; j < N; ++j)
        kept[i * N + j] *= pow(10, i - 6);
    }
    memcpy(a, kept, sizeof(a));
    for (int i = 0; i < N; ++i)
      x[i] = 2 * fixture_random(&seed) - 1;
    for (int i = 0; i < N; ++i)
    {
      b[i] = 0;
      for (int j = 0; j < N; ++j)
        b[i] += kept[i * N + j] * x[j];
    }
    assert_true(abut_dense_lu_factorise(N, a, pivot, scale));
    abut_dense_lu_solve(N, a, pivot, scale, b);
    for (int i = 0; i < N; ++i)
      assert_close(b[i], x[i], 1e-11);
  }
}

static void
elimination_finds_singular_matrices(void **unused)
{
  (void)unused;
  double a[] = {1, 2, 2, 4}, zero_row[] = {0, 0, 1, 1}, scale[2];
  int32_t pivot[2];
  assert_false(abut_dense_lu_factorise(2, a, pivot, scale));
  assert_false(abut_dense_lu_factorise(2, zero_row, pivot, scale));
}

/* Two masses joined by a spring and pushed to the right by 1 each; only the
 * wall on the right at distance 1/4 of the second holds them. */
typedef struct floating
{
  abut_context *context;
  abut_points *points;
  abut_dense_model model;
} floating;

static const double spring[] = {1, -1, -1, 1}, push[] = {1, 1};

static floating
open_floating(void)
{
  floating f = {.context = fixture_context()};
  const int32_t node = 1;
  const double minus_one = -1;
  assert_ok(abut_points_create(f.context, 1, &f.points));
  assert_ok(abut_points_append_scalar(
      f.points, 0, 0.5, 0.25, ABUT_POINT_CONTACT, 1, &node, &minus_one));
  const abut_dense_model model = {sizeof(model), 2,        spring,
                                  push,          f.points, NULL};
  f.model = model;
  return f;
}

static void
close_floating(floating *f)
{
  assert_ok(abut_points_destroy(&f->points));
  assert_int_equal(abut_context_memory(f->context).live_bytes, 0);
  assert_ok(abut_context_destroy(&f->context));
}

static void
contact_holds_a_floating_body(void **unused)
{
  (void)unused;
  const char *laws[] = {"lagrange", "augmented lagrangian", "interior point"};
  for (int law = 0; law < 3; ++law)
  {
    floating f = open_floating();
    abut_strategy_options options = exact_options();
    options.law = abut_law_find(laws[law]);
    double u[2] = {0, 0}, p = 0;
    uint8_t state = ABUT_STATE_CLOSED;
    abut_reason reason;
    abut_progress progress;
    assert_ok(abut_dense_model_solve(f.context, &f.model, &options, u, &p,
                                     &state, NULL, NULL, &progress, &reason));
    assert_int_equal(reason, ABUT_REASON_CONVERGED);
    /* The wall carries 2 = w p; the spring carries 1. */
    assert_close(p, 2 / 0.5, 1e-5);
    assert_close(u[1], 0.25, 2e-6);
    assert_close(u[0], 1.25, 2e-6);
    assert_int_equal(state, ABUT_STATE_CLOSED);
    assert_int_equal(progress.n_active, 1);
    close_floating(&f);
  }
}

/* The same with all forces in another unit. */
static void
units_of_force_do_not_matter(void **unused)
{
  (void)unused;
  for (int power = -18; power <= 18; power += 4)
  {
    floating f = open_floating();
    double stiffness[4], force[2], u[2] = {0, 0}, p = 0;
    const double unit = pow(10, power);
    for (int i = 0; i < 4; ++i)
      stiffness[i] = unit * spring[i];
    for (int i = 0; i < 2; ++i)
      force[i] = unit * push[i];
    f.model.stiffness = stiffness;
    f.model.force = force;
    abut_strategy_options options = exact_options();
    options.pressure_scale = unit;
    uint8_t state = ABUT_STATE_CLOSED;
    abut_reason reason;
    abut_progress progress;
    assert_ok(abut_dense_model_solve(f.context, &f.model, &options, u, &p,
                                     &state, NULL, NULL, &progress, &reason));
    assert_int_equal(reason, ABUT_REASON_CONVERGED);
    assert_close(p / unit, 4, 1e-9);
    assert_close(u[1], 0.25, 1e-9);
    assert_close(u[0], 1.25, 1e-9);
    close_floating(&f);
  }
}

static void
a_body_without_support_is_reported(void **unused)
{
  (void)unused;
  floating f = open_floating();
  const abut_strategy_options options = exact_options();
  double u[2] = {0, 0}, p = 0;
  assert_int_equal(abut_dense_model_solve(f.context, &f.model, &options, u, &p,
                                          NULL, NULL, NULL, NULL, NULL),
                   ABUT_SINGULAR);
  assert_non_null(strstr(abut_context_message(f.context), "singular"));
  close_floating(&f);
}

static void
a_warm_start_is_kept(void **unused)
{
  (void)unused;
  floating f = open_floating();
  const abut_strategy_options options = exact_options();
  double u[2] = {1.25, 0.25}, p = 4;
  uint8_t state = ABUT_STATE_CLOSED;
  abut_reason reason;
  abut_progress progress;
  assert_ok(abut_dense_model_solve(f.context, &f.model, &options, u, &p, &state,
                                   NULL, NULL, &progress, &reason));
  assert_int_equal(progress.step, 1);
  assert_close(u[0], 1.25, 1e-15);
  assert_close(p, 4, 1e-15);
  close_floating(&f);
}

static void
arguments_are_checked(void **unused)
{
  (void)unused;
  floating f = open_floating();
  const abut_strategy_options options = exact_options();
  const double nan_force[] = {1, NAN};
  double u[2] = {0, 0}, p = 0;
  uint8_t state = 1;
#define SOLVE(context, model, options, u, p)                                   \
  abut_dense_model_solve(context, model, options, u, p, &state, NULL, NULL,    \
                         NULL, NULL)
  assert_int_equal(SOLVE(NULL, &f.model, &options, u, &p),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(SOLVE(f.context, NULL, &options, u, &p),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(SOLVE(f.context, &f.model, NULL, u, &p),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(SOLVE(f.context, &f.model, &options, NULL, &p),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(SOLVE(f.context, &f.model, &options, u, NULL),
                   ABUT_INVALID_ARGUMENT);
  abut_dense_model model = f.model;
  model.struct_size = 0;
  assert_int_equal(SOLVE(f.context, &model, &options, u, &p),
                   ABUT_INVALID_ARGUMENT);
  model = f.model;
  model.n = 0;
  assert_int_equal(SOLVE(f.context, &model, &options, u, &p),
                   ABUT_INVALID_ARGUMENT);
  model.n = 1000000;
  assert_int_equal(SOLVE(f.context, &model, &options, u, &p),
                   ABUT_INVALID_ARGUMENT);
  /* The point's node is 1. */
  model.n = 1;
  assert_int_equal(SOLVE(f.context, &model, &options, u, &p),
                   ABUT_INVALID_ARGUMENT);
  model = f.model;
  model.force = nan_force;
  assert_int_equal(SOLVE(f.context, &model, &options, u, &p), ABUT_NOT_FINITE);
  model.force = NULL;
  assert_int_equal(SOLVE(f.context, &model, &options, u, &p),
                   ABUT_INVALID_ARGUMENT);
  model = f.model;
  model.points = NULL;
  assert_int_equal(SOLVE(f.context, &model, &options, u, &p),
                   ABUT_INVALID_ARGUMENT);
  u[0] = NAN;
  assert_int_equal(SOLVE(f.context, &f.model, &options, u, &p),
                   ABUT_NOT_FINITE);
#undef SOLVE
  close_floating(&f);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(elimination_inverts),
      cmocka_unit_test(elimination_finds_singular_matrices),
      cmocka_unit_test(contact_holds_a_floating_body),
      cmocka_unit_test(units_of_force_do_not_matter),
      cmocka_unit_test(a_body_without_support_is_reported),
      cmocka_unit_test(a_warm_start_is_kept),
      cmocka_unit_test(arguments_are_checked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
