/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Elimination of pressures: numbers against the formulas, blocks against dense
 * elimination of the whole system. */
#include "base/dense_lu.h"
#include "fixture.h"

#include <string.h>

enum
{
  N_UNKNOWNS = 7,
  MAX_POINTS = 3,
  MAX_VECTOR = 9,
  MAX_BLOCK = 27,
  MAX_SYSTEM = N_UNKNOWNS + MAX_VECTOR
};

/* Points with their law, and stencils from unknowns to gaps: g = G u, forces
 * on the unknowns are F^T w p. */
typedef struct problem
{
  int n, m;
  uint8_t k[MAX_POINTS];
  double weight[MAX_POINTS], pressure[MAX_VECTOR], c[MAX_VECTOR];
  double a[MAX_BLOCK], b[MAX_BLOCK];
  double stiffness[N_UNKNOWNS][N_UNKNOWNS], residual[N_UNKNOWNS];
  double g[MAX_VECTOR][N_UNKNOWNS], f[MAX_VECTOR][N_UNKNOWNS];
} problem;

typedef struct condensed
{
  uint8_t held[MAX_VECTOR];
  double value[MAX_VECTOR], force[MAX_VECTOR], spring[MAX_BLOCK];
  double trial[MAX_BLOCK], test[MAX_BLOCK];
} condensed;

static double
between(uint64_t *seed, double low, double high)
{
  return low + (high - low) * fixture_random(seed);
}

static abut_condense_points
points_of(const problem *p)
{
  return (abut_condense_points){.struct_size = sizeof(abut_condense_points),
                                .n = p->n,
                                .n_components = p->k,
                                .weight = p->weight,
                                .pressure = p->pressure,
                                .residual = p->c,
                                .d_pressure = p->a,
                                .d_gap = p->b};
}

static abut_condensed
result_of(condensed *c)
{
  return (abut_condensed){.struct_size = sizeof(abut_condensed),
                          .held = c->held,
                          .value = c->value,
                          .force = c->force,
                          .spring = c->spring,
                          .trial = c->trial,
                          .test = c->test};
}

static void
numbers_are_todays_formulas(void **unused)
{
  (void)unused;
  enum
  {
    N = 400
  };
  double a[N], b[N], c[N], p[N], w[N], value[N], force[N], spring[N];
  double dg[N], dp[N];
  uint8_t held[N];
  uint64_t seed = 1;
  for (int i = 0; i < N; ++i)
  {
    a[i] = i % 3 == 0 ? 0 : between(&seed, 0.1, 3);
    b[i] = i % 3 == 1 ? 0 : between(&seed, 0.1, 3);
    c[i] = between(&seed, -1, 1);
    p[i] = between(&seed, -1, 1);
    w[i] = between(&seed, 0.1, 1);
    dg[i] = between(&seed, -1, 1);
    dp[i] = 17;
  }
  const abut_condense_points points = {.struct_size = sizeof(points),
                                       .n = N,
                                       .weight = w,
                                       .pressure = p,
                                       .residual = c,
                                       .d_pressure = a,
                                       .d_gap = b};
  const abut_condensed result = {.struct_size = sizeof(result),
                                 .held = held,
                                 .value = value,
                                 .force = force,
                                 .spring = spring};
  assert_ok(abut_condense(&points, &result));
  assert_ok(abut_condense_recover(&points, dg, dp));
  for (int i = 0; i < N; ++i)
    if (a[i] == 0)
    {
      assert_int_equal(held[i], 1);
      assert_true(value[i] == -c[i] / b[i]);
      assert_true(force[i] == 0 && spring[i] == 0 && dp[i] == 17);
    }
    else
    {
      assert_int_equal(held[i], 0);
      assert_true(value[i] == 0);
      assert_true(force[i] == w[i] * (p[i] - c[i] / a[i]));
      assert_true(spring[i] == w[i] * b[i] / a[i]);
      assert_true(dp[i] == -(c[i] + b[i] * dg[i]) / a[i]);
    }
}

