/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Shape functions, measures and checks of facets. */
#include "facets.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

static void
assert_near(double a, double b, double tolerance)
{
  if (!(fabs(a - b) <= tolerance))
    fail_msg("%.17g != %.17g within %g", a, b, tolerance);
}

static void
test_kinds(void **state)
{
  (void)state;
  static const int nodes[] = {2, 3, 3, 6, 4, 9}, corners[] = {2, 2, 3, 3, 4, 4},
                   dimension[] = {2, 2, 3, 3, 3, 3};
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
  {
    const abut_facet_kind kind = (abut_facet_kind)k;
    assert_int_equal(abut_facet_n_nodes(kind), nodes[k]);
    assert_int_equal(abut_facet_n_corners(kind), corners[k]);
    assert_int_equal(abut_facet_dimension(kind), dimension[k]);
    assert_int_equal(abut_facet_n_second(kind), dimension[k] == 2 ? 1 : 3);
    int seen = 0;
    for (int a = 0; a < nodes[k]; ++a)
      seen |= 1 << abut_facet_vtk_order(kind)[a];
    assert_int_equal(seen, (1 << nodes[k]) - 1);
  }
  assert_int_equal(abut_facet_n_nodes(ABUT_FACET_N_KINDS), 0);
  assert_null(abut_facet_vtk_order(ABUT_FACET_N_KINDS));
  assert_string_equal(abut_facet_name(ABUT_FACET_QUAD9), "quad9");
}

/* VTK walks around the corners; its middle node 4 + i of a quadrilateral lies
 * between its corners i and i + 1. */
static void
test_vtk_order(void **state)
{
  (void)state;
  double x[27];
  reference_nodes(ABUT_FACET_QUAD9, x);
  const int8_t *order = abut_facet_vtk_order(ABUT_FACET_QUAD9);
  double area = 0.;
  for (int i = 0; i < 4; ++i)
  {
    const double *a = x + 3 * order[i], *b = x + 3 * order[(i + 1) % 4],
                 *m = x + 3 * order[4 + i];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    for (int d = 0; d < 2; ++d)
      assert_near(m[d], 0.5 * (a[d] + b[d]), 0.);
  }
  assert_near(area, 4., 0.);
  reference_nodes(ABUT_FACET_TRI6, x);
  order = abut_facet_vtk_order(ABUT_FACET_TRI6);
  for (int i = 0; i < 3; ++i)
    for (int d = 0; d < 2; ++d)
      assert_near(x[3 * order[3 + i] + d],
                  0.5 * (x[3 * order[i] + d] + x[3 * order[(i + 1) % 3] + d]),
                  0.);
}

/* N_a(node b) = delta_ab, the sum is 1, and derivatives are those of the
 * polynomials by central differences, exact up to degree 2 per direction. */
