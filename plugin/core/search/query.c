/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Answering queries through buckets.
 *
 * Queries are sorted along Morton's curve and taken in blocks of at most BLOCK
 * that fill a cell of the binary tree behind the curve. For a block the
 * buckets are visited once, and the facets near it gathered (block.c); each
 * query is tested against these. So the numbering of nodes and facets does not
 * matter, trees and tables are read once per block, and the answer is that of
 * the exact test. */
#include "search/search.h"

#include <math.h>

enum
{
  BLOCK = 64
};

/* Queries in their order, with their boxes (points: twice the same). */
typedef struct
{
  double lower[BLOCK][3];
  double upper[BLOCK][3];
  double block_lower[3];
  double block_upper[3];
  int32_t n;
} batch;

static inline void
query_box(const abut_query *q, int32_t i, double *lower, double *upper)
{
  if (q->points != NULL)
  {
    abut_query_point(q, i, lower);
    abut_query_point(q, i, upper);
    return;
  }
  const double *b = q->boxes + 6 * (int64_t)i;
  for (int d = 0; d < 3; ++d)
  {
    lower[d] = b[d];
    upper[d] = b[3 + d];
  }
}

/* Keys of the queries that touch the box of all facets; returns their number.
 */
static int32_t
key_queries(const abut_search *s, const abut_query *q, double skin,
            abut_keyed *items)
{
  const abut_lattice lattice =
      abut_lattice_make(s->lower, s->upper, s->smallest);
  double low[3], high[3];
  for (int d = 0; d < 3; ++d)
  {
    const double slack =
        skin + 1e-14 * (skin + fmax(fabs(s->lower[d]), fabs(s->upper[d])));
    low[d] = s->lower[d] - slack;
    high[d] = s->upper[d] + slack;
  }
  int32_t n = 0;
  for (int32_t i = 0; i < q->n; ++i)
  {
    double l[3], u[3], c[3];
    int in = 1;
    if (q->points != NULL)
    {
      abut_query_point(q, i, c);
      for (int d = 0; d < 3; ++d)
        in &= (c[d] >= low[d]) & (c[d] <= high[d]);
    }
    else
    {
      query_box(q, i, l, u);
      for (int d = 0; d < 3; ++d)
      {
        in &= (u[d] >= low[d]) & (l[d] <= high[d]);
        c[d] = 0.5 * (l[d] + u[d]);
      }
    }
    items[n].key = abut_lattice_key(&lattice, c);
    items[n].index = i;
    n += in;
  }
  return n;
}

/* End of the block that begins at i: queries in the largest cell of the
 * binary tree behind Morton's curve that holds no more than BLOCK of them from
 * here. */
static int32_t
block_end(const abut_keyed *items, int32_t i, int32_t n)
{
  if (n - i <= BLOCK)
    return n;
  uint64_t differ = items[i].key ^ items[i + BLOCK].key;
  if (differ == 0)
    return i + BLOCK;
  int bit = 0;
  while ((differ >>= 1) != 0)
    ++bit;
  int32_t end = i + 1;
  while (end < i + BLOCK && (items[end].key ^ items[i].key) >> bit == 0)
    ++end;
  return end;
}

static void
load_batch(const abut_query *q, const abut_keyed *items, int32_t n, batch *b)
{
  b->n = n;
  for (int d = 0; d < 3; ++d)
  {
    b->block_lower[d] = INFINITY;
    b->block_upper[d] = -INFINITY;
  }
  for (int32_t i = 0; i < n; ++i)
  {
    query_box(q, items[i].index, b->lower[i], b->upper[i]);
    for (int d = 0; d < 3; ++d)
    {
      const double l = b->lower[i][d], u = b->upper[i][d];
      b->block_lower[d] = l < b->block_lower[d] ? l : b->block_lower[d];
      b->block_upper[d] = u > b->block_upper[d] ? u : b->block_upper[d];
    }
  }
}

/* Ask for all records of short runs at once: they lie here and there in
 * memory. */
static void
prefetch_runs(const abut_record *records, const abut_runs *runs)
{
  for (int32_t r = 0; r < runs->n; ++r)
  {
    const int32_t first = runs->run[r].first, last = runs->run[r].last;
    for (int32_t i = first; i < last && i < first + 64; ++i)
    {
      __builtin_prefetch(records[i].lower);
      __builtin_prefetch(records[i].centre);
    }
  }
}

