/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A disc or a ball in the middle of flat facets: depths, widths and paths are
 * those of the circle. */
#include <abut/obstacle_facets.h>

#include "surface_fixture.h"

static abut_obstacle *
ball_at(int32_t dimension, double x, double y, double z, double radius)
{
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  abut_obstacle *obstacle = NULL;
  shape.dimension = dimension;
  shape.kind = ABUT_OBSTACLE_SPHERE;
  shape.point[0] = x;
  shape.point[1] = y;
  shape.point[2] = z;
  shape.radius = radius;
  require(abut_obstacle_create_shape(context, &shape, &obstacle));
  return obstacle;
}

/* Two facets of length 2 at height 0, outward downwards. */
static scene_mesh
two_facets(void)
{
  const double line[4] = {0., 0., 4., 0.};
  return scene_patch(ABUT_FACET_LINE2, 2, 1, scene_line, line, false);
}

static void
test_depth(void **state)
{
  (void)state;
  const double radius = 0.3, below = 0.1, gap = 0.05;
  scene_mesh mesh = two_facets();
  abut_surface *surface = surface_of(&mesh);
  abut_obstacle *disc = ball_at(2, 3., -below, 0., radius);
  abut_facet_samples samples = abut_facet_samples_defaults();
  abut_facet_depth found[2];
  int32_t n = -1;
  samples.gap = gap;
  for (int32_t k = 1; k <= 9; k += 2) /* the middle is one of the points */
  {
    samples.n = k;
    require(abut_obstacle_in_facets(disc, surface, &samples, found, &n));
    assert_int_equal(n, 1);
    assert_int_equal(found[0].facet, 1);
    require_near(found[0].depth, radius - below - gap, 1e-14);
    require_near(found[0].size, 2., 0.);
    require_near(found[0].place[0], 3., 1e-14);
    require_near(found[0].place[1], 0., 0.);
    /* Nodes are sqrt(1 + below^2) from the centre, the point below. */
    require_near(found[0].peak, radius - below - gap, 1e-14);
  }
  /* As many points as that miss it by their distance. */
  samples.n = 2;
  require(abut_obstacle_in_facets(disc, surface, &samples, found, &n));
  assert_int_equal(n, 0);
  const uint8_t wanted[2] = {1, 0};
  samples.n = 1;
  samples.wanted = wanted;
  require(abut_obstacle_in_facets(disc, surface, &samples, found, &n));
  assert_int_equal(n, 0);
  /* Moved away, and gaps that nodes see: then nothing is unseen. */
  double up[6];
  for (int i = 0; i < 3; ++i)
  {
    up[2 * i] = mesh.position[2 * i];
    up[2 * i + 1] = 1.;
  }
  samples.wanted = NULL;
  samples.position = up;
  require(abut_obstacle_in_facets(disc, surface, &samples, found, &n));
  assert_int_equal(n, 0);
  samples.position = NULL;
  samples.made = up;
  require(abut_obstacle_in_facets(disc, surface, &samples, found, &n));
  require_near(found[0].peak,
               fmin(radius - below - gap, sqrt(1. + 1.1 * 1.1) - 1.1), 1e-14);
  samples.n = 0;
  assert_int_equal(abut_obstacle_in_facets(disc, surface, &samples, found, &n),
                   ABUT_INVALID_ARGUMENT);
  require(abut_obstacle_destroy(&disc));
  require(abut_surface_destroy(&surface));
  scene_free(&mesh);
}

