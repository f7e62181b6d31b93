/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Interior point with a slack z > 0 per row: p z = mu and z = g, so that the
 * start need not be feasible (Nocedal and Wright, Numerical Optimization,
 * section 16.6). The slack's change dz = dg + (g - z) is eliminated from
 *
 *     z dp + p dz = -(p z - mu),
 *
 * which leaves z dp + p dg = -(p z - mu + p (g - z)). */
#include "law/check.h"
#include "law/interior.h"
#include "law/law_table.h"

static abut_status
classify(const abut_law_points *points, uint8_t *state)
{
  const abut_status status = abut_law_check_points(points, true);
  if (status != ABUT_SUCCESS)
    return status;
  if (points->n > 0 && state == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_interior_classify(points, points->slack, state);
  return ABUT_SUCCESS;
}

static abut_status
linearise(const abut_law_points *points, const uint8_t *state,
          abut_law_linearisation *result)
{
  (void)state;
  abut_status status = abut_law_check_points(points, true);
  if (status == ABUT_SUCCESS)
    status = abut_law_check_result(points, result);
  if (status != ABUT_SUCCESS)
    return status;
  for (int32_t i = 0; i < points->n; ++i)
  {
    const double p = points->pressure[i], z = points->slack[i];
    result->residual[i] = p * z - points->barrier + p * (points->gap[i] - z);
    result->d_pressure[i] = z;
    result->d_gap[i] = p;
  }
  return ABUT_SUCCESS;
}

const abut_law abut_law_interior_point = {
    .struct_size = sizeof(abut_law),
    .name = "interior point",
    .flags = ABUT_LAW_INTERIOR | ABUT_LAW_SLACK,
    .outer = ABUT_OUTER_PRIMAL_DUAL,
    .classify = classify,
    .linearise = linearise,
};
