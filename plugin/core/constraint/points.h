/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONSTRAINT_POINTS_H
#define ABUT_CONSTRAINT_POINTS_H

/* Functions of a set of points for the kernels of the core, in addition to its
 * interface. */

#include <abut/points.h>

/* The context that a set was made with, and its size. */
abut_context *abut_points_context(const abut_points *points);
int32_t abut_points_n(const abut_points *points);
int32_t abut_points_dimension(const abut_points *points);

/* The gaps of all components. */
double *abut_points_gaps(abut_points *points);

/* Keep the first n points: takes back what was appended after them. */
void abut_points_truncate(abut_points *points, int32_t n);

/* INVALID_ARGUMENT if a stencil has a node that is not below n_nodes. */
abut_status abut_points_check_nodes(const abut_points *points, const char *call,
                                    int32_t n_nodes);

#endif
