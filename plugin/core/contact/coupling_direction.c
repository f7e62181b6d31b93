/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Directions of mortar where the surfaces are, with their derivatives: the
 * averaged normals of geometry/surface_normals.c,
 *
 *     n = unit( sum_f A_f n_f ) ,  dn = (1 - n n') sum_f d(A_f n_f) / |sum_f|
 *
 * or, at features, those of the covered part. Angles, which weigh facets in
 * space where they are folded, count as constant. */
#include "contact/coupling.h"
#include "geometry/kernels.h"
#include "geometry/normal_change.h"
#include "geometry/vector.h"

#include <string.h>

static void
gather(const abut_coupling *c, int32_t f, double *x)
{
  const abut_surface_view *v = &c->secondary->view;
  const double *place = abut_coupling_place(c, 0);
  const int32_t *node = v->connectivity + v->facet_start[f],
                n = v->facet_start[f + 1] - v->facet_start[f],
                dim = v->dimension;
  for (int32_t a = 0; a < n; ++a)
    memcpy(x + a * dim, place + (int64_t)dim * node[a],
           sizeof(double) * (size_t)dim);
}

static void
begin(const abut_coupling *c, abut_coupling_direction *sum)
{
  memset(sum, 0, sizeof(*sum));
  sum->first = c->change.n_directions;
}

/* Derivatives by the place of a node, which is entered if it is new. */
static double *
change_of(abut_coupling *c, abut_coupling_direction *sum, int32_t node)
{
  int32_t *list = (int32_t *)c->change.direction_node.data + sum->first;
  double *change = (double *)c->change.direction_change.data + 9 * sum->first;
  int32_t k = 0;
  while (k < sum->n && list[k] != node)
    ++k;
  if (k == sum->n)
  {
    list[sum->n++] = node;
    memset(change + 9 * k, 0, 9 * sizeof(double));
  }
  return change + (ptrdiff_t)9 * k;
}

/* Add the normal of a facet at its node a, times weight, and its area unless it
 * is to be of unit length. */
static abut_status
add_facet(abut_coupling *c, int32_t f, int a, double weight, bool unit,
          abut_coupling_direction *sum, double *area)
{
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *node = v->connectivity + v->facet_start[f],
                n = v->facet_start[f + 1] - v->facet_start[f],
                dim = v->dimension;
  const int64_t used = sum->first + sum->n;
  double x[3 * ABUT_FACET_MAX_NODES], normal[3],
      change[3][3 * ABUT_FACET_MAX_NODES];
  abut_status status =
      abut_array_reserve(c->context, &c->change.direction_node, used, used + n);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(c->context, &c->change.direction_change,
                                9 * used, 9 * (used + n));
  if (status != ABUT_SUCCESS)
    return status;
  gather(c, f, x);
  abut_facet_normal_change((abut_facet_kind)v->kinds[f], x, a, normal, change);
  *area += norm3(normal);
  if (unit)
    abut_unit_change(dim * n, normal, change);
  axpy3(sum->normal, weight, normal, sum->normal);
  for (int32_t b = 0; b < n; ++b)
  {
    double *to = change_of(c, sum, node[b]);
    for (int d = 0; d < dim; ++d)
      for (int e = 0; e < dim; ++e)
        to[3 * d + e] += weight * change[d][dim * b + e];
  }
  return ABUT_SUCCESS;
}

/* Make it a unit vector. */
static void
finish(abut_coupling *c, abut_coupling_direction *sum)
{
  const double length = unit3(sum->normal, ABUT_TINY);
  double *change = (double *)c->change.direction_change.data + 9 * sum->first;
  for (int32_t k = 0; k < sum->n; ++k, change += 9)
    for (int e = 0; e < 3; ++e)
    {
      double along = 0.;
      for (int d = 0; d < 3; ++d)
        along += sum->normal[d] * change[3 * d + e];
      for (int d = 0; d < 3; ++d)
        change[3 * d + e] =
            length > 0. ? (change[3 * d + e] - along * sum->normal[d]) / length
                        : 0.;
    }
  c->change.n_directions += sum->n;
}

/* Sum over the facets of a node, by area or by angle. */
static abut_status
add_all(abut_coupling *c, int32_t node, bool by_angle,
        abut_coupling_direction *sum, double *area)
{
  const abut_surface_view *v = &c->secondary->view;
  abut_status status = ABUT_SUCCESS;
  *area = 0.;
  begin(c, sum);
  for (int32_t e = v->node_start[node];
       e < v->node_start[node + 1] && status == ABUT_SUCCESS; ++e)
  {
    const int32_t f = v->node_facet[e],
                  *corner = v->connectivity + v->facet_start[f];
    double x[3 * ABUT_FACET_MAX_NODES], weight = 1.;
    int a = 0;
    while (corner[a] != node)
      ++a;
    gather(c, f, x);
    if (by_angle)
      weight = abut_surface_angle(c->secondary, f, node, x);
    status = add_facet(c, f, a, weight, by_angle, sum, area);
  }
  return status;
}

abut_status
abut_coupling_average(abut_coupling *c, int32_t node,
                      abut_coupling_direction *direction)
{
  abut_coupling_direction *kept =
      (abut_coupling_direction *)c->change.directions.data + node;
  if (kept->n < 0)
  {
    abut_coupling_direction sum;
    double area;
    abut_status status = add_all(c, node, false, &sum, &area);
    if (status == ABUT_SUCCESS
        && norm3(sum.normal) < cos(0.5 * c->secondary->feature_angle) * area)
      status = add_all(c, node, true, &sum, &area);
    if (status != ABUT_SUCCESS)
      return status;
    finish(c, &sum);
    *kept = sum;
  }
  *direction = *kept;
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_facet_direction(abut_coupling *c, int32_t facet, int a,
                              abut_coupling_direction *direction)
{
  double area = 0.;
  begin(c, direction);
  const abut_status status = add_facet(c, facet, a, 1., true, direction, &area);
  if (status == ABUT_SUCCESS)
    finish(c, direction);
  return status;
}

/* The mean normal of the covered part, not of unit length, and not finished. */
static abut_status
add_covered(abut_coupling *c, const int64_t *list, int64_t n,
            abut_coupling_direction *sum)
{
  abut_status status = ABUT_SUCCESS;
  double area = 0.;
  begin(c, sum);
  for (int64_t i = 0; i < n && status == ABUT_SUCCESS; ++i)
  {
    const abut_coupling_share *s =
        (const abut_coupling_share *)c->sum.shares.data + list[i];
    status = add_facet(c, s->facet, -1, s->weight, true, sum, &area);
  }
  return status;
}

abut_status
abut_coupling_direct(abut_coupling *c, const int64_t *list, int64_t n,
                     const abut_coupling_share *total,
                     abut_coupling_direction *direction)
{
  const double limit = cos(0.5 * c->secondary->feature_angle);
  abut_coupling_direction mean;
  abut_status status = abut_coupling_average(c, total->node, direction);
  if (status == ABUT_SUCCESS)
    status = add_covered(c, list, n, &mean);
  if (status != ABUT_SUCCESS)
    return status;
  const double length = norm3(mean.normal);
  c->statistics.n_bent += length < limit * total->weight;
  if (dot3(direction->normal, mean.normal) >= limit * length)
    return ABUT_SUCCESS;
  ++c->statistics.n_split;
  finish(c, &mean);
  *direction = mean;
  return ABUT_SUCCESS;
}
