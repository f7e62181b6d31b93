/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Every search algorithm finds the pairs of the definition, on all scenes. */
#include "surface_fixture.h"

#include "geometry/clip.h"

#include <abut/search.h>

static abut_search_options
options_of(abut_search_algorithm algorithm, double reach, double relative)
{
  abut_search_options o = abut_search_defaults();
  o.algorithm = algorithm;
  o.reach = reach;
  o.relative_reach = relative;
  return o;
}

static void
destroy_both(abut_surface **s, abut_surface **t, scene_mesh *a, scene_mesh *b)
{
  require(abut_surface_destroy(s));
  require(abut_surface_destroy(t));
  scene_free(a);
  scene_free(b);
}

/* Pairs by the words of the definition, from the public measures alone. */
static int64_t
count_by_definition(const scene_mesh *primary, const scene_mesh *secondary,
                    double reach, double relative)
{
  int64_t n = 0;
  const int32_t per = abut_facet_n_nodes(primary->kind);
  const int32_t dim = primary->dimension;
  for (int32_t f = 0; f < primary->n_facets; ++f)
  {
    double nodes[27], size = 0;
    abut_facet_measures m;
    for (int32_t a = 0; a < per; ++a)
      for (int d = 0; d < dim; ++d)
        nodes[dim * a + d] =
            primary->position[dim * primary->connectivity[per * f + a] + d];
    assert_int_equal(abut_facet_measure(primary->kind, nodes, &m), 0);
    const int corners = abut_facet_n_corners(primary->kind);
    static const int sides4[8] = {0, 1, 1, 3, 3, 2, 2, 0};
    static const int sides3[6] = {0, 1, 1, 2, 2, 0};
    for (int k = 0; k < (corners == 2 ? 1 : corners); ++k)
    {
      const int a = corners == 4 ? sides4[2 * k] : sides3[2 * k];
      const int b = corners == 4 ? sides4[2 * k + 1] : sides3[2 * k + 1];
      double square = 0;
      for (int d = 0; d < dim; ++d)
        square += pow(nodes[dim * a + d] - nodes[dim * b + d], 2);
      size = fmax(size, sqrt(square));
    }
    const double h = fmax(reach, relative * size);
    for (int32_t i = 0; i < secondary->n_nodes; ++i)
    {
      double square = 0;
      bool in = true;
      for (int d = 0; d < dim; ++d)
      {
        const double x = secondary->position[dim * i + d];
        in = in && x >= m.lower[d] - h && x <= m.upper[d] + h;
        square += pow(x - m.centre[d], 2);
      }
      n += in && sqrt(square) <= h + m.radius;
    }
  }
  return n;
}

static void
assert_same_pairs(const abut_pairs *a, const abut_pairs *b)
{
  abut_pairs_view u, v;
  require(abut_pairs_get(a, &u));
  require(abut_pairs_get(b, &v));
  assert_int_equal(u.n_queries, v.n_queries);
  assert_memory_equal(u.start, v.start,
                      sizeof(int64_t) * (size_t)(u.n_queries + 1));
  const int64_t n = u.start[u.n_queries];
  if (n > 0)
    assert_memory_equal(u.facet, v.facet, sizeof(int32_t) * (size_t)n);
  for (int32_t i = 0; i < u.n_queries; ++i)
    for (int64_t e = u.start[i] + 1; e < u.start[i + 1]; ++e)
      assert_true(u.facet[e - 1] < u.facet[e]);
}

/* Number of node pairs; *facet_pairs of facet pairs. */
static int64_t
run(abut_surface *primary, abut_surface *secondary,
    const abut_search_options *options, abut_pairs *nodes, abut_pairs *facets)
{
  abut_search *search = NULL;
  abut_pairs_view view;
  require(abut_search_create(context, primary, options, &search));
  require(abut_search_nodes(search, secondary, nodes));
  require(abut_search_facets(search, secondary, facets));
  require(abut_search_destroy(&search));
  require(abut_pairs_get(nodes, &view));
  return view.start[view.n_queries];
}

/* All algorithms with several bucket sizes against all pairs. Frees both
 * meshes; returns the number of node pairs. */
