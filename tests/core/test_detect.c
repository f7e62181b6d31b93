/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "surface_fixture.h"

#include <abut/detect.h>

/* Two meshes, their surfaces, and a detection between them. */
typedef struct
{
  scene_mesh mesh[2]; /* secondary, primary */
  abut_surface *surface[2];
  abut_detection *detection;
  abut_detection_view view;
} pair;

static pair
begin(scene_mesh secondary, scene_mesh primary,
      const abut_detection_options *options)
{
  pair p = {{secondary, primary}, {NULL, NULL}, NULL, {0}};
  p.surface[0] = surface_of(&secondary);
  p.surface[1] = surface_of(&primary);
  require(abut_detection_create(context, p.surface[0], p.surface[1], options,
                                &p.detection));
  return p;
}

static void
run(pair *p, double motion)
{
  for (int k = 0; k < 2; ++k)
    require(abut_surface_update(p->surface[k], p->mesh[k].position));
  require(abut_detection_run(p->detection, motion));
  require(abut_detection_get(p->detection, &p->view));
}

static void
end(pair *p)
{
  require(abut_detection_destroy(&p->detection));
  for (int k = 0; k < 2; ++k)
  {
    require(abut_surface_destroy(&p->surface[k]));
    scene_free(&p->mesh[k]);
  }
}

/* On squares of 1/8 all is exact: the facet below a node, its gap and its
 * local coordinates are known; over edges and corners the lowest number. */
static void
flat_grids(void **state)
{
  (void)state;
  pair p = begin(scene_square(ABUT_FACET_QUAD4, 5, 0.0625, true),
                 scene_square(ABUT_FACET_QUAD4, 8, 0.125, false), NULL);
  run(&p, 0);
  assert_int_equal(p.view.n_paired, 36);
  for (int32_t i = 0; i < 36; ++i)
  {
    const double *x = p.mesh[0].position + 3 * i;
    const int32_t u = (int32_t)fmax(0, ceil(8 * x[0]) - 1);
    const int32_t v = (int32_t)fmax(0, ceil(8 * x[1]) - 1);
    assert_int_equal(p.view.contact[i].facet, 8 * v + u);
    assert_float_equal(p.view.contact[i].gap, -0.0625, 1e-15);
    assert_float_equal(p.view.contact[i].distance, 0.0625, 1e-15);
    assert_float_equal(p.view.contact[i].normal[2], 1, 1e-15);
    assert_float_equal(p.view.contact[i].local[0], 2 * (8 * x[0] - u) - 1,
                       1e-13);
    assert_float_equal(p.view.contact[i].local[1], 2 * (8 * x[1] - v) - 1,
                       1e-13);
  }
  int64_t rejected = 0;
  for (int k = 0; k < ABUT_REJECTION_N; ++k)
    rejected += p.view.rejected[k];
  assert_int_equal(p.view.n_candidates, 36 + rejected);
  abut_detection_report z;
  require(abut_detection_make_report(p.detection, &z));
  assert_int_equal(z.n_nodes, 36);
  assert_int_equal(z.n_paired, 36);
  assert_int_equal(z.n_overlaps, 36);
  assert_int_equal(z.n_reversed, 0);
  assert_float_equal(z.largest_overlap, 0.0625, 1e-15);
  assert_float_equal(z.area, 1, 1e-14);
  assert_float_equal(z.uncovered_area, 0, 0);
  assert_float_equal(z.size_ratio, 8. / 5, 1e-14);
  end(&p);
}

