/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The active set method against enumeration of all sets, and its protection
 * against cycling. */
#include "fixture.h"
#include "strategy/active_set.h"

#include <string.h>

enum
{
  MAX_N = 8
};

/* min 1/2 x'Kx - f'x with rows g_i = gap_i + sign x_i >= 0. */
typedef struct problem
{
  int n;
  double k[MAX_N * MAX_N], f[MAX_N], gap[MAX_N], sign;
} problem;

typedef struct answer
{
  double x[MAX_N], p[MAX_N];
  uint8_t state[MAX_N];
  abut_progress progress;
  abut_reason reason;
} answer;

/* Solve from the given set; state is NULL for the one that the start calls
 * for. */
static answer
solve(const problem *q, const abut_strategy_options *options,
      const uint8_t *state)
{
  abut_context *context = fixture_context();
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 1, &points));
  for (int i = 0; i < q->n; ++i)
  {
    const int32_t node = i;
    assert_ok(abut_points_append_scalar(
        points, i, 1, q->gap[i], ABUT_POINT_CONTACT, 1, &node, &q->sign));
  }
  const abut_dense_model model = {sizeof(model), q->n, q->k, q->f, points};
  answer out = {0};
  if (state != NULL)
    memcpy(out.state, state, (size_t)q->n);
  assert_ok(abut_dense_model_solve(context, &model, options, out.x, out.p,
                                   state != NULL ? out.state : NULL, NULL, NULL,
                                   &out.progress, &out.reason));
  assert_ok(abut_points_destroy(&points));
  assert_ok(abut_context_destroy(&context));
  return out;
}

/* Solve A x = b of size n by elimination without pivoting, which positive
 * definite matrices allow. */
