/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Projection of points onto lines in the plane. */
#include "geometry/kernels.h"
#include "geometry/vector.h"

/* All results from the local coordinate of the nearest point o + y, where the
 * tangent is (tx, ty); r = x - y; smallest: squared tangent that counts as
 * none. */
static void
finish2(const double *o, const double *y, const double *t, const double *r,
        double xi, double unconstrained, double smallest, abut_projection *p)
{
  const double tt = t[0] * t[0] + t[1] * t[1];
  const double f = tt > smallest ? 1. / sqrt(tt) : 0.;
  p->normal[0] = f * t[1];
  p->normal[1] = -f * t[0];
  p->distance = sqrt(r[0] * r[0] + r[1] * r[1]);
  p->gap = f > 0. ? r[0] * p->normal[0] + r[1] * p->normal[1] : p->distance;
  const double violation = fabs(unconstrained) - 1.;
  p->inside = violation <= ABUT_EDGE_TOLERANCE;
  p->violation = p->inside ? 0. : violation;
  p->local[0] = xi;
  p->local[1] = 0.;
  p->point[0] = o[0] + y[0];
  p->point[1] = o[1] + y[1];
  p->point[2] = p->normal[2] = 0.;
}

void
abut_project_line2(const double *nodes, const double *x, abut_projection *p)
{
  const double o[2] = {nodes[0] + 0.5 * (nodes[2] - nodes[0]),
                       nodes[1] + 0.5 * (nodes[3] - nodes[1])};
  const double t[2] = {0.5 * (nodes[2] - nodes[0]),
                       0.5 * (nodes[3] - nodes[1])};
  const double q[2] = {x[0] - o[0], x[1] - o[1]};
  const double tt = t[0] * t[0] + t[1] * t[1];
  const double free_xi = tt > ABUT_TINY ? (q[0] * t[0] + q[1] * t[1]) / tt : 0.;
  const double xi = clamp(free_xi, -1., 1.);
  const double y[2] = {xi * t[0], xi * t[1]}, r[2] = {q[0] - y[0], q[1] - y[1]};
  p->iterations = 0;
  p->converged = 1;
  finish2(o, y, t, r, xi, free_xi, ABUT_TINY, p);
}

void
abut_project_line3(const double *nodes, const double *x, abut_projection *p)
{
  const double *o = nodes + 4;
  const double q[3] = {x[0] - o[0], x[1] - o[1], 0.};
  double c[3][3] = {{0.}};
  for (int i = 0; i < 2; ++i)
  {
    const double l = nodes[i] - o[i], r = nodes[2 + i] - o[i];
    c[1][i] = 0.5 * (r - l);
    c[2][i] = 0.5 * (r + l);
  }
  p->iterations = 0;
  p->converged = 1;
  const double xi = abut_parabola_nearest(c[0], q, &p->iterations);
  double y[2], t[2], r[2];
  for (int i = 0; i < 2; ++i)
  {
    y[i] = xi * (c[1][i] + xi * c[2][i]);
    t[i] = c[1][i] + 2. * xi * c[2][i];
    r[i] = q[i] - y[i];
  }
  const double tt = t[0] * t[0] + t[1] * t[1];
  const double smallest =
      max2(1e-26 * (dot3(c[1], c[1]) + dot3(c[2], c[2])), ABUT_TINY);
  /* A stationary point inside stays one in spite of round-off. */
  const double step =
      fabs(xi) < 1. || !(tt > smallest) ? 0. : (r[0] * t[0] + r[1] * t[1]) / tt;
  finish2(o, y, t, r, xi, xi + step, smallest, p);
}
