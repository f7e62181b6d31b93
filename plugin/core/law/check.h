/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_LAW_CHECK_H
#define ABUT_LAW_CHECK_H

/* Checks of a law's arguments, made before anything is written. */

#include <abut/law.h>
#include <stdbool.h>

/* Points whose gap, pressure, scale and, if with_slack, slack are there and
 * finite. */
abut_status abut_law_check_points(const abut_law_points *points,
                                  bool with_slack);

/* A result with all three arrays for the n points. */
abut_status abut_law_check_result(const abut_law_points *points,
                                  const abut_law_linearisation *result);

#endif
