/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "strategy/interior.h"
#include "strategy/strategy.h"

#include <math.h>

abut_status
abut_interior_step(abut_strategy *s, const double *distance,
                   const double *d_distance, double fraction, double *alpha)
{
  double decrease = 0; /* largest relative decrease by a full step */
  for (int32_t i = 0; i < s->n; ++i)
  {
    decrease = fmax(decrease, -s->dp[i] / s->pressure[i]);
    decrease = fmax(decrease, -d_distance[i] / distance[i]);
  }
  const abut_status status =
      abut_strategy_reduce(s, ABUT_REDUCTION_MAX, &decrease, 1);
  *alpha = decrease > fraction ? fraction / decrease : 1;
  return status;
}

abut_status
abut_interior_move(abut_strategy *s, double alpha, double *slack)
{
  abut_interior *interior = &s->interior;
  for (int32_t i = 0; i < s->n; ++i)
  {
    s->pressure[i] += alpha * s->dp[i];
    if (slack != NULL)
      slack[i] += alpha * s->dz[i];
  }
  /* Residual of a linear host after a step of length alpha: the rest of the old
   * one and what the linear solver left. */
  interior->imbalance *= 1 - alpha * (1 - s->request.linear_tolerance);
  interior->alpha = alpha;
  return abut_strategy_request_move(s, alpha);
}

abut_status
abut_interior_report(abut_strategy *s)
{
  double sum[2] = {0, 0}, max[2] = {0, 0};
  const abut_law_points points = abut_strategy_points(s);
  abut_status status = s->options.law->classify(&points, s->trial_state);
  status = abut_strategy_agree(s, status);
  if (status != ABUT_SUCCESS)
    return status;
  for (int32_t i = 0; i < s->n; ++i)
  {
    sum[0] += s->trial_state[i] != ABUT_STATE_OPEN;
    sum[1] += s->trial_state[i] != s->state[i];
    max[0] = fmax(max[0], abut_strategy_penetration(s, i));
    max[1] = fmax(max[1], fabs(s->pressure[i] * s->gap[i]));
    s->state[i] = s->trial_state[i];
  }
  status = abut_strategy_reduce(s, ABUT_REDUCTION_SUM, sum, 2);
  if (status == ABUT_SUCCESS)
    status = abut_strategy_reduce(s, ABUT_REDUCTION_MAX, max, 2);
  s->progress.n_active = (int64_t)sum[0];
  s->progress.n_changes = (int64_t)sum[1];
  s->progress.penetration = max[0];
  s->progress.complementarity = max[1];
  return status;
}
