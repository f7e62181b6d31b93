/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Obstacles of closed formulas and of functions: distances against formulas
 * and against the nearest of many points of the surface, derivatives against
 * differences, poses, and bad input. */
#include "obstacle_fixture.h"

static abut_obstacle *
make(const abut_obstacle_shape *shape)
{
  abut_obstacle *o = NULL;
  if (abut_obstacle_create_shape(context, shape, &o) != ABUT_SUCCESS)
    fail_msg("%s", abut_context_message(context));
  return o;
}

static double
distance_at(abut_obstacle *o, double x, double y, double z, double *gradient)
{
  const double p[3] = {x, y, z};
  double d = NAN;
  assert_ok(abut_obstacle_distance(o, 1, p, &d, gradient, NULL));
  return d;
}

/* One of each: all shapes in 2D and 3D, with and without ends, askew. */
enum
{
  N_SHAPES = 11
};

static abut_obstacle_shape
shape_number(int i)
{
  static const abut_obstacle_kind kinds[N_SHAPES] = {
      ABUT_OBSTACLE_PLANE,    ABUT_OBSTACLE_SPHERE,   ABUT_OBSTACLE_BOX,
      ABUT_OBSTACLE_CONE,     ABUT_OBSTACLE_CONE,     ABUT_OBSTACLE_PLANE,
      ABUT_OBSTACLE_SPHERE,   ABUT_OBSTACLE_BOX,      ABUT_OBSTACLE_CONE,
      ABUT_OBSTACLE_CYLINDER, ABUT_OBSTACLE_CYLINDER,
  };
  abut_obstacle_shape s = abut_obstacle_shape_defaults();
  s.dimension = i < 5 ? 2 : 3;
  s.kind = kinds[i];
  s.point[0] = 0.3;
  s.point[1] = -0.2;
  s.point[2] = 0.1;
  s.axis[0] = 0.4;
  s.axis[1] = -1.1;
  s.axis[2] = 0.7;
  s.radius = 0.8;
  s.size[0] = 1.5;
  s.size[1] = 0.7;
  s.size[2] = 1.1;
  s.angle = 0.6;
  s.length = i == 4 || i == 8 || i == 10 ? 1.3 : 0.;
  return s;
}

/* Width and depth of a shape that is turned by an angle about the axis out of
 * the plane of x and y, for a normal in that plane. */
static void
check_size(const abut_obstacle_shape *shape, double angle, double normal_angle,
           double width, double depth)
{
  const double c = cos(angle), t = sin(angle);
  const double rotation_2d[4] = {c, -t, t, c};
  const double rotation_3d[9] = {c, -t, 0, t, c, 0, 0, 0, 1};
  const double normal[3] = {cos(normal_angle), sin(normal_angle), 0};
  abut_obstacle *o = make(shape);
  assert_ok(abut_obstacle_set_pose(
      o, shape->dimension == 2 ? rotation_2d : rotation_3d, NULL));
  if (isinf(width))
    assert_true(isinf(abut_obstacle_width(o, normal)));
  else
    assert_close(abut_obstacle_width(o, normal), width, 1e-14);
  if (isinf(depth))
    assert_true(isinf(abut_obstacle_depth(o)));
  else
    assert_close(abut_obstacle_depth(o), depth, 0);
  assert_ok(abut_obstacle_destroy(&o));
}

/* A line through the centre at angle a to an edge of length l of a box, between
 * two sides of it, has the length l / cos(a). */
static void
sizes(void **state)
{
  (void)state;
  abut_obstacle_shape s = abut_obstacle_shape_defaults();
  check_size(&s, 0.3, 0.2, INFINITY, INFINITY);
  s.kind = ABUT_OBSTACLE_CONE;
  s.length = 2;
  check_size(&s, 0.3, 0.2, INFINITY, INFINITY);
  s.kind = ABUT_OBSTACLE_SPHERE;
  s.radius = 0.75;
  check_size(&s, 0.3, 0.2, 1.5, 0.75);
  s.hollow = true;
  check_size(&s, 0.3, 0.2, INFINITY, INFINITY);
  s.hollow = false;
  /* The axis, along x before the turn: its end counts if it is nearer. */
  s.kind = ABUT_OBSTACLE_CYLINDER;
  s.axis[0] = 3;
  s.axis[2] = 0;
  s.length = 0;
  check_size(&s, 0.4, 0.4 + pi / 2, 1.5, 0.75);
  s.length = 1;
  check_size(&s, 0.4, 0.4 + pi / 2, 1, 0.5);
  check_size(&s, 0.4, 0.4 + pi / 2 - 0.5, 1 / cos(0.5), 0.5);
  check_size(&s, 0.4, 0.4, 1.5, 0.5);
  s.kind = ABUT_OBSTACLE_BOX;
  s.size[0] = 4;
  s.size[1] = 3;
  s.size[2] = 5;
  check_size(&s, 0.4, 0.4 + pi / 2, 4, 1.5);
  check_size(&s, 0.4, 0.4, 3, 1.5);
  check_size(&s, 0.4, 0.4 + 0.2, 3 / cos(0.2), 1.5);
  s.dimension = 2;
  s.size[1] = 5;
  check_size(&s, 0.4, 0.4 + pi / 2, 4, 2);
  check_size(&s, 0.4, 0.4, 5, 2);
}