static void
eliminate(int n, double *a, double *b)
{
  for (int k = 0; k < n; ++k)
    for (int i = k + 1; i < n; ++i)
    {
      const double factor = a[i * n + k] / a[k * n + k];
      for (int j = k; j < n; ++j)
        a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  for (int i = n - 1; i >= 0; --i)
  {
    for (int j = i + 1; j < n; ++j)
      b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
  }
}

/* Solve with the set of rows that mask has, and return the worst violation of
 * p >= 0 and g >= 0. */
static double
try_set(const problem *q, unsigned mask, double *x, double *p)
{
  const int n = q->n;
  double a[MAX_N * MAX_N], b[MAX_N], worst = 0;
  for (int i = 0; i < n; ++i)
  {
    const bool closed = (mask >> i) & 1;
    b[i] = closed ? -q->gap[i] / q->sign : q->f[i];
    for (int j = 0; j < n; ++j)
      a[i * n + j] = closed ? i == j : q->k[i * n + j];
  }
  /* Closed unknowns are known: take them out of the other equations to keep
   * the matrix symmetric and definite. */
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (((mask >> j) & 1) != 0 && ((mask >> i) & 1) == 0)
      {
        b[i] += a[i * n + j] * q->gap[j] / q->sign;
        a[i * n + j] = 0;
      }
  eliminate(n, a, b);
  for (int i = 0; i < n; ++i)
  {
    double r = -q->f[i];
    x[i] = b[i];
    for (int j = 0; j < n; ++j)
      r += q->k[i * n + j] * b[j];
    p[i] = ((mask >> i) & 1) != 0 ? r / q->sign : 0;
    worst = fmax(worst, fmax(-p[i], -(q->gap[i] + q->sign * x[i])));
  }
  return worst;
}

/* The only solution, by trying all sets. */
static void
enumerate(const problem *q, double *x, double *p)
{
  int n_solutions = 0;
  for (unsigned mask = 0; mask < 1u << q->n; ++mask)
  {
    double y[MAX_N], r[MAX_N];
    if (try_set(q, mask, y, r) > 1e-12)
      continue;
    n_solutions += 1;
    memcpy(x, y, sizeof(y));
    memcpy(p, r, sizeof(r));
  }
  assert_int_equal(n_solutions, 1);
}

static void
compare(const problem *q, const answer *out)
{
  double x[MAX_N], p[MAX_N];
  enumerate(q, x, p);
  assert_int_equal(out->reason, ABUT_REASON_CONVERGED);
  for (int i = 0; i < q->n; ++i)
  {
    assert_close(out->x[i], x[i], 1e-10);
    assert_close(out->p[i], p[i], 1e-10);
  }
}

/* A positive definite example on which flipping all rows at once runs through
 * {2}, {1,2,3}, {3} for ever: min 1/2 x'Hx - f'x, x <= 0. */
static void
cycling_example_ends_from_all_starts(void **unused)
{
  (void)unused;
  const problem q = {.n = 3,
                     .k = {4, 5, -5, 5, 9, -5, -5, -5, 7},
                     .f = {-2, -1, 3},
                     .gap = {0, 0, 0},
                     .sign = -1};
  const abut_strategy_options options = exact_options();
  int n_cycles = 0;
  for (unsigned start = 0; start < 8; ++start)
  {
    const uint8_t state[3] = {start & 1, (start >> 1) & 1, (start >> 2) & 1};
    const answer out = solve(&q, &options, state);
    compare(&q, &out);
    assert_true(out.progress.step <= 13);
    if (out.progress.cycle_length > 0)
    {
      assert_int_equal(out.progress.cycle_length, 3);
      assert_true(out.progress.fallback_steps > 0);
      n_cycles += 1;
    }
  }
  /* It does cycle without the protection, from six starts. */
  assert_int_equal(n_cycles, 6);
}

/* K = A'A + small I and data that close about half of the rows. */
static problem
random_problem(uint64_t *seed)
{
  problem q = {.n = 2 + (int)(fixture_random(seed) * (MAX_N - 1)), .sign = -1};
  double a[MAX_N * MAX_N];
  for (int i = 0; i < q.n * q.n; ++i)
    a[i] = 2 * fixture_random(seed) - 1;
  for (int i = 0; i < q.n; ++i)
  {
    for (int j = 0; j < q.n; ++j)
    {
      q.k[i * q.n + j] = i == j ? 0.05 : 0;
      for (int l = 0; l < q.n; ++l)
        q.k[i * q.n + j] += a[l * q.n + i] * a[l * q.n + j];
    }
    q.f[i] = 2 * fixture_random(seed) - 1;
    q.gap[i] = fixture_random(seed) - 0.5;
  }
  return q;
}

static void
random_problems_agree_with_enumeration(void **unused)
{
  (void)unused;
  uint64_t seed = 2024;
  const abut_strategy_options options = exact_options();
  int64_t n_closed = 0, n_rows = 0;
  for (int i = 0; i < 500; ++i)
  {
    const problem q = random_problem(&seed);
    uint8_t state[MAX_N];
    for (int k = 0; k < q.n; ++k)
      state[k] = fixture_random(&seed) < 0.5;
    const answer out = solve(&q, &options, i % 2 == 0 ? state : NULL);
    compare(&q, &out);
    n_closed += out.progress.n_active;
    n_rows += q.n;
  }
  assert_true(n_closed > n_rows / 5 && n_closed < n_rows * 4 / 5);
}

static void
other_laws_agree_with_enumeration(void **unused)
{
  (void)unused;
  uint64_t seed = 77;
  for (int i = 0; i < 100; ++i)
  {
    problem q = random_problem(&seed);
    double x[MAX_N], p[MAX_N];
    enumerate(&q, x, p);
    const char *names[] = {"augmented lagrangian", "interior point",
                           "quadratic penalty"};
    for (int law = 0; law < 3; ++law)
    {
      abut_strategy_options options = exact_options();
      options.law = abut_law_find(names[law]);
      options.gap_tolerance = 1e-8;
      options.pressure_tolerance = 1e-6;
      options.penalty_cap = 1e10;
      options.barrier_end = 1e-14;
      const answer out = solve(&q, &options, NULL);
      assert_int_equal(out.reason, ABUT_REASON_CONVERGED);
      /* The gap tolerance times the condition, at most about 1e3 here. */
      for (int k = 0; k < q.n; ++k)
        assert_close(out.x[k], x[k], 1e-4);
    }
  }
}

/* Rows with p = g = 0 may flicker, but must not keep the method busy. */
static void
rows_without_gap_and_pressure_end(void **unused)
{
  (void)unused;
  uint64_t seed = 8;
  const abut_strategy_options options = exact_options();
  for (int i = 0; i < 100; ++i)
  {
    problem q = random_problem(&seed);
    /* The free solution touches every obstacle without pressure. */
    double x[MAX_N], a[MAX_N * MAX_N];
    memcpy(a, q.k, sizeof(a));
    memcpy(x, q.f, sizeof(x));
    eliminate(q.n, a, x);
    memcpy(q.gap, x, sizeof(x));
    uint8_t state[MAX_N];
    for (int k = 0; k < q.n; ++k)
      state[k] = fixture_random(&seed) < 0.5;
    const answer out = solve(&q, &options, state);
    assert_int_equal(out.reason, ABUT_REASON_CONVERGED);
    assert_true(out.progress.step <= 20);
    for (int k = 0; k < q.n; ++k)
      assert_close(out.x[k], x[k], 1e-9);
  }
}

static void
signatures_tell_sets_apart(void **unused)
{
  (void)unused;
  static double all[1 << 10][ABUT_SET_PARTS];
  for (int mask = 0; mask < 1 << 10; ++mask)
    for (int i = 9; i >= 0; --i)
      if ((mask >> i) & 1)
        abut_active_set_sign(1000003 * i, all[mask]);
  for (int mask = 0; mask < 1 << 10; ++mask)
  {
    double other_order[ABUT_SET_PARTS] = {0};
    for (int i = 0; i < 10; ++i)
      if ((mask >> i) & 1)
        abut_active_set_sign(1000003 * i, other_order);
    assert_memory_equal(other_order, all[mask], sizeof(other_order));
    for (int less = 0; less < mask; ++less)
      assert_memory_not_equal(all[less], all[mask], sizeof(all[0]));
  }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cycling_example_ends_from_all_starts),
      cmocka_unit_test(random_problems_agree_with_enumeration),
      cmocka_unit_test(other_laws_agree_with_enumeration),
      cmocka_unit_test(rows_without_gap_and_pressure_end),
      cmocka_unit_test(signatures_tell_sets_apart),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
