/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Common parts of facets: closed forms, partition of the area, invariance. */
#include "facets.h"
#include "geometry/clip.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static void
assert_near(double a, double b, double tolerance)
{
  if (!(fabs(a - b) <= tolerance))
    fail_msg("%.17g != %.17g within %g", a, b, tolerance);
}

static int
gcd(int a, int b)
{
  return b == 0 ? a : gcd(b, a % b);
}

/* Facet i of a line of n, or (i, j) of a square of n x n, rotated by q; the
 * primary is walked the other way round, as facing surfaces are. */
static void
grid_facet(int dim, int n, int i, int j, int reverse, const double *q,
           double *nodes)
{
  for (int a = 0; a < 2 * dim - 2; ++a)
  {
    const int u = reverse ? 1 - a % 2 : a % 2, v = a / 2;
    const double x[3] = {(i + u) / (double)n,
                         dim == 2 ? 0. : (j + v) / (double)n, 0.};
    rotate(dim, q, x, nodes + dim * a);
  }
}

/* Flat grids of n1 and n2 facets per side over each other: n1 + n2 - gcd
 * pairs per direction have a common part, and the parts cover the whole. */
static void
test_grids(void **state)
{
  (void)state;
  static const int sizes[][2] = {{1, 1}, {2, 3}, {4, 6},
                                 {5, 5}, {1, 7}, {9, 12}};
  uint64_t seed = 1;
  for (int dim = 2; dim <= 3; ++dim)
    for (int k = 0; k < 6; ++k)
    {
      const int n1 = sizes[k][0], n2 = sizes[k][1];
      const abut_facet_kind kind =
          dim == 2 ? ABUT_FACET_LINE2 : ABUT_FACET_QUAD4;
      double q[9], s[12], m[12], sum = 0.;
      random_rotation(&seed, dim, q);
      int count = 0;
      for (int i = 0; i < (dim == 2 ? n1 : n1 * n1); ++i)
        for (int j = 0; j < (dim == 2 ? n2 : n2 * n2); ++j)
        {
          grid_facet(dim, n1, i % n1, i / n1, 0, q, s);
          grid_facet(dim, n2, j % n2, j / n2, 1, q, m);
          const double area = abut_facet_common_area(kind, s, kind, m);
          count += area > 0.;
          sum += area;
        }
      const int per_side = n1 + n2 - gcd(n1, n2);
      assert_int_equal(count, dim == 2 ? per_side : per_side * per_side);
      assert_near(sum, 1., 1e-13);
    }
}

/* Unit square and the same turned by 45 degrees: the regular octagon of area
 * 2 sqrt(2) - 2, centre in the middle. */
static void
test_octagon(void **state)
{
  (void)state;
  abut_part s = {4, {{-.5, -.5, 0}, {.5, -.5, 0}, {.5, .5, 0}, {-.5, .5, 0}}};
  const double r = sqrt(0.5), origin[3] = {0, 0, 0}, normal[3] = {0, 0, 1};
  abut_part m = {4, {{0, -r, 1}, {-r, 0, 1}, {0, r, 1}, {r, 0, 1}}};
  abut_clip3 c;
  assert_int_equal(abut_clip3_parts(&s, &m, origin, normal, &c),
                   ABUT_CLIP_POLYGON);
  assert_int_equal(c.n, 8);
  assert_near(c.area, 2. * sqrt(2.) - 2., 1e-15);
  assert_near(c.centroid[0], 0., 1e-15);
  assert_near(c.centroid[1], 0., 1e-15);
  /* All vertices lie on the circle around it. */
  for (int i = 0; i < 8; ++i)
    assert_near(hypot(c.vertex[i][0], c.vertex[i][1]),
                hypot(0.5, 0.5 * (sqrt(2.) - 1.)), 1e-15);
}

/* A triangle cut by half: area and centroid by hand. */
static void
test_triangle(void **state)
{
  (void)state;
  const abut_part s = {3, {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}};
  const abut_part m = {4, {{0, 0, 5}, {1, 0, 4}, {1, 9, 3}, {0, 9, 2}}};
  const double origin[3] = {0, 0, 0}, normal[3] = {0, 0, 1};
  abut_clip3 c;
  assert_int_equal(abut_clip3_parts(&s, &m, origin, normal, &c),
                   ABUT_CLIP_POLYGON);
  /* Trapezoid of heights 2 and 1, width 1. */
  assert_near(c.area, 1.5, 1e-15);
  double x[3];
  for (int d = 0; d < 3; ++d)
    x[d] = c.origin[d] + c.centroid[0] * c.e1[d] + c.centroid[1] * c.e2[d];
  assert_near(x[0], 4. / 9., 1e-15);
  assert_near(x[1], 7. / 9., 1e-15);
  assert_near(x[2], 0., 1e-15);
}