static void
known_distances(void **state)
{
  (void)state;
  double g[3];
  abut_obstacle_shape s = abut_obstacle_shape_defaults();
  s.axis[2] = 2.;
  s.point[2] = 0.25;
  abut_obstacle *o = make(&s);
  assert_close(distance_at(o, 7, -3, 1, g), 0.75, 1e-15);
  assert_close(g[2], 1, 0);
  assert_ok(abut_obstacle_destroy(&o));
  assert_null(o);

  s = abut_obstacle_shape_defaults();
  s.kind = ABUT_OBSTACLE_SPHERE;
  s.radius = 2;
  o = make(&s);
  assert_close(distance_at(o, 3, 4, 0, g), 3, 1e-15);
  assert_close(g[0], 0.6, 1e-15);
  assert_close(g[1], 0.8, 1e-15);
  assert_close(distance_at(o, 0, 0, 0, g), -2, 0);
  assert_close(g[2], 1, 0);
  assert_ok(abut_obstacle_destroy(&o));

  s = abut_obstacle_shape_defaults();
  s.kind = ABUT_OBSTACLE_BOX;
  s.size[0] = 2;
  s.size[1] = 4;
  s.size[2] = 6;
  o = make(&s);
  assert_close(distance_at(o, 2, 0, 0, g), 1, 1e-15);
  assert_close(distance_at(o, 4, 6, 0, g), 5, 1e-15); /* edge: 3, 4 */
  assert_close(g[1], 0.8, 1e-15);
  assert_close(distance_at(o, -3, -3, 5, g), 3, 1e-15); /* corner: 2, 1, 2 */
  assert_close(g[0], -2. / 3, 1e-15);
  assert_close(distance_at(o, 0.5, 0, 0, g), -0.5, 1e-15);
  assert_close(g[0], 1, 0);
  assert_close(distance_at(o, 0, 0, 0, g), -1, 0);
  assert_ok(abut_obstacle_destroy(&o));

  /* Without end: radius 1 about the axis z. */
  s = abut_obstacle_shape_defaults();
  s.kind = ABUT_OBSTACLE_CYLINDER;
  o = make(&s);
  assert_close(distance_at(o, 3, 4, 1e3, g), 4, 1e-15);
  assert_close(g[0], 0.6, 1e-15);
  assert_close(distance_at(o, 0, 0, 5, g), -1, 0);
  assert_close(g[0] * g[0] + g[1] * g[1], 1, 1e-15);
  assert_ok(abut_obstacle_destroy(&o));
  s.length = 4;
  o = make(&s);
  assert_close(distance_at(o, 4, 0, 6, g), 5, 1e-15); /* rim: 3, 4 */
  assert_close(distance_at(o, 0.5, 0, -3, g), 1, 1e-15);
  assert_close(g[2], -1, 0);
  assert_close(distance_at(o, 0, 0.75, 0, g), -0.25, 1e-15);
  assert_ok(abut_obstacle_destroy(&o));

  /* Half angle 45 degrees, tip below. */
  s = abut_obstacle_shape_defaults();
  s.kind = ABUT_OBSTACLE_CONE;
  s.angle = pi / 4;
  o = make(&s);
  assert_close(distance_at(o, 0, 0, -2, g), 2, 1e-15);
  assert_close(g[2], -1, 1e-15);
  assert_close(distance_at(o, 2, 0, 0, g), sqrt(2), 1e-15);
  assert_close(g[0], sqrt(0.5), 1e-15);
  assert_close(distance_at(o, 0, 0, 0, g), 0, 0);
  assert_close(g[2], -1, 0);
  assert_close(distance_at(o, 0, 0, 3, g), -3 / sqrt(2), 1e-15);
  assert_ok(abut_obstacle_destroy(&o));
}

/* The value 1 - (x/2)^2 - y^2, ten times: an ellipse, material outside. */
static int
ellipse(void *user, int32_t n, const double *p, double *value, double *gradient)
{
  const double factor = *(const double *)user;
  for (int32_t i = 0; i < n; ++i)
  {
    const double x = p[2 * i], y = p[2 * i + 1];
    value[i] = factor * (1 - x * x / 4 - y * y);
    gradient[2 * i] = -factor * x / 2;
    gradient[2 * i + 1] = -factor * 2 * y;
    if (x > 10)
      value[i] = NAN;
    if (x < -10)
      return 1;
  }
  return 0;
}

