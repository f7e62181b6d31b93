/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Newton's method for sum_a N_a(xi) flat_a = target. Linear facets and
 * parallelograms need one step; the projection of a convex quadrilateral
 * converges from its centre. */
#include "geometry/pull_back.h"
#include "geometry/kernels.h"
#include "geometry/vector.h"

enum
{
  MOST_STEPS = 30
};

/* Local coordinates beyond this belong to another branch of the map. */
static const double far_outside = 20., converged = 1e-14;

void
abut_plane_basis(int dimension, const double *normal, double (*e)[3])
{
  if (dimension == 2)
  {
    e[0][0] = -normal[1];
    e[0][1] = normal[0];
    e[0][2] = 0.;
    return;
  }
  int k = 0;
  for (int d = 1; d < 3; ++d)
    if (fabs(normal[d]) < fabs(normal[k]))
      k = d;
  double axis[3] = {0., 0., 0.};
  axis[k] = 1.;
  cross3(normal, axis, e[0]);
  unit3(e[0], ABUT_TINY);
  cross3(normal, e[0], e[1]);
}

double
abut_local_violation(abut_facet_kind kind, const double *local)
{
  if (abut_facet_dimension(kind) == 2)
    return fabs(local[0]) - 1.;
  if (abut_facet_n_corners(kind) == 3)
    return max2(max2(-local[0], -local[1]), local[0] + local[1] - 1.);
  return max2(fabs(local[0]), fabs(local[1])) - 1.;
}

static int
step1(const abut_shape *s, int n, const double *flat, double target,
      double *local, double *derivative, double *length)
{
  double r = -target, slope = 0.;
  for (int a = 0; a < n; ++a)
  {
    r += s->n[a] * flat[a];
    slope += s->d[0][a] * (flat[a] - flat[0]);
  }
  if (slope == 0.)
    return 0;
  local[0] -= r / slope;
  *derivative = slope;
  *length = fabs(r / slope);
  return 1;
}

static int
step2(const abut_shape *s, int n, const double *flat, const double *target,
      double *local, double *j, double *length)
{
  double r[2] = {-target[0], -target[1]};
  j[0] = j[1] = j[2] = j[3] = 0.;
  for (int a = 0; a < n; ++a)
    for (int d = 0; d < 2; ++d)
    {
      r[d] += s->n[a] * flat[2 * a + d];
      j[d] += s->d[0][a] * (flat[2 * a + d] - flat[d]);
      j[2 + d] += s->d[1][a] * (flat[2 * a + d] - flat[d]);
    }
  const double determinant = j[0] * j[3] - j[1] * j[2];
  if (determinant == 0.)
    return 0;
  const double u = (r[0] * j[3] - r[1] * j[2]) / determinant,
               v = (j[0] * r[1] - j[1] * r[0]) / determinant;
  local[0] -= u;
  local[1] -= v;
  *length = fabs(u) + fabs(v);
  return 1;
}

int
abut_pull_back(abut_facet_kind kind, const double *flat, const double *target,
               double *local, double *derivative)
{
  const int n = abut_facet_n_nodes(kind), dim = abut_facet_dimension(kind);
  const double start =
      dim == 3 && abut_facet_n_corners(kind) == 3 ? 1. / 3. : 0.;
  double j[4] = {0.}, length;
  local[0] = start;
  local[1] = start;
  for (int k = 0; k < MOST_STEPS; ++k)
  {
    abut_shape s;
    int regular;
    if (dim == 2)
    {
      abut_shape2(kind, local[0], &s);
      regular = step1(&s, n, flat, target[0], local, j, &length);
    }
    else
    {
      abut_shape3(kind, local[0], local[1], &s);
      regular = step2(&s, n, flat, target, local, j, &length);
    }
    if (!regular || !(fabs(local[0]) + fabs(local[1]) < far_outside))
      return 0;
    if (length <= converged || (k > 4 && length <= 1e3 * converged))
    {
      for (int i = 0; derivative != NULL && i < (dim - 1) * (dim - 1); ++i)
        derivative[i] = j[i];
      return 1;
    }
  }
  return 0;
}
