/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The ladder of friction.h: what is tried where sets of stick and slip come
 * back. */
#include "strategy/friction.h"
#include "strategy/strategy.h"

#include <math.h>

enum
{
  MAX_STEPS = 60,     /* without a settled set on one rung */
  MAX_ROUNDS = 100,   /* of frozen bounds */
  MAX_CORRECTIONS = 4 /* of springs of stick */
};

/* Change of the frozen bounds, relative to the largest, that counts as 0. */
static const double settled_bound = 1e-10;

bool
abut_friction_has_ladder(const abut_friction_rows *f)
{
  return abut_friction_is_on(f) && f->rung < ABUT_RUNG_TRESCA;
}

bool
abut_friction_is_lost(abut_friction_rows *f)
{
  f->steps += 1;
  return f->steps > MAX_STEPS;
}

bool
abut_friction_is_frozen_and_lost(abut_friction_rows *f)
{
  return abut_friction_is_on(f) && f->rung == ABUT_RUNG_TRESCA
         && abut_friction_is_lost(f);
}

/* The bounds of the present pressures, into frozen; their change, relative to
 * the largest one. Collective. */
static abut_status
freeze(abut_strategy *s, double *change)
{
  abut_friction_rows *f = &s->friction;
  const abut_friction_rung rung = f->rung;
  f->rung = ABUT_RUNG_NEWTON;
  abut_status status = abut_strategy_agree(s, abut_friction_find_bounds(s));
  f->rung = rung;
  double max[2] = {0, 0};
  for (int32_t i = 0; i < f->n && status == ABUT_SUCCESS; ++i)
  {
    max[0] = fmax(max[0], fabs(f->bound[i] - f->frozen[i]));
    max[1] = fmax(max[1], f->bound[i]);
    f->frozen[i] = f->bound[i];
  }
  if (status == ABUT_SUCCESS)
    status = abut_strategy_reduce(s, ABUT_REDUCTION_MAX, max, 2);
  *change = max[1] > 0 ? max[0] / max[1] : max[0] > 0;
  return status;
}

abut_status
abut_friction_climb(abut_strategy *s, bool *goes_on)
{
  abut_friction_rows *f = &s->friction;
  abut_status status = ABUT_SUCCESS;
  f->steps = 0;
  f->rung = f->iteration == ABUT_FRICTION_RADIAL_RETURN
                ? ABUT_RUNG_END
                : (abut_friction_rung)(f->rung + 1);
  s->progress.friction_rung = (int32_t)f->rung;
  if (f->rung == ABUT_RUNG_QUARTERS)
    f->quarter = 1;
  else
    f->quarter = ABUT_FRICTION_QUARTERS;
  if (f->rung == ABUT_RUNG_TRESCA)
  {
    f->rounds = 0;
    /* Unless an answer comes after all. */
    s->progress.seen = ABUT_FAILURE_STICK_SLIP;
    for (int32_t i = 0; i < f->n; ++i)
      f->frozen[i] = 0;
    status = freeze(s, &f->change);
  }
  *goes_on = f->rung < ABUT_RUNG_END;
  return status;
}

abut_status
abut_friction_begin_tresca(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  const abut_status status = abut_friction_find_bounds(s);
  for (int32_t i = 0; i < f->n && status == ABUT_SUCCESS; ++i)
    f->frozen[i] = f->bound[i];
  f->rung = ABUT_RUNG_TRESCA;
  s->progress.friction_rung = (int32_t)f->rung;
  s->progress.seen = ABUT_FAILURE_STICK_SLIP;
  return status;
}

void
abut_friction_describe_end(const abut_friction_rows *f, abut_text *text)
{
  switch (f->iteration)
  {
  case ABUT_FRICTION_PRIMAL_DUAL:
    abut_text_add(text,
                  "states of stick and slip cycle, also with all protections");
    break;
  case ABUT_FRICTION_RADIAL_RETURN:
    abut_text_add(text, "Newton's method on the return map cycles between "
                        "states of stick and slip; primal-dual does not");
    break;
  case ABUT_FRICTION_TRESCA:
    abut_text_add(text, "Tresca's fixed point has not settled: after ");
    abut_text_add_integer(text, f->rounds);
    abut_text_add(text, " iterations the friction limits still change by ");
    abut_text_add_number(text, f->change);
    abut_text_add(text, " of the largest one");
    if (f->steps > MAX_STEPS)
      abut_text_add(text,
                    ", and no state of stick and slip is found with them");
    abut_text_add(text, "; primal-dual needs no such iterations");
    break;
  }
}

/* Springs 1e4 times as stiff as the body leave a slip of 1e-4 of the body's
 * displacement; each correction takes them to that part of it. Collective. */
static abut_status
correct_springs(abut_strategy *s, bool *goes_on)
{
  abut_friction_rows *f = &s->friction;
  double max[2] = {0, 0};
  if (f->corrections == MAX_CORRECTIONS)
    return ABUT_SUCCESS;
  abut_friction_correct_springs(s, &max[0]);
  for (int32_t i = 0; i < f->n; ++i)
    max[1] = fmax(max[1], fabs(f->pressure[i]));
  const abut_status status =
      abut_strategy_reduce(s, ABUT_REDUCTION_MAX, max, 2);
  f->corrections += 1;
  *goes_on = max[0] > settled_bound * max[1];
  return status;
}

/* The next round of Tresca's problems, until their bounds stay. */
static abut_status
settle_bounds(abut_strategy *s, bool *goes_on)
{
  abut_friction_rows *f = &s->friction;
  const abut_status status = freeze(s, &f->change);
  f->rounds += 1;
  *goes_on = f->change > settled_bound;
  if (!*goes_on)
    s->progress.seen = ABUT_FAILURE_NONE;
  if (*goes_on && f->rounds >= MAX_ROUNDS)
  {
    f->rung = ABUT_RUNG_END;
    s->progress.friction_rung = (int32_t)f->rung;
  }
  return status;
}

abut_status
abut_friction_settled(abut_strategy *s, bool *goes_on)
{
  abut_friction_rows *f = &s->friction;
  *goes_on = false;
  if (!abut_friction_is_on(f))
    return ABUT_SUCCESS;
  f->steps = 0;
  if (f->rung == ABUT_RUNG_QUARTERS && f->quarter < ABUT_FRICTION_QUARTERS)
  {
    f->quarter += 1;
    *goes_on = true;
    return ABUT_SUCCESS;
  }
  const abut_status status =
      f->rung == ABUT_RUNG_TRESCA ? settle_bounds(s, goes_on) : ABUT_SUCCESS;
  return status != ABUT_SUCCESS || *goes_on ? status
                                            : correct_springs(s, goes_on);
}
