/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Surfaces from arbitrary arrays, searched by all algorithms, moved, searched
 * again, and detected: all must agree, whatever the options. */
#include "input.h"
#include <abut/detect.h>

enum
{
  max_nodes = 64,
  max_entries = 256,
  max_facets = 64,
  max_points = 8
};

typedef struct arrays
{
  abut_surface_data data;
  double position[3 * max_nodes];
  int32_t connectivity[max_entries];
  uint8_t kinds[max_facets];
  int32_t group[max_facets];
  int64_t id[max_nodes];
} arrays;

/* Facets over nodes in any order; mostly refused. */
static void
take_any(input *in, arrays *a)
{
  a->data.dimension = 2 + take_byte(in) % 2;
  a->data.n_nodes = take_below(in, max_nodes);
  a->data.n_facets = take_below(in, max_facets / 2);
  const int first = a->data.dimension == 2 ? 0 : 2,
            n_kinds = a->data.dimension == 2 ? 2 : 4;
  int n = 0;
  for (int f = 0; f < a->data.n_facets; ++f)
  {
    a->kinds[f] = (uint8_t)(first + take_byte(in) % n_kinds);
    const int m = abut_facet_n_nodes((abut_facet_kind)a->kinds[f]);
    if (n + m > max_entries)
    {
      a->data.n_facets = f;
      break;
    }
    for (int k = 0; k < m; ++k)
      a->connectivity[n++] = (int32_t)take_byte(in) - 1;
  }
  a->data.kinds = a->kinds;
}

/* A sheet of n x m quadrilaterals or triangles, a chain of lines in 2D. */
static void
take_sheet(input *in, arrays *a)
{
  const int n = 1 + take_below(in, 7), m = 1 + take_below(in, 7);
  const int kind = take_byte(in) % 3;
  a->data.dimension = kind == 0 ? 2 : 3;
  a->data.kind = kind == 0   ? ABUT_FACET_LINE2
                 : kind == 1 ? ABUT_FACET_QUAD4
                             : ABUT_FACET_TRI3;
  a->data.n_nodes = kind == 0 ? n * m + 1 : (n + 1) * (m + 1);
  a->data.n_facets = kind == 0 ? n * m : kind == 1 ? n * m : m;
  int k = 0;
  for (int f = 0; f < a->data.n_facets; ++f)
  {
    const int i = f % n, j = f / n, o = j * (n + 1) + i;
    const int32_t quad[4] = {o, o + 1, o + n + 1, o + n + 2};
    const int32_t triangle[3] = {f * (n + 1), f * (n + 1) + 1,
                                 (f + 1) * (n + 1)};
    for (int c = 0; c < abut_facet_n_nodes(a->data.kind); ++c)
      a->connectivity[k++] = kind == 0   ? f + c
                             : kind == 1 ? quad[c]
                                         : triangle[c];
  }
}

/* Regular places with a disturbance, so that most facets are sound. */
static void
take_positions(input *in, arrays *a, int regular)
{
  const int dim = a->data.dimension, style = take_byte(in) % 3;
  const double scale = take_scale(in);
  const double offset = take_byte(in) % 4 == 0 ? 1e6 * scale : 0.;
  const int columns = 1 + take_below(in, 8);
  for (int i = 0; i < a->data.n_nodes; ++i)
    for (int d = 0; d < dim; ++d)
    {
      const double place = d == 0 ? i % columns : d == 1 ? i / columns : 0.;
      a->position[i * dim + d] =
          regular ? offset + scale * (place + take_grid(in) / 20.)
                  : take_coordinate(in, style, scale, offset);
    }
}

static void
take_arrays(input *in, arrays *a)
{
  memset(a, 0, sizeof(*a));
  a->data = abut_surface_data_defaults();
  const int flags = take_byte(in);
  if (flags & 1)
    take_any(in, a);
  else
    take_sheet(in, a);
  take_positions(in, a, flags & 2);
  for (int f = 0; f < a->data.n_facets; ++f)
    a->group[f] = flags & 4 ? take_byte(in) % 3 : 0;
  for (int i = 0; i < a->data.n_nodes; ++i)
    a->id[i] = flags & 8 ? 1000 - i : take_byte(in);
  a->data.connectivity = a->connectivity;
  a->data.position = a->position;
  a->data.group = flags & 4 ? a->group : NULL;
  a->data.node_id = flags & 16 ? a->id : NULL;
  a->data.borrow = flags & 32;
  a->data.check_orientation = flags & 64;
}