static void
spheres(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[4] = {ABUT_FACET_QUAD4, ABUT_FACET_TRI3,
                                           ABUT_FACET_QUAD9, ABUT_FACET_TRI6};
  const double inner[3] = {1, 2, 0.5}, outer[3] = {1.01, 2, 0.4};
  for (int k = 0; k < 4; ++k)
  {
    pair p =
        begin(scene_patch(ABUT_FACET_QUAD4, 13, 13, scene_sphere, outer, true),
              scene_patch(kinds[k], 20, 20, scene_sphere, inner, false), NULL);
    run(&p, 0);
    assert_int_equal(p.view.n_paired, p.view.n_nodes);
    /* Faceted: the facet lies below the sphere by up to h^2 / 4 (a square of
     * side h has its corners h / sqrt 2 from its centre); curved: h^4. */
    const double h = 0.5 * 1.5708 / 20;
    const double error = k < 2 ? 0.3 * h * h : h * h * h * h;
    for (int32_t i = 0; i < p.view.n_nodes; ++i)
    {
      assert_true(p.view.contact[i].gap >= 0.01 - error);
      assert_true(p.view.contact[i].gap <= 0.01 + error);
    }
    end(&p);
  }
}

/* 2D: an arc inside another one. */
static void
arcs(void **state)
{
  (void)state;
  for (int k = 0; k < 2; ++k)
  {
    const double inner[5] = {0, 0, 1, 0.1, 1.5};
    const double outer[5] = {0, 0, 1.02, 0, 1.6};
    pair p =
        begin(scene_patch(ABUT_FACET_LINE2, 17, 1, scene_arc, inner, false),
              scene_patch(k == 0 ? ABUT_FACET_LINE2 : ABUT_FACET_LINE3, 30, 1,
                          scene_arc, outer, true),
              NULL);
    run(&p, 0);
    assert_int_equal(p.view.n_paired, 18);
    /* A chord of angle t lies inside by t^2 / 8. */
    const double t = 1.6 / 30;
    for (int32_t i = 0; i < 18; ++i)
      assert_true(fabs(p.view.contact[i].gap - 0.02) <= 1.02 * t * t / 8);
    end(&p);
  }
}