/* Blocks without structure, some rows of A 0; none of them near singular. */
static problem
make_problem(uint64_t *seed, const uint8_t *k, int n, const uint8_t *held)
{
  problem result = {.n = n};
  int block = 0;
  for (int i = 0; i < n; ++i)
  {
    result.k[i] = k[i];
    result.weight[i] = between(seed, 0.3, 2);
    for (int r = 0; r < k[i]; ++r)
      for (int s = 0; s < k[i]; ++s, ++block)
      {
        const double size = r == s ? 3 : 1;
        result.a[block] =
            held[result.m + r] ? 0 : between(seed, size - 1, size);
        result.b[block] = between(seed, size - 1, size);
      }
    result.m += k[i];
  }
  for (int i = 0; i < result.m; ++i)
  {
    result.pressure[i] = between(seed, -1, 1);
    result.c[i] = between(seed, -1, 1);
    for (int j = 0; j < N_UNKNOWNS; ++j)
    {
      result.g[i][j] = between(seed, -1, 1);
      result.f[i][j] = result.g[i][j] + between(seed, -0.1, 0.1);
    }
  }
  for (int i = 0; i < N_UNKNOWNS; ++i)
  {
    result.residual[i] = between(seed, -1, 1);
    for (int j = 0; j < N_UNKNOWNS; ++j)
      result.stiffness[i][j] = between(seed, -0.2, 0.2) + (i == j ? 4 : 0);
  }
  return result;
}

/* du and dp of the whole system
 *     K du - F^T w dp = -R + F^T w p,   A dp + B G du = -c. */
static void
solve_whole(const problem *p, double *du, double *dp)
{
  const int n = N_UNKNOWNS + p->m;
  double matrix[MAX_SYSTEM * MAX_SYSTEM] = {0}, scale[MAX_SYSTEM];
  double right[MAX_SYSTEM];
  int32_t pivot[MAX_SYSTEM];
  for (int i = 0; i < N_UNKNOWNS; ++i)
  {
    right[i] = -p->residual[i];
    for (int j = 0; j < N_UNKNOWNS; ++j)
      matrix[i * n + j] = p->stiffness[i][j];
  }
  int vector = 0, block = 0;
  for (int i = 0; i < p->n; ++i)
  {
    for (int r = 0; r < p->k[i]; ++r)
    {
      const int line = N_UNKNOWNS + vector + r;
      right[line] = -p->c[vector + r];
      for (int j = 0; j < N_UNKNOWNS; ++j)
      {
        matrix[j * n + line] = -p->weight[i] * p->f[vector + r][j];
        right[j] +=
            p->weight[i] * p->f[vector + r][j] * p->pressure[vector + r];
      }
      for (int s = 0; s < p->k[i]; ++s, ++block)
      {
        matrix[line * n + N_UNKNOWNS + vector + s] = p->a[block];
        for (int j = 0; j < N_UNKNOWNS; ++j)
          matrix[line * n + j] += p->b[block] * p->g[vector + s][j];
      }
    }
    vector += p->k[i];
  }
  assert_true(abut_dense_lu_factorise(n, matrix, pivot, scale));
  abut_dense_lu_solve(n, matrix, pivot, scale, right);
  memcpy(du, right, N_UNKNOWNS * sizeof(*du));
  memcpy(dp, right + N_UNKNOWNS, (size_t)p->m * sizeof(*dp));
}

/* The same with the answers of abut_condense(): unknowns are du and the
 * pressures L of held components,
 *     (K + F^T Z G) du - F^T test^T w L = -R + F^T f,   trial G du = value. */