static abut_search_options
take_options(input *in)
{
  abut_search_options o = abut_search_defaults();
  static const double sizes[] = {0., 1e-12, 0.1, 1., 3., 1e12, 1e300, NAN};
  o.bucket_size = sizes[take_byte(in) % 8];
  o.capacity = take_byte(in) % 4 == 0 ? take_below(in, 5000) : 0;
  o.reach = take_byte(in) % 4 == 0 ? take_raw(in) : 0.;
  o.relative_reach = take_below(in, 100) / 20.;
  o.skin = take_byte(in) % 2 == 0 ? 0. : take_below(in, 100) / 50.;
  return o;
}

static void
require_equal(const abut_pairs *one, const abut_pairs *two)
{
  abut_pairs_view a, b;
  REQUIRE(abut_pairs_get(one, &a) == ABUT_SUCCESS);
  REQUIRE(abut_pairs_get(two, &b) == ABUT_SUCCESS);
  REQUIRE(a.n_queries == b.n_queries);
  for (int32_t i = 0; i < a.n_queries; ++i)
  {
    REQUIRE(a.start[i + 1] == b.start[i + 1]);
    for (int64_t k = a.start[i]; k < a.start[i + 1]; ++k)
      REQUIRE(a.facet[k] == b.facet[k]);
  }
}

/* All algorithms over the same surfaces. */
typedef struct searches
{
  abut_search *search[ABUT_SEARCH_N_ALGORITHMS];
  abut_pairs *nodes[ABUT_SEARCH_N_ALGORITHMS];
  abut_pairs *facets[ABUT_SEARCH_N_ALGORITHMS];
  abut_pairs *points[ABUT_SEARCH_N_ALGORITHMS];
} searches;

static int
create_searches(abut_context *context, abut_surface *primary,
                abut_search_options o, searches *s)
{
  memset(s, 0, sizeof(*s));
  for (int k = 0; k < ABUT_SEARCH_N_ALGORITHMS; ++k)
  {
    o.algorithm = (abut_search_algorithm)k;
    if (abut_search_create(context, primary, &o, &s->search[k]) != ABUT_SUCCESS)
      return 0;
    REQUIRE(abut_pairs_create(context, &s->nodes[k]) == ABUT_SUCCESS);
    REQUIRE(abut_pairs_create(context, &s->facets[k]) == ABUT_SUCCESS);
    REQUIRE(abut_pairs_create(context, &s->points[k]) == ABUT_SUCCESS);
  }
  return 1;
}

static void
destroy_searches(searches *s)
{
  for (int k = 0; k < ABUT_SEARCH_N_ALGORITHMS; ++k)
  {
    if (s->nodes[k])
    {
      REQUIRE(abut_pairs_destroy(&s->nodes[k]) == ABUT_SUCCESS);
      REQUIRE(abut_pairs_destroy(&s->facets[k]) == ABUT_SUCCESS);
      REQUIRE(abut_pairs_destroy(&s->points[k]) == ABUT_SUCCESS);
    }
    if (s->search[k])
      REQUIRE(abut_search_destroy(&s->search[k]) == ABUT_SUCCESS);
  }
}

static void
compare_searches(searches *s, const abut_surface *secondary, int32_t n,
                 const double *points)
{
  for (int k = 0; k < ABUT_SEARCH_N_ALGORITHMS; ++k)
  {
    const abut_status one =
        abut_search_nodes(s->search[k], secondary, s->nodes[k]);
    const abut_status two =
        abut_search_facets(s->search[k], secondary, s->facets[k]);
    const abut_status three =
        abut_search_points(s->search[k], n, points, s->points[k]);
    REQUIRE(one >= 0 && two >= 0 && three >= 0);
    if (one == ABUT_SUCCESS)
      require_equal(s->nodes[0], s->nodes[k]);
    if (two == ABUT_SUCCESS)
      require_equal(s->facets[0], s->facets[k]);
    if (three == ABUT_SUCCESS)
      require_equal(s->points[0], s->points[k]);
  }
}

static void
require_same_contacts(abut_detection *one, abut_detection *two,
                      int32_t n_facets)
{
  abut_detection_view a, b;
  REQUIRE(abut_detection_get(one, &a) == ABUT_SUCCESS);
  REQUIRE(abut_detection_get(two, &b) == ABUT_SUCCESS);
  REQUIRE(a.n_nodes == b.n_nodes && a.n_paired == b.n_paired);
  for (int32_t i = 0; i < a.n_nodes; ++i)
  {
    const abut_contact *c = &a.contact[i], *d = &b.contact[i];
    REQUIRE(c->facet >= -1 && c->facet < n_facets);
    REQUIRE(isfinite(c->gap) && c->distance >= 0.);
    REQUIRE(c->facet == d->facet && c->gap == d->gap);
  }
}

