/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Quadratic penalty: eps grows by a factor from outer step to outer step, each
 * of which starts from the last one's solution, until the penetration, and the
 * slip of sticking points, meet their tolerance or eps its cap. */
#include "strategy/strategy.h"

#include <math.h>

/* Largest slip of sticking points, which is that of their springs, length. */
static abut_status
find_slip_of_stick(abut_strategy *s, double *slip)
{
  *slip = 0;
  if (!abut_friction_is_on(&s->friction))
    return ABUT_SUCCESS;
  for (int32_t i = 0; i < s->n; ++i)
    if (s->bilateral[i] == ABUT_ROW_TANGENT && !abut_friction_row_is_free(s, i))
      *slip = fmax(*slip, fabs(s->gap[i]));
  return abut_strategy_reduce(s, ABUT_REDUCTION_MAX, slip, 1);
}

abut_status
abut_penalty_settled(abut_strategy *s, abut_verdict *verdict)
{
  const abut_strategy_options *options = &s->options;
  double slip = 0;
  const abut_status status = find_slip_of_stick(s, &slip);
  if (status != ABUT_SUCCESS)
    return status;
  const double penetration = s->progress.penetration / options->length_scale;
  const double error = fmax(penetration, slip / options->length_scale);
  const double penalty = s->progress.penalty;
  if (error <= options->gap_tolerance)
    return ABUT_SUCCESS;
  if (penalty < options->penalty_cap)
  {
    abut_strategy_set_penalty(
        s, fmin(penalty * options->penalty_growth, options->penalty_cap));
    verdict->go_on = true;
    return ABUT_SUCCESS;
  }
  abut_text text = abut_strategy_remark(s);
  abut_text_add(&text, "the penalty is at its cap ");
  abut_text_add_number(&text, penalty);
  abut_text_add(&text,
                error > penetration
                    ? " and the relative slip of sticking points is still "
                    : " and the relative penetration is still ");
  abut_text_add_number(&text, error);
  abut_text_add(&text, " above the gap tolerance ");
  abut_text_add_number(&text, options->gap_tolerance);
  s->progress.seen = ABUT_FAILURE_PENALTY;
  verdict->reason = ABUT_REASON_STEP_LIMIT;
  return ABUT_SUCCESS;
}
