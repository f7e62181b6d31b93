/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Facets near a block of queries, as boxes that vector instructions test.
 *
 * Coordinates are sorted into 256 steps over the block by one function, which
 * is monotone: for v <= w also step(v) <= step(w). So boxes that touch touch in
 * steps too, whatever the rounding, and bytes are enough for a first test that
 * loses nothing. The few candidates more than the pairs that pass it are
 * decided by the exact test. Which boxes are touched cannot be predicted, hence
 * loops without branches. */
#include "search/search.h"

#include "base/clones.h"
#include "search/order.h"

#include <math.h>
#include <string.h>

enum
{
  PAD = 16,   /* boxes are tested by so many */
  CHUNK = 256 /* places within a chunk fit a byte */
};

void
abut_block_prepare(abut_block *b)
{
  memset(b, 0, sizeof(*b));
  b->step.element = sizeof(int8_t);
  b->exact.element = sizeof(abut_exact);
  b->value.element = sizeof(int32_t);
  b->keyed.element = sizeof(uint64_t);
  for (int bits = 0; bits < 256; ++bits)
    for (int k = 0; k < 8; ++k)
      if ((bits >> k & 1) != 0)
        b->place[bits][b->n_places[bits]++] = (uint8_t)k;
}

void
abut_block_release(abut_context *context, abut_block *b)
{
  abut_array_release(context, &b->step);
  abut_array_release(context, &b->exact);
  abut_array_release(context, &b->value);
  abut_array_release(context, &b->keyed);
}

static abut_status
reserve_block(abut_context *context, abut_block *b, int64_t n)
{
  if (n + PAD <= b->value.capacity)
    return ABUT_SUCCESS;
  const int64_t room = 2 * n + PAD;
  abut_status status = abut_array_reserve(context, &b->step, 0, 6 * room);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &b->exact, 0, room);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &b->keyed, 0, 2 * room);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &b->value, 0, room);
  return status;
}

/* Slots of the records of the runs that touch the box; returns their number. */
static int32_t
select_records(const abut_record *records, const abut_runs *runs,
               const double *lower, const double *upper, double skin,
               int32_t *restrict slot)
{
  int32_t n = 0;
  for (int32_t r = 0; r < runs->n; ++r)
    for (int32_t i = runs->run[r].first; i < runs->run[r].last; ++i)
    {
      slot[n] = i;
      n += abut_record_near_box(records + i, lower, upper, skin);
    }
  return n;
}

/* Put slots into ascending order of their facets. */
static void
sort_by_facet(const abut_record *records, abut_block *b)
{
  int32_t *slot = b->value.data;
  uint64_t *key = b->keyed.data;
  for (int32_t i = 0; i < b->n; ++i)
    key[i] =
        (uint64_t)records[slot[i]].facet << 32 | (uint64_t)(uint32_t)slot[i];
  abut_order_sort_pairs(key, key + b->n, b->n);
  for (int32_t i = 0; i < b->n; ++i)
    slot[i] = (int32_t)(key[i] & UINT32_MAX);
}

/* -128 .. 127, monotone in v. */
static inline int8_t
step_of(double v, double origin, double scale)
{
  double s = (v - origin) * scale - 128;
  s = s > -128 ? s : -128;
  s = s < 127 ? s : 127;
  return (int8_t)(int32_t)s;
}

/* Bounds and steps of the facets in value[n]; empty boxes up to a multiple of
 * PAD, so that loops have no tail. */
