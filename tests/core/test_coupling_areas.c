/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Points of surfaces that are not where weights are measured: the gaps are of
 * where they are, the weights of where they were. */
#include "coupling_fixture.h"

static const abut_discretisation ways[] = {
    ABUT_DISCRETISATION_DUAL_MORTAR, ABUT_DISCRETISATION_MORTAR,
    ABUT_DISCRETISATION_NODE_TO_SEGMENT, ABUT_DISCRETISATION_QUADRATURE_POINT};

/* Flat, along the first axes, at a height. */
static scene_mesh
sheet(abut_facet_kind kind, int32_t n, double height, bool up)
{
  const double line[4] = {up ? 1. : 0., height, up ? 0. : 1., height},
               plane[5] = {0., 0., 1., 1., height};
  return abut_facet_dimension(kind) == 2
             ? scene_patch(kind, n, 1, scene_line, line, false)
             : scene_patch(kind, n, n, scene_plane, plane, !up);
}

/* Stretch it by a quarter along the first axis and carry it far away, the last
 * axis by a distance of its own. */
static void
carry(scene_mesh *mesh, double rise)
{
  for (int32_t n = 0; n < mesh->n_nodes; ++n)
  {
    double *x = mesh->position + (int64_t)n * mesh->dimension;
    x[0] = 1.25 * x[0] + 7.;
    x[mesh->dimension - 1] += rise;
  }
}

static void
check_carried(abut_facet_kind kind, abut_discretisation way, bool segments)
{
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation = way;
  o.segments = segments;
  scene_mesh s = sheet(kind, 3, 0., true), m = sheet(kind, 4, 0.02, false);
  couple c = couple_meshes(&s, &m, &o, NULL);
  const int32_t n = c.view.n_rows, size = s.n_nodes * s.dimension;
  assert_true(n > 0);
  double *weight = malloc(sizeof(double) * (size_t)n),
         *before = malloc(sizeof(double) * (size_t)size);
  memcpy(weight, c.view.weight, sizeof(double) * (size_t)n);
  memcpy(before, s.position, sizeof(double) * (size_t)size);
  carry(&s, -3.);
  carry(&m, -3.01);
  require(abut_surface_update(c.secondary, s.position));
  require(abut_surface_update(c.primary, m.position));
  require(abut_points_clear(c.points));
  abut_coupling_target target = abut_coupling_target_defaults(c.points);
  target.kinematics = ABUT_KINEMATICS_UPDATED;
  target.reference = before;
  require(abut_coupling_build(c.coupling, NULL, 0., &target));
  couple_look(&c);
  check_rows(&c);
  assert_int_equal(c.view.n_rows, n);
  for (int32_t i = 0; i < n; ++i)
  {
    near(c.view.weight[i], weight[i], 1e-13, "weight of before");
    near(c.view.gap[i], 0.01, 1e-13, "gap of now");
  }
  near(c.statistics.full_area, 1., 1e-13, "area of before");
  target.reference = NULL;
  assert_true(abut_coupling_build(c.coupling, NULL, 0., &target) > 0);
  couple_destroy(&c);
  scene_free(&s);
  scene_free(&m);
  free(weight);
  free(before);
}

static void
test_carried(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[] = {ABUT_FACET_LINE2, ABUT_FACET_LINE3,
                                          ABUT_FACET_TRI3, ABUT_FACET_QUAD4};
  for (size_t k = 0; k < sizeof(kinds) / sizeof(kinds[0]); ++k)
    for (size_t w = 0; w < sizeof(ways) / sizeof(ways[0]); ++w)
    {
      check_carried(kinds[k], ways[w], true);
      if (ways[w] != ABUT_DISCRETISATION_NODE_TO_SEGMENT)
        check_carried(kinds[k], ways[w], false);
    }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_carried, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
