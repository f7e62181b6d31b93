/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_PSEUDONORMAL_H
#define ABUT_GEOMETRY_PSEUDONORMAL_H

#include "geometry/surface.h"

#include <abut/projection.h>

/* Unit normal that distinguishes the sides of a surface at the nearest point of
 * facet f (Baerentzen and Aanaes 2005): the facet's within it, the sum of the
 * two facets' on a side, the sum weighted by angles at a corner. At borders the
 * facets that are there count. Three components. */
void abut_pseudonormal(const abut_surface *surface, int32_t f,
                       const abut_projection *p, double *normal);

/* Which side of the surface x is on, by its nearest point on facet f: -1 behind
 * it, 1. */
double abut_side_of(const abut_surface *surface, int32_t f, const double *x,
                    const abut_projection *p);

/* Whether the nearest point of facet f is on a side where the surface ends, and
 * the point beyond it. */
bool abut_beyond_border(const abut_surface *surface, int32_t f,
                        const abut_projection *p);

#endif
