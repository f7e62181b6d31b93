/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Coupling of curves: what is exact on flat interfaces for any pair of meshes,
 * and how fast curved ones converge. */
#include "coupling_fixture.h"

static const double odd_angle = 0.7310;

/* Curve of n facets from u0 to u1 along an inclined line, at the given height
 * above it; up: the outward normal points up. */
static scene_mesh
inclined(abut_facet_kind kind, int32_t n, double u0, double u1, double height,
         bool up)
{
  const double c = cos(odd_angle), s = sin(odd_angle);
  const double from = up ? u1 : u0, to = up ? u0 : u1;
  const double p[4] = {c * from - s * height, s * from + c * height,
                       c * to - s * height, s * to + c * height};
  return scene_patch(kind, n, 1, scene_line, p, false);
}

static const double up[2] = {-0.66763, 0.74449};

static void
inclined_normal(double *n)
{
  n[0] = -sin(odd_angle);
  n[1] = cos(odd_angle);
  assert_true(fabs(n[0] - up[0]) < 1e-4 && fabs(n[1] - up[1]) < 1e-4);
}

static int
gcd(int a, int b)
{
  return b == 0 ? a : gcd(b, a % b);
}

static const int sizes[][2] = {{3, 4}, {4, 5}, {4, 8}, {8, 4},
                               {2, 3}, {1, 7}, {7, 1}, {6, 6}};
static const abut_facet_kind kinds[2] = {ABUT_FACET_LINE2, ABUT_FACET_LINE3};

typedef struct method
{
  abut_discretisation discretisation;
  int32_t degree;
} method;

static const method mortars[] = {{ABUT_DISCRETISATION_DUAL_MORTAR, 0},
                                 {ABUT_DISCRETISATION_MORTAR, 0},
                                 {ABUT_DISCRETISATION_MORTAR, 1}};

static abut_coupling_options
options_of(const method *m)
{
  return mortar_options(m->discretisation, m->degree);
}

/* Gap, weights, and forces of a uniform pressure on both sides, of flat meshes
 * that cover each other, for all kinds and pairs of sizes. */
static void
test_flat(void **state)
{
  (void)state;
  double n[2];
  inclined_normal(n);
  for (int k = 0; k < 8; ++k)
    for (int ks = 0; ks < 2; ++ks)
      for (int km = 0; km < 2; ++km)
        for (int i = 0; i < 3; ++i)
        {
          const abut_coupling_options o = options_of(&mortars[i]);
          const int n1 = sizes[k][0], n2 = sizes[k][1];
          scene_mesh s = inclined(kinds[ks], n1, 0., 1., 0., true),
                     m = inclined(kinds[km], n2, 0., 1., 0.03, false);
          couple c = couple_meshes(&s, &m, &o, NULL);
          check_rows(&c);
          check_balance(&c, 1e-13, 1e-13);
          near(force_error(&c, 0, n), 0., 1e-14, "secondary force");
          near(force_error(&c, 1, n), 0., 1e-14, "primary force");
          near(c.statistics.covered_area, 1., 1e-14, "covered");
          near(c.statistics.full_area, 1., 1e-14, "full");
          assert_int_equal(c.view.n_rows, mortars[i].degree == 1 || ks == 0
                                              ? n1 + 1
                                              : 2 * n1 + 1);
          if (ks == 0 && km == 0)
            assert_int_equal(c.statistics.n_pairs, n1 + n2 - gcd(n1, n2));
          for (int32_t j = 0; j < c.view.n_rows; ++j)
          {
            near(c.view.gap[j], 0.03, 1e-14, "gap");
            near(c.view.weight[j], c.view.full_weight[j], 1e-14, "weight");
            if (mortars[i].discretisation == ABUT_DISCRETISATION_DUAL_MORTAR)
            {
              assert_int_equal(
                  c.view.secondary_start[j + 1] - c.view.secondary_start[j], 1);
              assert_int_equal(c.view.secondary_node[c.view.secondary_start[j]],
                               c.view.node[j]);
            }
          }
          couple_destroy(&c);
          scene_free(&s);
          scene_free(&m);
        }
}