static int64_t
compare_all(scene_mesh a, scene_mesh b, double reach, double relative)
{
  static const double sizes[] = {0, 1e-9, 1, 3.7, 1e9};
  abut_surface *primary = surface_of(&a), *secondary = surface_of(&b);
  abut_pairs *list[4] = {NULL, NULL, NULL, NULL};
  for (int i = 0; i < 4; ++i)
    require(abut_pairs_create(context, &list[i]));
  abut_search_options o = options_of(ABUT_SEARCH_ALL_PAIRS, reach, relative);
  const int64_t n = run(primary, secondary, &o, list[0], list[1]);
  for (int algorithm = ABUT_SEARCH_UNIFORM_BUCKETS;
       algorithm < ABUT_SEARCH_N_ALGORITHMS; ++algorithm)
    for (int i = 0; i < 5; ++i)
    {
      o = options_of((abut_search_algorithm)algorithm, reach, relative);
      o.bucket_size = sizes[i];
      run(primary, secondary, &o, list[2], list[3]);
      assert_same_pairs(list[0], list[2]);
      assert_same_pairs(list[1], list[3]);
    }
  for (int i = 0; i < 4; ++i)
    require(abut_pairs_destroy(&list[i]));
  destroy_both(&primary, &secondary, &a, &b);
  return n;
}

static void
flat_grids(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[4] = {ABUT_FACET_QUAD4, ABUT_FACET_TRI3,
                                           ABUT_FACET_QUAD9, ABUT_FACET_TRI6};
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
    {
      scene_mesh a = scene_square(kinds[k], 12, 0, false);
      scene_mesh b = scene_square(kinds[l], 9, 0.01, true);
      const int64_t expected = count_by_definition(&a, &b, 0, 0.5);
      const int64_t n = compare_all(a, b, 0, 0.5);
      assert_true(n > 0);
      assert_int_equal(n, expected);
    }
}

/* On matching grids of n x n squares of size h = 1/8 (all numbers are exact)
 * with reach h/2 a node at the height of the facets pairs with the four
 * squares around it and no other: the next centres are at 1.58 h >
 * (1/2 + sqrt(1/2)) h. So the number of pairs is that of corners, 4 n^2. */
static void
matching_grids_have_four_pairs_per_facet(void **state)
{
  (void)state;
  const int32_t n = 8;
  assert_int_equal(compare_all(scene_square(ABUT_FACET_QUAD4, n, 0, false),
                               scene_square(ABUT_FACET_QUAD4, n, 0, true), 0,
                               0.5),
                   4 * n * n);
}

static int32_t
gcd(int32_t a, int32_t b)
{
  return b == 0 ? a : gcd(b, a % b);
}

static void
corners_of(const scene_mesh *m, int32_t f, double *x)
{
  for (int a = 0; a < 4; ++a)
    for (int d = 0; d < 3; ++d)
      x[3 * a + d] = m->position[3 * m->connectivity[4 * f + a] + d];
}

/* Lines at i / n1 and j / n2 cut the unit interval into n1 + n2 - gcd pieces,
 * so that many squared pairs of facets have a common area, and the areas sum
 * to one. */
static void
clipped_pairs_of_flat_grids(void **state)
{
  (void)state;
  static const int32_t n[4][2] = {{12, 9}, {7, 5}, {16, 24}, {1, 6}};
  for (int k = 0; k < 4; ++k)
    for (int algorithm = 0; algorithm < ABUT_SEARCH_N_ALGORITHMS; ++algorithm)
    {
      scene_mesh a = scene_square(ABUT_FACET_QUAD4, n[k][0], 0, false);
      scene_mesh b = scene_square(ABUT_FACET_QUAD4, n[k][1], 0.01, true);
      abut_surface *s = surface_of(&a), *t = surface_of(&b);
      abut_pairs *nodes = NULL, *facets = NULL;
      abut_pairs_view v;
      require(abut_pairs_create(context, &nodes));
      require(abut_pairs_create(context, &facets));
      const abut_search_options o =
          options_of((abut_search_algorithm)algorithm, 0.02, 0);
      run(s, t, &o, nodes, facets);
      require(abut_pairs_get(facets, &v));
      int32_t clipped = 0;
      double area = 0;
      for (int32_t i = 0; i < v.n_queries; ++i)
        for (int64_t e = v.start[i]; e < v.start[i + 1]; ++e)
        {
          double x[12], y[12];
          corners_of(&b, i, x);
          corners_of(&a, v.facet[e], y);
          const double common =
              abut_facet_common_area(ABUT_FACET_QUAD4, x, ABUT_FACET_QUAD4, y);
          clipped += common > 0;
          area += common;
        }
      const int32_t pieces = n[k][0] + n[k][1] - gcd(n[k][0], n[k][1]);
      assert_int_equal(clipped, pieces * pieces);
      assert_float_equal(area, 1, 1e-12);
      require(abut_pairs_destroy(&nodes));
      require(abut_pairs_destroy(&facets));
      destroy_both(&s, &t, &a, &b);
    }
}

