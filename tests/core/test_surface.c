/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "surface_fixture.h"

static const double plane_parameters[5] = {0, 0, 1, 2, 0.5};

static void
sizes_of_a_plane(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[4] = {ABUT_FACET_QUAD4, ABUT_FACET_TRI3,
                                           ABUT_FACET_QUAD9, ABUT_FACET_TRI6};
  for (int k = 0; k < 4; ++k)
  {
    scene_mesh m =
        scene_patch(kinds[k], 5, 4, scene_plane, plane_parameters, false);
    abut_surface *s = surface_of(&m);
    abut_surface_sizes z;
    require(abut_surface_measure(s, &z));
    const bool tri = kinds[k] == ABUT_FACET_TRI3 || kinds[k] == ABUT_FACET_TRI6;
    /* Cells of 0.2 x 0.5; triangles have the diagonal as longest side. */
    const double size = tri ? hypot(0.2, 0.5) : 0.5;
    assert_float_equal(z.area, 2, 1e-14);
    assert_float_equal(z.smallest, size, 1e-14);
    assert_float_equal(z.median, size, 1e-14);
    assert_float_equal(z.largest, size, 1e-14);
    assert_int_equal(z.n_border_sides, 2 * (5 + 4));
    assert_int_equal(z.n_feature_sides, 0);
    assert_float_equal(z.upper[1], 2, 0);
    assert_float_equal(z.lower[2], 0.5, 0);
    require(abut_surface_destroy(&s));
    scene_free(&m);
  }
}

/* The median is the element at n / 2 of the sorted sizes. */
static void
median_of_a_graded_line(void **state)
{
  (void)state;
  double x[2 * 8];
  int32_t c[2 * 7];
  static const double length[7] = {5, 1, 7, 3, 2, 6, 4};
  x[0] = x[1] = 0;
  for (int f = 0; f < 7; ++f)
  {
    x[2 * f + 2] = x[2 * f] + length[f];
    x[2 * f + 3] = 0;
    c[2 * f] = f;
    c[2 * f + 1] = f + 1;
  }
  const scene_mesh m = {2, 8, 7, ABUT_FACET_LINE2, x, c};
  abut_surface *s = surface_of(&m);
  abut_surface_sizes z;
  require(abut_surface_measure(s, &z));
  assert_float_equal(z.median, 4, 0);
  assert_float_equal(z.smallest, 1, 0);
  assert_float_equal(z.largest, 7, 0);
  assert_float_equal(z.area, 28, 1e-13);
  assert_int_equal(z.n_border_sides, 2);
  require(abut_surface_destroy(&s));
}

/* Normals of a sphere: radial, to second order in the facet size for faceted
 * and fourth for curved facets. */
static void
normals_of_a_sphere(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[4] = {ABUT_FACET_QUAD4, ABUT_FACET_TRI3,
                                           ABUT_FACET_QUAD9, ABUT_FACET_TRI6};
  for (int k = 0; k < 4; ++k)
    for (int flip = 0; flip < 2; ++flip)
    {
      const double p[3] = {2, 4, 0.3};
      scene_mesh m = scene_patch(kinds[k], 20, 20, scene_sphere, p, flip == 1);
      abut_surface *s = surface_of(&m);
      const double *n = NULL;
      require(abut_surface_normals(s, &n));
      double worst = 0;
      const int32_t row = k < 2 ? 21 : 41;
      for (int32_t i = 0; i < m.n_nodes; ++i)
      {
        double error = 0;
        for (int d = 0; d < 3; ++d)
          error += pow(
              n[3 * i + d] - (flip ? -1 : 1) * m.position[3 * i + d] / 2, 2);
        const int32_t u = i % row, v = i / row;
        if (u > 0 && v > 0 && u < row - 1 && v < row - 1)
          worst = fmax(worst, sqrt(error));
      }
      /* Facets have h = 2 * 0.3 * pi/2 / 20 = 0.047 on radius 2. */
      assert_true(worst < 1e-3);
      require(abut_surface_destroy(&s));
      scene_free(&m);
    }
}

/* At a corner of a body facets are weighted by angle: refining one side of
 * the corner does not tilt the normal. */
