/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Abut's three searches in the benchmark. Memory is warm, as in every call but
 * the first of a simulation; everything else is done anew in each repeat. */
#include "search_bench.h"

#include "contact/detect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct
{
  abut_context *context;
  abut_surface *secondary, *primary;
} world;

static void
require(abut_status status)
{
  if (status != ABUT_SUCCESS)
    abort();
}

static world
begin(const bench_scene *scene)
{
  world w = {NULL, NULL, NULL};
  abut_surface_data s = scene_data(&scene->secondary);
  abut_surface_data p = scene_data(&scene->primary);
  s.borrow = p.borrow = true;
  require(abut_context_create(NULL, &w.context));
  require(abut_surface_create(w.context, &s, &w.secondary));
  require(abut_surface_create(w.context, &p, &w.primary));
  return w;
}

static void
end(world *w)
{
  require(abut_surface_destroy(&w->secondary));
  require(abut_surface_destroy(&w->primary));
  require(abut_context_destroy(&w->context));
}

/* Positions are new: forget what was computed from the old ones. */
static void
touch(const bench_scene *scene, world *w, abut_search *search)
{
  require(abut_surface_update(w->secondary, scene->secondary.position));
  require(abut_surface_update(w->primary, scene->primary.position));
  search->revision = 0;
}

static void
candidates(const bench_scene *scene, world *w,
           const abut_search_options *options, bench_result *r)
{
  abut_search *search = NULL;
  abut_pairs *pairs = NULL;
  abut_pairs_view v;
  abut_search_statistics z;
  require(abut_search_create(w->context, w->primary, options, &search));
  require(abut_pairs_create(w->context, &pairs));
  require(abut_search_nodes(search, w->secondary, pairs));
  touch(scene, w, search);
  const double t0 = bench_now();
  require(abut_search_update(search));
  const double t1 = bench_now();
  require(abut_search_nodes(search, w->secondary, pairs));
  r->query = bench_now() - t1;
  r->build = t1 - t0;
  require(abut_pairs_get(pairs, &v));
  require(abut_search_get_statistics(search, &z));
  r->bytes = (double)z.structure_bytes;
  r->n = v.start[v.n_queries];
  for (int32_t i = 0; i < v.n_queries; ++i)
    for (int64_t e = v.start[i]; e < v.start[i + 1]; ++e)
      r->sum += bench_pair_number(i, v.facet[e]);
  require(abut_search_destroy(&search));
  require(abut_pairs_destroy(&pairs));
}

static void
nearest(const bench_scene *scene, world *w, const abut_search_options *options,
        bench_result *r)
{
  abut_detection *d = NULL;
  abut_detection_view v;
  abut_search_statistics z;
  abut_detection_options o = abut_detection_defaults();
  o.search = *options;
  require(abut_detection_create(w->context, w->secondary, w->primary, &o, &d));
  require(abut_detection_run(d, 0));
  touch(scene, w, d->search);
  const double t0 = bench_now();
  require(abut_search_update(d->search));
  const double t1 = bench_now();
  require(abut_detection_run(d, 0));
  r->query = bench_now() - t1;
  r->build = t1 - t0;
  require(abut_detection_get(d, &v));
  require(abut_search_get_statistics(d->search, &z));
  r->bytes = (double)z.structure_bytes;
  for (int32_t i = 0; i < v.n_nodes; ++i)
    if (v.contact[i].facet >= 0)
    {
      ++r->n;
      r->sum += v.contact[i].distance;
    }
  require(abut_detection_destroy(&d));
}

static int
run(const bench_scene *scene, bench_task task, abut_search_algorithm algorithm,
    bench_result *r)
{
  world w = begin(scene);
  abut_search_options o = abut_search_defaults();
  o.algorithm = algorithm;
  o.relative_reach = task == BENCH_CANDIDATES ? 1 : 0.5;
  memset(r, 0, sizeof(*r));
  if (task == BENCH_CANDIDATES)
    candidates(scene, &w, &o, r);
  else
    nearest(scene, &w, &o, r);
  end(&w);
  return 1;
}

