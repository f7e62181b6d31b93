/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Mortar that moves: what its forces change by, also along tangents, against
 * differences; surfaces that turn as one; nodes that are hardly covered. */
#include "coupling_fixture.h"

enum
{
  MAX_NODES = 150,
  MAX_POINTS = 100,
  MAX_ROWS = 3 * MAX_POINTS
};

/* Whether partners follow, or stay those of the undeformed surfaces. */
typedef enum way
{
  FOLLOWS,
  STAYS
} way;

/* Surfaces of which x are the present places, both sides one behind the
 * other. */
typedef struct moving
{
  couple c;
  way how;
  bool tangents;
  int dim, n_secondary, n_nodes;
  double reference[3 * MAX_NODES], x[3 * MAX_NODES];
  abut_coupling_view view;
  abut_points_view points;
} moving;

static void
rebuild(moving *m)
{
  const double *primary = m->x + m->dim * m->n_secondary;
  abut_coupling_target target = abut_coupling_target_defaults(m->c.points);
  target.tangents = m->tangents;
  require(abut_points_clear(m->c.points));
  if (m->how == FOLLOWS)
  {
    require(abut_surface_update(m->c.secondary, m->x));
    require(abut_surface_update(m->c.primary, primary));
    target.kinematics = ABUT_KINEMATICS_CURRENT;
    target.reference = m->reference;
  }
  else
  {
    target.kinematics = ABUT_KINEMATICS_COROTATIONAL;
    target.current = m->x;
    target.current_primary = primary;
  }
  require(abut_coupling_build(m->c.coupling, NULL, 0., &target));
  m->view.struct_size = sizeof(m->view);
  require(abut_coupling_get(m->c.coupling, &m->view));
  require(abut_points_get(m->c.points, &m->points));
  assert_true(m->points.n_points <= MAX_POINTS);
}

