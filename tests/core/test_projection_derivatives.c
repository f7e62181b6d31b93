/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Gradient and Hessian of the gap against finite differences; balance. */
#include "facets.h"
#include <abut/projection.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
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

/* Which edges a nearest point is on: bits, 0 inside. */
static int
edges_of(abut_facet_kind kind, const abut_projection *p)
{
  const double tiny = 1e-12, a = p->local[0], b = p->local[1];
  if (p->inside)
    return 0;
  if (abut_facet_n_corners(kind) == 3)
    return (a <= tiny) + 2 * (b <= tiny) + 4 * (1. - a - b <= tiny);
  const int first = 1. - fabs(a) <= tiny ? (a > 0. ? 1 : 2) : 0,
            second = 1. - fabs(b) <= tiny ? (b > 0. ? 4 : 8) : 0;
  return abut_facet_dimension(kind) == 2 ? first : first + second;
}

static int
distance_of(abut_facet_kind kind, const double *z, double side, double *value,
            double *gradient, double *hessian)
{
  abut_projection p;
  const int dim = abut_facet_dimension(kind);
  assert_int_equal(abut_facet_project(kind, z + dim, z, &p), ABUT_SUCCESS);
  *value = p.inside ? p.gap : side * p.distance;
  assert_int_equal(abut_facet_distance_derivatives(kind, z + dim, z, &p, side,
                                                   gradient, hessian),
                   ABUT_SUCCESS);
  return edges_of(kind, &p);
}

/* A point somewhere around a facet, beside its edges and corners too. */
static void
random_around(uint64_t *seed, abut_facet_kind kind, double *z)
{
  const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
  double *nodes = z + dim;
  random_facet(seed, kind, n > abut_facet_n_corners(kind) ? 0.06 : 0.2, 1.,
               nodes);
  for (int d = 0; d < dim; ++d)
  {
    z[d] = uniform(seed, -2., 2.);
    for (int k = 0; k < n; ++k)
      z[d] += nodes[dim * k + d] / n;
  }
}

/* The same differences beside edges and corners, with both signs. */
static void
test_edges_and_corners(void **state)
{
  (void)state;
  uint64_t seed = 31;
  const double h = 1e-4;
  int n_edge = 0, n_corner = 0;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < n_cases; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind),
                n = dim * (1 + abut_facet_n_nodes(kind));
      const double side = i % 2 == 0 ? 1. : -1.;
      double z[max_unknowns], g[max_unknowns], f[max_unknowns], value,
          H[max_unknowns * max_unknowns];
      random_around(&seed, kind, z);
      const int where = distance_of(kind, z, side, &value, g, H);
      if (fabs(value) < 0.2)
        continue;
      double worst[2] = {0., 0.};
      bool stays = true;
      for (int u = 0; u < n && stays; ++u)
      {
        double slope = 0., row[max_unknowns] = {0.};
        const double middle = z[u];
        for (int way = -1; way <= 1; way += 2)
        {
          z[u] = middle + way * h;
          stays = stays && distance_of(kind, z, side, &value, f, NULL) == where;
          slope += way / (2. * h) * value;
          for (int v = 0; v < n; ++v)
            row[v] += way / (2. * h) * f[v];
        }
        z[u] = middle;
        worst[0] = fmax(worst[0], fabs(slope - g[u]));
        for (int v = 0; v < n; ++v)
        {
          assert_true(H[u * n + v] == H[v * n + u]);
          worst[1] = fmax(worst[1], fabs(row[v] - H[u * n + v]));
        }
      }
      /* Points that pass to another edge meet a kink. */
      if (!stays || where == 0)
        continue;
      const bool corner = dim == 2 || (where & (where - 1)) != 0;
      n_corner += corner;
      n_edge += !corner;
      /* Near a centre of curvature third derivatives, and so the errors of the
       * differences, are large. */
      double largest = 1.;
      for (int u = 0; u < n * n; ++u)
        largest = fmax(largest, fabs(H[u]));
      assert_true(worst[0] < 1e-6);
      assert_true(worst[1] < 1e-6 * largest * largest);
    }
  assert_true(n_edge > 200 && n_corner > 200);
}

/* At the kink between the inside and an edge distance and gradient go on, and
 * each side has its own second derivative: over the end of a segment that of a
 * plane, 0, and that of a circle, 1 / distance along it. */
static void
test_kink(void **state)
{
  (void)state;
  const double segment[4] = {-1., 0., 1., 0.}, e = 1e-9;
  double h[2][36], g[2][6];
  for (int k = 0; k < 2; ++k)
  {
    const double x[2] = {k == 0 ? 1. - e : 1. + e, -0.5};
    abut_projection p;
    assert_int_equal(abut_facet_project(ABUT_FACET_LINE2, segment, x, &p),
                     ABUT_SUCCESS);
    assert_int_equal(abut_facet_distance_derivatives(ABUT_FACET_LINE2, segment,
                                                     x, &p, 1., g[k], h[k]),
                     ABUT_SUCCESS);
  }
  for (int u = 0; u < 6; ++u)
    assert_near(g[0][u], g[1][u], 1e-8);
  assert_near(h[0][0], 0., 1e-8);
  assert_near(h[1][0], 2., 1e-8);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_finite_differences),
                                     cmocka_unit_test(test_balance),
                                     cmocka_unit_test(test_segment),
                                     cmocka_unit_test(test_refusal),
                                     cmocka_unit_test(test_edges_and_corners),
                                     cmocka_unit_test(test_kink)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
