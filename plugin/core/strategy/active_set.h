/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STRATEGY_ACTIVE_SET_H
#define ABUT_STRATEGY_ACTIVE_SET_H

/* Primal-dual active set method with protection against cycling.
 *
 * After each linear solve the rows are looked for whose pressure or gap
 * contradicts their state ("bad" rows). Normally all of them are flipped at
 * once, which is a semismooth Newton step (Hintermueller, Ito and Kunisch,
 * SIAM J. Optim. 13, 2002). When their number has not fallen for a while, or a
 * set of active rows returns, only the bad row with the largest number is
 * flipped (Murty's rule) until there are fewer bad rows than ever before
 * (Judice and Pires, Computers Ops. Res. 21, 1994): finite for positive
 * definite problems. O(rows) per step. */

#include <abut/strategy.h>

typedef struct abut_method abut_method;

enum
{
  ABUT_SET_HISTORY = 64, /* sets remembered to find cycles */
  ABUT_SET_PARTS = 3     /* numbers in the signature of a set */
};

typedef struct abut_active_set
{
  double signature[ABUT_SET_HISTORY][ABUT_SET_PARTS]; /* ring of past sets */
  int32_t n_sets; /* sets seen since the last reset */
  double best;    /* smallest number of bad rows so far */
  int32_t budget; /* full steps without progress that are still allowed */
  bool tight;     /* linear solves are tight, not to mistake noise for cycles */
  double defect;  /* of the law after the last tight solve, length */
  int32_t n_defect; /* tight solves that did not lower the defect */
  bool polished;    /* tractions that met their bounds roughly got a solve more
                     */
} abut_active_set;

/* Method table of all laws that have an active set. */
extern const abut_method abut_method_active_set;

/* Forget the past sets: the problem has changed. */
void abut_active_set_reset(abut_active_set *set);

/* Add row id to the signature of a set. The parts are integers below 2^22, so
 * that sums over 2^31 rows are exact in double and free of order and ranks. */
void abut_active_set_sign(int64_t id, double signature[ABUT_SET_PARTS]);

#endif
