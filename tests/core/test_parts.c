/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Detection over parts of surfaces is detection over the whole. */
#include "pack.h"
#include "surface_fixture.h"

#include <abut/detect.h>
#include <abut/parts.h>

enum
{
  MAX_PARTS = 7,
  MAX_BOXES = 4
};

typedef struct
{
  size_t bytes;
  void *data;
} buffer;

static buffer
pack(abut_surface *s, int32_t n, const int32_t *facets)
{
  buffer b = {0, NULL};
  require(pack_surface(s, n, facets, NULL, &b.bytes));
  b.data = malloc(b.bytes);
  size_t bytes = b.bytes - 1;
  assert_int_equal(pack_surface(s, n, facets, b.data, &bytes),
                   ABUT_INVALID_ARGUMENT);
  bytes = b.bytes;
  require(pack_surface(s, n, facets, b.data, &bytes));
  assert_int_equal(bytes, b.bytes);
  return b;
}

static abut_surface *
unpack(int32_t dimension, int32_t n, buffer *b)
{
  const void *data[MAX_PARTS] = {NULL};
  size_t bytes[MAX_PARTS] = {0};
  abut_surface *s = NULL;
  for (int32_t i = 0; i < n; ++i)
  {
    data[i] = b[i].data;
    bytes[i] = b[i].bytes;
  }
  require(unpack_surfaces(context, dimension, n, data, bytes, &s));
  for (int32_t i = 0; i < n; ++i)
    free(b[i].data);
  return s;
}

/* Part `part` of `n_parts` of the facets: cut along the numbering (how = 0) or
 * one here, one there (how = 1). */
static abut_surface *
cut(abut_surface *whole, int32_t part, int32_t n_parts, int how)
{
  abut_surface_view v;
  require(abut_surface_get(whole, &v));
  int32_t *facets = malloc(sizeof(int32_t) * (size_t)(v.n_facets + 1));
  int32_t n = 0;
  for (int32_t f = 0; f < v.n_facets; ++f)
  {
    const int32_t owner = how == 0
                              ? (int32_t)((int64_t)f * n_parts / v.n_facets)
                              : f * 7 / 3 % n_parts;
    if (owner == part)
      facets[n++] = f;
  }
  buffer b = pack(whole, n, facets);
  free(facets);
  return unpack(v.dimension, 1, &b);
}

static abut_search *
search_over(abut_surface *s, const abut_search_options *options)
{
  abut_search *search = NULL;
  require(abut_search_create(context, s, options, &search));
  return search;
}

/* What part `me` receives from all parts: facets near the bounds of mine. */
static abut_surface *
collect(abut_surface *mine, abut_surface **parts, int32_t n_parts,
        const abut_search_options *options, double reach)
{
  abut_box boxes[MAX_BOXES];
  int32_t n_boxes = 0;
  buffer received[MAX_PARTS];
  abut_surface_view v;
  require(abut_surface_bounds(mine, reach, MAX_BOXES, boxes, &n_boxes));
  for (int32_t p = 0; p < n_parts; ++p)
  {
    abut_search *search = search_over(parts[p], options);
    require(abut_surface_get(parts[p], &v));
    int32_t *facets = malloc(sizeof(int32_t) * (size_t)(v.n_facets + 1));
    int32_t n = 0;
    require(abut_search_select(search, n_boxes, boxes, facets, &n));
    received[p] = pack(parts[p], n, facets);
    free(facets);
    require(abut_search_destroy(&search));
  }
  return unpack(v.dimension, n_parts, received);
}

/* Compare the result for the nodes of `own` with the whole one. */
static int32_t
compare(const abut_surface *own, abut_surface *secondary, abut_surface *primary,
        const abut_detection_view *part, const abut_detection_view *whole)
{
  abut_surface_view o, s, p;
  require(abut_surface_get(own, &o));
  require(abut_surface_get(secondary, &s));
  require(abut_surface_get(primary, &p));
  int32_t n = 0, j = 0;
  for (int32_t i = 0; i < o.n_nodes; ++i)
  {
    /* Both are in ascending order of their numbers. */
    while (s.node_id[j] != o.node_id[i])
      ++j;
    abut_contact mine = part->contact[j];
    const abut_contact *other = whole->contact + o.node_id[i];
    if (mine.facet >= 0)
      mine.facet = (int32_t)p.facet_id[mine.facet];
    assert_memory_equal(&mine, other, sizeof(mine));
    n += mine.facet >= 0;
  }
  return n;
}