/* Load the block that begins at `first` and find the buckets near it. */
static void
begin_block(const abut_search *s, const abut_query *q, const abut_keyed *items,
            int32_t first, int32_t n, double skin, batch *b, abut_runs *runs)
{
  double lower[3], upper[3];
  runs->n = 0;
  load_batch(q, items + first, block_end(items, first, n) - first, b);
  /* The slack covers the rounding of inflated boxes. */
  for (int d = 0; d < 3; ++d)
  {
    const double magnitude = fmax(fabs(s->lower[d]), fabs(s->upper[d]));
    const double slack = skin + 1e-14 * (skin + magnitude);
    lower[d] = b->block_lower[d] - slack;
    upper[d] = b->block_upper[d] + slack;
  }
  s->method->gather(s, lower, upper, runs);
  prefetch_runs(s->records.data, runs);
}

/* Pairs of query i of the batch, to the end of the list. */
static void
answer_query(abut_search *s, const abut_query *q, const batch *b, int32_t i,
             abut_list *list)
{
  int64_t *start = (int64_t *)list->start.data + list->n++;
  int32_t *slot = (int32_t *)list->slot.data + start[0];
  if (q->points == NULL)
  {
    start[1] = start[0]
               + abut_block_near_box(&s->block, b->lower[i], b->upper[i], slot);
    return;
  }
  int32_t nearest;
  const int32_t n = abut_block_near_point(&s->block, b->lower[i], slot,
                                          list->of_facets ? NULL : &nearest);
  start[1] = start[0] + n;
  if (n == 0 || list->of_facets)
    return;
  const int32_t first = slot[0];
  slot[0] = slot[nearest];
  slot[nearest] = first;
  abut_prefetch_facet(s->surface,
                      ((abut_record *)s->records.data)[slot[0]].facet);
}

/* Ask for the queries of the next block. */
static void
prefetch_queries(const abut_query *q, const abut_keyed *items, int32_t first,
                 int32_t n)
{
  const int32_t last = n - first < BLOCK ? n : first + BLOCK;
  for (int32_t i = first; i < last; ++i)
    if (q->points != NULL)
      __builtin_prefetch(q->points + (int64_t)q->dimension * items[i].index);
    else
      __builtin_prefetch(q->boxes + 6 * (int64_t)items[i].index);
}

/* The facets near the block must have been gathered. */
static abut_status
answer_block(abut_search *s, const abut_query *q, const batch *b,
             abut_list *list)
{
  const int64_t used = ((const int64_t *)list->start.data)[list->n];
  const abut_status status = abut_array_reserve(
      s->context, &list->slot, used, used + (int64_t)b->n * (s->block.n + 1));
  if (status != ABUT_SUCCESS)
    return status;
  for (int32_t i = 0; i < b->n; ++i)
    answer_query(s, q, b, i, list);
  s->statistics.n_box_tests += (int64_t)b->n * s->block.n;
  return ABUT_SUCCESS;
}

/* Every query against every facet, in their order: nothing but the exact
 * test. */
static abut_status
answer_all_pairs(abut_search *s, const abut_query *q, double skin,
                 abut_list *list, abut_consume consume, void *user)
{
  const abut_record *records = s->records.data;
  int64_t *start = list->start.data;
  int32_t *order = list->order.data;
  abut_status status = ABUT_SUCCESS;
  for (int32_t i = 0; i < q->n && status == ABUT_SUCCESS; ++i)
  {
    double lower[3], upper[3], square;
    const int32_t k = list->n;
    status =
        abut_array_reserve(s->context, &list->slot, start[k], start[k] + s->n);
    if (status != ABUT_SUCCESS)
      return status;
    int32_t *slot = list->slot.data;
    int64_t n = start[k];
    query_box(q, i, lower, upper);
    for (int32_t f = 0; f < s->n; ++f)
    {
      slot[n] = f;
      n += q->points != NULL
               ? abut_record_near_point(records + f, lower, skin, &square)
               : abut_record_near_box(records + f, lower, upper, skin);
    }
    order[k] = i;
    start[k + 1] = n;
    list->n = k + 1;
    if (consume != NULL)
    {
      const abut_answers answers = {1, order, start, slot};
      status = consume(user, &answers);
      list->n = 0;
    }
  }
  s->statistics.n_box_tests += (int64_t)q->n * s->n;
  return status;
}

