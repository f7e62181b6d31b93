/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Projection of points onto facets against dense sampling, closed forms and
 * rigid motions. */
#include "facets.h"
#include <abut/projection.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double distortions[] = {0., 0.05, 0.3, 0.9};

static void
assert_near(double a, double b, double tolerance)
{
  if (!(fabs(a - b) <= tolerance))
    fail_msg("%.17g != %.17g within %g", a, b, tolerance);
}

static int
in_domain(abut_facet_kind kind, const double *xi, double tolerance)
{
  if (abut_facet_n_corners(kind) == 3)
    return xi[0] >= -tolerance && xi[1] >= -tolerance
           && xi[0] + xi[1] <= 1. + tolerance;
  return fabs(xi[0]) <= 1. + tolerance && fabs(xi[1]) <= 1. + tolerance;
}

static double
distance_at(abut_facet_kind kind, const double *nodes, const double *xi,
            const double *x)
{
  double y[3];
  assert_int_equal(abut_facet_point(kind, nodes, xi, y, NULL), ABUT_SUCCESS);
  return distance(abut_facet_dimension(kind), x, y);
}

/* Nearest of a grid of samples, then of ever finer grids around it: an upper
 * bound of the true distance, from point evaluation alone. */
static double
sampled_distance(abut_facet_kind kind, const double *nodes, const double *x)
{
  const int line = abut_facet_dimension(kind) == 2;
  double centre[2] = {0., 0.}, half = 1., best = INFINITY;
  int n = line ? 200 : 16;
  for (int level = 0; level < 18; ++level)
  {
    double next[2] = {centre[0], centre[1]};
    for (int i = -n; i <= n; ++i)
      for (int j = line ? 0 : -n; j <= (line ? 0 : n); ++j)
      {
        const double xi[2] = {centre[0] + half * i / n,
                              centre[1] + half * j / n};
        if (!in_domain(kind, xi, 0.))
          continue;
        const double d = distance_at(kind, nodes, xi, x);
        if (d < best)
        {
          best = d;
          next[0] = xi[0];
          next[1] = xi[1];
        }
      }
    centre[0] = next[0];
    centre[1] = next[1];
    half *= level == 0 ? 2. / n : 0.5;
    n = 4;
  }
  return best;
}

/* What the fields of a projection say about each other. */
static void
check_consistency(abut_facet_kind kind, const double *nodes, const double *x,
                  const abut_projection *p, double size)
{
  const int dim = abut_facet_dimension(kind);
  double y[3], n[3], s = 0., normal_square = 0.;
  assert_true(in_domain(kind, p->local, 1e-15));
  assert_int_equal(abut_facet_point(kind, nodes, p->local, y, n), ABUT_SUCCESS);
  double scale = size;
  for (int d = 0; d < dim; ++d)
  {
    assert_near(y[d], p->point[d], 1e-14 * (size + fabs(y[d])));
    assert_near(n[d], p->normal[d], 1e-8);
    s += (x[d] - p->point[d]) * p->normal[d];
    normal_square += p->normal[d] * p->normal[d];
    scale = fmax(scale, fabs(x[d]));
  }
  assert_near(p->distance, distance(dim, x, p->point), 1e-14 * scale);
  if (normal_square > 0.)
  {
    assert_near(normal_square, 1., 1e-14);
    assert_near(p->gap, s, 1e-13 * scale);
  }
  assert_true(p->violation >= 0.);
  assert_true(p->inside ? p->violation == 0. : p->violation > 0.);
  if (p->inside && p->converged && normal_square > 0.)
    assert_near(fabs(p->gap), p->distance, 1e-9 * scale);
}

static void
random_point(uint64_t *seed, int dim, const double *nodes, int n, double *x)
{
  const double reach = pow(10., uniform(seed, -3., 1.));
  for (int d = 0; d < dim; ++d)
  {
    double centre = 0.;
    for (int a = 0; a < n; ++a)
      centre += uniform(seed, 0., 2.) * nodes[a * dim + d] / n;
    x[d] = centre + uniform(seed, -reach, reach);
  }
}

