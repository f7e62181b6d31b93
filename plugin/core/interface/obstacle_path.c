/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Points on straight paths past an obstacle: sphere tracing with a least step.
 */
#include "geometry/obstacle.h"
#include "geometry/vector.h"

#include <abut/missed_contact.h>

#include <string.h>

enum
{
  /* Paths along a surface are as long as many steps. */
  MOST_STEPS = 4096
};

/* A point on its path. */
typedef struct traveller
{
  double from[3], way[3];
  double length; /* of the way */
  double least;  /* step */
  double part;   /* of the way, done */
  double entry[3], last[3];
  bool is_inside, has_side;
  int32_t index;
} traveller;

typedef struct work
{
  abut_obstacle *obstacle;
  int32_t dimension;
  int32_t n; /* still on their way */
  abut_array travellers;
  abut_array point, distance, gradient; /* double, of these */
} work;

/* Look at a point that is distant from the surface, where this is outward, and
 * go on as far as nothing can be missed. False at the end of the way. */
static bool
go_on(traveller *t, double distance, const double *outward, int step,
      abut_obstacle_path *path)
{
  /* The sides of a right angle are no more than one behind the other. */
  const double opposite = -0.1;
  const double inverse = 1. / fmax(norm3(outward), 1e-300);
  double side[3];
  for (int d = 0; d < 3; ++d)
    side[d] = outward[d] * inverse;
  path->depth = fmax(path->depth, -distance);
  if (distance < 0. && !t->is_inside)
    memcpy(t->entry, t->has_side ? t->last : side, sizeof(side));
  else if (distance >= 0. && t->is_inside && dot3(t->entry, side) < opposite)
    path->through = 1;
  t->is_inside = distance < 0.;
  memcpy(t->last, side, sizeof(side));
  t->has_side = true;
  if (t->part == 1.)
    return false;
  const double shortest =
      step < MOST_STEPS ? t->least : fmax(t->least, t->length / 64.);
  t->part = fmin(1., t->part + fmax(fabs(distance), shortest) / t->length);
  return true;
}

static abut_status
reserve(work *w, abut_context *context, int64_t n)
{
  struct
  {
    abut_array *array;
    size_t element;
    int64_t n;
  } const list[] = {
      {&w->travellers, sizeof(traveller), n},
      {&w->point, sizeof(double), 3 * n},
      {&w->distance, sizeof(double), n},
      {&w->gradient, sizeof(double), 3 * n},
  };
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
  {
    list[i].array->element = list[i].element;
    const abut_status status =
        abut_array_reserve(context, list[i].array, 0, list[i].n);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

static void
begin(work *w, int32_t n, const double *from, const double *to)
{
  const double part_of_way = 1. / 64., part_of_depth = 0.25;
  const double half = abut_obstacle_depth(w->obstacle);
  const double *end = w->distance.data;
  for (int32_t i = 0; i < n; ++i)
  {
    traveller t;
    memset(&t, 0, sizeof(t));
    t.index = i;
    load3(from, w->dimension, i, t.from);
    load3(to, w->dimension, i, t.way);
    sub3(t.way, t.from, t.way);
    t.length = norm3(t.way);
    t.least = fmin(part_of_way * t.length, part_of_depth * half);
    if (end[i] < t.length)
      ((traveller *)w->travellers.data)[w->n++] = t;
  }
}

static abut_status
advance(work *w, int step, abut_obstacle_path *path)
{
  traveller *t = w->travellers.data;
  double *x = w->point.data, *distance = w->distance.data,
         *gradient = w->gradient.data;
  for (int32_t k = 0; k < w->n; ++k)
    for (int32_t d = 0; d < w->dimension; ++d)
      x[w->dimension * (int64_t)k + d] = t[k].from[d] + t[k].part * t[k].way[d];
  const abut_status status =
      abut_obstacle_distance(w->obstacle, w->n, x, distance, gradient, NULL);
  if (status != ABUT_SUCCESS)
    return status;
  int32_t n = 0;
  for (int32_t k = 0; k < w->n; ++k)
  {
    double outward[3];
    load3(gradient, w->dimension, k, outward);
    if (go_on(&t[k], distance[k], outward, step, &path[t[k].index]))
      t[n++] = t[k];
  }
  w->n = n;
  return ABUT_SUCCESS;
}

abut_status
abut_obstacle_follow(abut_obstacle *obstacle, int32_t n, const double *from,
                     const double *to, abut_obstacle_path *path)
{
  if (obstacle == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_context *context = obstacle->context;
  if (n < 0 || (n > 0 && (from == NULL || to == NULL || path == NULL)))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_obstacle_follow",
                     "n is negative, or points or result are NULL");
  if (n == 0)
    return ABUT_SUCCESS;
  work w;
  memset(&w, 0, sizeof(w));
  w.obstacle = obstacle;
  w.dimension = obstacle->view.dimension;
  memset(path, 0, (size_t)n * sizeof(*path));
  abut_status status = reserve(&w, context, n);
  if (status == ABUT_SUCCESS)
    status =
        abut_obstacle_distance(obstacle, n, to, w.distance.data, NULL, NULL);
  if (status == ABUT_SUCCESS)
    begin(&w, n, from, to);
  for (int step = 0; status == ABUT_SUCCESS && w.n > 0; ++step)
    status = advance(&w, step, path);
  abut_array_release(context, &w.travellers);
  abut_array_release(context, &w.point);
  abut_array_release(context, &w.distance);
  abut_array_release(context, &w.gradient);
  return status;
}
