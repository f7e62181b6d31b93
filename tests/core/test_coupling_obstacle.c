/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Coupling of surfaces and rigid obstacles. */
#include "coupling_fixture.h"

#include <abut/obstacle.h>
#include <abut/obstacle_surface.h>

static couple
couple_obstacle(const scene_mesh *mesh, abut_obstacle *obstacle,
                const abut_coupling_options *options)
{
  couple c;
  memset(&c, 0, sizeof(c));
  c.secondary = surface_of(mesh);
  require(abut_coupling_create_obstacle(context, c.secondary, obstacle, options,
                                        &c.coupling));
  couple_build(&c, NULL);
  return c;
}

static abut_obstacle *
make(const abut_obstacle_shape *shape)
{
  abut_obstacle *o = NULL;
  require(abut_obstacle_create_shape(context, shape, &o));
  return o;
}

/* Uniform gap over a plane: every row sees it, rows have no primary, weights
 * are the consistent areas for mortar and node to segment. */
static void
test_plane(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[3] = {ABUT_FACET_QUAD4, ABUT_FACET_QUAD9,
                                           ABUT_FACET_TRI3};
  const double p[5] = {0., 0., 1., 1., 0.1}, angles[3] = {0.2, 0.5, -0.3},
               none[3] = {0., 0., 0.};
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  double x[6] = {0., 0., 0., 0., 0., 1.};
  int32_t no[1] = {0};
  scene_mesh frame = {3, 2, 0, ABUT_FACET_QUAD4, x, no};
  scene_move(&frame, 1., angles, none);
  for (int d = 0; d < 3; ++d)
    shape.axis[d] = x[3 + d];
  abut_obstacle *plane = make(&shape);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < ABUT_DISCRETISATION_N; ++k)
    {
      abut_coupling_options o = abut_coupling_defaults();
      o.discretisation = (abut_discretisation)k;
      scene_mesh s = scene_patch(kinds[i], 3, 3, scene_plane, p, true);
      scene_move(&s, 1., angles, none);
      couple c = couple_obstacle(&s, plane, &o);
      check_rows(&c);
      near(c.statistics.covered_area, 1., 1e-14, "covered");
      double area[49];
      nodal_areas(c.secondary, area);
      for (int32_t j = 0; j < c.view.n_rows; ++j)
      {
        near(c.view.gap[j], 0.1, 1e-14, "gap");
        for (int d = 0; d < 3; ++d)
          near(c.view.normal[3 * j + d], -shape.axis[d], 1e-14, "normal");
        assert_int_equal(c.view.primary_start[j + 1], 0);
        if (c.view.node[j] >= 0)
          near(c.view.weight[j], area[c.view.node[j]], 1e-14, "weight");
      }
      if (k != ABUT_DISCRETISATION_QUADRATURE_POINT)
        assert_int_equal(c.view.n_rows, s.n_nodes);
      couple_destroy(&c);
      scene_free(&s);
    }
  require(abut_obstacle_destroy(&plane));
}

/* A disc on a plane: rows of nodes within reach only, none on the far side. */
static void
test_reach(void **state)
{
  (void)state;
  const double disc[5] = {0., 1.01, 1., 0., 6.283185307179586};
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  shape.dimension = 2;
  shape.axis[1] = 1.;
  abut_obstacle *plane = make(&shape);
  for (int k = 0; k < ABUT_DISCRETISATION_N; ++k)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.discretisation = (abut_discretisation)k;
    o.search.relative_reach = 0.;
    o.search.reach = 0.2;
    scene_mesh s = scene_patch(ABUT_FACET_LINE2, 64, 1, scene_arc, disc, false);
    couple c = couple_obstacle(&s, plane, &o);
    check_rows(&c);
    assert_true(c.view.n_rows > 5);
    for (int32_t j = 0; j < c.view.n_rows; ++j)
    {
      /* 0.002: the facets' sagitta of 0.0012 and the width of a row. */
      near(c.view.gap[j], c.view.position[2 * j + 1], 0.002, "gap");
      assert_true(c.view.gap[j] <= 0.2);
    }
    if (k == ABUT_DISCRETISATION_NODE_TO_SEGMENT)
    {
      int32_t n = 0;
      for (int32_t i = 0; i < s.n_nodes; ++i)
        n += s.position[2 * i + 1] <= 0.2;
      assert_int_equal(c.view.n_rows, n);
    }
    couple_destroy(&c);
    scene_free(&s);
  }
  require(abut_obstacle_destroy(&plane));
}

