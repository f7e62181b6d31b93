/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nearest point of a flat triangle, in closed form.
 *
 * Area coordinates by vector products, which keep slivers accurate where the
 * normal equations would lose half of the digits. Outside, only the edges that
 * the projection lies beyond can hold the nearest point: from any other
 * feasible point one comes closer by walking towards the projection. */
#include "geometry/finish.h"

/* Edge e as midpoint and half vector, and back to local coordinates. */
static void
edge(int e, const double *t1, const double *t2, double *o, double *h)
{
  for (int i = 0; i < 3; ++i)
  {
    o[i] = 0.5 * (e == 0 ? t1[i] : e == 1 ? t1[i] + t2[i] : t2[i]);
    h[i] = 0.5 * (e == 0 ? t1[i] : e == 1 ? t2[i] - t1[i] : -t2[i]);
  }
}

static void
nearest_on_edges(const double *t1, const double *t2, const double *q,
                 const int *use, double *local)
{
  double best = INFINITY;
  for (int e = 0; e < 3; ++e)
  {
    if (!use[e])
      continue;
    double o[3], h[3], y[3], r[3];
    edge(e, t1, t2, o, h);
    const double t = segment_nearest(o, h, q);
    axpy3(o, t, h, y);
    sub3(q, y, r);
    if (dot3(r, r) < best)
    {
      best = dot3(r, r);
      local[0] = e == 0 ? 0.5 * (1. + t) : e == 1 ? 0.5 * (1. - t) : 0.;
      local[1] = e == 0 ? 0. : e == 1 ? 0.5 * (1. + t) : 0.5 * (1. - t);
    }
  }
}

void
abut_project_tri3(const double *nodes, const double *x, abut_projection *p)
{
  double t1[3], t2[3], q[3], n[3], d[2], y[3];
  sub3(nodes + 3, nodes, t1);
  sub3(nodes + 6, nodes, t2);
  sub3(x, nodes, q);
  cross3(t1, t2, n);
  p->iterations = 0;
  p->converged = 1;
  const int regular = tangent_offset(q, t1, t2, n, d);
  double local[2] = {d[0], d[1]};
  const double violation = violation3(d[0], d[1], 1);
  const int inside = regular && violation <= ABUT_EDGE_TOLERANCE;
  if (!inside)
  {
    const int use[3] = {!regular || d[1] < 0., !regular || d[0] + d[1] > 1.,
                        !regular || d[0] < 0.};
    nearest_on_edges(t1, t2, q, use, local);
  }
  else if (violation > 0.)
  {
    local[0] = clamp(local[0], 0., 1.);
    local[1] = clamp(local[1], 0., 1. - local[0]);
  }
  for (int i = 0; i < 3; ++i)
    y[i] = local[0] * t1[i] + local[1] * t2[i];
  finish3(nodes, y, t1, t2, q, local[0], local[1], 1, p);
  p->inside = (uint8_t)inside;
  p->violation = inside ? 0. : regular ? violation : p->violation;
}
