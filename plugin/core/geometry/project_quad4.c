/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nearest point of a bilinear quadrilateral
 *
 *     y = c + a xi + b eta + d xi eta.
 *
 * A parallelogram (d lost in the round-off of the coordinates) is solved in
 * closed form. Else Newton's method from the solution for d = 0 looks for a
 * minimum inside, and failing that the nearest points of the four edges are
 * taken; these are guesses until they are proved. The proof: let y meet the
 * first-order conditions, r = x - y, z another point, D1 and D2 its local
 * distances from y, p and q the tangents half-way; then
 *
 *     |x - z|^2 - |r|^2 >= |p D1 + q D2|^2 - 2 (r.d) D1 D2,
 *     |p D1 + q D2|^2 >= 2 (|p||q| - |p.q|) |D1 D2|
 *                     >= |p x q|^2 / (|p||q|) |D1 D2|
 *
 * so y is nearest if J^2 >= 2 |a'||b'||r.d|, with J the smallest Jacobian of
 * the facet along its mean normal (linear in xi and eta: the corners decide)
 * and |a'|, |b'| the longest tangents. For a planar convex facet J > 0 alone
 * suffices. Unproved cases go to patch_project.c. */
#include "geometry/finish.h"
#include "geometry/patch.h"

enum
{
  max_steps = 8
};

/* Local coordinates beyond which Newton's method gives up: the nearest point
 * is then expected on an edge. */
static const double far_outside = 1.5;

/* |d|^2 below this times the squared coordinates is round-off. */
static const double round_off = 5e-31;

typedef struct quad4
{
  double c[3], a[3], b[3], d[3]; /* see above */
  double n[3];                   /* a x b */
  double q[3];                   /* x - c */
  double aa, bb, dd, nn, noise;  /* squares; squared round-off */
} quad4;

static void
load(const double *X, const double *x, quad4 *f)
{
  for (int i = 0; i < 3; ++i)
  {
    /* Along xi at eta = -1 and 1, then sum and difference. */
    const double l = 0.25 * (X[3 + i] - X[i]), r = 0.25 * (X[9 + i] - X[6 + i]);
    f->c[i] = 0.25 * ((X[i] + X[9 + i]) + (X[3 + i] + X[6 + i]));
    f->a[i] = l + r;
    f->d[i] = r - l;
    f->b[i] = 0.25 * ((X[6 + i] - X[i]) + (X[9 + i] - X[3 + i]));
    f->q[i] = x[i] - f->c[i];
  }
  cross3(f->a, f->b, f->n);
  f->aa = dot3(f->a, f->a);
  f->bb = dot3(f->b, f->b);
  f->dd = dot3(f->d, f->d);
  f->nn = dot3(f->n, f->n);
  f->noise = round_off * (dot3(f->c, f->c) + f->aa + f->bb);
}

/* r = x - y */
static inline void
remainder3(const quad4 *f, double xi, double eta, double *r)
{
  for (int i = 0; i < 3; ++i)
    r[i] = f->q[i] - xi * f->a[i] - eta * (f->b[i] + xi * f->d[i]);
}

static void
finish(const quad4 *f, double xi, double eta, abut_projection *p)
{
  double y[3], t1[3], t2[3];
  for (int i = 0; i < 3; ++i)
  {
    t1[i] = f->a[i] + eta * f->d[i];
    t2[i] = f->b[i] + xi * f->d[i];
    y[i] = xi * f->a[i] + eta * t2[i];
  }
  finish3(f->c, y, t1, t2, f->q, xi, eta, 0, p);
}

/* At a point where x - y is orthogonal to the facet, no more is needed. */
static void
finish_inside(const quad4 *f, double xi, double eta, abut_projection *p)
{
  double t1[3], t2[3], r[3];
  xi = clamp(xi, -1., 1.);
  eta = clamp(eta, -1., 1.);
  for (int i = 0; i < 3; ++i)
  {
    const double y = xi * f->a[i] + eta * (f->b[i] + xi * f->d[i]);
    t1[i] = f->a[i] + eta * f->d[i];
    t2[i] = f->b[i] + xi * f->d[i];
    r[i] = f->q[i] - y;
    p->point[i] = f->c[i] + y;
  }
  cross3(t1, t2, p->normal);
  unit3(p->normal, ABUT_TINY);
  p->gap = dot3(r, p->normal);
  p->distance = norm3(r);
  p->violation = 0.;
  p->inside = 1;
  p->local[0] = xi;
  p->local[1] = eta;
}

/* Nearest point of the edge where coordinate `fixed` is `side`: updates the
 * best so far. */
static void
try_edge(const quad4 *f, int fixed, double side, double *best, double *local)
{
  const double *o = fixed == 0 ? f->a : f->b, *e = fixed == 0 ? f->b : f->a;
  double h[3], w[3];
  for (int i = 0; i < 3; ++i)
  {
    h[i] = e[i] + side * f->d[i];
    w[i] = f->q[i] - side * o[i];
  }
  const double hh = dot3(h, h);
  const double t = hh > 0. ? clamp(dot3(w, h) / hh, -1., 1.) : 0.;
  axpy3(w, -t, h, w);
  const double square = dot3(w, w);
  if (square < *best)
  {
    *best = square;
    local[fixed] = side;
    local[1 - fixed] = t;
  }
}

