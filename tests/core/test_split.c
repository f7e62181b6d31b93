/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Surfaces that touch themselves, put on two sides. */
#include "coupling_fixture.h"

#include <abut/self_contact.h>

/* Polyline through n corners with the given numbers of facets between them. */
static scene_mesh
polyline(int32_t n, const double (*corner)[2], const int32_t *cells,
         bool closed)
{
  int32_t n_facets = 0;
  for (int32_t i = 0; i < n - !closed; ++i)
    n_facets += cells[i];
  scene_mesh m = {2,   n_facets + !closed, n_facets, ABUT_FACET_LINE2, NULL,
                  NULL};
  m.position = malloc(sizeof(double) * 2 * (size_t)m.n_nodes);
  m.connectivity = malloc(sizeof(int32_t) * 2 * (size_t)n_facets);
  int32_t k = 0;
  for (int32_t i = 0; i < n - !closed; ++i)
    for (int32_t j = 0; j < cells[i]; ++j, ++k)
      for (int d = 0; d < 2; ++d)
      {
        const double s = (double)j / cells[i];
        m.position[2 * k + d] =
            (1. - s) * corner[i][d] + s * corner[(i + 1) % n][d];
        m.connectivity[2 * k + d] = (k + d) % m.n_nodes;
      }
  if (!closed)
    memcpy(m.position + 2 * k, corner[n - 1], 2 * sizeof(double));
  return m;
}

/* A slit of length 1 and the given height, open at x = 1: its lower face has 8
 * facets, its end 1, its upper face 11. */
static scene_mesh
slit(double height)
{
  const double corner[4][2] = {{1., 0.}, {0., 0.}, {0., height}, {1., height}};
  const int32_t cells[3] = {8, 1, 11};
  return polyline(4, corner, cells, false);
}

static abut_split_report
split_mesh(const scene_mesh *m, const abut_split_options *o, uint8_t *side)
{
  abut_split_report report;
  abut_surface *s = surface_of(m);
  require(abut_surface_split(context, s, o, side, &report));
  require(abut_surface_destroy(&s));
  return report;
}

/* The two faces of a slit are on two sides, the first facet on the first one;
 * so they are after renumbering. */
