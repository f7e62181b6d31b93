/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Logarithmic barrier in primal-dual form: p g = mu with p > 0, g > 0
 * (Nocedal and Wright, Numerical Optimization, section 19.6). Linearised as it
 * stands: g dp + p dg = -(p g - mu). */
#include "law/check.h"
#include "law/interior.h"
#include "law/law_table.h"

static abut_status
classify(const abut_law_points *points, uint8_t *state)
{
  const abut_status status = abut_law_check_points(points, false);
  if (status != ABUT_SUCCESS)
    return status;
  if (points->n > 0 && state == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_interior_classify(points, points->gap, state);
  return ABUT_SUCCESS;
}

static abut_status
linearise(const abut_law_points *points, const uint8_t *state,
          abut_law_linearisation *result)
{
  (void)state;
  abut_status status = abut_law_check_points(points, false);
  if (status == ABUT_SUCCESS)
    status = abut_law_check_result(points, result);
  if (status != ABUT_SUCCESS)
    return status;
  for (int32_t i = 0; i < points->n; ++i)
  {
    const double p = points->pressure[i], gap = points->gap[i];
    result->residual[i] = p * gap - points->barrier;
    result->d_pressure[i] = gap;
    result->d_gap[i] = p;
  }
  return ABUT_SUCCESS;
}

const abut_law abut_law_barrier = {
    .struct_size = sizeof(abut_law),
    .name = "barrier",
    .flags = ABUT_LAW_INTERIOR,
    .outer = ABUT_OUTER_BARRIER,
    .classify = classify,
    .linearise = linearise,
};