static void
check_scene(scene_mesh a, scene_mesh b, const abut_search_options *search)
{
  const abut_surface_data da = scene_data(&a);
  abut_surface_data db = scene_data(&b);
  /* Nodes of the two surfaces are different nodes. */
  int64_t *node_id = malloc(sizeof(int64_t) * (size_t)b.n_nodes);
  for (int32_t i = 0; i < b.n_nodes; ++i)
    node_id[i] = 1000000 + i;
  db.node_id = node_id;
  abut_surface *secondary = NULL, *primary = NULL;
  abut_detection *d = NULL;
  abut_detection_view whole, part;
  abut_detection_options o = abut_detection_defaults();
  abut_surface_sizes sizes;
  o.search = *search;
  abut_search_options touching = *search;
  touching.reach = touching.relative_reach = 0;
  require(abut_surface_create(context, &da, &secondary));
  require(abut_surface_create(context, &db, &primary));
  require(abut_detection_create(context, secondary, primary, &o, &d));
  require(abut_detection_run(d, 0));
  require(abut_detection_get(d, &whole));
  assert_true(whole.n_paired > 0);
  require(abut_surface_measure(primary, &sizes));
  const double reach =
      fmax(search->reach, search->relative_reach * sizes.largest);
  for (int32_t n_parts = 2; n_parts <= MAX_PARTS; ++n_parts)
  {
    abut_surface *sp[MAX_PARTS], *pp[MAX_PARTS];
    int32_t n_paired = 0;
    for (int32_t k = 0; k < n_parts; ++k)
    {
      sp[k] = cut(secondary, k, n_parts, n_parts % 2);
      pp[k] = cut(primary, k, n_parts, n_parts / 2 % 2);
    }
    for (int32_t k = 0; k < n_parts; ++k)
    {
      abut_surface *s = collect(sp[k], sp, n_parts, &touching, 0);
      abut_surface *p = collect(sp[k], pp, n_parts, search, reach);
      abut_detection *e = NULL;
      require(abut_detection_create(context, s, p, &o, &e));
      require(abut_detection_run(e, 0));
      require(abut_detection_get(e, &part));
      n_paired += compare(sp[k], s, p, &part, &whole);
      require(abut_detection_destroy(&e));
      require(abut_surface_destroy(&s));
      require(abut_surface_destroy(&p));
    }
    /* Nodes on the rims of parts are counted more than once. */
    assert_true(n_paired >= whole.n_paired);
    for (int32_t k = 0; k < n_parts; ++k)
    {
      require(abut_surface_destroy(&sp[k]));
      require(abut_surface_destroy(&pp[k]));
    }
  }
  require(abut_detection_destroy(&d));
  require(abut_surface_destroy(&secondary));
  require(abut_surface_destroy(&primary));
  free(node_id);
  scene_free(&a);
  scene_free(&b);
}

static void
parts_are_the_whole(void **state)
{
  (void)state;
  const abut_search_options o = abut_search_defaults();
  const double flat[5] = {0, 0, 1, 1, 0}, above[5] = {0.1, 0.2, 1, 1, 0.01};
  check_scene(scene_patch(ABUT_FACET_QUAD4, 12, 12, scene_plane, above, true),
              scene_patch(ABUT_FACET_TRI3, 11, 9, scene_plane, flat, false),
              &o);
  const double inner[3] = {1, 0, 0.8}, outer[3] = {1.01, 0, 0.8};
  check_scene(scene_patch(ABUT_FACET_QUAD4, 15, 15, scene_sphere, outer, true),
              scene_patch(ABUT_FACET_QUAD4, 19, 17, scene_sphere, inner, false),
              &o);
  check_scene(scene_patch(ABUT_FACET_QUAD9, 7, 7, scene_sphere, outer, true),
              scene_patch(ABUT_FACET_TRI6, 9, 8, scene_sphere, inner, false),
              &o);
  /* Facets of very different size: the fringe matters. */
  const double ring[4] = {1e-3, 1, 0, 6}, lid[4] = {1e-3, 1, 1e-5, 6};
  check_scene(scene_patch(ABUT_FACET_QUAD4, 31, 23, scene_ring, lid, true),
              scene_patch(ABUT_FACET_QUAD4, 27, 25, scene_ring, ring, false),
              &o);
  const double arc[5] = {0, 0, 1, 0.1, 3}, hull[5] = {0, 0, 1.02, 0, 3.1};
  check_scene(scene_patch(ABUT_FACET_LINE2, 40, 1, scene_arc, arc, false),
              scene_patch(ABUT_FACET_LINE3, 33, 1, scene_arc, hull, true), &o);
}

/* Matching grids: every node is over a corner of four facets. */
static void
ties_between_parts(void **state)
{
  (void)state;
  const double flat[5] = {0, 0, 1, 1, 0}, above[5] = {0, 0, 1, 1, 0.01};
  for (int a = 0; a < ABUT_SEARCH_N_ALGORITHMS; ++a)
  {
    abut_search_options o = abut_search_defaults();
    o.algorithm = (abut_search_algorithm)a;
    check_scene(scene_patch(ABUT_FACET_QUAD4, 10, 10, scene_plane, above, true),
                scene_patch(ABUT_FACET_QUAD4, 10, 10, scene_plane, flat, false),
                &o);
  }
}

