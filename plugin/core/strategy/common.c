/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Helpers that all methods use: reductions, requests, and the law at the
 * present point. */
#include "strategy/strategy.h"

#include <math.h>

abut_status
abut_strategy_reduce(abut_strategy *s, abut_reduction op, double *values,
                     int32_t n)
{
  if (s->options.reduce == NULL)
    return ABUT_SUCCESS;
  if (s->options.reduce(s->options.user, op, values, n) != ABUT_SUCCESS)
    return abut_fail(s->context, ABUT_CALLBACK_FAILED, "abut_strategy_next",
                     "the reduction over ranks failed");
  return ABUT_SUCCESS;
}

abut_status
abut_strategy_agree(abut_strategy *s, abut_status status)
{
  /* The worst mistake and the worst fault: faults have negative codes. */
  double worst[2] = {(double)status, -(double)status};
  const abut_status reduced =
      abut_strategy_reduce(s, ABUT_REDUCTION_MAX, worst, 2);
  if (status != ABUT_SUCCESS)
    return status;
  if (reduced != ABUT_SUCCESS || (worst[0] <= 0 && worst[1] <= 0))
    return reduced;
  return abut_fail(s->context,
                   (abut_status)(worst[1] > 0 ? -worst[1] : worst[0]),
                   "abut_strategy", "another rank reported a failure");
}

abut_law_points
abut_strategy_points(const abut_strategy *s)
{
  const double length = s->options.length_scale;
  const abut_law_points points = {
      .struct_size = sizeof(abut_law_points),
      .n = s->n,
      .gap = s->gap,
      .pressure = s->pressure,
      .slack = s->slack,
      .reference_pressure = s->reference,
      .compliance = s->compliance,
      .scale = s->scale,
      .bilateral = s->bilateral,
      .allowed_penetration = s->options.allowed_penetration * length,
      .barrier = s->mu,
      .parameters = s->options.law_parameters,
  };
  return points;
}

abut_status
abut_strategy_linearise(abut_strategy *s)
{
  const abut_law_points points = abut_strategy_points(s);
  abut_law_linearisation result = {
      .struct_size = sizeof(abut_law_linearisation),
      .residual = s->residual,
      .d_pressure = s->d_pressure,
      .d_gap = s->d_gap,
  };
  abut_status status = s->options.law->linearise(&points, s->state, &result);
  double probe = 0;
  if (status == ABUT_SUCCESS)
    for (int32_t i = 0; i < s->n; ++i)
      probe += (s->residual[i] + s->d_pressure[i] + s->d_gap[i]) * 0.0;
  if (status == ABUT_SUCCESS && !(probe == 0))
    status = ABUT_NOT_FINITE;
  if (status != ABUT_SUCCESS)
  {
    abut_text text = abut_strategy_remark(s);
    abut_text_add(&text, "the law '");
    abut_text_add(&text, s->options.law->name);
    abut_text_add(&text, "' failed: ");
    abut_text_add(&text, abut_status_text(status));
  }
  return status;
}

abut_status
abut_strategy_ask_solve(abut_strategy *s, double tolerance, bool final)
{
  if (s->progress.step >= s->options.max_steps)
  {
    abut_text text = abut_strategy_remark(s);
    abut_text_add(&text, "not converged after ");
    abut_text_add_integer(&text, s->progress.step);
    abut_text_add(&text, " linear systems (max_steps)");
    return abut_strategy_stop(s, ABUT_REASON_STEP_LIMIT);
  }
  const abut_status status = abut_strategy_agree(s, abut_strategy_linearise(s));
  if (status != ABUT_SUCCESS)
    return status;
  s->progress.step += 1;
  s->request.action = ABUT_ACTION_SOLVE;
  s->request.linear_tolerance = tolerance;
  s->request.matrix_changed = s->matrix_changed;
  s->request.final_solve = final;
  s->matrix_changed = false;
  return ABUT_SUCCESS;
}

abut_status
abut_strategy_ask_move(abut_strategy *s, double step_length)
{
  s->request.action = ABUT_ACTION_MOVE;
  s->request.step_length = step_length;
  return ABUT_SUCCESS;
}

abut_status
abut_strategy_stop(abut_strategy *s, abut_reason reason)
{
  s->phase = ABUT_PHASE_STOPPED;
  s->request.action = ABUT_ACTION_STOP;
  s->request.reason = reason;
  return ABUT_SUCCESS;
}

abut_text
abut_strategy_remark(abut_strategy *s)
{
  return abut_fail_begin(s->context, "abut_strategy_next");
}

void
abut_strategy_set_penalty(abut_strategy *s, double penalty)
{
  for (int32_t i = 0; i < s->n; ++i)
    s->compliance[i] = 1 / (penalty * s->stiffness[i]);
  s->progress.penalty = penalty;
  s->matrix_changed = true;
}

double
abut_strategy_penetration(const abut_strategy *s, int32_t i)
{
  return s->bilateral[i] != 0 ? fabs(s->gap[i]) : fmax(-s->gap[i], 0);
}