static void
start(moving *m, const scene_mesh *secondary, const scene_mesh *primary,
      abut_discretisation discretisation, way how)
{
  abut_coupling_options options = mortar_options(discretisation, 0);
  options.quadrature_degree = 8;
  options.search.relative_reach = 0.;
  options.search.reach = 0.6;
  memset(m, 0, sizeof(*m));
  m->how = how;
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

/* The derivatives - n c_l of the gaps of all points by all nodes, and those of
 * slips, t c_l. */
typedef struct slopes
{
  int32_t n_points;
  double gap[MAX_POINTS], weight[MAX_POINTS], row[MAX_ROWS][3 * MAX_NODES];
} slopes;

static void
look(const moving *m, slopes *out)
{
  const abut_points_view *p = &m->points;
  out->n_points = p->n_points;
  memset(out->row, 0, sizeof(out->row));
  for (int32_t i = 0; i < p->n_points; ++i)
  {
    out->gap[i] = p->gap[p->component_start[i]];
    out->weight[i] = p->weight[i];
    for (int32_t r = p->component_start[i]; r < p->component_start[i + 1]; ++r)
      for (int64_t e = p->start[i]; e < p->start[i + 1]; ++e)
        for (int d = 0; d < m->dim; ++d)
          out->row[r][m->dim * p->node[e] + d] +=
              (r == p->component_start[i] ? -1. : 1.) * p->coefficient[e]
              * p->frame[m->dim * r + d];
  }
}

static slopes here, before, after, told;

/* What the view says the derivatives change by as unknown k does. */
static void
tell(const moving *m, int k, slopes *out)
{
  const abut_coupling_view *v = &m->view;
  const int dim = m->dim;
  memset(out->row, 0, sizeof(out->row));
  for (int32_t i = 0; i < v->n_points; ++i)
  {
    const int64_t l = v->line_start[i], c = v->column_start[i],
                  n_columns = v->column_start[i + 1] - c;
    const double *h = v->hessian + v->hessian_start[i];
    const int32_t first = m->points.component_start[i],
                  end = m->points.component_start[i + 1];
    const int64_t size =
        (v->line_start[i + 1] - l) * n_columns * (int64_t)dim * dim;
    assert_int_equal(v->hessian_start[i + 1] - v->hessian_start[i],
                     (end - first) * size);
    for (int32_t r = first; r < end; ++r, h += size)
      for (int64_t a = l; a < v->line_start[i + 1]; ++a)
        for (int d = 0; d < dim; ++d)
          for (int64_t b = 0; b < n_columns; ++b)
            if (v->column[c + b] == k / dim)
              out->row[r][dim * v->line[a] + d] +=
                  h[(((a - l) * dim + d) * n_columns + b) * dim + k % dim];
  }
}

/* Against differences; gaps have derivatives as told where surfaces touch. */
static void
check_unknown(moving *m, int k, double tolerance)
{
  const double h = 1e-5;
  tell(m, k, &told);
  m->x[k] += h;
  rebuild(m);
  look(m, &after);
  m->x[k] -= 2. * h;
  rebuild(m);
  look(m, &before);
  m->x[k] += h;
  rebuild(m);
  assert_int_equal(before.n_points, here.n_points);
  assert_int_equal(after.n_points, here.n_points);
  for (int32_t i = 0; i < here.n_points; ++i)
    near(after.weight[i], here.weight[i], 1e-5 * tolerance, "weight");
  for (int32_t i = 0; i < m->points.n_components; ++i)
    for (int r = 0; r < m->dim * m->n_nodes; ++r)
      near((after.row[i][r] - before.row[i][r]) / (2. * h), told.row[i][r],
           tolerance, "change of a force");
}

static void
check_moving(const scene_mesh *secondary, const scene_mesh *primary,
             double tolerance)
{
  static const abut_discretisation kinds[2] = {ABUT_DISCRETISATION_DUAL_MORTAR,
                                               ABUT_DISCRETISATION_MORTAR};
  static moving m;
  for (int k = 0; k < 8; ++k)
  {
    start(&m, secondary, primary, kinds[k / 2 % 2],
          k % 2 == 0 ? FOLLOWS : STAYS);
    m.tangents = k / 4 == 1;
    assert_int_equal(m.points.n_points, secondary->n_nodes);
    /* Where partners stay, places are not those of the undeformed surfaces. */
    for (int i = 0; i < m.dim * m.n_nodes && m.how == STAYS; ++i)
      m.x[i] += 0.05 * sin(1. + 3. * i);
    rebuild(&m);
    look(&m, &here);
    /* In space some unknowns will do, of all components. */
    for (int i = 0; i < m.dim * m.n_nodes; i += m.dim == 3 ? 7 : 1)
      check_unknown(&m, i, m.how == STAYS ? 1e-8 : tolerance);
    couple_destroy(&m.c);
  }
}

static double x_long[12] = {-.5, .02, .5,  -.03, 1.1, .02,
                            1.9, .05, 2.6, 0.,   3.4, .03},
              y_short[10] = {0.,   0.08, .8,   0.03, 1.6,
                             0.08, 2.3,  0.12, 3.,   0.05};
static int32_t up[10] = {1, 0, 2, 1, 3, 2, 4, 3, 5, 4},
               down[8] = {0, 1, 1, 2, 2, 3, 3, 4};

static void
test_lines(void **state)
{
  (void)state;
  const scene_mesh primary = {2, 6, 5, ABUT_FACET_LINE2, x_long, up},
                   secondary = {2, 5, 4, ABUT_FACET_LINE2, y_short, down};
  check_moving(&secondary, &primary, 1e-6);
  /* The same with middle nodes off the middle. */
  double x[22], y[18];
  int32_t curved_up[15], curved_down[12];
  memcpy(x, x_long, sizeof(x_long));
  memcpy(y, y_short, sizeof(y_short));
  for (int f = 0; f < 5; ++f)
  {
    for (int d = 0; d < 2; ++d)
      x[2 * (6 + f) + d] =
          0.5 * (x_long[2 * f + d] + x_long[2 * f + 2 + d]) + 0.01 * d;
    curved_up[3 * f] = f + 1;
    curved_up[3 * f + 1] = f;
    curved_up[3 * f + 2] = 6 + f;
  }
  for (int f = 0; f < 4; ++f)
  {
    for (int d = 0; d < 2; ++d)
      y[2 * (5 + f) + d] = 0.5 * (y_short[2 * f + d] + y_short[2 * f + 2 + d])
                           - 0.01 * (1 - d) + 0.01 * d;
    curved_down[3 * f] = f;
    curved_down[3 * f + 1] = f + 1;
    curved_down[3 * f + 2] = 5 + f;
  }
  const scene_mesh two = {2, 11, 5, ABUT_FACET_LINE3, x, curved_up},
                   one = {2, 9, 4, ABUT_FACET_LINE3, y, curved_down};
  check_moving(&one, &two, 1e-4);
}

static void
test_space(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[3] = {ABUT_FACET_TRI3, ABUT_FACET_QUAD4,
                                           ABUT_FACET_QUAD9};
  const double below[5] = {-.53, -.44, 2.61, 2.57, 0.},
               over[5] = {0., 0., 2., 2.};
  for (int k = 0; k < 3; ++k)
  {
    const int n = kinds[k] == ABUT_FACET_QUAD9 ? 1 : 2;
    scene_mesh primary = scene_patch(kinds[k], n + 1, n + 1, scene_plane, below,
                                     false),
               secondary = scene_patch(kinds[k], n, n, scene_plane, over, true);
    for (int i = 0; i < primary.n_nodes; ++i)
      primary.position[3 * i + 2] = 0.02 * sin(7. * i);
    for (int i = 0; i < secondary.n_nodes; ++i)
      secondary.position[3 * i + 2] = 0.08 + 0.02 * sin(3. * i);
    check_moving(&secondary, &primary,
                 kinds[k] == ABUT_FACET_TRI3 ? 1e-5 : 1e-3);
    scene_free(&primary);
    scene_free(&secondary);
  }
}

/* Turn all places about the origin of the plane, in space then also about the
 * first axis; and directions [3] likewise. */
static void
turned(int dim, double angle, const double *from, double *to)
{
  const double c = cos(angle), s = sin(angle);
  const double x = c * from[0] - s * from[1], y = s * from[0] + c * from[1];
  to[0] = x;
  to[1] = y;
  if (dim == 2)
    return;
  const double z = from[2];
  to[1] = c * y - s * z;
  to[2] = s * y + c * z;
}

static void
turn(moving *m, const double *from, double angle)
{
  for (int i = 0; i < m->n_nodes; ++i)
    turned(m->dim, angle, from + (ptrdiff_t)m->dim * i,
           m->x + (ptrdiff_t)m->dim * i);
}

/* Pairs that turn as one keep weights, gaps and coefficients; directions turn
 * with them. */
static void
check_turn(const scene_mesh *secondary, const scene_mesh *primary, way how)
{
  static moving m;
  static double from[3 * MAX_NODES];
  start(&m, secondary, primary, ABUT_DISCRETISATION_DUAL_MORTAR, how);
  m.tangents = true;
  rebuild(&m);
  look(&m, &here);
  assert_true(here.n_points > 0);
  memcpy(from, m.x, sizeof(from));
  for (int degrees = 30; degrees <= 180; degrees += 50)
  {
    const double angle = degrees * 3.14159265358979323846 / 180.;
    turn(&m, from, angle);
    rebuild(&m);
    look(&m, &after);
    assert_int_equal(after.n_points, here.n_points);
    for (int32_t i = 0; i < here.n_points; ++i)
    {
      near(after.gap[i], here.gap[i], 1e-14, "gap");
      near(after.weight[i], here.weight[i], 1e-14, "weight");
    }
    for (int32_t i = 0; i < m.points.n_components; ++i)
      for (int n = 0; n < m.n_nodes; ++n)
      {
        double goal[3];
        turned(m.dim, angle, here.row[i] + m.dim * n, goal);
        for (int d = 0; d < m.dim; ++d)
          near(after.row[i][m.dim * n + d], goal[d], 1e-12, "force");
      }
  }
  couple_destroy(&m.c);
}

static void
test_turn(void **state)
{
  (void)state;
  const scene_mesh primary = {2, 6, 5, ABUT_FACET_LINE2, x_long, up},
                   secondary = {2, 5, 4, ABUT_FACET_LINE2, y_short, down};
  const double below[5] = {-.53, -.44, 2.61, 2.57, 0.},
               over[5] = {0., 0., 2., 2.};
  scene_mesh ground =
                 scene_patch(ABUT_FACET_QUAD4, 3, 3, scene_plane, below, false),
             block =
                 scene_patch(ABUT_FACET_QUAD4, 2, 2, scene_plane, over, true);
  for (int i = 0; i < block.n_nodes; ++i)
    block.position[3 * i + 2] = 0.08 + 0.02 * sin(3. * i);
  for (int k = 0; k < 2; ++k)
  {
    check_turn(&secondary, &primary, k == 0 ? FOLLOWS : STAYS);
    check_turn(&block, &ground, k == 0 ? FOLLOWS : STAYS);
  }
  scene_free(&ground);
  scene_free(&block);
}

/* A flat secondary facet slides out from under the primary, whose end is at x =
 * 1: its outer node has a point down to a share of a fifth. */
static void
test_cover(void **state)
{
  (void)state;
  static moving m;
  double x[4] = {-1., 0., 1., 0.}, y[4] = {0., 0.1, 0.5, 0.1};
  int32_t up_one[2] = {1, 0}, down_one[2] = {0, 1};
  const scene_mesh primary = {2, 2, 1, ABUT_FACET_LINE2, x, up_one},
                   secondary = {2, 2, 1, ABUT_FACET_LINE2, y, down_one};
  start(&m, &secondary, &primary, ABUT_DISCRETISATION_DUAL_MORTAR, FOLLOWS);
  for (int k = 0; k < 10; ++k)
  {
    /* Covered to the part c, the outer node's share is c^2. */
    const double c = 0.95 - 0.1 * k;
    m.x[0] = 1. - 0.5 * c;
    m.x[2] = m.x[0] + 0.5;
    rebuild(&m);
    const bool outer = c * c > 0.2, inner = c * (2. - c) > 0.2;
    assert_int_equal(m.points.n_points, outer + inner);
    if (outer)
      near(m.points.weight[1], 0.25 * c * c, 1e-14, "weight");
  }
  couple_destroy(&m.c);
}

static void
test_refusals(void **state)
{
  (void)state;
  static moving m;
  const scene_mesh primary = {2, 6, 5, ABUT_FACET_LINE2, x_long, up},
                   secondary = {2, 5, 4, ABUT_FACET_LINE2, y_short, down};
  start(&m, &secondary, &primary, ABUT_DISCRETISATION_DUAL_MORTAR, FOLLOWS);
  for (int k = 0; k < 7; ++k)
  {
    abut_coupling_target target = abut_coupling_target_defaults(m.c.points);
    target.kinematics = k == 1 || k == 2 ? ABUT_KINEMATICS_COROTATIONAL
                        : k == 4         ? ABUT_KINEMATICS_REFERENCE
                        : k == 5         ? ABUT_KINEMATICS_UPDATED
                        : k == 6         ? ABUT_KINEMATICS_N
                                         : ABUT_KINEMATICS_CURRENT;
    target.reference = k != 1 && k != 5 ? m.reference : NULL;
    target.tie_axes = k == 0;
    target.current = k == 1 || k == 2 || k == 3 ? m.x : NULL;
    target.current_primary = k == 2 || k == 3 ? m.x : NULL;
    assert_int_equal(abut_coupling_build(m.c.coupling, NULL, 0., &target),
                     ABUT_INVALID_ARGUMENT);
  }
  couple_destroy(&m.c);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_lines, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_space, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_turn, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_cover, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_refusals, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