static void
sphere_patches(void **state)
{
  (void)state;
  for (int side = 0; side < 6; ++side)
  {
    const double p[3] = {1, side, 0.5}, q[3] = {1.01, side, 0.5};
    scene_mesh a =
        scene_patch(ABUT_FACET_QUAD4, 20, 20, scene_sphere, p, false);
    scene_mesh b = scene_patch(ABUT_FACET_TRI3, 15, 15, scene_sphere, q, true);
    const int64_t expected = count_by_definition(&a, &b, 0, 0.5);
    assert_int_equal(compare_all(a, b, 0, 0.5), expected);
  }
}

static scene_mesh
sphere(double radius, int32_t n, bool flip)
{
  const double p[3] = {radius, 0, 1};
  scene_mesh all = scene_patch(ABUT_FACET_QUAD4, n, n, scene_sphere, p, flip);
  for (int side = 1; side < 6; ++side)
  {
    const double q[3] = {radius, side, 1};
    all = scene_join(
        all, scene_patch(ABUT_FACET_QUAD4, n, n, scene_sphere, q, flip));
  }
  return all;
}

static void
sphere_in_sphere(void **state)
{
  (void)state;
  assert_true(compare_all(sphere(1, 8, false), sphere(1.02, 11, true), 0, 0.5)
              > 0);
  assert_true(compare_all(sphere(1, 8, false), sphere(1.02, 11, true), 0.05, 0)
              > 0);
}

static void
graded_ring(void **state)
{
  (void)state;
  const double p[4] = {1e-3, 1, 0, 6}, q[4] = {1e-3, 1, 1e-6, 6};
  assert_true(
      compare_all(scene_patch(ABUT_FACET_QUAD4, 33, 30, scene_ring, p, false),
                  scene_patch(ABUT_FACET_QUAD4, 40, 37, scene_ring, q, true), 0,
                  0.5)
      > 0);
}

static void
crossing_thin_plates(void **state)
{
  (void)state;
  const double l0[3] = {0, 0, 0}, u0[3] = {1, 1, 0.01};
  const double l1[3] = {0, 0.495, -0.5}, u1[3] = {1, 0.505, 0.5};
  assert_true(compare_all(scene_box(l0, u0, 20), scene_box(l1, u1, 17), 0, 0.5)
              > 0);
}

static void
folded_sheet_with_itself(void **state)
{
  (void)state;
  const double p[4] = {1, 0.02, 5, 0.5};
  scene_mesh sheet = scene_patch(ABUT_FACET_QUAD4, 80, 8, scene_fold, p, false);
  abut_surface *s = surface_of(&sheet);
  abut_pairs *list[4];
  for (int i = 0; i < 4; ++i)
    require(abut_pairs_create(context, &list[i]));
  abut_search_options o = options_of(ABUT_SEARCH_ALL_PAIRS, 0.03, 0);
  assert_true(run(s, s, &o, list[0], list[1]) > 0);
  for (int a = 1; a < ABUT_SEARCH_N_ALGORITHMS; ++a)
  {
    o.algorithm = (abut_search_algorithm)a;
    run(s, s, &o, list[2], list[3]);
    assert_same_pairs(list[0], list[2]);
    assert_same_pairs(list[1], list[3]);
  }
  for (int i = 0; i < 4; ++i)
    require(abut_pairs_destroy(&list[i]));
  require(abut_surface_destroy(&s));
  scene_free(&sheet);
}