static void
test_sampling(void **state)
{
  (void)state;
  uint64_t seed = 1;
  int not_converged = 0;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < 240; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
      double nodes[27], x[3];
      random_facet(&seed, kind, distortions[i % 4], i % 3 == 0 ? 30. : 1.,
                   nodes);
      random_point(&seed, dim, nodes, n, x);
      abut_projection p;
      assert_int_equal(abut_facet_project(kind, nodes, x, &p), ABUT_SUCCESS);
      check_consistency(kind, nodes, x, &p, 2.);
      const double d = sampled_distance(kind, nodes, x);
      if (!(p.distance <= d + 1e-12 * (1. + d)))
        fail_msg("%s, case %d: %.15g, but a sample is at %.15g",
                 abut_facet_name(kind), i, p.distance, d);
      not_converged += !p.converged;
    }
  assert_int_equal(not_converged, 0);
}

/* Nearest points of a plane square, a plane triangle and a segment. */
static void
test_planar(void **state)
{
  (void)state;
  static const double quad[] = {0, 0, 1, 2, 0, 1, 0, 2, 1, 2, 2, 1};
  static const double triangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  static const double line[] = {0, 0, 4, 0};
  abut_projection p;
  const double a[] = {1.5, 0.5, 3.};
  abut_facet_project(ABUT_FACET_QUAD4, quad, a, &p);
  assert_near(p.gap, 2., 1e-15);
  assert_near(p.local[0], 0.5, 1e-15);
  assert_near(p.local[1], -0.5, 1e-15);
  assert_true(p.inside);
  assert_near(p.normal[2], 1., 1e-15);
  const double b[] = {5., 3., 0.5};
  abut_facet_project(ABUT_FACET_QUAD4, quad, b, &p);
  assert_false(p.inside);
  assert_near(p.violation, 3., 1e-14);
  assert_near(p.gap, -0.5, 1e-15);
  assert_near(p.distance, sqrt(9. + 1. + 0.25), 1e-14);
  const double c[] = {1., 1., -2.};
  abut_facet_project(ABUT_FACET_TRI3, triangle, c, &p);
  assert_near(p.local[0], 0.5, 1e-15);
  assert_near(p.local[1], 0.5, 1e-15);
  assert_near(p.violation, 1., 1e-15);
  assert_near(p.gap, -2., 1e-15);
  assert_near(p.distance, sqrt(4.5), 1e-15);
  /* The tangent is +x, the outward normal -y. */
  const double d[] = {1., -3.};
  abut_facet_project(ABUT_FACET_LINE2, line, d, &p);
  assert_near(p.gap, 3., 1e-15);
  assert_near(p.local[0], -0.5, 1e-15);
  assert_near(p.normal[1], -1., 1e-15);
  const double e[] = {7., 4.};
  abut_facet_project(ABUT_FACET_LINE2, line, e, &p);
  assert_near(p.gap, -4., 1e-15);
  assert_near(p.distance, 5., 1e-14);
  assert_near(p.violation, 1.5, 1e-15);
}

/* The parabola y = x^2 seen from its axis at height h > 1/2: the nearest
 * points are x = +-sqrt(h - 1/2); the one that comes first is taken. */
static void
test_parabola(void **state)
{
  (void)state;
  static const double nodes[] = {-1, 1, 1, 1, 0, 0};
  abut_projection p;
  for (int i = 1; i < 10; ++i)
  {
    const double x[] = {0., 0.5 + 0.1 * i};
    abut_facet_project(ABUT_FACET_LINE3, nodes, x, &p);
    assert_near(fabs(p.local[0]), sqrt(0.1 * i), 1e-14);
    assert_near(p.distance, sqrt(0.25 + 0.1 * i), 1e-14);
    assert_near(p.gap, -p.distance, 1e-14);
    assert_true(p.inside && p.converged);
  }
  const double below[] = {0., -3.};
  abut_facet_project(ABUT_FACET_LINE3, nodes, below, &p);
  assert_near(p.local[0], 0., 1e-15);
  assert_near(p.gap, 3., 1e-15);
}