static void
load_facets(const abut_record *records, abut_block *b, double skin)
{
  const int64_t stride = b->value.capacity;
  const int32_t *slot = b->value.data;
  int8_t *restrict step = b->step.data;
  abut_exact *restrict exact = b->exact.data;
  for (int32_t i = 0; i < b->n; ++i)
  {
    const abut_record *r = records + slot[i];
    const double reach = r->reach + skin, limit = reach + r->radius;
    for (int d = 0; d < 3; ++d)
    {
      const double lower = r->lower[d] - reach, upper = r->upper[d] + reach;
      exact[i].bound[d] = lower;
      exact[i].bound[3 + d] = -upper;
      exact[i].centre[d] = r->centre[d];
      step[d * stride + i] = step_of(lower, b->origin[d], b->scale[d]);
      step[(3 + d) * stride + i] = step_of(upper, b->origin[d], b->scale[d]);
    }
    exact[i].limit = limit * limit;
  }
  b->n_padded = (b->n + PAD - 1) / PAD * PAD;
  /* A query as large as the block touches even the empty steps. */
  for (int32_t i = b->n; i < b->n_padded; ++i)
  {
    for (int d = 0; d < 3; ++d)
    {
      step[d * stride + i] = 127;
      step[(3 + d) * stride + i] = -128;
      exact[i].bound[d] = exact[i].bound[3 + d] = INFINITY;
      exact[i].centre[d] = 0;
    }
    exact[i].limit = -1;
  }
}

abut_status
abut_block_fill(abut_search *s, const abut_runs *runs, const double *lower,
                const double *upper, double skin, bool of_facets)
{
  abut_block *b = &s->block;
  const abut_record *records = s->records.data;
  int64_t n_facets = 0;
  for (int32_t r = 0; r < runs->n; ++r)
    n_facets += runs->run[r].last - runs->run[r].first;
  s->statistics.n_block_tests += n_facets;
  const abut_status status = reserve_block(s->context, b, n_facets);
  if (status != ABUT_SUCCESS)
    return status;
  for (int d = 0; d < 3; ++d)
  {
    const double extent = upper[d] - lower[d];
    b->origin[d] = lower[d];
    b->scale[d] = extent > 1e-290 ? 255 / extent : 0;
  }
  b->n = select_records(records, runs, lower, upper, skin, b->value.data);
  if (of_facets)
    sort_by_facet(records, b);
  load_facets(records, b, skin);
  if (of_facets)
    for (int32_t i = 0; i < b->n; ++i)
    {
      int32_t *value = (int32_t *)b->value.data + i;
      *value = records[*value].facet;
    }
  return ABUT_SUCCESS;
}

typedef int8_t lanes __attribute__((vector_size(PAD)));

static inline lanes
load(const int8_t *p)
{
  lanes v;
  memcpy(&v, p, sizeof(v));
  return v;
}

/* Bit k % 8 of hit[k] is set if box k touches the query's: q has the steps of
 * its upper and lower bounds. n is a multiple of PAD. */
static inline void
test_boxes(const int8_t *step, int64_t stride, int32_t n, const int8_t *q,
           uint8_t *hit)
{
  const lanes bit = {1, 2, 4, 8, 16, 32, 64, -128,
                     1, 2, 4, 8, 16, 32, 64, -128};
  const lanes zero = {0};
  const lanes b0 = zero + q[0], b1 = zero + q[1], b2 = zero + q[2];
  const lanes a0 = zero + q[3], a1 = zero + q[4], a2 = zero + q[5];
  for (int32_t i = 0; i < n; i += PAD)
  {
    const int8_t *l = step + i, *u = l + 3 * stride;
    const lanes out = (load(l) > b0) | (load(u) < a0) | (load(l + stride) > b1)
                      | (load(u + stride) < a1) | (load(l + 2 * stride) > b2)
                      | (load(u + 2 * stride) < a2);
    const lanes in = ~out & bit;
    memcpy(hit + i, &in, sizeof(in));
  }
}

/* Places, counted from `first`, of the boxes first .. first + n - 1 that touch
 * the query's; returns how many. n is a multiple of PAD and at most CHUNK. */
static int32_t
find_places(const abut_block *b, int32_t first, int32_t n, const int8_t *q,
            uint8_t *near)
{
  uint8_t hit[CHUNK];
  int32_t n_near = 0;
  test_boxes((const int8_t *)b->step.data + first, b->value.capacity, n, q,
             hit);
  for (int32_t k = 0; k < n; k += 8)
  {
    uint64_t eight, places;
    memcpy(&eight, hit + k, 8);
    const int bits = (int)(eight * UINT64_C(0x0101010101010101) >> 56);
    memcpy(&places, b->place[bits], 8);
    places += (uint64_t)k * UINT64_C(0x0101010101010101);
    memcpy(near + n_near, &places, 8);
    n_near += b->n_places[bits];
  }
  return n_near;
}