static void
needles_and_coincident_surfaces(void **state)
{
  (void)state;
  compare_all(scene_needles(300, 1, 1e-3), scene_needles(200, 1, 1.5e-3), 1e-4,
              0);
  compare_all(scene_needles(300, 1, 1e-3), scene_needles(200, 1, 1.5e-3), 0,
              0.5);
  compare_all(scene_square(ABUT_FACET_QUAD4, 10, 0, false),
              scene_square(ABUT_FACET_QUAD4, 10, 0, false), 0, 0);
}

static void
single_facets_and_empty_surfaces(void **state)
{
  (void)state;
  const scene_mesh empty = {3, 0, 0, ABUT_FACET_QUAD4, NULL, NULL};
  assert_int_equal(compare_all(scene_square(ABUT_FACET_QUAD4, 1, 0, false),
                               scene_square(ABUT_FACET_QUAD4, 1, 0.3, true), 0,
                               0.5),
                   4);
  /* The gap is larger than the reach. */
  assert_int_equal(compare_all(scene_square(ABUT_FACET_QUAD4, 1, 0, false),
                               scene_square(ABUT_FACET_QUAD4, 1, 0.7, true), 0,
                               0.5),
                   0);
  assert_int_equal(
      compare_all(empty, scene_square(ABUT_FACET_QUAD4, 2, 0, true), 0, 1), 0);
  assert_int_equal(
      compare_all(scene_square(ABUT_FACET_QUAD4, 2, 0, true), empty, 0, 1), 0);
  assert_int_equal(compare_all(empty, empty, 0, 1), 0);
}

/* A facet, not along the axes, that is a block of queries by itself: its box is
 * all of the block's, in three directions. */
static void
one_large_query(void **state)
{
  (void)state;
  const double angles[3] = {0.3, 0.5, 0.7}, shift[3] = {0, 0, 0};
  for (int32_t n = 1; n < 7; ++n)
  {
    scene_mesh a = scene_square(ABUT_FACET_QUAD4, n, 0, false),
               b = scene_square(ABUT_FACET_QUAD4, 1, 0, true);
    scene_move(&a, 1, angles, shift);
    scene_move(&b, 1, angles, shift);
    assert_true(compare_all(a, b, 0.1, 0) >= 4);
  }
}

static void
all_nodes_in_one_point(void **state)
{
  (void)state;
  scene_mesh mesh = scene_square(ABUT_FACET_QUAD4, 7, 0, false);
  abut_surface *s = surface_of(&mesh);
  double point[3 * 100];
  for (int i = 0; i < 300; ++i)
    point[i] = i % 3 == 2 ? 0.01 : 0.5;
  abut_pairs *all = NULL, *list = NULL;
  require(abut_pairs_create(context, &all));
  require(abut_pairs_create(context, &list));
  for (int a = 0; a < ABUT_SEARCH_N_ALGORITHMS; ++a)
  {
    abut_search *search = NULL;
    const abut_search_options o = options_of((abut_search_algorithm)a, 0.25, 0);
    require(abut_search_create(context, s, &o, &search));
    require(abut_search_points(search, 100, point, a == 0 ? all : list));
    if (a > 0)
      assert_same_pairs(all, list);
    require(abut_search_destroy(&search));
  }
  abut_pairs_view view;
  require(abut_pairs_get(all, &view));
  assert_true(view.start[1] > 0);
  assert_int_equal(view.start[100], 100 * view.start[1]);
  require(abut_pairs_destroy(&all));
  require(abut_pairs_destroy(&list));
  require(abut_surface_destroy(&s));
  scene_free(&mesh);
}

static void
moved(scene_mesh *m, double scale, double shift)
{
  const double angles[3] = {0.3, -0.7, 1.1};
  const double by[3] = {shift, -shift, 0.5 * shift};
  scene_move(m, scale, angles, by);
}