static void
test_shape(void **state)
{
  (void)state;
  uint64_t seed = 1;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
  {
    const abut_facet_kind kind = (abut_facet_kind)k;
    const int n = abut_facet_n_nodes(kind), m = abut_facet_dimension(kind) - 1,
              n_second = abut_facet_n_second(kind);
    const int triangle = abut_facet_n_corners(kind) == 3;
    double nodes[27], value[9], first[18], second[27];
    reference_nodes(kind, nodes);
    for (int b = 0; b < n; ++b)
    {
      double xi[2] = {0., 0.};
      for (int d = 0; d < m; ++d)
        xi[d] =
            triangle ? 0.5 * (1. + nodes[3 * b + d]) : nodes[(m + 1) * b + d];
      assert_int_equal(abut_facet_shape(kind, xi, value, NULL, NULL),
                       ABUT_SUCCESS);
      for (int a = 0; a < n; ++a)
        assert_near(value[a], a == b ? 1. : 0., 1e-15);
    }
    for (int i = 0; i < 50; ++i)
    {
      const double h = 0.25;
      double xi[2] = {uniform(&seed, -1., 1.), uniform(&seed, -1., 1.)};
      abut_facet_shape(kind, xi, value, first, second);
      double sum = 0.;
      for (int a = 0; a < n; ++a)
        sum += value[a];
      assert_near(sum, 1., 1e-14);
      for (int d = 0; d < m; ++d)
      {
        double l[9], r[9], dl[18], dr[18];
        const double middle = xi[d];
        xi[d] = middle - h;
        abut_facet_shape(kind, xi, l, dl, NULL);
        xi[d] = middle + h;
        abut_facet_shape(kind, xi, r, dr, NULL);
        xi[d] = middle;
        for (int a = 0; a < n; ++a)
        {
          assert_near(first[a * m + d], (r[a] - l[a]) / (2. * h), 1e-13);
          assert_near(second[a * n_second + d],
                      (dr[a * m + d] - dl[a * m + d]) / (2. * h), 1e-13);
          if (m == 2)
            assert_near(second[a * 3 + 2],
                        (dr[a * 2 + 1 - d] - dl[a * 2 + 1 - d]) / (2. * h),
                        1e-13);
        }
      }
    }
  }
  double xi[] = {NAN, 0.};
  assert_int_equal(abut_facet_shape(ABUT_FACET_TRI3, xi, NULL, NULL, NULL),
                   ABUT_NOT_FINITE);
  assert_int_equal(abut_facet_shape(ABUT_FACET_TRI3, NULL, NULL, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
}

/* Plane facets of side 2, moved, turned and scaled. */
static void
test_plane_measures(void **state)
{
  (void)state;
  uint64_t seed = 2;
  static const double area[] = {2., 2., 2., 2., 4., 4.};
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < 40; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
      double nodes[27], q[9], x[27];
      const double s = pow(10., uniform(&seed, -9., 9.));
      reference_nodes(kind, nodes);
      random_rotation(&seed, dim, q);
      for (int a = 0; a < n; ++a)
      {
        rotate(dim, q, nodes + dim * a, x + dim * a);
        for (int d = 0; d < dim; ++d)
          x[dim * a + d] *= s;
      }
      abut_facet_measures m;
      assert_int_equal(abut_facet_measure(kind, x, &m), ABUT_SUCCESS);
      assert_int_equal(abut_facet_check(kind, x), ABUT_FACET_FAULT_NONE);
      assert_near(m.area, area[k] * (dim == 2 ? s : s * s),
                  1e-14 * (dim == 2 ? s : s * s));
      assert_near(m.warping, 0., 1e-14);
      /* The normal is the image of (0, -1) or (0, 0, 1). */
      for (int d = 0; d < dim; ++d)
        assert_near(m.normal[d], dim == 2 ? -q[2 * d + 1] : q[3 * d + 2],
                    1e-14);
      const double diameter = dim == 2 ? 2. : sqrt(8.);
      assert_near(m.diameter, diameter * s, 1e-14 * s);
      assert_near(m.aspect, dim == 2 ? 1. : 8. / area[k], 1e-13);
      const double radius = dim == 2 ? 1.
                            : abut_facet_n_corners(kind) == 4
                                ? sqrt(2.)
                                : hypot(4. / 3., 2. / 3.);
      assert_near(m.radius, radius * s, 1e-14 * s);
    }
}

/* Box and ball hold the whole facet, for strongly curved ones too. */
static void
test_bounds(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < 100; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind);
      const int triangle = abut_facet_n_corners(kind) == 3;
      double nodes[27];
      random_facet(&seed, kind, 0.8, 1., nodes);
      abut_facet_measures m;
      abut_facet_measure(kind, nodes, &m);
      for (int j = 0; j < 200; ++j)
      {
        double xi[2] = {uniform(&seed, triangle ? 0. : -1., 1.), 0.}, y[3];
        xi[1] =
            triangle ? uniform(&seed, 0., 1. - xi[0]) : uniform(&seed, -1., 1.);
        abut_facet_point(kind, nodes, xi, y, NULL);
        for (int d = 0; d < dim; ++d)
        {
          assert_true(y[d] >= m.lower[d] - 1e-14);
          assert_true(y[d] <= m.upper[d] + 1e-14);
        }
        assert_true(distance(dim, y, m.centre) <= m.radius + 1e-14);
      }
    }
}

