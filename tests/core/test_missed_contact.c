/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nodes inside the other body, or behind it after a step through it; points on
 * paths past obstacles. Expected depths are differences of coordinates. */
#include <abut/missed_contact.h>
/* Its arguments have names that the fixture has. */
#include "coupling_fixture.h"

enum
{
  MOST = 1000
};

/* What abut_missed_contact() finds for two meshes, and its arguments. */
typedef struct search
{
  abut_surface *secondary, *primary;
  uint8_t secondary_marks[MOST], primary_marks[MOST];
  abut_missed_options options;
  abut_missed_node found[4 * MOST];
  abut_missed_report report;
} search;

static void
open_meshes(search *s, const scene_mesh *secondary, const scene_mesh *primary)
{
  assert_true(secondary->n_nodes <= MOST && primary->n_nodes <= MOST);
  memset(s, 0, sizeof(*s));
  s->secondary = surface_of(secondary);
  s->primary = surface_of(primary);
  memset(s->secondary_marks, ABUT_NODE_OWNED, MOST);
  memset(s->primary_marks, ABUT_NODE_OWNED, MOST);
  s->options = abut_missed_defaults();
}

static abut_status
try_search(search *s)
{
  return abut_missed_contact(context, s->secondary, s->primary,
                             s->secondary_marks, s->primary_marks, &s->options,
                             s->found, &s->report);
}

static void
run(search *s)
{
  require(try_search(s));
}

static void
close_surfaces(search *s)
{
  require(abut_surface_destroy(&s->secondary));
  require(abut_surface_destroy(&s->primary));
}

/* A horizontal line of n facets from x = a to x = b; up: its outward normal. */
static scene_mesh
level(int32_t n, double a, double b, double height, bool up)
{
  const double p[4] = {up ? b : a, height, up ? a : b, height};
  return scene_patch(ABUT_FACET_LINE2, n, 1, scene_line, p, false);
}

/* A row of nodes 0.02 deep in a block: missed without constraints, of either
 * surface; gap and tolerance count. */
static void
test_inside(void **state)
{
  (void)state;
  scene_mesh above = level(4, 0.1, 0.9, -0.02, false),
             block = level(5, 0., 1., 0., true);
  search s;
  open_meshes(&s, &above, &block);
  run(&s);
  assert_int_equal(s.report.n, 5);
  for (int k = 0; k < 5; ++k)
  {
    assert_int_equal(s.found[k].node, k);
    assert_int_equal(s.found[k].on_primary, 0);
    near(s.found[k].depth, 0.02, 1e-15, "depth");
  }
  /* Four nodes of the primary are below the secondary's facets. */
  near(s.report.between_points, 0.02, 1e-15, "depth of the primary");
  s.options.covers_facets = true;
  run(&s);
  assert_int_equal(s.report.n, 5 + 4);
  near(s.report.between_points, 0., 0., "depth of the primary");
  for (int k = 5; k < 9; ++k)
  {
    assert_int_equal(s.found[k].on_primary, 1);
    near(s.found[k].depth, 0.02, 1e-15, "depth");
  }
  s.options.tolerance = 0.021;
  run(&s);
  assert_int_equal(s.report.n, 0);
  /* A clearance allows as much; an interference makes it deeper. */
  s.options.tolerance = 0.;
  s.options.gap = 0.015;
  run(&s);
  assert_int_equal(s.report.n, 9);
  near(s.found[0].depth, 0.005, 1e-15, "depth");
  s.options.gap = -0.01;
  run(&s);
  near(s.found[0].depth, 0.03, 1e-15, "depth");
  /* Nodes deeper than half of a sheet are near its other skin. */
  s.options.gap = 0.;
  s.options.primary_thickness = 0.03;
  s.options.covers_facets = false;
  run(&s);
  assert_int_equal(s.report.n, 0);
  close_surfaces(&s);
  scene_free(&above);
  scene_free(&block);
}

/* Two straight facets, over three points. */
static void
bend(const double *p, double u, double v, double *x)
{
  const double t = 2. * u - 1.;
  (void)v;
  for (int d = 0; d < 2; ++d)
    x[d] = t < 0. ? p[2 + d] + t * (p[2 + d] - p[d])
                  : p[2 + d] + t * (p[4 + d] - p[2 + d]);
}

