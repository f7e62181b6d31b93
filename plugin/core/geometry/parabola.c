/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nearest point of a parabola arc y(t) = c0 + c1 t + c2 t^2, t in [-1, 1].
 *
 * phi(t) = |x - y(t)|^2 / 2 is a quartic; its derivative is the cubic
 *
 *     f(t) = 2|c2|^2 t^3 + 3 c1.c2 t^2 + (|c1|^2 - 2 q.c2) t - q.c1,  q = x-c0.
 *
 * The critical points of f split [-1, 1] into at most three intervals where f
 * is monotone; each holds at most one root, found by Newton's method guarded
 * by bisection. So the global minimum is found, whatever the shape. */
#include "geometry/kernels.h"
#include "geometry/vector.h"

typedef struct cubic
{
  double k[4];
} cubic;

static double
value(const cubic *f, double t)
{
  return f->k[0] + t * (f->k[1] + t * (f->k[2] + t * f->k[3]));
}

static double
slope(const cubic *f, double t)
{
  return f->k[1] + t * (2. * f->k[2] + t * 3. * f->k[3]);
}

/* phi(t) - phi(0) */
static double
integral(const cubic *f, double t)
{
  return t
         * (f->k[0]
            + t * (f->k[1] / 2. + t * (f->k[2] / 3. + t * f->k[3] / 4.)));
}

/* Root of f in [l, r] where f(l) <= 0 <= f(r). */
static double
bracketed_root(const cubic *f, double l, double r, int32_t *iterations)
{
  double t = 0.5 * (l + r);
  for (int i = 0; i < 80 && r - l > 1e-16; ++i)
  {
    const double v = value(f, t), s = slope(f, t);
    ++*iterations;
    if (v == 0.)
      return t;
    if (v < 0.)
      l = t;
    else
      r = t;
    double next = s > 0. ? t - v / s : l - 1.;
    if (!(next > l && next < r))
      next = 0.5 * (l + r);
    if (fabs(next - t) < 1e-16)
      return next;
    t = next;
  }
  return t;
}

/* Roots of f' within (-1, 1), in order; returns their number. */
static int
critical_points(const cubic *f, double *t)
{
  const double a = 3. * f->k[3], b = f->k[2], c = f->k[1];
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.))
    return 0;
  const double q = -(b + copysign(sqrt(discriminant), b));
  double r[2] = {2., 2.};
  if (fabs(q) < fabs(a))
    r[0] = q / a;
  if (fabs(c) < fabs(q))
    r[1] = c / q;
  if (r[0] > r[1])
  {
    const double swap = r[0];
    r[0] = r[1];
    r[1] = swap;
  }
  int n = 0;
  for (int i = 0; i < 2; ++i)
    if (fabs(r[i]) < 1.)
      t[n++] = r[i];
  return n;
}

double
abut_parabola_nearest(const double *c, const double *x, int32_t *iterations)
{
  double q[3], split[4] = {-1.};
  const double *c1 = c + 3, *c2 = c + 6;
  sub3(x, c, q);
  const cubic f = {{-dot3(q, c1), dot3(c1, c1) - 2. * dot3(q, c2),
                    3. * dot3(c1, c2), 2. * dot3(c2, c2)}};
  const int n = critical_points(&f, split + 1);
  split[n + 1] = 1.;
  double best = -1., lowest = integral(&f, -1.);
  for (int i = 0; i <= n; ++i)
  {
    const double l = split[i], r = split[i + 1];
    double t = r;
    if (value(&f, l) <= 0. && value(&f, r) >= 0.)
      t = bracketed_root(&f, l, r, iterations);
    const double phi = integral(&f, t);
    if (phi < lowest)
    {
      lowest = phi;
      best = t;
    }
  }
  return best;
}
