/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Obstacles of facets: against the shapes that they approximate or are,
 * against oracles of which side a point is on, and bad input. */
#include "surface_fixture.h"

#include <abut/obstacle_surface.h>

static const double pi = 3.14159265358979323846;

/* Merge nodes at one place and, for triangles, halve the quadrilaterals. */
static scene_mesh
closed_box(const double *lower, const double *upper, int32_t m, bool triangles)
{
  scene_mesh box = scene_box(lower, upper, m);
  int32_t *number = malloc((size_t)box.n_nodes * sizeof(*number)), n = 0;
  for (int32_t i = 0; i < box.n_nodes; ++i)
  {
    const double *x = box.position + 3 * i;
    int32_t j = 0;
    while (j < n)
    {
      const double *y = box.position + 3 * j;
      if (fabs(x[0] - y[0]) + fabs(x[1] - y[1]) + fabs(x[2] - y[2]) < 1e-9)
        break;
      ++j;
    }
    if (j == n)
      memmove(box.position + 3 * n++, x, 3 * sizeof(double));
    number[i] = j;
  }
  for (int32_t k = 0; k < 4 * box.n_facets; ++k)
    box.connectivity[k] = number[box.connectivity[k]];
  free(number);
  box.n_nodes = n;
  if (!triangles)
    return box;
  int32_t *c = malloc(6 * (size_t)box.n_facets * sizeof(*c));
  for (int32_t f = 0; f < box.n_facets; ++f)
  {
    const int32_t *q = box.connectivity + 4 * f;
    const int32_t two[6] = {q[0], q[1], q[3], q[0], q[3], q[2]};
    memcpy(c + 6 * f, two, sizeof(two));
  }
  free(box.connectivity);
  box.connectivity = c;
  box.n_facets *= 2;
  box.kind = ABUT_FACET_TRI3;
  return box;
}

/* The surface of a cube blown up to the unit sphere. */
static scene_mesh
ball(int32_t m, bool triangles)
{
  const double lower[3] = {-1, -1, -1}, upper[3] = {1, 1, 1};
  scene_mesh mesh = closed_box(lower, upper, m, triangles);
  for (int32_t i = 0; i < mesh.n_nodes; ++i)
  {
    double *x = mesh.position + 3 * i, s = 0;
    for (int d = 0; d < 3; ++d)
    {
      x[d] = tan(x[d] * pi / 4);
      s += x[d] * x[d];
    }
    for (int d = 0; d < 3; ++d)
      x[d] /= sqrt(s);
  }
  return mesh;
}

/* Polygon with n corners at the given radii, counter-clockwise. */
static scene_mesh
polygon(int32_t n, const double *radius)
{
  scene_mesh mesh = {2, n, n, ABUT_FACET_LINE2, NULL, NULL};
  mesh.position = malloc(2 * (size_t)n * sizeof(double));
  mesh.connectivity = malloc(2 * (size_t)n * sizeof(int32_t));
  for (int32_t i = 0; i < n; ++i)
  {
    mesh.position[2 * i] = radius[i] * cos(2 * pi * i / n);
    mesh.position[2 * i + 1] = radius[i] * sin(2 * pi * i / n);
    mesh.connectivity[2 * i] = i;
    mesh.connectivity[2 * i + 1] = (i + 1) % n;
  }
  return mesh;
}

static abut_obstacle *
obstacle_of(abut_surface *surface, const abut_obstacle_surface *options)
{
  abut_obstacle *o = NULL;
  require(abut_obstacle_create_surface(context, surface, options, &o));
  return o;
}

/* Largest error of the distance to the unit sphere (2D: circle), over points
 * at distances up to `far`. */
