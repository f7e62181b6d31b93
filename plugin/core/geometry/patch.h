/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_PATCH_H
#define ABUT_GEOMETRY_PATCH_H

/* A surface facet as a polynomial, for the general projection:
 *
 *     y = c0 + c1 xi + c2 eta + c3 xi eta + c4 xi^2 + c5 eta^2
 *       + c6 xi^2 eta + c7 xi eta^2 + c8 xi^2 eta^2
 *
 * with 4 (quad4), 6 (tri6) or 9 terms (quad9), relative to `origin`. */

#include <abut/projection.h>

typedef struct abut_patch
{
  double origin[3];
  double c[9][3];
  int n_terms;
  int triangle;
  double size; /* bound of the distance of two points */
} abut_patch;

/* Point and derivatives at (s, t). */
typedef struct abut_patch_point
{
  double y[3], y1[3], y2[3], y11[3], y22[3], y12[3];
} abut_patch_point;

void abut_patch_init(abut_patch *patch, abut_facet_kind kind,
                     const double *nodes);
void abut_patch_evaluate(const abut_patch *patch, double s, double t,
                         abut_patch_point *point);

/* Nearest point on the edges alone; x relative to the origin. Returns the
 * objective of abut_patch_objective(). */
double abut_patch_nearest_on_edges(const abut_patch *patch, const double *x,
                                   double *local, int32_t *iterations);

/* |x - y|^2/2 - |x|^2/2, without the cancellation that x far away causes. */
double abut_patch_objective(const double *x, const double *y);

/* The largest component of the gradient that leads into the facet from the
 * point at local (on the edge; inside: the largest of all), as a distance. */
double abut_patch_descent(const abut_patch *patch, const double *x,
                          const double *local, const abut_patch_point *point);

/* Newton's method with a shifted Hessian within the reference domain, from
 * local, at most n_steps; returns nonzero when it converged to a stationary
 * point inside. */
int abut_patch_descend(const abut_patch *patch, const double *x, int n_steps,
                       double *local, double *objective, int32_t *iterations);

/* The whole search for the global minimum; absolute: the point. */
void abut_patch_project(const abut_patch *patch, const double *absolute,
                        abut_projection *p);

#endif