static void
folded_sheet_touches_itself(void **state)
{
  (void)state;
  /* Folds of length 1, 0.02 apart; facets of about 0.033. */
  const double q[4] = {1, 0.02, 4, 0.2};
  scene_mesh m = scene_patch(ABUT_FACET_QUAD4, 120, 6, scene_fold, q, false);
  abut_surface *s = surface_of(&m);
  abut_detection *d = NULL;
  abut_detection_view v;
  abut_detection_options o = abut_detection_defaults();
  /* Between the second and third fold is the body: 0.02 thick. */
  const double thickness = 0.02;
  const int32_t group = 0;
  o.n_thicknesses = 1;
  o.thickness = &thickness;
  o.thickness_group = &group;
  o.search.reach = 0.03;
  o.search.relative_reach = 0;
  require(abut_detection_create(context, s, s, &o, &d));
  require(abut_detection_run(d, 0));
  require(abut_detection_get(d, &v));
  int32_t n_paired = 0;
  for (int32_t i = 0; i < v.n_nodes; ++i)
  {
    const double *x = m.position + 3 * i;
    /* The outward normal of the first fold is +z, so that it faces the
     * second, and the third the fourth. */
    const int fold = (int)floor(x[2] / 0.02 + 0.5);
    if (x[0] < 0.2 || x[0] > 0.8)
      continue;
    assert_true(v.contact[i].facet >= 0);
    assert_float_equal(v.contact[i].gap, 0.02, 1e-12);
    const int32_t *c = m.connectivity + 4 * v.contact[i].facet;
    const double z = m.position[3 * c[0] + 2];
    static const int partner[4] = {1, 0, 3, 2};
    assert_float_equal(z, 0.02 * partner[fold], 1e-12);
    ++n_paired;
  }
  assert_true(n_paired > 200);
  assert_true(v.rejected[ABUT_REJECTION_WRONG_SIDE] > 0);
  require(abut_detection_destroy(&d));
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

/* Two facets of one corner face each other across the corner; neither the
 * node's own facets nor their neighbours are partners. */
static void
own_neighbourhood_is_excluded(void **state)
{
  (void)state;
  /* A narrow groove: down, floor, up; the walls face each other. */
  double x[2 * 6] = {0, 2, 0, 1, 0, 0, 0.5, 0, 0.5, 1, 0.5, 2};
  int32_t c[10] = {1, 0, 2, 1, 3, 2, 4, 3, 5, 4};
  const scene_mesh m = {2, 6, 5, ABUT_FACET_LINE2, x, c};
  abut_surface *s = surface_of(&m);
  abut_detection *d = NULL;
  abut_detection_view v;
  abut_detection_options o = abut_detection_defaults();
  o.search.reach = 0.6;
  require(abut_detection_create(context, s, s, &o, &d));
  require(abut_detection_run(d, 0));
  require(abut_detection_get(d, &v));
  /* Node 0 at the top of the left wall: the right wall's top facet, 4. */
  assert_int_equal(v.contact[0].facet, 4);
  assert_float_equal(v.contact[0].gap, 0.5, 1e-15);
  /* Node 1 has facets 0, 1; ring 2. Right wall: 3 and 4 at equal distance,
   * the lower number is taken. */
  assert_int_equal(v.contact[1].facet, 3);
  /* Node 2 at the bottom: own facets 1, 2; 3 is in the ring; its normal is
   * diagonal, 4 is too far. */
  assert_int_equal(v.contact[2].facet, -1);
  assert_true(v.rejected[ABUT_REJECTION_OWN_NODE]
                  + v.rejected[ABUT_REJECTION_NEIGHBOUR]
              > 0);
  require(abut_detection_destroy(&d));
  require(abut_surface_destroy(&s));
}

static void
thickness_excludes_the_wrong_side(void **state)
{
  (void)state;
  const double lower[3] = {0, 0, -0.1}, upper[3] = {1, 1, 0};
  for (int k = 0; k < 3; ++k)
  {
    /* Depths 0.03 and 0.07 of a plate of thickness 0.1; and no limit. */
    const double depth = k == 0 ? 0.03 : 0.07, thickness = 0.1;
    const int32_t group = 0;
    abut_detection_options o = abut_detection_defaults();
    o.search.reach = 0.2;
    if (k < 2)
    {
      o.n_thicknesses = 1;
      o.thickness = &thickness;
      o.thickness_group = &group;
    }
    const double q[5] = {0.25, 0.25, 0.5, 0.5, -depth};
    pair p = begin(scene_patch(ABUT_FACET_QUAD4, 4, 4, scene_plane, q, true),
                   scene_box(lower, upper, 10), &o);
    run(&p, 0);
    assert_int_equal(p.view.n_paired, k == 1 ? 0 : 25);
    assert_int_equal(p.view.rejected[ABUT_REJECTION_WRONG_SIDE] > 0, k == 1);
    for (int32_t i = 0; i < 25 && k != 1; ++i)
      assert_float_equal(p.view.contact[i].gap, -depth, 1e-14);
    end(&p);
  }
}

/* Crossing thin plates: no node is paired through a plate with its far side. */
static void
crossing_thin_plates(void **state)
{
  (void)state;
  const double l0[3] = {0, 0, 0}, u0[3] = {1, 1, 0.01};
  const double l1[3] = {0, 0.495, 0.012}, u1[3] = {1, 0.505, 0.5};
  pair p = begin(scene_box(l1, u1, 40), scene_box(l0, u0, 20), NULL);
  run(&p, 0);
  int32_t n = 0;
  for (int32_t i = 0; i < p.view.n_nodes; ++i)
  {
    if (p.view.contact[i].facet < 0)
      continue;
    ++n;
    assert_float_equal(p.view.contact[i].normal[2], 1, 1e-12);
    assert_true(p.view.contact[i].gap >= 0.002 - 1e-12);
  }
  /* All nodes of the lower face, 41 x 2. */
  assert_true(n >= 82);
  end(&p);
}

static void
reversed_surfaces_are_reported(void **state)
{
  (void)state;
  pair p = begin(scene_square(ABUT_FACET_QUAD4, 5, 0.01, false),
                 scene_square(ABUT_FACET_QUAD4, 8, 0, false), NULL);
  run(&p, 0);
  abut_detection_report z;
  require(abut_detection_make_report(p.detection, &z));
  assert_int_equal(z.n_paired, 0);
  assert_int_equal(z.n_reversed, 36);
  assert_float_equal(z.uncovered_area, 1, 1e-14);
  assert_int_equal(p.view.rejected[ABUT_REJECTION_FACING_AWAY],
                   p.view.n_candidates);
  end(&p);
}

/* Nodes beyond the border of the primary surface, which are not those of the
 * facets behind the one there, however far the reach is. */
static void
border(void **state)
{
  const double q[5] = {0.5, 0, 1, 1, 0.01}, motion = *(const double *)*state;
  pair p = begin(scene_patch(ABUT_FACET_QUAD4, 64, 4, scene_plane, q, true),
                 scene_square(ABUT_FACET_QUAD4, 4, 0, false), NULL);
  run(&p, motion);
  for (int32_t i = 0; i < p.view.n_nodes; ++i)
  {
    const double beyond = p.mesh[0].position[3 * i] - 1;
    assert_int_equal(p.view.contact[i].facet >= 0, beyond <= 0.1 * 0.25);
    if (p.view.contact[i].facet >= 0)
      assert_float_equal(p.view.contact[i].gap, 0.01, 1e-14);
  }
  abut_detection_report z;
  require(abut_detection_make_report(p.detection, &z));
  /* Half a strip of 1/64 is shared with the last paired row of nodes. */
  assert_float_equal(z.uncovered_area, 0.5 - 1.5 / 64, 1e-13);
  end(&p);
}

static void
connectivity_is_kept_between_calls(void **state)
{
  (void)state;
  pair p = begin(scene_square(ABUT_FACET_QUAD4, 5, 0.01, true),
                 scene_square(ABUT_FACET_QUAD4, 8, 0, false), NULL);
  run(&p, 0);
  assert_true(p.view.changed);
  assert_int_equal(p.view.n_gained, 36);
  run(&p, 0);
  assert_false(p.view.changed);
  /* By 0.02 along x, 1/8 = 0.125: the nodes at x = 0, .2, .4, .6, .8 stay on
   * their facets except .6 -> .62 (stays below .625) and 1 -> 1.02, which is
   * beyond the border by more than 0.1 / 8. */
  for (int32_t i = 0; i < 36; ++i)
    p.mesh[0].position[3 * i] += 0.02;
  run(&p, 0);
  assert_true(p.view.changed);
  assert_int_equal(p.view.n_lost, 6);
  assert_int_equal(p.view.n_exchanged, 0);
  /* By another 0.02: .64 > .625 changes facets. */
  for (int32_t i = 0; i < 36; ++i)
    p.mesh[0].position[3 * i] += 0.02;
  run(&p, 0);
  assert_int_equal(p.view.n_lost, 0);
  assert_int_equal(p.view.n_exchanged, 6);
  for (int32_t i = 0; i < 36; ++i)
    p.mesh[0].position[3 * i + 2] += 1;
  run(&p, 0);
  assert_int_equal(p.view.n_lost, 30);
  assert_int_equal(p.view.n_paired, 0);
  end(&p);
}

static void
motion_enlarges_the_reach(void **state)
{
  (void)state;
  pair p = begin(scene_square(ABUT_FACET_QUAD4, 5, 0.3, true),
                 scene_square(ABUT_FACET_QUAD4, 8, 0, false), NULL);
  run(&p, 0);
  assert_int_equal(p.view.n_paired, 0);
  run(&p, 0.21);
  assert_int_equal(p.view.n_paired, 36);
  assert_float_equal(p.view.reach, 0.315, 1e-15);
  run(&p, 0);
  assert_int_equal(p.view.n_paired, 0);
  end(&p);
}

static void
groups(void **state)
{
  (void)state;
  scene_mesh a = scene_square(ABUT_FACET_QUAD4, 4, 0.01, true);
  scene_mesh b = scene_square(ABUT_FACET_QUAD4, 8, 0, false);
  int32_t ga[16], gb[64];
  for (int i = 0; i < 16; ++i)
    ga[i] = i / 4 < 2 ? 3 : 4; /* lower and upper half */
  for (int i = 0; i < 64; ++i)
    gb[i] = i % 8 < 4 ? 10 : 20; /* left and right half */
  abut_surface_data da = scene_data(&a), db = scene_data(&b);
  da.group = ga;
  db.group = gb;
  abut_surface *s = NULL, *t = NULL;
  abut_detection *d = NULL;
  abut_detection_view v;
  require(abut_surface_create(context, &da, &s));
  require(abut_surface_create(context, &db, &t));
  require(abut_detection_create(context, s, t, NULL, &d));
  require(abut_detection_pair_groups(d, 4, 10));
  require(abut_detection_run(d, 0));
  require(abut_detection_get(d, &v));
  for (int32_t i = 0; i < 25; ++i)
  {
    const double *x = a.position + 3 * i;
    assert_int_equal(v.contact[i].facet >= 0, x[1] >= 0.5 && x[0] <= 0.5);
    if (v.contact[i].facet >= 0)
      assert_int_equal(gb[v.contact[i].facet], 10);
  }
  require(abut_detection_pair_groups(d, 3, 20));
  require(abut_detection_run(d, 0));
  require(abut_detection_get(d, &v));
  for (int32_t i = 0; i < 25; ++i)
  {
    const double *x = a.position + 3 * i;
    assert_int_equal(v.contact[i].facet >= 0,
                     (x[1] >= 0.5 && x[0] <= 0.5)
                         || (x[1] <= 0.5 && x[0] >= 0.5));
  }
  for (int k = 0; k < 62; ++k)
    require(abut_detection_pair_groups(d, 3, 100 + k));
  assert_int_equal(abut_detection_pair_groups(d, 3, 1000), ABUT_UNSUPPORTED);
  require(abut_detection_destroy(&d));
  require(abut_surface_destroy(&s));
  require(abut_surface_destroy(&t));
  scene_free(&a);
  scene_free(&b);
}

static scene_mesh
patch(double radius, int32_t n, bool flip)
{
  const double p[3] = {radius, 0, 0.5};
  return scene_patch(ABUT_FACET_QUAD4, n, n, scene_sphere, p, flip);
}

static void
assert_same_result(const abut_detection_view *a, const abut_detection_view *b)
{
  const size_t n = (size_t)a->n_nodes;
  assert_int_equal(a->n_nodes, b->n_nodes);
  assert_memory_equal(a->contact, b->contact, n * sizeof(abut_contact));
  assert_memory_equal(a->rejected, b->rejected, sizeof(a->rejected));
  assert_int_equal(a->n_candidates, b->n_candidates);
}

/* Bit for bit the same for every algorithm, bucket size and skin. */
static void
result_does_not_depend_on_the_search(void **state)
{
  (void)state;
  static const double sizes[3] = {0, 1.5, 50};
  for (int scene = 0; scene < 2; ++scene)
  {
    abut_detection_options o = abut_detection_defaults();
    o.search.algorithm = ABUT_SEARCH_ALL_PAIRS;
    /* Matching grids: ties at every node. */
    pair first = scene == 0
                     ? begin(patch(1.01, 15, true), patch(1, 20, false), &o)
                     : begin(scene_square(ABUT_FACET_QUAD4, 12, 0.01, true),
                             scene_square(ABUT_FACET_QUAD4, 12, 0, false), &o);
    run(&first, 0);
    assert_int_equal(first.view.n_paired, first.view.n_nodes);
    for (int a = 1; a < ABUT_SEARCH_N_ALGORITHMS; ++a)
      for (int i = 0; i < 6; ++i)
      {
        o.search.algorithm = (abut_search_algorithm)a;
        o.search.bucket_size = sizes[i % 3];
        o.search.skin = i < 3 ? 0 : 0.02;
        pair p = scene == 0
                     ? begin(patch(1.01, 15, true), patch(1, 20, false), &o)
                     : begin(scene_square(ABUT_FACET_QUAD4, 12, 0.01, true),
                             scene_square(ABUT_FACET_QUAD4, 12, 0, false), &o);
        run(&p, 0);
        assert_same_result(&first.view, &p.view);
        /* Once more, from the list if there is a skin. */
        run(&p, 0);
        assert_same_result(&first.view, &p.view);
        assert_int_equal(p.view.searched, i < 3);
        end(&p);
      }
    end(&first);
  }
}

static void
rigid_motion_and_renumbering(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int scene = 0; scene < 2; ++scene)
  {
    scene_mesh a = scene == 0 ? patch(1.01, 15, true)
                              : scene_square(ABUT_FACET_QUAD4, 12, 0.01, true);
    scene_mesh b = scene == 0 ? patch(1, 20, false)
                              : scene_square(ABUT_FACET_QUAD4, 12, 0, false);
    const int32_t n = a.n_nodes;
    pair p = begin(a, b, NULL);
    run(&p, 0);
    int32_t *facet = malloc(sizeof(int32_t) * (size_t)n);
    double *gap = malloc(sizeof(double) * (size_t)n);
    for (int32_t i = 0; i < n; ++i)
    {
      facet[i] = p.view.contact[i].facet;
      gap[i] = p.view.contact[i].gap;
    }
    const double angles[3] = {0.4, 1.2, -2}, shift[3] = {5, -7, 3};
    for (int k = 0; k < 2; ++k)
      scene_move(&p.mesh[k], 1, angles, shift);
    run(&p, 0);
    assert_false(p.view.changed);
    for (int32_t i = 0; i < n; ++i)
      assert_float_equal(p.view.contact[i].gap, gap[i], 1e-13);
    scene_mesh moved[2] = {p.mesh[0], p.mesh[1]};
    require(abut_detection_destroy(&p.detection));
    require(abut_surface_destroy(&p.surface[0]));
    require(abut_surface_destroy(&p.surface[1]));
    /* Shuffled, with the old numbers as numbers. */
    int64_t node_id[2][441], facet_id[2][400];
    abut_surface_data data[2];
    for (int k = 0; k < 2; ++k)
    {
      scene_shuffle(&moved[k], &seed, node_id[k], facet_id[k]);
      data[k] = scene_data(&moved[k]);
      data[k].facet_id = facet_id[k];
      p.mesh[k] = moved[k];
      require(abut_surface_create(context, &data[k], &p.surface[k]));
    }
    require(abut_detection_create(context, p.surface[0], p.surface[1], NULL,
                                  &p.detection));
    run(&p, 0);
    for (int32_t i = 0; i < n; ++i)
    {
      assert_int_equal(facet_id[1][p.view.contact[i].facet],
                       facet[node_id[0][i]]);
      assert_float_equal(p.view.contact[i].gap, gap[node_id[0][i]], 1e-13);
    }
    free(facet);
    free(gap);
    end(&p);
  }
}