/* An obstacle that has been put deep into a body, far beyond the reach: there
 * is nothing behind it that could be meant, so all rows are there. */
static void
test_deep(void **state)
{
  (void)state;
  const double line[4] = {0., 0., 1., 0.};
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  shape.dimension = 2;
  shape.axis[1] = 1.;
  shape.point[1] = 5.;
  abut_obstacle *plane = make(&shape);
  for (int k = 0; k < ABUT_DISCRETISATION_N; ++k)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.discretisation = (abut_discretisation)k;
    scene_mesh s = scene_patch(ABUT_FACET_LINE2, 8, 1, scene_line, line, false);
    couple c = couple_obstacle(&s, plane, &o);
    check_rows(&c);
    near(c.statistics.covered_area, 1., 1e-14, "covered");
    assert_true(c.view.n_rows >= s.n_nodes);
    for (int32_t j = 0; j < c.view.n_rows; ++j)
      near(c.view.gap[j], -5., 1e-14, "gap");
    couple_destroy(&c);
    scene_free(&s);
  }
  require(abut_obstacle_destroy(&plane));
}

/* A flat patch over a sphere: gaps of nodes are exact, those of mortar rows
 * differ by less than the facet's diameter squared by the radius. */
static void
test_sphere(void **state)
{
  (void)state;
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  shape.kind = ABUT_OBSTACLE_SPHERE;
  shape.radius = 2.;
  abut_obstacle *sphere = make(&shape);
  const double p[5] = {-0.5, -0.5, 1., 1., 2.01};
  for (int k = 0; k < ABUT_DISCRETISATION_N; ++k)
  {
    abut_coupling_options o = abut_coupling_defaults();
    o.discretisation = (abut_discretisation)k;
    o.search.reach = 1.;
    scene_mesh s = scene_patch(ABUT_FACET_QUAD4, 6, 6, scene_plane, p, true);
    couple c = couple_obstacle(&s, sphere, &o);
    check_rows(&c);
    for (int32_t j = 0; j < c.view.n_rows; ++j)
    {
      const double *x = c.view.position + 3 * j;
      const double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
      const bool nodal = k == ABUT_DISCRETISATION_NODE_TO_SEGMENT
                         || k == ABUT_DISCRETISATION_QUADRATURE_POINT;
      /* Standard functions of the border have their centres inside. */
      if (k == ABUT_DISCRETISATION_MORTAR
          && fmax(fabs(x[0]), fabs(x[1])) > 0.49)
        continue;
      near(c.view.gap[j], r - 2., nodal ? 1e-14 : 1. / 36. / 2., "gap");
      for (int d = 0; nodal && d < 3; ++d)
        near(c.view.normal[3 * j + d], -x[d] / r, 1e-14, "normal");
    }
    couple_destroy(&c);
    scene_free(&s);
  }
  require(abut_obstacle_destroy(&sphere));
}

/* An obstacle of facets gives the rows of the plane that it is. */
static void
test_surface(void **state)
{
  (void)state;
  const double ground[5] = {-2., -2., 5., 5., 0.},
               p[5] = {0., 0., 1., 1., 0.05};
  scene_mesh g = scene_patch(ABUT_FACET_TRI3, 7, 5, scene_plane, ground, false),
             s = scene_patch(ABUT_FACET_QUAD4, 3, 3, scene_plane, p, true);
  abut_surface *facets = surface_of(&g);
  abut_obstacle_surface options = abut_obstacle_surface_defaults();
  options.open = true;
  abut_obstacle *o = NULL;
  require(abut_obstacle_create_surface(context, facets, &options, &o));
  couple c = couple_obstacle(&s, o, NULL);
  check_rows(&c);
  assert_int_equal(c.view.n_rows, 16);
  for (int32_t j = 0; j < 16; ++j)
    near(c.view.gap[j], 0.05, 1e-14, "gap");
  couple_destroy(&c);
  require(abut_obstacle_destroy(&o));
  require(abut_surface_destroy(&facets));
  scene_free(&g);
  scene_free(&s);
}

/* A thin plate that has come in by four fifths of its thickness, and by nine
 * tenths: its far side is the nearer one, and the gap is that of the near one.
 * Where the surface has a skin behind it, within the way that the plate would
 * push it, nothing is taken for the near side of anything. */
