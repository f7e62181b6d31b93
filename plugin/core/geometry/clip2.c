/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Common interval of two segments in the plane.
 *
 * With the secondary X(xi) = c + xi h and its normals n(xi) = n0 + xi m, the
 * end y of the primary lies over xi where (X(xi) - y) x n(xi) = 0, a quadratic
 * a xi^2 + b xi + k = 0 whose root next to the linear solution is taken. Back
 * from xi to the primary the equation is linear. */
#include "geometry/clip.h"
#include "geometry/vector.h"

/* Tolerance of a parameter whose equation may be nearly degenerate. */
static const double round_off = 1e-3;

static double
cross2(const double *a, const double *b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/* Middle and half difference of two points. */
static void
split(const double *x, double *middle, double *half)
{
  for (int d = 0; d < 2; ++d)
  {
    half[d] = 0.5 * (x[2 + d] - x[d]);
    middle[d] = x[d] + half[d];
  }
}

/* Zero if no normal passes through y. */
static int
over(const double *c, const double *h, const double *n0, const double *m,
     const double *y, double *xi)
{
  const double r[2] = {c[0] - y[0], c[1] - y[1]};
  const double a = cross2(h, m), b = cross2(r, m) + cross2(h, n0),
               k = cross2(r, n0);
  const double discriminant = b * b - 4. * a * k;
  if (!(discriminant >= 0.) || b == 0.)
    return 0;
  *xi = -2. * k / (b + copysign(sqrt(discriminant), b));
  return 1;
}

int
abut_clip2_segments(const double *secondary, const double *primary,
                    const double *normals, abut_clip2 *clip)
{
  double c[2], h[2], n0[2], m[2], q[2], k[2], xi[2];
  split(secondary, c, h);
  split(primary, q, k);
  split(normals, n0, m);
  if (!over(c, h, n0, m, primary, &xi[0])
      || !over(c, h, n0, m, primary + 2, &xi[1]))
    return 0;
  clip->secondary[0] = clamp(min2(xi[0], xi[1]), -1., 1.);
  clip->secondary[1] = clamp(max2(xi[0], xi[1]), -1., 1.);
  const double hh = sqrt(h[0] * h[0] + h[1] * h[1]),
               kk = sqrt(k[0] * k[0] + k[1] * k[1]);
  clip->length = (clip->secondary[1] - clip->secondary[0]) * hh;
  if (!(clip->length > ABUT_CLIP_SMALLEST * 2. * min2(hh, kk)))
    return 0;
  for (int i = 0; i < 2; ++i)
  {
    const double s = clip->secondary[i];
    const double n[2] = {n0[0] + s * m[0], n0[1] + s * m[1]},
                 r[2] = {c[0] + s * h[0] - q[0], c[1] + s * h[1] - q[1]};
    const double slope = cross2(k, n);
    if (slope == 0.)
      return 0;
    const double t = cross2(r, n) / slope;
    /* Ends on both sides of where normals meet: nothing is over the middle. */
    if (!(fabs(t) <= 1. + round_off))
      return 0;
    clip->primary[i] = clamp(t, -1., 1.);
  }
  return 1;
}