static void
bounds_contain_all_facets(void **state)
{
  (void)state;
  const double p[3] = {1, 0, 0.8};
  scene_mesh m = scene_patch(ABUT_FACET_QUAD4, 16, 16, scene_sphere, p, false);
  const abut_surface_data data = scene_data(&m);
  abut_surface *s = NULL;
  abut_box boxes[8];
  int32_t n_boxes = 0;
  require(abut_surface_create(context, &data, &s));
  require(abut_surface_bounds(s, 0.125, 8, boxes, &n_boxes));
  assert_int_equal(n_boxes, 8);
  double extent = 0;
  for (int k = 0; k < 8; ++k)
    extent = fmax(extent, boxes[k].upper[0] - boxes[k].lower[0]);
  /* Each box covers a part only: the patch is 1.1 wide. */
  assert_true(extent < 1.1 + 0.25);
  for (int32_t i = 0; i < m.n_nodes; ++i)
  {
    bool in = false;
    for (int k = 0; k < 8; ++k)
    {
      bool here = true;
      for (int d = 0; d < 3; ++d)
        here = here
               && m.position[3 * i + d] >= boxes[k].lower[d] + 0.125 - 1e-15
               && m.position[3 * i + d] <= boxes[k].upper[d] - 0.125 + 1e-15;
      in = in || here;
    }
    assert_true(in);
  }
  assert_int_equal(abut_surface_bounds(s, NAN, 8, boxes, &n_boxes),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_surface_bounds(s, 0, 0, boxes, &n_boxes),
                   ABUT_INVALID_ARGUMENT);
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

/* Boxes of a rectangle do not overlap: together they have its area. */
static void
bounds_are_tight(void **state)
{
  (void)state;
  const double flat[5] = {0, 0, 1, 1, 0};
  scene_mesh m =
      scene_patch(ABUT_FACET_QUAD4, 20, 12, scene_plane, flat, false);
  const abut_surface_data data = scene_data(&m);
  abut_surface *s = NULL;
  abut_box boxes[8], all;
  int32_t n_boxes = 0, n = 0;
  require(abut_surface_create(context, &data, &s));
  require(abut_surface_bounds(s, 0, 1, &all, &n));
  require(abut_surface_bounds(s, 0, 8, boxes, &n_boxes));
  assert_int_equal(n_boxes, 8);
  double area = (all.upper[0] - all.lower[0]) * (all.upper[1] - all.lower[1]);
  assert_true(area > 0);
  for (int k = 0; k < 8; ++k)
    area -= (boxes[k].upper[0] - boxes[k].lower[0])
            * (boxes[k].upper[1] - boxes[k].lower[1]);
  assert_true(fabs(area) < 1e-12);
  /* No more boxes than facets. */
  abut_box many[300];
  require(abut_surface_bounds(s, 0, 300, many, &n_boxes));
  assert_int_equal(n_boxes, 240);
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

static void
damaged_buffers_are_refused(void **state)
{
  (void)state;
  const double flat[5] = {0, 0, 1, 1, 0};
  scene_mesh m = scene_patch(ABUT_FACET_QUAD4, 3, 3, scene_plane, flat, false);
  const abut_surface_data data = scene_data(&m);
  abut_surface *s = NULL, *t = NULL;
  require(abut_surface_create(context, &data, &s));
  const int32_t facets[3] = {0, 4, 8}, beyond[1] = {9};
  size_t bytes = 0;
  assert_int_equal(pack_surface(s, 1, beyond, NULL, &bytes),
                   ABUT_INVALID_ARGUMENT);
  buffer b = pack(s, 3, facets);
  const void *buffers[1] = {b.data};
  for (size_t cut_off = 1; cut_off <= b.bytes; ++cut_off)
  {
    bytes = b.bytes - cut_off;
    assert_int_equal(unpack_surfaces(context, 3, 1, buffers, &bytes, &t),
                     ABUT_INVALID_ARGUMENT);
  }
  assert_int_equal(unpack_surfaces(context, 2, 1, buffers, &b.bytes, &t),
                   ABUT_INVALID_ARGUMENT);
  /* Any single byte: refused, or another surface, but no crash. */
  for (size_t i = 0; i < b.bytes; ++i)
  {
    ((uint8_t *)b.data)[i] ^= 0xff;
    if (unpack_surfaces(context, 3, 1, buffers, &b.bytes, &t) == ABUT_SUCCESS)
      require(abut_surface_destroy(&t));
    ((uint8_t *)b.data)[i] ^= 0xff;
  }
  t = unpack(3, 1, &b);
  abut_surface_view v;
  require(abut_surface_get(t, &v));
  assert_int_equal(v.n_facets, 3);
  assert_int_equal(v.facet_id[1], 4);
  assert_int_equal(v.n_nodes, 10);
  require(abut_surface_destroy(&t));
  require(abut_surface_destroy(&s));
  scene_free(&m);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(parts_are_the_whole),
      cmocka_unit_test(ties_between_parts),
      cmocka_unit_test(bounds_contain_all_facets),
      cmocka_unit_test(bounds_are_tight),
      cmocka_unit_test(damaged_buffers_are_refused)};
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
