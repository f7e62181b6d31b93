/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Creation of a search, and keeping it up to date with its surface. */
#include "search/search.h"

#include <math.h>
#include <string.h>

const char *
abut_search_name(abut_search_algorithm algorithm)
{
  const int i = (int)algorithm;
  return i >= 0 && i < ABUT_SEARCH_N_ALGORITHMS ? abut_search_methods[i].name
                                                : "";
}

abut_status
abut_search_find(const char *name, abut_search_algorithm *algorithm)
{
  if (name == NULL || algorithm == NULL)
    return ABUT_INVALID_ARGUMENT;
  for (int i = 0; i < ABUT_SEARCH_N_ALGORITHMS; ++i)
    if (strcmp(name, abut_search_methods[i].name) == 0)
    {
      *algorithm = (abut_search_algorithm)i;
      return ABUT_SUCCESS;
    }
  return ABUT_INVALID_ARGUMENT;
}

static bool
is_length(double v)
{
  return v >= 0 && v <= ABUT_FACET_LIMIT;
}

static const char *
fault_of(const abut_search_options *o)
{
  if ((int)o->algorithm < 0 || o->algorithm >= ABUT_SEARCH_N_ALGORITHMS)
    return "unknown algorithm";
  if (!is_length(o->bucket_size))
    return "bucket_size is negative or not finite";
  if (o->capacity < 0 || o->capacity > 4096)
    return "capacity is not in 0 .. 4096";
  if (!is_length(o->reach) || !is_length(o->relative_reach)
      || !is_length(o->skin))
    return "reach, relative_reach or skin is negative or not finite";
  for (int i = 0; i < 4; ++i)
    if (o->reserved[i] != 0)
      return "an option is set that this version of the library does not have";
  return NULL;
}

static void
prepare(abut_search *s)
{
  struct
  {
    abut_array *array;
    size_t element;
  } const list[] = {{&s->records, sizeof(abut_record)},
                    {&s->sites, sizeof(abut_site)},
                    {&s->items, sizeof(abut_keyed)},
                    {&s->room, sizeof(abut_keyed)},
                    {&s->runs, sizeof(abut_run)},
                    {&s->tree.groups, sizeof(abut_tree_group)},
                    {&s->grid.cell_key, sizeof(uint64_t)},
                    {&s->grid.cell_start, sizeof(int32_t)},
                    {&s->grid.table, sizeof(int32_t)},
                    {&s->query_box, sizeof(double)}};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
    list[i].array->element = list[i].element;
  abut_list_prepare(&s->list);
  abut_block_prepare(&s->block);
}

abut_status
abut_search_create(abut_context *context, abut_surface *surface,
                   const abut_search_options *options, abut_search **search)
{
  if (context == NULL || surface == NULL || search == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_search_create",
                     "context, surface or result is NULL");
  abut_search_options chosen = abut_search_defaults();
  const abut_status status = abut_copy_in(context, "abut_search_create",
                                          &chosen, sizeof(chosen), options);
  if (status != ABUT_SUCCESS)
    return status;
  const char *fault = fault_of(&chosen);
  if (fault != NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_search_create",
                     fault);
  abut_search *s = abut_object_create(context, sizeof(*s));
  if (s == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, "abut_search_create",
                     "no memory");
  s->context = context;
  s->surface = surface;
  s->options = chosen;
  s->method = &abut_search_methods[chosen.algorithm];
  s->reach.absolute = chosen.reach;
  s->reach.relative = chosen.relative_reach;
  s->skin = chosen.skin;
  prepare(s);
  *search = s;
  return ABUT_SUCCESS;
}

