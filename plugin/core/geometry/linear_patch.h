/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_LINEAR_PATCH_H
#define ABUT_GEOMETRY_LINEAR_PATCH_H

/* Linear patches of surface facets and their projections into a plane, for
 * integrals over common polygons (clip.h). */

#include "geometry/clip.h"

enum
{
  ABUT_MAX_LINEAR_PATCHES = 4
};

/* Linear patch of a facet: corners in the order of tri3 or quad4. */
typedef struct abut_linear_patch
{
  abut_facet_kind kind;
  double x[4][3];
  double local[4][2]; /* on the facet */
  double flat[8];     /* in the plane */
  /* Position in the plane (2), on the facet (2) and in space (3) at local
   * coordinates s, t of the patch: map[i][0] + map[i][1] s + map[i][2] t +
   * map[i][3] s t. */
  double map[7][4];
} abut_linear_patch;

/* Cut a facet into patches: at its middle nodes or, with split, a quad4 into
 * four at its middle. Returns their number. */
int abut_linear_patches(abut_facet_kind kind, const double *nodes, int split,
                        abut_linear_patch *patches);

/* The corners walked around. */
void abut_linear_patch_walk(const abut_linear_patch *patch, abut_part *part);

/* Project into the plane through origin along e[0] and e[1]: sets flat and
 * map. */
void abut_linear_patch_flatten(abut_linear_patch *patch, const double *origin,
                               double (*e)[3]);

/* The triangles of a flattened patch, cut so that they lie within it in the
 * plane; a triangle is its own. Returns their number. */
int abut_linear_patch_triangles(const abut_linear_patch *patch,
                                abut_linear_patch *result);

/* Place on a flattened patch over the point uv of the plane: local coordinates
 * on the facet, position x, and (or NULL) the ratio of areas of local
 * coordinates to areas of the plane. Zero if there is none. */
int abut_linear_patch_lift(const abut_linear_patch *patch, const double *uv,
                           double *local, double *x, double *ratio);

#endif