/* Detect by all pairs and by another algorithm. */
static void
run_detection(input *in, abut_context *context, abut_surface *secondary,
              abut_surface *primary, abut_search_options o)
{
  abut_detection_options options = abut_detection_defaults();
  abut_detection *detection[2] = {NULL, NULL};
  abut_surface_view facets;
  const int algorithm = take_byte(in) % ABUT_SEARCH_N_ALGORITHMS;
  options.self_contact = take_byte(in) % 2;
  options.normal_cosine = take_grid(in) / 8.;
  const int one_pair = take_byte(in) % 2;
  const int32_t groups[2] = {take_byte(in) % 3, take_byte(in) % 3};
  int created = 0;
  for (int k = 0; k < 2; ++k)
  {
    options.search = o;
    options.search.algorithm =
        k == 0 ? ABUT_SEARCH_ALL_PAIRS : (abut_search_algorithm)algorithm;
    created += abut_detection_create(context, secondary, primary, &options,
                                     &detection[k])
               == ABUT_SUCCESS;
    if (detection[k] && one_pair)
      (void)abut_detection_pair_groups(detection[k], groups[0], groups[1]);
  }
  REQUIRE(abut_surface_get(primary, &facets) == ABUT_SUCCESS);
  for (int run = 0; run < 2 && created == 2; ++run)
  {
    abut_detection_report report;
    if (abut_detection_run(detection[0], 0.1 * run) != ABUT_SUCCESS
        || abut_detection_run(detection[1], 0.1 * run) != ABUT_SUCCESS)
      break;
    require_same_contacts(detection[0], detection[1], facets.n_facets);
    REQUIRE(abut_detection_make_report(detection[1], &report) >= 0);
  }
  for (int k = 0; k < 2; ++k)
    if (detection[k])
      REQUIRE(abut_detection_destroy(&detection[k]) == ABUT_SUCCESS);
}

static void
run(input *in, abut_context *context, abut_surface *secondary,
    abut_surface *primary, arrays *moved)
{
  double points[3 * max_points];
  searches s;
  const abut_search_options o = take_options(in);
  for (int i = 0; i < 3 * max_points; ++i)
    points[i] = take_coordinate(in, i % 7 == 6 ? 2 : 0, 1., 0.);
  if (create_searches(context, primary, o, &s))
  {
    compare_searches(&s, secondary, max_points, points);
    const int small = take_byte(in) % 2;
    for (int i = 0; i < moved->data.n_nodes * moved->data.dimension; ++i)
      moved->position[i] += take_grid(in) * (small ? 0.01 : 1.);
    (void)abut_surface_update(primary, moved->position);
    compare_searches(&s, secondary, max_points, points);
    compare_searches(&s, primary, max_points, points);
  }
  destroy_searches(&s);
  run_detection(in, context, secondary, primary, o);
  run_detection(in, context, primary, primary, o);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static arrays a, b;
  input in = {data, size};
  abut_context *context = NULL;
  abut_surface *secondary = NULL, *primary = NULL;
  REQUIRE(abut_context_create(NULL, &context) == ABUT_SUCCESS);
  take_arrays(&in, &a);
  take_arrays(&in, &b);
  const abut_status one = abut_surface_create(context, &a.data, &secondary),
                    two = abut_surface_create(context, &b.data, &primary);
  REQUIRE(one >= 0 && two >= 0);
  if (one == ABUT_SUCCESS && two == ABUT_SUCCESS)
  {
    abut_surface_sizes sizes;
    const double *normal;
    REQUIRE(abut_surface_measure(primary, &sizes) == ABUT_SUCCESS);
    REQUIRE(abut_surface_normals(secondary, &normal) == ABUT_SUCCESS);
    run(&in, context, secondary, primary, &b);
  }
  if (secondary)
    REQUIRE(abut_surface_destroy(&secondary) == ABUT_SUCCESS);
  if (primary)
    REQUIRE(abut_surface_destroy(&primary) == ABUT_SUCCESS);
  REQUIRE(abut_context_destroy(&context) == ABUT_SUCCESS);
  return 0;
}