static void
huge_and_tiny_coordinates(void **state)
{
  (void)state;
  static const double scale[5] = {1e-9, 1e9, 1, 1, 1e-30};
  static const double shift[5] = {0, 0, 1e9, -1e6, 0};
  for (int i = 0; i < 5; ++i)
  {
    scene_mesh a = scene_square(ABUT_FACET_QUAD4, 12, 0, false);
    scene_mesh b = scene_square(ABUT_FACET_QUAD4, 9, 0.01, true);
    moved(&a, scale[i], shift[i]);
    moved(&b, scale[i], shift[i]);
    assert_true(compare_all(a, b, 0, 0.5) > 0);
  }
}

/* A cluster 1e-12 times as large as the scene: no lattice over the scene
 * resolves it. */
static void
tiny_cluster_in_a_large_scene(void **state)
{
  (void)state;
  scene_mesh far = scene_square(ABUT_FACET_QUAD4, 2, 0, false);
  scene_mesh near = scene_square(ABUT_FACET_QUAD4, 20, 0, false);
  scene_mesh other = scene_square(ABUT_FACET_QUAD4, 15, 0.01, true);
  const double zero[3] = {0, 0, 0}, away[3] = {1e12, 1e12, 1e12};
  scene_move(&far, 1, zero, away);
  scene_mesh both = scene_join(near, far);
  abut_surface *s = surface_of(&both);
  abut_search *search = NULL;
  abut_search_statistics z;
  abut_pairs *pairs = NULL;
  const abut_search_options o =
      options_of(ABUT_SEARCH_ADAPTIVE_BUCKETS, 0, 0.5);
  abut_surface *t = surface_of(&other);
  require(abut_pairs_create(context, &pairs));
  require(abut_search_create(context, s, &o, &search));
  require(abut_search_nodes(search, t, pairs));
  require(abut_search_get_statistics(search, &z));
  /* Not every facet was looked at for every block of at most 64 nodes. */
  assert_true(z.n_block_tests < 400 * (256 / 64) / 2 + 16 * 400);
  require(abut_search_destroy(&search));
  require(abut_pairs_destroy(&pairs));
  require(abut_surface_destroy(&s));
  require(abut_surface_destroy(&t));
  compare_all(both, other, 0, 0.5);
}

static void
random_scenes(void **state)
{
  (void)state;
  for (uint64_t i = 0; i < 1000; ++i)
  {
    uint64_t seed = i;
    static const abut_facet_kind kinds[6] = {
        ABUT_FACET_QUAD4, ABUT_FACET_TRI3,  ABUT_FACET_QUAD9,
        ABUT_FACET_TRI6,  ABUT_FACET_LINE2, ABUT_FACET_LINE3};
    const bool plane_scene = i % 3 == 2;
    const abut_facet_kind k =
        kinds[plane_scene ? 4 + i % 2 : scene_bits(&seed) % 4];
    const abut_facet_kind l =
        kinds[plane_scene ? 4 + i / 2 % 2 : scene_bits(&seed) % 4];
    const int32_t n = (int32_t)(scene_bits(&seed) % 60);
    const int32_t m = (int32_t)(scene_bits(&seed) % 60);
    const double ratio = pow(10, 4 * scene_uniform(&seed));
    const double box = pow(10, 6 * scene_uniform(&seed) - 3);
    const double largest = box * pow(10, -2 * scene_uniform(&seed));
    scene_mesh a = scene_random(k, n, box, largest / ratio, largest, &seed);
    scene_mesh b = scene_random(l, m, box, largest / 10, largest, &seed);
    const double reach = i % 2 == 0 ? 0 : 0.1 * largest;
    const double relative = scene_uniform(&seed);
    const int64_t expected = count_by_definition(&a, &b, reach, relative);
    const int64_t found = compare_all(a, b, reach, relative);
    /* The definition is evaluated here in another order of operations; in
     * random scenes no pair is closer to the border than round-off. */
    assert_int_equal(found, expected);
  }
}

