/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Method of multipliers (Hestenes 1969, Powell 1969; Bertsekas, Constrained
 * Optimization and Lagrange Multiplier Methods, 1982): solve with
 * p = pbar - eps g, then pbar <- max(p, 0). The error falls by about
 * k / (k + eps) per outer step, k the stiffness that the contact surface sees.
 * With adaptive_penalty, eps grows where that is too slow.
 *
 * Where rows outnumber the unknowns of the surface, multipliers of their own
 * are not unique: modes that no displacement changes never settle. With a
 * projection the multipliers are functions of a smaller space, and the update
 * is pbar <- pbar + P (max(p, 0) - pbar): at its end the gap vanishes in the
 * weighted means of the space, as in a mortar method. */
#include "strategy/strategy.h"

#include <math.h>

/* Wanted reduction of the gap error, growth of eps where it is missed, and
 * what counts as no contraction at all. */
static const double wanted_rate = 0.1, growth = 5, stagnant_rate = 0.9;

/* Pressures are measured by themselves, or by this part of the pressure scale
 * if they are smaller. */
static const double least_pressure = 1e-5;

enum
{
  MAX_STAGNANT = 4 /* outer steps without contraction before giving up */
};

abut_status
abut_multiplier_project(abut_strategy *s, double *value)
{
  if (s->options.project == NULL
      || s->options.project(s->options.project_user, s->n, value)
             == ABUT_SUCCESS)
    return ABUT_SUCCESS;
  return abut_fail(s->context, ABUT_CALLBACK_FAILED, "abut_strategy_next",
                   "the projection on the space of the multipliers failed");
}

/* Change of pbar in the next update, [n]. */
static abut_status
find_change(abut_strategy *s, double *change)
{
  for (int32_t i = 0; i < s->n; ++i)
    change[i] =
        (s->bilateral[i] != 0 ? s->pressure[i] : fmax(s->pressure[i], 0))
        - s->reference[i];
  return abut_multiplier_project(s, change);
}

static void
apply(abut_strategy *s, const double *change)
{
  for (int32_t i = 0; i < s->n; ++i)
    s->reference[i] += change[i];
}

abut_status
abut_multiplier_update(abut_strategy *s)
{
  const abut_status status = find_change(s, s->trial_pressure);
  if (status == ABUT_SUCCESS)
    apply(s, s->trial_pressure);
  return status;
}

/* Gap error (violated, or open under pressure) relative to the length scale,
 * and the weighted relative change of the pressures against pbar. With a space
 * of multipliers, the gap error is the projected one, by the change of pbar
 * that it makes. */
static abut_status
measure(abut_strategy *s, const double *change, double *gap_error)
{
  double max = 0, sum[3] = {0, 0, 0};
  for (int32_t i = 0; i < s->n; ++i)
  {
    const bool closed = s->state[i] != ABUT_STATE_OPEN;
    const double error = s->options.project != NULL
                             ? fabs(change[i]) * s->compliance[i]
                         : closed ? fabs(s->gap[i])
                                  : fmax(-s->gap[i], 0);
    /* Points that slip do not close a gap along the tangent. */
    if (!abut_friction_row_is_free(s, i))
      max = fmax(max, error);
    sum[0] += s->weight[i] * fabs(change[i]);
    sum[1] += s->weight[i] * fabs(s->pressure[i]);
    sum[2] += s->weight[i];
  }
  abut_status status = abut_strategy_reduce(s, ABUT_REDUCTION_MAX, &max, 1);
  if (status == ABUT_SUCCESS)
    status = abut_strategy_reduce(s, ABUT_REDUCTION_SUM, sum, 3);
  *gap_error = max / s->options.length_scale;
  /* All pressure gone is a change of 100 %. Where hardly anything presses, what
   * the linear solver leaves over of the load is not measured by that. */
  const double all =
      fmax(sum[1], least_pressure * s->options.pressure_scale * sum[2]);
  s->progress.pressure_change = sum[0] == 0                   ? 0
                                : sum[1] > 0 || sum[0] <= all ? sum[0] / all
                                                              : 1;
  return status;
}

static void
remark_stagnation(abut_strategy *s, double gap_error)
{
  abut_text text = abut_strategy_remark(s);
  abut_text_add(
      &text,
      "the method of multipliers does not converge: relative gap error ");
  abut_text_add_number(&text, gap_error);
  abut_text_add(&text, ", pressures change by ");
  abut_text_add_number(&text, s->progress.pressure_change);
  abut_text_add(&text, " of themselves");
  abut_text_add(&text, " after ");
  abut_text_add_integer(&text, s->progress.outer);
  abut_text_add(&text, " outer steps with penalty ");
  abut_text_add_number(&text, s->progress.penalty);
}

abut_status
abut_multiplier_settled(abut_strategy *s, abut_verdict *verdict)
{
  const abut_strategy_options *options = &s->options;
  abut_outer_memory *last = &s->outer;
  double gap_error = 0, *change = s->trial_pressure;
  abut_status status = find_change(s, change);
  if (status == ABUT_SUCCESS)
    status = measure(s, change, &gap_error);
  if (status != ABUT_SUCCESS)
    return status;
  const double merit =
      fmax(gap_error / options->gap_tolerance,
           s->progress.pressure_change / options->pressure_tolerance);
  const bool first = s->progress.outer == 1;
  const bool slow = !first && gap_error > options->gap_tolerance
                    && gap_error > wanted_rate * last->gap_error;
  const bool stagnant = !first && merit > stagnant_rate * last->merit;
  last->n_stagnant = stagnant ? last->n_stagnant + 1 : 0;
  s->progress.seen =
      slow || stagnant ? ABUT_FAILURE_MULTIPLIERS_STALL : ABUT_FAILURE_NONE;
  last->gap_error = gap_error;
  last->merit = merit;
  apply(s, change);

  if (merit <= 1)
    return ABUT_SUCCESS;
  verdict->go_on = true;
  const double penalty =
      fmin(growth * s->progress.penalty, options->penalty_cap);
  if (options->adaptive_penalty && slow && penalty > s->progress.penalty)
  {
    abut_strategy_set_penalty(s, penalty);
    last->n_stagnant = 0;
  }
  else if (last->n_stagnant >= MAX_STAGNANT)
  {
    remark_stagnation(s, gap_error);
    verdict->go_on = false;
    verdict->reason = ABUT_REASON_STAGNATION;
  }
  return ABUT_SUCCESS;
}
