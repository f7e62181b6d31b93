/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Signed distances of shapes. All are convex: inside, the nearest face counts;
 * outside, the nearest of faces, edges and corners. */
#include "geometry/obstacle_shape.h"

#include "geometry/vector.h"

#include <string.h>

static void
clear(abut_shape_distance *d)
{
  memset(d, 0, sizeof(*d));
}

/* h += s (a b' + b a') / 2 */
static void
add_product(double *h, double s, const double *a, const double *b)
{
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      h[3 * i + j] += 0.5 * s * (a[i] * b[j] + b[i] * a[j]);
}

void
abut_plane_distance(const abut_shape_data *s, const double *x,
                    abut_shape_distance *d)
{
  double v[3];
  clear(d);
  sub3(x, s->shape.point, v);
  d->value = dot3(v, s->shape.axis);
  memcpy(d->gradient, s->shape.axis, sizeof(d->gradient));
}

void
abut_sphere_distance(const abut_shape_data *s, const double *x,
                     abut_shape_distance *d)
{
  double v[3];
  clear(d);
  sub3(x, s->shape.point, v);
  const double r = unit3(v, ABUT_TINY);
  d->value = r - s->shape.radius;
  if (dot3(v, v) == 0.)
  {
    d->gradient[s->shape.dimension - 1] = 1.;
    return;
  }
  memcpy(d->gradient, v, sizeof(v));
  for (int i = 0; i < 3; ++i)
    d->hessian[4 * i] = 1. / r;
  add_product(d->hessian, -1. / r, v, v);
}

/* Nearest to a face from inside: the first of the nearest ones. */
static void
inside_box(const double *q, const double *sign, abut_shape_distance *d)
{
  int nearest = 0;
  for (int i = 1; i < 3; ++i)
    if (q[i] > q[nearest])
      nearest = i;
  d->value = q[nearest];
  d->gradient[nearest] = sign[nearest];
}

void
abut_box_distance(const abut_shape_data *s, const double *x,
                  abut_shape_distance *d)
{
  double v[3], q[3], sign[3], out[3], largest = 0.;
  clear(d);
  sub3(x, s->shape.point, v);
  for (int i = 0; i < 3; ++i)
  {
    sign[i] = v[i] < 0. ? -1. : 1.;
    q[i] = fabs(v[i]) - s->half[i];
    out[i] = max2(q[i], 0.);
    largest = max2(largest, out[i]);
  }
  if (!(largest > 0.))
  {
    inside_box(q, sign, d);
    return;
  }
  for (int i = 0; i < 3; ++i)
    out[i] /= largest;
  d->value = largest * unit3(out, 0.);
  for (int i = 0; i < 3; ++i)
    d->gradient[i] = sign[i] * out[i];
  if (d->value < 1e-140)
    return;
  /* (I - n n') / distance among the components that are beyond a face. */
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (q[i] > 0. && q[j] > 0.)
        d->hessian[3 * i + j] =
            ((i == j ? 1. : 0.) - d->gradient[i] * d->gradient[j]) / d->value;
}

/* A point of the half plane and what is nearest to it. */
typedef struct profile
{
  double value;
  double n[2];      /* gradient along r and z */
  double curvature; /* of the distance along the tangent: 1/distance at a
                       corner or tip, else 0 */
  bool tip;         /* the nearest point lies on the axis */
} profile;

/* The nearest point is the corner or tip c. */
static void
nearest_corner(const double *c, double r, double z, const double *fallback,
               profile *p)
{
  double v[3] = {r - c[0], z - c[1], 0.};
  p->value = unit3(v, ABUT_TINY);
  p->curvature = 1. / p->value;
  if (v[0] == 0. && v[1] == 0.)
  {
    v[0] = fallback[0];
    v[1] = fallback[1];
    p->curvature = 0.;
  }
  p->n[0] = v[0];
  p->n[1] = v[1];
}

/* The side r n_r + z n_z = offset runs up to the end z = top, if there is one,
 * and down to the tip of a cone at the origin. `along` measures the way up the
 * side. */
static void
find_profile(const abut_shape_data *s, double r, double z, profile *p)
{
  static const double origin[2] = {0., 0.}, down[2] = {0., -1.};
  const bool cone = s->shape.kind == ABUT_OBSTACLE_CONE;
  const double *n = s->side, *c = s->corner;
  const double along = n[0] * z - n[1] * r, end = n[0] * c[1] - n[1] * c[0];
  const double beside = n[0] * r + n[1] * z - s->offset, above = z - s->top;
  p->curvature = 0.;
  p->tip = cone && along <= 0.;
  if (p->tip)
    nearest_corner(origin, r, z, down, p);
  else if ((beside > 0. && along <= end)
           || (beside <= 0. && above <= 0. && beside >= above))
  {
    p->value = beside;
    p->n[0] = n[0];
    p->n[1] = n[1];
  }
  else if ((above > 0. && r <= c[0]) || (beside <= 0. && above <= 0.))
  {
    p->value = above;
    p->n[0] = 0.;
    p->n[1] = 1.;
  }
  else
  {
    double middle[3] = {n[0], n[1] + 1., 0.};
    unit3(middle, 0.);
    nearest_corner(c, r, z, middle, p);
  }
}

/* H = curvature t t' + (n_r / r) o o' with the tangent t in the half plane and
 * the direction o around the axis, where o o' = I - a a' - e e'. At a tip the
 * limit of n_r / r is the curvature; on the axis else it is infinite or has no
 * meaning, and left out. */
static void
profile_hessian(const profile *p, int32_t dimension, double r, const double *a,
                const double *e, double *h)
{
  double t[3];
  for (int i = 0; i < 3; ++i)
    t[i] = -p->n[1] * e[i] + p->n[0] * a[i];
  add_product(h, p->curvature, t, t);
  if (dimension == 2)
    return;
  const double around = p->tip ? p->curvature : r > 0. ? p->n[0] / r : 0.;
  if (!isfinite(around))
    return;
  for (int i = 0; i < 3; ++i)
    h[4 * i] += around;
  add_product(h, -around, a, a);
  add_product(h, -around, e, e);
}

/* Length and direction of what is left of a vector without its part along the
 * axis. Far along the axis that is round-off, which need not be orthogonal. */
static double
off_axis(const abut_shape_data *s, double *e)
{
  const double *a = s->shape.axis;
  const double r = unit3(e, ABUT_TINY);
  axpy3(e, -dot3(e, a), a, e);
  if (unit3(e, ABUT_TINY) > 0.5)
    return r;
  memcpy(e, s->across, 3 * sizeof(*e));
  return 0.;
}

void
abut_revolved_distance(const abut_shape_data *s, const double *x,
                       abut_shape_distance *d)
{
  double v[3], a[3], e[3];
  clear(d);
  sub3(x, s->shape.point, v);
  memcpy(a, s->shape.axis, sizeof(a));
  double z = dot3(v, a);
  axpy3(v, -z, a, e);
  const double r = off_axis(s, e);
  /* A cylinder is symmetric about its middle. */
  if (s->shape.kind == ABUT_OBSTACLE_CYLINDER && z < 0.)
  {
    z = -z;
    for (int i = 0; i < 3; ++i)
      a[i] = -a[i];
  }
  profile p;
  find_profile(s, r, z, &p);
  d->value = p.value;
  for (int i = 0; i < 3; ++i)
    d->gradient[i] = p.n[0] * e[i] + p.n[1] * a[i];
  profile_hessian(&p, s->shape.dimension, r, a, e, d->hessian);
}
