/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Surfaces from arbitrary arrays, searched by all algorithms, moved, searched
 * again, and detected: all must agree, whatever the options. */
#include "two_surfaces.h"

#include <abut/detect.h>

enum
{
  max_points = 8
};

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

void
run(input *in, abut_context *context, abut_surface *secondary,
    abut_surface *primary, arrays *moved)
{
  double points[3 * max_points];
  searches s;
  abut_surface_sizes sizes;
  const double *normal;
  REQUIRE(abut_surface_measure(primary, &sizes) == ABUT_SUCCESS);
  REQUIRE(abut_surface_normals(secondary, &normal) == ABUT_SUCCESS);
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