/* Pairs of a shuffled surface are the pairs of the original one. */
static void
renumbering(void **state)
{
  (void)state;
  uint64_t seed = 7;
  const double p[3] = {1, 0, 0.5}, q[3] = {1.01, 0, 0.5};
  scene_mesh a = scene_patch(ABUT_FACET_QUAD4, 20, 20, scene_sphere, p, false);
  scene_mesh b = scene_patch(ABUT_FACET_QUAD4, 15, 15, scene_sphere, q, true);
  abut_surface *s = surface_of(&a), *t = surface_of(&b);
  abut_pairs *before = NULL, *after = NULL, *facets = NULL;
  require(abut_pairs_create(context, &before));
  require(abut_pairs_create(context, &after));
  require(abut_pairs_create(context, &facets));
  const abut_search_options o =
      options_of(ABUT_SEARCH_ADAPTIVE_BUCKETS, 0, 0.5);
  const int64_t n = run(s, t, &o, before, facets);
  int64_t node_id[256], facet_id[400], unused[441], unused_too[225];
  require(abut_surface_destroy(&s));
  require(abut_surface_destroy(&t));
  scene_shuffle(&a, &seed, unused, facet_id);
  scene_shuffle(&b, &seed, node_id, unused_too);
  s = surface_of(&a);
  t = surface_of(&b);
  assert_int_equal(run(s, t, &o, after, facets), n);
  abut_pairs_view u, v;
  require(abut_pairs_get(before, &u));
  require(abut_pairs_get(after, &v));
  for (int32_t i = 0; i < v.n_queries; ++i)
  {
    const int64_t old = node_id[i];
    assert_int_equal(v.start[i + 1] - v.start[i],
                     u.start[old + 1] - u.start[old]);
    for (int64_t e = v.start[i]; e < v.start[i + 1]; ++e)
    {
      bool found = false;
      for (int64_t g = u.start[old]; g < u.start[old + 1]; ++g)
        found = found || u.facet[g] == facet_id[v.facet[e]];
      assert_true(found);
    }
  }
  require(abut_pairs_destroy(&before));
  require(abut_pairs_destroy(&after));
  require(abut_pairs_destroy(&facets));
  destroy_both(&s, &t, &a, &b);
}

/* Boxes turn with the axes: pairs are the same after a translation by numbers
 * that add without rounding and after turns by right angles. */
static void
translation_and_quarter_turns(void **state)
{
  (void)state;
  const abut_search_options o =
      options_of(ABUT_SEARCH_ADAPTIVE_BUCKETS, 0, 0.5);
  abut_pairs *before = NULL, *after = NULL, *facets = NULL;
  require(abut_pairs_create(context, &before));
  require(abut_pairs_create(context, &after));
  require(abut_pairs_create(context, &facets));
  for (int turn = 0; turn < 3; ++turn)
  {
    scene_mesh mesh[2] = {scene_square(ABUT_FACET_QUAD4, 16, 0, false),
                          scene_square(ABUT_FACET_TRI3, 8, 0.015625, true)};
    abut_surface *s = surface_of(&mesh[0]), *t = surface_of(&mesh[1]);
    run(s, t, &o, before, facets);
    for (int k = 0; k < 2; ++k)
    {
      for (int32_t i = 0; i < mesh[k].n_nodes; ++i)
      {
        double *x = mesh[k].position + 3 * i;
        const double y[3] = {x[0], x[1], x[2]};
        const int a = turn, b = (turn + 1) % 3, c = (turn + 2) % 3;
        x[a] = -y[b] + 64;
        x[b] = y[a] - 32;
        x[c] = y[c] + 16;
      }
      require(abut_surface_update(k == 0 ? s : t, mesh[k].position));
    }
    run(s, t, &o, after, facets);
    assert_same_pairs(before, after);
    require(abut_surface_destroy(&s));
    require(abut_surface_destroy(&t));
    scene_free(&mesh[0]);
    scene_free(&mesh[1]);
  }
  require(abut_pairs_destroy(&before));
  require(abut_pairs_destroy(&after));
  require(abut_pairs_destroy(&facets));
}

/* The sheet rolls over the other one in many small steps: with and without
 * skin, refitted or rebuilt, the pairs are those of a fresh search. */