/* A node beside a corner is not below the facet whose plane it is behind,
 * though the facet that it is opposite to faces away from it; behind a
 * reentrant corner it is. */
static void
test_beside(void **state)
{
  (void)state;
  const double edge[6] = {1., -1., 1., 0., 0., 0.},
               notch[6] = {0., 1., 0., 0., -1., 0.};
  scene_mesh beside = level(1, 2.5, 3.5, -0.1, false),
             behind = level(1, 0.05, 0.45, -0.05, false),
             convex = scene_patch(ABUT_FACET_LINE2, 2, 1, bend, edge, false),
             reentrant =
                 scene_patch(ABUT_FACET_LINE2, 2, 1, bend, notch, false);
  search s;
  open_meshes(&s, &beside, &convex);
  s.options.detection.search.reach = 10.;
  run(&s);
  assert_int_equal(s.report.n, 0);
  close_surfaces(&s);
  open_meshes(&s, &behind, &reentrant);
  s.options.detection.search.reach = 10.;
  run(&s);
  assert_true(s.report.n >= 1);
  assert_int_equal(s.found[0].node, 0);
  near(s.found[0].depth, 0.05, 1e-15, "depth");
  close_surfaces(&s);
  scene_free(&beside);
  scene_free(&behind);
  scene_free(&convex);
  scene_free(&reentrant);
}

/* Who is held, prescribed or of another process is not missed. */
static void
test_marks(void **state)
{
  (void)state;
  scene_mesh above = level(4, 0.1, 0.9, -0.02, false),
             block = level(5, 0., 1., 0., true);
  search s;
  open_meshes(&s, &above, &block);
  s.options.covers_facets = true;
  s.secondary_marks[0] |= ABUT_NODE_HELD;
  s.secondary_marks[1] |= ABUT_NODE_HELD | ABUT_NODE_PRESCRIBED;
  s.secondary_marks[2] = 0;
  run(&s);
  assert_int_equal(s.report.n, 2 + 2);
  assert_int_equal(s.found[0].node, 3);
  assert_int_equal(s.found[1].node, 4);
  near(s.report.held_in_mean, 0.02, 1e-15, "held");
  near(s.report.prescribed, 0.02, 1e-15, "prescribed");
  /* Facets of x = 0.1 to 0.5 have a held node: primary nodes at x = 0.6 and
   * 0.8 are left. */
  near(s.report.between_points, 0.02, 1e-15, "between");
  for (int k = 2; k < 4; ++k)
  {
    abut_surface_view v;
    require(abut_surface_get(s.primary, &v));
    assert_int_equal(s.found[k].on_primary, 1);
    assert_true(v.position[2 * s.found[k].node] > 0.5);
  }
  memset(s.primary_marks, 0, MOST);
  run(&s);
  assert_int_equal(s.report.n, 2);
  close_surfaces(&s);
  scene_free(&above);
  scene_free(&block);
}

/* Positions of a mesh moved by a vector, from the C library. */
static double *
moved_by(const scene_mesh *m, const double *way)
{
  double *x = malloc(sizeof(double) * (size_t)(m->dimension * m->n_nodes));
  for (int32_t i = 0; i < m->n_nodes; ++i)
    for (int d = 0; d < m->dimension; ++d)
      x[m->dimension * i + d] = m->position[m->dimension * i + d] + way[d];
  return x;
}

/* Start positions that are one vector away from the surfaces' positions. */
static void
start_at(search *s, const scene_mesh *a, const double *of_a,
         const scene_mesh *b, const double *of_b)
{
  s->options.secondary_start = moved_by(a, of_a);
  s->options.primary_start = moved_by(b, of_b);
}

static void
forget_start(search *s)
{
  free((double *)(uintptr_t)s->options.secondary_start);
  free((double *)(uintptr_t)s->options.primary_start);
  s->options.secondary_start = s->options.primary_start = NULL;
}

/* A row of nodes goes through a thin sheet from 1 above to 2 below it, out of
 * every reach; both may move as one, and nothing goes through from behind. */
