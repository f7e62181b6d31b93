/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Primal-dual interior point with slack, infeasible start and Mehrotra's
 * predictor-corrector (Mehrotra, SIAM J. Optim. 2, 1992; Nocedal and Wright,
 * Numerical Optimization, algorithm 16.4). One matrix and two right-hand sides
 * per step. Displacement and pressure take a common step, because the residual
 * of a quadratic energy contracts only so. */
#include "strategy/strategy.h"

#include <math.h>

/* Least start values of slack and pressure relative to their scales: with
 * pressures to begin with, and without. */
static const double warm_floor = 1e-3, cold_slack = 0.03, cold_pressure = 0.1;

/* Part of the residual that may be left at the end, and a step that is no
 * progress. */
static const double imbalance_end = 1e-8, short_step = 1e-2;

enum
{
  MAX_SHORT = 5 /* short steps in a row before giving up */
};

/* sum w (p + alpha dp) (z + alpha dz) / sum w over all ranks. */
static abut_status
average_product(abut_strategy *s, double alpha, double *average)
{
  double sum[2] = {0, 0};
  for (int32_t i = 0; i < s->n; ++i)
  {
    sum[0] += s->weight[i] * (s->pressure[i] + alpha * s->dp[i])
              * (s->slack[i] + alpha * s->dz[i]);
    sum[1] += s->weight[i];
  }
  const abut_status status =
      abut_strategy_reduce(s, ABUT_REDUCTION_SUM, sum, 2);
  *average = sum[1] > 0 ? sum[0] / sum[1] : 0;
  return status;
}

/* Ask for the predictor: the full Newton step towards mu = 0. The linear
 * solver's error must fall with mu, or it would drown the corrector. */
static abut_status
predict(abut_strategy *s)
{
  const abut_strategy_options *options = &s->options;
  const abut_interior *interior = &s->interior;
  const double final =
      fmin(options->final_linear_tolerance, options->linear_tolerance);
  const double progress =
      interior->start > 0 ? interior->average / interior->start : 0;
  s->mu = 0;
  s->interior.corrector = false;
  s->matrix_changed = true;
  return abut_strategy_request_solve(
      s, fmax(final, options->linear_tolerance * fmin(progress, 1)), false);
}

static void
report_barrier(abut_strategy *s)
{
  s->progress.barrier = s->interior.average
                        / (s->options.pressure_scale * s->options.length_scale);
}

/* Without any pressure to begin with, the predictor's changes only serve to
 * find a better start (restart()). */
static abut_status
look_for_pressure(abut_strategy *s)
{
  double largest = 0;
  for (int32_t i = 0; i < s->n; ++i)
    largest = fmax(largest, s->pressure[i]);
  const abut_status status =
      abut_strategy_reduce(s, ABUT_REDUCTION_MAX, &largest, 1);
  s->interior.cold = s->progress.n_rows > 0 && largest <= 0;
  return status;
}

/* Measure the products of the start, from which the path to 0 is counted. */
static abut_status
start_path(abut_strategy *s)
{
  const abut_status status = average_product(s, 0, &s->interior.average);
  if (status != ABUT_SUCCESS)
    return status;
  s->interior.start = s->interior.average;
  report_barrier(s);
  return predict(s);
}

static abut_status
begin(abut_strategy *s)
{
  abut_status status = look_for_pressure(s);
  const double pressure =
      s->options.pressure_scale * (s->interior.cold ? 1 : warm_floor);
  for (int32_t i = 0; i < s->n; ++i)
  {
    s->slack[i] = fmax(s->gap[i], warm_floor * s->options.length_scale);
    s->pressure[i] = fmax(s->pressure[i], pressure);
  }
  s->interior.imbalance = 1;
  return status == ABUT_SUCCESS ? start_path(s) : status;
}

/* Start again from the sizes that pressure and slack would have after the
 * first predictor (Nocedal and Wright, end of section 16.6); the displacement
 * stays. One linear system that saves two or three. */
