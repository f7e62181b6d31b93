/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Gaps between flat facets and what bulges towards them: no row of dual mortar
 * sees it nearer than it is, though its functions are negative in places. */
#include "coupling_fixture.h"

#include <abut/obstacle.h>

static const double below[4] = {1., 0., -1., 0.};

/* y = x^2 from p[0] to p[1]; in space for all y, z = x^2. */
static void
parabola(const double *p, double u, double v, double *x)
{
  (void)v;
  x[0] = p[0] + u * (p[1] - p[0]);
  x[1] = x[0] * x[0];
}

static void
trough(const double *p, double u, double v, double *x)
{
  x[0] = p[0] + u * (p[1] - p[0]);
  x[1] = 2. * v - 1.;
  x[2] = x[0] * x[0];
}

/* Rows of facets of length 1 below a surface of height x^2 have its gap at
 * their nodes. Frees both. */
static void
check_parabola(scene_mesh s, scene_mesh m, int32_t n_rows)
{
  abut_coupling_options o = abut_coupling_defaults();
  o.search.reach = 2.;
  couple c = couple_meshes(&s, &m, &o, NULL);
  check_rows(&c);
  assert_int_equal(c.view.n_rows, n_rows);
  for (int32_t j = 0; j < n_rows; ++j)
  {
    const double x = c.view.position[s.dimension * j];
    near(c.view.gap[j], x * x, 1e-14, "gap");
  }
  couple_destroy(&c);
  scene_free(&s);
  scene_free(&m);
}

/* At the node at 0 the weighted gap of dual functions is -1/6, that of the
 * surfaces 0. */
static void
test_parabola(void **state)
{
  (void)state;
  const double p[2] = {-1., 1.};
  check_parabola(scene_patch(ABUT_FACET_LINE2, 2, 1, scene_line, below, false),
                 scene_patch(ABUT_FACET_LINE2, 64, 1, parabola, p, false), 3);
}

/* The same in space. */
static void
test_trough(void **state)
{
  (void)state;
  const double p[2] = {-1., 1.}, flat[5] = {-1., -1., 2., 2., 0.};
  check_parabola(scene_patch(ABUT_FACET_QUAD4, 2, 2, scene_plane, flat, false),
                 scene_patch(ABUT_FACET_QUAD4, 16, 3, trough, p, true), 9);
}

/* Wherever the border of the primary is, and the secondary's facets meet: no
 * row is nearer than the nearest point. */
static void
test_partly_covered(void **state)
{
  (void)state;
  uint64_t seed = 7;
  for (int k = 0; k < 200; ++k)
  {
    const double p[2] = {-scene_uniform(&seed), scene_uniform(&seed)};
    const abut_facet_kind kind =
        k % 2 == 0 ? ABUT_FACET_LINE2 : ABUT_FACET_LINE3;
    const int32_t n = 1 + (int32_t)(scene_bits(&seed) % 6);
    scene_mesh s = scene_patch(kind, n, 1, scene_line, below, false),
               m = scene_patch(ABUT_FACET_LINE2, 7, 1, parabola, p, false);
    couple c = couple_meshes(&s, &m, NULL, NULL);
    for (int32_t j = 0; j < c.view.n_rows; ++j)
      assert_true(c.view.gap[j] >= -1e-14);
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

/* A rigid disc or ball that touches the middle. */
static void
test_ball(void **state)
{
  (void)state;
  const double flat[5] = {-1., -1., 2., 2., 0.}, radius = 2.;
  for (int32_t dim = 2; dim <= 3; ++dim)
  {
    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    abut_obstacle *ball = NULL;
    shape.kind = ABUT_OBSTACLE_SPHERE;
    shape.dimension = dim;
    shape.point[dim - 1] = shape.radius = radius;
    require(abut_obstacle_create_shape(context, &shape, &ball));
    scene_mesh s =
        dim == 2
            ? scene_patch(ABUT_FACET_LINE2, 2, 1, scene_line, below, false)
            : scene_patch(ABUT_FACET_QUAD4, 2, 2, scene_plane, flat, false);
    couple c;
    memset(&c, 0, sizeof(c));
    c.secondary = surface_of(&s);
    require(abut_coupling_create_obstacle(context, c.secondary, ball, NULL,
                                          &c.coupling));
    couple_build(&c, NULL);
    check_rows(&c);
    assert_int_equal(c.view.n_rows, dim == 2 ? 3 : 9);
    for (int32_t j = 0; j < c.view.n_rows; ++j)
    {
      const double *x = c.view.position + (ptrdiff_t)dim * j;
      double sum = radius * radius;
      for (int32_t d = 0; d < dim - 1; ++d)
        sum += x[d] * x[d];
      near(c.view.gap[j], sqrt(sum) - radius, 1e-14, "gap");
    }
    couple_destroy(&c);
    scene_free(&s);
    require(abut_obstacle_destroy(&ball));
  }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_parabola, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_trough, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_partly_covered, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_ball, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
