/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* See active_set.h for the method. */
#include "strategy/active_set.h"
#include "base/finite.h"
#include "strategy/outer_table.h"
#include "strategy/strategy.h"

#include <math.h>
#include <string.h>

enum
{
  FULL_STEP_BUDGET = 5,  /* full steps without progress before Murty's rule */
  MAX_DEFECT_SOLVES = 20 /* tight solves in vain before giving up */
};

/* Pressures and gaps this close to zero, relative to the largest pressure and
 * to the length scale, do not contradict a state. */
static const double pressure_noise = 1e-10, gap_noise = 1e-12;

/* Penalty, as a multiple of the stiffness, above which springs leave too little
 * accuracy for the rest of the matrix. */
static const double stiff = 1e10;

/* Where traction_tolerance is not above the first number, tractions that miss
 * their bound by more than the second one, relative to the largest pressure,
 * are worth one more solve, since Newton's method converges quadratically. */
static const double traction_noise = 1e-10, sharp_traction = 1e-13;

/* Result of the rows of all ranks after a step. */
typedef struct findings
{
  double max_pressure, max_gap_change, defect;    /* maxima */
  double traction_defect;                         /* max, of slipping points */
  double n_bad, bad_weight, all_weight, n_active; /* sums */
  double n_closing, n_opening;      /* sums: normals that change */
  double n_slipping;                /* sum */
  double signature[ABUT_SET_PARTS]; /* sums */
  double last_bad; /* largest number of a bad row, -1 if none */
  bool seen;       /* this set has been seen before */
} findings;

void
abut_active_set_reset(abut_active_set *set)
{
  memset(set, 0, sizeof(*set));
  set->best = INFINITY;
  set->budget = FULL_STEP_BUDGET;
}

void
abut_active_set_sign(int64_t id, double signature[ABUT_SET_PARTS])
{
  /* The finaliser of SplitMix64 scatters neighbouring numbers. */
  uint64_t x = (uint64_t)id + UINT64_C(0x9e3779b97f4a7c15);
  x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
  x ^= x >> 31;
  for (int part = 0; part < ABUT_SET_PARTS; ++part)
    signature[part] += (double)((x >> (21 * part)) & 0x1fffff);
}

/* Remember the signature; 0 if it is new, else how many steps ago it was
 * there. */
static int32_t
remember(abut_active_set *set, const double signature[ABUT_SET_PARTS])
{
  const int32_t known =
      set->n_sets < ABUT_SET_HISTORY ? set->n_sets : ABUT_SET_HISTORY;
  int32_t age = 0;
  for (int32_t back = 1; back <= known && age == 0; ++back)
    if (memcmp(set->signature[(set->n_sets - back) % ABUT_SET_HISTORY],
               signature, sizeof(set->signature[0]))
        == 0)
      age = back;
  memcpy(set->signature[set->n_sets % ABUT_SET_HISTORY], signature,
         sizeof(set->signature[0]));
  set->n_sets += 1;
  return age;
}

