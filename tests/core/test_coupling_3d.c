/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Coupling of surfaces: what is exact on flat interfaces for any pair of
 * meshes, and how fast curved ones converge. */
#include "coupling_fixture.h"

static const double angles[3] = {0.4, -0.9, 1.7}, shift[3] = {0.3, -2., 0.7};

/* Flat mesh of nu x nv cells over [x0, x0 + lx] x [y0, y0 + ly] at height z in
 * a rotated frame; up: its normal is the frame's third axis. */
static scene_mesh
plane(abut_facet_kind kind, int32_t nu, int32_t nv, const double *p, bool up)
{
  scene_mesh m = scene_patch(kind, nu, nv, scene_plane, p, !up);
  scene_move(&m, 1., angles, shift);
  return m;
}

static void
frame_normal(double *n)
{
  double x[6] = {0., 0., 0., 0., 0., 1.};
  int32_t none[1] = {0};
  scene_mesh m = {3, 2, 0, ABUT_FACET_QUAD4, x, none};
  scene_move(&m, 1., angles, shift);
  for (int d = 0; d < 3; ++d)
    n[d] = x[3 + d] - x[d];
}

static const double unit[5] = {0., 0., 1., 1., 0.},
                    above[5] = {0., 0., 1., 1., 0.02};

static int
gcd(int a, int b)
{
  return b == 0 ? a : gcd(b, a % b);
}

static const abut_facet_kind kinds[3] = {ABUT_FACET_QUAD4, ABUT_FACET_TRI3,
                                         ABUT_FACET_QUAD9};

/* The number of rows, and D diagonal. */
static void
check_dual(const couple *c, int32_t n_rows)
{
  assert_int_equal(c->view.n_rows, n_rows);
  for (int32_t j = 0; j < c->view.n_rows; ++j)
  {
    const int64_t e = c->view.secondary_start[j];
    assert_int_equal(c->view.secondary_start[j + 1] - e, 1);
    assert_int_equal(c->view.secondary_node[e], c->view.node[j]);
  }
}

static void
flat_case(abut_facet_kind ks, abut_facet_kind km, int n1, int n2,
          abut_discretisation discretisation, int32_t degree)
{
  double n[3];
  frame_normal(n);
  const abut_coupling_options o = mortar_options(discretisation, degree);
  scene_mesh s = plane(ks, n1, n1, unit, true),
             m = plane(km, n2, n2, above, false);
  couple c = couple_meshes(&s, &m, &o, NULL);
  check_rows(&c);
  /* Row j has the pressure 1 + j: round-off grows with the square. */
  const double load = fmax(1., 1e-4 * c.view.n_rows * c.view.n_rows);
  check_balance(&c, 2e-13 * load, 5e-13 * load);
  near(force_error(&c, 0, n), 0., 1e-14, "secondary force");
  near(force_error(&c, 1, n), 0., 1e-14, "primary force");
  near(c.statistics.covered_area, 1., 5e-14, "covered");
  near(c.statistics.full_area, 1., 1e-14, "full");
  for (int32_t j = 0; j < c.view.n_rows; ++j)
  {
    near(c.view.gap[j], 0.02, 2e-14, "gap");
    near(c.view.weight[j], c.view.full_weight[j], 1e-14, "weight");
  }
  const int per_side = (ks == ABUT_FACET_QUAD9 && degree == 0 ? 2 : 1) * n1 + 1;
  if (discretisation == ABUT_DISCRETISATION_DUAL_MORTAR)
    check_dual(&c, per_side * per_side);
  if (ks == ABUT_FACET_QUAD4 && km == ABUT_FACET_QUAD4)
    assert_int_equal(c.statistics.n_pairs,
                     (n1 + n2 - gcd(n1, n2)) * (n1 + n2 - gcd(n1, n2)));
  couple_destroy(&c);
  scene_free(&s);
  scene_free(&m);
}

/* Uniform pressure, weights, gaps and pairs of flat meshes that cover each
 * other, for all kinds and several pairs of sizes. */
