/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STRATEGY_INTERIOR_H
#define ABUT_STRATEGY_INTERIOR_H

/* Common part of the two interior methods: steps that stay in p > 0, s > 0,
 * where s is the gap (barrier) or the slack (interior point). */

#include <abut/strategy.h>

typedef struct abut_method abut_method;

typedef struct abut_interior
{
  double start;     /* average of p z at the start, pressure times length */
  double average;   /* the same now */
  double weight;    /* sum of the rows' weights */
  double error;     /* largest |p s - mu| / mu after the last step */
  double imbalance; /* part of the first residual that is still there, if the
                       host is linear */
  double alpha;     /* last step length */
  int32_t n_short;  /* very short steps in a row */
  bool cold;        /* the first predictor only serves to find a start */
  bool corrector;   /* the corrector's solve is under way */
} abut_interior;

extern const abut_method abut_method_barrier, abut_method_interior_point;

/* Largest alpha <= 1 with x + alpha dx >= (1 - fraction) x for p and the
 * distance s of all rows of all ranks. */
abut_status abut_interior_step(abut_strategy *s, const double *distance,
                               const double *d_distance, double fraction,
                               double *alpha);

/* Move pressures (and the slack, if it is given) and request a move of the
 * host. */
abut_status abut_interior_move(abut_strategy *s, double alpha, double *slack);

/* Fill the progress report: penetration, complementarity, rows on the contact
 * side of the central path. */
abut_status abut_interior_report(abut_strategy *s);

#endif
