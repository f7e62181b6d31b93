/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The front of all methods: life cycle, checks at the boundary, and handing
 * the host's reports to the method. */
#include "strategy/strategy.h"
#include "base/finite.h"
#include "base/sized.h"
#include "strategy/options.h"
#include "strategy/outer_table.h"

#include <math.h>
#include <string.h>

const char *
abut_reason_text(abut_reason reason)
{
  switch (reason)
  {
  case ABUT_REASON_NONE:
    return "not stopped";
  case ABUT_REASON_CONVERGED:
    return "converged";
  case ABUT_REASON_STEP_LIMIT:
    return "a limit was reached: allow more steps or a larger penalty, start "
           "closer to the solution, or use another method";
  case ABUT_REASON_STAGNATION:
    return "the iteration does not converge: use a larger or adaptive penalty, "
           "or a smaller linear tolerance";
  case ABUT_REASON_INFEASIBLE:
    return "the barrier needs open gaps and has one that is closed, at the "
           "start or by round-off: move the bodies apart, use a larger end of "
           "the barrier, or 'interior point', which needs no open gaps";
  case ABUT_REASON_NOT_FINITE:
    return "a gap or an increment is not finite: check for data that are not "
           "finite and for a singular linear system";
  case ABUT_REASON_UNHELD:
    return "a body is supported by friction alone, which is too small: give it "
           "a support, less load along the surface, or more friction";
  }
  return "unknown reason";
}

/* Steps on one mesh after which a set that still moves has come a long way;
 * least eps of nitsche beside its default of 10 that can be stable; least eps
 * whose forces are not round-off of those of the bodies. */
static const int32_t many_steps = 12;
static const double least_stable = 1, least_felt = 1e-15;

static abut_failure
failure_at_limit(const abut_law *law, const abut_progress *progress)
{
  if (progress->seen != ABUT_FAILURE_NONE)
    return progress->seen;
  if (abut_law_needs_stress(law) && progress->penalty > 0
      && progress->penalty < least_stable)
    return ABUT_FAILURE_NITSCHE;
  if (progress->penalty > 0 && progress->penalty < least_felt)
    return ABUT_FAILURE_PENALTY;
  if (progress->fallback_steps > 0)
    return ABUT_FAILURE_CYCLE;
  return abut_law_solves_once(law) && progress->step > many_steps
             ? ABUT_FAILURE_COLD_START
             : ABUT_FAILURE_STEP_LIMIT;
}

abut_failure
abut_reason_failure(abut_reason reason, const abut_law *law,
                    const abut_progress *given)
{
  abut_progress taken = {0};
  if (law == NULL || given == NULL
      || abut_sized_read(&taken, sizeof(taken), given) != NULL)
    return ABUT_FAILURE_NONE;
  const abut_progress *progress = &taken;
  switch (reason)
  {
  case ABUT_REASON_NONE:
  case ABUT_REASON_CONVERGED:
    return progress->fallback_steps > 0 ? ABUT_FAILURE_CYCLE
                                        : ABUT_FAILURE_NONE;
  case ABUT_REASON_STEP_LIMIT:
  case ABUT_REASON_STAGNATION:
    return failure_at_limit(law, progress);
  case ABUT_REASON_INFEASIBLE:
    return ABUT_FAILURE_INFEASIBLE_START;
  case ABUT_REASON_NOT_FINITE:
    return ABUT_FAILURE_NOT_FINITE;
  case ABUT_REASON_UNHELD:
    return ABUT_FAILURE_FREE_SLIDING;
  }
  return ABUT_FAILURE_NONE;
}

abut_status
abut_strategy_create(abut_context *context,
                     const abut_strategy_options *options,
                     abut_strategy **strategy)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (options == NULL || strategy == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_strategy_create",
                     "an argument is NULL");
  abut_strategy_options taken = abut_strategy_defaults();
  abut_status status = abut_copy_in(context, "abut_strategy_create", &taken,
                                    sizeof(taken), options);
  if (status == ABUT_SUCCESS && taken.law == NULL)
    taken.law = abut_law_find("lagrange");
  if (status == ABUT_SUCCESS)
    status =
        abut_strategy_check_options(context, &taken, "abut_strategy_create");
  if (status != ABUT_SUCCESS)
    return status;
  abut_strategy *s = abut_object_create(context, sizeof(abut_strategy));
  if (s == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, "abut_strategy_create",
                     "no memory");
  s->context = context;
  s->options = taken;
  s->method = abut_outer_get(taken.law->outer)->method;
  s->numbers.element = sizeof(double);
  s->bytes.element = sizeof(uint8_t);
  s->ids.element = sizeof(int64_t);
  abut_friction_prepare(&s->friction);
  *strategy = s;
  return ABUT_SUCCESS;
}

