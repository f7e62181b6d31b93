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
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation = discretisation;
  o.multiplier_degree = degree;
  scene_mesh s = plane(ks, n1, n1, unit, true),
             m = plane(km, n2, n2, above, false);
  couple c = couple_meshes(&s, &m, &o, NULL);
  check_rows(&c);
  check_balance(&c, 2e-13, 5e-13);
  near(force_error(&c, 0, n), 0., 1e-14, "secondary force");
  near(force_error(&c, 1, n), 0., 1e-14, "primary force");
  near(c.statistics.covered_area, 1., 1e-14, "covered");
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
    }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_flat, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
