/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_MEASURE_H
#define ABUT_GEOMETRY_MEASURE_H

/* Measures of facets without checks of the arguments. */

#include <abut/facet.h>

/* Measures and, in *vector_area, the integral of normal times area: with
 * folds it is shorter than the area. lowest_cosine: of the angles of the
 * nodes' normals with the mean normal. */
void abut_measure2(abut_facet_kind kind, const double *nodes,
                   abut_facet_measures *m, double *vector_area,
                   double *lowest_cosine);
void abut_measure3(abut_facet_kind kind, const double *nodes,
                   abut_facet_measures *m, double *vector_area,
                   double *lowest_cosine);

/* Box and ball around the points of a control polygon, which contains the
 * facet; the ball is about m->centre. dimension 2 or 3. */
void abut_measure_hull(const double *points, int n, int dimension,
                       abut_facet_measures *m);

#endif