static void
test_slit(void **state)
{
  (void)state;
  abut_split_options o = abut_split_defaults();
  o.reach = 0.05;
  uint8_t side[20], shuffled[20];
  int64_t node_id[21], facet_id[20];
  uint64_t seed = 5;
  scene_mesh m = slit(0.04);
  const abut_split_report report = split_mesh(&m, &o, side);
  assert_true(report.n_pairs >= 18);
  assert_int_equal(report.n_conflicts, 0);
  assert_int_equal(report.n_skins, 0);
  for (int f = 0; f < 8; ++f)
    assert_int_equal(side[f], 0);
  for (int f = 9; f < 20; ++f)
    assert_int_equal(side[f], 1);

  scene_shuffle(&m, &seed, node_id, facet_id);
  abut_surface_data data = scene_data(&m);
  data.node_id = node_id;
  data.facet_id = facet_id;
  abut_surface *s = NULL;
  require(abut_surface_create(context, &data, &s));
  require(abut_surface_split(context, s, &o, shuffled, NULL));
  for (int f = 0; f < 20; ++f)
    assert_int_equal(shuffled[f], side[facet_id[f]]);
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

/* A polyline in the plane of x and z drawn out along y, with this many facets
 * over the length 1; facets of one place along the line follow each other. */
static scene_mesh
draw_out(const scene_mesh *line, int32_t n)
{
  scene_mesh m = {
      3,   line->n_nodes * (n + 1), line->n_facets * n, ABUT_FACET_QUAD4, NULL,
      NULL};
  m.position = malloc(sizeof(double) * 3 * (size_t)m.n_nodes);
  m.connectivity = malloc(sizeof(int32_t) * 4 * (size_t)m.n_facets);
  for (int32_t i = 0; i < m.n_nodes; ++i)
  {
    const double *point = line->position + 2 * (i / (n + 1));
    m.position[3 * i] = point[0];
    m.position[3 * i + 1] = (double)(i % (n + 1)) / n;
    m.position[3 * i + 2] = point[1];
  }
  for (int32_t f = 0; f < m.n_facets; ++f)
    for (int k = 0; k < 4; ++k)
      m.connectivity[4 * f + k] =
          line->connectivity[2 * (f / n) + k / 2] * (n + 1) + f % n + k % 2;
  return m;
}

/* The slit in space. */
static void
test_slit_3d(void **state)
{
  (void)state;
  enum
  {
    N = 3
  };
  abut_split_options o = abut_split_defaults();
  o.reach = 0.05;
  uint8_t side[20 * N];
  scene_mesh line = slit(0.04), m = draw_out(&line, N);
  const abut_split_report report = split_mesh(&m, &o, side);
  assert_true(report.n_pairs >= 18 * N);
  assert_int_equal(report.n_conflicts, 0);
  assert_int_equal(report.n_skins, 0);
  for (int f = 0; f < 8 * N; ++f)
    assert_int_equal(side[f], 0);
  for (int f = 9 * N; f < 20 * N; ++f)
    assert_int_equal(side[f], 1);
  /* Inside out, the faces of the slit are the skins of a sheet. */
  for (int32_t f = 0; f < m.n_facets; ++f)
  {
    const int32_t second = m.connectivity[4 * f + 1];
    m.connectivity[4 * f + 1] = m.connectivity[4 * f + 2];
    m.connectivity[4 * f + 2] = second;
  }
  const abut_split_report sheet = split_mesh(&m, &o, side);
  assert_int_equal(sheet.n_pairs, 0);
  assert_int_equal(sheet.n_skins, report.n_pairs);
  near(sheet.thickness, 0.04, 1e-14, "thickness");
  scene_free(&line);
  scene_free(&m);
}

/* The facets of one side as a surface with the numbers of the whole. */
static abut_surface *
surface_of_side(const scene_mesh *m, const uint8_t *side, uint8_t which)
{
  static int64_t node_id[64], facet_id[64];
  int32_t connectivity[128], n = 0;
  for (int32_t i = 0; i < m->n_nodes; ++i)
    node_id[i] = i;
  for (int32_t f = 0; f < m->n_facets; ++f)
    if (side[f] == which)
    {
      facet_id[n] = f;
      memcpy(connectivity + 2 * n++, m->connectivity + 2 * f,
             2 * sizeof(int32_t));
    }
  abut_surface_data data = scene_data(m);
  data.n_facets = n;
  data.connectivity = connectivity;
  data.node_id = node_id;
  data.facet_id = facet_id;
  abut_surface *s = NULL;
  require(abut_surface_create(context, &data, &s));
  return s;
}

/* Sides couple like two bodies: the whole lower face is covered once, at the
 * slit's height; no row couples a facet with its neighbour. */
static void
test_rows(void **state)
{
  (void)state;
  abut_split_options o = abut_split_defaults();
  abut_coupling_options options = abut_coupling_defaults();
  o.reach = options.search.reach = 0.05;
  uint8_t side[20];
  scene_mesh m = slit(0.04);
  (void)split_mesh(&m, &o, side);
  couple c;
  memset(&c, 0, sizeof(c));
  c.secondary = surface_of_side(&m, side, 0);
  c.primary = surface_of_side(&m, side, 1);
  require(abut_coupling_create(context, c.secondary, c.primary, &options,
                               &c.coupling));
  couple_build(&c, NULL);
  check_rows(&c);
  check_balance(&c, 1e-13, 1e-13);
  near(c.statistics.covered_area, 1., 1e-14, "covered");
  for (int32_t j = 0; j < c.view.n_rows; ++j)
  {
    near(c.view.gap[j], 0.04, 1e-14, "gap");
    for (int64_t e = c.view.secondary_start[j];
         e < c.view.secondary_start[j + 1]; ++e)
      for (int64_t k = c.view.primary_start[j]; k < c.view.primary_start[j + 1];
           ++k)
        assert_int_not_equal(c.view.secondary_node[e], c.view.primary_node[k]);
  }
  couple_destroy(&c);
  scene_free(&m);
}

/* The two skins of a thin strip do not face each other: its thickness is found,
 * or may be told. */
static void
test_thin(void **state)
{
  (void)state;
  const double corner[4][2] = {{0., 0.}, {1., 0.}, {1., 0.03}, {0., 0.03}};
  const int32_t cells[4] = {10, 1, 7, 1};
  abut_split_options o = abut_split_defaults();
  o.reach = 0.2;
  uint8_t side[19];
  scene_mesh m = polyline(4, corner, cells, true);
  for (int k = 0; k < 2; ++k)
  {
    o.thickness = k == 0 ? 0. : 0.03;
    const abut_split_report report = split_mesh(&m, &o, side);
    assert_int_equal(report.n_pairs, 0);
    assert_true(report.n_skins > 10);
    near(report.thickness, 0.03, 1e-15, "thickness");
    for (int f = 0; f < 19; ++f)
      assert_int_equal(side[f], 0);
  }
  /* Of a body that is thicker, the same faces would be an overlap. */
  o.thickness = 0.1;
  assert_true(split_mesh(&m, &o, side).n_pairs > 10);
  scene_free(&m);
}

/* A strip folded twice, thickness 0.05, slits 0.02: the faces of each slit are
 * on two sides. */
static void
test_folds(void **state)
{
  (void)state;
  const double corner[12][2] = {{0., 0.},     {1., 0.},     {1., 0.12},
                                {0.05, 0.12}, {0.05, 0.14}, {1., 0.14},
                                {1., 0.19},   {0., 0.19},   {0., 0.07},
                                {0.95, 0.07}, {0.95, 0.05}, {0., 0.05}};
  const int32_t cells[12] = {12, 1, 11, 1, 13, 1, 14, 1, 9, 1, 10, 1};
  abut_split_options o = abut_split_defaults();
  o.reach = 0.06;
  uint8_t side[75];
  scene_mesh m = polyline(12, corner, cells, true);
  assert_int_equal(m.n_facets, 75);
  const abut_split_report report = split_mesh(&m, &o, side);
  near(report.thickness, 0.05, 1e-15, "thickness");
  assert_int_equal(report.n_conflicts, 0);
  for (int32_t f = 0; f < 75; ++f)
    for (int32_t g = 0; g < 75; ++g)
    {
      const double *a = m.position + 2 * m.connectivity[2 * f],
                   *b = m.position + 2 * m.connectivity[2 * f + 1],
                   *p = m.position + 2 * m.connectivity[2 * g],
                   *q = m.position + 2 * m.connectivity[2 * g + 1];
      const bool level = a[1] == b[1] && p[1] == q[1];
      const double upper = fmax(a[1], p[1]), lower = fmin(a[1], p[1]);
      const bool across =
          (lower == 0.05 && upper == 0.07) || (lower == 0.12 && upper == 0.14);
      const double beside = fabs(0.5 * (a[0] + b[0]) - 0.5 * (p[0] + q[0]));
      if (level && across && beside < 0.05)
        assert_int_not_equal(side[f], side[g]);
    }
  scene_free(&m);
}

/* The middles of the three flanks of a triangular hole face each other: two of
 * them must be on one side, and are counted. */
static void
test_conflict(void **state)
{
  (void)state;
  const double h = sqrt(3.) / 2.;
  /* Clockwise: the hole is outside of the body. */
  const double corner[3][2] = {{0., 0.}, {0.5, h}, {1., 0.}};
  const int32_t cells[3] = {3, 3, 3};
  abut_split_options o = abut_split_defaults();
  o.reach = 1.;
  uint8_t side[9];
  scene_mesh m = polyline(3, corner, cells, true);
  const abut_split_report report = split_mesh(&m, &o, side);
  assert_int_equal(report.n_conflicts, 1);
  scene_free(&m);
}

/* The inside of a ring: facets that are opposite see each other, though those
 * beside them are nearer. Of an odd number the one or the other is opposite. */
static void
test_ring(void **state)
{
  (void)state;
  enum
  {
    MOST = 25
  };
  for (int32_t n = MOST - 3; n <= MOST; ++n)
  {
    double corner[MOST][2];
    int32_t cells[MOST];
    uint8_t side[MOST];
    for (int32_t i = 0; i < n; ++i)
    {
      /* Clockwise: the hole is outside of the body. */
      const double angle = -2. * acos(-1.) * (i + 0.3) / n;
      corner[i][0] = 0.7 * cos(angle);
      corner[i][1] = 0.7 * sin(angle);
      cells[i] = 1;
    }
    abut_split_options o = abut_split_defaults();
    o.reach = 1.5;
    scene_mesh m = polyline(n, corner, cells, true);
    const abut_split_report report = split_mesh(&m, &o, side);
    assert_true(report.n_pairs >= n / 2);
    int seen = 0;
    for (int32_t i = 0; i < n; ++i)
      seen += side[i] != side[(i + n / 2) % n];
    assert_true(seen >= n - n % 2);
    scene_free(&m);
  }
}

/* A ring that is pressed flat: sides to the left and right become those below
 * and above as these come near, and stay where they do not, or where three
 * flanks meet. */
static void
test_renewed(void **state)
{
  (void)state;
  enum
  {
    N = 40
  };
  for (int closed = 0; closed < 2; ++closed)
  {
    double corner[N][2];
    int32_t cells[N];
    uint8_t side[N], before[N];
    const double height = closed ? 0.04 : 0.6;
    for (int32_t i = 0; i < N; ++i)
    {
      const double angle = -2. * acos(-1.) * (i + 0.5) / N;
      corner[i][0] = cos(angle);
      corner[i][1] = height * sin(angle);
      cells[i] = 1;
      before[i] = cos(angle - acos(-1.) / N) < 0.;
    }
    abut_split_options o = abut_split_defaults();
    o.reach = 3.;
    o.previous = before;
    o.near = 0.1;
    scene_mesh m = polyline(N, corner, cells, true);
    abut_split_report report = split_mesh(&m, &o, side);
    assert_int_equal(report.n_met > 0, closed);
    int n_same = 0, n_across = 0;
    for (int32_t i = 0; i < N; ++i)
    {
      n_same += side[i] == before[i];
      n_across += side[i] != side[N - 1 - (i + 1) % N];
    }
    if (closed)
      assert_true(n_across >= N - 4);
    else
      assert_int_equal(n_same, N);
    /* What touches keeps its sides. */
    memcpy(before, side, N);
    report = split_mesh(&m, &o, side);
    assert_memory_equal(before, side, N);
    scene_free(&m);
  }
  const double h = sqrt(3.) / 2., corner[3][2] = {{0., 0.}, {0.5, h}, {1., 0.}};
  const int32_t cells[3] = {3, 3, 3};
  uint8_t side[9], before[9] = {0, 0, 0, 1, 1, 1, 1, 1, 1};
  abut_split_options o = abut_split_defaults();
  o.reach = o.near = 1.;
  o.previous = before;
  scene_mesh m = polyline(3, corner, cells, true);
  assert_true(split_mesh(&m, &o, side).n_met > 0);
  assert_memory_equal(before, side, 9);
  scene_free(&m);
}

/* Wrong arguments change nothing. */
static void
test_arguments(void **state)
{
  (void)state;
  abut_split_options o = abut_split_defaults();
  uint8_t side[20] = {7};
  scene_mesh m = slit(0.04);
  abut_surface *s = surface_of(&m);
  assert_int_equal(abut_surface_split(context, NULL, &o, side, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_surface_split(context, s, &o, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  o.reach = NAN;
  assert_int_equal(abut_surface_split(context, s, &o, side, NULL),
                   ABUT_INVALID_ARGUMENT);
  o = abut_split_defaults();
  o.thickness = -1.;
  assert_int_equal(abut_surface_split(context, s, &o, side, NULL),
                   ABUT_INVALID_ARGUMENT);
  o = abut_split_defaults();
  o.normal_cosine = 2.;
  assert_int_equal(abut_surface_split(context, s, &o, side, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(side[0], 7);
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_slit, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_slit_3d, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_rows, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_thin, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_folds, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_conflict, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_ring, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_arguments, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
