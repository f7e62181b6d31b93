/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Places follow their points, and what is read from them is that of points put
 * together by hand. */
#include <abut/contact_measures.h>
#include <abut/law.h>
#include <abut/places.h>

#include "surface_fixture.h"

static abut_points *points;

/* A point of two components in the plane, between node 0 + i of the secondary
 * and node 5 of the primary, with its normal at an angle. */
static void
add(int64_t id, int32_t i, double weight, double angle, abut_point_kind kind)
{
  const double c = cos(angle), s = sin(angle), frame[4] = {s, -c, c, s},
               gap[2] = {0.5, 0.25}, coefficient[2] = {1., -1.};
  const int32_t node[2] = {i, 5};
  abut_point point = abut_point_defaults();
  point.id = id;
  point.kind = kind;
  point.n_components = 2;
  point.weight = weight;
  point.frame = frame;
  point.gap = gap;
  point.n_nodes = 2;
  point.n_secondary = 1;
  point.node = node;
  point.coefficient = coefficient;
  require(abut_points_append(points, &point));
}

static void
place(int32_t pair, int32_t node, int32_t facet, int32_t n_lines,
      const int32_t *line, const double *block)
{
  const double position[2] = {10. * pair, 1. + node};
  abut_place p = abut_place_defaults();
  p.pair = pair;
  p.node = node;
  p.facet = facet;
  p.position = position;
  p.n_lines = n_lines;
  p.line = line;
  p.block = block;
  require(abut_points_append_place(points, &p));
}

static void
test_filter(void **state)
{
  (void)state;
  const int32_t line[2] = {5, 6};
  double block[2 * 36];
  for (int e = 0; e < 72; ++e)
    block[e] = e < 36 ? 1. + e : -2. * e;
  require(abut_points_create(context, 2, &points));
  add(0, 0, 2., 0., ABUT_POINT_CONTACT);
  add(10, 1, 3., 0., ABUT_POINT_CONTACT);
  add(20, 2, 4., 0., ABUT_POINT_TIE);
  place(0, 0, -1, 0, NULL, NULL);
  abut_places_view p;
  assert_int_equal(abut_points_get_places(points, &p), ABUT_INVALID_ARGUMENT);
  place(1, -1, 7, 2, line, block);
  place(2, 2, -1, 2, line, block);
  const double position[2] = {0., 0.};
  abut_place one_more = abut_place_defaults();
  one_more.position = position;
  assert_int_equal(abut_points_append_place(points, &one_more),
                   ABUT_INVALID_ARGUMENT);
  require(abut_points_get_places(points, &p));
  assert_int_equal(p.n_pairs, 3);
  assert_int_equal(p.n_nodes, 3);
  assert_int_equal(p.block_start[3], 144);

  /* Blocks are summed by values and weights. */
  const double value[6] = {1., 1., 0.5, 2., 0., 0.};
  double sum[36];
  int64_t n = 0;
  require(abut_points_force_block(points, 1, value, sum, &n));
  assert_int_equal(n, 36);
  for (int e = 0; e < 36; ++e)
    require_near(sum[e], 3. * (0.5 * block[e] + 2. * block[36 + e]), 1e-12);
  require(abut_points_force_block(points, 1, NULL, sum, &n));
  require_near(sum[3], block[3] + block[39], 0.);
  require(abut_points_force_block(points, 2, value, sum, &n));
  assert_int_equal(n, 0);
  require(abut_points_force_block(points, 0, value, NULL, &n));
  assert_int_equal(n, 0);

  /* The first point goes, and the second component of the tie. */
  const uint8_t keep[6] = {0, 1, 1, 1, 0, 1};
  require(abut_points_filter(points, keep));
  require(abut_points_get_places(points, &p));
  assert_int_equal(p.n_points, 2);
  assert_int_equal(p.pair[0], 1);
  assert_int_equal(p.facet[0], 7);
  assert_int_equal(p.node[1], 2);
  require_near(p.position[0], 10., 0.);
  require_near(p.position[3], 3., 0.);
  assert_int_equal(p.line_start[2], 4);
  assert_int_equal(p.line[3], 6);
  assert_int_equal(p.block_start[1], 72);
  assert_int_equal(p.block_start[2], 108);
  require_near(p.block[0], block[0], 0.);
  require_near(p.block[72], block[36], 0.);
  require_near(p.block[107], block[71], 0.);

  /* New numbers of nodes and facets. */
  const int32_t number[7] = {0, 4, 3, 2, 1, 8, 9};
  int32_t facet[8] = {0, 0, 0, 0, 0, 0, 0, 3};
  require(abut_points_renumber(points, 7, number));
  require(abut_points_renumber_facets(points, 8, facet));
  require(abut_points_get_places(points, &p));
  assert_int_equal(p.node[0], -1);
  assert_int_equal(p.node[1], 3);
  assert_int_equal(p.n_nodes, 4);
  assert_int_equal(p.line[0], 8);
  assert_int_equal(p.line[3], 9);
  assert_int_equal(p.facet[0], 3);
  facet[3] = -1;
  require(abut_points_renumber_facets(points, 8, facet));
  require(abut_points_get_places(points, &p));
  assert_int_equal(p.facet[0], -1);
  const int32_t lost[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, -1};
  assert_int_equal(abut_points_renumber(points, 10, lost),
                   ABUT_INVALID_ARGUMENT);
  require(abut_points_clear(points));
  require(abut_points_get_places(points, &p));
  assert_int_equal(p.n_points, 0);
  require(abut_points_destroy(&points));
}