static void
warm_detection_allocates_nothing(void **state)
{
  (void)state;
  for (int skin = 0; skin < 2; ++skin)
  {
    abut_detection_options o = abut_detection_defaults();
    o.search.skin = skin * 0.01;
    pair p = begin(patch(1.01, 30, true), patch(1, 40, false), &o);
    uint64_t before = 0;
    for (int step = 0; step < 12; ++step)
    {
      if (step == 6)
        before = abut_context_memory(context).n_allocations;
      for (int32_t i = 0; i < p.mesh[0].n_nodes; ++i)
        p.mesh[0].position[3 * i] += step % 6 < 3 ? 0.004 : -0.004;
      run(&p, 0.004);
    }
    assert_int_equal(abut_context_memory(context).n_allocations, before);
    end(&p);
  }
}

static void
wrong_arguments(void **state)
{
  (void)state;
  pair p = begin(scene_square(ABUT_FACET_QUAD4, 2, 0.1, true),
                 scene_square(ABUT_FACET_QUAD4, 2, 0, false), NULL);
  abut_detection *d = NULL;
  abut_detection_report z;
  assert_int_equal(abut_detection_make_report(p.detection, &z),
                   ABUT_WRONG_ORDER);
  assert_int_equal(abut_detection_run(p.detection, NAN), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_detection_run(p.detection, -1), ABUT_INVALID_ARGUMENT);
  abut_detection_options o = abut_detection_defaults();
  o.normal_cosine = NAN;
  assert_int_equal(
      abut_detection_create(context, p.surface[0], p.surface[1], &o, &d),
      ABUT_INVALID_ARGUMENT);
  o = abut_detection_defaults();
  o.extension = -1;
  assert_int_equal(
      abut_detection_create(context, p.surface[0], p.surface[1], &o, &d),
      ABUT_INVALID_ARGUMENT);
  o = abut_detection_defaults();
  const double thickness = 0;
  const int32_t group = 0;
  o.n_thicknesses = 1;
  o.thickness = &thickness;
  o.thickness_group = &group;
  assert_int_equal(
      abut_detection_create(context, p.surface[0], p.surface[1], &o, &d),
      ABUT_INVALID_ARGUMENT);
  o = abut_detection_defaults();
  o.search.skin = NAN;
  assert_int_equal(
      abut_detection_create(context, p.surface[0], p.surface[1], &o, &d),
      ABUT_INVALID_ARGUMENT);
  assert_null(d);
  end(&p);
}