/* Largest values over all rows, and the progress that follows from them. */
static abut_status
find_maxima(abut_strategy *s, findings *found)
{
  enum
  {
    PRESSURE,
    GAP_CHANGE,
    DEFECT,
    TRACTION,
    PENETRATION,
    COMPLEMENTARITY,
    CHANGED,
    N_MAXIMA
  };
  double max[N_MAXIMA] = {0};
  max[CHANGED] = s->coefficients_changed;
  for (int32_t i = 0; i < s->n; ++i)
  {
    /* Derivative by a length, whatever the units of the law's c. */
    const double slope =
        fabs(s->d_gap[i]) + fabs(s->d_pressure[i]) * s->stiffness[i];
    const bool is_tangent = s->bilateral[i] == ABUT_ROW_TANGENT;
    max[PRESSURE] = abut_larger(max[PRESSURE], fabs(s->pressure[i]));
    max[GAP_CHANGE] = abut_larger(max[GAP_CHANGE], fabs(s->dg[i]));
    if (is_tangent && abut_friction_row_is_free(s, i))
      max[TRACTION] = abut_larger(max[TRACTION], fabs(s->residual[i]));
    else if (slope > 0)
      max[DEFECT] = abut_larger(max[DEFECT], fabs(s->residual[i]) / slope);
    if (is_tangent)
      continue;
    max[PENETRATION] =
        abut_larger(max[PENETRATION], abut_strategy_penetration(s, i));
    max[COMPLEMENTARITY] =
        abut_larger(max[COMPLEMENTARITY], fabs(s->pressure[i] * s->gap[i]));
  }
  const abut_status status =
      abut_strategy_reduce(s, ABUT_REDUCTION_MAX, max, N_MAXIMA);
  /* A user's law may have other slopes at the new point in the same state. */
  s->matrix_changed |= max[CHANGED] > 0;
  found->max_pressure = max[PRESSURE];
  found->max_gap_change = max[GAP_CHANGE];
  found->defect = max[DEFECT];
  found->traction_defect = max[TRACTION];
  s->progress.penetration = max[PENETRATION];
  s->progress.complementarity = max[COMPLEMENTARITY];
  return status;
}

/* The states that pressure and gap call for, into trial_state. On closed rows
 * the shifted gap is zero but for the error of the linear solver, and on open
 * rows the pressure is zero: a small c makes the answer one of the pressure
 * alone and of the gap alone, and free of the option complementarity. */
static abut_status
classify(abut_strategy *s, const findings *found)
{
  const double p_noise = pressure_noise * found->max_pressure;
  const double g_noise =
      gap_noise * s->options.length_scale
      + 0.1 * s->options.final_linear_tolerance * found->max_gap_change;
  for (int32_t i = 0; i < s->n; ++i)
  {
    const bool closed = s->state[i] != ABUT_STATE_OPEN;
    s->trial_pressure[i] = s->pressure[i] + (closed ? p_noise : 0);
    s->trial_gap[i] = s->gap[i] + (closed ? 0 : g_noise);
    s->trial_scale[i] = 1e-6 * s->stiffness[i];
  }
  abut_law_points points = abut_strategy_points(s);
  points.gap = s->trial_gap;
  points.pressure = s->trial_pressure;
  points.scale = s->trial_scale;
  const abut_status status = s->options.law->classify(&points, s->trial_state);
  return status == ABUT_SUCCESS ? abut_friction_find_states(s, p_noise, g_noise)
                                : status;
}

/* Count the bad rows of all ranks. */
static abut_status
count_bad(abut_strategy *s, findings *found)
{
  enum
  {
    N_BAD,
    BAD_WEIGHT,
    ALL_WEIGHT,
    N_ACTIVE,
    N_CLOSING,
    N_OPENING,
    N_SLIPPING,
    SIGNATURE,
    N_SUMS = SIGNATURE + ABUT_SET_PARTS
  };
  double sum[N_SUMS] = {0};
  found->last_bad = -1;
  sum[N_SLIPPING] = abut_friction_n_slipping(&s->friction);
  for (int32_t i = 0; i < s->n; ++i)
  {
    sum[ALL_WEIGHT] += s->weight[i] * fabs(s->pressure[i]);
    if (s->bilateral[i] == ABUT_ROW_TANGENT)
      continue;
    const bool closed = s->state[i] != ABUT_STATE_OPEN;
    if (closed)
    {
      sum[N_ACTIVE] += 1;
      abut_active_set_sign(s->id[i] + abut_friction_mark(s, i),
                           sum + SIGNATURE);
    }
    const bool flips = s->trial_state[i] != s->state[i];
    if (!flips && !abut_friction_point_is_bad(s, i))
      continue;
    sum[N_BAD] += 1;
    sum[N_CLOSING] += flips && !closed;
    sum[N_OPENING] += flips && closed;
    sum[BAD_WEIGHT] +=
        s->weight[i]
        * (flips ? fabs(s->pressure[i]) + s->stiffness[i] * fabs(s->gap[i])
                 : abut_friction_excess(s, i));
    found->last_bad = abut_larger(found->last_bad, (double)s->id[i]);
  }
  abut_status status = abut_strategy_reduce(s, ABUT_REDUCTION_SUM, sum, N_SUMS);
  if (status == ABUT_SUCCESS)
    status = abut_strategy_reduce(s, ABUT_REDUCTION_MAX, &found->last_bad, 1);
  found->n_bad = sum[N_BAD];
  found->bad_weight = sum[BAD_WEIGHT];
  found->all_weight = sum[ALL_WEIGHT];
  found->n_active = sum[N_ACTIVE];
  found->n_closing = sum[N_CLOSING];
  found->n_opening = sum[N_OPENING];
  found->n_slipping = sum[N_SLIPPING];
  memcpy(found->signature, sum + SIGNATURE, sizeof(found->signature));
  return status;
}