/* Of five points one is lost, one has another facet opposite, one another
 * normal, and one is not asked for. */
static void
test_changes(void **state)
{
  (void)state;
  const double degree = 3.14159265358979323846 / 180.;
  const int32_t facet[3][2] = {{5, 6}, {6, 7}, {8, 9}};
  abut_points *before = NULL;
  for (int k = 0; k < 2; ++k)
  {
    require(abut_points_create(context, 2, &points));
    /* Numbers are in no order. */
    const int64_t id[5] = {40, 0, 30, 10, 20};
    for (int i = 0; i < 5; ++i)
    {
      if (k == 1 && i == 0)
        continue;
      add(id[i], i, 1., k * degree * (i == 2 ? 31. : 29.), ABUT_POINT_CONTACT);
    }
    for (int i = 0; i < 5; ++i)
      if (k == 0 || i > 0)
        place(0, i, -1, 2, facet[k == 0 ? 0 : i == 1 || i == 4 ? 2 : 1], NULL);
    if (k == 0)
      before = points;
  }
  const uint8_t wanted[5] = {1, 1, 1, 1, 0};
  abut_place_changes changes;
  require(abut_points_count_changes(before, points, wanted, &changes));
  assert_int_equal(changes.lost, 1);
  assert_int_equal(changes.jumped, 2);
  require(abut_points_count_changes(before, before, wanted, &changes));
  assert_int_equal(changes.lost + changes.jumped, 0);
  assert_int_equal(abut_points_count_changes(before, points, NULL, &changes),
                   ABUT_INVALID_ARGUMENT);
  require(abut_points_destroy(&before));
  require(abut_points_destroy(&points));
}

enum
{
  N_NODES = 6
};

