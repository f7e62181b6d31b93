/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The loop around abut_strategy_next() over a host's functions. */
#include "strategy/strategy.h"

static const char call[] = "abut_strategy_run";

/* Let the host carry out the request. */
static abut_status
serve(abut_strategy *s, const abut_host *host, const abut_request *request)
{
  const bool move = request->action == ABUT_ACTION_MOVE;
  /* The host writes the new gap where it is not read until next() copies it. */
  const abut_status status = move
                                 ? host->move(host->user, request, s->trial_gap)
                                 : host->solve(host->user, request);
  if (status == ABUT_SUCCESS)
    return ABUT_SUCCESS;
  abut_text text = abut_fail_begin(s->context, call);
  abut_text_add(&text, move ? "the host's move failed: "
                            : "the host's solve failed: ");
  abut_text_add(&text, abut_status_text(status));
  return ABUT_CALLBACK_FAILED;
}

static void
report(const abut_strategy *s, const abut_host *host,
       const abut_request *request)
{
  if (host->monitor != NULL)
    host->monitor(host->user, &s->progress, request);
}

abut_status
abut_strategy_run(abut_strategy *strategy, const abut_host *given,
                  abut_reason *reason)
{
  if (strategy == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_strategy *s = strategy;
  abut_host taken = {0};
  abut_status status =
      abut_copy_in(s->context, call, &taken, sizeof(taken), given);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_host *host = &taken;
  if (host->solve == NULL || host->move == NULL)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call,
                     "the host's functions are incomplete");
  if (s->phase != ABUT_PHASE_STARTED)
    return abut_fail(s->context, ABUT_WRONG_ORDER, call,
                     "the strategy has not just been started");
  abut_request request;
  status = abut_strategy_next(s, NULL, &request);
  if (status == ABUT_SUCCESS && request.action == ABUT_ACTION_STOP)
    report(s, host, &request);
  while (status == ABUT_SUCCESS && request.action != ABUT_ACTION_STOP)
  {
    const bool moves = request.action == ABUT_ACTION_MOVE;
    status = abut_strategy_agree(s, serve(s, host, &request));
    if (status == ABUT_SUCCESS)
      status = abut_strategy_next(s, s->trial_gap, &request);
    if (status == ABUT_SUCCESS && (moves || request.action == ABUT_ACTION_STOP))
      report(s, host, &request);
  }
  if (status == ABUT_SUCCESS && reason != NULL)
    *reason = request.reason;
  return status;
}
