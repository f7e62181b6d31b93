/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Common polygon of two facets projected into a plane, as in Puso and Laursen,
 * Comput. Methods Appl. Mech. Engrg. 193 (2004), 601-629: the convex subject
 * is cut by the half-plane of each edge of the convex clip polygon (Sutherland
 * and Hodgman, Commun. ACM 17, 1974). Each cut adds at most one vertex. */
#include "geometry/clip.h"
#include "geometry/pull_back.h"
#include "geometry/vector.h"
#include <string.h>

typedef struct polygon
{
  int n;
  double x[abut_clip_max][2];
} polygon;

static double
signed_area(const polygon *p)
{
  double sum = 0.;
  for (int i = 2; i < p->n; ++i)
    sum += (p->x[i - 1][0] - p->x[0][0]) * (p->x[i][1] - p->x[0][1])
           - (p->x[i - 1][1] - p->x[0][1]) * (p->x[i][0] - p->x[0][0]);
  return 0.5 * sum;
}

/* Project a part, counter-clockwise; returns its area. */
static double
project(const abut_clip3 *c, const abut_part *part, polygon *p)
{
  p->n = part->n;
  for (int i = 0; i < part->n; ++i)
  {
    double r[3];
    sub3(part->x[i], c->origin, r);
    p->x[i][0] = dot3(r, c->e1);
    p->x[i][1] = dot3(r, c->e2);
  }
  const double area = signed_area(p);
  for (int i = 0; i < p->n / 2 && area < 0.; ++i)
    for (int d = 0; d < 2; ++d)
    {
      const double swap = p->x[i][d];
      p->x[i][d] = p->x[p->n - 1 - i][d];
      p->x[p->n - 1 - i][d] = swap;
    }
  return fabs(area);
}

/* Twice the area of (a, b, q): positive to the left of a -> b. */
static double
side(const double *a, const double *b, const double *q)
{
  return (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]);
}

static int
convex(const polygon *p, double area)
{
  for (int i = 0; i < p->n; ++i)
    if (side(p->x[i], p->x[(i + 1) % p->n], p->x[(i + 2) % p->n])
        < -1e-9 * area)
      return 0;
  return 1;
}

/* Keep what is to the left of a -> b. */
static void
cut(polygon *p, const double *a, const double *b)
{
  polygon q = {0};
  for (int i = 0; i < p->n && q.n < abut_clip_max; ++i)
  {
    const double *x = p->x[i], *y = p->x[(i + 1) % p->n];
    const double s = side(a, b, x), t = side(a, b, y);
    if (s >= 0.)
    {
      memcpy(q.x[q.n], x, sizeof(q.x[0]));
      ++q.n;
    }
    if ((s > 0. && t < 0.) || (s < 0. && t > 0.))
    {
      if (q.n == abut_clip_max)
        break;
      const double f = s / (s - t);
      for (int d = 0; d < 2; ++d)
        q.x[q.n][d] = x[d] + f * (y[d] - x[d]);
      ++q.n;
    }
  }
  *p = q;
}

static void
measure(const polygon *p, abut_clip3 *c)
{
  double sum = 0., moment[2] = {0., 0.};
  for (int i = 2; i < p->n; ++i)
  {
    const double a = 0.5 * side(p->x[0], p->x[i - 1], p->x[i]);
    sum += a;
    for (int d = 0; d < 2; ++d)
      moment[d] += a * (p->x[0][d] + p->x[i - 1][d] + p->x[i][d]) / 3.;
  }
  c->n = p->n;
  c->area = sum;
  memcpy(c->vertex, p->x, sizeof(p->x[0]) * (size_t)p->n);
  for (int d = 0; d < 2; ++d)
    c->centroid[d] = sum > 0. ? moment[d] / sum : 0.;
}

abut_clip_result
abut_clip3_parts(const abut_part *s, const abut_part *m, const double *origin,
                 const double *normal, abut_clip3 *c)
{
  polygon p = {0}, q = {0};
  memcpy(c->origin, origin, sizeof(c->origin));
  memcpy(c->normal, normal, sizeof(c->normal));
  double e[2][3];
  abut_plane_basis(3, c->normal, e);
  memcpy(c->e1, e[0], sizeof(c->e1));
  memcpy(c->e2, e[1], sizeof(c->e2));
  c->n = 0;
  c->area = c->centroid[0] = c->centroid[1] = 0.;
  const double area_s = project(c, s, &p), area_m = project(c, m, &q);
  if (!(area_s > 0. && area_m > 0.))
    return ABUT_CLIP_EMPTY;
  if (!convex(&p, area_s) || !convex(&q, area_m))
    return ABUT_CLIP_NOT_CONVEX;
  for (int i = 0; i < q.n; ++i)
    cut(&p, q.x[i], q.x[(i + 1) % q.n]);
  measure(&p, c);
  if (c->area > ABUT_CLIP_SMALLEST * min2(area_s, area_m))
    return ABUT_CLIP_POLYGON;
  c->n = 0;
  c->area = c->centroid[0] = c->centroid[1] = 0.;
  return ABUT_CLIP_EMPTY;
}

static void
set_polygon(const abut_clip3 *c, polygon *p)
{
  p->n = c->n;
  memcpy(p->x, c->vertex, sizeof(p->x[0]) * (size_t)c->n);
}

int
abut_clip3_intersect(const abut_clip3 *a, const abut_clip3 *b, double part,
                     abut_clip3 *common)
{
  polygon p;
  set_polygon(a, &p);
  for (int i = 0; i < b->n && p.n > 0; ++i)
    cut(&p, b->vertex[i], b->vertex[(i + 1) % b->n]);
  *common = *a;
  measure(&p, common);
  return common->area > part * min2(a->area, b->area);
}

/* The parts outside of one edge of b after another. */
int
abut_clip3_subtract(const abut_clip3 *a, const abut_clip3 *b, double part,
                    abut_clip3 *pieces)
{
  polygon rest;
  int n = 0;
  set_polygon(a, &rest);
  for (int i = 0; i < b->n && rest.n > 0; ++i)
  {
    const double *x = b->vertex[i], *y = b->vertex[(i + 1) % b->n];
    polygon outside = rest;
    cut(&outside, y, x);
    cut(&rest, x, y);
    pieces[n] = *a;
    measure(&outside, &pieces[n]);
    n += pieces[n].area > part * a->area;
  }
  return n;
}
