/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Gradient and Hessian of the gap against finite differences; balance. */
#include "facets.h"
#include <abut/projection.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum
{
  n_cases = 1000,
  max_unknowns = 30
};

static void
assert_near(double a, double b, double tolerance)
{
  if (!(fabs(a - b) <= tolerance))
    fail_msg("%.17g != %.17g within %g", a, b, tolerance);
}

/* A facet and a point over its inside, z = (x, nodes). */
static void
random_case(uint64_t *seed, abut_facet_kind kind, double *z)
{
  const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
  const double bend = n > abut_facet_n_corners(kind) ? 0.06 : 0.2;
  double *nodes = z + dim, xi[2], normal[3];
  random_facet(seed, kind, bend, 1., nodes);
  const int triangle = abut_facet_n_corners(kind) == 3;
  xi[0] = triangle ? uniform(seed, 0.1, 0.5) : uniform(seed, -0.8, 0.8);
  xi[1] =
      triangle ? uniform(seed, 0.1, 0.85 - xi[0]) : uniform(seed, -0.8, 0.8);
  abut_facet_point(kind, nodes, xi, z, normal);
  const double gap = uniform(seed, -0.3, 0.3);
  for (int d = 0; d < dim; ++d)
    z[d] += gap * normal[d];
}

static double
evaluate(abut_facet_kind kind, const double *z, double *gradient,
         double *hessian)
{
  abut_projection p;
  const int dim = abut_facet_dimension(kind);
  assert_int_equal(abut_facet_project(kind, z + dim, z, &p), ABUT_SUCCESS);
  assert_true(p.inside && p.converged);
  assert_int_equal(
      abut_facet_gap_derivatives(kind, z + dim, &p, gradient, hessian),
      ABUT_SUCCESS);
  return p.gap;
}

/* Central differences of gap and gradient. */
static void
test_finite_differences(void **state)
{
  (void)state;
  uint64_t seed = 23;
  const double h = 1e-4;
  double worst[2] = {0., 0.};
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < n_cases; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int n = abut_facet_dimension(kind) * (1 + abut_facet_n_nodes(kind));
      double z[max_unknowns], g[max_unknowns], f[max_unknowns],
          H[max_unknowns * max_unknowns];
      random_case(&seed, kind, z);
      evaluate(kind, z, g, H);
      for (int u = 0; u < n; ++u)
      {
        double slope = 0., row[max_unknowns] = {0.};
        const double middle = z[u];
        for (int side = -1; side <= 1; side += 2)
        {
          z[u] = middle + side * h;
          slope += side / (2. * h) * evaluate(kind, z, f, NULL);
          for (int v = 0; v < n; ++v)
            row[v] += side / (2. * h) * f[v];
        }
        z[u] = middle;
        worst[0] = fmax(worst[0], fabs(slope - g[u]));
        for (int v = 0; v < n; ++v)
        {
          assert_true(H[u * n + v] == H[v * n + u]);
          worst[1] = fmax(worst[1], fabs(row[v] - H[u * n + v]));
        }
      }
    }
  assert_true(worst[0] < 1e-6);
  assert_true(worst[1] < 1e-6);
}

/* Moving or turning point and facet together leaves the gap: forces -p dg on
 * point and nodes have no sum and no moment. */
static void
test_balance(void **state)
{
  (void)state;
  uint64_t seed = 29;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < n_cases; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
      double z[max_unknowns], g[max_unknowns], H[max_unknowns * max_unknowns],
          force[3] = {0.}, moment[3] = {0.};
      random_case(&seed, kind, z);
      evaluate(kind, z, g, H);
      for (int a = 0; a <= n; ++a)
      {
        double x[3] = {0.}, f[3] = {0.};
        for (int d = 0; d < dim; ++d)
        {
          x[d] = z[dim * a + d];
          f[d] = g[dim * a + d];
          force[d] += f[d];
        }
        for (int d = 0; d < 3; ++d)
          moment[d] +=
              x[(d + 1) % 3] * f[(d + 2) % 3] - x[(d + 2) % 3] * f[(d + 1) % 3];
      }
      for (int d = 0; d < 3; ++d)
      {
        assert_near(force[d], 0., 1e-14);
        assert_near(moment[d], 0., 1e-12);
      }
      /* A translation changes no gradient either. */
      const int m = dim * (1 + n);
      for (int u = 0; u < m; ++u)
        for (int d = 0; d < dim; ++d)
        {
          double sum = 0.;
          for (int a = 0; a <= n; ++a)
            sum += H[u * m + dim * a + d];
          assert_near(sum, 0., 1e-12);
        }
    }
}

/* A segment of length 4 whose ends move by -v and v normal to it, and a point
 * that moves by d along it, both from the middle: the segment passes v d / 2
 * above its old place, and the gap below it grows by as much. */
static void
test_segment(void **state)
{
  (void)state;
  const double z[] = {0., -0.5, -2., 0., 2., 0.};
  double g[6], H[36];
  assert_near(evaluate(ABUT_FACET_LINE2, z, g, H), 0.5, 1e-15);
  /* n = (0, -1): gradient of x and half of it for each end. */
  const double expected[] = {0., -1., 0., 0.5, 0., 0.5};
  for (int i = 0; i < 6; ++i)
    assert_near(g[i], expected[i], 1e-15);
  assert_near(H[0], 0., 1e-15);
  assert_near(H[0 * 6 + 5] - H[0 * 6 + 3], 0.5, 1e-15);
}

static void
test_refusal(void **state)
{
  (void)state;
  const double nodes[] = {-1., 0., 1., 0.}, x[] = {3., 1.};
  double g[6];
  abut_projection p;
  abut_facet_project(ABUT_FACET_LINE2, nodes, x, &p);
  assert_int_equal(
      abut_facet_gap_derivatives(ABUT_FACET_LINE2, nodes, &p, g, NULL),
      ABUT_UNSUPPORTED);
  assert_int_equal(
      abut_facet_gap_derivatives(ABUT_FACET_LINE2, NULL, &p, g, NULL),
      ABUT_INVALID_ARGUMENT);
  /* The centre of curvature of y = x^2 at its vertex. */
  const double parabola[] = {-1., 1., 1., 1., 0., 0.}, centre[] = {0., 0.5};
  double h[64], full[8];
  abut_facet_project(ABUT_FACET_LINE3, parabola, centre, &p);
  p.local[0] = 0.;
  p.gap = -0.5;
  assert_int_equal(
      abut_facet_gap_derivatives(ABUT_FACET_LINE3, parabola, &p, full, h),
      ABUT_UNSUPPORTED);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_finite_differences), cmocka_unit_test(test_balance),
      cmocka_unit_test(test_segment), cmocka_unit_test(test_refusal)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