static void
test_thin(void **state)
{
  (void)state;
  const double p[5] = {0., 0., 1., 1., 0.}, angles[3] = {0.2, 0.5, -0.3},
               shift[3] = {1., 2., 3.};
  for (int turned = 0; turned < 2; ++turned)
    for (int k = 0; k < ABUT_DISCRETISATION_N; ++k)
      for (int step = 0; step < 3; ++step)
      {
        const double way = step == 1 ? 0.009 : 0.008;
        abut_obstacle_shape shape = abut_obstacle_shape_defaults();
        shape.kind = ABUT_OBSTACLE_BOX;
        shape.size[0] = shape.size[1] = 10.;
        shape.size[2] = 0.01;
        shape.point[2] = way - 0.005;
        abut_obstacle *plate = make(&shape);
        abut_coupling_options o = abut_coupling_defaults();
        o.discretisation = (abut_discretisation)k;
        o.thickness = step == 2 ? 0.007 : 0.;
        scene_mesh s =
            scene_patch(ABUT_FACET_QUAD4, 3, 3, scene_plane, p, true);
        double x[12] = {0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.};
        int32_t no[1] = {0};
        scene_mesh frame = {3, 4, 0, ABUT_FACET_QUAD4, x, no};
        if (turned)
        {
          double rotation[9];
          scene_move(&frame, 1., angles, shift);
          for (int d = 0; d < 3; ++d)
            for (int e = 0; e < 3; ++e)
              rotation[3 * d + e] = x[3 * (e + 1) + d] - x[d];
          require(abut_obstacle_set_pose(plate, rotation, x));
          scene_move(&s, 1., angles, shift);
        }
        couple c = couple_obstacle(&s, plate, &o);
        if (step == 2)
          assert_int_equal(c.view.n_rows, 0);
        else
          assert_true(c.view.n_rows >= 16);
        for (int32_t j = 0; j < c.view.n_rows; ++j)
        {
          near(c.view.gap[j], -way, 1e-12, "gap");
          for (int d = 0; d < 3; ++d)
            near(c.view.normal[3 * j + d], x[d] - x[9 + d], 1e-12, "normal");
        }
        couple_destroy(&c);
        scene_free(&s);
        require(abut_obstacle_destroy(&plate));
      }
}

static int
fails(void *user, int32_t n, const double *x, double *value, double *gradient)
{
  (void)x;
  for (int32_t i = 0; i < n; ++i)
  {
    value[i] = 0.01;
    gradient[3 * i] = gradient[3 * i + 1] = 0.;
    gradient[3 * i + 2] = 1.;
  }
  return *(const int *)user;
}

/* A function that fails is reported; the coupling works again afterwards. */
static void
test_failures(void **state)
{
  (void)state;
  int failing = 0;
  const double p[5] = {0., 0., 1., 1., 0.05};
  abut_obstacle_function f = abut_obstacle_function_defaults();
  f.evaluate = fails;
  f.user = &failing;
  abut_obstacle *o = NULL, *flat = NULL;
  require(abut_obstacle_create_function(context, &f, &o));
  scene_mesh s = scene_patch(ABUT_FACET_QUAD4, 3, 3, scene_plane, p, true);
  couple c = couple_obstacle(&s, o, NULL);
  assert_int_equal(c.view.n_rows, 16);
  failing = 1;
  assert_int_equal(couple_try(&c, NULL), ABUT_CALLBACK_FAILED);
  couple_look(&c);
  assert_int_equal(c.view.n_rows, 0);
  failing = 0;
  couple_build(&c, NULL);
  assert_int_equal(c.view.n_rows, 16);
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  shape.dimension = 2;
  shape.axis[1] = 1.;
  flat = make(&shape);
  abut_coupling *none = NULL;
  assert_int_equal(
      abut_coupling_create_obstacle(context, c.secondary, flat, NULL, &none),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_coupling_create_obstacle(context, c.secondary, NULL, NULL, &none),
      ABUT_INVALID_ARGUMENT);
  couple_destroy(&c);
  require(abut_obstacle_destroy(&flat));
  require(abut_obstacle_destroy(&o));
  scene_free(&s);
}

/* A slope as a height along the last axis, z - 3 x / 4: 4 / 5 of that is the
 * distance, and (-3, 4) / 5 the normal; the gradient of evaluate is the axis.
 */
