/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/finite.h"

enum
{
  SUMS = 8
};

/* x * 0 is 0 for every finite x and NaN otherwise: sums decide it without a
 * branch in the loop, several side by side as none need wait for another. */
bool
abut_all_finite(const double *x, int64_t n)
{
  double sum[SUMS] = {0};
  int64_t i = 0;
  for (; i + SUMS <= n; i += SUMS)
    for (int32_t k = 0; k < SUMS; ++k)
      sum[k] += x[i + k] * 0.0;
  for (; i < n; ++i)
    sum[0] += x[i] * 0.0;
  for (int32_t k = 1; k < SUMS; ++k)
    sum[0] += sum[k];
  return sum[0] == 0;
}
