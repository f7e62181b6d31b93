/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* How the tangents of a point that moves turn with its normal, and the shares
 * of the primary's nodes go on along its facet: all of it is in the second
 * derivatives H of the gap. With its gradient n at the point and - N_a n at the
 * nodes,
 *
 *     dn = H_x du ,    dN_a = - n . H_a du / |n|^2
 *
 * where H_x and H_a are the rows of the point and of node a. The slip along a
 * tangent t changes by t . (dx - sum_a N_a dx_a), whose derivative is
 *
 *     dt at the point,  - N_a dt - dN_a t at node a.
 *
 * Of mortar the slip changes by t . sum_l c_l dx_l. What n c_l changes by has a
 * part along n, n dc_l, and one across it, c_l dn, so that
 *
 *     d(t c_l) = t dc_l + c_l dt . */
#include "contact/coupling.h"
#include "geometry/vector.h"

#include <string.h>

/* Two vectors that make a frame with the unit normal; see abut_coupling_target.
 * Returns the axis that they are made of. */
static int
tangents_of(int dim, const double *n, double (*t)[3])
{
  memset(t, 0, 2 * sizeof(*t));
  if (dim == 2)
  {
    t[0][0] = -n[1];
    t[0][1] = n[0];
    return 0;
  }
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (fabs(n[d]) < fabs(n[axis]))
      axis = d;
  for (int d = 0; d < 3; ++d)
    t[0][d] = (d == axis) - n[axis] * n[d];
  unit3(t[0], 0.);
  cross3(n, t[0], t[1]);
  return axis;
}

void
abut_coupling_tangents(int32_t dim, const double *normal, double *tangents)
{
  double t[2][3];
  (void)tangents_of(dim, normal, t);
  for (int k = 0; k < dim - 1; ++k)
    memcpy(tangents + k * dim, t[k], sizeof(double) * (size_t)dim);
}

/* How they change as the unit normal does. */
static void
turn_tangents(int dim, const double *n, const double *dn, double (*dt)[3])
{
  double t[2][3], e[3] = {0., 0., 0.}, a[3], b[3];
  const int axis = tangents_of(dim, n, t);
  memset(dt, 0, 2 * sizeof(*dt));
  if (dim == 2)
  {
    dt[0][0] = -dn[1];
    dt[0][1] = dn[0];
    return;
  }
  /* Of v = e - n_axis n, which is made a unit vector. */
  e[axis] = 1.;
  axpy3(e, -n[axis], n, a);
  const double length = norm3(a);
  for (int d = 0; d < 3; ++d)
    dt[0][d] = -(dn[axis] * n[d] + n[axis] * dn[d]) / length;
  axpy3(dt[0], -dot3(dt[0], t[0]), t[0], dt[0]);
  cross3(dn, t[0], a);
  cross3(n, dt[0], b);
  axpy3(a, 1., b, dt[1]);
}

void
abut_coupling_turn(int32_t dim, int32_t n, const double *normal,
                   const double *shape, const double *hessian, double *turning)
{
  double unit[3] = {0., 0., 0.}, t[2][3];
  memcpy(unit, normal, sizeof(double) * (size_t)dim);
  const double length = unit3(unit, 0.);
  (void)tangents_of(dim, unit, t);
  for (int32_t u = 0; u < n; ++u)
  {
    /* The normal is minus the gradient. */
    double dn[3] = {0., 0., 0.}, dt[2][3];
    for (int d = 0; d < dim; ++d)
      dn[d] = -hessian[d * n + u] / length;
    axpy3(dn, -dot3(dn, unit), unit, dn);
    turn_tangents(dim, unit, dn, dt);
    for (int32_t a = 0; a < n / dim; ++a)
    {
      double share = 1., change = 0.;
      for (int d = 0; a > 0 && d < dim; ++d)
        change += unit[d] * hessian[(a * dim + d) * n + u] / length;
      if (a > 0)
        share = -shape[a - 1];
      for (int k = 0; k < dim - 1; ++k)
        for (int d = 0; d < dim; ++d)
          turning[((int64_t)k * n + a * dim + d) * n + u] =
              share * dt[k][d] - change * t[k][d];
    }
  }
}

void
abut_coupling_turn_lines(int32_t dim, int32_t n_lines, int64_t n_columns,
                         const double *normal, const double *block,
                         double *turning)
{
  double unit[3] = {0., 0., 0.}, t[2][3];
  const int64_t size = n_lines * dim * n_columns;
  memcpy(unit, normal, sizeof(double) * (size_t)dim);
  (void)tangents_of(dim, unit, t);
  for (int32_t l = 0; l < n_lines; ++l)
    for (int64_t u = 0; u < n_columns; ++u)
    {
      double way[3] = {0., 0., 0.}, dt[2][3];
      const int64_t first = (int64_t)l * dim * n_columns + u;
      for (int d = 0; d < dim; ++d)
        way[d] = -block[first + d * n_columns];
      const double change = dot3(unit, way);
      axpy3(way, -change, unit, way);
      turn_tangents(dim, unit, way, dt);
      for (int k = 0; k < dim - 1; ++k)
        for (int d = 0; d < dim; ++d)
          turning[k * size + first + d * n_columns] =
              change * t[k][d] + dt[k][d];
    }
}
