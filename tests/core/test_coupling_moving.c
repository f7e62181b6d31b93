/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Points that move against the nearest point of another surface. */
#include "coupling_fixture.h"

#include <abut/coupling_search.h>

enum
{
  MAX_POINTS = 400,
  MAX_NODES = 150,
  MAX_UNKNOWNS = 3 * (1 + ABUT_FACET_MAX_NODES)
};

/* A secondary and a primary surface where they are now, with numbers of nodes
 * one behind the other. */
typedef struct moving
{
  couple c;
  int dim, n_secondary, n_nodes;
  double reference[3 * MAX_NODES], x[3 * MAX_NODES];
  abut_coupling_view view;
  abut_points_view points;
} moving;

static void
rebuild(moving *m)
{
  require(abut_surface_update(m->c.secondary, m->x));
  require(abut_surface_update(m->c.primary, m->x + m->dim * m->n_secondary));
  require(abut_points_clear(m->c.points));
  abut_coupling_target target = abut_coupling_target_defaults(m->c.points);
  target.kinematics = ABUT_KINEMATICS_CURRENT;
  target.reference = m->reference;
  target.tangents = true;
  require(abut_coupling_build(m->c.coupling, NULL, 0., &target));
  m->view.struct_size = sizeof(m->view);
  require(abut_coupling_get(m->c.coupling, &m->view));
  require(abut_points_get(m->c.points, &m->points));
  assert_true(m->points.n_points <= MAX_POINTS);
}

static void
start(moving *m, const scene_mesh *secondary, const scene_mesh *primary,
      abut_discretisation discretisation)
{
  abut_coupling_options options = abut_coupling_defaults();
  options.discretisation = discretisation;
  options.search.relative_reach = 0.;
  options.search.reach = 0.6;
  m->dim = secondary->dimension;
  m->n_secondary = secondary->n_nodes;
  m->n_nodes = secondary->n_nodes + primary->n_nodes;
  assert_true(m->n_nodes <= MAX_NODES);
  memcpy(m->reference, secondary->position,
         sizeof(double) * (size_t)(m->dim * secondary->n_nodes));
  memcpy(m->x, m->reference, sizeof(m->reference));
  memcpy(m->x + m->dim * m->n_secondary, primary->position,
         sizeof(double) * (size_t)(m->dim * primary->n_nodes));
  m->c = couple_meshes(secondary, primary, &options, NULL);
  rebuild(m);
}

/* Derivative of the gap of point i (k = 0), or of the slip along a tangent, by
 * component d of unknown block a: 0 is the place of the point, 1 .. the nodes
 * of its primary facet. */
static double
slope(const moving *m, int32_t i, int k, const int32_t *facet_node, int a,
      int d)
{
  const abut_points_view *p = &m->points;
  double coefficient = a == 0;
  for (int64_t e = p->start[i] + p->n_secondary[i];
       a > 0 && e < p->start[i + 1]; ++e)
    if (p->node[e] == m->n_secondary + facet_node[a - 1])
      coefficient += p->coefficient[e];
  return (k == 0 ? -1. : 1.) * coefficient
         * p->frame[(p->component_start[i] + k) * m->dim + d];
}

/* The first and second derivatives of all gaps at one place. */
typedef struct derivatives
{
  int32_t n_points, primary[MAX_POINTS];
  double gap[MAX_POINTS], rows[MAX_POINTS][3][MAX_UNKNOWNS];
} derivatives;

static void
look(const moving *m, const abut_surface_view *primary, derivatives *out)
{
  out->n_points = m->points.n_points;
  for (int32_t i = 0; i < out->n_points; ++i)
  {
    const int32_t f = m->view.primary[i];
    const int32_t *node = primary->connectivity + primary->facet_start[f];
    const int n = primary->facet_start[f + 1] - primary->facet_start[f];
    out->primary[i] = f;
    out->gap[i] = m->points.gap[m->points.component_start[i]];
    for (int k = 0; k < m->dim; ++k)
      for (int a = 0; a <= n; ++a)
        for (int d = 0; d < m->dim; ++d)
          out->rows[i][k][a * m->dim + d] = slope(m, i, k, node, a, d);
  }
}

