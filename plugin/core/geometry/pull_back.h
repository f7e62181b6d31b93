/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_PULL_BACK_H
#define ABUT_GEOMETRY_PULL_BACK_H

/* Local coordinates of the points of a facet that is projected into a line or
 * a plane. */

#include <abut/facet.h>

/* Unit vectors e[0], e[1] with e[0], e[1], normal right-handed; in 2D e[0] is
 * the tangent whose outward normal is `normal`. */
void abut_plane_basis(int dimension, const double *normal, double (*e)[3]);

/* Local coordinates of the point of a facet whose projection is `target`.
 * flat [n_nodes * (dimension - 1)]: the facet's nodes in the coordinates of
 * the line or plane. Newton's method from the centre. Returns nonzero if it
 * converged; then derivative [(dimension - 1)^2] (may be NULL) is that of the
 * projected point with respect to the local coordinates, column by column. */
int abut_pull_back(abut_facet_kind kind, const double *flat,
                   const double *target, double *local, double *derivative);

/* How far local coordinates are outside of the reference domain; <= 0 inside.
 */
double abut_local_violation(abut_facet_kind kind, const double *local);

#endif
