/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STRATEGY_STRATEGY_H
#define ABUT_STRATEGY_STRATEGY_H

/* The inside of a strategy, shared by the methods. A method is a table of
 * three functions that the front (strategy.c) calls when the host reports;
 * each of them leaves the next request in s->request. */

#include "base/memory.h"
#include "strategy/active_set.h"
#include "strategy/friction.h"
#include "strategy/interior.h"
#include "strategy/outer.h"

#include <abut/strategy.h>

typedef struct abut_method
{
  abut_status (*begin)(abut_strategy *s);  /* first request */
  abut_status (*solved)(abut_strategy *s); /* changes are in dp and dg */
  abut_status (*moved)(abut_strategy *s);  /* new gap is in gap */
} abut_method;

typedef enum abut_phase
{
  ABUT_PHASE_CREATED, /* start is next */
  ABUT_PHASE_STARTED, /* first call of next is next */
  ABUT_PHASE_RUNNING, /* the host carries out the request */
  ABUT_PHASE_STOPPED
} abut_phase;

struct abut_strategy
{
  abut_context *context;
  abut_strategy_options options;
  const abut_method *method;
  abut_phase phase;

  int32_t n; /* rows on this rank; all arrays below have n entries */
  abut_array numbers, bytes, ids; /* owners of the arrays below */
  /* slack, reference and compliance are NULL unless the law uses them */
  double *gap, *pressure, *slack, *reference, *compliance, *scale;
  double *weight, *stiffness;
  double *residual, *d_pressure, *d_gap;
  double *dp, *dg, *dz; /* changes; dz NULL as slack */
  double *trial_gap, *trial_pressure, *trial_scale;
  uint8_t *state, *trial_state, *bilateral;
  int64_t *id;

  double mu; /* barrier, pressure times length */
  bool matrix_changed;
  bool coefficients_changed; /* here, by the law, since the last SOLVE */
  uint64_t coefficient_sign; /* of those of the last linearisation */
  abut_request request;
  abut_progress progress;

  abut_friction_rows friction;
  abut_active_set active_set;
  abut_outer_memory outer;
  abut_interior interior;
};

/* Reduce n values over ranks in place. */
abut_status abut_strategy_reduce(abut_strategy *s, abut_reduction op,
                                 double *values, int32_t n);

/* The rank's own status, or another rank's failure, so that all of them leave a
 * collective call together. */
abut_status abut_strategy_agree(abut_strategy *s, abut_status status);

/* Points of the law at the present gap and pressure. */
abut_law_points abut_strategy_points(const abut_strategy *s);

/* Evaluate the law in the present state into residual, d_pressure, d_gap; fails
 * where the result is of no use, with the row in the message. */
abut_status abut_strategy_linearise(abut_strategy *s);

/* Linearise and request a solve, or stop at the limit of steps. */
abut_status abut_strategy_request_solve(abut_strategy *s, double tolerance,
                                        bool final);

/* Request a move by step_length times the last increment. */
abut_status abut_strategy_request_move(abut_strategy *s, double step_length);

/* Stop. */
abut_status abut_strategy_stop(abut_strategy *s, abut_reason reason);

/* Begin a remark for the context's message. */
abut_text abut_strategy_remark(abut_strategy *s);

/* eps_i = penalty * stiffness_i for all rows. */
void abut_strategy_set_penalty(abut_strategy *s, double penalty);

/* Penetration of row i: -g, or |g| of a bilateral row, 0 of a tangent; >= 0. */
double abut_strategy_penetration(const abut_strategy *s, int32_t i);

#endif
