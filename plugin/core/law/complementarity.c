/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "law/complementarity.h"
#include "law/check.h"

static bool
is_bilateral(const abut_law_points *points, int32_t i)
{
  return points->bilateral != NULL && points->bilateral[i] != 0;
}

static double
compliance_of(const abut_law_points *points, uint32_t terms, int32_t i)
{
  return (terms & ABUT_TERM_COMPLIANCE) != 0 && points->compliance != NULL
             ? points->compliance[i]
             : 0;
}

/* g~ of row i. */
static double
shifted_gap(const abut_law_points *points, uint32_t terms, int32_t i)
{
  double p = points->pressure[i];
  if ((terms & ABUT_TERM_REFERENCE) != 0 && points->reference_pressure != NULL)
    p -= points->reference_pressure[i];
  double gap = points->gap[i] + p * compliance_of(points, terms, i);
  if ((terms & ABUT_TERM_ALLOWED) != 0 && !is_bilateral(points, i))
    gap += points->allowed_penetration;
  return gap;
}

abut_status
abut_complementarity_classify(const abut_law_points *points, uint32_t terms,
                              uint8_t *state)
{
  const abut_status status = abut_law_check_points(points, false);
  if (status != ABUT_SUCCESS)
    return status;
  if (points->n > 0 && state == NULL)
    return ABUT_INVALID_ARGUMENT;
  for (int32_t i = 0; i < points->n; ++i)
  {
    const double gap = shifted_gap(points, terms, i);
    const bool closed = is_bilateral(points, i)
                        || points->pressure[i] - points->scale[i] * gap > 0;
    state[i] = closed ? ABUT_STATE_CLOSED : ABUT_STATE_OPEN;
  }
  return ABUT_SUCCESS;
}

abut_status
abut_complementarity_linearise(const abut_law_points *points, uint32_t terms,
                               const uint8_t *state,
                               abut_law_linearisation *result)
{
  abut_status status = abut_law_check_points(points, false);
  if (status == ABUT_SUCCESS)
    status = abut_law_check_result(points, result);
  if (status != ABUT_SUCCESS)
    return status;
  if (points->n > 0 && state == NULL)
    return ABUT_INVALID_ARGUMENT;
  for (int32_t i = 0; i < points->n; ++i)
  {
    const bool closed = state[i] != ABUT_STATE_OPEN || is_bilateral(points, i);
    result->residual[i] =
        closed ? shifted_gap(points, terms, i) : points->pressure[i];
    result->d_pressure[i] = closed ? compliance_of(points, terms, i) : 1;
    result->d_gap[i] = closed ? 1 : 0;
  }
  return ABUT_SUCCESS;
}
