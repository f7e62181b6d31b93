/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STRATEGY_OUTER_H
#define ABUT_STRATEGY_OUTER_H

/* Outer iterations around the active set: what to do when it has settled. */

#include <abut/strategy.h>

/* Data that an outer iteration keeps between its steps. */
typedef struct abut_outer_memory
{
  double gap_error;   /* of the last outer step, length */
  double merit;       /* worst error over its tolerance, last outer step */
  int32_t n_stagnant; /* outer steps in a row without contraction */
} abut_outer_memory;

/* Answer of an outer iteration, which is called with: converged. */
typedef struct abut_verdict
{
  bool go_on;         /* the problem was changed: solve again */
  abut_reason reason; /* else: why to stop */
} abut_verdict;

/* Quadratic penalty: eps grows until the penetration is small. */
abut_status abut_penalty_settled(abut_strategy *s, abut_verdict *verdict);

/* Method of multipliers: pbar <- p. */
abut_status abut_multiplier_settled(abut_strategy *s, abut_verdict *verdict);

/* Replace values [n] by the nearest ones in the space of the multipliers, if
 * there is such a space. Collective. */
abut_status abut_multiplier_project(abut_strategy *s, double *value);

/* pbar <- max(p, 0), without the clipping for bilateral rows; with a space of
 * multipliers pbar <- pbar + projection of that change. Collective. */
abut_status abut_multiplier_update(abut_strategy *s);

#endif