static double
error_of_ball(scene_mesh mesh, double far)
{
  uint64_t seed = 7;
  const int32_t n = 1000, dim = mesh.dimension;
  double *x = malloc((size_t)(n * dim) * sizeof(double));
  double *phi = malloc((size_t)n * sizeof(double)), worst = 0;
  double *g = malloc((size_t)(n * dim) * sizeof(double));
  for (int32_t i = 0; i < n; ++i)
  {
    double s = 0;
    for (int d = 0; d < dim; ++d)
    {
      x[dim * i + d] = scene_uniform(&seed) - 0.5;
      s += x[dim * i + d] * x[dim * i + d];
    }
    const double r = 0.3 + (0.7 + far) * scene_uniform(&seed);
    for (int d = 0; d < dim; ++d)
      x[dim * i + d] *= r / sqrt(s);
  }
  abut_surface *surface = surface_of(&mesh);
  abut_obstacle *o = obstacle_of(surface, NULL);
  require(abut_obstacle_distance(o, n, x, phi, g, NULL));
  for (int32_t i = 0; i < n; ++i)
  {
    double r = 0, length = 0, outwards = 0;
    for (int d = 0; d < dim; ++d)
    {
      r += x[dim * i + d] * x[dim * i + d];
      length += g[dim * i + d] * g[dim * i + d];
      outwards += x[dim * i + d] * g[dim * i + d];
    }
    r = sqrt(r);
    worst = fmax(worst, fabs(phi[i] - (r - 1)));
    assert_true(fabs(length - 1) < 1e-12);
    assert_true(outwards > 0.5 * r);
  }
  require(abut_obstacle_destroy(&o));
  require(abut_surface_destroy(&surface));
  free(x);
  free(phi);
  free(g);
  scene_free(&mesh);
  return worst;
}

/* Chords lie h^2/8 deep in the ball. */
static void
second_order(void **state)
{
  (void)state;
  for (int triangles = 0; triangles < 2; ++triangles)
  {
    const double coarse = error_of_ball(ball(8, triangles == 1), 4);
    const double fine = error_of_ball(ball(16, triangles == 1), 4);
    const double order = log2(coarse / fine);
    assert_true(order > 1.9 && order < 2.1);
    /* Edges are at most pi/16 long, diagonals sqrt(2) times that; a
     * triangle's centre is deepest: radius^2/2 of its circle. */
    assert_true(coarse < pow(pi / 16 * sqrt(2), 2) / 8 * 1.2);
  }
  double radius[64];
  for (int i = 0; i < 64; ++i)
    radius[i] = 1;
  const double worst = error_of_ball(polygon(64, radius), 4);
  assert_true(worst <= 1 - cos(pi / 64) + 1e-14);
  assert_true(worst > 0.9 * (1 - cos(pi / 64)));
}

/* A box of facets is a box. */
static void
box_is_exact(void **state)
{
  (void)state;
  const double lower[3] = {-1, -0.5, 0}, upper[3] = {1, 0.5, 0.75};
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  shape.kind = ABUT_OBSTACLE_BOX;
  for (int d = 0; d < 3; ++d)
  {
    shape.point[d] = 0.5 * (lower[d] + upper[d]);
    shape.size[d] = upper[d] - lower[d];
  }
  abut_obstacle *exact = NULL;
  require(abut_obstacle_create_shape(context, &shape, &exact));
  for (int m = 1; m <= 16; m *= 4)
    for (int triangles = 0; triangles < 2; ++triangles)
    {
      uint64_t seed = 11;
      scene_mesh mesh = closed_box(lower, upper, m, triangles == 1);
      abut_surface *surface = surface_of(&mesh);
      abut_obstacle *o = obstacle_of(surface, NULL);
      int n_inside = 0, n_corner = 0;
      for (int k = 0; k < 1000; ++k)
      {
        double x[3], d, e, g[3], n[3];
        for (int i = 0; i < 3; ++i)
        {
          const double t = 2 * scene_uniform(&seed) - 0.5;
          x[i] = lower[i] + t * (upper[i] - lower[i]);
          /* Some exactly above edges and corners, or on them. */
          if (k % 4 == 0 && scene_uniform(&seed) < 0.5)
            x[i] = upper[i];
        }
        require(abut_obstacle_distance(o, 1, x, &d, g, NULL));
        require(abut_obstacle_distance(exact, 1, x, &e, n, NULL));
        assert_true(fabs(d - e) < 1e-14);
        n_inside += d < 0;
        if (e > 1e-8)
          for (int i = 0; i < 3; ++i)
            assert_true(fabs(g[i] - n[i]) < 1e-7);
        n_corner += e > 0 && fabs(n[0] * n[1] * n[2]) > 1e-6;
      }
      assert_true(n_inside > 50 && n_corner > 50);
      require(abut_obstacle_destroy(&o));
      require(abut_surface_destroy(&surface));
      scene_free(&mesh);
    }
  require(abut_obstacle_destroy(&exact));
}

/* Whether x = s (a p + b q + c r) with a, b, c >= 0 and a + b + c = 1; then
 * s: where on the ray through the triangle x is. */