/* A patch of the paraboloid z = (x^2 + y^2)/2: the normal of the point
 * (x, y, z) is (-x, -y, 1)/sqrt(1 + x^2 + y^2), so points at known gaps below
 * and, within the smallest radius of curvature 1, above are known. */
static void
test_paraboloid(void **state)
{
  (void)state;
  uint64_t seed = 7;
  const abut_facet_kind kinds[] = {ABUT_FACET_QUAD9, ABUT_FACET_TRI6};
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 200; ++i)
    {
      double nodes[27];
      reference_nodes(kinds[k], nodes);
      for (int a = 0; a < abut_facet_n_nodes(kinds[k]); ++a)
        nodes[3 * a + 2] = 0.5
                           * (nodes[3 * a] * nodes[3 * a]
                              + nodes[3 * a + 1] * nodes[3 * a + 1]);
      const double s = uniform(&seed, -0.9, 0.9),
                   t = k == 0 ? uniform(&seed, -0.9, 0.9)
                              : uniform(&seed, -0.95, -0.02 - s);
      const double l = sqrt(1. + s * s + t * t),
                   g = uniform(&seed, -3., i % 2 == 0 ? 0. : 0.9);
      const double n[3] = {-s / l, -t / l, 1. / l};
      const double x[3] = {s + g * n[0], t + g * n[1],
                           0.5 * (s * s + t * t) + g * n[2]};
      abut_projection p;
      abut_facet_project(kinds[k], nodes, x, &p);
      assert_near(p.gap, g, 1e-13);
      assert_near(p.point[0], s, 1e-12);
      assert_near(p.point[1], t, 1e-12);
      assert_true(p.inside && p.converged);
      for (int d = 0; d < 3; ++d)
        assert_near(p.normal[d], n[d], 1e-12);
    }
}

/* Results move with the scene, at any scale from 1e-9 to 1e9. */
static void
test_frames(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < 300; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
      double nodes[27], moved[27], x[3], z[3], q[9], shift[3];
      random_facet(&seed, kind, distortions[i % 3], 1., nodes);
      random_point(&seed, dim, nodes, n, x);
      random_rotation(&seed, dim, q);
      const double scale = pow(10., uniform(&seed, -9., 9.));
      for (int d = 0; d < dim; ++d)
        shift[d] = uniform(&seed, -1., 1.);
      for (int a = 0; a <= n; ++a)
      {
        double *to = a < n ? moved + dim * a : z;
        rotate(dim, q, a < n ? nodes + dim * a : x, to);
        for (int d = 0; d < dim; ++d)
          to[d] = scale * (to[d] + shift[d]);
      }
      abut_projection p, m;
      abut_facet_project(kind, nodes, x, &p);
      abut_facet_project(kind, moved, z, &m);
      assert_near(m.distance, scale * p.distance,
                  2e-14 * scale * (15. + p.distance));
      /* Two points at nearly the same distance may change places. */
      if (fabs(m.local[0] - p.local[0]) + fabs(m.local[1] - p.local[1]) > 1e-3)
        continue;
      assert_near(m.gap, scale * p.gap, 1e-6 * scale);
      if (p.violation < 1e-9 || m.violation < 1e-9)
        continue;
      assert_int_equal(m.inside, p.inside);
    }
}

/* Points 1e6 facet sizes away, on the facet, and facets far from the origin. */
static void
test_extremes(void **state)
{
  (void)state;
  uint64_t seed = 5;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < 100; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
      double nodes[27], x[3], xi[2];
      random_facet(&seed, kind, distortions[i % 4], 1., nodes);
      for (int d = 0; d < dim; ++d)
        x[d] = 2e6 * uniform(&seed, -1., 1.);
      abut_projection p;
      abut_facet_project(kind, nodes, x, &p);
      const double d = sampled_distance(kind, nodes, x);
      assert_true(p.distance <= d + 1e-15 * d);
      check_consistency(kind, nodes, x, &p, 2.);
      /* A point of the facet. */
      do
      {
        xi[0] = uniform(&seed, -1., 1.);
        xi[1] = dim == 2 ? 0. : uniform(&seed, -1., 1.);
      } while (!in_domain(kind, xi, 0.));
      abut_facet_point(kind, nodes, xi, x, NULL);
      abut_facet_project(kind, nodes, x, &p);
      assert_near(p.distance, 0., 3e-9);
      if (distortions[i % 4] < 0.1)
      {
        assert_near(p.distance, 0., 1e-14);
        assert_near(p.local[0], xi[0], 1e-13);
        assert_near(p.local[1], xi[1], 1e-13);
      }
      /* The same far from the origin: round-off 1e9 * 2^-53. */
      for (int j = 0; j < n * dim; ++j)
        nodes[j] += 1e9;
      for (int j = 0; j < dim; ++j)
        x[j] += 1e9;
      abut_facet_project(kind, nodes, x, &p);
      assert_near(p.distance, 0., 1e-6);
    }
}

