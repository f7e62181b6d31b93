/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Radix sort from the lowest digit (Knuth, TAOCP 3, 5.2.5). Digits in which
 * all keys agree are left out, so that short keys cost little. */
#include "search/order.h"

#include <string.h>

enum
{
  DIGIT_BITS = 11,
  DIGITS = 1 << DIGIT_BITS,
  SMALL = 64
};

abut_lattice
abut_lattice_make(const double *lower, const double *upper, double edge)
{
  abut_lattice l = {{lower[0], lower[1], lower[2]}, 0, 0};
  double extent = 0;
  for (int d = 0; d < 3; ++d)
    if (upper[d] - lower[d] > extent)
      extent = upper[d] - lower[d];
  /* All in one place, or so close that the scale would overflow. */
  if (!(extent > 1e-100))
    return l;
  if (!(edge * 524288. > extent))
    edge = extent / 524288.;
  while (l.bits < 19 && edge * (double)(UINT64_C(1) << l.bits) < extent)
    ++l.bits;
  l.scale = 1 / edge;
  return l;
}

static void
insertion_sort(abut_keyed *items, int32_t n)
{
  for (int32_t i = 1; i < n; ++i)
  {
    const abut_keyed item = items[i];
    int32_t j = i;
    for (; j > 0 && items[j - 1].key > item.key; --j)
      items[j] = items[j - 1];
    items[j] = item;
  }
}

static void
sort_by_digit(const abut_keyed *restrict from, abut_keyed *restrict to,
              int32_t n, int shift)
{
  int32_t start[DIGITS] = {0};
  for (int32_t i = 0; i < n; ++i)
    ++start[(from[i].key >> shift) & (DIGITS - 1)];
  int32_t sum = 0;
  for (int32_t b = 0; b < DIGITS; ++b)
  {
    const int32_t count = start[b];
    start[b] = sum;
    sum += count;
  }
  for (int32_t i = 0; i < n; ++i)
    to[start[(from[i].key >> shift) & (DIGITS - 1)]++] = from[i];
}

void
abut_order_sort(abut_keyed *items, abut_keyed *room, int32_t n)
{
  if (n <= SMALL)
  {
    insertion_sort(items, n);
    return;
  }
  uint64_t differ = 0;
  for (int32_t i = 1; i < n; ++i)
    differ |= items[i].key ^ items[0].key;
  abut_keyed *from = items, *to = room;
  for (int shift = 0; shift < 64; shift += DIGIT_BITS)
  {
    if (((differ >> shift) & (DIGITS - 1)) == 0)
      continue;
    sort_by_digit(from, to, n, shift);
    abut_keyed *swap = from;
    from = to;
    to = swap;
  }
  if (from != items)
    memcpy(items, from, (size_t)n * sizeof(*items));
}

/* Digits of eight bits of the difference to the least key, because the tables
 * of larger ones take longer than few items. */
void
abut_order_sort_pairs(uint64_t *pairs, uint64_t *room, int32_t n)
{
  uint64_t least = UINT64_MAX, most = 0;
  for (int32_t i = 0; i < n; ++i)
  {
    const uint64_t key = pairs[i] >> 32;
    least = key < least ? key : least;
    most = key > most ? key : most;
  }
  uint64_t *from = pairs, *to = room;
  for (int shift = 0; shift < 32 && n > 1 && (most - least) >> shift != 0;
       shift += 8)
  {
    int32_t start[256] = {0}, sum = 0;
    for (int32_t i = 0; i < n; ++i)
      ++start[((from[i] >> 32) - least) >> shift & 255];
    for (int b = 0; b < 256; ++b)
    {
      const int32_t count = start[b];
      start[b] = sum;
      sum += count;
    }
    for (int32_t i = 0; i < n; ++i)
      to[start[((from[i] >> 32) - least) >> shift & 255]++] = from[i];
    uint64_t *swap = from;
    from = to;
    to = swap;
  }
  if (from != pairs)
    memcpy(pairs, from, (size_t)n * sizeof(*pairs));
}
