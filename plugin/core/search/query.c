/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Answering queries through buckets.
 *
 * Queries are sorted along Morton's curve and taken in blocks that fill a
 * cell of an octree with at most BLOCK of them. For a block the buckets are
 * visited once; facets whose inflated box touches the block's box go into
 * short arrays of single-precision boxes, rounded outwards. Each query is
 * tested against these in one vectorisable loop, and what is hit is tested
 * exactly in double precision. So numbering does not matter, trees and tables
 * are read once per block, and the answer is that of the exact test. */
#include "search/search.h"

#include <float.h>
#include <math.h>

enum
{
  BLOCK = 40,
  PAD = 16
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

static void
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
    query_box(q, i, l, u);
    for (int d = 0; d < 3; ++d)
    {
      in &= (u[d] >= low[d]) & (l[d] <= high[d]);
      c[d] = 0.5 * (l[d] + u[d]);
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

/* Single precision at most / at least v; |v| far beyond what a block can
 * touch is cut off, which keeps the order. */
static inline float
round_down(double v)
{
  v = v < -1e38 ? -1e38 : v > 1e38 ? 1e38 : v;
  const float f = (float)v;
  return f - fabsf(f) * 2e-7f - FLT_MIN;
}

static inline float
round_up(double v)
{
  v = v < -1e38 ? -1e38 : v > 1e38 ? 1e38 : v;
  const float f = (float)v;
  return f + fabsf(f) * 2e-7f + FLT_MIN;
}

static abut_status
reserve_block(abut_context *context, abut_block *b, int32_t n)
{
  if (n <= b->slot.capacity)
    return ABUT_SUCCESS;
  const int64_t room = 2 * (int64_t)n;
  abut_status status = abut_array_reserve(context, &b->box, 0, 6 * room);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &b->hit, 0, room);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &b->near, 0, room);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &b->slot, 0, room);
  return status;
}

/* Empty boxes up to a multiple of PAD, so that the loop over them has no
 * tail. */
static void
pad_block(abut_block *b)
{
  float *box = b->box.data;
  b->n_padded = (b->n + PAD - 1) / PAD * PAD;
  for (int32_t i = b->n; i < b->n_padded; ++i)
    for (int d = 0; d < 3; ++d)
    {
      box[d * b->slot.capacity + i] = FLT_MAX;
      box[(3 + d) * b->slot.capacity + i] = -FLT_MAX;
    }
}

/* Facets of the runs whose inflated box touches the block. */
static abut_status
fill_block(abut_search *s, const abut_runs *runs, const batch *q, double skin)
{
  abut_block *b = &s->block;
  int64_t n_facets = 0;
  for (int32_t r = 0; r < runs->n; ++r)
    n_facets += runs->run[r].last - runs->run[r].first;
  s->statistics.n_block_tests += n_facets;
  const abut_status status =
      reserve_block(s->context, b, (int32_t)n_facets + PAD);
  if (status != ABUT_SUCCESS)
    return status;
  const int64_t stride = b->slot.capacity;
  const abut_record *records = s->records.data;
  float *box = b->box.data;
  int32_t *slot = b->slot.data;
  int32_t n = 0;
  for (int d = 0; d < 3; ++d)
    b->origin[d] = 0.5 * (q->block_lower[d] + q->block_upper[d]);
  /* Without branches: which ones touch cannot be predicted. */
  for (int32_t r = 0; r < runs->n; ++r)
    for (int32_t i = runs->run[r].first; i < runs->run[r].last; ++i)
    {
      slot[n] = i;
      n += abut_record_near_box(records + i, q->block_lower, q->block_upper,
                                skin);
    }
  for (int32_t i = 0; i < n; ++i)
  {
    const abut_record *f = records + slot[i];
    const double reach = f->reach + skin;
    for (int d = 0; d < 3; ++d)
    {
      box[d * stride + i] = round_down(f->lower[d] - reach - b->origin[d]);
      box[(3 + d) * stride + i] = round_up(f->upper[d] + reach - b->origin[d]);
    }
  }
  b->n = n;
  pad_block(b);
  return ABUT_SUCCESS;
}

/* hit[i] = whether box i of the block touches the query; n is a multiple of
 * PAD. */
static void
test_boxes(const float *restrict box, int64_t stride, int32_t n,
           const float *restrict q, int32_t *restrict hit)
{
  const float *restrict l0 = box, *restrict l1 = box + stride;
  const float *restrict l2 = box + 2 * stride;
  const float *restrict u0 = box + 3 * stride, *restrict u1 = box + 4 * stride;
  const float *restrict u2 = box + 5 * stride;
  const float a0 = q[0], a1 = q[1], a2 = q[2], b0 = q[3], b1 = q[4], b2 = q[5];
  for (int32_t i = 0; i < n; i += PAD)
    for (int32_t j = i; j < i + PAD; ++j)
      hit[j] = (l0[j] <= b0) & (u0[j] >= a0) & (l1[j] <= b1) & (u1[j] >= a1)
               & (l2[j] <= b2) & (u2[j] >= a2);
}