/* The parabola y = x^2, |x| <= 1 has the length sqrt(5) + asinh(2)/2, and the
 * saddle z = x y over the square the area of a known integral; both to the
 * accuracy of the Gauss rules. */
static void
test_curved_area(void **state)
{
  (void)state;
  const double parabola[] = {-1, 1, 1, 1, 0, 0};
  abut_facet_measures m;
  abut_facet_measure(ABUT_FACET_LINE3, parabola, &m);
  assert_near(m.area, sqrt(5.) + 0.5 * asinh(2.), 5e-3);
  assert_near(m.warping, atan(2.), 1e-14);
  /* The tangents at the ends meet at y = -1. */
  assert_near(m.lower[1], -1., 1e-15);
  /* Shallow arc: x^2/8, length by the same formula. */
  const double arc[] = {-1, .125, 1, .125, 0, 0};
  abut_facet_measure(ABUT_FACET_LINE3, arc, &m);
  assert_near(m.area, sqrt(1. + .0625) + 4. * asinh(.25), 1e-9);
  /* Bilinear facet z = h x y: warping atan(sqrt(2) h) at the corners. */
  const double h = 0.3;
  const double saddle[] = {-1, -1, h, 1, -1, -h, -1, 1, -h, 1, 1, h};
  abut_facet_measure(ABUT_FACET_QUAD4, saddle, &m);
  assert_near(m.warping, atan(sqrt(2.) * h), 1e-14);
  double sum = 0.;
  const int n = 400;
  for (int i = 0; i < n * n; ++i)
  {
    const double x = (2. * (i % n) + 1.) / n - 1.,
                 y = (2. * (i / n) + 1.) / n - 1.;
    sum += sqrt(1. + h * h * (x * x + y * y)) * 4. / ((double)n * n);
  }
  assert_near(m.area, sum, 1e-6);
}

/* Error of the area of a square cap of the unit sphere with half angle a,
 * interpolated by a quad9; the solid angle is 4 asin(sin(a)^2). */
static double
cap_error(double a)
{
  double nodes[27];
  reference_nodes(ABUT_FACET_QUAD9, nodes);
  for (int i = 0; i < 9; ++i)
  {
    const double u = tan(a * nodes[3 * i]), v = tan(a * nodes[3 * i + 1]),
                 l = sqrt(1. + u * u + v * v);
    nodes[3 * i] = u / l;
    nodes[3 * i + 1] = v / l;
    nodes[3 * i + 2] = 1. / l;
  }
  abut_facet_measures m;
  abut_facet_measure(ABUT_FACET_QUAD9, nodes, &m);
  assert_near(m.normal[2], 1., 1e-14);
  const double exact = 4. * asin(sin(a) * sin(a));
  return fabs(m.area - exact) / exact;
}

/* Quadratic interpolation: fourth order at the symmetric patch. */
static void
test_sphere_patch(void **state)
{
  (void)state;
  for (double a = pi / 16.; a > 0.02; a *= 0.5)
  {
    const double order = log2(cap_error(a) / cap_error(0.5 * a));
    assert_true(order > 3.9 && order < 4.1);
  }
}

static void
expect(abut_facet_kind kind, const double *nodes, abut_facet_fault fault)
{
  const abut_facet_fault found = abut_facet_check(kind, nodes);
  if (found != fault)
    fail_msg("\"%s\" instead of \"%s\"", abut_facet_fault_text(found),
             abut_facet_fault_text(fault));
}

