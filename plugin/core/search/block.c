/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Facets near a block of queries, as boxes that vector instructions test.
 *
 * Boxes are in single precision relative to the middle of the block and
 * rounded outwards, so that nothing is lost; whether a facet really is a
 * partner is decided elsewhere in double precision. Which boxes are touched
 * cannot be predicted, hence loops without branches. */
#include "search/search.h"

#include <float.h>
#include <math.h>

enum
{
  PAD = 16 /* boxes are tested by so many */
};

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
reserve_block(abut_context *context, abut_block *b, int64_t n)
{
  if (n + PAD <= b->slot.capacity)
    return ABUT_SUCCESS;
  const int64_t room = 2 * n + PAD;
  abut_status status = abut_array_reserve(context, &b->box, 0, 6 * room);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &b->slot, 0, room);
  return status;
}

/* Empty boxes up to a multiple of PAD, so that loops have no tail. */
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

abut_status
abut_block_fill(abut_search *s, const abut_runs *runs, const double *lower,
                const double *upper, double skin)
{
  abut_block *b = &s->block;
  int64_t n_facets = 0;
  for (int32_t r = 0; r < runs->n; ++r)
    n_facets += runs->run[r].last - runs->run[r].first;
  s->statistics.n_block_tests += n_facets;
  abut_status status = reserve_block(s->context, b, n_facets);
  if (status == ABUT_SUCCESS)
    status = reserve_block(s->context, &s->part, n_facets);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->hit, 0, n_facets + PAD);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->near, 0,
                                ABUT_PART * (n_facets + PAD));
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->owner, 0,
                                ABUT_PART * (n_facets + PAD));
  if (status != ABUT_SUCCESS)
    return status;
  const int64_t stride = b->slot.capacity;
  const abut_record *records = s->records.data;
  float *box = b->box.data;
  int32_t *slot = b->slot.data;
  int32_t n = 0;
  for (int d = 0; d < 3; ++d)
    s->block_origin[d] = 0.5 * (lower[d] + upper[d]);
  prefetch_runs(records, runs);
  for (int32_t r = 0; r < runs->n; ++r)
    for (int32_t i = runs->run[r].first; i < runs->run[r].last; ++i)
    {
      slot[n] = i;
      n += abut_record_near_box(records + i, lower, upper, skin);
    }
  for (int32_t i = 0; i < n; ++i)
  {
    const abut_record *f = records + slot[i];
    const double reach = f->reach + skin;
    for (int d = 0; d < 3; ++d)
    {
      const double o = s->block_origin[d];
      box[d * stride + i] = round_down(f->lower[d] - reach - o);
      box[(3 + d) * stride + i] = round_up(f->upper[d] + reach - o);
    }
  }
  b->n = n;
  pad_block(b);
  return ABUT_SUCCESS;
}

/* hit[i] = whether box i touches the query's; n is a multiple of PAD. */
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

/* Append the places of the boxes of b that a box touches to near, beginning
 * at near[n], and the query's number to owner; returns the new n. */
static int32_t
touch(abut_search *s, const abut_block *b, const double *lower,
      const double *upper, uint8_t query, int32_t n)
{
  const int32_t *restrict hit = s->hit.data;
  int32_t *restrict near = s->near.data;
  uint8_t *restrict owner = s->owner.data;
  float bounds[6];
  for (int d = 0; d < 3; ++d)
  {
    bounds[d] = round_down(lower[d] - s->block_origin[d]);
    bounds[3 + d] = round_up(upper[d] - s->block_origin[d]);
  }
  test_boxes(b->box.data, b->slot.capacity, b->n_padded, bounds, s->hit.data);
  for (int32_t i = 0; i < b->n; ++i)
  {
    near[n] = i;
    owner[n] = query;
    n += hit[i];
  }
  return n;
}

void
abut_block_narrow(abut_search *s, const double *lower, const double *upper)
{
  const abut_block *b = &s->block;
  abut_block *p = &s->part;
  p->n = touch(s, b, lower, upper, 0, 0);
  const int32_t *near = s->near.data;
  const int32_t *slot = b->slot.data;
  int32_t *to_slot = p->slot.data;
  for (int32_t i = 0; i < p->n; ++i)
    to_slot[i] = slot[near[i]];
  for (int k = 0; k < 6; ++k)
  {
    const float *restrict from =
        (const float *)b->box.data + k * b->slot.capacity;
    float *restrict to = (float *)p->box.data + k * p->slot.capacity;
    for (int32_t i = 0; i < p->n; ++i)
      to[i] = from[near[i]];
  }
  pad_block(p);
}

/* The exact tests of all queries of a part in one loop, because how many there
 * are for a single query cannot be predicted either. */
static int32_t
test_points(const abut_search *s, int32_t n_near, const double (*x)[3],
            double skin, int32_t *count, int32_t *restrict slots)
{
  const abut_record *records = s->records.data;
  const int32_t *slot = s->part.slot.data, *near = s->near.data;
  const uint8_t *owner = s->owner.data;
  double least[ABUT_PART];
  int32_t nearest[ABUT_PART], n = 0;
  for (int q = 0; q < ABUT_PART; ++q)
    least[q] = INFINITY;
  for (int32_t i = 0; i < n_near; ++i)
  {
    const int q = owner[i];
    const int32_t at = slot[near[i]];
    double square;
    const int in = abut_record_near_point(records + at, x[q], skin, &square);
    const int better = in & (square < least[q]);
    slots[n] = at;
    least[q] = better ? square : least[q];
    nearest[q] = better ? n : nearest[q];
    count[q] += in;
    n += in;
  }
  int32_t first = 0;
  for (int q = 0; q < ABUT_PART; first += count[q++])
    if (count[q] > 0)
    {
      const int32_t swap = slots[first];
      slots[first] = slots[nearest[q]];
      slots[nearest[q]] = swap;
      abut_prefetch_facet(s->surface, records[slots[first]].facet);
    }
  return n;
}

static int32_t
test_other_boxes(const abut_search *s, int32_t n_near, const double (*lower)[3],
                 const double (*upper)[3], double skin, int32_t *count,
                 int32_t *restrict slots)
{
  const abut_record *records = s->records.data;
  const int32_t *slot = s->part.slot.data, *near = s->near.data;
  const uint8_t *owner = s->owner.data;
  int32_t n = 0;
  for (int32_t i = 0; i < n_near; ++i)
  {
    const int q = owner[i];
    slots[n] = slot[near[i]];
    const int in =
        abut_record_near_box(records + slots[n], lower[q], upper[q], skin);
    count[q] += in;
    n += in;
  }
  return n;
}

int32_t
abut_block_answer(abut_search *s, int32_t n_queries, const double (*lower)[3],
                  const double (*upper)[3], bool points, double skin,
                  int32_t *count, int32_t *slots)
{
  int32_t n_near = 0;
  for (int q = 0; q < ABUT_PART; ++q)
    count[q] = 0;
  for (int32_t q = 0; q < n_queries; ++q)
    n_near = touch(s, &s->part, lower[q], upper[q], (uint8_t)q, n_near);
  s->statistics.n_box_tests += (int64_t)n_queries * s->part.n;
  return points ? test_points(s, n_near, lower, skin, count, slots)
                : test_other_boxes(s, n_near, lower, upper, skin, count, slots);
}