static void
functions(void **state)
{
  (void)state;
  double factor = 1e200, g[2], d;
  abut_obstacle_function f = abut_obstacle_function_defaults();
  f.dimension = 2;
  f.user = &factor;
  f.evaluate = ellipse;
  abut_obstacle *o = NULL;
  assert_ok(abut_obstacle_create_function(context, &f, &o));
  /* On the axes the error of the first order is known: e^2/2 + ... */
  for (int k = 0; k < 2; ++k)
  {
    factor = k == 0 ? 1e200 : 1e-200;
    const double e = 1e-3, p[4] = {0, 1 - e, 2 - 2 * e, 0};
    double distance[2], gradient[4];
    assert_ok(abut_obstacle_distance(o, 2, p, distance, gradient, NULL));
    assert_close(distance[0], (2 * e - e * e) / (2 * (1 - e)), 1e-15);
    assert_close(gradient[1], -1, 1e-15);
    assert_close(distance[1], (2 * e - e * e) / (1 - e), 1e-15);
    assert_close(gradient[2], -1, 1e-15);
  }
  /* No gradient at the centre: value as it is, a fixed direction. */
  factor = 3;
  const double centre[2] = {0, 0};
  assert_ok(abut_obstacle_distance(o, 1, centre, &d, g, NULL));
  assert_close(d, 3, 0);
  assert_close(g[0], 0, 0);
  assert_close(g[1], 1, 0);

  const double bad[4] = {0, 0.5, 11, 2.5}, worse[2] = {-11, 2};
  double two[2], hessian[4];
  assert_int_equal(abut_obstacle_distance(o, 2, bad, two, NULL, NULL),
                   ABUT_NOT_FINITE);
  assert_non_null(strstr(abut_context_message(context), "point 1 = (11, 2.5)"));
  assert_int_equal(abut_obstacle_distance(o, 1, worse, two, NULL, NULL),
                   ABUT_CALLBACK_FAILED);
  /* There, no second derivatives either. */
  assert_ok(abut_obstacle_distance(o, 1, centre, two, NULL, hessian));
  for (int i = 0; i < 4; ++i)
    assert_close(hessian[i], 0, 0);
  abut_obstacle_view v;
  assert_ok(abut_obstacle_get(o, &v));
  assert_int_equal(v.kind, ABUT_OBSTACLE_FUNCTION);
  assert_ok(abut_obstacle_destroy(&o));
  f.evaluate = NULL;
  assert_int_equal(abut_obstacle_create_function(context, &f, &o),
                   ABUT_INVALID_ARGUMENT);
  f.evaluate = ellipse;
  const double lengths[] = {-1, NAN, INFINITY};
  for (int i = 0; i < 3; ++i)
  {
    f.length = lengths[i];
    assert_int_equal(abut_obstacle_create_function(context, &f, &o),
                     ABUT_INVALID_ARGUMENT);
  }
}

/* |x|^3 - 8 times a factor: a sphere, but no distance. */
static int
cubes(void *user, int32_t n, const double *points, double *value,
      double *gradient)
{
  const double factor = *(const double *)user;
  for (int32_t i = 0; i < n; ++i)
  {
    const double *x = points + 3 * i;
    const double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    value[i] = factor * (r * r * r - 8);
    for (int d = 0; d < 3; ++d)
      gradient[3 * i + d] = 3 * factor * r * x[d];
  }
  return 0;
}

/* A bowl, the lower half of a sphere of radius 1 about (0, 0, 1), as a height
 * whose gap is along the axis. */
static int
sphere_height(void *user, int32_t n, const double *points, double *value,
              double *gradient)
{
  (void)user;
  for (int32_t i = 0; i < n; ++i)
  {
    const double *x = points + 3 * i;
    value[i] = x[2] - 1 + sqrt(1 - x[0] * x[0] - x[1] * x[1]);
    gradient[3 * i] = gradient[3 * i + 1] = 0;
    gradient[3 * i + 2] = 1;
  }
  return 0;
}

/* Second derivatives of functions: level surfaces of known curvature, also
 * hollow, in a pose, in other units, and with a length given. */