typedef double two __attribute__((vector_size(16)));

static inline two
load_two(const double *p)
{
  two v;
  memcpy(&v, p, sizeof(v));
  return v;
}

/* abut_record_near_point() two numbers at a time; sides: x, -x. */
static inline int
is_near(const abut_exact *e, const double *sides, double *square)
{
  const two c = load_two(sides) - load_two(e->centre);
  const double z = sides[2] - e->centre[2];
  const two cc = c * c;
  const double d2 = cc[0] + cc[1] + z * z;
  const __typeof__(c < cc) in =
      (load_two(sides) >= load_two(e->bound))
      & (load_two(sides + 2) >= load_two(e->bound + 2))
      & (load_two(sides + 4) >= load_two(e->bound + 4));
  *square = d2;
  return (int)(in[0] & in[1]) & (d2 <= e->limit);
}

/* Bits of a number that is not negative: in the order of the numbers. */
static inline uint64_t
bits_of(double v)
{
  uint64_t bits;
  memcpy(&bits, &v, sizeof(bits));
  return bits;
}

ABUT_INLINE int32_t
near_point(const abut_block *b, const double *x, bool track,
           int32_t *restrict values, int32_t *nearest)
{
  const int32_t *value = b->value.data;
  const double sides[6] = {x[0], x[1], x[2], -x[0], -x[1], -x[2]};
  uint8_t near[CHUNK + 8];
  int8_t q[6];
  uint64_t least = UINT64_MAX;
  int32_t n = 0, n_least = 0;
  for (int d = 0; d < 3; ++d)
    q[d] = q[3 + d] = step_of(x[d], b->origin[d], b->scale[d]);
  for (int32_t first = 0; first < b->n_padded; first += CHUNK)
  {
    const int32_t left = b->n_padded - first;
    const int32_t n_near =
        find_places(b, first, left < CHUNK ? left : CHUNK, q, near);
    const abut_exact *exact = (const abut_exact *)b->exact.data + first;
    for (int32_t i = 0; i < n_near; ++i)
    {
      double square;
      values[n] = value[first + near[i]];
      const int in = is_near(exact + near[i], sides, &square);
      if (track)
      {
        const uint64_t bits = bits_of(square) | ((uint64_t)in - 1);
        n_least = bits < least ? n : n_least;
        least = bits < least ? bits : least;
      }
      n += in;
    }
  }
  if (track)
    *nearest = n_least;
  return n;
}

int32_t
abut_block_near_point(const abut_block *b, const double *x,
                      int32_t *restrict values, int32_t *nearest)
{
  return nearest != NULL ? near_point(b, x, true, values, nearest)
                         : near_point(b, x, false, values, NULL);
}

int32_t
abut_block_near_box(const abut_block *b, const double *lower,
                    const double *upper, int32_t *restrict values)
{
  const int32_t *value = b->value.data;
  uint8_t near[CHUNK + 8];
  int8_t q[6];
  int32_t n = 0;
  for (int d = 0; d < 3; ++d)
  {
    q[d] = step_of(upper[d], b->origin[d], b->scale[d]);
    q[3 + d] = step_of(lower[d], b->origin[d], b->scale[d]);
  }
  for (int32_t first = 0; first < b->n_padded; first += CHUNK)
  {
    const int32_t left = b->n_padded - first;
    const int32_t n_near =
        find_places(b, first, left < CHUNK ? left : CHUNK, q, near);
    for (int32_t i = 0; i < n_near; ++i)
    {
      const int32_t at = first + near[i];
      const double *bound = ((const abut_exact *)b->exact.data)[at].bound;
      int in = 1;
      for (int d = 0; d < 3; ++d)
        in &= (upper[d] >= bound[d]) & (-lower[d] >= bound[3 + d]);
      values[n] = value[at];
      n += in;
    }
  }
  return n;
}