/* What the place of point i, or node a of its facet, does when a node moves. */
static double
share_of(const moving *m, int32_t i, const int32_t *facet_node, int a, int node)
{
  const abut_points_view *p = &m->points;
  double sum = 0.;
  if (a > 0)
    return facet_node[a - 1] + m->n_secondary == node;
  for (int64_t e = p->start[i]; e < p->start[i] + p->n_secondary[i]; ++e)
    sum += p->node[e] == node ? p->coefficient[e] : 0.;
  return sum;
}

/* Forces along the normal are on the line from the point to the nearest one:
 * they have no moment. Tangents make a frame with it. */
static void
check_lines(const moving *m)
{
  const abut_points_view *p = &m->points;
  const int dim = m->dim;
  for (int32_t i = 0; i < p->n_points; ++i)
  {
    const double *f = p->frame + (int64_t)p->component_start[i] * dim;
    double sum = 0., way[3] = {0.}, along = 0.;
    for (int64_t e = p->start[i]; e < p->start[i + 1]; ++e)
    {
      sum += p->coefficient[e];
      for (int d = 0; d < dim; ++d)
        way[d] += p->coefficient[e] * m->x[dim * p->node[e] + d];
    }
    near(sum, 0., 1e-14, "sum of forces");
    for (int d = 0; d < dim; ++d)
      along += way[d] * f[d];
    near(along, -p->gap[p->component_start[i]], 1e-14, "gap");
    for (int d = 0; d < dim; ++d)
      near(way[d], along * f[d], 1e-8, "moment of forces");
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l)
      {
        double product = 0.;
        for (int d = 0; d < dim; ++d)
          product += f[k * dim + d] * f[l * dim + d];
        near(product, k == l, 1e-14, "frame");
      }
  }
}

/* What n second derivatives of the gap of point i and of its slips are off by.
 * In space tangents also turn about the normal as the secondary does, which is
 * not told: of a slip along t1 it is a part along t2. */
static void
check_second(const moving *m, int32_t i, int n, double (*off)[MAX_UNKNOWNS])
{
  const int dim = m->dim;
  const double *frame =
      m->points.frame + (int64_t)m->points.component_start[i] * dim;
  for (int k = 0; k < dim; ++k)
    for (int a = 0; a < n / dim; ++a)
      for (int l = 0; l < dim; ++l)
      {
        double along = 0.;
        for (int d = 0; d < dim; ++d)
          along += off[k][a * dim + d] * frame[l * dim + d];
        if (k == 0 || l == 0 || l == k)
          near(along, 0., 4e-6, "second derivative");
      }
}

static derivatives here, before, after;

/* Derivatives by component k of all nodes' positions against differences. */
static void
check_unknown(moving *m, const abut_surface_view *primary, int k)
{
  const double h = 1e-5;
  const int dim = m->dim;
  m->x[k] += h;
  rebuild(m);
  look(m, primary, &after);
  m->x[k] -= 2. * h;
  rebuild(m);
  look(m, primary, &before);
  m->x[k] += h;
  rebuild(m);
  assert_int_equal(before.n_points, here.n_points);
  assert_int_equal(after.n_points, here.n_points);
  for (int32_t i = 0; i < here.n_points; ++i)
  {
    const int32_t f = here.primary[i];
    const int32_t *node = primary->connectivity + primary->facet_start[f];
    const int n =
        dim * (1 + primary->facet_start[f + 1] - primary->facet_start[f]);
    const double *hessian = m->view.hessian + m->view.hessian_start[i];
    assert_int_equal(m->view.hessian_start[i + 1] - m->view.hessian_start[i],
                     dim * n * n);
    double first = 0., second[3][MAX_UNKNOWNS] = {{0.}};
    for (int a = 0; a < n / dim; ++a)
    {
      const double share = share_of(m, i, node, a, k / dim);
      const int column = a * dim + k % dim;
      first += share * here.rows[i][0][column];
      for (int r = 0; r < dim * n; ++r)
        second[r / n][r % n] += share * hessian[r * n + column];
    }
    near((after.gap[i] - before.gap[i]) / (2. * h), first, 1e-6, "slope");
    /* On the common side of two facets either may be told. */
    if (before.primary[i] != f || after.primary[i] != f
        || m->view.primary[i] != f)
      continue;
    double off[3][MAX_UNKNOWNS];
    for (int r = 0; r < dim * n; ++r)
    {
      const double change =
          after.rows[i][r / n][r % n] - before.rows[i][r / n][r % n];
      off[r / n][r % n] = change / (2. * h) - second[r / n][r % n];
    }
    check_second(m, i, n, off);
  }
}