static void
test_through(void **state)
{
  (void)state;
  scene_mesh below = level(4, 0.1, 0.9, -2., false),
             sheet = level(7, -1., 2., 0., true);
  const double up[3] = {0.3, 3., 0.}, deep[3] = {0., -3., 0.},
               rest[3] = {0., 0., 0.}, both[3] = {5., 4., 0.},
               with_both[3] = {5.3, 7., 0.};
  for (int a = 0; a < ABUT_SEARCH_N_ALGORITHMS; ++a)
  {
    search s;
    open_meshes(&s, &below, &sheet);
    s.options.detection.search.algorithm = (abut_search_algorithm)a;
    run(&s);
    assert_int_equal(s.report.n, 0);
    for (int as_one = 0; as_one < 2; ++as_one)
    {
      start_at(&s, &below, as_one ? with_both : up, &sheet,
               as_one ? both : rest);
      /* The sheet's node at x = 5/7 goes through a facet of the others, beside
       * the middle one of their nodes: it is held with that. */
      for (int held = 0; held < 2; ++held)
      {
        s.secondary_marks[2] =
            held == 1 ? ABUT_NODE_OWNED | ABUT_NODE_HELD : ABUT_NODE_OWNED;
        run(&s);
        int n_of_sheet = 0;
        for (int k = 0; k < s.report.n; ++k)
        {
          near(s.found[k].depth, 2., 1e-14, "depth");
          n_of_sheet += s.found[k].on_primary;
          assert_int_equal(s.found[k].node, s.found[k].on_primary ? 3
                                            : held == 1 && k >= 2 ? k + 1
                                                                  : k);
        }
        assert_int_equal(n_of_sheet, 1 - held);
        assert_int_equal(s.report.n, held == 1 ? 4 : 5 + 1);
      }
      s.options.tolerance = 2.1;
      run(&s);
      assert_int_equal(s.report.n, 0);
      s.options.tolerance = 0.;
      forget_start(&s);
    }
    start_at(&s, &below, deep, &sheet, rest);
    run(&s);
    assert_int_equal(s.report.n, 0);
    forget_start(&s);
    close_surfaces(&s);
  }
  scene_free(&below);
  scene_free(&sheet);
}

/* Out of a body through its surface is no way in, not of an interference
 * either. */
static void
test_out(void **state)
{
  (void)state;
  scene_mesh below = level(4, 0.1, 0.9, -2., false),
             ceiling = level(7, -1., 2., 0., false);
  const double up[3] = {0., 3., 0.}, rest[3] = {0., 0., 0.};
  search s;
  open_meshes(&s, &below, &ceiling);
  start_at(&s, &below, up, &ceiling, rest);
  for (int k = 0; k < 2; ++k)
  {
    s.options.gap = k == 0 ? 0. : -0.3;
    run(&s);
    assert_int_equal(s.report.n, 0);
  }
  forget_start(&s);
  close_surfaces(&s);
  scene_free(&below);
  scene_free(&ceiling);
}

/* In space, through triangles and quadrilaterals: exactly the nodes whose path
 * meets the square, at a speed that depends on the node. */
static void
test_through_3d(void **state)
{
  (void)state;
  const abut_facet_kind kinds[2] = {ABUT_FACET_TRI3, ABUT_FACET_QUAD4};
  for (int k = 0; k < 2; ++k)
  {
    const double p[5] = {-0.53, -0.41, 2., 2., -3.};
    scene_mesh below = scene_patch(kinds[k], 9, 9, scene_plane, p, true),
               sheet = scene_square(kinds[k], 6, 0., false);
    const double rest[3] = {0., 0., 0.};
    search s;
    open_meshes(&s, &below, &sheet);
    start_at(&s, &below, rest, &sheet, rest);
    double *start = (double *)(uintptr_t)s.options.secondary_start;
    bool through[MOST];
    int n = 0, n_found = 0;
    for (int i = 0; i < below.n_nodes; ++i)
    {
      /* To -3 from 1 + i / 100, sideways by 0.7 in the same time. */
      const double height = 1. + 0.01 * i, part = height / (height + 3.);
      double at[2];
      start[3 * i + 2] = height;
      start[3 * i] -= 0.7;
      for (int d = 0; d < 2; ++d)
        at[d] = start[3 * i + d]
                + part * (below.position[3 * i + d] - start[3 * i + d]);
      through[i] = at[0] > 0. && at[0] < 1. && at[1] > 0. && at[1] < 1.;
      n += through[i];
    }
    run(&s);
    for (int f = 0; f < s.report.n; ++f)
    {
      if (s.found[f].on_primary)
        continue;
      ++n_found;
      assert_true(through[s.found[f].node]);
      near(s.found[f].depth, 3., 1e-14, "depth");
    }
    assert_in_range(n, 10, below.n_nodes - 10);
    assert_int_equal(n_found, n);
    forget_start(&s);
    close_surfaces(&s);
    scene_free(&below);
    scene_free(&sheet);
  }
}