static int
height(void *user, int32_t n, const double *x, double *value, double *gradient)
{
  const int32_t dim = *(const int32_t *)user;
  for (int32_t i = 0; i < n; ++i, x += dim)
  {
    value[i] = x[dim - 1] - 0.75 * x[0];
    for (int32_t d = 0; d < dim; ++d)
      gradient[dim * i + d] = d == dim - 1;
  }
  return 0;
}

static int
slope(void *user, int32_t n, const double *x, double *derivative)
{
  (void)x;
  const int32_t dim = *(const int32_t *)user;
  for (int32_t i = 0; i < n; ++i)
  {
    for (int32_t d = 0; d < dim; ++d)
      derivative[dim * i + d] = d == dim - 1;
    derivative[dim * i] = -0.75;
  }
  return 0;
}

static abut_obstacle *
make_height(int32_t *dim)
{
  abut_obstacle_function f = abut_obstacle_function_defaults();
  abut_obstacle *o = NULL;
  f.dimension = *dim;
  f.user = dim;
  f.evaluate = height;
  f.derivative = slope;
  require(abut_obstacle_create_function(context, &f, &o));
  /* Turned and shifted a little. */
  const double c = cos(0.1), s = sin(0.1), shift[3] = {0.1, -0.35, -0.3};
  const double turn2[4] = {c, -s, s, c},
               turn3[9] = {1., 0., 0., 0., c, -s, 0., s, c};
  require(abut_obstacle_set_pose(o, *dim == 2 ? turn2 : turn3, shift));
  return o;
}

/* Points at positions x with weights of the reference. */
static void
build_moving(couple *c, const double *x, const double *reference)
{
  require(abut_surface_update(c->secondary, x));
  require(abut_points_clear(c->points));
  abut_coupling_target target = abut_coupling_target_defaults(c->points);
  target.kinematics = ABUT_KINEMATICS_CURRENT;
  target.reference = reference;
  require(abut_coupling_build(c->coupling, NULL, 10., &target));
}

/* The gaps, directions and second derivatives of points that move, against
 * differences over the nodes; weights of the reference; gaps at displacements.
 */
static void
check_moving(const scene_mesh *mesh, abut_obstacle *obstacle,
             abut_discretisation discretisation)
{
  const int dim = mesh->dimension, n = mesh->n_nodes * dim;
  const double h = 1e-4;
  double x[300], u[300];
  assert_true(n <= 300);
  abut_coupling_options options = abut_coupling_defaults();
  options.discretisation = discretisation;
  options.search.reach = 10.;
  couple c = couple_obstacle(mesh, obstacle, &options);
  abut_points_view p;
  require(abut_points_get(c.points, &p));
  const int32_t n_points = p.n_points;
  assert_true(n_points > 0);
  double *weight = malloc(sizeof(double) * (size_t)n_points),
         *gap = malloc(sizeof(double) * (size_t)n_points),
         *step = calloc((size_t)n_points * (size_t)(1 + dim), sizeof(double)),
         *frame = malloc(sizeof(double) * (size_t)(n_points * dim)),
         *hessian = malloc(sizeof(double) * (size_t)(n_points * dim * dim));
  memcpy(weight, p.weight, sizeof(double) * (size_t)n_points);
  for (int i = 0; i < n; ++i)
  {
    u[i] = 0.05 * sin(1. + 3. * i);
    x[i] = mesh->position[i] + u[i];
  }
  build_moving(&c, x, mesh->position);
  abut_coupling_view view;
  require(abut_coupling_get(c.coupling, &view));
  require(abut_points_get(c.points, &p));
  assert_int_equal(p.n_points, n_points);
  memcpy(gap, p.gap, sizeof(double) * (size_t)n_points);
  memcpy(frame, p.frame, sizeof(double) * (size_t)(n_points * dim));
  memcpy(hessian, view.hessian,
         sizeof(double) * (size_t)(n_points * dim * dim));
  for (int32_t i = 0; i < n_points; ++i)
  {
    double square = 0.;
    for (int d = 0; d < dim; ++d)
      square += frame[i * dim + d] * frame[i * dim + d];
    near(square, 1., 1e-14, "length of a direction");
    near(p.weight[i], weight[i], 1e-15, "weight of the reference");
  }
  for (int k = 0; k < n; ++k)
  {
    double dg[1000], df[3000];
    memset(dg, 0, sizeof(dg));
    memset(df, 0, sizeof(df));
    assert_true(n_points <= 1000);
    for (int side = -1; side <= 1; side += 2)
    {
      x[k] += side * h;
      build_moving(&c, x, mesh->position);
      require(abut_points_get(c.points, &p));
      for (int32_t i = 0; i < n_points; ++i)
      {
        dg[i] += side * p.gap[i] / (2. * h);
        for (int d = 0; d < dim; ++d)
          df[i * dim + d] += side * p.frame[i * dim + d] / (2. * h);
      }
      x[k] -= side * h;
    }
    for (int32_t i = 0; i < n_points; ++i)
    {
      double part = 0.;
      for (int64_t e = p.start[i]; e < p.start[i + 1]; ++e)
        part += p.node[e] == k / dim ? p.coefficient[e] : 0.;
      near(dg[i], -part * frame[i * dim + k % dim], 1e-7, "direction");
      for (int d = 0; d < dim; ++d)
        near(-df[i * dim + d], part * hessian[(i * dim + d) * dim + k % dim],
             1e-7, "second derivative");
    }
  }
  /* Gaps as those at the displacements. */
  build_moving(&c, x, mesh->position);
  require(abut_points_set_origin(c.points, 0, n_points, mesh->n_nodes, u));
  require(abut_points_gap(c.points, mesh->n_nodes, u, step));
  for (int32_t i = 0; i < n_points; ++i)
    near(step[i], gap[i], 1e-14, "gap at the displacements");
  assert_int_equal(
      abut_points_set_origin(c.points, 1, n_points, mesh->n_nodes, u),
      ABUT_INVALID_ARGUMENT);
  free(weight);
  free(gap);
  free(step);
  free(frame);
  free(hessian);
  couple_destroy(&c);
}

