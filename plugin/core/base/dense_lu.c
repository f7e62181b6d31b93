/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/dense_lu.h"

#include <math.h>

static const double smallest_pivot = 1e-13;

static void
swap(double *x, double *y)
{
  const double kept = *x;
  *x = *y;
  *y = kept;
}

/* Scale all rows to the size 1, so that pivots of different units compare. */
static bool
scale_rows(int32_t n, double *a, double *scale)
{
  for (int32_t i = 0; i < n; ++i)
  {
    double size = 0;
    for (int32_t j = 0; j < n; ++j)
    {
      const double value = fabs(a[(int64_t)i * n + j]);
      size = value > size ? value : size;
    }
    if (!(size > 0))
      return false;
    scale[i] = 1 / size;
    for (int32_t j = 0; j < n; ++j)
      a[(int64_t)i * n + j] *= scale[i];
  }
  return true;
}

/* Exchange row k with the row below that has the largest entry in column k. */
static double
pivot_row(int32_t n, double *a, int32_t k, int32_t *pivot)
{
  int32_t best = k;
  for (int32_t i = k + 1; i < n; ++i)
    if (fabs(a[(int64_t)i * n + k]) > fabs(a[(int64_t)best * n + k]))
      best = i;
  pivot[k] = best;
  if (best != k)
    for (int32_t j = 0; j < n; ++j)
      swap(&a[(int64_t)k * n + j], &a[(int64_t)best * n + j]);
  return a[(int64_t)k * n + k];
}

bool
abut_dense_lu_factorise(int32_t n, double *a, int32_t *pivot, double *scale)
{
  if (!scale_rows(n, a, scale))
    return false;
  for (int32_t k = 0; k < n; ++k)
  {
    const double diagonal = pivot_row(n, a, k, pivot);
    if (!(fabs(diagonal) > smallest_pivot))
      return false;
    const double *upper = a + (int64_t)k * n;
    for (int32_t i = k + 1; i < n; ++i)
    {
      double *row = a + (int64_t)i * n;
      const double factor = row[k] / diagonal;
      row[k] = factor;
      if (factor != 0)
        for (int32_t j = k + 1; j < n; ++j)
          row[j] -= factor * upper[j];
    }
  }
  return true;
}

void
abut_dense_lu_solve(int32_t n, const double *a, const int32_t *pivot,
                    const double *scale, double *x)
{
  for (int32_t i = 0; i < n; ++i)
    x[i] *= scale[i];
  for (int32_t k = 0; k < n; ++k)
    if (pivot[k] != k)
      swap(&x[k], &x[pivot[k]]);
  for (int32_t i = 0; i < n; ++i)
    for (int32_t j = 0; j < i; ++j)
      x[i] -= a[(int64_t)i * n + j] * x[j];
  for (int32_t i = n - 1; i >= 0; --i)
  {
    for (int32_t j = i + 1; j < n; ++j)
      x[i] -= a[(int64_t)i * n + j] * x[j];
    x[i] /= a[(int64_t)i * n + i];
  }
}
