/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_NORMAL_CHANGE_H
#define ABUT_GEOMETRY_NORMAL_CHANGE_H

/* Normals of facets with their first derivatives. */

#include <abut/facet.h>

/* Normal of a facet times its area, with the derivatives
 * change[d][dimension * b + e] of component d by component e of node b; at
 * node a, or for a < 0 the integral of the normal over the facet. Components
 * are three, those of lines have zeros. */
void abut_facet_normal_change(abut_facet_kind kind, const double *nodes, int a,
                              double *normal,
                              double (*change)[3 * ABUT_FACET_MAX_NODES]);

/* Make a vector with derivatives of n unknowns one of unit length. */
void abut_unit_change(int n, double *vector,
                      double (*change)[3 * ABUT_FACET_MAX_NODES]);

#endif
