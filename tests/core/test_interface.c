/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Pairs of two parallel lines at a distance, and of a line above a plane: gaps,
 * places and clearances are known for every kinematics. */
#include <abut/interface.h>
#include <abut/law.h>
/* Its arguments have names that the fixture has. */
#include "coupling_fixture.h"

enum
{
  N = 4,        /* facets of the secondary */
  M = 3,        /* of the primary */
  FIRST = 10,   /* number of the secondary's first node */
  PRIMARY = 20, /* and of the primary's */
  N_NODES = 30, /* all are below */
  FACET = 100,  /* number of the secondary's first facet */
  DIM = 2
};

static const double height = 0.05, extra = 0.01;

/* The body of the secondary is above the one of the primary. */
typedef struct scene
{
  scene_mesh mesh[2];
  abut_surface *surface[2];
  abut_interface *pair;
  abut_points *points;
  int32_t node[2][N + 1], facet[N];
  double reference[DIM * N_NODES], displacement[DIM * N_NODES],
      position[DIM * N_NODES];
} scene;

static void
open_scene(scene *s, abut_kinematics kinematics,
           abut_discretisation discretisation, abut_obstacle *obstacle)
{
  const double upper[4] = {0., height, 1., height}, lower[4] = {1., 0., 0., 0.};
  memset(s, 0, sizeof(*s));
  s->mesh[0] = scene_patch(ABUT_FACET_LINE2, N, 1, scene_line, upper, false);
  s->mesh[1] = scene_patch(ABUT_FACET_LINE2, M, 1, scene_line, lower, false);
  for (int k = 0; k < 2; ++k)
  {
    s->surface[k] = surface_of(&s->mesh[k]);
    for (int32_t i = 0; i < s->mesh[k].n_nodes; ++i)
    {
      s->node[k][i] = (k == 0 ? FIRST : PRIMARY) + i;
      for (int d = 0; d < DIM; ++d)
        s->reference[DIM * s->node[k][i] + d] =
            s->mesh[k].position[DIM * i + d];
    }
  }
  for (int32_t f = 0; f < N; ++f)
    s->facet[f] = FACET + f;
  abut_interface_options options = abut_interface_defaults();
  options.coupling = mortar_options(discretisation, 1);
  options.coupling.search.reach = 0.3;
  options.kinematics = kinematics;
  options.number = 3;
  options.facet_size = 0.25;
  options.secondary_node = s->node[0];
  options.primary_node = s->node[1];
  options.secondary_facet = s->facet;
  require(abut_interface_create(context, s->surface[0],
                                obstacle == NULL ? s->surface[1] : NULL,
                                obstacle, &options, &s->pair));
  require(abut_points_create(context, DIM, &s->points));
}

static void
close_scene(scene *s)
{
  require(abut_points_destroy(&s->points));
  require(abut_interface_destroy(&s->pair));
  for (int k = 0; k < 2; ++k)
  {
    require(abut_surface_destroy(&s->surface[k]));
    scene_free(&s->mesh[k]);
  }
}

/* Both sides rotate about the origin, and the secondary comes down along the
 * rotated normal. */
static void
displace(scene *s, double angle, double down)
{
  const double c = cos(angle), e = sin(angle);
  for (int32_t i = 0; i < N_NODES; ++i)
  {
    const double *x = s->reference + DIM * i;
    const double y = x[1] - (i < PRIMARY ? down : 0.);
    s->position[DIM * i] = c * x[0] - e * y;
    s->position[DIM * i + 1] = e * x[0] + c * y;
    for (int d = 0; d < DIM; ++d)
      s->displacement[DIM * i + d] = s->position[DIM * i + d] - x[d];
  }
}

static void
build(scene *s, bool displaced)
{
  abut_interface_target target = abut_interface_target_defaults(s->points);
  target.gap = extra;
  target.n_nodes = N_NODES;
  target.displacement = displaced ? s->displacement : NULL;
  require(abut_points_clear(s->points));
  require(abut_interface_build(s->pair, &target));
}

/* Points belong to the nodes of the secondary, by the caller's numbers. */
static void
check_places(const scene *s, bool at_nodes)
{
  abut_points_view v;
  abut_places_view p;
  require(abut_points_get(s->points, &v));
  require(abut_points_get_places(s->points, &p));
  assert_int_equal(p.n_points, v.n_points);
  assert_true(v.n_points >= N);
  for (int32_t i = 0; i < v.n_points; ++i)
  {
    assert_int_equal(p.pair[i], 3);
    if (at_nodes)
    {
      assert_in_range(p.node[i], FIRST, FIRST + N);
      assert_int_equal(p.facet[i], -1);
    }
    else
    {
      assert_int_equal(p.node[i], -1);
      assert_in_range(p.facet[i], FACET, FACET + N - 1);
    }
    for (int64_t e = v.start[i]; e < v.start[i + 1]; ++e)
      if (e < v.start[i] + v.n_secondary[i])
        assert_in_range(v.node[e], FIRST, FIRST + N);
      else
        assert_in_range(v.node[e], PRIMARY, PRIMARY + M);
  }
}

