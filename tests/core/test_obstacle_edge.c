/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Contact at convex edges, corners and tips: the direction is the body's normal
 * limited to the flanks' cone, the gap is the way along it, both are continuous
 * in the position; far from edges, near concave ones and at smooth obstacles
 * nothing changes. Expected values are those of planes. */
#include "obstacle_fixture.h"

#include <abut/obstacle_edge.h>

/* Gap and gradient of one point of a facet of size 1. */
static double
face(abut_obstacle *o, const double *x, const double *normal, double *gradient)
{
  const double size = 1.;
  double gap = NAN;
  assert_ok(abut_obstacle_distance(o, 1, x, &gap, gradient, NULL));
  assert_ok(
      abut_obstacle_face(o, false, 1, x, normal, &size, &gap, gradient, NULL));
  return gap;
}

/* A rectangle, its corner down at the origin, rotated by an angle from where
 * its sides are vertical and horizontal. */
static abut_obstacle *
corner_down(double angle)
{
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  const double c = cos(angle), s = sin(angle);
  const double rotation[4] = {c, -s, s, c};
  abut_obstacle *o = NULL;
  shape.dimension = 2;
  shape.kind = ABUT_OBSTACLE_BOX;
  shape.point[0] = shape.point[1] = 5.;
  shape.size[0] = shape.size[1] = 10.;
  assert_ok(abut_obstacle_create_shape(context, &shape, &o));
  assert_ok(abut_obstacle_set_pose(o, rotation, NULL));
  return o;
}

/* The corner above a horizontal surface: the direction is down whatever the
 * flanks are, and the gap is the height of the flank above the point. */
static void
corners_in_the_plane(void **state)
{
  static const double offsets[] = {0.,    1e-17, -1e-17, 1e-12,  -1e-12,
                                   1e-8,  -1e-8, 1e-4,   -1e-4,  0.01,
                                   -0.01, 0.1,   -0.1,   0.0625, -0.0625};
  static const double heights[] = {0., 1e-15, -1e-15, 1e-6, -1e-6, -0.3, 0.4};
  static const double up[2] = {0., 1.};
  (void)state;
  for (int a = 1; a < 9; ++a)
  {
    const double angle = a * pi / 18.;
    abut_obstacle *o = corner_down(angle);
    for (size_t i = 0; i < sizeof(offsets) / sizeof(*offsets); ++i)
      for (size_t k = 0; k < sizeof(heights) / sizeof(*heights); ++k)
      {
        const double x[2] = {offsets[i], -heights[k]};
        const double flank = x[0] > 0. ? x[0] * tan(angle) : -x[0] / tan(angle);
        double n[2];
        assert_close(face(o, x, up, n), flank + heights[k], 1e-11);
        assert_close(n[0], 0., 1e-15);
        assert_close(n[1], -1., 1e-15);
      }
    assert_ok(abut_obstacle_destroy(&o));
  }
}

/* A body whose normal is outside of the cone meets the nearest flank. */
static void
limited(void **state)
{
  const double angle = pi / 9.;
  abut_obstacle *o = corner_down(angle);
  (void)state;
  for (int k = 0; k <= 27; ++k)
  {
    /* -m at this angle from straight down; the cone is from the normal of the
     * left flank to that of the right one. */
    const double beta = -pi / 2. + k * pi / 36.;
    const double m[2] = {-sin(beta), cos(beta)}, x[2] = {0., 1e-3};
    const double limit = fmax(angle - pi / 2., fmin(beta, angle));
    double n[2];
    const double gap = face(o, x, m, n);
    assert_close(n[0], sin(limit), 1e-7);
    assert_close(n[1], -cos(limit), 1e-7);
    /* A line from the point out along (sin, -cos) leaves by one of the two
     * flanks: depths over cosines. */
    const double right = 1e-3 * cos(angle) / cos(limit - angle),
                 left = 1e-3 * sin(angle) / cos(limit - angle + pi / 2.);
    assert_close(gap / 1e-3, -fmin(fabs(right), fabs(left)) / 1e-3, 1e-5);
  }
  assert_ok(abut_obstacle_destroy(&o));
}

/* Direction and gap do not jump on a way across the corner, and are those of
 * the flank beyond a quarter of the facet. */
static void
continuous(void **state)
{
  static const double up[2] = {0., 1.};
  abut_obstacle *o = corner_down(pi / 4.);
  double before[3] = {NAN, 0., 0.};
  (void)state;
  for (int k = -40000; k <= 40000; ++k)
  {
    const double x[2] = {k * 1e-5, 0.01};
    double now[3];
    now[2] = face(o, x, up, now);
    for (int d = 0; d < 3 && k > -40000; ++d)
      assert_true(fabs(now[d] - before[d]) < 1e-3);
    if (fabs(x[0]) >= 0.25 || fabs(x[0]) <= 0.115)
      assert_close(fabs(now[0]), fabs(x[0]) >= 0.25 ? sqrt(0.5) : 0., 1e-14);
    memcpy(before, now, sizeof(now));
  }
  assert_ok(abut_obstacle_destroy(&o));
}