static void
test_flat(void **state)
{
  (void)state;
  static const int sizes[][2] = {{3, 4}, {2, 4}, {4, 2},
                                 {2, 3}, {1, 7}, {3, 3}};
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 9; ++i)
    {
      const abut_facet_kind ks = kinds[i / 3], km = kinds[i % 3];
      const int n1 = sizes[k][0], n2 = sizes[k][1];
      flat_case(ks, km, n1, n2, ABUT_DISCRETISATION_DUAL_MORTAR, 0);
      flat_case(ks, km, n1, n2, ABUT_DISCRETISATION_MORTAR, 0);
      flat_case(ks, km, n1, n2, ABUT_DISCRETISATION_MORTAR, 1);
      flat_case(ks, km, n1, n2, ABUT_DISCRETISATION_QUADRATURE_POINT, 0);
    }
}

/* A linear polynomial of the frame's plane coordinates, and with all products
 * of two of them. */
typedef struct polynomial
{
  double axes[9]; /* a point of the frame and one along each axis from it */
  bool quadratic;
} polynomial;

static polynomial
polynomial_of_frame(bool quadratic)
{
  polynomial p = {{0., 0., 0., 1., 0., 0., 0., 1., 0.}, quadratic};
  int32_t none[1] = {0};
  scene_mesh frame = {3, 3, 0, ABUT_FACET_QUAD4, p.axes, none};
  scene_move(&frame, 1., angles, shift);
  return p;
}

static double
value_at(const double *x, const void *data)
{
  const polynomial *p = data;
  double t[2] = {0., 0.};
  for (int k = 0; k < 2; ++k)
    for (int d = 0; d < 3; ++d)
      t[k] += (x[d] - p->axes[d]) * (p->axes[3 * (k + 1) + d] - p->axes[d]);
  return 0.3 + 1.7 * t[0] - 0.9 * t[1]
         + (p->quadratic ? t[0] * t[0] - 0.4 * t[0] * t[1] + 0.6 * t[1] * t[1]
                         : 0.);
}

/* Both sides see the same linear field alike, quadratic facets the same
 * quadratic one; the primary is larger and its mesh shifted. */
static void
test_fields(void **state)
{
  (void)state;
  const double larger[5] = {-0.13, -0.21, 1.4, 1.3, 0.};
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 3; ++k)
    {
      const abut_coupling_options o = mortar_options(
          k == 0 ? ABUT_DISCRETISATION_DUAL_MORTAR : ABUT_DISCRETISATION_MORTAR,
          k == 2);
      scene_mesh s = plane(kinds[i / 3], 3, 2, unit, true),
                 m = plane(kinds[i % 3], 4, 5, larger, false);
      couple c = couple_meshes(&s, &m, &o, NULL);
      check_rows(&c);
      near(c.statistics.covered_area, 1., 1e-14, "covered");
      const polynomial p = polynomial_of_frame(i == 8);
      near(field_difference(&c, value_at, &p), 0., 1e-13, "field");
      couple_destroy(&c);
      scene_free(&s);
      scene_free(&m);
    }
}

/* Dual rows of matching meshes couple node to node: one entry on each side. */
static void
test_matching(void **state)
{
  (void)state;
  for (int i = 0; i < 3; i += 2)
  {
    scene_mesh s = plane(kinds[i], 6, 6, unit, true),
               m = plane(kinds[i], 6, 6, above, false);
    couple c = couple_meshes(&s, &m, NULL, NULL);
    const couple_view *v = &c.view;
    check_dual(&c, s.n_nodes);
    assert_int_equal(v->primary_start[v->n_rows], v->n_rows);
    for (int32_t j = 0; j < v->n_rows; ++j)
    {
      const double *x = s.position + 3 * v->node[j],
                   *y = m.position + 3 * v->primary_node[j];
      near(v->primary_coefficient[j], 1., 0., "coefficient");
      near(sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1])
                + (x[2] - y[2]) * (x[2] - y[2])),
           0.02, 1e-14, "distance of the two nodes");
    }
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* tri6 with linear multipliers: rows at corners, forces exact. */
static void
test_tri6(void **state)
{
  (void)state;
  flat_case(ABUT_FACET_TRI6, ABUT_FACET_TRI6, 2, 3, ABUT_DISCRETISATION_MORTAR,
            1);
  flat_case(ABUT_FACET_TRI6, ABUT_FACET_QUAD9, 2, 3, ABUT_DISCRETISATION_MORTAR,
            1);
  flat_case(ABUT_FACET_QUAD4, ABUT_FACET_TRI6, 2, 3,
            ABUT_DISCRETISATION_DUAL_MORTAR, 0);
}