/* Points whose nearest point is a corner (one coefficient), on a line of
 * elements (two) or elsewhere. */
typedef struct census
{
  int corner, edge, inside;
} census;

static census
count(const moving *m)
{
  census result = {0, 0, 0};
  for (int32_t i = 0; i < m->points.n_points; ++i)
  {
    const int64_t n =
        m->points.start[i + 1] - m->points.start[i] - m->points.n_secondary[i];
    ++*(n == 1            ? &result.corner
        : n == m->dim - 1 ? &result.edge
                          : &result.inside);
  }
  return result;
}

static census
check_moving(const scene_mesh *secondary, const scene_mesh *primary,
             abut_discretisation discretisation)
{
  static moving m;
  abut_surface_view view;
  memset(&m, 0, sizeof(m));
  start(&m, secondary, primary, discretisation);
  require(abut_surface_get(m.c.primary, &view));
  check_lines(&m);
  look(&m, &view, &here);
  for (int k = 0; k < m.dim * m.n_nodes; ++k)
    check_unknown(&m, &view, k);
  const census result = count(&m);
  couple_destroy(&m.c);
  return result;
}

static const abut_discretisation ways[2] = {
    ABUT_DISCRETISATION_NODE_TO_SEGMENT, ABUT_DISCRETISATION_QUADRATURE_POINT};

/* Facets of a polygon: inside, before a convex corner, behind a hollow one, and
 * a little beyond the end. */
static void
test_lines(void **state)
{
  (void)state;
  double x[8] = {0., 0., 1., 0., 2., -0.3, 3., -0.2},
         y[10] = {0.4, 0.05, 1.03, 0.15, 1.6, -0.1, 1.991, -0.4, 3.05, -0.1};
  int32_t up[6] = {1, 0, 2, 1, 3, 2}, down[8] = {0, 1, 1, 2, 2, 3, 3, 4};
  const scene_mesh primary = {2, 4, 3, ABUT_FACET_LINE2, x, up},
                   secondary = {2, 5, 4, ABUT_FACET_LINE2, y, down};
  for (int k = 0; k < 2; ++k)
  {
    const census found = check_moving(&secondary, &primary, ways[k]);
    assert_true(found.inside >= 3);
    if (k == 0)
      assert_int_equal(found.corner, 2);
  }
  /* The same with middle nodes off the middle. */
  double c[14] = {0.,   0.,  1.,  0.,  2.,  -0.3, 3.,
                  -0.2, .52, .03, 1.5, -.1, 2.5,  -.28};
  int32_t curved[9] = {1, 0, 4, 2, 1, 5, 3, 2, 6};
  const scene_mesh quadratic = {2, 7, 3, ABUT_FACET_LINE3, c, curved};
  for (int k = 0; k < 2; ++k)
    (void)check_moving(&secondary, &quadratic, ways[k]);
}

/* Height of a roof with four ridges that meet at (1, 1). */
static double
roof(const double *x)
{
  return 0.3 * (1. - fabs(x[0] - 1.)) * (1. - fabs(x[1] - 1.));
}