/* A box's edge and corner, and a cone askew, down on a horizontal surface. */
static void
in_space(void **state)
{
  static const double up[3] = {0., 0., 1.};
  const double r = sqrt(0.5), t = sqrt(1. / 3.), f = sqrt(2. / 3.),
               h = sqrt(1. / 6.);
  /* Rotations that have an edge, and a corner, at the bottom. */
  const double edge[9] = {1., 0., 0., 0., r, -r, 0., r, r};
  const double corner[9] = {f, -h, -h, 0., r, -r, t, t, t};
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  (void)state;
  for (int kind = 0; kind < 3; ++kind)
  {
    abut_obstacle *o = NULL;
    shape.kind = kind == 2 ? ABUT_OBSTACLE_CONE : ABUT_OBSTACLE_BOX;
    for (int d = 0; d < 3; ++d)
    {
      shape.size[d] = 10.;
      shape.point[d] = kind == 2 || (kind == 0 && d == 0) ? 0. : 5.;
      shape.axis[d] = d == 2 ? 1. : 0.2 * d;
    }
    shape.angle = pi / 3.;
    assert_ok(abut_obstacle_create_shape(context, &shape, &o));
    assert_ok(abut_obstacle_set_pose(o,
                                     kind == 2   ? NULL
                                     : kind == 1 ? corner
                                                 : edge,
                                     NULL));
    for (int k = 0; k < 24; ++k)
    {
      const double radius = k == 0 ? 0. : pow(10., -(k % 8) * 2. - 2.);
      const double x[3] = {radius * cos(k), radius * sin(k), 1e-3};
      double n[3];
      const double gap = face(o, x, up, n);
      assert_close(n[0], 0., 1e-14);
      assert_close(n[1], 0., 1e-14);
      assert_close(n[2], -1., 1e-14);
      /* The place along the direction is on the surface. */
      const double y[3] = {x[0], x[1], x[2] + gap};
      double distance;
      assert_ok(abut_obstacle_distance(o, 1, y, &distance, n, NULL));
      assert_close(distance, 0., 1e-12);
    }
    assert_ok(abut_obstacle_destroy(&o));
  }
}

/* Heights of |x| below, whose gradient is by the formula, with their edge away
 * from the origin, and of x^2, which has none; and a hollow box, whose corners
 * are concave. */
static int
roof(void *user, int32_t n, const double *points, double *value,
     double *gradient)
{
  const double bend = *(const double *)user;
  for (int32_t i = 0; i < n; ++i)
  {
    const double x = points[2 * i] - 0.3, y = points[2 * i + 1];
    value[i] = (bend > 0. ? bend * x * x : fabs(x)) - y;
    gradient[2 * i] = bend > 0. ? 2. * bend * x : x < 0. ? -1. : 1.;
    gradient[2 * i + 1] = -1.;
  }
  return 0;
}

static void
functions_and_concave_corners(void **state)
{
  static const double up[2] = {0., 1.};
  double bend = 0.;
  abut_obstacle_function function = abut_obstacle_function_defaults();
  abut_obstacle *o = NULL;
  (void)state;
  function.dimension = 2;
  function.user = &bend;
  function.evaluate = roof;
  assert_ok(abut_obstacle_create_function(context, &function, &o));
  for (int k = -8; k <= 8; ++k)
  {
    const double x[2] = {0.3 + k * 0.0125, 0.02};
    double n[2], value, gradient[2];
    bend = 0.;
    assert_close(face(o, x, up, n), fabs(k * 0.0125) - 0.02, 1e-12);
    assert_close(n[0], 0., 1e-14);
    bend = 2.;
    const double gap = face(o, x, up, n);
    assert_ok(abut_obstacle_distance(o, 1, x, &value, gradient, NULL));
    assert_true(gap == value && n[0] == gradient[0] && n[1] == gradient[1]);
  }
  assert_ok(abut_obstacle_destroy(&o));

  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  shape.dimension = 2;
  shape.kind = ABUT_OBSTACLE_BOX;
  shape.hollow = true;
  assert_ok(abut_obstacle_create_shape(context, &shape, &o));
  for (int k = 0; k < 20; ++k)
  {
    const double x[2] = {0.5 - 0.004 * k, 0.5 - 0.01 * (k % 7) + 0.02};
    double n[2], value, gradient[2];
    const double gap = face(o, x, up, n);
    assert_ok(abut_obstacle_distance(o, 1, x, &value, gradient, NULL));
    assert_true(gap == value && n[0] == gradient[0] && n[1] == gradient[1]);
  }
  assert_ok(abut_obstacle_destroy(&o));
}

static void
bad_calls(void **state)
{
  const double x[2] = {0., 0.}, size = 1.;
  double gap = 0., gradient[2] = {0., -1.};
  abut_obstacle *o = corner_down(0.3);
  (void)state;
  assert_int_equal(
      abut_obstacle_face(NULL, false, 1, x, x, &size, &gap, gradient, NULL),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_obstacle_face(o, false, -1, x, x, &size, &gap, gradient, NULL),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_obstacle_face(o, false, 1, x, NULL, &size, &gap, gradient, NULL),
      ABUT_INVALID_ARGUMENT);
  assert_ok(
      abut_obstacle_face(o, false, 0, NULL, NULL, NULL, NULL, NULL, NULL));
  assert_ok(abut_obstacle_destroy(&o));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(corners_in_the_plane, set_up, tear_down),
      cmocka_unit_test_setup_teardown(limited, set_up, tear_down),
      cmocka_unit_test_setup_teardown(continuous, set_up, tear_down),
      cmocka_unit_test_setup_teardown(in_space, set_up, tear_down),
      cmocka_unit_test_setup_teardown(functions_and_concave_corners, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(bad_calls, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