/* A cloud of random convex quadrilaterals against a grid that covers them:
 * the parts add up to each one's area, whatever the orientation, and clipping
 * is symmetric in a common plane. */
static void
test_partition(void **state)
{
  (void)state;
  uint64_t seed = 2;
  for (int k = 0; k < 200; ++k)
  {
    double q[9], x[4][3], s[12], sum = 0., area = 0.;
    random_rotation(&seed, 3, q);
    const double scale = pow(10., uniform(&seed, -9., 9.));
    for (int a = 0; a < 4; ++a)
    {
      x[a][0] = 0.5 + (a % 2 ? 1. : -1.) * uniform(&seed, 0.1, 0.4);
      x[a][1] = 0.5 + (a / 2 ? 1. : -1.) * uniform(&seed, 0.1, 0.4);
      x[a][2] = 0.;
      rotate(3, q, x[a], s + 3 * a);
    }
    for (int i = 0; i < 12; ++i)
      s[i] *= scale;
    /* Half the cross product of the diagonals. */
    area = 0.5
           * ((x[3][0] - x[0][0]) * (x[2][1] - x[1][1])
              - (x[3][1] - x[0][1]) * (x[2][0] - x[1][0]));
    for (int i = 0; i < 9; ++i)
    {
      double m[12];
      grid_facet(3, 3, i % 3, i / 3, i % 2, q, m);
      for (int j = 0; j < 12; ++j)
        m[j] *= scale;
      const double part =
          abut_facet_common_area(ABUT_FACET_QUAD4, s, ABUT_FACET_QUAD4, m);
      assert_near(
          part,
          abut_facet_common_area(ABUT_FACET_QUAD4, m, ABUT_FACET_QUAD4, s),
          1e-14 * scale * scale);
      sum += part;
    }
    assert_near(sum, area * scale * scale, 1e-14 * scale * scale);
  }
}

