/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "law/check.h"

#include "base/finite.h"

static bool
all_positive(const double *x, int32_t n)
{
  bool positive = true;
  for (int32_t i = 0; i < n; ++i)
    positive &= x[i] > 0;
  return positive;
}

abut_status
abut_law_check_points(const abut_law_points *points, bool with_slack)
{
  if (points == NULL || points->struct_size != sizeof(abut_law_points)
      || points->n < 0)
    return ABUT_INVALID_ARGUMENT;
  const int32_t n = points->n;
  if (!(points->allowed_penetration >= 0) || !(points->barrier >= 0))
    return ABUT_INVALID_ARGUMENT;
  if (n == 0)
    return ABUT_SUCCESS;
  if (points->gap == NULL || points->pressure == NULL || points->scale == NULL
      || (with_slack && points->slack == NULL))
    return ABUT_INVALID_ARGUMENT;
  if (!abut_all_finite(points->gap, n) || !abut_all_finite(points->pressure, n)
      || !abut_all_finite(points->scale, n)
      || (with_slack && !abut_all_finite(points->slack, n))
      || (points->compliance != NULL && !abut_all_finite(points->compliance, n))
      || (points->reference_pressure != NULL
          && !abut_all_finite(points->reference_pressure, n)))
    return ABUT_NOT_FINITE;
  return all_positive(points->scale, n) ? ABUT_SUCCESS : ABUT_INVALID_ARGUMENT;
}

abut_status
abut_law_check_result(const abut_law_points *points,
                      const abut_law_linearisation *result)
{
  if (result == NULL || result->struct_size != sizeof(abut_law_linearisation))
    return ABUT_INVALID_ARGUMENT;
  if (points->n > 0
      && (result->residual == NULL || result->d_pressure == NULL
          || result->d_gap == NULL))
    return ABUT_INVALID_ARGUMENT;
  return ABUT_SUCCESS;
}