abut_status
abut_search_fit(abut_context *context, abut_array *array, int64_t n)
{
  if (n <= array->capacity)
    return ABUT_SUCCESS;
  abut_array_release(context, array);
  return abut_array_reserve(context, array, 0, n);
}

static abut_status
reserve_list(abut_search *s, int32_t n_queries, int32_t n_listed,
             abut_list *list)
{
  abut_status status =
      abut_search_fit(s->context, &list->order, (int64_t)n_listed + 1);
  if (status == ABUT_SUCCESS)
    status = abut_search_fit(s->context, &list->start, (int64_t)n_listed + 1);
  if (status == ABUT_SUCCESS)
    status = abut_search_fit(s->context, &s->items, n_queries);
  if (status == ABUT_SUCCESS)
    status = abut_search_fit(s->context, &s->room, n_queries);
  return status;
}

abut_status
abut_search_list(abut_search *s, const abut_query *q, double skin,
                 abut_list *list, abut_consume consume, void *user)
{
  const int32_t n_listed = consume == NULL || q->n < BLOCK ? q->n : BLOCK;
  abut_status status = reserve_list(s, q->n, n_listed, list);
  if (status != ABUT_SUCCESS)
    return status;
  list->n = 0;
  ((int64_t *)list->start.data)[0] = 0;
  if (s->n == 0)
    return ABUT_SUCCESS;
  if (s->method->gather == NULL)
    return answer_all_pairs(s, q, skin, list, consume, user);
  abut_keyed *items = s->items.data;
  const int32_t n = key_queries(s, q, skin, items);
  abut_order_sort(items, s->room.data, n);
  batch blocks[2];
  abut_runs runs = {s->runs.data, 0};
  if (n > 0)
    begin_block(s, q, items, 0, n, skin, blocks, &runs);
  for (int32_t i = 0, k = 0; i < n && status == ABUT_SUCCESS; k = 1 - k)
  {
    const batch *b = blocks + k;
    int32_t *order = (int32_t *)list->order.data + list->n;
    for (int32_t j = 0; j < b->n; ++j)
      order[j] = items[i + j].index;
    status = abut_block_fill(s, &runs, b->block_lower, b->block_upper, skin,
                             list->of_facets);
    if (status != ABUT_SUCCESS)
      break;
    i += b->n;
    /* The memory of the next block comes while this one is answered. */
    if (i < n)
    {
      begin_block(s, q, items, i, n, skin, blocks + 1 - k, &runs);
      prefetch_queries(q, items, i + blocks[1 - k].n, n);
    }
    status = answer_block(s, q, b, list);
    if (status == ABUT_SUCCESS && consume != NULL)
    {
      const abut_answers answers = {list->n, order, list->start.data,
                                    list->slot.data};
      status = consume(user, &answers);
      list->n = 0;
    }
  }
  return status;
}

abut_status
abut_list_consume(const abut_list *list, abut_consume consume, void *user)
{
  const int32_t *order = list->order.data;
  const int64_t *start = list->start.data;
  abut_status status = ABUT_SUCCESS;
  for (int32_t k = 0; k < list->n && status == ABUT_SUCCESS; k += BLOCK)
  {
    const abut_answers answers = {list->n - k < BLOCK ? list->n - k : BLOCK,
                                  order + k, start + k, list->slot.data};
    status = consume(user, &answers);
  }
  return status;
}

void
abut_list_prepare(abut_list *list)
{
  const abut_list empty = {0,
                           false,
                           {NULL, 0, sizeof(int32_t)},
                           {NULL, 0, sizeof(int64_t)},
                           {NULL, 0, sizeof(int32_t)}};
  *list = empty;
}

void
abut_list_release(abut_context *context, abut_list *list)
{
  abut_array_release(context, &list->order);
  abut_array_release(context, &list->start);
  abut_array_release(context, &list->slot);
  list->n = 0;
}