abut_status
abut_strategy_destroy(abut_strategy **strategy)
{
  if (strategy == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_strategy *s = *strategy;
  if (s == NULL)
    return ABUT_SUCCESS;
  abut_array_release(s->context, &s->numbers);
  abut_array_release(s->context, &s->bytes);
  abut_array_release(s->context, &s->ids);
  abut_friction_release(s->context, &s->friction);
  abut_object_destroy(s->context, s, sizeof(*s));
  *strategy = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_strategy_progress_sized(const abut_strategy *strategy,
                             abut_progress *progress)
{
  if (strategy == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (progress == NULL)
    return abut_fail(strategy->context, ABUT_INVALID_ARGUMENT,
                     "abut_strategy_progress", "progress is NULL");
  if (strategy->phase == ABUT_PHASE_CREATED)
    return abut_fail(strategy->context, ABUT_WRONG_ORDER,
                     "abut_strategy_progress", "the strategy is not started");
  return abut_copy_out(strategy->context, "abut_strategy_progress", progress,
                       sizeof(strategy->progress), &strategy->progress);
}

/* Whether all ranks' values are finite; y may be NULL. */
static abut_status
all_finite(abut_strategy *s, const double *x, const double *y, bool *finite)
{
  const bool here =
      abut_all_finite(x, s->n) && (y == NULL || abut_all_finite(y, s->n));
  double bad = here ? 0 : 1;
  const abut_status status =
      abut_strategy_reduce(s, ABUT_REDUCTION_MAX, &bad, 1);
  *finite = bad == 0;
  return status;
}

static abut_status
stop_not_finite(abut_strategy *s, const char *what)
{
  abut_text text = abut_strategy_remark(s);
  abut_text_add(&text, what);
  abut_text_add(&text, " is NaN or infinite");
  return abut_strategy_stop(s, ABUT_REASON_NOT_FINITE);
}

static abut_status
take_changes(abut_strategy *s)
{
  bool finite = false;
  const abut_status status = all_finite(s, s->dp, s->dg, &finite);
  if (status != ABUT_SUCCESS)
    return status;
  return finite ? s->method->solved(s) : stop_not_finite(s, "an increment");
}

static abut_status
take_gap(abut_strategy *s, const double *gap)
{
  bool finite = false;
  if (s->n > 0)
    memcpy(s->gap, gap, (size_t)s->n * sizeof(double));
  const abut_status status = all_finite(s, s->gap, NULL, &finite);
  if (status != ABUT_SUCCESS)
    return status;
  return finite ? s->method->moved(s) : stop_not_finite(s, "a gap");
}

abut_status
abut_strategy_next_sized(abut_strategy *strategy, const double *gap,
                         abut_request *request)
{
  if (strategy == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_strategy *s = strategy;
  if (request == NULL)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "abut_strategy_next",
                     "request is NULL");
  if (s->phase == ABUT_PHASE_CREATED)
    return abut_fail(s->context, ABUT_WRONG_ORDER, "abut_strategy_next",
                     "the strategy is not started");
  const bool running = s->phase == ABUT_PHASE_RUNNING;
  const bool takes_gap = running && s->request.action == ABUT_ACTION_MOVE;
  if (takes_gap && s->n > 0 && gap == NULL)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "abut_strategy_next",
                     "gap is NULL after a move");
  abut_status status = ABUT_SUCCESS;
  if (s->phase == ABUT_PHASE_STARTED)
  {
    s->phase = ABUT_PHASE_RUNNING;
    status = s->method->begin(s);
  }
  else if (takes_gap)
    status = take_gap(s, gap);
  else if (running)
    status = take_changes(s);
  if (status == ABUT_SUCCESS)
    status = abut_copy_out(s->context, "abut_strategy_next", request,
                           sizeof(s->request), &s->request);
  /* After a failure the arrays may be half way: only a new start helps. */
  if (status != ABUT_SUCCESS)
    s->phase = ABUT_PHASE_CREATED;
  return status;
}