/* A small primary: weights add up to its area, and a uniform pressure gives its
 * consistent forces. */
static void
test_partly_covered(void **state)
{
  (void)state;
  static const double small[][5] = {{0.23, 0.31, 0.4, 0.5, 0.01},
                                    {0.25, 0.25, 0.5, 0.5, 0.01},
                                    {0.4, 0.35, 0.04, 0.03, 0.01},
                                    {0.249, 0.1, 0.7, 0.8, 0.01},
                                    {-0.2, 0.51, 0.6, 0.2, 0.01}};
  double n[3];
  frame_normal(n);
  for (int k = 0; k < 5; ++k)
    for (int i = 0; i < 9; ++i)
      for (int dual = 0; dual < 2; ++dual)
      {
        const double *p = small[k];
        abut_coupling_options o = abut_coupling_defaults();
        o.discretisation =
            dual ? ABUT_DISCRETISATION_DUAL_MORTAR : ABUT_DISCRETISATION_MORTAR;
        o.search.reach = 0.05;
        scene_mesh s = plane(kinds[i / 3], 4, 4, unit, true),
                   m = plane(kinds[i % 3], 2, 3, p, false);
        couple c = couple_meshes(&s, &m, &o, NULL);
        const double area = (fmin(p[0] + p[2], 1.) - fmax(p[0], 0.)) * p[3];
        check_rows(&c);
        /* Lumped facets have forces in balance, not moments. */
        check_balance(&c, 1e-13, c.statistics.n_lumped == 0 ? 1e-12 : 1e-5);
        near(c.statistics.covered_area, area, 1e-14, "covered");
        for (int32_t j = 0; j < c.view.n_rows; ++j)
          near(c.view.gap[j], 0.01, 1e-11, "gap");
        if (k < 4)
          near(force_error(&c, 1, n), 0., 1e-14, "primary force");
        couple_destroy(&c);
        scene_free(&s);
        scene_free(&m);
      }
}

