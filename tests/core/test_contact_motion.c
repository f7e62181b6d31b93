/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Rotations by known angles, and displacements of affine motions at points. */
#include <abut/contact_motion.h>
/* Its arguments have names that the fixture has. */
#include "coupling_fixture.h"

/* Affine functions are exact on both sides: a common one leaves nothing of the
 * relative motion, and each side has its value at the point. */
static void
test_sums(void **state)
{
  (void)state;
  const double lower[4] = {0., 0., 1., 0.}, upper[4] = {1., 0., 0., 0.};
  scene_mesh a = scene_patch(ABUT_FACET_LINE2, 5, 1, scene_line, lower, false),
             b = scene_patch(ABUT_FACET_LINE2, 3, 1, scene_line, upper, false);
  abut_coupling_options options =
      mortar_options(ABUT_DISCRETISATION_DUAL_MORTAR, 1);
  couple c = couple_meshes(&a, &b, &options, NULL);
  const int32_t n_a = a.n_nodes, n_nodes = a.n_nodes + b.n_nodes;
  double value[32], sum[16], of_primary[16];
  int32_t point[8];
  assert_in_range(c.view.n_rows, 1, 8);
  for (int32_t i = 0; i < n_nodes; ++i)
  {
    const double x = i < n_a ? a.position[2 * i] : b.position[2 * (i - n_a)];
    value[2 * i] = 3. + 2. * x;
    value[2 * i + 1] = i < n_a ? 0.5 : -0.25;
  }
  for (int32_t i = 0; i < c.view.n_rows; ++i)
    point[i] = c.view.n_rows - 1 - i;
  require(abut_points_sum(c.points, ABUT_SIDE_BOTH, c.view.n_rows, point,
                          n_nodes, value, sum));
  for (int32_t i = 0; i < c.view.n_rows; ++i)
  {
    near(sum[2 * i], 0., 1e-14, "common motion");
    near(sum[2 * i + 1], 0.75, 1e-14, "relative motion");
  }
  require(abut_points_sum(c.points, ABUT_SIDE_SECONDARY, c.view.n_rows, point,
                          n_nodes, value, sum));
  require(abut_points_sum(c.points, ABUT_SIDE_PRIMARY, c.view.n_rows, point,
                          n_nodes, value, of_primary));
  for (int32_t i = 0; i < c.view.n_rows; ++i)
  {
    near(sum[2 * i + 1], 0.5, 1e-14, "secondary");
    near(of_primary[2 * i + 1], 0.25, 1e-14, "primary");
    near(sum[2 * i] + of_primary[2 * i], 0., 1e-14, "both");
  }
  assert_int_equal(
      abut_points_sum(c.points, ABUT_SIDE_BOTH, 1, point, 2, value, sum),
      ABUT_INVALID_ARGUMENT);
  point[0] = c.view.n_rows;
  assert_int_equal(
      abut_points_sum(c.points, ABUT_SIDE_BOTH, 1, point, n_nodes, value, sum),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_points_sum(c.points, ABUT_SIDE_BOTH, 1, NULL, n_nodes, value, sum),
      ABUT_INVALID_ARGUMENT);
  couple_destroy(&c);
  scene_free(&a);
  scene_free(&b);
}

/* Forces that rotate by known angles, of directions of any length. */
static void
test_directions(void **state)
{
  (void)state;
  for (int32_t dim = 2; dim <= 3; ++dim)
  {
    const double angle[3] = {0.1, 1.5, 3.1}, force[3] = {2., 0.5, 0.};
    double before[9] = {0.}, after[9] = {0.}, moment = 0., resultant[2] = {0.};
    abut_direction_change change = {0., 0., 0., {0., 0., 0.}};
    for (int i = 0; i < 3; ++i)
    {
      before[dim * i] = 3. + i;
      after[dim * i] = 0.1 * cos(angle[i]);
      after[dim * i + 1] = 0.1 * sin(angle[i]);
      moment += force[i] * angle[i];
      resultant[0] += force[i] * (cos(angle[i]) - 1.);
      resultant[1] += force[i] * sin(angle[i]);
    }
    /* In two parts, as different processes have them. */
    require(abut_direction_change_add(dim, 1, force, before, after, &change));
    require(abut_direction_change_add(dim, 2, force + 1, before + dim,
                                      after + dim, &change));
    near(change.force, 2.5, 1e-15, "force");
    near(change.sum, moment, 1e-14, "sum of angles");
    near(change.largest, 3.1, 1e-13, "largest angle");
    for (int d = 0; d < 2; ++d)
      near(change.change[d], resultant[d], 1e-15, "resultant");
    near(change.change[2], 0., 0., "resultant");
    assert_int_equal(
        abut_direction_change_add(dim, 1, NULL, before, after, &change),
        ABUT_INVALID_ARGUMENT);
    assert_int_equal(
        abut_direction_change_add(4, 1, force, before, after, &change),
        ABUT_INVALID_ARGUMENT);
  }
}

/* A square rotates as a whole, stretched besides; one corner is lifted. Only
 * facets with marked nodes count. */
static void
test_facets(void **state)
{
  (void)state;
  scene_mesh m = scene_square(ABUT_FACET_QUAD4, 3, 0., false),
             rotated = scene_square(ABUT_FACET_QUAD4, 3, 0., false);
  const double angles[3] = {0.7, 0., 0.4}, shift[3] = {3., 1., 2.};
  abut_surface *s = surface_of(&m);
  uint8_t marked[16] = {0};
  double angle = -1.;
  scene_move(&rotated, 2., angles, shift);
  require(
      abut_surface_rotation(s, marked, m.position, rotated.position, &angle));
  near(angle, 0., 0., "without marks");
  marked[5] = 1;
  require(
      abut_surface_rotation(s, marked, m.position, rotated.position, &angle));
  /* A rotation about the normal leaves it; the one about x is left. */
  near(angle, 0.4, 1e-14, "rotated");
  /* Node 15 is the corner of the last facet alone, and not of its triangle of
   * first corners; node 14 is. */
  memcpy(rotated.position, m.position, sizeof(double) * 48);
  rotated.position[3 * 14 + 2] = 1. / 3.;
  require(
      abut_surface_rotation(s, marked, m.position, rotated.position, &angle));
  near(angle, 0., 0., "elsewhere");
  marked[15] = 1;
  require(
      abut_surface_rotation(s, marked, m.position, rotated.position, &angle));
  near(angle, atan(1.), 1e-14, "lifted");
  assert_int_equal(
      abut_surface_rotation(s, NULL, m.position, m.position, &angle),
      ABUT_INVALID_ARGUMENT);
  require(abut_surface_destroy(&s));
  scene_free(&m);
  scene_free(&rotated);
}

/* The same of lines. */
static void
test_lines(void **state)
{
  (void)state;
  const double line[4] = {0., 0., 1., 0.};
  scene_mesh m = scene_patch(ABUT_FACET_LINE2, 2, 1, scene_line, line, false);
  abut_surface *s = surface_of(&m);
  const uint8_t marked[3] = {0, 0, 1};
  double after[6], angle = -1.;
  memcpy(after, m.position, sizeof(after));
  after[5] = -0.5;
  require(abut_surface_rotation(s, marked, m.position, after, &angle));
  near(angle, atan(1.), 1e-14, "bent down");
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_sums, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_directions, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_facets, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_lines, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
