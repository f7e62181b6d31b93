/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_BASE_FINITE_H
#define ABUT_BASE_FINITE_H

#include <stdbool.h>
#include <stdint.h>

/* Whether n numbers are finite, all of them read once. */
bool abut_all_finite(const double *x, int64_t n);

/* The larger of two numbers, of which neither is NaN: without the call that
 * fmax() is. */
static inline double
abut_larger(double a, double b)
{
  return a > b ? a : b;
}

#endif
