/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Lists of pairs as the caller sees them: by query, facets ascending. */
#include "search/reuse.h"

#include <math.h>
#include <string.h>

struct abut_pairs
{
  abut_context *context;
  abut_pairs_view view;
  abut_array start; /* int64_t */
  abut_array facet; /* int32_t */
  abut_skin_list skin;
};

abut_status
abut_pairs_create(abut_context *context, abut_pairs **pairs)
{
  if (context == NULL || pairs == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_pairs_create",
                     "context or result is NULL");
  abut_pairs *p = abut_object_create(context, sizeof(*p));
  if (p == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, "abut_pairs_create",
                     "no memory");
  p->context = context;
  p->start.element = sizeof(int64_t);
  p->facet.element = sizeof(int32_t);
  abut_skin_list_prepare(&p->skin);
  const abut_status status = abut_array_reserve(context, &p->start, 0, 1);
  if (status != ABUT_SUCCESS)
  {
    abut_object_destroy(context, p, sizeof(*p));
    return status;
  }
  ((int64_t *)p->start.data)[0] = 0;
  p->view.start = p->start.data;
  *pairs = p;
  return ABUT_SUCCESS;
}

abut_status
abut_pairs_destroy(abut_pairs **pairs)
{
  if (pairs == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_pairs *p = *pairs;
  if (p == NULL)
    return ABUT_SUCCESS;
  abut_array_release(p->context, &p->start);
  abut_array_release(p->context, &p->facet);
  abut_skin_list_release(p->context, &p->skin);
  abut_object_destroy(p->context, p, sizeof(*p));
  *pairs = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_pairs_get_sized(const abut_pairs *pairs, abut_pairs_view *view)
{
  if (pairs == NULL || view == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_copy_out(pairs->context, "abut_pairs_get", view,
                       sizeof(pairs->view), &pairs->view);
}

static void
sift_down(int32_t *v, int64_t i, int64_t n)
{
  const int32_t item = v[i];
  for (int64_t child; (child = 2 * i + 1) < n; i = child)
  {
    if (child + 1 < n && v[child + 1] > v[child])
      ++child;
    if (v[child] <= item)
      break;
    v[i] = v[child];
  }
  v[i] = item;
}

/* Insertion for the usual handful, a heap for the rest. */
static void
sort_facets(int32_t *v, int64_t n)
{
  if (n <= 32)
  {
    for (int64_t i = 1; i < n; ++i)
    {
      const int32_t item = v[i];
      int64_t j = i;
      for (; j > 0 && v[j - 1] > item; --j)
        v[j] = v[j - 1];
      v[j] = item;
    }
    return;
  }
  for (int64_t i = n / 2; i-- > 0;)
    sift_down(v, i, n);
  for (int64_t last = n - 1; last > 0; --last)
  {
    const int32_t swap = v[0];
    v[0] = v[last];
    v[last] = swap;
    sift_down(v, 0, last);
  }
}

/* Places of the pairs of each query: start[i + 1] first has its number. */
static abut_status
place_queries(abut_pairs *p, abut_context *context, const abut_list *l,
              int32_t n)
{
  const int32_t *order = l->order.data;
  const int64_t *from = l->start.data;
  abut_status status =
      abut_array_reserve(context, &p->start, 0, (int64_t)n + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &p->facet, 0, from[l->n] + 1);
  if (status != ABUT_SUCCESS)
    return status;
  int64_t *start = p->start.data;
  memset(start, 0, ((size_t)n + 1) * sizeof(*start));
  for (int32_t k = 0; k < l->n; ++k)
    start[order[k] + 1] = from[k + 1] - from[k];
  for (int32_t i = 0; i < n; ++i)
    start[i + 1] += start[i];
  p->view.n_queries = n;
  p->view.start = start;
  p->view.facet = p->facet.data;
  return ABUT_SUCCESS;
}

/* The list by query instead of by order of search. */
static abut_status
arrange(abut_pairs *p, const abut_search *s, const abut_list *l, int32_t n)
{
  const abut_status status = place_queries(p, s->context, l, n);
  if (status != ABUT_SUCCESS)
    return status;
  const int32_t *order = l->order.data, *slot = l->slot.data;
  const int64_t *from = l->start.data, *start = p->start.data;
  const abut_record *records = s->records.data;
  int32_t *facet = p->facet.data;
  for (int32_t k = 0; k < l->n; ++k)
  {
    int32_t *restrict to = facet + start[order[k]];
    const int32_t *restrict of = slot + from[k];
    const int64_t count = from[k + 1] - from[k];
    if (l->of_facets)
      for (int64_t e = 0; e < count; ++e)
        to[e] = of[e];
    else
    {
      for (int64_t e = 0; e < count; ++e)
        to[e] = records[of[e]].facet;
      sort_facets(to, count);
    }
  }
  return ABUT_SUCCESS;
}

/* Pairs of a list with skin that are pairs without it, into the search's own
 * list. */
static abut_status
filter(abut_search *s, const abut_list *l, const abut_query *q)
{
  abut_list *out = &s->list;
  const int64_t *from = l->start.data;
  const int32_t *slot = l->slot.data, *order = l->order.data;
  abut_status status =
      abut_array_reserve(s->context, &out->order, 0, (int64_t)l->n + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &out->start, 0, (int64_t)l->n + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &out->slot, 0, from[l->n] + 1);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_record *records = s->records.data;
  int64_t *start = out->start.data, n = 0;
  int32_t *to = out->slot.data;
  for (int32_t k = 0; k < l->n; ++k)
  {
    ((int32_t *)out->order.data)[k] = order[k];
    start[k] = n;
    double x[3], square;
    if (q->points != NULL)
      abut_query_point(q, order[k], x);
    for (int64_t e = from[k]; e < from[k + 1]; ++e)
    {
      const abut_record *r = records + slot[e];
      to[n] = slot[e];
      if (q->points != NULL)
        n += abut_record_near_point(r, x, 0, &square);
      else
      {
        const double *box = q->boxes + 6 * (int64_t)order[k];
        n += abut_record_near_box(r, box, box + 3, 0);
      }
    }
  }
  start[l->n] = n;
  out->n = l->n;
  out->of_facets = false;
  return ABUT_SUCCESS;
}

static abut_status
search_surface(abut_search *s, const abut_surface *secondary, bool facets,
               abut_pairs *p)
{
  abut_query query;
  abut_status status = abut_search_refresh(s);
  if (status != ABUT_SUCCESS)
    return status;
  const bool reuse = abut_skin_list_serves(&p->skin, s, secondary, facets);
  if (!reuse)
    status = abut_search_update(s);
  if (status != ABUT_SUCCESS)
    return status;
  *(reuse ? &s->statistics.n_reuses : &s->statistics.n_searches) += 1;
  if (!reuse && s->skin > 0)
    status = abut_skin_list_make(&p->skin, s, secondary, facets);
  if (status == ABUT_SUCCESS)
    status = abut_search_query_of(s, secondary, facets, &query);
  s->list.of_facets = true;
  if (status == ABUT_SUCCESS)
    status = s->skin > 0 ? filter(s, &p->skin.list, &query)
                         : abut_search_list(s, &query, 0, &s->list, NULL, NULL);
  if (status == ABUT_SUCCESS)
    status = arrange(p, s, &s->list, query.n);
  if (status == ABUT_SUCCESS)
    s->statistics.n_pairs = p->view.start[query.n];
  return status;
}

static abut_status
check(const abut_search *s, const abut_surface *secondary,
      const abut_pairs *pairs, const char *call)
{
  if (s == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (secondary == NULL || pairs == NULL)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call,
                     "surface or pairs is NULL");
  if (secondary->view.dimension != s->surface->view.dimension)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call,
                     "the surfaces have different dimensions");
  return ABUT_SUCCESS;
}

abut_status
abut_search_nodes(abut_search *search, const abut_surface *secondary,
                  abut_pairs *pairs)
{
  const abut_status status =
      check(search, secondary, pairs, "abut_search_nodes");
  return status == ABUT_SUCCESS
             ? search_surface(search, secondary, false, pairs)
             : status;
}

abut_status
abut_search_facets(abut_search *search, const abut_surface *secondary,
                   abut_pairs *pairs)
{
  const abut_status status =
      check(search, secondary, pairs, "abut_search_facets");
  return status == ABUT_SUCCESS ? search_surface(search, secondary, true, pairs)
                                : status;
}

abut_status
abut_search_points(abut_search *search, int32_t n, const double *points,
                   abut_pairs *pairs)
{
  if (search == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_search *s = search;
  if (n < 0 || (n > 0 && points == NULL) || pairs == NULL)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "abut_search_points",
                     "n is negative, or points or pairs is NULL");
  const int32_t dimension = s->surface->view.dimension;
  for (int64_t i = 0; i < (int64_t)n * dimension; ++i)
    if (!(fabs(points[i]) <= ABUT_FACET_LIMIT))
    {
      abut_text text = abut_fail_begin(s->context, "abut_search_points");
      abut_text_add(&text, "point ");
      abut_text_add_integer(&text, i / dimension);
      abut_text_add(&text, " has coordinate ");
      abut_text_add_number(&text, points[i]);
      return ABUT_NOT_FINITE;
    }
  const abut_query query = {n, dimension, points, NULL};
  s->list.of_facets = true;
  abut_status status = abut_search_update(s);
  if (status == ABUT_SUCCESS)
    status = abut_search_list(s, &query, 0, &s->list, NULL, NULL);
  if (status == ABUT_SUCCESS)
    status = arrange(pairs, s, &s->list, n);
  if (status != ABUT_SUCCESS)
    return status;
  pairs->skin.search = NULL;
  ++s->statistics.n_searches;
  s->statistics.n_pairs = pairs->view.start[n];
  return ABUT_SUCCESS;
}
