/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_LAW_COMPLEMENTARITY_H
#define ABUT_LAW_COMPLEMENTARITY_H

/* The complementarity laws differ only in which terms of
 *
 *     g~ = g + e + (p - pbar) / eps
 *
 * are present. A state is CLOSED when p - c g~ > 0; the residual is g~ on
 * closed rows (a = 1/eps, b = 1) and p on open ones (a = 1, b = 0): the
 * primal-dual active set method as a semismooth Newton method (Hintermueller,
 * Ito and Kunisch, SIAM J. Optim. 13, 2002). O(n). */

#include <abut/law.h>

/* Terms that a law uses. */
enum
{
  ABUT_TERM_COMPLIANCE = 1, /* 1/eps */
  ABUT_TERM_REFERENCE = 2,  /* pbar */
  ABUT_TERM_ALLOWED = 4     /* e, unilateral rows only */
};

abut_status abut_complementarity_classify(const abut_law_points *points,
                                          uint32_t terms, uint8_t *state);

abut_status abut_complementarity_linearise(const abut_law_points *points,
                                           uint32_t terms, const uint8_t *state,
                                           abut_law_linearisation *result);

#endif