static void
solve_condensed(const problem *p, const condensed *c, double *du, double *dp)
{
  int multiplier[MAX_VECTOR], n = N_UNKNOWNS;
  for (int i = 0; i < p->m; ++i)
    multiplier[i] = c->held[i] ? n++ : -1;
  double matrix[MAX_SYSTEM * MAX_SYSTEM] = {0}, scale[MAX_SYSTEM];
  double right[MAX_SYSTEM];
  int32_t pivot[MAX_SYSTEM];
  for (int i = 0; i < N_UNKNOWNS; ++i)
  {
    right[i] = -p->residual[i];
    for (int j = 0; j < N_UNKNOWNS; ++j)
      matrix[i * n + j] = p->stiffness[i][j];
  }
  int vector = 0, block = 0;
  for (int i = 0; i < p->n; ++i)
  {
    for (int r = 0; r < p->k[i]; ++r)
    {
      const int line = multiplier[vector + r];
      if (line >= 0)
        right[line] = c->value[vector + r];
      for (int j = 0; j < N_UNKNOWNS; ++j)
        right[j] += p->f[vector + r][j] * c->force[vector + r];
      for (int s = 0; s < p->k[i]; ++s, ++block)
        for (int j = 0; j < N_UNKNOWNS; ++j)
        {
          for (int l = 0; l < N_UNKNOWNS; ++l)
            matrix[j * n + l] +=
                p->f[vector + r][j] * c->spring[block] * p->g[vector + s][l];
          if (line < 0)
            continue;
          matrix[line * n + j] += c->trial[block] * p->g[vector + s][j];
          matrix[j * n + line] -=
              p->weight[i] * c->test[block] * p->f[vector + s][j];
        }
    }
    vector += p->k[i];
  }
  assert_true(abut_dense_lu_factorise(n, matrix, pivot, scale));
  abut_dense_lu_solve(n, matrix, pivot, scale, right);
  memcpy(du, right, N_UNKNOWNS * sizeof(*du));
  double dg[MAX_VECTOR] = {0};
  for (int i = 0; i < p->m; ++i)
  {
    for (int j = 0; j < N_UNKNOWNS; ++j)
      dg[i] += p->g[i][j] * du[j];
    dp[i] = c->held[i] ? right[multiplier[i]] - p->pressure[i] : NAN;
  }
  const abut_condense_points points = points_of(p);
  assert_ok(abut_condense_recover(&points, dg, dp));
}

static void
compare(const problem *p, const uint8_t *held)
{
  condensed c;
  const abut_condense_points points = points_of(p);
  const abut_condensed result = result_of(&c);
  assert_ok(abut_condense(&points, &result));
  double du[2][N_UNKNOWNS], dp[2][MAX_VECTOR];
  solve_whole(p, du[0], dp[0]);
  solve_condensed(p, &c, du[1], dp[1]);
  for (int i = 0; i < p->m; ++i)
  {
    assert_int_equal(c.held[i], held[i]);
    assert_close(dp[1][i], dp[0][i], 1e-9);
  }
  for (int i = 0; i < N_UNKNOWNS; ++i)
    assert_close(du[1][i], du[0][i], 1e-9);
}

/* All mixtures of held and sprung components of one point. */
static void
all_mixtures(void **unused)
{
  (void)unused;
  uint64_t seed = 5;
  for (int repetition = 0; repetition < 20; ++repetition)
    for (uint8_t k = 1; k <= 3; ++k)
      for (int mixture = 0; mixture < 1 << k; ++mixture)
      {
        uint8_t held[3];
        for (int r = 0; r < k; ++r)
          held[r] = (mixture >> r) & 1;
        const problem p = make_problem(&seed, &k, 1, held);
        compare(&p, held);
      }
}

/* Points of different size in one call: a tie, a slipping point, an open one
 * of one component. */
static void
points_of_all_sizes(void **unused)
{
  (void)unused;
  const uint8_t k[3] = {2, 1, 3}, held[6] = {1, 1, 0, 1, 0, 0};
  uint64_t seed = 11;
  for (int repetition = 0; repetition < 20; ++repetition)
  {
    const problem p = make_problem(&seed, k, 3, held);
    compare(&p, held);
  }
}

/* Coulomb slip in the plane under a hard normal law: the test direction of the
 * normal leans by mu in the direction e of the traction, and as tau = mu p e,
 * whatever the slip, no spring is left. */
static void
slip_leans_the_test_direction(void **unused)
{
  (void)unused;
  const double mu = 0.3, e = -1, gap = -0.02, p = 2, tau = -0.5;
  const double a[4] = {0, 0, -mu * e, 1}, b[4] = {1, 0, 0, 0};
  const double pressure[2] = {p, tau}, c[2] = {gap, tau - mu * p * e};
  const uint8_t k = 2;
  const abut_condense_points points = {.struct_size = sizeof(points),
                                       .n = 1,
                                       .n_components = &k,
                                       .pressure = pressure,
                                       .residual = c,
                                       .d_pressure = a,
                                       .d_gap = b};
  condensed out;
  const abut_condensed result = result_of(&out);
  assert_ok(abut_condense(&points, &result));
  assert_int_equal(out.held[0], 1);
  assert_int_equal(out.held[1], 0);
  assert_close(out.value[0], -gap, 1e-15);
  assert_close(out.trial[0], 1, 1e-15);
  assert_close(out.trial[1], 0, 1e-15);
  assert_close(out.test[0], 1, 1e-15);
  assert_close(out.test[1], mu * e, 1e-15);
  for (int i = 0; i < 4; ++i)
    assert_true(out.spring[i] == 0);
  assert_close(out.force[1], 0, 1e-15);
  /* The pressure grows to 5: the traction follows. */
  const double dg[2] = {-gap, 0.1};
  double dp[2] = {3, NAN};
  assert_ok(abut_condense_recover(&points, dg, dp));
  assert_close(tau + dp[1], mu * 5 * e, 1e-15);
}