static void
normals_at_a_corner(void **state)
{
  (void)state;
  /* Roof: along y; left side with one facet, right side split in three with
   * a small first one. Edge along y at x = 0. */
  double x[3 * 10] = {-1, 0, 0, 0, 0, 1, .1, 0, .9, .5, 0, .5, 1, 0, 0,
                      -1, 1, 0, 0, 1, 1, .1, 1, .9, .5, 1, .5, 1, 1, 0};
  int32_t c[16];
  for (int f = 0; f < 4; ++f)
  {
    c[4 * f] = f;
    c[4 * f + 1] = f + 1;
    c[4 * f + 2] = 5 + f;
    c[4 * f + 3] = 6 + f;
  }
  const scene_mesh m = {3, 10, 4, ABUT_FACET_QUAD4, x, c};
  abut_surface *s = surface_of(&m);
  const double *n = NULL;
  require(abut_surface_normals(s, &n));
  assert_float_equal(n[3 * 1 + 0], 0, 1e-14);
  assert_float_equal(n[3 * 1 + 2], 1, 1e-14);
  assert_float_equal(n[3 * 2 + 0], sqrt(0.5), 1e-14);
  uint8_t mask[4];
  require(abut_surface_features(s, 0.7, mask));
  /* Sides of a quad4: 0 front (y = 0), 1 right, 2 back, 3 left. */
  assert_int_equal(mask[0], 1 | 2 | 4 | 8);
  assert_int_equal(mask[1], 1 | 4 | 8);
  assert_int_equal(mask[2], 1 | 4);
  assert_int_equal(mask[3], 1 | 2 | 4);
  abut_surface_sizes z;
  require(abut_surface_measure(s, &z));
  assert_int_equal(z.n_feature_sides, 1);
  assert_int_equal(z.n_border_sides, 10);
  /* 2D: the corner of an angle with sides of different length. */
  double y[6] = {0, 5, 0, 0, 1, 0};
  int32_t e[4] = {0, 1, 1, 2};
  const scene_mesh l = {2, 3, 2, ABUT_FACET_LINE2, y, e};
  abut_surface *t = surface_of(&l);
  require(abut_surface_normals(t, &n));
  assert_float_equal(n[0], -1, 1e-14);
  assert_float_equal(n[2], -sqrt(0.5), 1e-14);
  assert_float_equal(n[3], -sqrt(0.5), 1e-14);
  require(abut_surface_destroy(&s));
  require(abut_surface_destroy(&t));
}

/* A smooth kink is weighted by area: area vectors (ty, -tx) add up. */
static void
normals_are_weighted_by_area(void **state)
{
  (void)state;
  double x[6] = {0, 0, 3, 0, 4, 0.1};
  int32_t c[4] = {0, 1, 1, 2};
  const scene_mesh m = {2, 3, 2, ABUT_FACET_LINE2, x, c};
  abut_surface *s = surface_of(&m);
  const double *n = NULL;
  require(abut_surface_normals(s, &n));
  assert_float_equal(n[2], 0.1 / hypot(0.1, 4), 1e-15);
  assert_float_equal(n[3], -4 / hypot(0.1, 4), 1e-15);
  /* Normals follow an update. */
  x[5] = 0;
  require(abut_surface_update(s, x));
  require(abut_surface_normals(s, &n));
  assert_float_equal(n[2], 0, 0);
  assert_float_equal(n[3], -1, 0);
  require(abut_surface_destroy(&s));
}

static void
neighbours_and_nodes(void **state)
{
  (void)state;
  scene_mesh m =
      scene_patch(ABUT_FACET_QUAD4, 3, 2, scene_plane, plane_parameters, false);
  abut_surface *s = surface_of(&m);
  abut_surface_view v;
  require(abut_surface_get(s, &v));
  /* Facet 1 is in the middle of the lower row: below nothing, right facet 2,
   * above facet 4, left facet 0. */
  assert_int_equal(v.neighbour[4], ABUT_NEIGHBOUR_BORDER);
  assert_int_equal(v.neighbour[5], 2);
  assert_int_equal(v.neighbour[6], 4);
  assert_int_equal(v.neighbour[7], 0);
  /* Node 5 = (1, 1) belongs to the four facets around it. */
  static const int32_t around[4] = {0, 1, 3, 4};
  assert_int_equal(v.node_start[6] - v.node_start[5], 4);
  assert_memory_equal(v.node_facet + v.node_start[5], around, sizeof(around));
  require(abut_surface_destroy(&s));
  /* Three facets that share an edge. */
  double x[3 * 5] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1};
  int32_t c[9] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
  const scene_mesh fan = {3, 5, 3, ABUT_FACET_TRI3, x, c};
  s = surface_of(&fan);
  require(abut_surface_get(s, &v));
  assert_int_equal(v.neighbour[0], ABUT_NEIGHBOUR_MANY);
  assert_int_equal(v.neighbour[1], ABUT_NEIGHBOUR_BORDER);
  assert_int_equal(v.neighbour[3], ABUT_NEIGHBOUR_UNUSED);
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

static void
expect_refusal(const abut_surface_data *data, abut_status status,
               const char *words)
{
  abut_surface *s = NULL;
  assert_int_equal(abut_surface_create(context, data, &s), status);
  assert_null(s);
  if (strstr(abut_context_message(context), words) == NULL)
    fail_msg("\"%s\" does not say \"%s\"", abut_context_message(context),
             words);
}