/* A facet that stretches and rotates is met where it was at the start. */
static void
test_strain(void **state)
{
  (void)state;
  scene_mesh below = level(1, -0.05, 0.05, -1., false),
             sheet = level(1, -1., 1., 0., true);
  const double up[3] = {0., 2., 0.}, rest[3] = {0., 0., 0.};
  search s;
  open_meshes(&s, &below, &sheet);
  start_at(&s, &below, up, &sheet, rest);
  double *start = (double *)(uintptr_t)s.options.primary_start;
  for (int i = 0; i < 2; ++i)
    start[2 * i] *= 30.;
  run(&s);
  assert_int_equal(s.report.n, 2);
  near(s.found[0].depth, 1., 1e-14, "depth");
  forget_start(&s);
  close_surfaces(&s);
  scene_free(&below);
  scene_free(&sheet);
}

/* A strip folded on itself: one end is 0.01 inside the other one, of the same
 * surface. */
static void
test_same_side(void **state)
{
  (void)state;
  scene_mesh fold = scene_join(level(4, 0., 1., -0.01, false),
                               level(5, 0., 1., 0., true)),
             other = level(1, 5., 6., 5., true);
  search s;
  open_meshes(&s, &fold, &other);
  run(&s);
  assert_int_equal(s.report.n, 0);
  s.options.side_thickness[0] = 1.;
  s.options.gap = -0.3;
  run(&s);
  assert_int_equal(s.report.n, fold.n_nodes);
  for (int k = 0; k < s.report.n; ++k)
  {
    assert_int_equal(s.found[k].same_side, 1);
    assert_int_equal(s.found[k].on_primary, 0);
    near(s.found[k].depth, 0.01, 1e-15, "depth");
  }
  s.options.side_thickness[0] = 0.015;
  run(&s);
  assert_int_equal(s.report.n, 0);
  close_surfaces(&s);
  scene_free(&fold);
  scene_free(&other);
}

/* Wrong arguments have their reason. */
static void
test_arguments(void **state)
{
  (void)state;
  scene_mesh a = level(1, 0., 1., 0., false), b = level(1, 0., 1., 0., true),
             square = scene_square(ABUT_FACET_QUAD4, 1, 0., false);
  const double nowhere[4] = {0., 0., NAN, 0.};
  search s;
  open_meshes(&s, &a, &b);
  s.options.tolerance = -1.;
  assert_int_equal(try_search(&s), ABUT_INVALID_ARGUMENT);
  s.options.tolerance = 0.;
  s.options.gap = NAN;
  assert_int_equal(try_search(&s), ABUT_INVALID_ARGUMENT);
  s.options.gap = 0.;
  s.options.secondary_start = nowhere;
  assert_int_equal(try_search(&s), ABUT_INVALID_ARGUMENT);
  s.options.primary_start = nowhere;
  assert_int_equal(try_search(&s), ABUT_NOT_FINITE);
  assert_non_null(strstr(abut_context_message(context), "node 1"));
  s.options = abut_missed_defaults();
  assert_int_equal(abut_missed_contact(context, s.secondary, s.primary, NULL,
                                       s.primary_marks, &s.options, s.found,
                                       &s.report),
                   ABUT_INVALID_ARGUMENT);
  require(abut_surface_destroy(&s.primary));
  s.primary = surface_of(&square);
  assert_int_equal(try_search(&s), ABUT_INVALID_ARGUMENT);
  close_surfaces(&s);
  scene_free(&a);
  scene_free(&b);
  scene_free(&square);
}

static abut_obstacle *
disc(int32_t dimension, double radius, bool hollow)
{
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  abut_obstacle *o = NULL;
  shape.dimension = dimension;
  shape.kind = ABUT_OBSTACLE_SPHERE;
  shape.radius = radius;
  shape.hollow = hollow;
  require(abut_obstacle_create_shape(context, &shape, &o));
  return o;
}