/* Of two sheets over one spot the nearer has it, to the last part of area. */
static void
test_layers(void **state)
{
  (void)state;
  const double wide[5] = {-0.1, -0.1, 1.2, 1.2, 0.05},
               narrow[5] = {0.33, 0.21, 0.4, 0.53, 0.02};
  double n[3];
  frame_normal(n);
  for (int dual = 0; dual < 2; ++dual)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.discretisation =
        dual ? ABUT_DISCRETISATION_DUAL_MORTAR : ABUT_DISCRETISATION_MORTAR;
    o.search.reach = 0.2;
    scene_mesh s = plane(ABUT_FACET_QUAD4, 4, 4, unit, true),
               m = scene_join(plane(ABUT_FACET_QUAD4, 3, 3, wide, false),
                              plane(ABUT_FACET_QUAD4, 2, 3, narrow, false));
    couple c = couple_meshes(&s, &m, &o, NULL);
    check_rows(&c);
    near(c.statistics.covered_area, 1., 1e-14, "covered");
    assert_true(c.statistics.n_layers > 0);
    double force[3 * 28] = {0.}, sum[2] = {0.};
    nodal_forces(&c.view, 1, force);
    for (int l = 0; l < 28; ++l)
      for (int d = 0; d < 3; ++d)
        sum[l >= 16] += force[3 * l + d] * n[d];
    near(sum[1], 0.4 * 0.53, 1e-14, "force on the near sheet");
    near(sum[0], 1. - 0.4 * 0.53, 1e-14, "force on the far sheet");
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* Node to segment, and quadrature points of whole facets: balanced; a uniform
 * pressure is not transferred exactly. */
static void
test_points(void **state)
{
  (void)state;
  double n[3];
  frame_normal(n);
  for (int k = 0; k < 2; ++k)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.discretisation = k == 0 ? ABUT_DISCRETISATION_NODE_TO_SEGMENT
                              : ABUT_DISCRETISATION_QUADRATURE_POINT;
    o.segments = false;
    scene_mesh s = plane(ABUT_FACET_QUAD4, 3, 3, unit, true),
               m = plane(ABUT_FACET_QUAD4, 4, 4, above, false);
    couple c = couple_meshes(&s, &m, &o, NULL);
    check_rows(&c);
    check_balance(&c, 1e-13, 1e-13);
    assert_int_equal(c.view.n_rows, k == 0 ? 16 : 36);
    near(c.statistics.covered_area, 1., 1e-14, "covered");
    near(force_error(&c, 0, n), 0., 1e-14, "secondary force");
    for (int32_t j = 0; j < c.view.n_rows; ++j)
      near(c.view.gap[j], 0.02, 1e-14, "gap");
    /* By hand for node to segment: (8/9)^2 of a sixteenth at node (1, 1). */
    if (k == 0)
      near(force_error(&c, 1, n),
           fmax(17. / 81. / 16., 7. / 9. * 1. / 64.) * 1., 3e-3,
           "primary force");
    assert_true(force_error(&c, 1, n) > 1e-3);
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* Concentric spheres: gaps and covered area converge with the square of the
 * facet size at least. */
static void
test_spheres(void **state)
{
  (void)state;
  const double inner[3] = {1., 2., 0.8}, outer[3] = {1.03, 2., 1.};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
    {
      const int n_levels = i < 1 ? 3 : 2;
      double error[3] = {0.};
      for (int level = 0; level < n_levels; ++level)
      {
        const int32_t n = 4 << level;
        abut_coupling_options o = abut_coupling_defaults();
        o.discretisation = k == 0   ? ABUT_DISCRETISATION_DUAL_MORTAR
                           : k == 1 ? ABUT_DISCRETISATION_MORTAR
                                    : ABUT_DISCRETISATION_QUADRATURE_POINT;
        o.search.reach = 0.2;
        scene_mesh s = scene_patch(kinds[i], n, n, scene_sphere, inner, false),
                   m = scene_patch(kinds[i], n + n / 3, n + n / 3, scene_sphere,
                                   outer, true);
        couple c = couple_meshes(&s, &m, &o, NULL);
        check_rows(&c);
        if (k == 2 && kinds[i] != ABUT_FACET_QUAD9)
          check_balance(&c, 1e-11, 1e-11);
        assert_true(c.view.n_rows > n * n);
        error[level] = 0.;
        for (int32_t j = 0; j < c.view.n_rows; ++j)
          error[level] = fmax(error[level], fabs(c.view.gap[j] - 0.03));
        couple_destroy(&c);
        scene_free(&s);
        scene_free(&m);
      }
      for (int level = 1; level < n_levels; ++level)
        if (!(error[level] < error[level - 1] / 3.2))
          print_error("kind %d method %d: %g %g %g", i, k, error[0], error[1],
                      error[2]);
    }
}

/* A saddle z = a x y, as one warped facet, under its own mesh of finer facets a
 * little higher: fully covered, its area that of the saddle. */
static void
test_warped(void **state)
{
  (void)state;
  static const double slope[3] = {0.1, 0.6, 1.2};
  for (int k = 0; k < 3; ++k)
  {
    double x[12], y[75];
    int32_t nodes[4] = {0, 1, 2, 3}, fine[64], *f = fine;
    for (int a = 0; a < 4; ++a)
    {
      x[3 * a] = a % 2 - 0.5;
      x[3 * a + 1] = a / 2 - 0.5;
      x[3 * a + 2] = slope[k] * x[3 * a] * x[3 * a + 1];
    }
    for (int a = 0; a < 25; ++a)
    {
      y[3 * a] = 0.7 - 1.4 * (a % 5) / 4.;
      y[3 * a + 1] = -0.7 + 1.4 * (a / 5) / 4.;
      y[3 * a + 2] = slope[k] * y[3 * a] * y[3 * a + 1] + 0.01;
    }
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        for (int a = 0; a < 4; ++a)
          *f++ = 5 * (j + a / 2) + i + a % 2;
    scene_mesh s = {3, 4, 1, ABUT_FACET_QUAD4, x, nodes},
               m = {3, 25, 16, ABUT_FACET_QUAD4, y, fine};
    couple c = couple_meshes(&s, &m, NULL, NULL);
    check_rows(&c);
    check_balance(&c, 1e-13, 1.);
    /* Angle between the normals (-a/2, -a/2, 1) at a corner and e_z. */
    near(c.statistics.largest_warping, atan(slope[k] * sqrt(0.5)), 1e-12,
         "warping");
    assert_int_equal(c.view.n_rows, 4);
    /* Area by Gauss's rule with 40^2 midpoints, to their accuracy. */
    double area = 0.;
    for (int i = 0; i < 1600; ++i)
    {
      const double u = (i % 40 + 0.5) / 40 - 0.5, v = (i / 40 + 0.5) / 40 - 0.5;
      area += sqrt(1. + slope[k] * slope[k] * (u * u + v * v)) / 1600;
    }
    near(c.statistics.covered_area, area, 2e-3 * slope[k] * slope[k], "area");
    for (int32_t j = 0; j < 4; ++j)
      near(c.view.gap[j], 0.01, 0.01 * slope[k] * slope[k] + 1e-4, "gap");
    couple_destroy(&c);
  }
}

/* Make one node of nodes at one place. */
static void
merge_nodes(scene_mesh *m)
{
  for (int32_t e = 0; e < m->n_facets * 4; ++e)
    for (int32_t i = 0; i < m->connectivity[e]; ++i)
    {
      const double *x = m->position + 3 * i,
                   *y = m->position + 3 * m->connectivity[e];
      if (fabs(x[0] - y[0]) + fabs(x[1] - y[1]) + fabs(x[2] - y[2]) < 1e-10)
        m->connectivity[e] = i;
    }
}

/* A box in a box: nodes on edges and in corners are dropped, and the rows of
 * the faces have their directions and the whole area. */
static void
test_box(void **state)
{
  (void)state;
  const double lower[3] = {0., 0., 0.}, upper[3] = {1., 1., 1.},
               outer_lower[3] = {-0.01, -0.01, -0.01},
               outer_upper[3] = {1.01, 1.01, 1.01};
  for (int k = 0; k < 3; ++k)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.discretisation =
        k < 2 ? ABUT_DISCRETISATION_DUAL_MORTAR : ABUT_DISCRETISATION_MORTAR;
    o.search.relative_reach = 0.2;
    scene_mesh s = scene_box(lower, upper, k == 1 ? 1 : 3),
               m = scene_box(outer_lower, outer_upper, 4);
    merge_nodes(&s);
    for (int32_t f = 0; f < m.n_facets; ++f)
    {
      int32_t *c = m.connectivity + 4 * f, kept = c[1];
      c[1] = c[2];
      c[2] = kept;
    }
    couple c = couple_meshes(&s, &m, &o, NULL);
    check_rows(&c);
    near(c.statistics.covered_area, 6., 1e-13, "covered");
    /* With one facet per face there are only corners, which are kept. */
    assert_int_equal(c.view.n_rows, k == 1 ? 8 : 24);
    assert_int_equal(c.statistics.n_corners, k == 1 ? 0 : 8 + 12 * 2);
    assert_int_equal(c.statistics.n_bent, k == 1 ? 8 : 0);
    for (int32_t j = 0; j < c.view.n_rows && k != 1; ++j)
    {
      const double *n = c.view.normal + 3 * j, *x = c.view.position + 3 * j;
      near(c.view.gap[j], 0.01, 1e-14, "gap");
      for (int d = 0; d < 3; ++d)
        near(n[d],
             x[d] < 1e-14        ? -1.
             : x[d] > 1. - 1e-14 ? 1.
                                 : 0.,
             1e-14, "normal");
    }
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_flat, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_fields, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_matching, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_tri6, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_partly_covered, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_layers, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_points, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_spheres, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_warped, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_box, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
