/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Products with the stencils of all points: gaps of displacements, and forces
 * of pressures, which are the transpose. O(entries * dimension). */
#include "base/context.h"
#include "constraint/points.h"

/* The arrays of a set, once the arguments are legal. */
static abut_status
begin(const abut_points *points, const char *call, int32_t n_nodes,
      const void *per_node, const void *per_component, abut_points_view *v)
{
  const abut_status status = abut_points_get(points, v);
  if (status != ABUT_SUCCESS)
    return status;
  if (n_nodes < 0 || (v->start[v->n_points] > 0 && per_node == NULL)
      || (v->n_components > 0 && per_component == NULL))
    return abut_fail(abut_points_context(points), ABUT_INVALID_ARGUMENT, call,
                     "an array is NULL or a size negative");
  return abut_points_check_nodes(points, call, n_nodes);
}

/* sigma f . sum_l c_l v_l of a component of point i. */
static double
change_of(const abut_points_view *v, int32_t i, int32_t row, const double *u)
{
  const int32_t dim = v->dimension;
  const double sign = abut_point_sign(v->kind[i], row - v->component_start[i]);
  const double *f = v->frame + (int64_t)row * dim;
  double sum = 0.;
  for (int64_t e = v->start[i]; e < v->start[i + 1]; ++e)
    for (int32_t d = 0; d < dim; ++d)
      sum += sign * f[d] * v->coefficient[e] * u[(int64_t)dim * v->node[e] + d];
  return sum;
}

abut_status
abut_points_gap(const abut_points *points, int32_t n_nodes,
                const double *displacement, double *value)
{
  static const char call[] = "abut_points_gap";
  abut_points_view v;
  const abut_status status =
      begin(points, call, n_nodes, displacement, value, &v);
  if (status != ABUT_SUCCESS)
    return status;
  double probe = 0;
  for (int32_t i = 0; i < v.n_points; ++i)
    for (int32_t row = v.component_start[i]; row < v.component_start[i + 1];
         ++row)
    {
      value[row] = v.gap[row] + change_of(&v, i, row, displacement);
      probe += value[row] * 0.0;
    }
  return probe == 0 ? ABUT_SUCCESS
                    : abut_fail(abut_points_context(points), ABUT_NOT_FINITE,
                                call, "a displacement is not finite");
}

/* Add the force of a component of point i with a traction. */
static void
add_force_of(const abut_points_view *v, int32_t i, int32_t row, double pressure,
             double *force)
{
  const int32_t dim = v->dimension;
  const double *f = v->frame + (int64_t)row * dim;
  const double factor =
      v->weight[i] * pressure
      * abut_point_sign(v->kind[i], row - v->component_start[i]);
  for (int64_t e = v->start[i]; e < v->start[i + 1]; ++e)
    for (int32_t d = 0; d < dim; ++d)
      force[(int64_t)dim * v->node[e] + d] += factor * v->coefficient[e] * f[d];
}

abut_status
abut_points_add_force(const abut_points *points, int32_t n_nodes,
                      const double *pressure, double *force)
{
  static const char call[] = "abut_points_add_force";
  abut_points_view v;
  const abut_status status = begin(points, call, n_nodes, force, pressure, &v);
  if (status != ABUT_SUCCESS)
    return status;
  double probe = 0;
  for (int32_t row = 0; row < v.n_components; ++row)
    probe += pressure[row] * 0.0;
  if (!(probe == 0))
    return abut_fail(abut_points_context(points), ABUT_NOT_FINITE, call,
                     "a pressure is not finite");
  for (int32_t i = 0; i < v.n_points; ++i)
    for (int32_t row = v.component_start[i]; row < v.component_start[i + 1];
         ++row)
      add_force_of(&v, i, row, pressure[row], force);
  return ABUT_SUCCESS;
}

abut_status
abut_points_set_origin(abut_points *points, int32_t first, int32_t n_points,
                       int32_t n_nodes, const double *displacement)
{
  static const char call[] = "abut_points_set_origin";
  abut_points_view v;
  const abut_status status =
      begin(points, call, n_nodes, displacement, displacement, &v);
  if (status != ABUT_SUCCESS)
    return status;
  if (first < 0 || n_points < 0 || first > v.n_points - n_points)
    return abut_fail(abut_points_context(points), ABUT_INVALID_ARGUMENT, call,
                     "there are no such points");
  double probe = 0, *gap = abut_points_gaps(points);
  const int32_t end = first + n_points;
  for (int32_t i = first; i < end; ++i)
    for (int32_t row = v.component_start[i]; row < v.component_start[i + 1];
         ++row)
      probe += change_of(&v, i, row, displacement) * 0.0;
  if (!(probe == 0))
    return abut_fail(abut_points_context(points), ABUT_NOT_FINITE, call,
                     "a displacement is not finite");
  for (int32_t i = first; i < end; ++i)
    for (int32_t row = v.component_start[i]; row < v.component_start[i + 1];
         ++row)
      gap[row] -= change_of(&v, i, row, displacement);
  return ABUT_SUCCESS;
}