static void
motion_with_skin(void **state)
{
  (void)state;
  for (int algorithm = 1; algorithm < ABUT_SEARCH_N_ALGORITHMS; ++algorithm)
  {
    scene_mesh a = scene_square(ABUT_FACET_QUAD4, 20, 0, false);
    scene_mesh b = scene_square(ABUT_FACET_QUAD4, 15, 0.02, true);
    abut_surface *s = surface_of(&a), *t = surface_of(&b);
    abut_search *search = NULL;
    abut_search_statistics z;
    abut_pairs *pairs[2] = {NULL, NULL}, *fresh[2] = {NULL, NULL};
    abut_search_options o =
        options_of((abut_search_algorithm)algorithm, 0, 0.5);
    o.skin = 0.02;
    require(abut_search_create(context, s, &o, &search));
    for (int i = 0; i < 2; ++i)
    {
      require(abut_pairs_create(context, &pairs[i]));
      require(abut_pairs_create(context, &fresh[i]));
    }
    for (int step = 0; step < 60; ++step)
    {
      for (int32_t i = 0; i < b.n_nodes; ++i)
        b.position[3 * i] += 0.004;
      for (int32_t i = 0; i < a.n_nodes; ++i)
        a.position[3 * i + 2] += 1e-4 * sin(5 * a.position[3 * i] + step);
      if (step > 40)
        for (int32_t i = 0; i < a.n_nodes; ++i)
          a.position[3 * i] *= 1.1;
      require(abut_surface_update(s, a.position));
      require(abut_surface_update(t, b.position));
      require(abut_search_nodes(search, t, pairs[0]));
      require(abut_search_facets(search, t, pairs[1]));
      const abut_search_options all = options_of(ABUT_SEARCH_ALL_PAIRS, 0, 0.5);
      run(s, t, &all, fresh[0], fresh[1]);
      assert_same_pairs(pairs[0], fresh[0]);
      assert_same_pairs(pairs[1], fresh[1]);
    }
    require(abut_search_get_statistics(search, &z));
    assert_true(z.n_reuses > 0);
    assert_true(z.n_searches > 2);
    assert_true(z.n_refits > 0);
    assert_true(z.n_builds > 1);
    require(abut_search_destroy(&search));
    for (int i = 0; i < 2; ++i)
    {
      require(abut_pairs_destroy(&pairs[i]));
      require(abut_pairs_destroy(&fresh[i]));
    }
    destroy_both(&s, &t, &a, &b);
  }
}

/* Memory is proportional to the number of facets whatever the bucket size,
 * and a warmed-up search allocates nothing. */
static void
memory(void **state)
{
  (void)state;
  static const double sizes[] = {0, 1e-12, 2, 1e12};
  scene_mesh a = scene_square(ABUT_FACET_QUAD4, 100, 0, false);
  scene_mesh b = scene_square(ABUT_FACET_QUAD4, 75, 0.001, true);
  abut_surface *s = surface_of(&a), *t = surface_of(&b);
  abut_pairs *pairs = NULL;
  require(abut_pairs_create(context, &pairs));
  for (int algorithm = 1; algorithm < ABUT_SEARCH_N_ALGORITHMS; ++algorithm)
    for (int i = 0; i < 4; ++i)
    {
      abut_search *search = NULL;
      abut_search_statistics z;
      abut_search_options o =
          options_of((abut_search_algorithm)algorithm, 0, 0.5);
      o.bucket_size = sizes[i];
      require(abut_search_create(context, s, &o, &search));
      require(abut_search_nodes(search, t, pairs));
      require(abut_search_get_statistics(search, &z));
      assert_true(z.structure_bytes <= 100 * 10000);
      /* The search radius is one facet size. */
      assert_int_equal(z.bucket_raised,
                       algorithm == ABUT_SEARCH_UNIFORM_BUCKETS && i == 1);
      /* The second time the same motion is met with enough memory. */
      uint64_t before = 0;
      for (int step = 0; step < 8; ++step)
      {
        if (step == 4)
          before = abut_context_memory(context).n_allocations;
        for (int32_t k = 0; k < a.n_nodes; ++k)
          a.position[3 * k] += step % 4 < 3 ? 0.25 : -0.75;
        require(abut_surface_update(s, a.position));
        require(abut_search_nodes(search, t, pairs));
      }
      assert_int_equal(abut_context_memory(context).n_allocations, before);
      require(abut_search_destroy(&search));
    }
  require(abut_pairs_destroy(&pairs));
  destroy_both(&s, &t, &a, &b);
}