static abut_status
inspect(abut_strategy *s, findings *found)
{
  abut_status status = abut_strategy_linearise(s);
  status = abut_strategy_agree(s, status);
  if (status == ABUT_SUCCESS)
    status = find_maxima(s, found);
  if (status == ABUT_SUCCESS)
    status = abut_strategy_agree(s, classify(s, found));
  if (status == ABUT_SUCCESS)
    status = count_bad(s, found);
  if (status != ABUT_SUCCESS)
    return status;
  const int32_t age = remember(&s->active_set, found->signature);
  found->seen = age > 0 && found->n_bad > 0;
  /* Under Murty's rule sets may return without that being a cycle. */
  if (found->seen && s->active_set.budget > 0)
    s->progress.cycle_length = age;
  return ABUT_SUCCESS;
}

/* Flip all bad rows, or only the one with the largest number. */
static void
flip(abut_strategy *s, const findings *found, bool all)
{
  int change = 0;
  for (int32_t i = 0; i < s->n; ++i)
    if (s->trial_state[i] != s->state[i] && s->bilateral[i] != ABUT_ROW_TANGENT
        && (all || (double)s->id[i] == found->last_bad))
    {
      change = s->state[i] == ABUT_STATE_OPEN ? 1 : -1;
      s->state[i] = s->trial_state[i];
    }
  abut_friction_accept_states(s, all, found->last_bad);
  s->matrix_changed = true;
  if (all)
  {
    s->progress.n_changes = (int64_t)found->n_bad;
    s->progress.n_active =
        (int64_t)(found->n_active + found->n_closing - found->n_opening);
    return;
  }
  s->progress.n_changes = 1;
  s->progress.fallback_steps += 1;
  s->progress.n_active = (int64_t)found->n_active + change;
}

static bool
can_tighten(const abut_strategy *s)
{
  return !s->active_set.tight
         && s->options.final_linear_tolerance < s->options.linear_tolerance;
}

/* With friction, sets that come back climb the ladder of friction.h; a front of
 * slip that walks from node to node is progress all the same. */
static abut_status
change_frictional_set(abut_strategy *s, const findings *found, bool *goes_on)
{
  abut_active_set *set = &s->active_set;
  const bool lost = found->seen || abut_friction_is_lost(&s->friction);
  abut_status status = ABUT_SUCCESS;
  *goes_on = true;
  if (lost && can_tighten(s))
  {
    set->tight = true;
    set->n_sets = 0;
    s->friction.steps = 0;
  }
  else if (lost)
  {
    status = abut_friction_climb(s, goes_on);
    abut_active_set_reset(set);
    set->tight = true;
  }
  if (status == ABUT_SUCCESS && *goes_on)
    flip(s, found, true);
  return status;
}

