/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_ORDER_H
#define ABUT_SEARCH_ORDER_H

/* Sorting along a space-filling curve. */

#include <stdint.h>

/* A key and what it belongs to. */
typedef struct abut_keyed
{
  uint64_t key;
  int32_t index;
  int32_t unused;
} abut_keyed;

/* A cube of cells: coordinates are measured from origin in units of 1/scale
 * and clamped to [0, 2^bits - 1]. */
typedef struct abut_lattice
{
  double origin[3];
  double scale;
  int32_t bits; /* per direction, 0 .. 19 */
} abut_lattice;

/* The lattice over a box whose cells are as close to edge as 19 bits per
 * direction allow, but not smaller. */
abut_lattice abut_lattice_make(const double *lower, const double *upper,
                               double edge);

static inline uint64_t
abut_lattice_coordinate(const abut_lattice *l, double x, int d)
{
  const double last = (double)((INT32_C(1) << l->bits) - 1);
  double c = (x - l->origin[d]) * l->scale;
  c = c > 0 ? c : 0;
  c = c < last ? c : last;
  return (uint64_t)(int32_t)c;
}

/* Spread the lowest 21 bits of v to every third bit. */
static inline uint64_t
abut_spread(uint64_t v)
{
  v &= UINT64_C(0x1fffff);
  v = (v | v << 32) & UINT64_C(0x001f00000000ffff);
  v = (v | v << 16) & UINT64_C(0x001f0000ff0000ff);
  v = (v | v << 8) & UINT64_C(0x100f00f00f00f00f);
  v = (v | v << 4) & UINT64_C(0x10c30c30c30c30c3);
  v = (v | v << 2) & UINT64_C(0x1249249249249249);
  return v;
}

/* Key of a point along Morton's curve, below 2^(3 * bits). */
static inline uint64_t
abut_lattice_key(const abut_lattice *l, const double *x)
{
  return abut_spread(abut_lattice_coordinate(l, x[0], 0))
         | abut_spread(abut_lattice_coordinate(l, x[1], 1)) << 1
         | abut_spread(abut_lattice_coordinate(l, x[2], 2)) << 2;
}

/* Sort items[n] by key, stably, with room[n] of scratch; the result is in
 * items. O(n) per eleven bits in which keys differ. */
void abut_order_sort(abut_keyed *items, abut_keyed *room, int32_t n);

/* Sort few pairs[n] by their upper 32 bits, with room[n] of scratch; the result
 * is in pairs. */
void abut_order_sort_pairs(uint64_t *pairs, uint64_t *room, int32_t n);

#endif
