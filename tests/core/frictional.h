/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_FRICTIONAL_H
#define ABUT_TESTS_CORE_FRICTIONAL_H

/* Small dense problems with friction, for tests and benchmarks: points that
 * press on rigid planes, held by a random stiffness; and the exact law, written
 * down once more to judge what is found. */

#include <abut/dense_model.h>
#include <stdbool.h>

enum
{
  FRICTIONAL_POINTS = 5,
  FRICTIONAL_SIZE = 3 * FRICTIONAL_POINTS,
  FRICTIONAL_STARTS = 5
};

/* Point i has the unknowns i * dimension + 0 .. dimension - 1: the first along
 * its normal (gap[i] - u), the others along its tangents. */
typedef struct frictional
{
  int32_t dimension, n_points, n;
  double stiffness[FRICTIONAL_SIZE * FRICTIONAL_SIZE], force[FRICTIONAL_SIZE];
  double gap[FRICTIONAL_POINTS], coefficient[FRICTIONAL_POINTS];
  double cap[FRICTIONAL_POINTS]; /* infinite: none */
  double condition;              /* of the stiffness */
  int32_t n_plain; /* so many points, the first, have their normals only */
  const abut_friction *law; /* NULL: coulomb */
  const void *parameters;   /* of the law */
} frictional;

/* Ranges that random problems are drawn from, evenly in the logarithm. */
typedef struct frictional_ranges
{
  double coefficient[2], condition[2];
} frictional_ranges;

/* What a solve came to. */
typedef struct frictional_answer
{
  abut_status status;
  abut_reason reason;
  abut_progress progress;
  double u[FRICTIONAL_SIZE], p[FRICTIONAL_SIZE];
  uint8_t state[FRICTIONAL_SIZE];
} frictional_answer;

/* A problem of 2 to 5 points. */
frictional frictional_draw(int32_t dimension, const frictional_ranges *ranges,
                           uint64_t *seed);

/* Solve from the u, p and state of the answer, or, without from_state, from the
 * states that u and p call for. */
void frictional_solve(abut_context *context, const frictional *problem,
                      const abut_strategy_options *options, bool from_state,
                      frictional_answer *answer);

/* A random start. */
void frictional_start(const frictional *problem, uint64_t *seed,
                      frictional_answer *answer);

/* Largest violation of equilibrium and of Signorini's and Coulomb's laws, in
 * units of force and length. */
double frictional_violation(const frictional *problem, const double *u,
                            const double *p);

/* Whether two answers are the same state. */
bool frictional_same(const frictional *problem, const frictional_answer *a,
                     const frictional_answer *b);

/* What a set of problems came to. */
typedef struct frictional_count
{
  int32_t n_problems, n_runs;
  int32_t n_lost;   /* runs without an answer */
  int32_t cured[4]; /* runs by the rung that they needed */
  int32_t answers[FRICTIONAL_STARTS + 2]; /* problems by different answers */
  int32_t most_steps;
  double mean_steps;      /* linear systems */
  double worst_violation; /* of all answers */
} frictional_count;

/* Solve random problems, each from zero and from @p starts random starts. */
frictional_count frictional_survey(int32_t dimension,
                                   const frictional_ranges *ranges, int32_t n,
                                   int32_t starts, uint64_t seed);

#endif