static bool
on_ray(const double *p, const double *q, const double *r, const double *x,
       double *s)
{
  const double *columns[3] = {p, q, r};
  double weight[3], det = 0, sum = 0;
  for (int k = 0; k < 4; ++k)
  {
    const double *c[3] = {columns[0], columns[1], columns[2]};
    if (k < 3)
      c[k] = x;
    const double d = c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1])
                     - c[1][0] * (c[0][1] * c[2][2] - c[0][2] * c[2][1])
                     + c[2][0] * (c[0][1] * c[1][2] - c[0][2] * c[1][1]);
    if (k < 3)
      weight[k] = d;
    else
      det = d;
  }
  for (int k = 0; k < 3; ++k)
  {
    weight[k] /= det;
    if (weight[k] < 0)
      return false;
    sum += weight[k];
  }
  *s = sum;
  return true;
}

/* Spikes and pits all over a ball, starlike about its middle: the side of a
 * point is read on the ray through it. Edges and corners are nearest for most
 * points, where a facet's own normal often gives the wrong sign. */
static void
sides_of_spikes(void **state)
{
  (void)state;
  uint64_t seed = 5;
  scene_mesh mesh = ball(6, true);
  for (int32_t i = 0; i < mesh.n_nodes; ++i)
  {
    const double r = 0.35 + 0.65 * scene_uniform(&seed);
    for (int d = 0; d < 3; ++d)
      mesh.position[3 * i + d] *= r;
  }
  abut_surface *surface = surface_of(&mesh);
  abut_obstacle *o = obstacle_of(surface, NULL);
  int n_inside = 0, n_checked = 0;
  for (int k = 0; k < 2000; ++k)
  {
    double x[3], d, s = 0;
    for (int i = 0; i < 3; ++i)
      x[i] = 1.6 * (scene_uniform(&seed) - 0.5);
    require(abut_obstacle_distance(o, 1, x, &d, NULL, NULL));
    for (int32_t f = 0; f < mesh.n_facets; ++f)
    {
      const int32_t *c = mesh.connectivity + 3 * f;
      if (!on_ray(mesh.position + 3 * c[0], mesh.position + 3 * c[1],
                  mesh.position + 3 * c[2], x, &s))
        continue;
      if (fabs(s - 1) < 1e-9)
        continue;
      assert_true((d > 0) == (s > 1));
      n_inside += d < 0;
      ++n_checked;
      break;
    }
  }
  assert_true(n_checked > 1995 && n_inside > 200 && n_inside < 1800);
  require(abut_obstacle_destroy(&o));
  require(abut_surface_destroy(&surface));
  scene_free(&mesh);
}

/* The same in 2D, with distances from all sides of the polygon and the side by
 * counting crossings. */
static void
star_polygon(void **state)
{
  (void)state;
  uint64_t seed = 29;
  double radius[40];
  for (int i = 0; i < 40; ++i)
    radius[i] = i % 2 ? 1 : 0.2 + 0.3 * scene_uniform(&seed);
  scene_mesh mesh = polygon(40, radius);
  abut_surface *surface = surface_of(&mesh);
  abut_obstacle *o = obstacle_of(surface, NULL);
  for (int k = 0; k < 3000; ++k)
  {
    double x[2], d, g[2], nearest = INFINITY;
    bool inside = false;
    for (int i = 0; i < 2; ++i)
      x[i] = 2.4 * (scene_uniform(&seed) - 0.5);
    for (int i = 0; i < 40; ++i)
    {
      const double *a = mesh.position + 2 * i;
      const double *b = mesh.position + 2 * ((i + 1) % 40);
      const double u[2] = {b[0] - a[0], b[1] - a[1]};
      double t = ((x[0] - a[0]) * u[0] + (x[1] - a[1]) * u[1])
                 / (u[0] * u[0] + u[1] * u[1]);
      t = fmin(fmax(t, 0), 1);
      nearest =
          fmin(nearest, hypot(x[0] - a[0] - t * u[0], x[1] - a[1] - t * u[1]));
      if ((a[1] > x[1]) != (b[1] > x[1])
          && x[0] < a[0] + (x[1] - a[1]) / u[1] * u[0])
        inside = !inside;
    }
    require(abut_obstacle_distance(o, 1, x, &d, g, NULL));
    assert_true(fabs(fabs(d) - nearest) < 1e-14);
    assert_true(nearest < 1e-12 || (d < 0) == inside);
    /* Back along the gradient lies the surface. */
    double y[2] = {x[0] - d * g[0], x[1] - d * g[1]}, e;
    require(abut_obstacle_distance(o, 1, y, &e, NULL, NULL));
    assert_true(fabs(e) < 1e-13);
  }
  require(abut_obstacle_destroy(&o));
  require(abut_surface_destroy(&surface));
  scene_free(&mesh);
}

