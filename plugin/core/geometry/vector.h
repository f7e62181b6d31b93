/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_VECTOR_H
#define ABUT_GEOMETRY_VECTOR_H

/* Vectors of three numbers. */

#include <math.h>
#include <stdint.h>

/* A squared vector below this has lost accuracy to underflow: it counts as
 * zero. Between lengths of 1e-40 and 1e40 no square of a length, and no square
 * of an area above round-off, gets there. */
#define ABUT_TINY 1e-280

static inline double
dot3(const double *a, const double *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void
cross3(const double *a, const double *b, double *c)
{
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void
sub3(const double *a, const double *b, double *c)
{
  c[0] = a[0] - b[0];
  c[1] = a[1] - b[1];
  c[2] = a[2] - b[2];
}

/* c = a + s b */
static inline void
axpy3(const double *a, double s, const double *b, double *c)
{
  c[0] = a[0] + s * b[0];
  c[1] = a[1] + s * b[1];
  c[2] = a[2] + s * b[2];
}

/* Vector i of values [.. * dimension]; x[2] = 0 in the plane. */
static inline void
load3(const double *values, int32_t dimension, int32_t i, double *x)
{
  x[2] = 0.;
  for (int32_t d = 0; d < dimension; ++d)
    x[d] = values[(int64_t)dimension * i + d];
}

/* Outward normal of a facet by its first corners, of any length: two in the
 * plane, three in space. */
static inline void
corner_normal3(int32_t dimension, double (*corner)[3], double *n)
{
  double a[3], b[3];
  sub3(corner[1], corner[0], a);
  if (dimension == 2)
  {
    n[0] = a[1];
    n[1] = -a[0];
    n[2] = 0.;
    return;
  }
  sub3(corner[2], corner[0], b);
  cross3(a, b, n);
}

static inline double
norm3(const double *a)
{
  return sqrt(dot3(a, a));
}

/* Scale to unit length; a vector whose square is not above tiny becomes zero.
 * Returns the length. */
static inline double
unit3(double *a, double tiny)
{
  const double s = dot3(a, a), length = sqrt(s),
               f = s > tiny ? 1. / length : 0.;
  a[0] *= f;
  a[1] *= f;
  a[2] *= f;
  return length;
}

static inline double
clamp(double x, double lower, double upper)
{
  return x < lower ? lower : x > upper ? upper : x;
}

static inline double
max2(double a, double b)
{
  return a > b ? a : b;
}

static inline double
min2(double a, double b)
{
  return a < b ? a : b;
}

#endif
