/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_LAW_INTERIOR_H
#define ABUT_LAW_INTERIOR_H

/* Common functions of the two interior laws. */

#include <abut/law.h>

/* CLOSED where p > c s, that is on the contact side of the central path; s is
 * the array distance[n]. For reports only. */
void abut_interior_classify(const abut_law_points *points,
                            const double *distance, uint8_t *state);

#endif