static void
curvature_of_functions(void **state)
{
  (void)state;
  double factor = 1, d[2], g[6], h[18], expected[9];
  uint64_t seed = 31;
  abut_obstacle_function f = abut_obstacle_function_defaults();
  f.user = &factor;
  f.evaluate = cubes;
  abut_obstacle_shape s = abut_obstacle_shape_defaults();
  s.kind = ABUT_OBSTACLE_SPHERE;
  s.radius = 2;
  const double turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1}, shift[3] = {1, -2, 0.5};
  for (int k = 0; k < 4; ++k)
  {
    factor = k % 2 == 0 ? 1e100 : 1e-100;
    s.hollow = f.hollow = k / 2 == 1;
    f.length = k == 3 ? 0.7 : 0;
    abut_obstacle *o = NULL, *sphere = make(&s);
    assert_ok(abut_obstacle_create_function(context, &f, &o));
    assert_ok(abut_obstacle_set_pose(o, turn, shift));
    assert_ok(abut_obstacle_set_pose(sphere, turn, shift));
    for (int i = 0; i < 50; ++i)
    {
      double x[3];
      for (int j = 0; j < 3; ++j)
        x[j] = shift[j] + 2 + 2 * (fixture_random(&seed) - 0.5);
      assert_ok(abut_obstacle_distance(sphere, 1, x, d, NULL, expected));
      assert_ok(abut_obstacle_distance(o, 1, x, d, g, h));
      for (int j = 0; j < 9; ++j)
        assert_close(h[j], expected[j], 1e-10);
    }
    assert_ok(abut_obstacle_destroy(&o));
    assert_ok(abut_obstacle_destroy(&sphere));
  }

  /* Curvatures of an ellipse with half axes 2 and 1 at its ends, seen from
   * within. */
  f = abut_obstacle_function_defaults();
  f.dimension = 2;
  f.user = &factor;
  f.evaluate = ellipse;
  abut_obstacle *o = NULL;
  assert_ok(abut_obstacle_create_function(context, &f, &o));
  const double ends[4] = {2, 0, 0, -1},
               curvature[8] = {0, 0, 0, -2, -0.25, 0, 0, 0};
  assert_ok(abut_obstacle_distance(o, 2, ends, d, g, h));
  for (int j = 0; j < 8; ++j)
    assert_close(h[j], curvature[j], 1e-11);
  assert_ok(abut_obstacle_destroy(&o));

  f.dimension = 3;
  f.evaluate = sphere_height;
  const double x[3] = {0.3, 0.7, 0.4};
  assert_ok(abut_obstacle_create_function(context, &f, &o));
  assert_ok(abut_obstacle_distance(o, 1, x, d, g, h));
  for (int j = 0; j < 9; ++j)
    assert_close(h[j], 0, 0);
  assert_ok(abut_obstacle_destroy(&o));
}

static int
sphere_slope(void *user, int32_t n, const double *points, double *derivative)
{
  (void)user;
  for (int32_t i = 0; i < n; ++i)
  {
    const double *x = points + 3 * i;
    const double depth = sqrt(1 - x[0] * x[0] - x[1] * x[1]);
    derivative[3 * i] = -x[0] / depth;
    derivative[3 * i + 1] = -x[1] / depth;
    derivative[3 * i + 2] = 1;
  }
  return 0;
}

/* Gaps of points that move: at the surface those of the sphere, to slopes of
 * 1.5; the axis for points that do not. */
static void
gaps_of_heights(void **state)
{
  (void)state;
  abut_obstacle_function f = abut_obstacle_function_defaults();
  f.evaluate = sphere_height;
  f.derivative = sphere_slope;
  abut_obstacle_shape s = abut_obstacle_shape_defaults();
  s.kind = ABUT_OBSTACLE_SPHERE;
  s.point[2] = 1;
  s.hollow = true;
  abut_obstacle *o = NULL, *sphere = make(&s);
  assert_ok(abut_obstacle_create_function(context, &f, &o));
  const double turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1}, shift[3] = {1, -2, 0.5};
  assert_ok(abut_obstacle_set_pose(o, turn, shift));
  assert_ok(abut_obstacle_set_pose(sphere, turn, shift));
  uint64_t seed = 17;
  for (int i = 0; i < 50; ++i)
  {
    const double a = 6.2831853 * fixture_random(&seed),
                 r = 0.83 * fixture_random(&seed),
                 x[3] = {shift[0] + r * cos(a), shift[1] + r * sin(a),
                         shift[2] + 1 - sqrt(1 - r * r)};
    double d, g[3], h[9], distance, normal[3], curvature[9];
    assert_ok(
        abut_obstacle_distance(sphere, 1, x, &distance, normal, curvature));
    assert_ok(abut_obstacle_gap(o, 1, x, &d, g, h));
    assert_close(d, 0, 1e-15);
    for (int j = 0; j < 3; ++j)
      assert_close(g[j], normal[j], 1e-14);
    for (int j = 0; j < 9; ++j)
      assert_close(h[j], curvature[j], 1e-8);
    /* Below it, to first order: 1e-4 along the axis. */
    const double below[3] = {x[0], x[1], x[2] - 1e-4};
    assert_ok(abut_obstacle_distance(sphere, 1, below, &distance, NULL, NULL));
    assert_ok(abut_obstacle_gap(o, 1, below, &d, NULL, NULL));
    assert_close(d, distance, 2e-8);
    assert_ok(abut_obstacle_distance(o, 1, below, &d, g, NULL));
    assert_close(d, -1e-4, 1e-15);
    assert_close(g[2], 1, 0);
  }
  assert_ok(abut_obstacle_destroy(&o));
  assert_ok(abut_obstacle_destroy(&sphere));
}

