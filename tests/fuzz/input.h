/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_FUZZ_INPUT_H
#define ABUT_FUZZ_INPUT_H

/* Numbers from the bytes of a fuzzer. Past the end all bytes are 0. */

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A property that must hold; the fuzzer reports the abort with its input. */
#define REQUIRE(condition)                                                     \
  do                                                                           \
    if (!(condition))                                                          \
    {                                                                          \
      fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);          \
      abort();                                                                 \
    }                                                                          \
  while (0)

typedef struct input
{
  const uint8_t *data;
  size_t size;
} input;

static inline uint8_t
take_byte(input *in)
{
  if (in->size == 0)
    return 0;
  --in->size;
  return *in->data++;
}

/* In [0, n) */
static inline int32_t
take_below(input *in, int32_t n)
{
  const int32_t high = take_byte(in);
  return n > 256 ? (high * 256 + take_byte(in)) % n : high % n;
}

/* Any bit pattern: NaN, infinities, denormals, huge numbers. */
static inline double
take_raw(input *in)
{
  uint8_t bytes[8];
  double x;
  for (int i = 0; i < 8; ++i)
    bytes[i] = take_byte(in);
  memcpy(&x, bytes, sizeof(x));
  return x;
}

/* A multiple of 1/16 in [-8, 8): small sets make ties and degenerate facets
 * likely. */
static inline double
take_grid(input *in)
{
  return ((double)take_byte(in) - 128.) / 16.;
}

/* 10^-30 .. 10^30, mostly 1 */
static inline double
take_scale(input *in)
{
  const int e = take_byte(in);
  return e < 128 ? 1. : pow(10., e % 61 - 30);
}

/* One of the styles of numbers: grid, grid with small disturbance, raw. */
static inline double
take_coordinate(input *in, int style, double scale, double offset)
{
  if (style == 2)
    return take_raw(in);
  double x = take_grid(in);
  if (style == 1)
    x += 1e-3 * take_grid(in);
  return offset + scale * x;
}

#endif
