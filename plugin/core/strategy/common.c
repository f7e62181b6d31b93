/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Helpers that all methods use: reductions, requests, and the law at the
 * present point. */
#include "base/finite.h"
#include "strategy/strategy.h"

#include <math.h>
#include <string.h>

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
  double failed = status != ABUT_SUCCESS;
  const abut_status reduced =
      abut_strategy_reduce(s, ABUT_REDUCTION_MAX, &failed, 1);
  if (status != ABUT_SUCCESS)
    return status;
  if (reduced != ABUT_SUCCESS || failed == 0)
    return reduced;
  return abut_fail(s->context, ABUT_FAILED_ELSEWHERE, "abut_strategy",
                   abut_status_text(ABUT_FAILED_ELSEWHERE));
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

/* A number that distinguishes the laws' matrix coefficients: those of a row
 * come into one, so that rows wait for one product only. */
static uint64_t
sign_coefficients(const abut_strategy *s)
{
  const bool blocks = abut_friction_is_on(&s->friction);
  const int64_t n = blocks ? s->friction.block_numbers : s->n;
  uint64_t sign = 0;
  for (int64_t i = 0; i < n; ++i)
  {
    uint64_t a, b;
    memcpy(&a, blocks ? &s->friction.a[i] : &s->d_pressure[i], sizeof(a));
    memcpy(&b, blocks ? &s->friction.b[i] : &s->d_gap[i], sizeof(b));
    const uint64_t both =
        a ^ ((b << 23 | b >> 41) * UINT64_C(0x9e3779b97f4a7c15));
    sign = (sign ^ both) * UINT64_C(1099511628211);
  }
  return sign;
}

/* Why the law's result in row i is of no use; NULL if it is good, or if the row
 * is a tangent, which friction's law decides. */
static const char *
fault_of_row(const abut_strategy *s, int32_t i)
{
  const double a = s->d_pressure[i], b = s->d_gap[i];
  if (s->bilateral[i] == ABUT_ROW_TANGENT)
    return NULL;
  if (!isfinite(s->residual[i]) || !isfinite(a) || !isfinite(b))
    return "a value that is not finite";
  if (a == 0 && (b == 0 || !abut_law_is_exact(s->options.law)))
    return "a derivative by the pressure that is zero";
  return NULL;
}

static void
add_row(abut_text *text, const abut_strategy *s, int32_t i)
{
  abut_text_add(text, " at gap ");
  abut_text_add_number(text, s->gap[i]);
  abut_text_add(text, ", pressure ");
  abut_text_add_number(text, s->pressure[i]);
}

/* Look at what the law gave. */
static abut_status
check_law_result(abut_strategy *s, abut_status status)
{
  const char *fault = status == ABUT_SUCCESS ? NULL : abut_status_text(status);
  int32_t row = -1;
  for (int32_t i = 0; i < s->n && fault == NULL; ++i)
  {
    fault = fault_of_row(s, i);
    row = i;
  }
  if (fault == NULL)
    return ABUT_SUCCESS;
  abut_text text = abut_strategy_remark(s);
  abut_text_add(&text, "the law '");
  abut_text_add(&text, s->options.law->name);
  abut_text_add(&text, status == ABUT_SUCCESS ? "' gives " : "' failed: ");
  abut_text_add(&text, fault);
  if (row >= 0)
    add_row(&text, s, row);
  return status == ABUT_SUCCESS ? ABUT_NOT_FINITE : status;
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
  status = check_law_result(s, status);
  if (status == ABUT_SUCCESS && abut_friction_is_on(&s->friction))
    status = abut_friction_evaluate(s);
  const uint64_t sign = sign_coefficients(s);
  s->coefficients_changed |= sign != s->coefficient_sign;
  s->coefficient_sign = sign;
  return status;
}

abut_status
abut_strategy_request_solve(abut_strategy *s, double tolerance, bool final)
{
  if (s->progress.step >= s->options.max_steps)
  {
    abut_text text = abut_strategy_remark(s);
    abut_text_add(&text, "not converged after ");
    abut_text_add_integer(&text, s->progress.step);
    abut_text_add(&text, " linear systems");
    return abut_strategy_stop(s, ABUT_REASON_STEP_LIMIT);
  }
  const abut_status status = abut_strategy_agree(s, abut_strategy_linearise(s));
  if (status != ABUT_SUCCESS)
    return status;
  abut_friction_store_directions(&s->friction);
  s->coefficients_changed = false;
  s->progress.step += 1;
  s->request.action = ABUT_ACTION_SOLVE;
  s->request.linear_tolerance = tolerance;
  s->request.matrix_changed = s->matrix_changed;
  s->request.final_solve = final;
  s->matrix_changed = false;
  return ABUT_SUCCESS;
}

abut_status
abut_strategy_request_move(abut_strategy *s, double step_length)
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
  if (s->bilateral[i] == ABUT_ROW_TANGENT)
    return 0;
  return s->bilateral[i] != 0 ? fabs(s->gap[i]) : abut_larger(-s->gap[i], 0);
}
