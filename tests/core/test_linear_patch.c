/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Projections of facets and patches into planes, and the way back. */
#include "facets.h"
#include "fixture.h"
#include "geometry/kernels.h"
#include "geometry/linear_patch.h"
#include "geometry/pull_back.h"
#include "geometry/vector.h"

static const abut_facet_kind kinds[6] = {ABUT_FACET_LINE2, ABUT_FACET_LINE3,
                                         ABUT_FACET_TRI3,  ABUT_FACET_TRI6,
                                         ABUT_FACET_QUAD4, ABUT_FACET_QUAD9};

/* A place in the reference domain. */
static void
random_local(uint64_t *seed, abut_facet_kind kind, double *local)
{
  local[0] = uniform(seed, -1., 1.);
  local[1] = abut_facet_dimension(kind) == 3 ? uniform(seed, -1., 1.) : 0.;
  if (abut_facet_dimension(kind) == 2 || abut_facet_n_corners(kind) == 4)
    return;
  local[0] = 0.5 * (1. + local[0]);
  local[1] = 0.5 * (1. + local[1]) * (1. - local[0]);
}

/* The point over a projected point is the point itself. */
static void
test_pull_back(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 200; ++i)
    {
      const abut_facet_kind kind = kinds[k];
      const int dim = abut_facet_dimension(kind), n = abut_facet_n_nodes(kind);
      double nodes[27], local[2], found[2], flat[18], e[2][3], x[3] = {0.};
      random_facet(&seed, kind, 0.1, 10., nodes);
      abut_facet_measures m;
      assert_ok(abut_facet_measure(kind, nodes, &m));
      abut_plane_basis(dim, m.normal, e);
      random_local(&seed, kind, local);
      assert_ok(abut_facet_point(kind, nodes, local, x, NULL));
      double target[2] = {0., 0.};
      for (int d = 0; d < dim - 1; ++d)
      {
        for (int a = 0; a < n; ++a)
        {
          flat[a * (dim - 1) + d] = 0.;
          for (int c = 0; c < dim; ++c)
            flat[a * (dim - 1) + d] += e[d][c] * nodes[a * dim + c];
        }
        for (int c = 0; c < dim; ++c)
          target[d] += e[d][c] * x[c];
      }
      assert_true(abut_pull_back(kind, flat, target, found, NULL));
      for (int d = 0; d < dim - 1; ++d)
        assert_close(found[d], local[d], 1e-12);
      assert_true(abut_local_violation(kind, found) < 1e-12);
    }
}

/* A basis with the normal is right-handed and of unit vectors. */
static void
test_basis(void **state)
{
  (void)state;
  uint64_t seed = 5;
  for (int i = 0; i < 100; ++i)
  {
    double n[3], e[2][3], c[3];
    for (int d = 0; d < 3; ++d)
      n[d] = uniform(&seed, -1., 1.);
    unit3(n, 0.);
    abut_plane_basis(3, n, e);
    cross3(e[0], e[1], c);
    for (int d = 0; d < 3; ++d)
      assert_close(c[d], n[d], 1e-15);
    assert_close(dot3(e[0], e[1]), 0., 1e-15);
    abut_plane_basis(2, n, e);
    /* The outward normal of (tx, ty) is (ty, -tx). */
    assert_true(e[0][1] == n[0] && -e[0][0] == n[1]);
  }
}

/* Patches of a facet lie on it, and what is lifted from the plane lies over it;
 * the ratio of areas, integrated, gives the area of the reference domain. */
static void
test_patches(void **state)
{
  (void)state;
  uint64_t seed = 7;
  for (int k = 2; k < 6; ++k)
    for (int i = 0; i < 100; ++i)
    {
      const abut_facet_kind kind = kinds[k];
      double nodes[27], e[2][3];
      random_facet(&seed, kind, 0.1, 3., nodes);
      abut_facet_measures m;
      assert_ok(abut_facet_measure(kind, nodes, &m));
      abut_plane_basis(3, m.normal, e);
      abut_linear_patch patch[ABUT_MAX_LINEAR_PATCHES], triangle[2];
      const int split = kind == ABUT_FACET_QUAD4 && i % 2;
      const int n = abut_linear_patches(kind, nodes, split, patch);
      assert_int_equal(n, split || k == 3 || k == 5 ? 4 : 1);
      double reference = 0.;
      for (int p = 0; p < n; ++p)
      {
        abut_linear_patch_flatten(&patch[p], m.centre, e);
        abut_part part;
        abut_linear_patch_walk(&patch[p], &part);
        double x[3], y[3], local[2], ratio, centre[3] = {0.};
        for (int a = 0; a < part.n; ++a)
          axpy3(centre, 1. / part.n, part.x[a], centre);
        const double uv[2] = {dot3(centre, e[0]) - dot3(m.centre, e[0]),
                              dot3(centre, e[1]) - dot3(m.centre, e[1])};
        assert_true(abut_linear_patch_lift(&patch[p], uv, local, x, &ratio));
        assert_close(dot3(x, e[0]), dot3(centre, e[0]), 1e-12);
        assert_close(dot3(x, e[1]), dot3(centre, e[1]), 1e-12);
        /* Corners are nodes, or lie where the facet has them. */
        for (int a = 0; a < part.n; ++a)
        {
          assert_ok(abut_facet_point(kind, nodes, patch[p].local[a], y, NULL));
          for (int d = 0; d < 3; ++d)
            assert_close(patch[p].x[a][d], y[d], 1e-14);
        }
        const int n_triangles =
            abut_linear_patch_triangles(&patch[p], triangle);
        assert_int_equal(n_triangles, part.n - 2);
        for (int t = 0; t < n_triangles; ++t)
        {
          const double *f = triangle[t].flat;
          const double area = 0.5
                              * fabs((f[2] - f[0]) * (f[5] - f[1])
                                     - (f[3] - f[1]) * (f[4] - f[0]));
          const double middle[2] = {(f[0] + f[2] + f[4]) / 3.,
                                    (f[1] + f[3] + f[5]) / 3.};
          assert_true(
              abut_linear_patch_lift(&triangle[t], middle, local, x, &ratio));
          reference += area * ratio;
        }
      }
      assert_close(reference, abut_facet_n_corners(kind) == 3 ? 0.5 : 4.,
                   1e-12);
    }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_pull_back),
                                     cmocka_unit_test(test_basis),
                                     cmocka_unit_test(test_patches)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