/* Over a roof, or in a pit: sign 1 or -1. */
static void
test_roof(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[3] = {ABUT_FACET_QUAD4, ABUT_FACET_TRI3,
                                           ABUT_FACET_QUAD9};
  const double below[5] = {0., 0., 2., 2., 0.}, over[5] = {.15, .15, 1.7, 1.7};
  for (int k = 0; k < 6; ++k)
  {
    const double sign = k % 2 == 0 ? 1. : -1.;
    scene_mesh primary =
                   scene_patch(kinds[k / 2], 2, 2, scene_plane, below, false),
               secondary =
                   scene_patch(ABUT_FACET_QUAD4, 4, 4, scene_plane, over, true);
    for (int i = 0; i < primary.n_nodes; ++i)
      primary.position[3 * i + 2] =
          sign * roof(primary.position + 3 * i) + 0.003 * sin(7. * i);
    for (int i = 0; i < secondary.n_nodes; ++i)
    {
      double *p = secondary.position + 3 * i;
      p[0] += 0.01 * sin(1. + 2. * i);
      p[1] += 0.01 * sin(2. + 5. * i);
      p[2] = sign * (roof(p) + 0.15) + 0.01 * sin(3. * i);
    }
    census found = {0, 0, 0};
    for (int w = 0; w < 2; ++w)
    {
      const census some = check_moving(&secondary, &primary, ways[w]);
      found.corner += some.corner;
      found.edge += some.edge;
      found.inside += some.inside;
    }
    assert_true(found.inside >= 16);
    if (kinds[k / 2] == ABUT_FACET_QUAD4)
      assert_true(found.corner > 0 && found.edge > 0);
    scene_free(&primary);
    scene_free(&secondary);
  }
}

/* A node slides over all facets and off the end: its gap has no jump, the
 * direction turns at the corners only, and beyond the end there is no point. */
static void
test_off_the_end(void **state)
{
  (void)state;
  static moving m;
  double x[8] = {0., 0., 1., 0., 2., -0.3, 3., -0.6},
         y[4] = {0.2, 0.1, 0.3, 0.1};
  int32_t up[6] = {1, 0, 2, 1, 3, 2}, down[2] = {0, 1};
  const scene_mesh primary = {2, 4, 3, ABUT_FACET_LINE2, x, up},
                   secondary = {2, 2, 1, ABUT_FACET_LINE2, y, down};
  start(&m, &secondary, &primary, ABUT_DISCRETISATION_NODE_TO_SEGMENT);
  double last = 0.1, first = 0.3;
  for (int k = 0; k < 2800; ++k)
  {
    m.x[0] = first + 0.001 * k;
    m.x[1] = 0.1 - (m.x[0] > 1. ? 0.3 * (m.x[0] - 1.) : 0.);
    m.x[2] = m.x[0] + 0.1;
    m.x[3] = m.x[1];
    rebuild(&m);
    assert_true(m.points.n_points > 0 && m.view.node[0] == 0);
    near(m.points.gap[0], last, 3e-4, "gap along the way");
    last = m.points.gap[0];
  }
  m.x[0] = 3.3;
  m.x[1] = -0.55;
  m.x[2] = 3.4;
  m.x[3] = -0.55;
  rebuild(&m);
  assert_int_equal(m.points.n_points, 0);
  couple_destroy(&m.c);
}

/* What a set of points holds, to the last bit. */
static void
same_points(const abut_points *a, const abut_points *b)
{
  abut_points_view p, q;
  require(abut_points_get(a, &p));
  require(abut_points_get(b, &q));
  assert_int_equal(p.n_points, q.n_points);
  assert_int_equal(p.n_components, q.n_components);
  const size_t n = (size_t)p.n_points, m = (size_t)p.start[n];
  assert_memory_equal(p.id, q.id, n * sizeof(*p.id));
  assert_memory_equal(p.weight, q.weight, n * sizeof(*p.weight));
  assert_memory_equal(p.gap, q.gap, (size_t)p.n_components * sizeof(*p.gap));
  assert_memory_equal(p.frame, q.frame,
                      (size_t)(p.n_components * p.dimension)
                          * sizeof(*p.frame));
  assert_memory_equal(p.start, q.start, (n + 1) * sizeof(*p.start));
  assert_memory_equal(p.node, q.node, m * sizeof(*p.node));
  assert_memory_equal(p.coefficient, q.coefficient, m * sizeof(*p.coefficient));
}

