/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_QUADRATURE_H
#define ABUT_GEOMETRY_QUADRATURE_H

/* Rules of integration over the reference domains of facets. */

#include <abut/facet.h>

enum
{
  ABUT_RULE_MAX_POINTS = 25,
  ABUT_RULE_MAX_DEGREE = 8 /* that all reference domains have */
};

/* Weights add up to the measure of the reference domain: 2, 4, or 1/2. */
typedef struct abut_rule
{
  int n;
  double local[ABUT_RULE_MAX_POINTS][2]; /* lines: the second is zero */
  double weight[ABUT_RULE_MAX_POINTS];
} abut_rule;

/* Gauss's points and weights on [-1, 1], n = 1 .. 5, exact to degree 2 n - 1.
 */
const double *abut_gauss_points(int n);
const double *abut_gauss_weights(int n);

/* Rule that is exact for polynomials up to the given degree: Gauss's on lines
 * and (in each direction) quadrilaterals, degree 0 .. 9; on triangles
 * Dunavant's with 3, 6, 12 or 16 points, degree 0 .. 8 (Int. J. Numer. Meth.
 * Engng 21 (1985) 1129). Higher degrees get the highest. */
void abut_rule_facet(abut_facet_kind kind, int degree, abut_rule *rule);

#endif