static void
test_moving(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[3] = {ABUT_FACET_QUAD4, ABUT_FACET_QUAD9,
                                           ABUT_FACET_TRI3};
  const double p[5] = {0., 0., 1., 1., 0.1};
  static const abut_discretisation ways[2] = {
      ABUT_DISCRETISATION_NODE_TO_SEGMENT,
      ABUT_DISCRETISATION_QUADRATURE_POINT};
  double x[10] = {0., 0., 0.4, 0.1, 1., 0.05, 1.5, 0., 2., 0.1};
  int32_t lines[8] = {0, 1, 1, 2, 2, 3, 3, 4};
  const scene_mesh plane = {2, 5, 4, ABUT_FACET_LINE2, x, lines};
  for (int32_t dim = 2; dim <= 3; ++dim)
  {
    int32_t own = dim;
    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    shape.dimension = dim;
    shape.kind = ABUT_OBSTACLE_SPHERE;
    shape.point[dim - 1] = -2.;
    abut_obstacle *o[2] = {make_height(&own), make(&shape)};
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < (dim == 2 ? 1 : 3); ++i)
      {
        scene_mesh space = {0};
        if (dim == 3)
          space = scene_patch(kinds[i], 2, 2, scene_plane, p, true);
        check_moving(dim == 2 ? &plane : &space, o[k % 2], ways[k / 2]);
        if (dim == 3)
          scene_free(&space);
      }
    require(abut_obstacle_destroy(&o[0]));
    require(abut_obstacle_destroy(&o[1]));
  }
}

/* What cannot move says so. */
static void
test_not_moving(void **state)
{
  (void)state;
  double x[4] = {0., 0., 1., 0.};
  int32_t lines[2] = {0, 1};
  const scene_mesh s = {2, 2, 1, ABUT_FACET_LINE2, x, lines};
  int32_t dim = 2;
  abut_obstacle *o = make_height(&dim);
  for (int k = 0; k < 2; ++k)
  {
    abut_coupling_options options = abut_coupling_defaults();
    options.discretisation = k == 0 ? ABUT_DISCRETISATION_DUAL_MORTAR
                                    : ABUT_DISCRETISATION_NODE_TO_SEGMENT;
    couple c = couple_obstacle(&s, o, &options);
    abut_coupling_target target = abut_coupling_target_defaults(c.points);
    target.kinematics = ABUT_KINEMATICS_CURRENT;
    target.reference = x;
    target.tie_axes = k == 1;
    assert_int_equal(abut_coupling_build(c.coupling, NULL, 0., &target),
                     ABUT_INVALID_ARGUMENT);
    couple_destroy(&c);
  }
  require(abut_obstacle_destroy(&o));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_plane, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_reach, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_deep, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_sphere, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_surface, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_thin, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_moving, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_not_moving, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_failures, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
