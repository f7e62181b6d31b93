/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Barrier continuation: for a falling sequence of mu, primal-dual Newton steps
 * on p g = mu that keep p > 0 and g > 0 (fraction to the boundary; Nocedal and
 * Wright, Numerical Optimization, section 19.6). All but the last mu are only
 * solved roughly: |p g - mu| <= mu. The start must have open gaps. */
#include "strategy/strategy.h"

#include <math.h>

/* Part of the way to the boundary that a step may go. */
static const double fraction = 0.995;

/* Relative errors of p g = mu: rough, to be finished by a tight solve,
 * finished, finished if rounding prevents better, and if gaps are rounding. */
static const double rough = 1, nearly = 1e-6, exact = 1e-12, rounding = 1e-3,
                    rounded_gap = 0.1;

static void
set_barrier(abut_strategy *s, double barrier)
{
  s->progress.barrier = barrier;
  s->mu = barrier * s->options.pressure_scale * s->options.length_scale;
  s->interior.error = INFINITY;
}

/* The mu that the start's pressures belong to: the mean of p g, each row
 * weighed by its force. With no pressure, barrier_start. */
static abut_status
first_barrier(abut_strategy *s, double *barrier)
{
  const abut_strategy_options *options = &s->options;
  double sum[2] = {0, 0};
  for (int32_t i = 0; i < s->n; ++i)
  {
    const double force = s->weight[i] * fmax(s->pressure[i], 0);
    sum[0] += force * s->pressure[i] * s->gap[i];
    sum[1] += force;
  }
  const abut_status status =
      abut_strategy_reduce(s, ABUT_REDUCTION_SUM, sum, 2);
  *barrier = options->barrier_start;
  if (sum[1] > 0)
    *barrier =
        sum[0] / sum[1] / (options->pressure_scale * options->length_scale);
  *barrier = fmin(fmax(*barrier, options->barrier_end), options->barrier_start);
  return status;
}

/* Rows that are not open, and the worst gap, over all ranks. */
static abut_status
count_closed(abut_strategy *s, double *n_closed, double *worst)
{
  *n_closed = 0;
  *worst = -INFINITY;
  for (int32_t i = 0; i < s->n; ++i)
  {
    *n_closed += s->gap[i] <= 0;
    *worst = fmax(*worst, -s->gap[i]);
  }
  abut_status status = abut_strategy_reduce(s, ABUT_REDUCTION_SUM, n_closed, 1);
  if (status == ABUT_SUCCESS)
    status = abut_strategy_reduce(s, ABUT_REDUCTION_MAX, worst, 1);
  *worst = -*worst;
  return status;
}

static abut_status
stop_infeasible(abut_strategy *s, double n_closed, double worst)
{
  abut_text text = abut_strategy_remark(s);
  abut_text_add(&text, "the barrier needs open gaps, but ");
  abut_text_add_integer(&text, (int64_t)n_closed);
  abut_text_add(&text, " constraints are closed, the worst with gap ");
  abut_text_add_number(&text, worst);
  return abut_strategy_stop(s, ABUT_REASON_INFEASIBLE);
}

static abut_status
ask(abut_strategy *s, bool tight)
{
  const abut_strategy_options *options = &s->options;
  const double final =
      fmin(options->final_linear_tolerance, options->linear_tolerance);
  s->matrix_changed = true;
  return abut_strategy_request_solve(
      s, tight ? final : options->linear_tolerance,
      tight && final < options->linear_tolerance);
}

static abut_status
begin(abut_strategy *s)
{
  double n_closed, worst, barrier;
  abut_status status = count_closed(s, &n_closed, &worst);
  if (status == ABUT_SUCCESS)
    status = first_barrier(s, &barrier);
  if (status != ABUT_SUCCESS)
    return status;
  if (n_closed > 0)
    return stop_infeasible(s, n_closed, worst);
  const bool rows = s->progress.n_rows > 0;
  set_barrier(s, rows ? barrier : s->options.barrier_end);
  for (int32_t i = 0; i < s->n; ++i)
    s->pressure[i] = fmax(s->pressure[i], s->mu / s->gap[i]);
  return ask(s, !rows);
}

static abut_status
solved(abut_strategy *s)
{
  double alpha = 1;
  const abut_status status =
      abut_interior_step(s, s->gap, s->dg, fraction, &alpha);
  return status != ABUT_SUCCESS ? status : abut_interior_move(s, alpha, NULL);
}

static abut_status
measure_error(abut_strategy *s, double *error)
{
  *error = 0;
  for (int32_t i = 0; i < s->n; ++i)
    *error = fmax(*error, fabs(s->pressure[i] * s->gap[i] - s->mu) / s->mu);
  return abut_strategy_reduce(s, ABUT_REDUCTION_MAX, error, 1);
}

/* The next mu, or the end of the continuation. */
static abut_status
next_barrier(abut_strategy *s)
{
  const abut_strategy_options *options = &s->options;
  s->progress.outer += 1;
  if (s->progress.barrier <= options->barrier_end)
    return abut_strategy_stop(s, ABUT_REASON_CONVERGED);
  if (s->progress.outer >= options->max_outer)
  {
    abut_text text = abut_strategy_remark(s);
    abut_text_add(&text, "the barrier is still ");
    abut_text_add_number(&text, s->progress.barrier);
    abut_text_add(&text, " after all outer iterations");
    return abut_strategy_stop(s, ABUT_REASON_STEP_LIMIT);
  }
  set_barrier(s, fmax(s->progress.barrier * options->barrier_factor,
                      options->barrier_end));
  return ask(s, false);
}

static abut_status
moved(abut_strategy *s)
{
  double n_closed, worst, error;
  abut_status status = count_closed(s, &n_closed, &worst);
  if (status == ABUT_SUCCESS)
    status = measure_error(s, &error);
  if (status == ABUT_SUCCESS)
    status = abut_interior_report(s);
  if (status != ABUT_SUCCESS)
    return status;
  if (n_closed > 0)
    return stop_infeasible(s, n_closed, worst);
  const double last_error = s->interior.error;
  const bool full = s->interior.alpha == 1;
  s->interior.error = error;
  if (s->progress.barrier > s->options.barrier_end)
    return error <= rough ? next_barrier(s) : ask(s, false);
  const bool tight =
      s->request.linear_tolerance <= s->options.final_linear_tolerance;
  const bool is_stalled = (error <= rounding && error > 0.1 * last_error)
                          || (error <= rounded_gap && error >= last_error);
  if (full && tight && (error <= exact || is_stalled))
    return next_barrier(s);
  return ask(s, full && (error <= nearly || is_stalled));
}

const abut_method abut_method_barrier = {begin, solved, moved};