/* Change the set according to the rules in active_set.h. */
static void
change_set(abut_strategy *s, const findings *found)
{
  abut_active_set *set = &s->active_set;
  bool all = true;
  if (found->n_bad < set->best)
  {
    if (set->budget == 0)
      set->n_sets = 0;
    set->best = found->n_bad;
    set->budget = FULL_STEP_BUDGET;
  }
  else if ((found->seen || set->budget == 0) && can_tighten(s))
  {
    set->tight = true;
    set->budget = FULL_STEP_BUDGET;
    set->n_sets = 0;
  }
  else if (found->seen || set->budget == 0)
  {
    set->budget = 0;
    all = false;
  }
  else
    set->budget -= 1;
  flip(s, found, all);
}

/* Rows that flicker between the states because both p and g vanish there must
 * not keep the method from stopping. */
static bool
only_flickers(const abut_strategy *s, const findings *found)
{
  return (found->seen || s->active_set.budget == 0)
         && found->bad_weight
                <= 1e-3 * s->options.gap_tolerance * found->all_weight;
}

/* So few rows changed, measured by the length of the set's rim, that the next
 * solve is likely the last: it may as well be an accurate one. */
static bool
nearly_settled(const abut_strategy *s)
{
  const double n_changes = (double)s->progress.n_changes;
  return s->progress.step > 0 && abut_law_solves_once(s->options.law)
         && 50 * n_changes * n_changes <= (double)s->progress.n_active;
}

static double
tolerance_of(const abut_strategy *s)
{
  const abut_strategy_options *options = &s->options;
  return s->active_set.tight || s->progress.n_rows == 0 || nearly_settled(s)
             ? fmin(options->linear_tolerance, options->final_linear_tolerance)
             : options->linear_tolerance;
}

static abut_status
begin(abut_strategy *s)
{
  abut_active_set_reset(&s->active_set);
  return abut_strategy_request_solve(s, tolerance_of(s), false);
}

static abut_status
solved(abut_strategy *s)
{
  for (int32_t i = 0; i < s->n; ++i)
    /* A prescribed pressure is met exactly, whatever the linear solver did. */
    s->pressure[i] += s->d_gap[i] == 0 && s->d_pressure[i] != 0
                              && !abut_friction_row_is_free(s, i)
                          ? -s->residual[i] / s->d_pressure[i]
                          : s->dp[i];
  return abut_strategy_request_move(s, 1);
}

/* No state of stick and slip was found, which does not mean that there is none.
 */
static abut_status
stop_without_state(abut_strategy *s)
{
  abut_text text = abut_strategy_remark(s);
  abut_friction_describe_end(&s->friction, &text);
  s->progress.seen = ABUT_FAILURE_STICK_SLIP;
  s->progress.friction_rung = ABUT_RUNG_END;
  return abut_strategy_stop(s, ABUT_REASON_STAGNATION);
}

/* The set has settled and the laws hold: done, or the next round of a cure. */
static abut_status
settle_friction(abut_strategy *s, abut_reason reason)
{
  bool goes_on = false;
  const abut_status status = abut_friction_settled(s, &goes_on);
  if (status != ABUT_SUCCESS)
    return status;
  if (s->friction.rung == ABUT_RUNG_END)
    return stop_without_state(s);
  if (!goes_on)
    return abut_strategy_stop(s, reason);
  abut_active_set_reset(&s->active_set);
  return abut_strategy_request_solve(s, s->options.final_linear_tolerance,
                                     false);
}

/* The law must hold, too, when the set has settled: a user's law need not be
 * linear within a state, and the linear solver may have failed its promise. */
