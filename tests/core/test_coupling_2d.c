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
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation = m->discretisation;
  o.multiplier_degree = m->degree;
  return o;
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

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_flat, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
