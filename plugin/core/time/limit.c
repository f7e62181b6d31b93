/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The longest step of explicit schemes, by power iteration on M^-1 K. */
#include <abut/time.h>

#include <math.h>

static const double accuracy = 1e-7;
static const int32_t most_products = 2000;

/* A number in [-1, 1] that has nothing to do with those of its neighbours. */
static double
scattered(uint64_t number)
{
  uint64_t z = number + UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  z ^= z >> 31;
  return (double)(z >> 11) / (double)(UINT64_C(1) << 52) - 1;
}

abut_status
abut_time_limit_begin(abut_time_limit *limit, int64_t first, int64_t n,
                      double *x)
{
  if (limit == NULL || first < 0 || n < 0 || (n > 0 && x == NULL))
    return ABUT_INVALID_ARGUMENT;
  *limit = (abut_time_limit){
      .struct_size = sizeof(*limit), .goes_on = 1, .step = INFINITY};
  for (int64_t i = 0; i < n; ++i)
    x[i] = scattered((uint64_t)(first + i));
  return ABUT_SUCCESS;
}

abut_status
abut_time_limit_sums(int64_t n, const double *mass, const double *x,
                     const double *stiffness_times_x, double sums[2])
{
  if (sums == NULL || n < 0
      || (n > 0 && (mass == NULL || x == NULL || stiffness_times_x == NULL)))
    return ABUT_INVALID_ARGUMENT;
  sums[0] = sums[1] = 0;
  for (int64_t i = 0; i < n; ++i)
    if (mass[i] > 0)
    {
      sums[0] += mass[i] * x[i] * x[i];
      sums[1] += stiffness_times_x[i] * stiffness_times_x[i] / mass[i];
    }
  return ABUT_SUCCESS;
}

abut_status
abut_time_limit_next(abut_time_limit *limit, const double sums[2], int64_t n,
                     const double *mass, const double *stiffness_times_x,
                     double *x)
{
  if (limit == NULL || limit->struct_size != sizeof(*limit) || sums == NULL
      || n < 0
      || (n > 0 && (mass == NULL || x == NULL || stiffness_times_x == NULL)))
    return ABUT_INVALID_ARGUMENT;
  if (!(sums[0] >= 0 && sums[1] >= 0) || !isfinite(sums[0] + sums[1]))
    return ABUT_NOT_FINITE;
  const double square = sums[0] > 0 ? sqrt(sums[1] / sums[0]) : 0;
  ++limit->n_products;
  limit->goes_on = fabs(square - limit->square) > accuracy * square
                   && limit->n_products < most_products;
  limit->square = square;
  limit->step = square > 0 ? 2 / sqrt(square) : INFINITY;
  /* The vector has length 1 in the norm of M, so that nothing overflows. */
  const double factor = sums[1] > 0 ? 1 / sqrt(sums[1]) : 0;
  for (int64_t i = 0; i < n; ++i)
    x[i] = mass[i] > 0 ? factor * stiffness_times_x[i] / mass[i] : 0;
  return ABUT_SUCCESS;
}