abut_status
abut_search_destroy(abut_search **search)
{
  if (search == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_search *s = *search;
  if (s == NULL)
    return ABUT_SUCCESS;
  abut_array *arrays[] = {&s->records,        &s->sites,         &s->items,
                          &s->room,           &s->runs,          &s->query_box,
                          &s->tree.groups,    &s->grid.cell_key, &s->grid.table,
                          &s->grid.cell_start};
  for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i)
    abut_array_release(s->context, arrays[i]);
  abut_list_release(s->context, &s->list);
  abut_block_release(s->context, &s->block);
  abut_object_destroy(s->context, s, sizeof(*s));
  *search = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_search_set_reach(abut_search *search, double reach, double relative_reach,
                      double skin)
{
  if (search == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_search *s = search;
  if (!is_length(reach) || !is_length(relative_reach) || !is_length(skin))
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "abut_search_set_reach",
                     "reach, relative_reach or skin is negative or not finite");
  s->reach_changed |=
      reach != s->reach.absolute || relative_reach != s->reach.relative;
  s->reach.absolute = reach;
  s->reach.relative = relative_reach;
  s->skin = skin;
  return ABUT_SUCCESS;
}

/* Median size of at most 1023 facets evenly spread over the numbering: the
 * bucket size changes the cost only, not the result. */
static double
median_size(const abut_search *s)
{
  double size[1023];
  abut_lanes lanes;
  const int32_t n = s->n < 1023 ? s->n : 1023;
  for (int32_t i = 0; i < n; ++i)
  {
    const int32_t f = (int32_t)((int64_t)i * s->n / n);
    abut_lanes_bound(s->surface, f, 1, &lanes);
    const double v = lanes.size[0];
    int32_t j = i;
    for (; j > 0 && size[j - 1] > v; --j)
      size[j] = size[j - 1];
    size[j] = v;
  }
  return n > 0 ? size[n / 2] : 0;
}

static int32_t
choose_capacity(const abut_search *s)
{
  const double b = s->options.bucket_size;
  if (s->options.capacity > 0)
    return s->options.capacity;
  if (!(b > 0))
    return 8;
  const double facets = s->surface->view.dimension == 3 ? b * b : b;
  return (int32_t)(facets < 1 ? 1 : facets > 4096 ? 4096 : round(facets));
}

static void
compute_sites(abut_search *s)
{
  for (int32_t f = 0; f < s->n; f += ABUT_LANES)
  {
    const int32_t n = s->n - f < ABUT_LANES ? s->n - f : ABUT_LANES;
    abut_site *sites = (abut_site *)s->sites.data + f;
    abut_lanes m;
    double half[ABUT_LANES] = {0};
    for (int32_t l = 0; l < n && f + n + l < s->n; ++l)
      abut_prefetch_nodes(s->surface, f + n + l);
    abut_lanes_bound(s->surface, f, n, &m);
    for (int d = 0; d < 3; ++d)
      for (int l = 0; l < ABUT_LANES; ++l)
      {
        const double h = 0.5 * (m.upper[d][l] - m.lower[d][l]);
        half[l] = h > half[l] ? h : half[l];
      }
    for (int l = 0; l < ABUT_LANES; ++l)
      half[l] += abut_reach_of(&s->reach, m.size[l]);
    for (int32_t l = 0; l < n; ++l)
    {
      for (int d = 0; d < 3; ++d)
        sites[l].centre[d] = 0.5 * (m.lower[d][l] + m.upper[d][l]);
      sites[l].half = half[l];
    }
  }
}

static abut_status
reserve(abut_search *s)
{
  const int64_t n = s->n;
  struct
  {
    abut_array *array;
    int64_t n;
  } const list[] = {
      {&s->records, n}, {&s->sites, n}, {&s->items, n}, {&s->room, n}};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
  {
    const abut_status status =
        abut_search_fit(s->context, list[i].array, list[i].n);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

/* Numbers of the n facets from place i of the search order on. */
static inline void
facets_at(const abut_record *records, const abut_keyed *items, int32_t i,
          int32_t n, int32_t *facets)
{
  for (int32_t l = 0; l < n; ++l)
    facets[l] = items != NULL ? items[i + l].index : records[i + l].facet;
}

/* Ask for the facets that will be needed soon. */
static void
prefetch_ahead(const abut_search *s, const abut_keyed *items, int32_t i)
{
  int32_t facets[ABUT_LANES];
  const abut_record *records = s->records.data;
  if (i + 3 * ABUT_LANES > s->n)
    return;
  facets_at(records, items, i + 2 * ABUT_LANES, ABUT_LANES, facets);
  for (int l = 0; l < ABUT_LANES; ++l)
    abut_prefetch_facet(s->surface, facets[l]);
  facets_at(records, items, i + ABUT_LANES, ABUT_LANES, facets);
  for (int l = 0; l < ABUT_LANES; ++l)
    abut_prefetch_nodes(s->surface, facets[l]);
}

/* Compute the records of all facets, in the order of the sorted items or (NULL)
 * the one they have, and, while they are in the cache, the boxes around each
 * bucket and around all. Returns the sum of the buckets' extents. */
static double
compute_records(abut_search *s, const abut_keyed *items)
{
  abut_record *records = s->records.data;
  const abut_search_method *m = s->method;
  const int32_t chunk = m->bucket_size != NULL ? m->bucket_size(s) : 64;
  const abut_bounds none = {{INFINITY, INFINITY, INFINITY},
                            {-INFINITY, -INFINITY, -INFINITY},
                            INFINITY};
  abut_bounds all = none;
  double extent = 0;
  for (int32_t first = 0; first < s->n; first += chunk)
  {
    const int32_t last = s->n - first < chunk ? s->n : first + chunk;
    abut_bounds b = none;
    for (int32_t i = first; i < last; i += ABUT_LANES)
    {
      const int32_t n = last - i < ABUT_LANES ? last - i : ABUT_LANES;
      int32_t facets[ABUT_LANES];
      prefetch_ahead(s, items, i);
      facets_at(records, items, i, n, facets);
      abut_records_compute(s->surface, facets, n, &s->reach, records + i, &b);
    }
    if (m->fit_bucket != NULL)
      extent += m->fit_bucket(s, first / chunk, b.lower, b.upper);
    for (int d = 0; d < 3; ++d)
    {
      all.lower[d] = b.lower[d] < all.lower[d] ? b.lower[d] : all.lower[d];
      all.upper[d] = b.upper[d] > all.upper[d] ? b.upper[d] : all.upper[d];
    }
    all.smallest = b.smallest < all.smallest ? b.smallest : all.smallest;
  }
  memcpy(s->lower, all.lower, sizeof(s->lower));
  memcpy(s->upper, all.upper, sizeof(s->upper));
  s->smallest = s->n > 0 ? all.smallest : 0;
  return extent;
}

static abut_status
build_all_pairs(abut_search *s)
{
  abut_keyed *items = s->items.data;
  for (int32_t f = 0; f < s->n; ++f)
    items[f].index = f;
  compute_records(s, items);
  return ABUT_SUCCESS;
}

static abut_status
build_grid(abut_search *s)
{
  abut_search_statistics *z = &s->statistics;
  compute_sites(s);
  /* Four facets along a side of a cell cost least, measured; the radius of
   * the largest facet is the least that works. */
  const double asked = s->options.bucket_size;
  const double edge = (asked > 0 ? asked : 4) * median_size(s);
  abut_status status = abut_grid_build(s->context, &s->grid, s->sites.data,
                                       s->n, edge, s->items.data, s->room.data);
  compute_records(s, s->items.data);
  if (status == ABUT_SUCCESS)
    status = abut_search_fit(s->context, &s->runs, s->grid.n_cells);
  z->n_buckets = s->grid.n_cells;
  z->bucket_edge = s->grid.edge;
  z->bucket_raised = asked > 0 && s->grid.raised;
  return status;
}

static abut_status
build_tree(abut_search *s)
{
  abut_search_statistics *z = &s->statistics;
  compute_sites(s);
  abut_status status =
      abut_tree_reserve(s->context, &s->tree, s->n, choose_capacity(s));
  if (status == ABUT_SUCCESS)
    status = abut_search_fit(s->context, &s->runs, s->tree.n_buckets);
  if (status != ABUT_SUCCESS)
    return status;
  abut_tree_order(&s->tree, s->sites.data, s->n, s->items.data, s->room.data);
  s->tree.extent_built = compute_records(s, s->items.data);
  abut_tree_fit(&s->tree);
  z->n_buckets = s->tree.n_buckets;
  z->n_levels = s->tree.n_classes;
  z->capacity = s->tree.capacity;
  return ABUT_SUCCESS;
}

static bool
refit_nothing(abut_search *s)
{
  (void)s;
  return true;
}

static bool
refit_grid(abut_search *s)
{
  return abut_grid_refit(&s->grid, s->records.data);
}

static bool
refit_tree(abut_search *s)
{
  if (s->extent > 1.5 * s->tree.extent_built)
    return false;
  abut_tree_fit(&s->tree);
  return true;
}

static int32_t
tree_bucket_size(const abut_search *s)
{
  return s->tree.capacity;
}

static double
fit_tree_bucket(abut_search *s, int32_t bucket, const double *lower,
                const double *upper)
{
  return abut_tree_fit_bucket(&s->tree, bucket, lower, upper);
}

static void
gather_cells(const abut_search *s, const double *lower, const double *upper,
             abut_runs *runs)
{
  abut_grid_gather(&s->grid, lower, upper, runs);
}

static void
gather_buckets(const abut_search *s, const double *lower, const double *upper,
               abut_runs *runs)
{
  abut_tree_gather(&s->tree, lower, upper, runs);
}

/* In the order of abut_search_algorithm. */
const abut_search_method abut_search_methods[ABUT_SEARCH_N_ALGORITHMS] = {
    {"all pairs", build_all_pairs, refit_nothing, NULL, NULL, NULL},
    {"uniform buckets", build_grid, refit_grid, NULL, NULL, gather_cells},
    {"adaptive buckets", build_tree, refit_tree, tree_bucket_size,
     fit_tree_bucket, gather_buckets},
};

static abut_status
build(abut_search *s)
{
  s->revision = 0;
  s->n = s->surface->view.n_facets;
  abut_status status = reserve(s);
  if (status != ABUT_SUCCESS)
    return status;
  s->statistics.n_levels = 1;
  s->statistics.n_buckets = 1;
  status = s->method->build(s);
  if (status != ABUT_SUCCESS)
    return status;
  ++s->statistics.n_builds;
  ++s->serial;
  s->fitted = true;
  return ABUT_SUCCESS;
}

abut_status
abut_search_refresh(abut_search *s)
{
  if (s->revision == s->surface->revision && !s->reach_changed)
    return ABUT_SUCCESS;
  if (s->revision != 0)
  {
    s->extent = compute_records(s, NULL);
    s->fitted = false;
  }
  else
  {
    const abut_status status = build(s);
    if (status != ABUT_SUCCESS)
      return status;
  }
  s->revision = s->surface->revision;
  s->reach_changed = false;
  return ABUT_SUCCESS;
}

abut_status
abut_search_update(abut_search *search)
{
  if (search == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_search *s = search;
  abut_status status = abut_search_refresh(s);
  if (status != ABUT_SUCCESS || s->fitted)
    return status;
  if (s->method->refit(s))
  {
    ++s->statistics.n_refits;
    s->fitted = true;
    return ABUT_SUCCESS;
  }
  const uint64_t revision = s->revision;
  status = build(s);
  if (status == ABUT_SUCCESS)
    s->revision = revision;
  return status;
}

static int64_t
bytes_of(const abut_array *a)
{
  return a->capacity * (int64_t)a->element;
}

abut_status
abut_search_get_statistics_sized(const abut_search *search,
                                 abut_search_statistics *statistics)
{
  if (search == NULL || statistics == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_search *s = search;
  abut_search_statistics z = s->statistics;
  z.n_facets = s->n;
  z.structure_bytes =
      bytes_of(&s->items) + bytes_of(&s->room) + bytes_of(&s->runs)
      + bytes_of(&s->tree.groups) + bytes_of(&s->grid.cell_key)
      + bytes_of(&s->grid.cell_start) + bytes_of(&s->grid.table);
  z.record_bytes = bytes_of(&s->records) + bytes_of(&s->sites);
  z.query_bytes = bytes_of(&s->list.order) + bytes_of(&s->list.start)
                  + bytes_of(&s->list.slot) + bytes_of(&s->query_box)
                  + bytes_of(&s->block.step) + bytes_of(&s->block.exact)
                  + bytes_of(&s->block.value) + bytes_of(&s->block.keyed);
  return abut_copy_out(s->context, "abut_search_get_statistics", statistics,
                       sizeof(z), &z);
}