static abut_status
restart(abut_strategy *s)
{
  const double slack = cold_slack * s->options.length_scale;
  const double pressure = cold_pressure * s->options.pressure_scale;
  for (int32_t i = 0; i < s->n; ++i)
  {
    s->slack[i] = fmax(slack, fabs(s->slack[i] + s->dz[i]));
    s->pressure[i] = fmax(pressure, fabs(s->pressure[i] + s->dp[i]));
  }
  s->interior.cold = false;
  return start_path(s);
}

/* The corrector's right-hand side: centring by Mehrotra's rule and the second
 * order term of the predictor. */
static abut_status
correct(abut_strategy *s)
{
  double alpha, after;
  abut_status status = abut_interior_step(s, s->slack, s->dz, 1, &alpha);
  if (status == ABUT_SUCCESS)
    status = average_product(s, alpha, &after);
  if (status != ABUT_SUCCESS)
    return status;
  const double now = s->interior.average;
  const double ratio = now > 0 ? fmax(after, 0) / now : 0;
  const double target = ratio * ratio * ratio * now;
  for (int32_t i = 0; i < s->n; ++i)
    s->residual[i] += s->dz[i] * s->dp[i] - target;
  s->interior.corrector = true;
  s->request.action = ABUT_ACTION_SOLVE_AGAIN;
  s->request.matrix_changed = 0;
  return ABUT_SUCCESS;
}

static abut_status
solved(abut_strategy *s)
{
  for (int32_t i = 0; i < s->n; ++i)
    s->dz[i] = s->dg[i] + s->gap[i] - s->slack[i];
  if (s->interior.cold)
    return restart(s);
  if (!s->interior.corrector)
    return correct(s);
  const abut_interior *interior = &s->interior;
  const double left =
      interior->start > 0 ? interior->average / interior->start : 0;
  double alpha = 1;
  const abut_status status =
      abut_interior_step(s, s->slack, s->dz, fmax(0.995, 1 - left), &alpha);
  return status != ABUT_SUCCESS ? status
                                : abut_interior_move(s, alpha, s->slack);
}

/* Largest difference of gap and slack over all ranks. */
static abut_status
measure_infeasibility(abut_strategy *s, double *infeasibility)
{
  *infeasibility = 0;
  for (int32_t i = 0; i < s->n; ++i)
    *infeasibility = fmax(*infeasibility, fabs(s->gap[i] - s->slack[i]));
  return abut_strategy_reduce(s, ABUT_REDUCTION_MAX, infeasibility, 1);
}

static abut_status
give_up(abut_strategy *s, abut_reason reason, const char *what)
{
  abut_text text = abut_strategy_remark(s);
  abut_text_add(&text, what);
  abut_text_add(&text, ", mean p z relative to the scales ");
  abut_text_add_number(&text, s->progress.barrier);
  return abut_strategy_stop(s, reason);
}

static abut_status
moved(abut_strategy *s)
{
  const abut_strategy_options *options = &s->options;
  abut_interior *interior = &s->interior;
  double infeasibility;
  abut_status status = average_product(s, 0, &interior->average);
  if (status == ABUT_SUCCESS)
    status = measure_infeasibility(s, &infeasibility);
  if (status == ABUT_SUCCESS)
    status = abut_interior_report(s);
  if (status != ABUT_SUCCESS)
    return status;
  report_barrier(s);
  s->progress.outer += 1;
  if (s->progress.barrier <= options->barrier_end
      && infeasibility <= options->gap_tolerance * options->length_scale
      && interior->imbalance <= imbalance_end)
    return abut_strategy_stop(s, ABUT_REASON_CONVERGED);
  interior->n_short = interior->alpha < short_step ? interior->n_short + 1 : 0;
  if (interior->n_short > 0)
    s->progress.seen = ABUT_FAILURE_INTERIOR;
  if (interior->n_short >= MAX_SHORT)
    return give_up(s, ABUT_REASON_STAGNATION,
                   "interior point: the step lengths have become very small");
  if (s->progress.outer >= options->max_outer)
    return give_up(s, ABUT_REASON_STEP_LIMIT,
                   "interior point: not converged within max_outer iterations");
  return predict(s);
}

const abut_method abut_method_interior_point = {begin, solved, moved};