/* A point of the surface of a box or of a cone (2D: rectangle, wedge) with an
 * end, in the frame of the shape: s, t in [0, 1] on part k of it. */
static void
surface_point(const abut_obstacle_shape *s, int k, double a, double b,
              double *x)
{
  const int dim = s->dimension;
  const double u[2] = {a, b};
  if (s->kind == ABUT_OBSTACLE_BOX)
  {
    const int d = k / 2;
    for (int i = 0, j = 0; i < dim; ++i)
      x[i] = s->point[i]
             + s->size[i] * (i == d ? (k % 2 ? 0.5 : -0.5) : u[j++] - 0.5);
    return;
  }
  /* The axis is the last coordinate axis. */
  const double z = k == 0 ? s->length * a : s->length;
  const double r = tan(s->angle) * (k == 0 ? z : s->length * a);
  if (dim == 2)
  {
    x[0] = s->point[0] + (b < 0.5 ? -r : r);
    x[1] = s->point[1] + z;
    return;
  }
  x[0] = s->point[0] + r * cos(2 * pi * b);
  x[1] = s->point[1] + r * sin(2 * pi * b);
  x[2] = s->point[2] + z;
}

/* Nearest of many points on the surface: an upper bound of the distance that
 * exceeds it by less than the square of their spacing allows, outside and
 * inside. The sign by the definition of the shape. */
static void
nearest_points(void **state)
{
  (void)state;
  uint64_t seed = 5;
  for (int number = 0; number < 4; ++number)
  {
    abut_obstacle_shape s = shape_number(number == 0   ? 2
                                         : number == 1 ? 4
                                         : number == 2 ? 7
                                                       : 8);
    const int dim = s.dimension, m = dim == 2 ? 4000 : 300;
    memset(s.axis, 0, sizeof(s.axis));
    s.axis[dim - 1] = 1;
    abut_obstacle *o = make(&s);
    const int n_parts = s.kind == ABUT_OBSTACLE_BOX ? 2 * dim : 2;
    for (int k = 0; k < 40; ++k)
    {
      double x[3], d, g[3], best = INFINITY;
      for (int i = 0; i < dim; ++i)
        x[i] = s.point[i] + 3 * (fixture_random(&seed) - 0.5);
      assert_ok(abut_obstacle_distance(o, 1, x, &d, g, NULL));
      for (int part = 0; part < n_parts; ++part)
        for (int i = 0; i <= m; ++i)
          for (int j = 0; j <= (dim == 2 ? 1 : m); ++j)
          {
            double y[3], square = 0;
            surface_point(&s, part, (double)i / m,
                          dim == 2 ? (double)j : (double)j / m, y);
            for (int e = 0; e < dim; ++e)
              square += (x[e] - y[e]) * (x[e] - y[e]);
            best = fmin(best, square);
          }
      best = sqrt(best);
      const double spacing = (dim == 2 ? 1.5 : 6.) / m;
      assert_true(fabs(d) <= best + 1e-14);
      assert_true(best <= sqrt(d * d + spacing * spacing) + 1e-14);
    }
    assert_ok(abut_obstacle_destroy(&o));
  }
}

/* Sign, length of the gradient, |phi(x) - phi(y)| <= |x - y|, and that going
 * back by phi along the gradient ends on the surface. */
static void
eikonal(void **state)
{
  (void)state;
  uint64_t seed = 17;
  for (int number = 0; number < N_SHAPES; ++number)
  {
    const abut_obstacle_shape s = shape_number(number);
    abut_obstacle *o = make(&s);
    double last[3] = {0, 0, 0}, last_d = 0;
    int n_inside = 0;
    for (int k = 0; k < 2000; ++k)
    {
      double x[3], y[3], d, g[3] = {0, 0, 0}, e, length = 0, step = 0;
      for (int i = 0; i < 3; ++i)
        x[i] = 4 * (fixture_random(&seed) - 0.5);
      assert_ok(abut_obstacle_distance(o, 1, x, &d, g, NULL));
      for (int i = 0; i < s.dimension; ++i)
      {
        length += g[i] * g[i];
        step += (x[i] - last[i]) * (x[i] - last[i]);
        y[i] = x[i] - d * g[i];
        last[i] = x[i];
      }
      assert_close(length, 1, 1e-14);
      if (k > 0)
        assert_true(fabs(d - last_d) <= sqrt(step) + 1e-14);
      assert_ok(abut_obstacle_distance(o, 1, y, &e, NULL, NULL));
      assert_close(e, 0, 1e-14);
      last_d = d;
      n_inside += d < 0;
    }
    assert_true(n_inside > 20 && n_inside < 1980);
    assert_ok(abut_obstacle_destroy(&o));
  }
}