/* Needles: a parallelogram, triangle and trapezoid of height 1e-6. */
static void
test_slivers(void **state)
{
  (void)state;
  uint64_t seed = 11;
  const double h = 1e-6;
  for (int i = 0; i < 100; ++i)
  {
    const double quad[] = {
        0, 0, 0, 1, 0, 0, i % 2 ? 0.3 : 0., h, 0, i % 3 ? 1.3 : 0.7, h, 0};
    const double triangle[] = {0, 0, 0, 1, 0, 0, i % 2 ? 0.5 : 0.999, h, 0};
    const double x[] = {uniform(&seed, -.2, 1.2),
                        uniform(&seed, -2. * h, 3. * h),
                        uniform(&seed, -1., 1.)};
    abut_projection p;
    abut_facet_project(ABUT_FACET_QUAD4, quad, x, &p);
    double d = sampled_distance(ABUT_FACET_QUAD4, quad, x);
    assert_true(p.distance <= d + 1e-12);
    assert_true(p.converged);
    assert_near(fabs(p.normal[2]), 1., 1e-12);
    abut_facet_project(ABUT_FACET_TRI3, triangle, x, &p);
    d = sampled_distance(ABUT_FACET_TRI3, triangle, x);
    assert_true(p.distance <= d + 1e-12);
  }
}

/* Facets without area have a nearest point too. */
static void
test_degenerate(void **state)
{
  (void)state;
  uint64_t seed = 13;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < 60; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
      double nodes[27], x[3] = {0.3, -0.4, 1.2}, direction[3], s = 0.;
      for (int d = 0; d < dim; ++d)
      {
        direction[d] = i < 30 ? 0. : uniform(&seed, -1., 1.);
        s += x[d] * x[d];
      }
      for (int a = 0; a < n; ++a)
      {
        const double t = uniform(&seed, -1., 1.);
        for (int d = 0; d < dim; ++d)
          nodes[dim * a + d] = t * direction[d];
      }
      abut_projection p;
      assert_int_equal(abut_facet_project(kind, nodes, x, &p), ABUT_SUCCESS);
      assert_true(isfinite(p.gap) && isfinite(p.violation));
      if (i < 30)
        assert_near(p.distance, sqrt(s), 1e-14);
      else
        assert_true(p.distance <= sampled_distance(kind, nodes, x) + 1e-9);
    }
}