static void
bad_meshes_are_refused_by_number(void **state)
{
  (void)state;
  scene_mesh m =
      scene_patch(ABUT_FACET_QUAD4, 3, 2, scene_plane, plane_parameters, false);
  int64_t facet_id[6], node_id[12];
  for (int i = 0; i < 6; ++i)
    facet_id[i] = 100 + i;
  for (int i = 0; i < 12; ++i)
    node_id[i] = 700 + i;
  abut_surface_data data = scene_data(&m);
  data.facet_id = facet_id;
  data.node_id = node_id;
  int32_t *c = m.connectivity;
  double *x = m.position;

  c[4 * 2 + 1] = 12;
  expect_refusal(&data, ABUT_INVALID_MESH, "facet 2 (number 102)");
  c[4 * 2 + 1] = -1;
  expect_refusal(&data, ABUT_INVALID_MESH, "has the node -1");
  c[4 * 2 + 1] = c[4 * 2];
  expect_refusal(&data, ABUT_INVALID_MESH, "twice");
  c[4 * 2 + 1] = 3;

  const double keep = x[3 * 7 + 1];
  x[3 * 7 + 1] = NAN;
  expect_refusal(&data, ABUT_NOT_FINITE, "node 7 (number 707)");
  x[3 * 7 + 1] = -INFINITY;
  expect_refusal(&data, ABUT_NOT_FINITE, "node 7");
  x[3 * 7 + 1] = 1e41;
  expect_refusal(&data, ABUT_NOT_FINITE, "node 7");
  /* Node 7 pulled beyond the opposite corner: facet 2 turns inside out. */
  x[3 * 7 + 1] = -3;
  expect_refusal(&data, ABUT_INVALID_MESH, "facet 2");
  /* All nodes of a row on one line. */
  x[3 * 7 + 1] = keep;
  for (int i = 4; i < 8; ++i)
    x[3 * i + 1] = 0;
  expect_refusal(&data, ABUT_INVALID_MESH, "facet 0");
  for (int i = 4; i < 8; ++i)
    x[3 * i + 1] = keep;

  /* Facet 4 runs the other way round. */
  int32_t swap = c[17];
  c[17] = c[18];
  c[18] = swap;
  expect_refusal(&data, ABUT_INVALID_MESH, "inverted");
  data.check_orientation = false;
  abut_surface *s = NULL;
  require(abut_surface_create(context, &data, &s));
  require(abut_surface_destroy(&s));
  data.check_orientation = true;
  swap = c[17];
  c[17] = c[18];
  c[18] = swap;

  const uint8_t kinds[6] = {4, 4, 0, 4, 4, 4};
  data.kinds = kinds;
  expect_refusal(&data, ABUT_INVALID_MESH, "facet 2");
  data.kinds = NULL;
  data.dimension = 4;
  expect_refusal(&data, ABUT_INVALID_ARGUMENT, "dimension");
  data.dimension = 3;
  data.position = NULL;
  expect_refusal(&data, ABUT_INVALID_ARGUMENT, "position");
  data.position = x;
  data.feature_angle = NAN;
  expect_refusal(&data, ABUT_INVALID_ARGUMENT, "feature_angle");
  data.feature_angle = 0.7;
  data.struct_size -= 4;
  expect_refusal(&data, ABUT_INVALID_ARGUMENT, "version");
  scene_free(&m);
}

static void
inverted_lines_are_refused(void **state)
{
  (void)state;
  double x[6] = {0, 0, 1, 0, 2, 0};
  int32_t c[4] = {0, 1, 2, 1};
  const scene_mesh m = {2, 3, 2, ABUT_FACET_LINE2, x, c};
  const abut_surface_data data = scene_data(&m);
  expect_refusal(&data, ABUT_INVALID_MESH, "facet 1 is inverted");
}

static void
borrowed_and_mixed(void **state)
{
  (void)state;
  /* A square and a triangle. */
  double x[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0};
  int32_t c[7] = {0, 1, 2, 3, 1, 4, 3}, group[2] = {5, 6};
  const uint8_t kinds[2] = {ABUT_FACET_QUAD4, ABUT_FACET_TRI3};
  abut_surface_data data = abut_surface_data_defaults();
  data.n_nodes = 5;
  data.n_facets = 2;
  data.kinds = kinds;
  data.connectivity = c;
  data.position = x;
  data.group = group;
  data.borrow = true;
  abut_surface *s = NULL;
  abut_surface_view v;
  abut_surface_sizes z;
  require(abut_surface_create(context, &data, &s));
  require(abut_surface_get(s, &v));
  assert_ptr_equal(v.position, x);
  assert_ptr_equal(v.connectivity, c);
  assert_int_equal(v.facet_start[2], 7);
  assert_int_equal(v.neighbour[1], 1);
  require(abut_surface_measure(s, &z));
  assert_float_equal(z.area, 1.5, 1e-15);
  x[12] = 3;
  require(abut_surface_update(s, x));
  require(abut_surface_measure(s, &z));
  assert_float_equal(z.area, 2, 1e-15);
  x[13] = NAN;
  assert_int_equal(abut_surface_update(s, x), ABUT_NOT_FINITE);
  assert_non_null(strstr(abut_context_message(context), "node 4"));
  require(abut_surface_destroy(&s));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sizes_of_a_plane),
      cmocka_unit_test(median_of_a_graded_line),
      cmocka_unit_test(normals_of_a_sphere),
      cmocka_unit_test(normals_at_a_corner),
      cmocka_unit_test(normals_are_weighted_by_area),
      cmocka_unit_test(neighbours_and_nodes),
      cmocka_unit_test(bad_meshes_are_refused_by_number),
      cmocka_unit_test(inverted_lines_are_refused),
      cmocka_unit_test(borrowed_and_mixed)};
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
