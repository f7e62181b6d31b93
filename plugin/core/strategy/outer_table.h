/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STRATEGY_OUTER_TABLE_H
#define ABUT_STRATEGY_OUTER_TABLE_H

/* Properties of each outer iteration, in one table. */

#include "strategy/outer.h"
#include "strategy/strategy.h"

typedef struct abut_outer_entry
{
  const abut_method *method;
  /* The set has settled: what next. NULL: that was all. */
  abut_status (*settled)(abut_strategy *s, abut_verdict *verdict);
  /* eps / stiffness of the first solve, if none is given; 0: the law's. */
  double first_penalty;
} abut_outer_entry;

/* Entry of an outer iteration; NULL if there is no such one. */
const abut_outer_entry *abut_outer_get(abut_outer outer);

#endif
