/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The energy balance of a motion and the verdict on the scheme. */
#include "base/sized.h"
#include "time/scheme.h"

#include <math.h>

/* A motion with so many times the energy that there was has blown up: plain
 * trapezoid with exact contact, the worst scheme that still means something,
 * makes eight of one. */
static const double blow_up = 100;

/* Part of the energy that may get lost without a word: what modified mass and
 * the damping of the highest frequencies take from a wave that the steps
 * resolve is a half of that. */
static const double visible_loss = 0.05;

static double
sum_of(const abut_time_energy *e)
{
  return e->kinetic + e->strain + e->contact + e->dissipated - e->external_work;
}

/* Add the balance @p sum, of which @p work is that of the loads. */
static void
add(abut_time_balance *balance, double work, double sum)
{
  if (balance->n == 0)
    balance->first = balance->highest = sum;
  if (balance->n > 0 && balance->last - sum > balance->fall)
  {
    balance->fall = balance->last - sum;
    balance->fall_at = balance->n;
  }
  balance->n += 1;
  balance->last = sum;
  balance->highest = fmax(balance->highest, sum);
  /* Work that the loads take back, as gravity does of what flies up, is no
   * scale: it may be of energy that the scheme made. */
  balance->scale =
      fmax(fmax(balance->scale, balance->first + work), fabs(work) / blow_up);
  /* Relative to all energy given so far: first steps under loads give next to
   * nothing, and their errors are no part of what follows. */
  balance->gain = balance->scale > 0
                      ? (balance->highest - balance->first) / balance->scale
                      : 0;
  balance->loss =
      balance->scale > 0 ? fmax(0, balance->first - sum) / balance->scale : 0;
}

abut_status
abut_time_judge(const abut_time_scheme *given, const abut_time_energy *energy,
                abut_time_balance *balance, abut_time_verdict *verdict)
{
  abut_time_scheme scheme;
  const abut_status status = abut_time_scheme_copy_in(given, &scheme);
  if (status != ABUT_SUCCESS)
    return status;
  abut_time_energy now = {.struct_size = sizeof(now)};
  abut_time_balance sums = {.struct_size = sizeof(sums)};
  if (energy == NULL || balance == NULL || verdict == NULL
      || abut_sized_read(&now, sizeof(now), energy) != NULL
      || abut_sized_read(&sums, sizeof(sums), balance) != NULL || sums.n < 0)
    return ABUT_INVALID_ARGUMENT;
  const double sum = sum_of(&now);
  if (!isfinite(sum))
  {
    *verdict = ABUT_TIME_BLOWS_UP;
    return ABUT_SUCCESS;
  }
  add(&sums, now.external_work, sum);
  *verdict = sums.gain > blow_up         ? ABUT_TIME_BLOWS_UP
             : sums.gain > scheme.growth ? ABUT_TIME_GAINS
             : sums.loss > visible_loss && scheme.impulses == 0
                 ? ABUT_TIME_LOSES
                 : ABUT_TIME_STEADY;
  return abut_sized_write(balance, sizeof(sums), &sums) == NULL
             ? ABUT_SUCCESS
             : ABUT_INVALID_ARGUMENT;
}