int
bench_all_pairs(const bench_scene *scene, bench_task task, bench_result *r)
{
  /* Quadratic: some 10^8 tests show it. */
  if ((double)scene->primary.n_facets * scene->secondary.n_nodes > 1.5e8)
    return 0;
  return run(scene, task, ABUT_SEARCH_ALL_PAIRS, r);
}

int
bench_uniform(const bench_scene *scene, bench_task task, bench_result *r)
{
  return run(scene, task, ABUT_SEARCH_UNIFORM_BUCKETS, r);
}

int
bench_adaptive(const bench_scene *scene, bench_task task, bench_result *r)
{
  return run(scene, task, ABUT_SEARCH_ADAPTIVE_BUCKETS, r);
}

static abut_status
count_pairs(void *user, const abut_answers *answers)
{
  *(int64_t *)user += answers->start[answers->n] - answers->start[0];
  return ABUT_SUCCESS;
}

/* Steps 2 to 11 by searching, and by checking that a list still serves. */
static void
time_steps(const bench_scene *scene, world *w, abut_detection *d,
           bench_stages *z)
{
  const double n = scene->secondary.n_nodes;
  abut_search *s = d->search;
  abut_query query;
  int64_t pairs = 0;
  touch(scene, w, s);
  double t0 = bench_now();
  require(abut_search_update(s));
  require(abut_search_query_of(s, w->secondary, false, &query));
  require(abut_search_list(s, &query, 0, &s->list, count_pairs, &pairs));
  z->steps_2_to_11 = fmin(z->steps_2_to_11, 1e9 * (bench_now() - t0) / n);
  s->skin = 0.1 * scene->largest;
  require(abut_skin_list_make(&d->list, s, w->secondary, false));
  require(abut_surface_update(w->primary, scene->primary.position));
  t0 = bench_now();
  require(abut_search_refresh(s));
  const double t1 = bench_now();
  if (!abut_skin_list_serves(&d->list, s, w->secondary, false))
    abort();
  z->after_motion = fmin(z->after_motion, 1e9 * (bench_now() - t1) / n);
  z->renewal = fmin(z->renewal, 1e9 * (t1 - t0) / n);
  s->skin = 0;
}

void
bench_stages_of(const bench_scene *scene, int repeats, bench_stages *z)
{
  world w = begin(scene);
  abut_detection *d = NULL;
  const double *normals = NULL;
  const double n = scene->secondary.n_nodes;
  const bench_stages none = {1e300, 1e300, 1e300, 1e300, 1e300, 1e300};
  *z = none;
  require(abut_detection_create(w.context, w.secondary, w.primary, NULL, &d));
  require(abut_detection_run(d, 0));
  for (int k = 0; k < repeats; ++k)
  {
    touch(scene, &w, d->search);
    const double t0 = bench_now();
    require(abut_surface_normals(w.secondary, &normals));
    const double t1 = bench_now();
    require(abut_search_update(d->search));
    const double t2 = bench_now();
    require(abut_detection_run(d, 0));
    const double t3 = bench_now();
    z->normals = fmin(z->normals, 1e9 * (t1 - t0) / n);
    z->build = fmin(z->build, 1e9 * (t2 - t1) / n);
    z->rest = fmin(z->rest, 1e9 * (t3 - t2) / n);
    time_steps(scene, &w, d, z);
  }
  require(abut_detection_destroy(&d));
  end(&w);
}

double
bench_bucket_size(const bench_scene *scene, int algorithm, double bucket_size,
                  int repeats)
{
  world w = begin(scene);
  abut_search_options o = abut_search_defaults();
  double best = 1e300;
  o.algorithm = (abut_search_algorithm)algorithm;
  o.bucket_size = bucket_size;
  for (int k = 0; k < repeats; ++k)
  {
    bench_result r = {0, 0, 0, 0, 0};
    nearest(scene, &w, &o, &r);
    best = fmin(best, 1e9 * (r.build + r.query) / scene->secondary.n_nodes);
  }
  end(&w);
  return best;
}