/* Gaps of all points at displacements. */
static void
check_gaps(const scene *s, const double *displacement, double expected)
{
  abut_points_view v;
  double gap[64];
  require(abut_points_get(s->points, &v));
  assert_in_range(v.n_components, 1, 64);
  require(abut_points_gap(s->points, N_NODES, displacement, gap));
  for (int32_t i = 0; i < v.n_components; ++i)
    near(gap[i], expected, 1e-12, "gap");
}

static const double nothing[DIM * N_NODES] = {0.};

/* Gaps of the reference configuration, whatever the discretisation. */
static void
test_reference(void **state)
{
  (void)state;
  for (int k = 0; k < ABUT_DISCRETISATION_N; ++k)
  {
    scene s;
    open_scene(&s, ABUT_KINEMATICS_REFERENCE, (abut_discretisation)k, NULL);
    build(&s, false);
    check_places(&s, k != ABUT_DISCRETISATION_QUADRATURE_POINT);
    check_gaps(&s, nothing, height + extra);
    displace(&s, 0., 0.02);
    check_gaps(&s, s.displacement, height + extra - 0.02);
    close_scene(&s);
  }
}

/* Surfaces that have moved: gaps are right where they are, and places have what
 * forces change by. */
static void
test_displaced(void **state)
{
  (void)state;
  const abut_kinematics kinematics[2] = {ABUT_KINEMATICS_UPDATED,
                                         ABUT_KINEMATICS_CURRENT};
  for (int k = 0; k < 2; ++k)
  {
    scene s;
    open_scene(&s, kinematics[k], ABUT_DISCRETISATION_NODE_TO_SEGMENT, NULL);
    displace(&s, 0.4, 0.02);
    require(abut_interface_move(s.pair, N_NODES, s.position));
    build(&s, true);
    require(abut_interface_move(s.pair, 0, NULL));
    check_places(&s, true);
    check_gaps(&s, s.displacement, height + extra - 0.02);
    abut_places_view p;
    require(abut_points_get_places(s.points, &p));
    for (int32_t i = 0; i < p.n_points; ++i)
    {
      const int64_t n = p.block_start[i + 1] - p.block_start[i];
      assert_int_equal(n, k == 0 ? 0 : 36); /* (2 (1 + 2))^2 */
      assert_int_equal(p.line_start[i + 1] - p.line_start[i], k == 0 ? 0 : 2);
      for (int64_t l = p.line_start[i]; l < p.line_start[i + 1]; ++l)
        assert_in_range(p.line[l], PRIMARY, PRIMARY + M);
      near(p.position[DIM * i], s.position[DIM * p.node[i]], 1e-15, "place");
    }
    /* The surfaces are back: gaps are those of the beginning. */
    abut_surface_view view;
    require(abut_surface_get(s.surface[0], &view));
    for (int32_t i = 0; i < DIM * view.n_nodes; ++i)
      near(view.position[i], s.mesh[0].position[i], 0., "position");
    close_scene(&s);
  }
}

/* Partners of the reference configuration: a rotation of both sides changes no
 * gap. */
static void
test_corotational(void **state)
{
  (void)state;
  scene s;
  open_scene(&s, ABUT_KINEMATICS_COROTATIONAL, ABUT_DISCRETISATION_DUAL_MORTAR,
             NULL);
  displace(&s, 1.2, 0.);
  build(&s, true);
  check_places(&s, true);
  check_gaps(&s, s.displacement, height + extra);
  close_scene(&s);
}

static void
test_obstacle(void **state)
{
  (void)state;
  abut_obstacle_shape plane = abut_obstacle_shape_defaults();
  plane.dimension = DIM;
  plane.axis[0] = 0.;
  plane.axis[1] = 1.;
  abut_obstacle *obstacle = NULL;
  require(abut_obstacle_create_shape(context, &plane, &obstacle));
  scene s;
  open_scene(&s, ABUT_KINEMATICS_REFERENCE, ABUT_DISCRETISATION_NODE_TO_SEGMENT,
             obstacle);
  build(&s, false);
  check_places(&s, true);
  check_gaps(&s, nothing, height + extra);
  close_scene(&s);
  require(abut_obstacle_destroy(&obstacle));
}

