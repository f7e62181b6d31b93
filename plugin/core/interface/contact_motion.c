/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Displacements at points, rotations of directions and of facets. O(entries).
 */
#include "constraint/points.h"
#include "geometry/surface.h"
#include "geometry/vector.h"

#include <abut/contact_motion.h>

abut_status
abut_points_sum(const abut_points *points, abut_point_sides sides, int32_t n,
                const int32_t *point, int32_t n_nodes, const double *value,
                double *sum)
{
  static const char call[] = "abut_points_sum";
  abut_points_view v;
  abut_status status = abut_points_get(points, &v);
  if (status != ABUT_SUCCESS)
    return status;
  abut_context *context = abut_points_context(points);
  if (n < 0 || n_nodes < 0 || (n > 0 && (point == NULL || sum == NULL))
      || (n_nodes > 0 && value == NULL))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "an array is NULL or a size negative");
  for (int32_t k = 0; k < n; ++k)
    if (point[k] < 0 || point[k] >= v.n_points)
      return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                       "there is no such point");
  status = abut_points_check_nodes(points, call, n_nodes);
  if (status != ABUT_SUCCESS)
    return status;
  const int32_t dim = v.dimension;
  for (int32_t k = 0; k < n; ++k)
  {
    double *s = sum + (int64_t)dim * k;
    const int32_t i = point[k];
    const int64_t middle = v.start[i] + v.n_secondary[i];
    const int64_t first = sides & ABUT_SIDE_SECONDARY ? v.start[i] : middle;
    const int64_t last = sides & ABUT_SIDE_PRIMARY ? v.start[i + 1] : middle;
    for (int32_t d = 0; d < dim; ++d)
      s[d] = 0.;
    for (int64_t e = first; e < last; ++e)
      for (int32_t d = 0; d < dim; ++d)
        s[d] += v.coefficient[e] * value[(int64_t)dim * v.node[e] + d];
  }
  return ABUT_SUCCESS;
}

abut_status
abut_direction_change_add(int32_t dimension, int32_t n, const double *magnitude,
                          const double *before, const double *after,
                          abut_direction_change *change)
{
  if ((dimension != 2 && dimension != 3) || n < 0 || change == NULL
      || (n > 0 && (magnitude == NULL || before == NULL || after == NULL)))
    return ABUT_INVALID_ARGUMENT;
  for (int32_t i = 0; i < n; ++i)
  {
    double a[3], b[3], d[3];
    load3(before, dimension, i, a);
    load3(after, dimension, i, b);
    (void)unit3(a, 0.);
    (void)unit3(b, 0.);
    sub3(b, a, d);
    const double angle = 2. * asin(0.5 * min2(2., norm3(d)));
    change->force += magnitude[i];
    change->sum += magnitude[i] * angle;
    change->largest = max2(change->largest, angle);
    axpy3(change->change, magnitude[i], d, change->change);
  }
  return ABUT_SUCCESS;
}

abut_status
abut_surface_rotation(const abut_surface *surface, const uint8_t *marked,
                      const double *before, const double *after, double *angle)
{
  static const char call[] = "abut_surface_rotation";
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (angle == NULL
      || (surface->view.n_nodes > 0
          && (marked == NULL || before == NULL || after == NULL)))
    return abut_fail(surface->context, ABUT_INVALID_ARGUMENT, call,
                     "an array or the result is NULL");
  *angle = 0.;
  for (int32_t f = 0; f < surface->view.n_facets; ++f)
  {
    double a[3], b[3];
    if (!abut_surface_has_mark(&surface->view, f, marked))
      continue;
    abut_surface_corner_normal(&surface->view, f, before, a);
    abut_surface_corner_normal(&surface->view, f, after, b);
    const double size = norm3(a) * norm3(b);
    if (size > 0.)
      *angle = max2(*angle, acos(clamp(dot3(a, b) / size, -1., 1.)));
  }
  return ABUT_SUCCESS;
}