/* q0 + q1 x + q2 y + q3 t^2, with t the coordinate along the line. */
static double
polynomial(const double *x, const void *data)
{
  const double *q = data;
  const double t = cos(odd_angle) * x[0] + sin(odd_angle) * x[1];
  return q[0] + q[1] * x[0] + q[2] * x[1] + q[3] * t * t;
}

/* Both sides see the same linear field in the same way, quadratic facets the
 * same quadratic one, where the surfaces coincide. With one entry on the
 * secondary side this says that dual functions are biorthogonal. */
static void
test_fields(void **state)
{
  (void)state;
  const double linear[4] = {0.3, -1.2, 0.7, 0.},
               quadratic[4] = {0.3, -1.2, 0.7, 1.9};
  for (int k = 0; k < 8; ++k)
    for (int kind = 0; kind < 2; ++kind)
      for (int i = 0; i < 3; ++i)
      {
        const abut_coupling_options o = options_of(&mortars[i]);
        scene_mesh s = inclined(kinds[kind], sizes[k][0], 0., 1., 0., true),
                   m = inclined(kinds[kind], sizes[k][1], -0.1, 1.2, 0., false);
        couple c = couple_meshes(&s, &m, &o, NULL);
        check_rows(&c);
        near(field_difference(&c, polynomial, kind == 0 ? linear : quadratic),
             0., 2e-14, "field");
        couple_destroy(&c);
        scene_free(&s);
        scene_free(&m);
      }
}