static void
test_checks(void **state)
{
  (void)state;
  const double nan_node[] = {0, 0, 1, NAN}, huge[] = {0, 0, 1e300, 0},
               point[] = {3, 3, 3, 3};
  expect(ABUT_FACET_LINE2, nan_node, ABUT_FACET_FAULT_NOT_FINITE);
  expect(ABUT_FACET_LINE2, huge, ABUT_FACET_FAULT_NOT_FINITE);
  expect(ABUT_FACET_LINE2, NULL, ABUT_FACET_FAULT_NOT_FINITE);
  expect(ABUT_FACET_LINE2, point, ABUT_FACET_FAULT_COINCIDENT);
  expect(ABUT_FACET_N_KINDS, point, ABUT_FACET_FAULT_KIND);
  const double collinear[] = {0, 0, 0, 1, 1, 1, 3, 3, 3};
  expect(ABUT_FACET_TRI3, collinear, ABUT_FACET_FAULT_ZERO_AREA);
  const double needle[] = {0, 0, 0, 1, 0, 0, .5, 1e-9, 0};
  expect(ABUT_FACET_TRI3, needle, ABUT_FACET_FAULT_NONE);
  const double lost[] = {1e9, 0, 0, 1e9 + 1, 0, 0, 1e9, 1e-8, 0};
  expect(ABUT_FACET_TRI3, lost, ABUT_FACET_FAULT_COINCIDENT);
  const double bow_tie[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  expect(ABUT_FACET_QUAD4, bow_tie, ABUT_FACET_FAULT_FOLDED);
  const double dart[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, .3, .3, 0};
  expect(ABUT_FACET_QUAD4, dart, ABUT_FACET_FAULT_FOLDED);
  const double collapsed[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0};
  expect(ABUT_FACET_QUAD4, collapsed, ABUT_FACET_FAULT_COINCIDENT);
  const double warped[] = {0, 0, 0, 1, 0, .5, 0, 1, .5, 1, 1, 0};
  expect(ABUT_FACET_QUAD4, warped, ABUT_FACET_FAULT_NONE);
  const double folded_line[] = {0, 0, 1, 0, 1.3, 0};
  expect(ABUT_FACET_LINE3, folded_line, ABUT_FACET_FAULT_FOLDED);
  const double bent_line[] = {0, 0, 1, 0, .5, .3};
  expect(ABUT_FACET_LINE3, bent_line, ABUT_FACET_FAULT_NONE);
  double quad9[27], tri6[18];
  reference_nodes(ABUT_FACET_QUAD9, quad9);
  quad9[3 * 6] = 0.7; /* a middle node beyond the quarter point */
  expect(ABUT_FACET_QUAD9, quad9, ABUT_FACET_FAULT_FOLDED);
  reference_nodes(ABUT_FACET_TRI6, tri6);
  expect(ABUT_FACET_TRI6, tri6, ABUT_FACET_FAULT_NONE);
  tri6[3 * 4] = -0.9;
  tri6[3 * 4 + 1] = -0.9;
  expect(ABUT_FACET_TRI6, tri6, ABUT_FACET_FAULT_FOLDED);
  assert_string_equal(abut_facet_fault_text((abut_facet_fault)99),
                      "unknown fault");
}

/* Every text exists and no two are the same. */
static void
test_texts(void **state)
{
  (void)state;
  for (int i = 0; i <= ABUT_FACET_FAULT_FOLDED; ++i)
    for (int j = 0; j < i; ++j)
      assert_string_not_equal(abut_facet_fault_text((abut_facet_fault)i),
                              abut_facet_fault_text((abut_facet_fault)j));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_kinds),
                                     cmocka_unit_test(test_vtk_order),
                                     cmocka_unit_test(test_shape),
                                     cmocka_unit_test(test_plane_measures),
                                     cmocka_unit_test(test_bounds),
                                     cmocka_unit_test(test_curved_area),
                                     cmocka_unit_test(test_sphere_patch),
                                     cmocka_unit_test(test_checks),
                                     cmocka_unit_test(test_texts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