static void
refusals(void **unused)
{
  (void)unused;
  double a[4] = {0}, b[4] = {0}, c[2] = {1, 1}, p[2] = {0};
  uint8_t k = 2;
  abut_condense_points points = {.struct_size = sizeof(points),
                                 .n = 1,
                                 .n_components = &k,
                                 .pressure = p,
                                 .residual = c,
                                 .d_pressure = a,
                                 .d_gap = b};
  condensed out;
  abut_condensed result = result_of(&out);
  double dp[2] = {0};
  /* Neither pressure nor gap is determined. */
  assert_int_equal(abut_condense(&points, &result), ABUT_UNSUPPORTED);
  k = 1;
  assert_int_equal(abut_condense(&points, &result), ABUT_UNSUPPORTED);
  /* A_SS is singular. */
  k = 2;
  a[0] = a[1] = a[2] = a[3] = 1;
  assert_int_equal(abut_condense(&points, &result), ABUT_UNSUPPORTED);
  assert_int_equal(abut_condense_recover(&points, c, dp), ABUT_UNSUPPORTED);
  k = 1;
  c[0] = NAN;
  assert_int_equal(abut_condense(&points, &result), ABUT_NOT_FINITE);
  assert_int_equal(abut_condense_recover(&points, p, dp), ABUT_NOT_FINITE);
  k = 4;
  assert_int_equal(abut_condense(&points, &result), ABUT_INVALID_ARGUMENT);
  k = 0;
  assert_int_equal(abut_condense(&points, &result), ABUT_INVALID_ARGUMENT);
  k = 1;
  result.spring = NULL;
  assert_int_equal(abut_condense(&points, &result), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_condense(NULL, &result), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_condense(&points, NULL), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_condense_recover(&points, NULL, dp),
                   ABUT_INVALID_ARGUMENT);
  points.d_gap = NULL;
  assert_int_equal(abut_condense_recover(&points, p, dp),
                   ABUT_INVALID_ARGUMENT);
  points.n = 0;
  assert_ok(abut_condense(&points, &result));
}

static void
nothing_beyond_the_points_is_read_or_written(void **unused)
{
  (void)unused;
  /* Three points of which two are given; p = 2 g and a held one. */
  const double p[3] = {0, 0, NAN}, c[3] = {0, 1, NAN}, a[3] = {1, 0, NAN},
               b[3] = {-2, 1, NAN}, w[3] = {1, 1, NAN}, dg[3] = {3, 0, NAN};
  double value[3] = {0, 0, NAN}, force[3] = {0, 0, NAN},
         spring[3] = {0, 0, NAN}, dp[3] = {0, 0, NAN};
  uint8_t held[3] = {7, 7, 7};
  const abut_condense_points points = {.struct_size = sizeof(points),
                                       .n = 2,
                                       .weight = w,
                                       .pressure = p,
                                       .residual = c,
                                       .d_pressure = a,
                                       .d_gap = b};
  const abut_condensed result = {.struct_size = sizeof(result),
                                 .held = held,
                                 .value = value,
                                 .force = force,
                                 .spring = spring};
  assert_ok(abut_condense(&points, &result));
  assert_ok(abut_condense_recover(&points, dg, dp));
  assert_int_equal(held[2], 7);
  assert_true(held[0] == 0 && held[1] == 1 && dp[0] == 6 && dp[1] == 0);
  assert_true(spring[0] == -2 && value[1] == -1);
  assert_true(isnan(value[2]) && isnan(force[2]) && isnan(spring[2])
              && isnan(dp[2]));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_beyond_the_points_is_read_or_written),
      cmocka_unit_test(numbers_are_todays_formulas),
      cmocka_unit_test(all_mixtures),
      cmocka_unit_test(points_of_all_sizes),
      cmocka_unit_test(slip_leans_the_test_direction),
      cmocka_unit_test(refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