/* All kinds of facets in space see a ball in the middle of the only one. */
static void
test_kinds(void **state)
{
  (void)state;
  const abut_facet_kind kinds[3] = {ABUT_FACET_QUAD4, ABUT_FACET_QUAD9,
                                    ABUT_FACET_TRI3};
  for (int k = 0; k < 3; ++k)
  {
    scene_mesh mesh = scene_square(kinds[k], 1, 0., false);
    abut_surface *surface = surface_of(&mesh);
    /* One point is in the middle: the mean of the nodes. */
    const int32_t n_nodes = abut_facet_n_nodes(kinds[k]);
    double x = 0., y = 0.;
    for (int32_t a = 0; a < n_nodes; ++a)
    {
      x += mesh.position[3 * mesh.connectivity[a]] / n_nodes;
      y += mesh.position[3 * mesh.connectivity[a] + 1] / n_nodes;
    }
    abut_obstacle *ball = ball_at(3, x, y, 0., 0.1);
    abut_facet_samples samples = abut_facet_samples_defaults();
    abut_facet_depth found[2];
    int32_t n = 0;
    require(abut_obstacle_in_facets(ball, surface, &samples, found, &n));
    assert_int_equal(n, 1);
    require_near(found[0].depth, 0.1, 1e-14);
    require_near(found[0].place[0], x, 1e-14);
    require_near(found[0].place[1], y, 1e-14);
    require(abut_obstacle_destroy(&ball));
    require(abut_surface_destroy(&surface));
    scene_free(&mesh);
  }
}

/* A facet that jumps over a disc, while its nodes pass beside. */
static void
test_path(void **state)
{
  (void)state;
  scene_mesh mesh = two_facets();
  abut_surface *surface = surface_of(&mesh);
  abut_obstacle *disc = ball_at(2, 1., -0.5, 0., 0.2);
  double end[6];
  for (int i = 0; i < 3; ++i)
  {
    end[2 * i] = mesh.position[2 * i];
    end[2 * i + 1] = -1.25;
  }
  abut_facet_samples samples = abut_facet_samples_defaults();
  samples.position = end;
  samples.n = 3;
  double way = -1.;
  require(abut_obstacle_passes_facets(disc, surface, &samples, mesh.position,
                                      &way));
  require_near(way, 1.25, 1e-14);
  const uint8_t wanted[2] = {0, 1};
  samples.wanted = wanted;
  require(abut_obstacle_passes_facets(disc, surface, &samples, mesh.position,
                                      &way));
  require_near(way, 0., 0.);
  require(abut_obstacle_destroy(&disc));
  require(abut_surface_destroy(&surface));
  scene_free(&mesh);
}

static void
test_width(void **state)
{
  (void)state;
  scene_mesh mesh = two_facets();
  abut_surface *surface = surface_of(&mesh);
  abut_obstacle *disc = ball_at(2, 1., -0.5, 0., 0.2);
  abut_facet_samples samples = abut_facet_samples_defaults();
  abut_obstacle_beside beside;
  /* Both are near by their size of 2. */
  require(abut_obstacle_narrowest(disc, surface, &samples, &beside));
  require_near(beside.width, 0.4, 1e-14);
  require_near(beside.size, 2., 0.);
  const double above[2] = {1., -0.25}, aside[2] = {-0.5, -0.25},
               behind[2] = {1., 0.5};
  /* Outward is down. */
  require(abut_obstacle_beside_facet(disc, surface, &samples, above, &beside));
  assert_true(beside.is_over);
  require_near(beside.distance, 0.25, 1e-15);
  require_near(beside.width, 0.4, 1e-14);
  require(abut_obstacle_beside_facet(disc, surface, &samples, aside, &beside));
  assert_false(beside.is_over);
  require(abut_obstacle_beside_facet(disc, surface, &samples, behind, &beside));
  assert_false(beside.is_over);
  const uint8_t none[2] = {0, 0};
  samples.wanted = none;
  require(abut_obstacle_narrowest(disc, surface, &samples, &beside));
  assert_true(isinf(beside.width));
  require_near(beside.size, 1., 0.);
  assert_int_equal(
      abut_obstacle_beside_facet(disc, surface, &samples, NULL, &beside),
      ABUT_INVALID_ARGUMENT);
  require(abut_obstacle_destroy(&disc));
  require(abut_surface_destroy(&surface));
  scene_free(&mesh);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_depth, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_kinds, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_path, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_width, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