/* A rotation about an odd axis (2D: by an odd angle), row by row. */
static void
odd_rotation(int dim, double *r)
{
  const double c = cos(0.7), s = sin(0.7), u[3] = {2. / 7, -3. / 7, 6. / 7};
  if (dim == 2)
  {
    r[0] = r[3] = c;
    r[1] = -s;
    r[2] = s;
    return;
  }
  const double cross[9] = {0, -u[2], u[1], u[2], 0, -u[0], -u[1], u[0], 0};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      r[3 * i + j] =
          (i == j ? c : 0) + (1 - c) * u[i] * u[j] + s * cross[3 * i + j];
}

/* Gradient and second derivatives against central differences at a point;
 * false where the nearest feature changes between the points of the
 * difference: there one of the two jumps. */
static bool
check_differences(abut_obstacle *o, int dim, const double *x)
{
  const double h = 1e-5;
  double d, g[3], hessian[9], worst[2] = {0, 0};
  assert_ok(abut_obstacle_distance(o, 1, x, &d, g, hessian));
  for (int j = 0; j < dim; ++j)
  {
    double p[6], dd[2], gg[6], hh[18];
    for (int i = 0; i < dim; ++i)
      p[i] = p[dim + i] = x[i];
    p[j] += h;
    p[dim + j] -= h;
    assert_ok(abut_obstacle_distance(o, 2, p, dd, gg, hh));
    worst[0] = fmax(worst[0], fabs((dd[0] - dd[1]) / (2 * h) - g[j]));
    for (int i = 0; i < dim; ++i)
    {
      if (fabs(gg[i] - gg[dim + i]) > 1e-2)
        return false;
      worst[1] = fmax(worst[1], fabs((gg[i] - gg[dim + i]) / (2 * h)
                                     - hessian[i * dim + j]));
    }
    for (int i = 0; i < dim * dim; ++i)
      if (fabs(hh[i] - hessian[i]) > 0.05
          || fabs(hh[dim * dim + i] - hessian[i]) > 0.05 || fabs(hh[i]) > 20)
        return false;
  }
  assert_true(worst[0] < 1e-7);
  assert_true(worst[1] < 1e-5);
  return true;
}

static void
derivatives(void **state)
{
  (void)state;
  uint64_t seed = 23;
  const double shift[3] = {0.3, -0.4, 0.2};
  double rotation[9];
  for (int number = 0; number < 2 * N_SHAPES; ++number)
  {
    abut_obstacle_shape s = shape_number(number % N_SHAPES);
    s.hollow = number >= N_SHAPES;
    abut_obstacle *o = make(&s);
    odd_rotation(s.dimension, rotation);
    assert_ok(abut_obstacle_set_pose(o, rotation, shift));
    int n_checked = 0;
    for (int k = 0; k < 400; ++k)
    {
      double x[3];
      for (int i = 0; i < 3; ++i)
        x[i] = 3 * (fixture_random(&seed) - 0.5);
      n_checked += check_differences(o, s.dimension, x);
    }
    assert_true(n_checked > 380);
    assert_ok(abut_obstacle_destroy(&o));
  }
}

/* An obstacle in a pose, asked for points moved along with it, gives the same
 * distances, and gradients and second derivatives turned with it; hollow ones
 * give the opposite. */
