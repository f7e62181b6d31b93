/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STRATEGY_FRICTION_H
#define ABUT_STRATEGY_FRICTION_H

/* Friction within a strategy: points whose normal row is followed by the rows
 * of their tangents. Rows keep the normal law's numbers; what friction makes of
 * them stands here as one block for each point.
 *
 * Where sets of stick and slip come back, a ladder is climbed: the other
 * derivative of the bound where nothing presses; the coefficient in four rounds
 * of a quarter each; Tresca's problem, with the bound frozen in each round;
 * then there is no answer. The iterations of textbooks are parts of this: the
 * radial return has its own linearisation and no ladder, Tresca's fixed point
 * begins on that rung. */

#include "base/memory.h"
#include "base/text.h"

#include <abut/strategy.h>

enum
{
  /* Value of abut_strategy's array bilateral: a tangent of the point before it.
   * The law sees an equality, and its result is replaced. */
  ABUT_ROW_TANGENT = 2,
  ABUT_FRICTION_QUARTERS = 4
};

/* Where on the ladder a solve is. */
typedef enum abut_friction_rung
{
  ABUT_RUNG_NEWTON,   /* as it is meant to go */
  ABUT_RUNG_BOUND,    /* no derivative of the bound where p <= 0 */
  ABUT_RUNG_QUARTERS, /* the coefficient grows */
  ABUT_RUNG_TRESCA,   /* frozen bounds */
  ABUT_RUNG_END
} abut_friction_rung;

typedef struct abut_friction_rows
{
  /* Arguments of abut_strategy_set_friction(); law is NULL without friction. */
  const abut_friction *law;
  const void *parameters;
  int32_t n, m, blocks; /* points, their tangents, numbers of these blocks */
  bool has_cap;
  abut_array given, given_rows, given_bytes; /* owners of the next arrays */
  double *coefficient, *cap, *committed;     /* [n], [n], [m] */
  int32_t *first;                            /* [n] row of the normal */
  uint8_t *n_tangents;                       /* [n] */
  uint8_t *tangent;                          /* [m] abut_tangent */
  int32_t n_rivals;
  int32_t *rival_point, *rival_row; /* [n_rivals] */

  /* Made at the start of a solve. */
  abut_array numbers, bytes;
  double *pressure, *scale, *bound, *d_bound, *frozen; /* [n] */
  double *slip, *traction, *reference, *compliance;    /* [m] */
  double *anchor; /* [m] tractions that springs of stick begin from */
  double *residual, *d_pressure, *direction, *turned; /* [m] */
  double *d_traction, *d_slip;                        /* [blocks] */
  double *a, *b;       /* blocks of all points, those without friction, too */
  uint8_t *block_size; /* [n_blocks] */
  int32_t n_blocks;
  int64_t block_numbers;
  uint8_t *state, *trial; /* [n] */
  uint8_t *shares;        /* [n] nonzero: another contact holds its node, too */
  uint8_t *row_state;     /* [rows] with SLIP, for the host */
  double *row_excess;     /* [rows] of bad points, a pressure */
  uint8_t *row_changes;   /* [rows] nonzero at normals whose state is bad */
  uint8_t *row_mark;      /* [rows] state and direction, for signatures */

  abut_friction_iteration iteration;
  abut_friction_rung rung;
  int32_t quarter; /* of the coefficient, 1 .. 4 */
  int32_t steps;   /* since the last rung */
  double change;   /* of the frozen bounds in the last round, relative */
  int32_t rounds;
  int32_t corrections; /* of the springs of stick */
} abut_friction_rows;

/* Whether there is friction, on whatever rank. */
static inline bool
abut_friction_is_on(const abut_friction_rows *f)
{
  return f->law != NULL;
}

void abut_friction_prepare(abut_friction_rows *f);
void abut_friction_release(abut_context *context, abut_friction_rows *f);

/* Report the error of point i, and return the status. */
abut_status abut_friction_reject(abut_strategy *s, abut_status status,
                                 int32_t i, const char *what);

/* Memory and marks for the rows that were copied into the strategy. */
abut_status abut_friction_start(abut_strategy *s);

/* Starting states, by the host's (may be NULL) or by what p and s call for. */
abut_status abut_friction_first_state(abut_strategy *s, const uint8_t *state);

/* Pressures, slips and tractions by point, and the bounds that belong to them.
 */
abut_status abut_friction_find_bounds(abut_strategy *s);

/* Residual of the tangents, blocks of all points: what the normal law gave must
 * stand in the rows. */
abut_status abut_friction_evaluate(abut_strategy *s);

/* States that traction and slip call for, after the normal law's trial states;
 * noise: pressures below it count as 0. */
abut_status abut_friction_find_states(abut_strategy *s, double pressure_noise,
                                      double slip_noise);

/* The states found become those of the next linearisation, of all points or of
 * the one whose normal has the number @p only; normals were flipped before. */
void abut_friction_accept_states(abut_strategy *s, bool all, double only);

/* Directions of slip are those of the linearisation from here on. */
void abut_friction_store_directions(abut_friction_rows *f);

/* Whether row i is a tangent that does not stick. */
bool abut_friction_row_is_free(const abut_strategy *s, int32_t i);

/* For the normal row i, after find_states: whether its point contradicts its
 * state, by how much (a pressure), and a number that distinguishes its state
 * and direction in signatures of sets. */
bool abut_friction_point_is_bad(const abut_strategy *s, int32_t i);
double abut_friction_excess(const abut_strategy *s, int32_t i);
int64_t abut_friction_mark(const abut_strategy *s, int32_t i);

/* Whether there is friction, and rungs of the ladder that are not Tresca's,
 * whose problems have the protection against cycles that all others have. */
bool abut_friction_has_ladder(const abut_friction_rows *f);

/* Whether a rung has had steps enough. Counts the step. */
bool abut_friction_is_lost(abut_friction_rows *f);

/* The same on Tresca's rung: with so much friction a point may lift, and
 * without contact have none, so that a frozen problem need not have an answer.
 */
bool abut_friction_is_frozen_and_lost(abut_friction_rows *f);

/* Next rung; false at the end of the ladder. */
abut_status abut_friction_climb(abut_strategy *s, bool *goes_on);

/* Tresca's fixed point begins: the bounds are those of the first pressures. */
abut_status abut_friction_begin_tresca(abut_strategy *s);

/* Observations where no state was found, for a message. */
void abut_friction_describe_end(const abut_friction_rows *f, abut_text *text);

/* The set has settled: whether another round of the rung follows. */
abut_status abut_friction_settled(abut_strategy *s, bool *goes_on);

/* Springs of stick along tangents that supports or other contacts hold begin
 * from the traction that they have now; its largest change on this rank. */
void abut_friction_correct_springs(abut_strategy *s, double *change);

/* Points that slip, on this rank. */
int32_t abut_friction_n_slipping(const abut_friction_rows *f);

#endif
