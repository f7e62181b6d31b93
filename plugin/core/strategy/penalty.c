/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Quadratic penalty: eps grows by a factor from outer step to outer step, each
 * of which starts from the last one's solution, until the penetration meets
 * its tolerance or eps its cap. */
#include "strategy/strategy.h"

#include <math.h>

abut_status
abut_penalty_settled(abut_strategy *s, abut_verdict *verdict)
{
  const abut_strategy_options *options = &s->options;
  const double penetration = s->progress.penetration / options->length_scale;
  const double penalty = s->progress.penalty;
  verdict->go_on = false;
  verdict->reason = ABUT_REASON_CONVERGED;
  if (penetration <= options->gap_tolerance)
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
  abut_text_add(&text, " and the relative penetration still ");
  abut_text_add_number(&text, penetration);
  abut_text_add(&text, " above the gap tolerance ");
  abut_text_add_number(&text, options->gap_tolerance);
  s->progress.seen = ABUT_FAILURE_PENALTY;
  verdict->reason = ABUT_REASON_STEP_LIMIT;
  return ABUT_SUCCESS;
}
