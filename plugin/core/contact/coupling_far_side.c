/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Points that are so deep in a thin obstacle that the far side is the nearer
 * one. The nearest way out would push them on through the obstacle; the way
 * back is against the outward normal n of their own surface, into the body.
 *
 * Such a point is inside with n and the gradient of the distance phi the same
 * way. From x it is followed along x - t n in steps of |phi|, which cannot
 * leave the obstacle unnoticed, to the place y where it comes out; distance
 * and gradient g are those of the plane there,
 *     phi(x) = phi(y) + g . (x - y),    g = grad phi(y),
 * if that side faces the surface. No body is pushed back by more than its own
 * thickness, if that is known, or than its surface extends. */
#include "contact/coupling.h"
#include "contact/discretisation.h"
#include "geometry/vector.h"

#include <string.h>

/* Cosine of normals that point the same way beyond doubt: flanks of a body that
 * is pushed into a wide obstacle are no such places. */
static const double same_direction = 0.5;

/* Distance, in extents of the surface, at which a point has come out. */
static const double at_surface = 1e-12;

enum
{
  MAX_STEPS = 60
};

/* A point on its way; x is where it is now. */
typedef struct walker
{
  int64_t point;
  double x[3], normal[3], way;
} walker;

static double
extent_of(const abut_coupling *c)
{
  const int dim = c->view.dimension;
  const double *x = c->answer.asked.data;
  double square = 0.;
  for (int d = 0; d < dim; ++d)
  {
    double low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < c->answer.n_asked; ++i)
    {
      low = fmin(low, x[i * dim + d]);
      high = fmax(high, x[i * dim + d]);
    }
    square += (high - low) * (high - low);
  }
  return sqrt(square);
}

/* Points that are to walk, in c->answer.walkers. */
static abut_status
collect(abut_coupling *c, int64_t *n)
{
  const int dim = c->view.dimension;
  const double *x = c->answer.asked.data, *normal = c->answer.asked_normal.data,
               *distance = c->answer.distance.data,
               *gradient = c->answer.gradient.data;
  *n = 0;
  for (int64_t i = 0; i < c->answer.n_asked; ++i)
  {
    double cosine = 0.;
    for (int d = 0; d < dim; ++d)
      cosine += gradient[i * dim + d] * normal[i * dim + d];
    if (!(distance[i] < 0. && cosine > same_direction))
      continue;
    const abut_status status = abut_array_reserve(
        c->context, &c->answer.walkers, *n * (int64_t)sizeof(walker),
        (*n + 1) * (int64_t)sizeof(walker));
    if (status != ABUT_SUCCESS)
      return status;
    walker *w = (walker *)c->answer.walkers.data + (*n)++;
    memset(w, 0, sizeof(*w));
    w->point = i;
    memcpy(w->x, x + i * dim, sizeof(double) * (size_t)dim);
    memcpy(w->normal, normal + i * dim, sizeof(double) * (size_t)dim);
  }
  return ABUT_SUCCESS;
}

/* Take over what a walker has met, if that side faces the surface. */
static void
arrive(abut_coupling *c, const walker *w, double distance,
       const double *gradient)
{
  const int dim = c->view.dimension;
  double cosine = 0.;
  for (int d = 0; d < dim; ++d)
    cosine += gradient[d] * w->normal[d];
  if (!(cosine <= c->options.normal_cosine))
    return;
  ((double *)c->answer.distance.data)[w->point] = distance + w->way * cosine;
  memcpy((double *)c->answer.gradient.data + w->point * dim, gradient,
         sizeof(double) * (size_t)dim);
  if (abut_coupling_moves(c))
    memset((double *)c->answer.hessian.data + w->point * dim * dim, 0,
           sizeof(double) * (size_t)(dim * dim));
}

/* One step of all walkers; those that have arrived or are lost leave. */
static abut_status
step(abut_coupling *c, double limit, double tolerance, int64_t *n)
{
  const int dim = c->view.dimension;
  walker *w = c->answer.walkers.data;
  abut_status status =
      abut_array_reserve(c->context, &c->answer.walk, 0, *n * (2 * dim + 1));
  if (status != ABUT_SUCCESS)
    return status;
  double *x = c->answer.walk.data, *distance = x + *n * dim,
         *gradient = distance + *n;
  for (int64_t i = 0; i < *n; ++i)
    memcpy(x + i * dim, w[i].x, sizeof(double) * (size_t)dim);
  status = abut_obstacle_distance(c->obstacle, (int32_t)*n, x, distance,
                                  gradient, NULL);
  if (status != ABUT_SUCCESS)
    return status;
  int64_t left = 0;
  for (int64_t i = 0; i < *n; ++i)
  {
    if (distance[i] >= -tolerance && w[i].way > 0.)
    {
      arrive(c, w + i, distance[i], gradient + i * dim);
      continue;
    }
    walker next = w[i];
    const double length = fmax(-distance[i], tolerance);
    next.way += length;
    axpy3(next.x, -length, next.normal, next.x);
    if (next.way <= limit)
      w[left++] = next;
  }
  *n = left;
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_leave_far_side(abut_coupling *c)
{
  int64_t n;
  abut_status status = collect(c, &n);
  const double extent = n > 0 ? extent_of(c) : 0.;
  const double limit =
      c->options.thickness > 0. ? c->options.thickness : extent;
  for (int k = 0; k < MAX_STEPS && n > 0 && status == ABUT_SUCCESS; ++k)
    status = step(c, limit, at_surface * extent, &n);
  return status;
}