/* The batch gives the single calls' results bit for bit. */
static void
test_batch(void **state)
{
  (void)state;
  uint64_t seed = 17;
  enum
  {
    n_facets = 40,
    n_points = 50,
    n_pairs = 500
  };
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
  {
    const abut_facet_kind kind = (abut_facet_kind)k;
    const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
    double positions[n_facets * 27], points[n_points * 3];
    int32_t facets[n_facets * 9], pair_point[n_pairs], pair_facet[n_pairs];
    double local[2 * n_pairs], gap[n_pairs], length[n_pairs],
        violation[n_pairs], normal[3 * n_pairs];
    uint8_t inside[n_pairs];
    for (int f = 0; f < n_facets; ++f)
      random_facet(&seed, kind, distortions[f % 4], 1.,
                   positions + f * n * dim);
    for (int i = 0; i < n_facets * n; ++i)
      facets[i] = i;
    for (int i = 0; i < n_points * dim; ++i)
      points[i] = uniform(&seed, -1.5, 1.5);
    for (int i = 0; i < n_pairs; ++i)
    {
      pair_point[i] = (int32_t)uniform(&seed, 0., n_points);
      pair_facet[i] = (int32_t)uniform(&seed, 0., n_facets);
    }
    abut_projection_batch b = {.struct_size = sizeof(b),
                               .kind = kind,
                               .n_points = n_points,
                               .n_nodes = n * n_facets,
                               .n_facets = n_facets,
                               .n_pairs = n_pairs,
                               .points = points,
                               .positions = positions,
                               .facet_nodes = facets,
                               .pair_point = pair_point,
                               .pair_facet = pair_facet,
                               .local = local,
                               .gap = gap,
                               .distance = length,
                               .violation = violation,
                               .normal = normal,
                               .inside = inside};
    assert_int_equal(abut_facet_project_batch(&b), ABUT_SUCCESS);
    for (int i = 0; i < n_pairs; ++i)
    {
      abut_projection p;
      abut_facet_project(kind, positions + pair_facet[i] * n * dim,
                         points + pair_point[i] * dim, &p);
      assert_memory_equal(p.local, local + i * (dim - 1),
                          sizeof(double) * (size_t)(dim - 1));
      assert_memory_equal(p.normal, normal + i * dim,
                          sizeof(double) * (size_t)dim);
      assert_true(p.gap == gap[i] && p.distance == length[i]
                  && p.violation == violation[i] && p.inside == inside[i]);
    }
    pair_facet[3] = n_facets;
    assert_int_equal(abut_facet_project_batch(&b), ABUT_INVALID_ARGUMENT);
    pair_facet[3] = 0;
    points[0] = NAN;
    assert_int_equal(abut_facet_project_batch(&b), ABUT_NOT_FINITE);
    b.struct_size = 8;
    assert_int_equal(abut_facet_project_batch(&b), ABUT_INVALID_ARGUMENT);
  }
}

static void
test_arguments(void **state)
{
  (void)state;
  double nodes[] = {0, 0, 1, 0}, x[] = {0, 1};
  abut_projection p;
  assert_int_equal(abut_facet_project(ABUT_FACET_N_KINDS, nodes, x, &p),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_facet_project(ABUT_FACET_LINE2, NULL, x, &p),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_facet_project(ABUT_FACET_LINE2, nodes, x, NULL),
                   ABUT_INVALID_ARGUMENT);
  x[1] = INFINITY;
  assert_int_equal(abut_facet_project(ABUT_FACET_LINE2, nodes, x, &p),
                   ABUT_NOT_FINITE);
  x[1] = 1e41;
  assert_int_equal(abut_facet_project(ABUT_FACET_LINE2, nodes, x, &p),
                   ABUT_NOT_FINITE);
}

/* Bounds from centre and radius alone hold for every kind. */
static void
test_bounds(void **state)
{
  (void)state;
  uint64_t seed = 19;
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
    for (int i = 0; i < 300; ++i)
    {
      const abut_facet_kind kind = (abut_facet_kind)k;
      const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
      double nodes[27], x[3], lower, upper;
      random_facet(&seed, kind, distortions[i % 4], 1., nodes);
      random_point(&seed, dim, nodes, n, x);
      abut_facet_measures m;
      abut_projection p;
      assert_int_equal(abut_facet_measure(kind, nodes, &m), ABUT_SUCCESS);
      abut_facet_project(kind, nodes, x, &p);
      abut_facet_distance_bounds(dim, m.centre, m.radius, x, &lower, &upper);
      assert_true(lower <= p.distance * (1. + 1e-14) + 1e-14);
      assert_true(upper >= p.distance * (1. - 1e-14) - 1e-14);
    }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_sampling), cmocka_unit_test(test_planar),
      cmocka_unit_test(test_parabola), cmocka_unit_test(test_paraboloid),
      cmocka_unit_test(test_frames),   cmocka_unit_test(test_extremes),
      cmocka_unit_test(test_slivers),  cmocka_unit_test(test_degenerate),
      cmocka_unit_test(test_batch),    cmocka_unit_test(test_arguments),
      cmocka_unit_test(test_bounds)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
