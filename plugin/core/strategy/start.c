/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The start of a solve: checks, memory, copies, first state. */
#include "strategy/options.h"
#include "strategy/strategy.h"

#include <math.h>
#include <string.h>

static const char call[] = "abut_strategy_start";

/* Numbers of rows go through double in reductions. */
static const int64_t max_id = INT64_C(1) << 53;

typedef struct inputs
{
  int32_t n;
  const int64_t *id;
  const double *weight, *stiffness, *gap, *pressure;
  const uint8_t *bilateral, *state;
} inputs;

static abut_status
reject(abut_strategy *s, abut_status status, int32_t i, const char *what)
{
  abut_text text = abut_fail_begin(s->context, call);
  abut_text_add(&text, "row ");
  abut_text_add_integer(&text, i);
  abut_text_add(&text, ": ");
  abut_text_add(&text, what);
  return status;
}

static abut_status
check_row(abut_strategy *s, const inputs *in, int32_t i)
{
  if (!isfinite(in->weight[i]) || !isfinite(in->stiffness[i]))
    return reject(s, ABUT_NOT_FINITE, i, "weight or stiffness is not finite");
  if (in->weight[i] <= 0 || in->stiffness[i] <= 0)
    return reject(s, ABUT_INVALID_ARGUMENT, i,
                  "weight or stiffness is not positive");
  if (!isfinite(in->gap[i])
      || (in->pressure != NULL && !isfinite(in->pressure[i])))
    return reject(s, ABUT_NOT_FINITE, i, "gap or pressure is not finite");
  if (in->id != NULL && (in->id[i] < 0 || in->id[i] >= max_id))
    return reject(s, ABUT_INVALID_ARGUMENT, i,
                  "its number is negative or 2^53 or more");
  const uint8_t last =
      abut_friction_is_on(&s->friction) ? ABUT_STATE_SLIP : ABUT_STATE_CLOSED;
  if (in->state != NULL && in->state[i] > last)
    return reject(s, ABUT_INVALID_ARGUMENT, i, "its state is not a state");
  if (in->bilateral != NULL && in->bilateral[i] != 0
      && abut_law_is_interior(s->options.law))
    return reject(s, ABUT_UNSUPPORTED, i,
                  "an equality has no interior: use another law");
  return ABUT_SUCCESS;
}

static abut_status
check_inputs(abut_strategy *s, const inputs *in)
{
  if (in->n < 0)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call, "n is negative");
  if (in->n > 0
      && (in->weight == NULL || in->stiffness == NULL || in->gap == NULL))
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call,
                     "weight, stiffness or gap is NULL");
  abut_status status = ABUT_SUCCESS;
  for (int32_t i = 0; i < in->n && status == ABUT_SUCCESS; ++i)
    status = check_row(s, in, i);
  return status;
}

/* Room for the arrays that the law uses in three blocks; others are NULL. */
static abut_status
place_arrays(abut_strategy *s, int32_t n)
{
  const abut_law *law = s->options.law;
  const bool has_slack = abut_law_is_interior(law),
             has_compliance = abut_law_has_penalty(law),
             has_reference = abut_law_updates_multipliers(law);
  struct
  {
    double **at;
    bool is_used;
  } numbers[] = {{&s->gap, true},
                 {&s->pressure, true},
                 {&s->slack, has_slack},
                 {&s->reference, has_reference},
                 {&s->compliance, has_compliance},
                 {&s->scale, true},
                 {&s->weight, true},
                 {&s->stiffness, true},
                 {&s->residual, true},
                 {&s->d_pressure, true},
                 {&s->d_gap, true},
                 {&s->dp, true},
                 {&s->dg, true},
                 {&s->dz, has_slack},
                 {&s->trial_gap, true},
                 {&s->trial_pressure, true},
                 {&s->trial_scale, true}};
  uint8_t **bytes[] = {&s->state, &s->trial_state, &s->bilateral};
  const int64_t n_numbers = sizeof(numbers) / sizeof(numbers[0]);
  const int64_t n_bytes = sizeof(bytes) / sizeof(bytes[0]);
  int64_t n_used = 0;
  for (int64_t k = 0; k < n_numbers; ++k)
    n_used += numbers[k].is_used;
  abut_status status =
      abut_array_reserve(s->context, &s->numbers, 0, n_used * n);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->bytes, 0, n_bytes * n);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->ids, 0, n);
  if (status != ABUT_SUCCESS)
    return status;
  s->n = n;
  s->id = s->ids.data;
  /* Without rows there are no blocks to point into. */
  double *next = n > 0 ? s->numbers.data : NULL;
  for (int64_t k = 0; k < n_numbers; ++k)
  {
    *numbers[k].at = numbers[k].is_used ? next : NULL;
    if (numbers[k].is_used && n > 0)
      next += n;
  }
  for (int64_t k = 0; k < n_bytes; ++k)
    *bytes[k] = n > 0 ? (uint8_t *)s->bytes.data + k * n : NULL;
  return ABUT_SUCCESS;
}

static void
clear(double *values, int32_t n)
{
  for (int32_t i = 0; i < n && values != NULL; ++i)
    values[i] = 0;
}