/* The least distance is that of a node of the primary that has come up. */
static void
test_clearances(void **state)
{
  (void)state;
  const double up = 0.01;
  scene s;
  open_scene(&s, ABUT_KINEMATICS_REFERENCE, ABUT_DISCRETISATION_MORTAR, NULL);
  build(&s, false);
  abut_points_view v;
  require(abut_points_get(s.points, &v));
  double clearance[64];
  const abut_detection_options options = abut_detection_defaults();
  for (int k = 0; k < 2; ++k)
  {
    displace(&s, 0., 0.);
    s.position[DIM * (PRIMARY + 1) + 1] += k * up;
    require(abut_interface_move(s.pair, N_NODES, s.position));
    require(abut_interface_clearances(s.pair, s.points, &options, 0.3, extra,
                                      N_NODES, clearance));
    double least = INFINITY, most = 0.;
    for (int32_t i = 0; i < v.n_points; ++i)
    {
      least = fmin(least, clearance[i]);
      most = fmax(most, clearance[i]);
    }
    near(least, height + extra - k * up, 1e-14, "least");
    if (k == 0)
      near(most, height + extra, 1e-14, "most");
  }
  close_scene(&s);
}

/* Directions of forces rotate with the bodies, at a ball with the way about its
 * centre, and ties, open points and other pairs do not count. */
static void
test_rotation(void **state)
{
  (void)state;
  const double angle = 0.4;
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  shape.dimension = DIM;
  shape.kind = ABUT_OBSTACLE_SPHERE;
  shape.radius = height; /* the centre is the origin */
  abut_obstacle *ball = NULL;
  require(abut_obstacle_create_shape(context, &shape, &ball));
  const abut_discretisation kinds[3] = {ABUT_DISCRETISATION_NODE_TO_SEGMENT,
                                        ABUT_DISCRETISATION_DUAL_MORTAR,
                                        ABUT_DISCRETISATION_NODE_TO_SEGMENT};
  for (int k = 0; k < 3; ++k)
  {
    scene s;
    open_scene(&s, ABUT_KINEMATICS_REFERENCE, kinds[k], k == 2 ? ball : NULL);
    displace(&s, angle, 0.);
    build(&s, false);
    abut_points_view v;
    require(abut_points_get(s.points, &v));
    double value[64] = {0.}, force = 0.;
    uint8_t states[64] = {0};
    for (int32_t i = 0; i < v.n_points; ++i)
    {
      value[i] = 1. + i;
      states[i] = i == 1 ? ABUT_STATE_OPEN : ABUT_STATE_CLOSED;
      force += i == 1 ? 0. : v.weight[i] * value[i];
    }
    const abut_kinematics kinematics[4] = {ABUT_KINEMATICS_REFERENCE};
    const abut_node_positions nodes = {sizeof(nodes), N_NODES, 4,
                                       s.reference,   NULL,    s.displacement,
                                       kinematics};
    abut_direction_change change;
    require(abut_interface_rotation(s.pair, s.points, &nodes, value, states,
                                    &change));
    near(change.force, force, 1e-12, "force");
    near(change.largest, angle, 1e-9, "largest");
    near(change.sum, angle * force, 1e-9, "sum");
    require(abut_interface_rotation(s.pair, s.points, &nodes, value, NULL,
                                    &change));
    near(change.force, 0., 0., "force");
    assert_int_equal(
        abut_interface_rotation(s.pair, s.points, NULL, value, states, &change),
        ABUT_INVALID_ARGUMENT);
    close_scene(&s);
  }
  require(abut_obstacle_destroy(&ball));
}

static void
test_arguments(void **state)
{
  (void)state;
  scene s;
  open_scene(&s, ABUT_KINEMATICS_REFERENCE, ABUT_DISCRETISATION_MORTAR, NULL);
  abut_interface *none = NULL;
  double clearance[64];
  assert_int_equal(
      abut_interface_create(context, s.surface[0], NULL, NULL, NULL, &none),
      ABUT_INVALID_ARGUMENT);
  assert_null(none);
  assert_int_equal(abut_interface_move(s.pair, FIRST, s.reference),
                   ABUT_INVALID_ARGUMENT);
  abut_interface_target target = abut_interface_target_defaults(s.points);
  target.displacement = nothing;
  target.n_nodes = FIRST;
  assert_int_equal(abut_interface_build(s.pair, &target),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_interface_clearances(s.pair, s.points, NULL, 0., 0.,
                                             FIRST, clearance),
                   ABUT_INVALID_ARGUMENT);
  assert_null(abut_interface_coupling(NULL));
  assert_non_null(abut_interface_coupling(s.pair));
  close_scene(&s);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_reference, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_displaced, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_corotational, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_obstacle, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_clearances, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_rotation, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_arguments, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