/* Over a plate that is not parallel dual rows see the gap at their nodes. */
static void
test_wedge(void **state)
{
  (void)state;
  const double below[4] = {1., 0., 0., 0.}, above[4] = {-0.3, 0.02, 1.4, 0.122};
  for (int kind = 0; kind < 2; ++kind)
  {
    scene_mesh s = scene_patch(kinds[kind], 5, 1, scene_line, below, false),
               m = scene_patch(kinds[1 - kind], 7, 1, scene_line, above, false);
    couple c = couple_meshes(&s, &m, NULL, NULL);
    assert_int_equal(c.view.n_rows, kind == 0 ? 6 : 11);
    check_rows(&c);
    check_balance(&c, 1e-13, 1e-13);
    for (int32_t j = 0; j < c.view.n_rows; ++j)
      near(c.view.gap[j], 0.02 + 0.06 * (c.view.position[2 * j] + 0.3), 1e-14,
           "gap");
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* Integral of the hat function of node i of a grid of n facets over [a, b]. */
static double
hat_integral(int n, int i, double a, double b)
{
  const double h = 1. / n, x = i * h;
  double sum = 0.;
  for (int side = 0; side < 2; ++side)
  {
    const double from = fmax(fmax(a, 0.), side == 0 ? x - h : x),
                 to = fmin(fmin(b, 1.), side == 0 ? x : x + h);
    if (to > from)
      sum += (to - from) * (1. - fabs(0.5 * (from + to) - x) / h);
  }
  return sum;
}

/* A primary that covers [a, b] only: the weights are the integrals over the
 * covered part and add up to it, and a uniform pressure still gives the
 * primary's consistent forces. */
static void
test_partly_covered(void **state)
{
  (void)state;
  static const double covered[][2] = {
      {0.37, 0.81}, {0.2, 0.6}, {0.33, 0.34}, {0.2001, 0.5}, {0.05, 0.999}};
  double n[2];
  inclined_normal(n);
  for (int k = 0; k < 5; ++k)
    for (int kind = 0; kind < 2; ++kind)
      for (int i = 0; i < 3; ++i)
      {
        const double a = covered[k][0], b = covered[k][1];
        abut_coupling_options o = options_of(&mortars[i]);
        o.search.reach = 0.1;
        scene_mesh s = inclined(kinds[kind], 5, 0., 1., 0., true),
                   m = inclined(kinds[kind], 3, a, b, 0.01, false);
        couple c = couple_meshes(&s, &m, &o, NULL);
        check_rows(&c);
        check_balance(&c, 1e-12, 1e-12);
        near(force_error(&c, 1, n), 0., 1e-14, "primary force");
        near(c.statistics.covered_area, b - a, 1e-14, "covered");
        near(c.statistics.full_area, 1., 1e-14, "full");
        double sum = 0.;
        for (int32_t j = 0; j < c.view.n_rows; ++j)
        {
          sum += c.view.weight[j];
          near(c.view.gap[j], 0.01, 1e-12, "gap");
          /* Nodes run from the far end. */
          if (kind == 0 && c.statistics.n_lumped == 0)
            near(c.view.weight[j], hat_integral(5, 5 - c.view.node[j], a, b),
                 1e-15, "weight");
        }
        near(sum, b - a, 1e-14, "sum of weights");
        couple_destroy(&c);
        scene_free(&s);
        scene_free(&m);
      }
}

/* Less than 1e-6 of a node's weight makes no row. */
static void
test_sliver(void **state)
{
  (void)state;
  for (int k = 0; k < 2; ++k)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.search.reach = 0.1;
    /* The node at 0.4 is covered from 0.6 - d on: d^2 / 2 / h of h. */
    const double d = k == 0 ? 1e-4 : 1e-3;
    scene_mesh s = inclined(ABUT_FACET_LINE2, 5, 0., 1., 0., true),
               m = inclined(ABUT_FACET_LINE2, 2, 0.6 - d, 1., 0.01, false);
    couple c = couple_meshes(&s, &m, &o, NULL);
    assert_int_equal(c.view.n_rows, k == 0 ? 3 : 4);
    assert_int_equal(c.statistics.n_weak, k == 0 ? 1 : 0);
    check_rows(&c);
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* A covered part below 1/1000 of a facet gets lumped functions. */
static void
test_lumped(void **state)
{
  (void)state;
  for (int k = 0; k < 2; ++k)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.search.reach = 0.1;
    const double d = 0.2 * (k == 0 ? 0.9e-3 : 1.1e-3);
    scene_mesh s = inclined(ABUT_FACET_LINE2, 5, 0., 1., 0., true),
               m = inclined(ABUT_FACET_LINE2, 2, 0.6 - d, 0.8, 0.01, false);
    couple c = couple_meshes(&s, &m, &o, NULL);
    assert_int_equal(c.statistics.n_lumped, k == 0 ? 1 : 0);
    check_rows(&c);
    near(c.statistics.covered_area, 0.2 + d, 1e-6 * 0.2, "covered");
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* Of two sheets over one spot the nearer has it. */
static void
test_layers(void **state)
{
  (void)state;
  double n[2];
  inclined_normal(n);
  for (int i = 0; i < 3; ++i)
    for (int below = 0; below < 2; ++below)
    {
      abut_coupling_options o = options_of(&mortars[i]);
      o.search.reach = 0.2;
      scene_mesh s = inclined(ABUT_FACET_LINE2, 5, 0., 1., 0., true),
                 near_one = inclined(ABUT_FACET_LINE2, 3, 0.33, 0.71,
                                     below ? -0.02 : 0.02, false),
                 far_one =
                     inclined(ABUT_FACET_LINE2, 4, -0.1, 1.1, 0.05, false);
      scene_mesh m = scene_join(far_one, near_one);
      couple c = couple_meshes(&s, &m, &o, NULL);
      check_rows(&c);
      near(c.statistics.covered_area, 1., 1e-14, "covered");
      assert_true(c.statistics.n_layers > 0);
      double force[2 * 9] = {0.}, sum[2] = {0.};
      nodal_forces(&c.view, 1, force);
      for (int l = 0; l < 9; ++l)
        for (int d = 0; d < 2; ++d)
          sum[l >= 5] += force[2 * l + d] * n[d];
      near(sum[1], 0.71 - 0.33, 1e-14, "force on the near sheet");
      near(sum[0], 1. - 0.38, 1e-14, "force on the far sheet");
      couple_destroy(&c);
      scene_free(&s);
      scene_free(&m);
    }
}

static int32_t
rows_of(const scene_mesh *s, const scene_mesh *m,
        const abut_coupling_options *o)
{
  couple c = couple_meshes(s, m, o, NULL);
  const int32_t n = c.view.n_rows;
  couple_destroy(&c);
  return n;
}

/* Facets that face the same way, are out of reach or too deep are not used. */
static void
test_filters(void **state)
{
  (void)state;
  for (int k = 0; k < ABUT_DISCRETISATION_N; ++k)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.discretisation = (abut_discretisation)k;
    o.search.relative_reach = 0.;
    o.search.reach = 0.1;
    scene_mesh s = inclined(ABUT_FACET_LINE2, 5, 0., 1., 0., true);
    scene_mesh same = inclined(ABUT_FACET_LINE2, 4, -0.1, 1.1, 0.02, true);
    assert_int_equal(rows_of(&s, &same, &o), 0);
    const double height[] = {0.099, 0.101, -0.099, -0.101};
    for (int i = 0; i < 4; ++i)
    {
      scene_mesh m = inclined(ABUT_FACET_LINE2, 4, -0.1, 1.1, height[i], false);
      assert_int_equal(rows_of(&s, &m, &o) > 0, i % 2 == 0);
      o.thickness = 0.19;
      assert_int_equal(rows_of(&s, &m, &o) > 0, i == 0);
      o.thickness = 0.;
      scene_free(&m);
    }
    scene_free(&same);
    scene_free(&s);
  }
}

/* Forces on the primary by node to segment: each node's tributary length at
 * the primary's hat functions, which is not the consistent force, whatever the
 * mesh size; 4 over 8 leaves out every second node, 8 over 4 is exact because
 * the meshes are nested. */
static void
test_node_to_segment(void **state)
{
  (void)state;
  static const int sizes_and_error[][2] = {{3, 4}, {6, 8}, {4, 8}, {8, 4}};
  static const double expected[4] = {1. / 9., 1. / 3., 1., 0.};
  double n[2];
  inclined_normal(n);
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation = ABUT_DISCRETISATION_NODE_TO_SEGMENT;
  for (int k = 0; k < 4; ++k)
  {
    const int n1 = sizes_and_error[k][0], n2 = sizes_and_error[k][1];
    scene_mesh s = inclined(ABUT_FACET_LINE2, n1, 0., 1., 0., true),
               m = inclined(ABUT_FACET_LINE2, n2, 0., 1., 0., false);
    couple c = couple_meshes(&s, &m, &o, NULL);
    check_rows(&c);
    check_balance(&c, 1e-13, 1e-13);
    near(force_error(&c, 0, n), 0., 1e-14, "secondary force");
    double force[2 * 9] = {0.}, worst = 0.;
    nodal_forces(&c.view, 1, force);
    for (int l = 0; l <= n2; ++l)
    {
      double sum = 0.;
      for (int j = 0; j <= n1; ++j)
        sum += (j == 0 || j == n1 ? 0.5 : 1.) / n1
               * fmax(0., 1. - fabs((double)j / n1 - (double)l / n2) * n2);
      const double f = force[2 * l] * n[0] + force[2 * l + 1] * n[1];
      near(f, sum, 1e-14, "force by hand");
      if (l > 0 && l < n2)
        worst = fmax(worst, fabs(f * n2 - 1.));
    }
    near(worst, expected[k], 1e-12, "error inside");
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* Rows at the points of whole facets: weights of the rule, forces in balance,
 * the gap along the normal. */
static void
test_quadrature_points(void **state)
{
  (void)state;
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation = ABUT_DISCRETISATION_QUADRATURE_POINT;
  o.segments = false;
  o.search.reach = 0.2;
  for (int kind = 0; kind < 2; ++kind)
  {
    const double below[4] = {1., 0., 0., 0.},
                 above[4] = {-0.3, 0.02, 1.4, 0.122};
    scene_mesh s = scene_patch(kinds[kind], 5, 1, scene_line, below, false),
               m = scene_patch(kinds[1 - kind], 7, 1, scene_line, above, false);
    couple c = couple_meshes(&s, &m, &o, NULL);
    assert_int_equal(c.view.n_rows, 5 * (kind == 0 ? 2 : 3));
    check_rows(&c);
    check_balance(&c, 1e-13, 1e-13);
    near(c.statistics.covered_area, 1., 1e-14, "covered");
    for (int32_t j = 0; j < c.view.n_rows; ++j)
    {
      assert_int_equal(c.view.node[j], -1);
      assert_int_equal(c.view.facet[j], j / (kind == 0 ? 2 : 3));
      near(c.view.gap[j], 0.02 + 0.06 * (c.view.position[2 * j] + 0.3), 1e-14,
           "gap");
    }
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* Rows at points of the common segments: a uniform pressure is exact, forces
 * and moments balance, the gap is that along the normal; two points per segment
 * of straight lines. */
static void
test_points_of_segments(void **state)
{
  (void)state;
  double n[2];
  inclined_normal(n);
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation = ABUT_DISCRETISATION_QUADRATURE_POINT;
  for (int k = 0; k < 8; ++k)
    for (int kind = 0; kind < 4; ++kind)
    {
      const int n1 = sizes[k][0], n2 = sizes[k][1];
      scene_mesh s = inclined(kinds[kind / 2], n1, 0., 1., 0., true),
                 m = inclined(kinds[kind % 2], n2, 0., 1., 0.03, false);
      couple c = couple_meshes(&s, &m, &o, NULL);
      check_rows(&c);
      check_balance(&c, 1e-12, 1e-12);
      near(force_error(&c, 0, n), 0., 1e-14, "secondary force");
      near(force_error(&c, 1, n), 0., 1e-14, "primary force");
      near(c.statistics.covered_area, 1., 1e-14, "covered");
      if (kind == 0)
        assert_int_equal(c.view.n_rows, 2 * (n1 + n2 - gcd(n1, n2)));
      for (int32_t j = 0; j < c.view.n_rows; ++j)
      {
        assert_int_equal(c.view.node[j], -1);
        assert_int_equal(c.view.point[j],
                         j > 0 && c.view.facet[j] == c.view.facet[j - 1]
                             ? c.view.point[j - 1] + 1
                             : 0);
        near(c.view.gap[j], 0.03, 1e-14, "gap");
      }
      couple_destroy(&c);
      scene_free(&s);
      scene_free(&m);
    }
}

/* Integration over whole facets: balanced, but a uniform pressure is not
 * transferred exactly. */
static void
test_without_segments(void **state)
{
  (void)state;
  double n[2];
  inclined_normal(n);
  abut_coupling_options o = abut_coupling_defaults();
  o.segments = false;
  scene_mesh s = inclined(ABUT_FACET_LINE2, 3, 0., 1., 0., true),
             m = inclined(ABUT_FACET_LINE2, 4, 0., 1., 0., false);
  couple c = couple_meshes(&s, &m, &o, NULL);
  check_rows(&c);
  check_balance(&c, 1e-13, 1e-13);
  near(force_error(&c, 0, n), 0., 1e-14, "secondary force");
  const double error = force_error(&c, 1, n);
  assert_true(error > 1e-4 * 0.25 && error < 5e-2 * 0.25);
  couple_destroy(&c);
  scene_free(&s);
  scene_free(&m);
}

/* Concentric arcs: the gap converges with the square of the facet size at
 * least, and the weights to the length of the arc. */
static void
test_arcs(void **state)
{
  (void)state;
  const double inner[5] = {0.2, -0.1, 1., 0.3, 1.5},
               outer[5] = {0.2, -0.1, 1.03, 0.1, 1.7};
  for (int kind = 0; kind < 2; ++kind)
    for (int i = 0; i < 4; ++i)
    {
      double error[3], area[3];
      for (int level = 0; level < 3; ++level)
      {
        const int32_t n = 6 << level;
        abut_coupling_options o = abut_coupling_defaults();
        if (i < 3)
          o = options_of(&mortars[i]);
        else
          o.discretisation = ABUT_DISCRETISATION_QUADRATURE_POINT;
        o.search.reach = 0.1;
        scene_mesh s = scene_patch(kinds[kind], n, 1, scene_arc, inner, false),
                   m = scene_patch(kinds[kind], n + n / 3, 1, scene_arc, outer,
                                   true);
        couple c = couple_meshes(&s, &m, &o, NULL);
        check_rows(&c);
        if (i == 3 && kind == 0)
          check_balance(&c, 1e-11, 1e-11);
        assert_true(c.view.n_rows > n);
        error[level] = 0.;
        for (int32_t j = 0; j < c.view.n_rows; ++j)
          error[level] = fmax(error[level], fabs(c.view.gap[j] - 0.03));
        area[level] = fabs(c.statistics.covered_area - 1.2);
        couple_destroy(&c);
        scene_free(&s);
        scene_free(&m);
      }
      for (int level = 1; level < 3; ++level)
      {
        assert_true(error[level] < error[level - 1] / 3.4);
        assert_true(area[level] < area[level - 1] / 3.4);
      }
    }
}

/* Bodies of revolution: areas of a disc and of a cone, consistent forces on the
 * primary from 2 pi int r N dr. */
static void
test_axisymmetric(void **state)
{
  (void)state;
  const double pi = acos(-1.);
  for (int i = 0; i < 3; ++i)
    for (int kind = 0; kind < 2; ++kind)
    {
      abut_coupling_options o = options_of(&mortars[i]);
      o.axisymmetric = true;
      const double disc[4] = {1., 0., 0., 0.}, over[4] = {0., 0., 1., 0.},
                   cone[4] = {2., 3., 0.5, 5.}, hood[4] = {0.5, 5., 2., 3.};
      scene_mesh s = scene_patch(kinds[kind], 3, 1, scene_line, disc, false),
                 m = scene_patch(ABUT_FACET_LINE2, 4, 1, scene_line, over,
                                 false);
      couple c = couple_meshes(&s, &m, &o, NULL);
      check_rows(&c);
      near(c.statistics.covered_area, pi, 1e-14 * pi, "disc");
      double force[2 * 5] = {0.};
      const double h = 0.25;
      nodal_forces(&c.view, 1, force);
      for (int l = 0; l < 5; ++l)
        near(force[2 * l + 1],
             2. * pi
                 * (l == 0   ? h * h / 6.
                    : l == 4 ? h / 2. - h * h / 6.
                             : l * h * h),
             1e-14, "ring force");
      couple_destroy(&c);
      scene_free(&s);
      scene_free(&m);
      s = scene_patch(kinds[kind], 3, 1, scene_line, cone, false);
      m = scene_patch(ABUT_FACET_LINE2, 5, 1, scene_line, hood, false);
      c = couple_meshes(&s, &m, &o, NULL);
      near(c.statistics.covered_area, pi * 2.5 * 2.5, 1e-13, "cone");
      couple_destroy(&c);
      scene_free(&s);
      scene_free(&m);
    }
}

/* Rows at nodes: all have the area of their shape functions, but that on the
 * axis, which quadratic facets give none: it has a sixtieth of the ring. */
static void
test_node_on_the_axis(void **state)
{
  (void)state;
  const double pi = acos(-1.);
  const double disc[4] = {1., 0., 0., 0.}, over[4] = {0., 0., 1., 0.};
  for (int kind = 0; kind < 2; ++kind)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.search.relative_reach = 0.1;
    o.discretisation = ABUT_DISCRETISATION_NODE_TO_SEGMENT;
    o.axisymmetric = true;
    scene_mesh s = scene_patch(kinds[kind], 3, 1, scene_line, disc, false),
               m = scene_patch(ABUT_FACET_LINE2, 4, 1, scene_line, over, false);
    couple c = couple_meshes(&s, &m, &o, NULL);
    const bool quadratic = kinds[kind] == ABUT_FACET_LINE3;
    assert_int_equal(c.view.n_rows, quadratic ? 7 : 4);
    double sum = 0., least = 1.;
    for (int32_t i = 0; i < c.view.n_rows; ++i)
    {
      sum += c.view.weight[i];
      least = fmin(least, c.view.weight[i]);
    }
    const double ring = 2. * pi / 9.;
    near(least, quadratic ? ring / 60. : ring / 6., 1e-14,
         "weight on the axis");
    near(sum, pi + (quadratic ? ring / 60. : 0.), 1e-14 * pi, "disc");
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* Mortar has no row at a node without area on the axis, whatever the round-off
 * of its integral: the row of all others has at least the area of a corner's
 * function in its ring, 2 pi r L / 6, less the change of r. */
static void
test_mortar_on_the_axis(void **state)
{
  (void)state;
  const double pi = acos(-1.);
  for (int i = 0; i < 2; ++i)
    for (int k = 1; k <= 40; ++k)
    {
      abut_coupling_options o = options_of(&mortars[i]);
      o.axisymmetric = true;
      const double r = 0.37 * k, third = r / 3.;
      const double disc[4] = {r, 0., 0., 0.1 * r},
                   over[4] = {0., 0.1 * r, r, 0.};
      scene_mesh s = scene_patch(ABUT_FACET_LINE3, 3, 1, scene_line, disc,
                                 false),
                 m = scene_patch(ABUT_FACET_LINE3, 4, 1, scene_line, over,
                                 false);
      couple c = couple_meshes(&s, &m, &o, NULL);
      check_rows(&c);
      assert_int_equal(c.view.n_rows, 6);
      for (int32_t row = 0; row < c.view.n_rows; ++row)
        assert_true(c.view.weight[row] > 2. * pi * third * third / 6.);
      const double slant = sqrt(1.01);
      near(c.statistics.covered_area, pi * r * r * slant, 1e-13 * r * r,
           "cone");
      couple_destroy(&c);
      scene_free(&s);
      scene_free(&m);
    }
}

/* A square punch on a plane: the rows at its corners have the normal of the
 * covered side, not the average of the two. */
static void
test_corner(void **state)
{
  (void)state;
  double x[8] = {1., 1., 1., 0., 0., 0., 0., 1.};
  int32_t nodes[6] = {1, 0, 2, 1, 3, 2};
  scene_mesh s = {2, 4, 3, ABUT_FACET_LINE2, x, nodes};
  const double below[4] = {2., -0.01, -1., -0.01};
  scene_mesh m = scene_patch(ABUT_FACET_LINE2, 4, 1, scene_line, below, false);
  abut_coupling_options o = abut_coupling_defaults();
  o.search.relative_reach = 0.1;
  couple c = couple_meshes(&s, &m, &o, NULL);
  check_rows(&c);
  assert_int_equal(c.view.n_rows, 2);
  assert_int_equal(c.statistics.n_split, 2);
  near(c.statistics.covered_area, 1., 1e-15, "covered");
  for (int32_t j = 0; j < 2; ++j)
  {
    near(c.view.normal[2 * j + 1], -1., 1e-15, "normal");
    near(c.view.gap[j], 0.01, 1e-15, "gap");
  }
  couple_destroy(&c);
  scene_free(&m);
}

/* The punch in a groove that fits it: each corner is covered on both sides. */
static void
test_groove(void **state)
{
  (void)state;
  double x[8] = {1., 1., 1., 0., 0., 0., 0., 1.};
  double y[8] = {-0.01, 1., -0.01, -0.01, 1.01, -0.01, 1.01, 1.};
  int32_t nodes[6] = {1, 0, 2, 1, 3, 2};
  int32_t groove[6] = {1, 0, 2, 1, 3, 2};
  const uint8_t dropped[4] = {0, 1, 1, 0};
  scene_mesh s = {2, 4, 3, ABUT_FACET_LINE2, x, nodes},
             m = {2, 4, 3, ABUT_FACET_LINE2, y, groove};
  abut_coupling_nodes n = abut_coupling_nodes_defaults();
  couple c = couple_meshes(&s, &m, NULL, &n);
  check_rows(&c);
  assert_int_equal(c.view.n_rows, 4);
  assert_int_equal(c.statistics.n_bent, 2);
  near(c.statistics.covered_area, 3., 1e-14, "covered");
  for (int32_t j = 0; j < 4; ++j)
    near(c.view.normal[2 * j], (j < 2 ? 1. : -1.) * (j % 3 ? sqrt(.5) : 1.),
         1e-14, "normal");
  /* Without the corners the sides are held by their upper ends. */
  n.dropped = dropped;
  couple_build(&c, &n);
  check_rows(&c);
  assert_int_equal(c.view.n_rows, 2);
  assert_int_equal(c.statistics.n_bent, 0);
  near(c.statistics.covered_area, 2., 1e-14, "covered");
  couple_destroy(&c);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_flat, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_fields, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_wedge, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_partly_covered, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_sliver, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_lumped, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_layers, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_filters, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_node_to_segment, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_quadrature_points, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(test_points_of_segments, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(test_without_segments, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_arcs, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_axisymmetric, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_mortar_on_the_axis, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(test_node_on_the_axis, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_corner, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_groove, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
