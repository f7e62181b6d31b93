/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_FINISH_H
#define ABUT_GEOMETRY_FINISH_H

/* The last stage of every projection onto a surface facet: all results from
 * the local coordinates of the nearest point. Positions are relative to
 * `origin`. */

#include "geometry/kernels.h"
#include "geometry/vector.h"

static inline double
violation3(double xi, double eta, int triangle)
{
  return triangle ? max2(max2(-xi, -eta), xi + eta - 1.)
                  : max2(fabs(xi), fabs(eta)) - 1.;
}

/* Tangential offset of r in multiples of the tangents t1 and t2: the solution
 * of min |r - d[0] t1 - d[1] t2|. n = t1 x t2. Returns zero and the two
 * separate solutions if the tangents are parallel. */
static inline int
tangent_offset(const double *r, const double *t1, const double *t2,
               const double *n, double *d)
{
  const double nn = dot3(n, n), t11 = dot3(t1, t1), t22 = dot3(t2, t2);
  if (nn > ABUT_PARALLEL * t11 * t22 && nn > ABUT_TINY)
  {
    double s[3];
    cross3(r, t2, s);
    d[0] = dot3(s, n) / nn;
    cross3(t1, r, s);
    d[1] = dot3(s, n) / nn;
    return 1;
  }
  d[0] = t11 > 0. ? dot3(r, t1) / t11 : 0.;
  d[1] = t22 > 0. ? dot3(r, t2) / t22 : 0.;
  return 0;
}

/* y: nearest point, t1 and t2: tangents there, x: the point. */
static inline void
finish3(const double *origin, const double *y, const double *t1,
        const double *t2, const double *x, double xi, double eta, int triangle,
        abut_projection *p)
{
  double r[3], d[2];
  sub3(x, y, r);
  cross3(t1, t2, p->normal);
  const int regular = tangent_offset(r, t1, t2, p->normal, d);
  const double violation = violation3(xi + d[0], eta + d[1], triangle);
  p->distance = norm3(r);
  if (regular)
  {
    unit3(p->normal, ABUT_TINY);
    p->gap = dot3(r, p->normal);
  }
  else
  {
    p->normal[0] = p->normal[1] = p->normal[2] = 0.;
    p->gap = p->distance;
  }
  p->inside = violation <= ABUT_EDGE_TOLERANCE;
  p->violation = p->inside ? 0. : violation;
  p->local[0] = xi;
  p->local[1] = eta;
  for (int i = 0; i < 3; ++i)
    p->point[i] = origin[i] + y[i];
}

/* Parameter in [-1, 1] of the nearest point of the segment o + t e. */
static inline double
segment_nearest(const double *o, const double *e, const double *x)
{
  double q[3];
  sub3(x, o, q);
  const double ee = dot3(e, e);
  return ee > 0. ? clamp(dot3(q, e) / ee, -1., 1.) : 0.;
}

#endif