static void
poses(void **state)
{
  (void)state;
  uint64_t seed = 41;
  const double shift[3] = {-2, 5, 0.25};
  double r[9];
  for (int number = 0; number < N_SHAPES; ++number)
  {
    abut_obstacle_shape s = shape_number(number);
    const int dim = s.dimension;
    abut_obstacle *o = make(&s);
    s.hollow = true;
    abut_obstacle *moved = make(&s);
    odd_rotation(dim, r);
    assert_ok(abut_obstacle_set_pose(moved, r, shift));
    for (int k = 0; k < 100; ++k)
    {
      double x[3], y[3], d[2], g[2][3], h[2][9];
      for (int i = 0; i < 3; ++i)
        x[i] = 3 * (fixture_random(&seed) - 0.5);
      for (int i = 0; i < dim; ++i)
      {
        y[i] = shift[i];
        for (int j = 0; j < dim; ++j)
          y[i] += r[i * dim + j] * x[j];
      }
      assert_ok(abut_obstacle_distance(o, 1, x, d, g[0], h[0]));
      assert_ok(abut_obstacle_distance(moved, 1, y, d + 1, g[1], h[1]));
      assert_close(d[1], -d[0], 2e-15);
      for (int i = 0; i < dim; ++i)
      {
        double turned = 0;
        for (int j = 0; j < dim; ++j)
          turned += r[i * dim + j] * g[0][j];
        assert_close(g[1][i], -turned, 1e-12);
        for (int j = 0; j < dim; ++j)
        {
          double sum = 0;
          for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
              sum += r[i * dim + a] * h[0][a * dim + b] * r[j * dim + b];
          assert_close(h[1][i * dim + j], -sum, 1e-9 * (1 + fabs(1 / d[0])));
        }
      }
    }
    /* Back to where it was. */
    double x[3] = {0.5, 0.25, 0.125}, d, e;
    assert_ok(abut_obstacle_set_pose(moved, NULL, NULL));
    assert_ok(abut_obstacle_distance(o, 1, x, &d, NULL, NULL));
    assert_ok(abut_obstacle_distance(moved, 1, x, &e, NULL, NULL));
    assert_true(d == -e);
    assert_ok(abut_obstacle_destroy(&o));
    assert_ok(abut_obstacle_destroy(&moved));
  }
}

/* Units divide out, from 1e-12 to 1e12, and nothing is NaN at the singular
 * points. */
static void
scales_and_singular_points(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int number = 0; number < N_SHAPES; ++number)
    for (int e = -12; e <= 12; e += 8)
    {
      const double unit = pow(2, 3.3 * e);
      abut_obstacle_shape s = shape_number(number);
      abut_obstacle *o = make(&s);
      for (int i = 0; i < 3; ++i)
      {
        s.point[i] *= unit;
        s.size[i] *= unit;
        s.axis[i] *= unit;
      }
      s.radius *= unit;
      s.length *= unit;
      abut_obstacle *scaled = make(&s);
      for (int k = 0; k < 100; ++k)
      {
        double x[3], y[3], d, f, g[3], h[9];
        for (int i = 0; i < 3; ++i)
        {
          x[i] = 3 * (fixture_random(&seed) - 0.5);
          y[i] = unit * x[i];
        }
        assert_ok(abut_obstacle_distance(o, 1, x, &d, NULL, NULL));
        assert_ok(abut_obstacle_distance(scaled, 1, y, &f, g, h));
        assert_close(f / unit, d, 1e-14);
      }
      /* The reference point of each shape is singular or on the surface. */
      double d, g[3], h[9], length = 0;
      assert_ok(abut_obstacle_distance(scaled, 1, s.point, &d, g, h));
      for (int i = 0; i < s.dimension; ++i)
        length += g[i] * g[i];
      assert_close(length, 1, 1e-14);
      for (int i = 0; i < s.dimension * s.dimension; ++i)
        assert_true(isfinite(h[i]));
      assert_ok(abut_obstacle_destroy(&o));
      assert_ok(abut_obstacle_destroy(&scaled));
    }
}

static void
refuse(const abut_obstacle_shape *s, abut_status expected, const char *word)
{
  abut_obstacle *o = NULL;
  assert_int_equal(abut_obstacle_create_shape(context, s, &o), expected);
  assert_null(o);
  if (strstr(abut_context_message(context), word) == NULL)
    fail_msg("'%s' does not name %s", abut_context_message(context), word);
}

static void
bad_shapes(void **state)
{
  (void)state;
  const double lengths[] = {0, -1, NAN, INFINITY, 1e41};
  for (size_t i = 0; i < sizeof(lengths) / sizeof(*lengths); ++i)
  {
    abut_obstacle_shape s = abut_obstacle_shape_defaults();
    s.radius = lengths[i];
    s.kind = ABUT_OBSTACLE_SPHERE;
    refuse(&s, ABUT_INVALID_ARGUMENT, "radius");
    s.kind = ABUT_OBSTACLE_CYLINDER;
    refuse(&s, ABUT_INVALID_ARGUMENT, "radius");
    s.radius = 1;
    if (i > 0)
    {
      s.length = lengths[i];
      refuse(&s, ABUT_INVALID_ARGUMENT, "length");
    }
    s.kind = ABUT_OBSTACLE_BOX;
    s.size[1] = lengths[i];
    refuse(&s, ABUT_INVALID_ARGUMENT, "size");
    s.kind = ABUT_OBSTACLE_CONE;
    s.length = 0;
    s.angle = lengths[i] == 1e41 ? pi / 2 : lengths[i];
    refuse(&s, ABUT_INVALID_ARGUMENT, "angle");
    s.kind = ABUT_OBSTACLE_PLANE;
    s.point[2] = i < 2 ? NAN : INFINITY;
    refuse(&s, ABUT_NOT_FINITE, "point");
  }
  abut_obstacle_shape s = abut_obstacle_shape_defaults();
  s.axis[2] = 0;
  refuse(&s, ABUT_INVALID_ARGUMENT, "axis");
  s.axis[0] = NAN;
  refuse(&s, ABUT_NOT_FINITE, "axis");
  s = abut_obstacle_shape_defaults();
  s.dimension = 2;
  refuse(&s, ABUT_INVALID_ARGUMENT, "axis"); /* (0, 0), not (0, 0, 1) */
  s.kind = ABUT_OBSTACLE_CYLINDER;
  refuse(&s, ABUT_UNSUPPORTED, "cylinder");
  s.kind = ABUT_OBSTACLE_SURFACE;
  refuse(&s, ABUT_INVALID_ARGUMENT, "kind");
  s.dimension = 4;
  refuse(&s, ABUT_INVALID_ARGUMENT, "dimension");
  s.struct_size = 8;
  refuse(&s, ABUT_INVALID_ARGUMENT, "version");
  refuse(NULL, ABUT_INVALID_ARGUMENT, "shape");
}