/* Places of the facets in the block that a query touches in single precision;
 * returns their number. */
static int32_t
touch(const abut_block *b, const double *lower, const double *upper)
{
  const int32_t *restrict hit = b->hit.data;
  int32_t *restrict near = b->near.data;
  float bounds[6];
  int32_t n = 0;
  for (int d = 0; d < 3; ++d)
  {
    bounds[d] = round_down(lower[d] - b->origin[d]);
    bounds[3 + d] = round_up(upper[d] - b->origin[d]);
  }
  test_boxes(b->box.data, b->slot.capacity, b->n_padded, bounds, b->hit.data);
  for (int32_t i = 0; i < b->n; ++i)
  {
    near[n] = i;
    n += hit[i];
  }
  return n;
}

/* Pairs of one query into slots; returns their number. */
static int32_t
answer_point(const abut_search *s, const double *x, double skin,
             int32_t *restrict slots)
{
  const abut_block *b = &s->block;
  const abut_record *records = s->records.data;
  const int32_t *slot = b->slot.data, *near = b->near.data;
  const int32_t n_near = touch(b, x, x);
  int32_t n = 0, nearest = 0;
  double least = INFINITY;
  for (int32_t i = 0; i < n_near; ++i)
  {
    const int32_t at = slot[near[i]];
    double square;
    const int in = abut_record_near_point(records + at, x, skin, &square);
    const int better = in & (square < least);
    slots[n] = at;
    least = better ? square : least;
    nearest = better ? n : nearest;
    n += in;
  }
  if (n > 0)
  {
    const int32_t swap = slots[0];
    slots[0] = slots[nearest];
    slots[nearest] = swap;
    abut_prefetch_facet(s->surface, records[slots[0]].facet);
  }
  return n;
}

static int32_t
answer_box(const abut_search *s, const double *lower, const double *upper,
           double skin, int32_t *restrict slots)
{
  const abut_block *b = &s->block;
  const abut_record *records = s->records.data;
  const int32_t *slot = b->slot.data, *near = b->near.data;
  const int32_t n_near = touch(b, lower, upper);
  int32_t n = 0;
  for (int32_t i = 0; i < n_near; ++i)
  {
    slots[n] = slot[near[i]];
    n += abut_record_near_box(records + slots[n], lower, upper, skin);
  }
  return n;
}

static abut_status
answer_block(abut_search *s, const abut_query *q, const batch *b, double skin,
             abut_list *list)
{
  double lower[3], upper[3];
  abut_runs runs = {s->runs.data, 0};
  /* The slack covers the rounding of inflated boxes. */
  for (int d = 0; d < 3; ++d)
  {
    const double magnitude = fmax(fabs(s->lower[d]), fabs(s->upper[d]));
    const double slack = skin + 1e-14 * (skin + magnitude);
    lower[d] = b->block_lower[d] - slack;
    upper[d] = b->block_upper[d] + slack;
  }
  if (s->options.algorithm == ABUT_SEARCH_UNIFORM_BUCKETS)
    abut_grid_gather(&s->grid, lower, upper, &runs);
  else
    abut_tree_gather(&s->tree, lower, upper, &runs);
  abut_status status = fill_block(s, &runs, b, skin);
  if (status != ABUT_SUCCESS)
    return status;
  int64_t *start = list->start.data;
  status =
      abut_array_reserve(s->context, &list->slot, start[list->n],
                         start[list->n] + (int64_t)b->n * (s->block.n + 1));
  if (status != ABUT_SUCCESS)
    return status;
  int32_t *slot = list->slot.data;
  s->statistics.n_box_tests += (int64_t)b->n * s->block.n;
  for (int32_t i = 0; i < b->n; ++i, ++list->n)
  {
    int32_t *to = slot + start[list->n];
    start[list->n + 1] =
        start[list->n]
        + (q->points != NULL
               ? answer_point(s, b->lower[i], skin, to)
               : answer_box(s, b->lower[i], b->upper[i], skin, to));
  }
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
  if (s->options.algorithm == ABUT_SEARCH_ALL_PAIRS)
    return answer_all_pairs(s, q, skin, list, consume, user);
  abut_keyed *items = s->items.data;
  const int32_t n = key_queries(s, q, skin, items);
  abut_order_sort(items, s->room.data, n);
  for (int32_t i = 0; i < n && status == ABUT_SUCCESS;)
  {
    batch b;
    const int32_t end = block_end(items, i, n);
    int32_t *order = (int32_t *)list->order.data + list->n;
    for (int32_t k = i; k < end; ++k)
      order[k - i] = items[k].index;
    load_batch(q, items + i, end - i, &b);
    status = answer_block(s, q, &b, skin, list);
    if (status == ABUT_SUCCESS && consume != NULL)
    {
      const abut_answers answers = {list->n, order, list->start.data,
                                    list->slot.data};
      status = consume(user, &answers);
      list->n = 0;
    }
    i = end;
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
