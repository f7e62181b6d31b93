/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_CLIP_H
#define ABUT_GEOMETRY_CLIP_H

/* Common parts of two facets, for mortar integrals: an interval in 2D, a
 * convex polygon in an auxiliary plane in 3D. Quadratic facets are cut into
 * linear parts first. Nothing is allocated; arguments are not checked. */

#include <abut/facet.h>

/* A part smaller than this times the smaller facet is no common part. */
#define ABUT_CLIP_SMALLEST 1e-9

/* Corners of one linear part of a facet, walked around (quads: not
 * lexicographic). */
typedef struct abut_part
{
  int n;
  double x[4][3];
} abut_part;

/* Number of linear parts: 2 for line3, 4 for tri6 and quad9, else 1. */
int abut_facet_n_parts(abut_facet_kind kind);

/* The facet's nodes at the corners of a part. */
const int8_t *abut_facet_part_corners(abut_facet_kind kind, int part);

/* Part number `part` of a facet. */
void abut_facet_part(abut_facet_kind kind, const double *nodes, int part,
                     abut_part *result);

/* Length or area of a part by its corners (warped quads: of the projection
 * along the mean normal), and its unit mean normal (zero without area). */
double abut_part_area(const abut_part *part, double *normal);

/* Common interval of two segments. */
typedef struct abut_clip2
{
  double secondary[2]; /* ends in local coordinates, ascending */
  double primary[2];   /* local coordinates of the same two points */
  double length;       /* on the secondary */
} abut_clip2;

/* Project the primary segment onto the secondary along the normals at the
 * secondary's ends, interpolated linearly; returns nonzero if the common part
 * is longer than ABUT_CLIP_SMALLEST of the shorter one.
 * secondary, primary, normals: [2 * 2]; normals need not be unit vectors. */
int abut_clip2_segments(const double *secondary, const double *primary,
                        const double *normals, abut_clip2 *clip);

enum
{
  abut_clip_max = 12 /* two quadrilaterals give 8; differences of those more */
};

/* Common polygon of two facets in a plane with the points origin + u e1 + v e2;
 * e1 x e2 = normal. */
typedef struct abut_clip3
{
  double origin[3], e1[3], e2[3], normal[3];
  int n;                           /* vertices */
  double vertex[abut_clip_max][2]; /* (u, v), counter-clockwise */
  double area;
  double centroid[2];
} abut_clip3;

typedef enum abut_clip_result
{
  ABUT_CLIP_EMPTY,
  ABUT_CLIP_POLYGON,
  ABUT_CLIP_NOT_CONVEX /* a part's projection is: cut it into triangles */
} abut_clip_result;

/* Clip part s with part m in the plane through `origin` with unit normal
 * `normal`; the polygon is dropped if its area is below ABUT_CLIP_SMALLEST of
 * the smaller projection. */
abut_clip_result abut_clip3_parts(const abut_part *s, const abut_part *m,
                                  const double *origin, const double *normal,
                                  abut_clip3 *clip);

/* Common polygon of two polygons of one plane; nonzero if its area is more than
 * the given part of the smaller one. */
int abut_clip3_intersect(const abut_clip3 *a, const abut_clip3 *b, double part,
                         abut_clip3 *common);

/* Convex pieces of a without b (of one plane), dropped below `part` of a; at
 * most b->n. Returns their number. */
int abut_clip3_subtract(const abut_clip3 *a, const abut_clip3 *b, double part,
                        abut_clip3 *pieces);

/* First corner of the diagonal (0 or 1) along which a quadrilateral is cut into
 * triangles: the one that lies within it. Triangle i has the corners (first +
 * 2 i + 0, 1, 2) modulo 4. */
int abut_part_diagonal(const abut_part *quad);

/* Common length or area of two facets of the same dimension, summed over
 * their parts, each in the plane of the secondary's part; 0 if there is none.
 * Whether they face each other and how far they are apart is the caller's
 * question. */
double abut_facet_common_area(abut_facet_kind secondary_kind,
                              const double *secondary,
                              abut_facet_kind primary_kind,
                              const double *primary);

#endif