static void
bad_calls(void **state)
{
  (void)state;
  const abut_obstacle_shape s = abut_obstacle_shape_defaults();
  abut_obstacle *o = make(&s);
  const double mirror[9] = {1, 0, 0, 0, 1, 0, 0, 0, -1};
  const double stretch[9] = {2, 0, 0, 0, 1, 0, 0, 0, 0.5};
  const double broken[9] = {1, 0, 0, 0, NAN, 0, 0, 0, 1};
  const double *const matrices[] = {mirror, stretch, broken};
  for (int i = 0; i < 3; ++i)
    assert_int_equal(abut_obstacle_set_pose(o, matrices[i], NULL),
                     ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_obstacle_set_pose(o, NULL, broken + 3),
                   ABUT_NOT_FINITE);
  assert_int_equal(abut_obstacle_set_pose(NULL, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);

  const double points[6] = {0, 0, 2, 0, NAN, 1};
  double d[2];
  assert_int_equal(abut_obstacle_distance(o, 2, points, d, NULL, NULL),
                   ABUT_NOT_FINITE);
  assert_non_null(strstr(abut_context_message(context), "point 1 = (0, nan"));
  assert_int_equal(abut_obstacle_distance(o, -1, points, d, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_obstacle_distance(o, 1, NULL, d, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_obstacle_distance(o, 1, points, NULL, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_obstacle_distance(NULL, 1, points, d, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_obstacle_distance(o, 0, NULL, NULL, NULL, NULL));
  /* The refused poses have changed nothing. */
  assert_ok(abut_obstacle_distance(o, 1, points, d, NULL, NULL));
  assert_close(d[0], 2, 0);

  abut_obstacle_view v;
  assert_ok(abut_obstacle_get(o, &v));
  assert_int_equal(v.kind, ABUT_OBSTACLE_PLANE);
  assert_close(v.rotation[4], 1, 0);
  assert_string_equal(abut_obstacle_name(v.kind), "plane");
  assert_string_equal(abut_obstacle_name(ABUT_OBSTACLE_SURFACE), "surface");
  abut_obstacle_kind kind = ABUT_OBSTACLE_PLANE;
  assert_int_equal(abut_obstacle_find("cone", &kind), ABUT_SUCCESS);
  assert_int_equal(kind, ABUT_OBSTACLE_CONE);
  assert_int_equal(abut_obstacle_find("cones", &kind), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_obstacle_find(NULL, &kind), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_obstacle_fields(ABUT_OBSTACLE_BOX), ABUT_SHAPE_SIZE);
  assert_int_equal(abut_obstacle_fields(ABUT_OBSTACLE_FUNCTION), 0);
  assert_int_equal(abut_obstacle_fields(ABUT_OBSTACLE_N_KINDS), 0);
  assert_string_equal(abut_obstacle_name(ABUT_OBSTACLE_N_KINDS), "");
  assert_ok(abut_obstacle_destroy(&o));
  assert_ok(abut_obstacle_destroy(&o));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(sizes, set_up, tear_down),
      cmocka_unit_test_setup_teardown(known_distances, set_up, tear_down),
      cmocka_unit_test_setup_teardown(functions, set_up, tear_down),
      cmocka_unit_test_setup_teardown(curvature_of_functions, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(nearest_points, set_up, tear_down),
      cmocka_unit_test_setup_teardown(eikonal, set_up, tear_down),
      cmocka_unit_test_setup_teardown(derivatives, set_up, tear_down),
      cmocka_unit_test_setup_teardown(poses, set_up, tear_down),
      cmocka_unit_test_setup_teardown(scales_and_singular_points, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(bad_shapes, set_up, tear_down),
      cmocka_unit_test_setup_teardown(bad_calls, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
