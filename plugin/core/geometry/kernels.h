/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_KERNELS_H
#define ABUT_GEOMETRY_KERNELS_H

/* Kernels of the geometry without checks of their arguments, for callers that
 * have checked: kinds are legal, numbers finite and within ABUT_FACET_LIMIT. */

#include <abut/facet.h>
#include <abut/projection.h>

/* Shape functions of one facet and their derivatives: along xi and eta; xi xi,
 * eta eta, xi eta. */
typedef struct abut_shape
{
  double n[ABUT_FACET_MAX_NODES];
  double d[2][ABUT_FACET_MAX_NODES];
  double dd[3][ABUT_FACET_MAX_NODES];
} abut_shape;

void abut_shape2(abut_facet_kind kind, double xi, abut_shape *shape);
void abut_shape3(abut_facet_kind kind, double xi, double eta,
                 abut_shape *shape);

/* Local coordinates of node a of a kind: two numbers (lines: the second is
 * zero). */
const double *abut_facet_node_local(abut_facet_kind kind, int32_t a);

/* Nonzero if all n numbers are finite and within ABUT_FACET_LIMIT. */
int abut_facet_finite(const double *x, int32_t n);

/* A local coordinate outside by less than this counts as inside: a point over
 * the common edge of two facets must not fall between them by round-off. */
#define ABUT_EDGE_TOLERANCE 1e-12

/* Squared sine of the angle of two tangents below which they are parallel. */
#define ABUT_PARALLEL 1e-26

/* Nearest point of one facet; nodes as in abut_facet_project(). */
void abut_project_line2(const double *nodes, const double *x,
                        abut_projection *p);
void abut_project_line3(const double *nodes, const double *x,
                        abut_projection *p);
void abut_project_tri3(const double *nodes, const double *x,
                       abut_projection *p);
void abut_project_quad4(const double *nodes, const double *x,
                        abut_projection *p);
void abut_project_tri6(const double *nodes, const double *x,
                       abut_projection *p);
void abut_project_quad9(const double *nodes, const double *x,
                        abut_projection *p);

/* The same by kind. */
void abut_project(abut_facet_kind kind, const double *nodes, const double *x,
                  abut_projection *p);

/* Parameter in [-1, 1] of the point of the parabola c[0] + c[1] t + c[2] t^2
 * that is nearest to x: the global minimum, by all roots of a cubic. c holds
 * c[0], c[1], c[2] one after the other, three numbers each. */
double abut_parabola_nearest(const double *c, const double *x,
                             int32_t *iterations);

#endif