/* Points at all distances at once give what each gives alone; hollow ones the
 * opposite; moved surfaces move along. */
static void
batches_poses_and_updates(void **state)
{
  (void)state;
  enum
  {
    N = 1000
  };
  static double x[3 * N], y[3 * N], alone[N], d[N], g[3 * N], h[3 * N];
  uint64_t seed = 19;
  for (int i = 0; i < 3 * N; ++i)
    x[i] = (scene_uniform(&seed) - 0.5) * pow(10, (i / 3) % 4 - 1) * 3;
  scene_mesh mesh = ball(12, true);
  abut_surface *surface = surface_of(&mesh);
  abut_obstacle *o = obstacle_of(surface, NULL);
  require(abut_obstacle_distance(o, N, x, d, g, NULL));
  for (int i = 0; i < N; ++i)
    require(
        abut_obstacle_distance(o, 1, x + 3 * i, alone + i, h + 3 * i, NULL));
  assert_memory_equal(d, alone, sizeof(d));
  assert_memory_equal(g, h, sizeof(g));
  require(abut_obstacle_destroy(&o));
  abut_obstacle_surface options = abut_obstacle_surface_defaults();
  options.hollow = true;
  o = obstacle_of(surface, &options);
  const double turn[9] = {0, -1, 0, 0, 0, -1, 1, 0, 0}, shift[3] = {4, 5, 6};
  require(abut_obstacle_set_pose(o, turn, shift));
  for (int i = 0; i < N; ++i)
  {
    y[3 * i] = shift[0] - x[3 * i + 1];
    y[3 * i + 1] = shift[1] - x[3 * i + 2];
    y[3 * i + 2] = shift[2] + x[3 * i];
  }
  require(abut_obstacle_distance(o, N, y, d, g, NULL));
  for (int i = 0; i < N; ++i)
  {
    assert_true(fabs(d[i] + alone[i]) < 1e-12);
    if (fabs(alone[i] + 1) > 0.5 && fabs(alone[i]) > 1e-3)
      assert_true(fabs(g[3 * i + 2] + h[3 * i]) < 1e-9);
  }
  require(abut_obstacle_destroy(&o));

  o = obstacle_of(surface, NULL);
  for (int32_t i = 0; i < mesh.n_nodes; ++i)
    for (int k = 0; k < 3; ++k)
      mesh.position[3 * i + k] = 10 * mesh.position[3 * i + k] + shift[k];
  require(abut_surface_update(surface, mesh.position));
  for (int i = 0; i < 3 * N; ++i)
    y[i] = 10 * x[i] + shift[i % 3];
  require(abut_obstacle_distance(o, N, y, d, NULL, NULL));
  for (int i = 0; i < N; ++i)
    assert_true(fabs(d[i] - 10 * alone[i]) < 1e-12 * (1 + fabs(d[i])));
  require(abut_obstacle_destroy(&o));
  require(abut_surface_destroy(&surface));
  scene_free(&mesh);
}

static void
limits(void **state)
{
  (void)state;
  scene_mesh mesh = ball(10, true);
  abut_surface *surface = surface_of(&mesh);
  const double x[12] = {0, 0, 1.05, 0, 0, 0, 0, 5, 0, 0, 0, 0.95};
  for (int k = 0; k < 4; ++k)
  {
    abut_obstacle_surface options = abut_obstacle_surface_defaults();
    options.limit = k < 2 ? 0.2 : 0.7;
    options.hollow = k % 2 == 1;
    const double sign = options.hollow ? -1 : 1;
    abut_obstacle *o = obstacle_of(surface, &options);
    double d[4], g[12];
    abut_obstacle_view v;
    require(abut_obstacle_distance(o, 4, x, d, g, NULL));
    require(abut_obstacle_get(o, &v));
    assert_int_equal(v.n_beyond, 2);
    assert_true(fabs(d[0] - sign * 0.05) < 0.01);
    assert_true(d[1] == options.limit && d[2] == options.limit);
    assert_true(fabs(d[3] + sign * 0.05) < 0.01);
    assert_true(g[7] == 1 && fabs(g[5]) == 1);
    require(abut_obstacle_distance(o, 1, x, d, NULL, NULL));
    require(abut_obstacle_get(o, &v));
    assert_int_equal(v.n_beyond, 0);
    require(abut_obstacle_destroy(&o));
  }
  require(abut_surface_destroy(&surface));
  scene_free(&mesh);
}