static void
wrong_arguments(void **state)
{
  (void)state;
  scene_mesh mesh = scene_square(ABUT_FACET_QUAD4, 2, 0, false);
  abut_surface *s = surface_of(&mesh);
  abut_search *search = NULL;
  abut_pairs *pairs = NULL;
  require(abut_pairs_create(context, &pairs));
  const struct
  {
    double bucket_size, reach, relative, skin;
    int32_t capacity, algorithm;
  } bad[] = {
      {-1, 0, 0, 0, 0, 1},       {NAN, 0, 0, 0, 0, 1}, {0, -1, 0, 0, 0, 1},
      {0, INFINITY, 0, 0, 0, 1}, {0, 0, -1, 0, 0, 1},  {0, 0, NAN, 0, 0, 1},
      {0, 0, 0, -1, 0, 1},       {0, 0, 0, 0, -1, 1},  {0, 0, 0, 0, 4097, 1},
      {0, 0, 0, 0, 0, 3},        {0, 0, 0, 0, 0, -1}};
  for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); ++i)
  {
    abut_search_options o = abut_search_defaults();
    o.bucket_size = bad[i].bucket_size;
    o.reach = bad[i].reach;
    o.relative_reach = bad[i].relative;
    o.skin = bad[i].skin;
    o.capacity = bad[i].capacity;
    o.algorithm = (abut_search_algorithm)bad[i].algorithm;
    assert_int_equal(abut_search_create(context, s, &o, &search),
                     ABUT_INVALID_ARGUMENT);
    assert_null(search);
  }
  require(abut_search_create(context, s, NULL, &search));
  const double point[6] = {0, 0, 0, 0, NAN, 0};
  assert_int_equal(abut_search_points(search, 2, point, pairs),
                   ABUT_NOT_FINITE);
  assert_non_null(strstr(abut_context_message(context), "point 1"));
  assert_int_equal(abut_search_points(search, 1, NULL, pairs),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_search_nodes(search, NULL, pairs),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_search_set_reach(search, NAN, 0, 0),
                   ABUT_INVALID_ARGUMENT);
  require(abut_search_destroy(&search));
  require(abut_pairs_destroy(&pairs));
  require(abut_surface_destroy(&s));
  scene_free(&mesh);
}

static void
names(void **state)
{
  (void)state;
  abut_search_algorithm found;
  for (int a = 0; a < ABUT_SEARCH_N_ALGORITHMS; ++a)
  {
    const abut_search_algorithm algorithm = (abut_search_algorithm)a;
    require(abut_search_find(abut_search_name(algorithm), &found));
    assert_int_equal(found, a);
  }
  assert_int_equal(abut_search_find("octree", &found), ABUT_INVALID_ARGUMENT);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(flat_grids),
      cmocka_unit_test(matching_grids_have_four_pairs_per_facet),
      cmocka_unit_test(clipped_pairs_of_flat_grids),
      cmocka_unit_test(sphere_patches),
      cmocka_unit_test(sphere_in_sphere),
      cmocka_unit_test(graded_ring),
      cmocka_unit_test(crossing_thin_plates),
      cmocka_unit_test(folded_sheet_with_itself),
      cmocka_unit_test(needles_and_coincident_surfaces),
      cmocka_unit_test(single_facets_and_empty_surfaces),
      cmocka_unit_test(all_nodes_in_one_point),
      cmocka_unit_test(huge_and_tiny_coordinates),
      cmocka_unit_test(tiny_cluster_in_a_large_scene),
      cmocka_unit_test(random_scenes),
      cmocka_unit_test(renumbering),
      cmocka_unit_test(translation_and_quarter_turns),
      cmocka_unit_test(motion_with_skin),
      cmocka_unit_test(memory),
      cmocka_unit_test(wrong_arguments),
      cmocka_unit_test(one_large_query),
      cmocka_unit_test(names)};
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