static abut_status
finish(abut_strategy *s, const findings *found, abut_reason reason)
{
  abut_active_set *set = &s->active_set;
  const double final = s->options.final_linear_tolerance;
  const double limit = s->options.gap_tolerance * s->options.length_scale;
  if (s->request.linear_tolerance > final)
  {
    set->defect = INFINITY;
    return abut_strategy_request_solve(s, final, true);
  }
  const double allowed = s->options.traction_tolerance;
  if (found->defect <= limit
      && found->traction_defect <= allowed * found->max_pressure)
  {
    if (set->polished || allowed > traction_noise
        || found->traction_defect <= sharp_traction * found->max_pressure)
      return settle_friction(s, reason);
    set->polished = true;
    return abut_strategy_request_solve(s, final, s->request.final_solve);
  }
  const double defect = found->defect + found->traction_defect;
  set->n_defect = defect > 0.5 * set->defect ? set->n_defect + 1 : 0;
  set->defect = defect;
  s->friction.steps += 1;
  if (set->n_defect < MAX_DEFECT_SOLVES)
    return abut_strategy_request_solve(
        s, fmin(final, s->options.linear_tolerance), s->request.final_solve);
  if (abut_friction_has_ladder(&s->friction))
  {
    bool goes_on = false;
    const abut_status status = abut_friction_climb(s, &goes_on);
    abut_active_set_reset(set);
    if (status != ABUT_SUCCESS)
      return status;
    return goes_on ? abut_strategy_request_solve(s, final, false)
                   : stop_without_state(s);
  }
  abut_text text = abut_strategy_remark(s);
  abut_text_add(&text, "the contact law is violated by a length of ");
  abut_text_add_number(&text, found->defect);
  abut_text_add(&text, " which further solves do not lower");
  /* A law of the user's own may not be met for reasons of its own. */
  if (abut_law_solves_once(s->options.law)
      && abut_law_find(s->options.law->name) == s->options.law)
    s->progress.seen = s->progress.penalty > stiff ? ABUT_FAILURE_PENALTY
                                                   : ABUT_FAILURE_LINEAR_SOLVER;
  return abut_strategy_stop(s, ABUT_REASON_STAGNATION);
}

/* The set has settled: continue with the outer iteration, if any. */
static abut_status
settled(abut_strategy *s, const findings *found)
{
  abut_verdict verdict = {false, ABUT_REASON_CONVERGED};
  abut_status status = ABUT_SUCCESS;
  s->progress.n_changes = 0;
  s->progress.n_active = (int64_t)found->n_active;
  s->progress.outer += 1;
  const abut_outer_entry *outer = abut_outer_get(s->options.law->outer);
  if (outer->settled != NULL)
    status = outer->settled(s, &verdict);
  if (status != ABUT_SUCCESS)
    return status;
  if (!verdict.go_on)
    return finish(s, found, verdict.reason);
  if (s->progress.outer >= s->options.max_outer)
  {
    abut_text text = abut_strategy_remark(s);
    abut_text_add(&text, "not converged after ");
    abut_text_add_integer(&text, s->progress.outer);
    abut_text_add(&text, " outer iterations");
    return abut_strategy_stop(s, ABUT_REASON_STEP_LIMIT);
  }
  abut_active_set_reset(&s->active_set);
  return abut_strategy_request_solve(s, tolerance_of(s), false);
}

static abut_status
moved(abut_strategy *s)
{
  findings found;
  abut_status status = inspect(s, &found);
  if (status != ABUT_SUCCESS)
    return status;
  s->progress.n_slipping = (int64_t)found.n_slipping;
  if (found.n_bad == 0 || only_flickers(s, &found))
    return settled(s, &found);
  if (abut_law_updates_multipliers(s->options.law)
      && s->options.adaptive_penalty)
    status = abut_multiplier_update(s);
  if (status != ABUT_SUCCESS)
    return status;
  bool goes_on = true;
  if (abut_friction_has_ladder(&s->friction))
    status = change_frictional_set(s, &found, &goes_on);
  else if (abut_friction_is_frozen_and_lost(&s->friction))
    goes_on = false;
  else
    change_set(s, &found);
  if (status != ABUT_SUCCESS)
    return status;
  return goes_on ? abut_strategy_request_solve(s, tolerance_of(s), false)
                 : stop_without_state(s);
}

const abut_method abut_method_active_set = {begin, solved, moved};
