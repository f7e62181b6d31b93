/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Sums of friction, and points that share a node, of points put together by
 * hand: expected figures are those of the numbers below. */
#include <abut/friction_points.h>
#include <abut/law.h>
/* Its arguments have names that the fixture has. */
#include "coupling_fixture.h"

enum
{
  MOST = 8
};

/* Points with places, of that many pairs. */
typedef struct scene
{
  abut_points *points;
  int32_t n_pairs;
} scene;

static void
open_scene(scene *s, int32_t n_pairs)
{
  memset(s, 0, sizeof(*s));
  require(abut_points_create(context, 2, &s->points));
  s->n_pairs = n_pairs;
}

/* A point of two components whose normal is at an angle. */
static void
add(scene *s, int32_t pair, int32_t node, double angle, double gap,
    double weight, abut_point_kind kind)
{
  abut_points_view v;
  const double c = cos(angle), d = sin(angle), frame[4] = {-d, -c, c, -d},
               gaps[2] = {gap, 0.}, one = 1.;
  const int32_t own = node < 0 ? 9 : node;
  abut_point point = abut_point_defaults();
  require(abut_points_get(s->points, &v));
  assert_true(v.n_points < MOST);
  point.id = 10 * v.n_points;
  point.kind = kind;
  point.n_components = 2;
  point.weight = weight;
  point.frame = frame;
  point.gap = gaps;
  point.n_nodes = point.n_secondary = 1;
  point.node = &own;
  point.coefficient = &one;
  require(abut_points_append(s->points, &point));
  abut_place place = abut_place_defaults();
  place.pair = pair;
  place.node = node;
  place.position = frame;
  require(abut_points_append_place(s->points, &place));
}

static void
close_scene(scene *s)
{
  require(abut_points_destroy(&s->points));
}

/* A point that slips, one that sticks, one that is open, a tie, and the one
 * point of another pair. */
static void
test_sums(void **state)
{
  (void)state;
  scene s;
  open_scene(&s, 3);
  add(&s, 0, 0, 0., 0., 2., ABUT_POINT_CONTACT);
  add(&s, 0, 1, 0., 0., 3., ABUT_POINT_CONTACT);
  add(&s, 0, 2, 0., 0., 4., ABUT_POINT_CONTACT);
  add(&s, 0, 3, 0., 0., 5., ABUT_POINT_TIE);
  add(&s, 2, -1, 0., 0., 0.5, ABUT_POINT_CONTACT);
  const double value[10] = {10., -3., 20., 4., 0., 0., 100., 50., 8., 1.},
               slip[10] = {0., 0.25, 0., 7., 0., 0., 0., 0., 0., -2.};
  const uint8_t states[10] = {ABUT_STATE_SLIP, 0, ABUT_STATE_CLOSED, 0,
                              ABUT_STATE_OPEN, 0, ABUT_STATE_CLOSED, 0,
                              ABUT_STATE_SLIP, 0};
  abut_friction_sums sums[3];
  require(abut_points_friction(s.points, s.n_pairs, value, slip, states, sums));
  near(sums[0].normal_force, 2. * 10. + 3. * 20., 1e-14, "sum");
  near(sums[0].friction_force, 2. * 3. + 3. * 4., 1e-14, "sum");
  near(sums[0].traction, 4., 0., "sum");
  near(sums[0].dissipation, 2. * 3. * 0.25, 1e-14, "sum");
  near(sums[0].force[0], 2. * -3. + 3. * 4., 1e-14, "sum");
  near(sums[0].force[1], 0., 1e-14, "sum");
  near(sums[0].shared_stick_force, 0., 0., "sum");
  assert_int_equal(sums[0].n_slipping, 1);
  near(sums[1].normal_force, 0., 0., "sum");
  near(sums[2].friction_force, 0.5, 0., "sum");
  near(sums[2].dissipation, 0.5 * 2., 0., "sum");
  /* Work that a law puts in is no dissipation. */
  const double back[10] = {0., -0.25};
  require(abut_points_friction(s.points, s.n_pairs, value, back, states, sums));
  near(sums[0].dissipation, 0., 0., "sum");
  require(abut_points_friction(s.points, s.n_pairs, value, slip, NULL, sums));
  assert_int_equal(sums[0].n_slipping, 0);
  near(sums[0].friction_force, 2. * 3. + 3. * 4., 1e-14, "sum");
  close_scene(&s);
}

/* In a corner two points of a node are closed: what sticks there shares its
 * node. */