/* Two surfaces whose nodes have the same numbers: a facet next to a node's own
 * one is excluded in contact of a body with itself, and only there. */
static void
surfaces_with_equal_numbers_are_still_two(void **state)
{
  (void)state;
  for (int self = 0; self < 2; ++self)
  {
    scene_mesh mesh[2] = {scene_square(ABUT_FACET_QUAD4, 4, 0.125, true),
                          scene_square(ABUT_FACET_QUAD4, 4, 0., false)};
    int64_t id[25];
    for (int i = 0; i < 25; ++i)
      id[i] = i;
    abut_surface *surface[2] = {NULL, NULL};
    for (int k = 0; k < 2; ++k)
    {
      abut_surface_data data = scene_data(&mesh[k]);
      data.node_id = id;
      require(abut_surface_create(context, &data, &surface[k]));
    }
    abut_detection_options options = abut_detection_defaults();
    options.self_contact = self == 1;
    abut_detection *detection = NULL;
    abut_detection_view view;
    require(abut_detection_create(context, surface[0], surface[1], &options,
                                  &detection));
    require(abut_detection_run(detection, 0.));
    require(abut_detection_get(detection, &view));
    if (self)
      assert_true(view.rejected[ABUT_REJECTION_NEIGHBOUR] > 0);
    else
      assert_int_equal(view.rejected[ABUT_REJECTION_NEIGHBOUR], 0);
    require(abut_detection_destroy(&detection));
    for (int k = 0; k < 2; ++k)
    {
      require(abut_surface_destroy(&surface[k]));
      scene_free(&mesh[k]);
    }
  }
}

int
main(void)
{
  static double motion[2] = {0., 1.};
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(surfaces_with_equal_numbers_are_still_two),
      cmocka_unit_test(flat_grids),
      cmocka_unit_test(spheres),
      cmocka_unit_test(arcs),
      cmocka_unit_test(folded_sheet_touches_itself),
      cmocka_unit_test(own_neighbourhood_is_excluded),
      cmocka_unit_test(thickness_excludes_the_wrong_side),
      cmocka_unit_test(crossing_thin_plates),
      cmocka_unit_test(reversed_surfaces_are_reported),
      cmocka_unit_test_prestate(border, &motion[0]),
      cmocka_unit_test_prestate(border, &motion[1]),
      cmocka_unit_test(connectivity_is_kept_between_calls),
      cmocka_unit_test(motion_enlarges_the_reach),
      cmocka_unit_test(groups),
      cmocka_unit_test(result_does_not_depend_on_the_search),
      cmocka_unit_test(rigid_motion_and_renumbering),
      cmocka_unit_test(warm_detection_allocates_nothing),
      cmocka_unit_test(wrong_arguments)};
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