static void
refuse(const scene_mesh *mesh, const abut_obstacle_surface *options,
       bool unchecked, const char *word)
{
  abut_surface *surface = NULL;
  abut_obstacle *o = NULL;
  abut_surface_data data = scene_data(mesh);
  data.check_orientation = !unchecked;
  require(abut_surface_create(context, &data, &surface));
  assert_int_equal(abut_obstacle_create_surface(context, surface, options, &o),
                   ABUT_INVALID_MESH);
  assert_null(o);
  if (strstr(abut_context_message(context), word) == NULL)
    fail_msg("'%s' does not say '%s'", abut_context_message(context), word);
  require(abut_surface_destroy(&surface));
}

static void
bad_surfaces(void **state)
{
  (void)state;
  scene_mesh mesh = ball(4, true);
  int32_t *c = mesh.connectivity;
  /* One facet missing. */
  mesh.n_facets -= 1;
  refuse(&mesh, NULL, false, "not closed");
  mesh.n_facets += 1;
  /* One facet turned. */
  const int32_t swap = c[6];
  c[6] = c[7];
  c[7] = swap;
  refuse(&mesh, NULL, true, "inverted");
  c[7] = c[6];
  c[6] = swap;
  /* All turned. */
  for (int32_t f = 0; f < mesh.n_facets; ++f)
  {
    const int32_t first = c[3 * f];
    c[3 * f] = c[3 * f + 1];
    c[3 * f + 1] = first;
  }
  refuse(&mesh, NULL, false, "inside out");
  mesh.n_facets = 0;
  refuse(&mesh, NULL, false, "no facets");
  scene_free(&mesh);

  /* Three facets at one side. */
  static double position[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1};
  static int32_t fins[9] = {0, 1, 2, 0, 1, 3, 0, 1, 4};
  const scene_mesh many = {3, 5, 3, ABUT_FACET_TRI3, position, fins};
  abut_obstacle_surface open = abut_obstacle_surface_defaults();
  open.open = true;
  refuse(&many, &open, true, "more than two");

  const double plane[5] = {-1, -1, 2, 2, 0.5};
  scene_mesh sheet =
      scene_patch(ABUT_FACET_QUAD4, 4, 4, scene_plane, plane, false);
  refuse(&sheet, NULL, false, "not closed");
  abut_surface *surface = surface_of(&sheet);
  abut_obstacle *o = NULL;
  open.limit = NAN;
  assert_int_equal(abut_obstacle_create_surface(context, surface, &open, &o),
                   ABUT_INVALID_ARGUMENT);
  open.limit = 0;
  open.struct_size = 1;
  assert_int_equal(abut_obstacle_create_surface(context, surface, &open, &o),
                   ABUT_INVALID_ARGUMENT);
  open.struct_size = sizeof(open);
  assert_int_equal(abut_obstacle_create_surface(context, NULL, &open, &o),
                   ABUT_INVALID_ARGUMENT);

  /* Accepted as a sheet: the plane z = 1/2 over the square, its border
   * beside. */
  o = obstacle_of(surface, &open);
  const double x[9] = {0.3, 0.2, 0.75, 0.3, -0.7, 0.25, 1.3, 0, 0.9};
  double d[3], g[9], hessian[27];
  require(abut_obstacle_distance(o, 3, x, d, g, NULL));
  assert_true(fabs(d[0] - 0.25) < 1e-15 && fabs(d[1] + 0.25) < 1e-15);
  assert_true(g[2] == 1 && g[5] == 1);
  assert_true(fabs(d[2] - 0.5) < 1e-15 && fabs(g[6] - 0.6) < 1e-15);
  require(abut_obstacle_distance(o, 3, x, d, g, hessian));
  for (int i = 0; i < 27; ++i)
    assert_true(hessian[i] == 0);
  require(abut_obstacle_destroy(&o));
  require(abut_surface_destroy(&surface));
  scene_free(&sheet);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(second_order, set_up, tear_down),
      cmocka_unit_test_setup_teardown(box_is_exact, set_up, tear_down),
      cmocka_unit_test_setup_teardown(sides_of_spikes, set_up, tear_down),
      cmocka_unit_test_setup_teardown(star_polygon, set_up, tear_down),
      cmocka_unit_test_setup_teardown(batches_poses_and_updates, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(limits, set_up, tear_down),
      cmocka_unit_test_setup_teardown(bad_surfaces, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