static void
copy_inputs(abut_strategy *s, const inputs *in)
{
  const double complementarity = s->options.complementarity;
  for (int32_t i = 0; i < in->n; ++i)
  {
    s->id[i] = in->id != NULL ? in->id[i] : i;
    s->weight[i] = in->weight[i];
    s->stiffness[i] = in->stiffness[i];
    s->gap[i] = in->gap[i];
    s->pressure[i] = in->pressure != NULL ? in->pressure[i] : 0;
    s->bilateral[i] = in->bilateral != NULL && in->bilateral[i] != 0;
    s->scale[i] = complementarity * in->stiffness[i];
    s->dp[i] = s->dg[i] = 0;
  }
  clear(s->slack, in->n);
  clear(s->compliance, in->n);
  clear(s->dz, in->n);
}

static abut_status
first_state(abut_strategy *s, const uint8_t *state)
{
  if (state == NULL)
  {
    const abut_law_points points = abut_strategy_points(s);
    return s->options.law->classify(&points, s->state);
  }
  for (int32_t i = 0; i < s->n; ++i)
    s->state[i] = s->bilateral[i] != 0 || state[i] != ABUT_STATE_OPEN
                      ? ABUT_STATE_CLOSED
                      : ABUT_STATE_OPEN;
  return ABUT_SUCCESS;
}

/* Totals over ranks for the first progress report. */
static abut_status
count_rows(abut_strategy *s)
{
  double sum[3] = {0, 0, abut_friction_n_slipping(&s->friction)};
  double penetration = 0;
  for (int32_t i = 0; i < s->n; ++i)
  {
    if (s->bilateral[i] == ABUT_ROW_TANGENT)
      continue;
    sum[0] += 1;
    sum[1] += s->state[i] != ABUT_STATE_OPEN;
    penetration = fmax(penetration, abut_strategy_penetration(s, i));
  }
  abut_status status = abut_strategy_reduce(s, ABUT_REDUCTION_SUM, sum, 3);
  if (status == ABUT_SUCCESS)
    status = abut_strategy_reduce(s, ABUT_REDUCTION_MAX, &penetration, 1);
  s->progress.n_rows = (int64_t)sum[0];
  s->progress.n_active = (int64_t)sum[1];
  s->progress.n_slipping = (int64_t)sum[2];
  s->progress.penetration = penetration;
  return status;
}

static void
reset(abut_strategy *s)
{
  memset(&s->progress, 0, sizeof(s->progress));
  s->progress.struct_size = sizeof(s->progress);
  memset(&s->outer, 0, sizeof(s->outer));
  memset(&s->interior, 0, sizeof(s->interior));
  memset(&s->request, 0, sizeof(s->request));
  s->request.pressure = s->pressure;
  s->request.state = s->state;
  s->request.residual = s->residual;
  s->request.d_pressure = s->d_pressure;
  s->request.d_gap = s->d_gap;
  s->request.pressure_change = s->dp;
  s->request.gap_change = s->dg;
  if (abut_friction_is_on(&s->friction))
  {
    s->request.state = s->friction.row_state;
    s->request.d_pressure = s->friction.a;
    s->request.d_gap = s->friction.b;
    s->request.block_size = s->friction.block_size;
    s->request.n_blocks = s->friction.n_blocks;
  }
  s->mu = 0;
  s->matrix_changed = true;
  for (int32_t i = 0; i < s->n; ++i)
    s->state[i] = ABUT_STATE_OPEN;
  const double penalty = abut_strategy_first_penalty(&s->options);
  if (penalty > 0)
    abut_strategy_set_penalty(s, penalty);
}

/* The first multipliers are what an update makes of the starting pressures. */
static abut_status
first_reference(abut_strategy *s)
{
  if (!abut_law_updates_multipliers(s->options.law))
    return ABUT_SUCCESS;
  for (int32_t i = 0; i < s->n; ++i)
    s->reference[i] =
        s->bilateral[i] != 0 ? s->pressure[i] : fmax(s->pressure[i], 0);
  return abut_multiplier_project(s, s->reference);
}

abut_status
abut_strategy_start(abut_strategy *strategy, int32_t n, const int64_t *id,
                    const double *weight, const double *stiffness,
                    const uint8_t *bilateral, const double *gap,
                    const double *pressure, const uint8_t *state)
{
  if (strategy == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_strategy *s = strategy;
  const inputs in = {n, id, weight, stiffness, gap, pressure, bilateral, state};
  abut_status status = abut_strategy_agree(s, check_inputs(s, &in));
  if (status != ABUT_SUCCESS)
    return status;
  s->phase = ABUT_PHASE_CREATED;
  status = abut_strategy_agree(s, place_arrays(s, n));
  if (status == ABUT_SUCCESS)
  {
    copy_inputs(s, &in);
    status = abut_friction_start(s);
  }
  if (status == ABUT_SUCCESS)
  {
    reset(s);
    status = first_reference(s);
    if (status == ABUT_SUCCESS && !abut_law_is_interior(s->options.law))
      status = first_state(s, state);
    if (status == ABUT_SUCCESS)
      status = abut_friction_first_state(s, state);
  }
  status = abut_strategy_agree(s, status);
  if (status == ABUT_SUCCESS)
    status = count_rows(s);
  if (status == ABUT_SUCCESS)
    s->phase = ABUT_PHASE_STARTED;
  return status;
}