/* A wavy patch slides over a plane by three facets, and comes back to where it
 * was on the way, as trials of a line search do. Lists with a skin give the
 * points of lists that are made anew, with any algorithm, and most of the time
 * no list is made. */
static void
check_skin(abut_discretisation discretisation, abut_search_algorithm algorithm)
{
  static const double low[5] = {0., 0., 1., 1., 0.},
                      high[5] = {0.2, 0.2, 0.4, 0.4, 0.};
  scene_mesh primary =
                 scene_patch(ABUT_FACET_QUAD4, 10, 10, scene_plane, low, false),
             secondary =
                 scene_patch(ABUT_FACET_QUAD4, 5, 5, scene_plane, high, true);
  double place[3 * MAX_NODES];
  abut_coupling_options options = abut_coupling_defaults();
  options.discretisation = discretisation;
  couple exact, listed;
  exact = couple_meshes(&secondary, &primary, &options, NULL);
  options.search.algorithm = algorithm;
  options.search.skin = 0.1;
  listed = couple_meshes(&secondary, &primary, &options, NULL);
  const int n_steps = 60;
  for (int k = 0; k < n_steps; ++k)
  {
    const int back = k % 5 == 4 ? 2 : 0;
    for (int32_t i = 0; i < secondary.n_nodes; ++i)
    {
      const double *x = secondary.position + 3 * (int64_t)i;
      place[3 * i] = x[0] + 0.005 * (k - back);
      place[3 * i + 1] = x[1];
      place[3 * i + 2] = 0.002 * sin(20. * x[0] + 0.1 * k);
    }
    abut_coupling_target target = abut_coupling_target_defaults(NULL);
    target.kinematics = ABUT_KINEMATICS_CURRENT;
    target.reference = secondary.position;
    couple *both[2] = {&exact, &listed};
    for (int c = 0; c < 2; ++c)
    {
      require(abut_surface_update(both[c]->secondary, place));
      require(abut_points_clear(both[c]->points));
      target.points = both[c]->points;
      if (c == 1) /* the build has nothing left to search */
        require(abut_coupling_search(both[c]->coupling, 0.01));
      require(abut_coupling_build(both[c]->coupling, NULL, 0.01, &target));
    }
    same_points(exact.points, listed.points);
  }
  abut_search_statistics found[2];
  require(abut_search_get_statistics(abut_coupling_searcher(exact.coupling),
                                     &found[0]));
  require(abut_search_get_statistics(abut_coupling_searcher(listed.coupling),
                                     &found[1]));
  assert_int_equal(found[0].n_searches, n_steps + 1);
  assert_int_equal(found[1].n_searches + found[1].n_reuses, n_steps + 1);
  /* A third of a unit is gone in all, and a list serves for a tenth. */
  assert_true(found[1].n_searches >= 3 && found[1].n_searches <= 6);
  couple_destroy(&exact);
  couple_destroy(&listed);
  scene_free(&primary);
  scene_free(&secondary);
}

static void
test_skin(void **state)
{
  (void)state;
  static const abut_discretisation kinds[] = {
      ABUT_DISCRETISATION_NODE_TO_SEGMENT, ABUT_DISCRETISATION_QUADRATURE_POINT,
      ABUT_DISCRETISATION_DUAL_MORTAR};
  for (int k = 0; k < 3; ++k)
    for (int a = 0; a < ABUT_SEARCH_N_ALGORITHMS; ++a)
      check_skin(kinds[k], (abut_search_algorithm)a);
  assert_int_equal(abut_coupling_search(NULL, 0.), ABUT_INVALID_ARGUMENT);
  assert_null(abut_coupling_searcher(NULL));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_lines, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_roof, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_skin, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_off_the_end, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
