/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Sides at known distances, obstacles before and behind a surface, a surface
 * with one bend, and nodes that two pairs have points at. */
#include <abut/pair_checks.h>

#include "surface_fixture.h"

static scene_mesh
line(double x0, double y0, double x1, double y1, int32_t n)
{
  const double p[4] = {x0, y0, x1, y1};
  return scene_patch(ABUT_FACET_LINE2, n, 1, scene_line, p, false);
}

static void
test_nearest(void **state)
{
  (void)state;
  abut_detection_options options = abut_detection_defaults();
  options.search.reach = 10.;
  for (int k = 0; k < 3; ++k)
  {
    /* The body of the upper one is above, of the lower one below; the third
     * faces away. */
    const double height = k == 1 ? -0.25 : 0.25;
    scene_mesh a = line(0., height, 1., height, 4),
               b = k == 2 ? line(0., 0., 1., 0., 3) : line(1., 0., 0., 0., 3);
    abut_surface *secondary = surface_of(&a), *primary = surface_of(&b);
    double above = 0., below = 0.;
    require(abut_surface_nearest(context, secondary, primary, &options, &above,
                                 &below));
    require_near(k == 0 ? above : 0.25, 0.25, 1e-14);
    require_near(k == 1 ? below : 0.25, 0.25, 1e-14);
    assert_int_equal(isinf(above) != 0, k != 0);
    assert_int_equal(isinf(below) != 0, k != 1);
    assert_int_equal(abut_surface_nearest(context, secondary, primary, &options,
                                          NULL, &below),
                     ABUT_INVALID_ARGUMENT);
    require(abut_surface_destroy(&secondary));
    require(abut_surface_destroy(&primary));
    scene_free(&a);
    scene_free(&b);
  }
}

/* A half space, above or below the surface, whose outward normal is down. */
static void
test_facing(void **state)
{
  (void)state;
  scene_mesh a = line(0., 0., 1., 0., 4);
  abut_surface *surface = surface_of(&a);
  for (int k = 0; k < 3; ++k)
  {
    /* Material below with its normal up, opposite; material above at 0.2 and at
     * 0.6 with its normal down, in the body. */
    const double height[3] = {-0.1, 0.2, 0.6};
    abut_obstacle_shape plane = abut_obstacle_shape_defaults();
    plane.dimension = 2;
    plane.axis[0] = 0.;
    plane.axis[1] = k == 0 ? 1. : -1.;
    plane.point[1] = height[k];
    abut_obstacle *obstacle = NULL;
    require(abut_obstacle_create_shape(context, &plane, &obstacle));
    int32_t same = -1, material = -1;
    require(abut_obstacle_faces_away(obstacle, surface, NULL, 0.5, &same,
                                     &material));
    assert_int_equal(same, k == 0 ? 0 : 5);
    assert_int_equal(material, k == 1 ? 5 : 0);
    const uint8_t wanted[5] = {0, 1, 0, 0, 1};
    require(abut_obstacle_faces_away(obstacle, surface, wanted, 1., &same,
                                     &material));
    assert_int_equal(same, k == 0 ? 0 : 2);
    assert_int_equal(material, k == 0 ? 0 : 2);
    assert_int_equal(abut_obstacle_faces_away(obstacle, surface, NULL, -1.,
                                              &same, &material),
                     ABUT_INVALID_ARGUMENT);
    require(abut_obstacle_destroy(&obstacle));
  }
  require(abut_surface_destroy(&surface));
  scene_free(&a);
}

/* An arc of facets that bend by 36 degrees. */
static void
test_bends(void **state)
{
  (void)state;
  const double degree = 3.14159265358979323846 / 180.,
               arc[5] = {0., 0., 1., 0., 180. * degree};
  scene_mesh a = scene_patch(ABUT_FACET_LINE2, 5, 1, scene_arc, arc, false);
  abut_surface *surface = surface_of(&a);
  uint8_t marked[6] = {0, 0, 1, 0, 0, 0};
  bool bends = false;
  require(abut_surface_bends(surface, 35. * degree, marked, &bends));
  assert_true(bends);
  require(abut_surface_bends(surface, 37. * degree, marked, &bends));
  assert_false(bends);
  marked[2] = 0;
  require(abut_surface_bends(surface, 35. * degree, marked, &bends));
  assert_false(bends);
  assert_int_equal(abut_surface_bends(surface, 1., NULL, &bends),
                   ABUT_INVALID_ARGUMENT);
  require(abut_surface_destroy(&surface));
  scene_free(&a);
}

static void
test_nearest_pair(void **state)
{
  (void)state;
  const int32_t node[6] = {0, 1, 2, 0, 1, -1}, pair[6] = {0, 0, 0, 1, 1, 1};
  const double gap[6] = {0.2, -0.1, 0.3, -0.1, 0.1 * (1. - 1e-12), 0.},
               frame[2] = {0., -1.}, zero = 0.;
  const int32_t any = 3;
  const double one = 1.;
  abut_points *points = NULL;
  require(abut_points_create(context, 2, &points));
  for (int i = 0; i < 6; ++i)
  {
    abut_point point = abut_point_defaults();
    point.id = i;
    point.frame = frame;
    point.gap = &zero;
    point.n_nodes = point.n_secondary = 1;
    point.node = &any;
    point.coefficient = &one;
    require(abut_points_append(points, &point));
    abut_place place = abut_place_defaults();
    place.node = node[i];
    place.pair = pair[i];
    place.position = frame;
    require(abut_points_append_place(points, &place));
  }
  int32_t nearest[4];
  require(abut_points_nearest_pair(points, gap, 4, nearest));
  const int32_t expected[4] = {1, 0, 0, -1};
  for (int n = 0; n < 4; ++n)
    assert_int_equal(nearest[n], expected[n]);
  assert_int_equal(abut_points_nearest_pair(points, gap, 2, nearest),
                   ABUT_INVALID_ARGUMENT);
  require(abut_points_destroy(&points));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_nearest, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_facing, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_bends, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_nearest_pair, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