/* A frictional point, an open one and a tie: forces and moments by hand. */
static void
test_measures(void **state)
{
  (void)state;
  require(abut_points_create(context, 2, &points));
  add(0, 0, 2., 0., ABUT_POINT_CONTACT);
  add(10, 1, 3., 0., ABUT_POINT_CONTACT);
  add(20, 2, 4., 0., ABUT_POINT_TIE);
  place(0, 0, -1, 0, NULL, NULL);
  place(0, 1, -1, 0, NULL, NULL);
  place(1, 2, -1, 0, NULL, NULL);
  double reference[2 * N_NODES], made[2 * N_NODES], u[2 * N_NODES];
  for (int i = 0; i < N_NODES; ++i)
  {
    reference[2 * i] = 1. + i;
    reference[2 * i + 1] = 0.5 * i;
    made[2 * i] = reference[2 * i] + 0.25;
    made[2 * i + 1] = reference[2 * i + 1] - 0.5;
    u[2 * i] = 0.125 * i;
    u[2 * i + 1] = 2.;
  }
  const abut_kinematics kinematics[2] = {ABUT_KINEMATICS_CURRENT,
                                         ABUT_KINEMATICS_REFERENCE};
  const abut_node_positions nodes = {
      sizeof(nodes), N_NODES, 2, reference, made, u, kinematics};
  const double value[6] = {5., -1., -0.5, 0., 7., 8.},
               gap[6] = {-0.25, 0., 0.5, 0., 0.125, -0.0625};
  const uint8_t states[6] = {ABUT_STATE_CLOSED, 0,
                             ABUT_STATE_OPEN,   0,
                             ABUT_STATE_CLOSED, ABUT_STATE_CLOSED};
  abut_contact_sums s[2];
  require(abut_points_measure(points, &nodes, value, gap, states, s));
  assert_int_equal(s[0].n_rows, 2);
  assert_int_equal(s[0].n_active, 1);
  require_near(s[0].covered_area, 5., 0.);
  require_near(s[0].contact_area, 2., 0.);
  require_near(s[0].pressure, 5., 0.);
  require_near(s[0].least_pressure, 5., 0.);
  require_near(s[0].largest_tension, 0.5, 0.);
  require_near(s[0].penetration, 0.25, 0.);
  require_near(s[0].initial_gap_work, (2. * 5. - 3. * 0.5) * 0.5, 1e-14);
  /* Normal (0, -1): the pressures push the secondary up, w (p - 0.5 * 3); the
   * traction along (1, 0) is that on the secondary. */
  require_near(s[0].secondary.force[0], 2. * -1., 1e-14);
  require_near(s[0].secondary.force[1], 2. * 5. - 3. * 0.5, 1e-14);
  require_near(s[0].primary.force[1], -s[0].secondary.force[1], 1e-14);
  /* x f_y - y f_x where points were made, and at present. */
  require_near(s[0].secondary.moment[2],
               made[0] * 10. - made[1] * -2. + made[2] * -1.5, 1e-13);
  require_near(s[0].secondary.present_moment[2],
               (reference[0] + u[0]) * 10. - (reference[1] + u[1]) * -2.
                   + (reference[2] + u[2]) * -1.5,
               1e-13);
  require_near(s[0].primary.moment[2], -(made[10] * 8.5 - made[11] * -2.),
               1e-13);
  /* A tie: each component has its part of the area, and gaps of both signs. */
  assert_int_equal(s[1].n_rows, 2);
  require_near(s[1].covered_area, 4., 0.);
  require_near(s[1].penetration, 0.125, 0.);
  require_near(s[1].largest_tension, 0., 0.);
  assert_true(isinf(s[1].least_pressure));
  require_near(s[1].secondary.force[0], 4. * -8., 1e-13);
  require_near(s[1].secondary.force[1], 4. * 7., 1e-13);
  require_near(s[1].secondary.moment[2],
               reference[4] * 28. - reference[5] * -32., 1e-12);
  /* Without states what has a pressure is closed; positions not known are
   * those of the points. */
  abut_node_positions unknown = nodes;
  unknown.displacement = NULL;
  require(abut_points_measure(points, &unknown, value, gap, NULL, s));
  assert_int_equal(s[0].n_active, 0);
  require_near(s[0].least_pressure, -0.5, 0.);
  require_near(s[0].secondary.present_moment[2], s[0].secondary.moment[2], 0.);
  unknown.n_pairs = 1;
  assert_int_equal(abut_points_measure(points, &unknown, value, gap, NULL, s),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_measure(points, &nodes, NULL, gap, NULL, s),
                   ABUT_INVALID_ARGUMENT);

  uint8_t marks[2 * N_NODES] = {0};
  require(abut_points_mark_nodes(points, states, 2, N_NODES, marks));
  for (int i = 0; i < 2 * N_NODES; ++i)
    assert_int_equal(marks[i], i == 0 || i == N_NODES + 2);
  require(abut_points_mark_nodes(points, NULL, 2, N_NODES, marks));
  assert_int_equal(marks[1], 1);
  assert_int_equal(abut_points_mark_nodes(points, NULL, 1, N_NODES, marks),
                   ABUT_INVALID_ARGUMENT);
  require(abut_points_destroy(&points));
}

/* Node 0 against node 5, in each kinematics. */
static void
test_motion(void **state)
{
  (void)state;
  require(abut_points_create(context, 2, &points));
  add(0, 0, 2., 0., ABUT_POINT_CONTACT);
  place(0, 0, -1, 0, NULL, NULL);
  double reference[2 * N_NODES] = {0.}, made[2 * N_NODES] = {0.},
                       u[2 * N_NODES] = {0.};
  reference[0] = 1.;
  made[0] = 1.5;
  u[0] = 0.75;
  reference[10] = -2.;
  made[10] = -2.25;
  u[10] = 0.125;
  /* Their distance, their motion, and that since points were made. */
  const double apart = 3. + 0.75 - 0.125, all = 0.75 - 0.125,
               step = all - 0.5 - 0.25;
  const double relative[ABUT_KINEMATICS_N] = {[ABUT_KINEMATICS_REFERENCE] = all,
                                              [ABUT_KINEMATICS_COROTATIONAL] =
                                                  apart,
                                              [ABUT_KINEMATICS_UPDATED] = step,
                                              [ABUT_KINEMATICS_CURRENT] = all};
  for (int k = 0; k < ABUT_KINEMATICS_N; ++k)
  {
    const abut_kinematics kinematics = (abut_kinematics)k;
    const abut_node_positions nodes = {
        sizeof(nodes), N_NODES, 1, reference, made, u, &kinematics};
    double motion[2], since[2];
    require(abut_points_motion(points, &nodes, motion, since));
    require_near(motion[0], relative[k], 1e-15);
    require_near(motion[1], 0., 0.);
    require_near(since[0], k == ABUT_KINEMATICS_REFERENCE ? all : step, 1e-15);
    require(abut_points_motion(points, &nodes, NULL, NULL));
  }
  require(abut_points_destroy(&points));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_filter, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_changes, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_measures, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_motion, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