/* A dart is not convex; its area within the unit square is its own. */
static void
test_dart(void **state)
{
  (void)state;
  static const double square[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  for (int first = 0; first < 4; ++first)
  {
    /* Corners walked around, reflex one at (0.4, 0.4): area 0.4. */
    static const double corner[4][2] = {{0, 0}, {1, 0}, {.4, .4}, {0, 1}};
    static const int lexicographic[4] = {0, 1, 3, 2};
    double dart[12];
    for (int a = 0; a < 4; ++a)
    {
      const double *x = corner[(first + lexicographic[a]) % 4];
      dart[3 * a] = x[0];
      dart[3 * a + 1] = x[1];
      dart[3 * a + 2] = 0.3;
    }
    assert_near(abut_facet_common_area(ABUT_FACET_QUAD4, square,
                                       ABUT_FACET_QUAD4, dart),
                0.4, 1e-15);
    assert_near(abut_facet_common_area(ABUT_FACET_QUAD4, dart, ABUT_FACET_QUAD4,
                                       square),
                0.4, 1e-15);
  }
}

/* Quadratic facets with straight edges cover what their linear parts do. */
static void
test_quadratic(void **state)
{
  (void)state;
  double quad[27], triangle[18], line[6];
  reference_nodes(ABUT_FACET_QUAD9, quad);
  reference_nodes(ABUT_FACET_TRI6, triangle);
  reference_nodes(ABUT_FACET_LINE3, line);
  const double shifted[] = {0.5, 0.1, 2.5, 0.1};
  assert_near(
      abut_facet_common_area(ABUT_FACET_QUAD9, quad, ABUT_FACET_QUAD9, quad),
      4., 1e-14);
  assert_near(
      abut_facet_common_area(ABUT_FACET_QUAD9, quad, ABUT_FACET_TRI6, triangle),
      2., 1e-14);
  assert_near(
      abut_facet_common_area(ABUT_FACET_LINE3, line, ABUT_FACET_LINE2, shifted),
      0.5, 1e-15);
}

/* Touching, apart and degenerate facets have nothing in common. */
static void
test_empty(void **state)
{
  (void)state;
  const double a[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const double b[] = {1, 0, 0, 2, 0, 0, 1, 1, 0, 2, 1, 0};
  const double flat[] = {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0};
  const double upright[] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1};
  const abut_facet_kind k = ABUT_FACET_QUAD4;
  assert_true(abut_facet_common_area(k, a, k, b) == 0.);
  assert_true(abut_facet_common_area(k, flat, k, a) == 0.);
  assert_true(abut_facet_common_area(k, a, k, flat) == 0.);
  assert_true(abut_facet_common_area(k, a, k, upright) == 0.);
  const double u[] = {0, 0, 1, 0}, v[] = {1, 0, 2, 0}, w[] = {0, 0, 0, 1};
  assert_true(abut_facet_common_area(ABUT_FACET_LINE2, u, ABUT_FACET_LINE2, v)
              == 0.);
  assert_true(abut_facet_common_area(ABUT_FACET_LINE2, u, ABUT_FACET_LINE2, w)
              == 0.);
}

/* Unit segments that overlap by a little more, and less, than counts. */
static void
test_smallest_segment(void **state)
{
  (void)state;
  const double normals[] = {0, 1, 0, 1}, s[] = {1, 0, 0, 0};
  for (int i = 0; i < 2; ++i)
  {
    const double common = (i == 0 ? 1.5 : 0.5) * ABUT_CLIP_SMALLEST,
                 m[] = {1 - common, 0.1, 2, 0.1};
    abut_clip2 c;
    assert_int_equal(abut_clip2_segments(s, m, normals, &c), i == 0);
    assert_near(c.length, common, 1e-15);
  }
}

/* Two concentric arcs' chords, normals through the centre: the ends of the
 * primary are seen from the centre at the angles they have. */
static void
test_interpolated_normals(void **state)
{
  (void)state;
  uint64_t seed = 5;
  for (int i = 0; i < 100; ++i)
  {
    const double a = uniform(&seed, 0.05, 0.6), from = uniform(&seed, -1., 1.),
                 to = from + uniform(&seed, 0.1, 0.9), R = 1.3;
    const double s[] = {cos(-a), sin(-a), cos(a), sin(a)};
    const double m[] = {R * cos(a * to), R * sin(a * to), R * cos(a * from),
                        R * sin(a * from)};
    abut_clip2 c;
    assert_int_equal(abut_clip2_segments(s, m, s, &c), 1);
    /* Chord at x = cos a: height over angle t is cos(a) tan(t). */
    const double lower = fmax(tan(a * from) / tan(a), -1.),
                 upper = fmin(tan(a * to) / tan(a), 1.);
    assert_near(c.secondary[0], lower, 1e-14);
    assert_near(c.secondary[1], upper, 1e-14);
    assert_near(c.length, (upper - lower) * sin(a), 1e-14);
    /* The same rays hit the primary's chord. */
    for (int e = 0; e < 2; ++e)
    {
      const double t = c.primary[e],
                   y[2] = {0.5 * (1 - t) * m[0] + 0.5 * (1 + t) * m[2],
                           0.5 * (1 - t) * m[1] + 0.5 * (1 + t) * m[3]};
      assert_near(y[1] / y[0], c.secondary[e] * tan(a), 1e-14);
    }
  }
}

/* Chords of circles, seen from the centre by the secondary's normals as lines:
 * one that passes the direction along the secondary has its ends on both sides,
 * and nothing over the middle. */
static void
test_behind_the_normals(void **state)
{
  (void)state;
  uint64_t seed = 6;
  for (int i = 0; i < 100; ++i)
  {
    const double right = acos(0.), a = uniform(&seed, 0.05, 0.3),
                 from = uniform(&seed, 0.4, right - 0.01),
                 to = uniform(&seed, right + 0.01, 2.7),
                 R = uniform(&seed, 1.1, 3.);
    const double s[] = {cos(-a), sin(-a), cos(a), sin(a)};
    const double m[] = {R * cos(to), R * sin(to), R * cos(from), R * sin(from)};
    abut_clip2 c;
    assert_int_equal(abut_clip2_segments(s, m, s, &c), 0);
  }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_grids),
      cmocka_unit_test(test_octagon),
      cmocka_unit_test(test_triangle),
      cmocka_unit_test(test_partition),
      cmocka_unit_test(test_dart),
      cmocka_unit_test(test_quadratic),
      cmocka_unit_test(test_empty),
      cmocka_unit_test(test_smallest_segment),
      cmocka_unit_test(test_interpolated_normals),
      cmocka_unit_test(test_behind_the_normals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