/* Parallelogram: of the edges only those that the projection lies beyond. */
static void
project_parallelogram(const quad4 *f, double xi, double eta, abut_projection *p)
{
  const double outside = max2(fabs(xi), fabs(eta)) - 1.;
  p->converged = 1;
  if (outside <= ABUT_EDGE_TOLERANCE)
  {
    finish_inside(f, xi, eta, p);
    return;
  }
  double best = INFINITY, local[2] = {0., 0.};
  if (fabs(xi) > 1.)
    try_edge(f, 0, copysign(1., xi), &best, local);
  if (fabs(eta) > 1.)
    try_edge(f, 1, copysign(1., eta), &best, local);
  finish(f, local[0], local[1], p);
  p->inside = 0;
  p->violation = outside;
}

/* Newton's method without bounds; nonzero if it converged within the facet. */
static int
newton(const quad4 *f, double *xi, double *eta, int32_t *iterations)
{
  double s = *xi, t = *eta;
  for (int k = 0; k < max_steps; ++k)
  {
    if (!(max2(fabs(s), fabs(t)) <= far_outside))
      return 0;
    double y1[3], y2[3], r[3];
    for (int i = 0; i < 3; ++i)
    {
      y1[i] = f->a[i] + t * f->d[i];
      y2[i] = f->b[i] + s * f->d[i];
      r[i] = f->q[i] - s * f->a[i] - t * y2[i];
    }
    const double g1 = dot3(r, y1), g2 = dot3(r, y2), h11 = dot3(y1, y1),
                 h22 = dot3(y2, y2), h12 = dot3(y1, y2) - dot3(r, f->d),
                 det = h11 * h22 - h12 * h12;
    if (!(det > 1e-13 * h11 * h22))
      return 0;
    const double scale = 1. / det, ds = scale * (g1 * h22 - g2 * h12),
                 dt = scale * (g2 * h11 - g1 * h12);
    s += ds;
    t += dt;
    ++*iterations;
    /* Quadratic convergence: what is left is of the order of the square. */
    if (ds * ds * h11 + dt * dt * h22 <= 1e-17 * min2(f->aa, f->bb))
    {
      *xi = s;
      *eta = t;
      return max2(fabs(s), fabs(t)) <= 1. + ABUT_EDGE_TOLERANCE;
    }
  }
  return 0;
}

/* See the head comment. */
static int
surely_nearest(const quad4 *f, double xi, double eta)
{
  double s[3], r[3];
  cross3(f->a, f->d, s);
  const double j1 = dot3(f->n, s);
  cross3(f->d, f->b, s);
  const double jacobian = (f->nn - fabs(j1) - fabs(dot3(f->n, s))) / f->nn;
  if (!(jacobian > 0.))
    return 0;
  const double nd = dot3(f->n, f->d);
  if (nd * nd <= f->noise * f->nn)
    return 1;
  remainder3(f, xi, eta, r);
  const double longest = 2. * sqrt((f->aa + f->dd) * (f->bb + f->dd));
  return jacobian * jacobian * f->nn >= 2. * longest * fabs(dot3(r, f->d));
}

/* No direction into the facet leads nearer to x. */
static int
first_order(const quad4 *f, const double *local)
{
  double r[3], y1[3], y2[3];
  remainder3(f, local[0], local[1], r);
  axpy3(f->a, local[1], f->d, y1);
  axpy3(f->b, local[0], f->d, y2);
  const double g[2] = {dot3(r, y1), dot3(r, y2)},
               tolerance = 1e-12 * norm3(r) * sqrt(max2(f->aa, f->bb));
  for (int i = 0; i < 2; ++i)
  {
    if (local[i] < 1. && g[i] > tolerance)
      return 0;
    if (local[i] > -1. && g[i] < -tolerance)
      return 0;
  }
  return 1;
}

void
abut_project_quad4(const double *nodes, const double *x, abut_projection *p)
{
  quad4 f;
  load(nodes, x, &f);
  p->iterations = 0;
  if (f.nn > ABUT_PARALLEL * f.aa * f.bb && f.nn > ABUT_TINY)
  {
    double s[3];
    const double scale = 1. / f.nn;
    cross3(f.q, f.b, s);
    double xi = scale * dot3(s, f.n);
    cross3(f.a, f.q, s);
    double eta = scale * dot3(s, f.n);
    if (f.dd <= f.noise)
    {
      project_parallelogram(&f, xi, eta, p);
      return;
    }
    p->converged = 1;
    if (newton(&f, &xi, &eta, &p->iterations))
    {
      if (surely_nearest(&f, xi, eta))
      {
        finish_inside(&f, xi, eta, p);
        return;
      }
    }
    else
    {
      double best = INFINITY, local[2] = {0., 0.};
      for (int e = 0; e < 4; ++e)
        try_edge(&f, e / 2, e % 2 == 0 ? -1. : 1., &best, local);
      if (first_order(&f, local) && surely_nearest(&f, local[0], local[1]))
      {
        finish(&f, local[0], local[1], p);
        return;
      }
    }
  }
  abut_patch patch;
  abut_patch_init(&patch, ABUT_FACET_QUAD4, nodes);
  abut_patch_project(&patch, x, p);
}