/* Chords of a sphere: through it the deepest point is at the middle of the
 * chord; to its centre, past it and along its surface the path goes not
 * through. */
static void
test_paths(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; ++dim)
  {
    abut_obstacle *o = disc(dim, 1., false);
    double from[5][3] = {{-10., 0.2, 0.},
                         {-10., 0., 0.},
                         {-10., 1.5, 0.},
                         {-10., 0., 0.},
                         {0.5, 0., 0.}},
           to[5][3] = {{20., 0.2, 0.},
                       {0., 0., 0.},
                       {20., 1.5, 0.},
                       {-9.5, 0., 0.},
                       {3., 0., 0.}};
    double a[15], b[15];
    abut_obstacle_path path[5];
    for (int i = 0; i < 5; ++i)
      for (int d = 0; d < dim; ++d)
      {
        a[dim * i + d] = from[i][d];
        b[dim * i + d] = to[i][d];
      }
    require(abut_obstacle_follow(o, 5, a, b, path));
    /* Steps inside are a quarter of the depth at least: the middle is missed by
     * half of one at most. */
    assert_true(path[0].depth <= 0.8);
    assert_true(path[0].depth >= 1. - hypot(0.2, 0.125));
    assert_int_equal(path[0].through, 1);
    near(path[1].depth, 1., 1e-15, "to the centre");
    assert_int_equal(path[1].through, 0);
    near(path[2].depth, 0., 0., "past it");
    assert_int_equal(path[2].through, 0);
    near(path[3].depth, 0., 0., "too short to meet it");
    /* Out of it from inside is no way through. */
    near(path[4].depth, 0.5, 1e-15, "out of it");
    assert_int_equal(path[4].through, 0);
    assert_int_equal(abut_obstacle_follow(o, -1, a, b, path),
                     ABUT_INVALID_ARGUMENT);
    assert_int_equal(abut_obstacle_follow(o, 1, NULL, b, path),
                     ABUT_INVALID_ARGUMENT);
    a[0] = NAN;
    assert_int_equal(abut_obstacle_follow(o, 1, b, a, path), ABUT_NOT_FINITE);
    require(abut_obstacle_follow(o, 0, NULL, NULL, NULL));
    require(abut_obstacle_destroy(&o));
  }
}

/* Into a wall and out by the next face of the corner is on one side; a thin
 * plate is met however long the path is. */
static void
test_corners(void **state)
{
  (void)state;
  abut_obstacle_shape shape = abut_obstacle_shape_defaults();
  abut_obstacle *o = NULL;
  shape.dimension = 2;
  shape.kind = ABUT_OBSTACLE_BOX;
  shape.size[0] = 2.;
  shape.size[1] = 1e-3;
  require(abut_obstacle_create_shape(context, &shape, &o));
  const double from[4] = {0.1, 50., -3., 1e-4}, to[4] = {0.2, -70., 3., 1e-4};
  abut_obstacle_path path[2];
  require(abut_obstacle_follow(o, 2, from, to, path));
  assert_int_equal(path[0].through, 1);
  assert_true(path[0].depth > 0. && path[0].depth <= 5e-4);
  assert_int_equal(path[1].through, 1);
  require(abut_obstacle_destroy(&o));
  shape.size[0] = shape.size[1] = 1.;
  require(abut_obstacle_create_shape(context, &shape, &o));
  const double above[2] = {0.2, 0.8}, beside[2] = {0.8, 0.2};
  require(abut_obstacle_follow(o, 1, above, beside, path));
  assert_int_equal(path[0].through, 0);
  near(path[0].depth, 0., 1e-15, "the corner itself");
  const double inner_above[2] = {0.1, 0.7}, inner_beside[2] = {0.7, 0.1};
  require(abut_obstacle_follow(o, 1, inner_above, inner_beside, path));
  assert_int_equal(path[0].through, 0);
  assert_true(path[0].depth > 0.05 && path[0].depth <= 0.1 + 1e-15);
  require(abut_obstacle_destroy(&o));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_inside, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_beside, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_marks, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_through, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_out, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_through_3d, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_strain, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_same_side, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_arguments, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_paths, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_corners, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