static void
test_corner(void **state)
{
  (void)state;
  scene s;
  open_scene(&s, 2);
  add(&s, 0, 4, 0., 0., 2., ABUT_POINT_CONTACT);
  add(&s, 1, 4, 1.5, 0., 3., ABUT_POINT_CONTACT);
  add(&s, 1, 5, 1.5, 0., 7., ABUT_POINT_CONTACT);
  const double value[6] = {10., 1., 20., 1., 30., 1.}, slip[6] = {0.};
  uint8_t states[6] = {ABUT_STATE_CLOSED, 0, ABUT_STATE_SLIP, 0,
                       ABUT_STATE_CLOSED, 0};
  abut_friction_sums sums[2];
  require(abut_points_friction(s.points, s.n_pairs, value, slip, states, sums));
  near(sums[0].shared_stick_force, 2. * 10., 0., "sum");
  near(sums[1].shared_stick_force, 0., 0., "sum");
  states[2] = ABUT_STATE_OPEN;
  require(abut_points_friction(s.points, s.n_pairs, value, slip, states, sums));
  near(sums[0].shared_stick_force, 0., 0., "sum");
  close_scene(&s);
}

/* Two walls with one normal: the farther one is covered, if one of them has
 * friction and neither moves. */
static void
test_cover(void **state)
{
  (void)state;
  const uint8_t fixed = ABUT_PAIR_FIXED_POINTS,
                both = ABUT_PAIR_FIXED_POINTS | ABUT_PAIR_FRICTION;
  const uint8_t marks[5][3] = {{both, fixed, both},
                               {fixed, both, both},
                               {fixed, fixed, both},
                               {both, ABUT_PAIR_FRICTION, both},
                               {both, both, both}};
  const int covered[5] = {1, 1, -1, -1, 1};
  for (int k = 0; k < 5; ++k)
  {
    scene s;
    open_scene(&s, 3);
    add(&s, 0, 4, 0.3, 0.1, 1., ABUT_POINT_CONTACT);
    add(&s, 1, 4, 0.3, 0.2, 1., ABUT_POINT_CONTACT);
    add(&s, 2, 4, 0.4, 0.3, 1., ABUT_POINT_CONTACT); /* another normal */
    add(&s, 2, 5, 0.3, 0.3, 1., ABUT_POINT_CONTACT); /* another node */
    add(&s, 2, -1, 0.3, 0.3, 1., ABUT_POINT_CONTACT);
    uint8_t keep[10];
    memset(keep, 1, sizeof(keep));
    require(abut_points_cover(s.points, s.n_pairs, marks[k], keep));
    for (int row = 0; row < 10; ++row)
      assert_int_equal(keep[row], row / 2 != covered[k]);
    close_scene(&s);
  }
  /* Of equal gaps, and of a nearer one that comes later. */
  for (int nearer = 0; nearer < 2; ++nearer)
  {
    scene s;
    open_scene(&s, 2);
    add(&s, 0, 0, 0., 0.1, 1., ABUT_POINT_CONTACT);
    add(&s, 1, 0, 0., nearer ? 0.05 : 0.1, 1., ABUT_POINT_CONTACT);
    uint8_t keep[4] = {1, 1, 1, 1};
    require(abut_points_cover(s.points, s.n_pairs, marks[4], keep));
    for (int row = 0; row < 4; ++row)
      assert_int_equal(keep[row], row / 2 != (nearer ? 0 : 1));
    close_scene(&s);
  }
}

/* Other contacts of the same node, ties left out. */
static void
test_rivals(void **state)
{
  (void)state;
  scene s;
  open_scene(&s, 3);
  add(&s, 0, 4, 0., 0., 1., ABUT_POINT_CONTACT);
  add(&s, 0, 5, 0., 0., 1., ABUT_POINT_CONTACT);
  add(&s, 1, 4, 0., 0., 1., ABUT_POINT_CONTACT);
  add(&s, 1, 5, 0., 0., 1., ABUT_POINT_TIE);
  add(&s, 2, 4, 0., 0., 1., ABUT_POINT_CONTACT);
  add(&s, 2, -1, 0., 0., 1., ABUT_POINT_CONTACT);
  const int32_t first[4] = {0, 2, 8, 10};
  int32_t n = -1, point[8], row[8];
  require(abut_points_rivals(s.points, 4, first, &n, NULL, NULL));
  assert_int_equal(n, 4);
  require(abut_points_rivals(s.points, 4, first, &n, point, row));
  const int32_t points[4] = {0, 0, 2, 2}, rows[4] = {4, 8, 0, 4};
  for (int k = 0; k < 4; ++k)
  {
    assert_int_equal(point[k], points[k]);
    assert_int_equal(row[k], rows[k]);
  }
  close_scene(&s);
}

static void
test_arguments(void **state)
{
  (void)state;
  scene s;
  open_scene(&s, 1);
  add(&s, 0, 4, 0., 0., 1., ABUT_POINT_CONTACT);
  const double value[2] = {0.};
  uint8_t keep[2] = {1, 1};
  int32_t n = 0, first = 0;
  abut_friction_sums sums;
  assert_int_equal(abut_points_friction(s.points, 0, value, value, NULL, &sums),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_points_friction(s.points, s.n_pairs, NULL, value, NULL, &sums),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_cover(s.points, s.n_pairs, NULL, keep),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_rivals(s.points, 1, &first, &n, &n, NULL),
                   ABUT_INVALID_ARGUMENT);
  close_scene(&s);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_sums, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_corner, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_cover, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_rivals, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_arguments, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
