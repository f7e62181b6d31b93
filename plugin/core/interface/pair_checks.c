/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Whether the sides of a pair fit together. */
#include "constraint/places.h"
#include "constraint/points.h"
#include "geometry/surface.h"
#include "geometry/vector.h"
#include "interface/inside.h"

#include <abut/pair_checks.h>

#include <string.h>

abut_status
abut_surface_nearest(abut_context *context, abut_surface *secondary,
                     abut_surface *primary,
                     const abut_detection_options *options, double *above,
                     double *below)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (above == NULL || below == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_surface_nearest",
                     "a result is NULL");
  *above = *below = INFINITY;
  abut_detection *detection = NULL;
  abut_detection_view view = {0};
  const abut_status status =
      abut_detect(context, secondary, primary, options, &detection, &view);
  for (int32_t i = 0; i < view.n_nodes && status == ABUT_SUCCESS; ++i)
  {
    if (view.contact[i].facet < 0)
      continue;
    double *least = view.contact[i].gap >= 0. ? above : below;
    *least = min2(*least, view.contact[i].distance);
  }
  (void)abut_detection_destroy(&detection);
  return status;
}

/* Arrays of abut_obstacle_faces_away(). */
typedef struct facing
{
  abut_array point, normal, gradient; /* double, [n * dimension] */
  abut_array distance;                /* double, [n] */
  abut_array same;                    /* uint8_t, [n]; 2: has met material */
} facing;

static abut_status
count_material(abut_obstacle *obstacle, int32_t n, int32_t dim, double depth,
               const facing *f, int32_t *same, int32_t *material)
{
  enum
  {
    STEPS = 32 /* thin obstacles are not to be passed by */
  };
  double *x = f->point.data, *d = f->distance.data;
  const double *normal = f->normal.data, *gradient = f->gradient.data;
  uint8_t *mark = f->same.data;
  abut_status status =
      abut_obstacle_distance(obstacle, n, x, d, f->gradient.data, NULL);
  for (int32_t i = 0; i < n && status == ABUT_SUCCESS; ++i)
  {
    double a[3], b[3];
    load3(gradient, dim, i, a);
    load3(normal, dim, i, b);
    mark[i] = dot3(a, b) > 0.;
    *same += mark[i];
  }
  for (int k = 0; k < STEPS && status == ABUT_SUCCESS; ++k)
  {
    for (int64_t e = 0; e < (int64_t)n * dim; ++e)
      x[e] -= depth / STEPS * normal[e];
    status = abut_obstacle_distance(obstacle, n, x, d, NULL, NULL);
    for (int32_t i = 0; i < n && status == ABUT_SUCCESS; ++i)
      if (mark[i] == 1 && d[i] < 0.)
      {
        mark[i] = 2;
        ++*material;
      }
  }
  return status;
}

abut_status
abut_obstacle_faces_away(abut_obstacle *obstacle, abut_surface *surface,
                         const uint8_t *wanted, double depth, int32_t *same,
                         int32_t *material)
{
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_context *context = surface->context;
  if (obstacle == NULL || !(depth >= 0.) || same == NULL || material == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_obstacle_faces_away",
                     "obstacle or a result is NULL, or depth is negative");
  const int32_t n_nodes = surface->view.n_nodes, dim = surface->view.dimension;
  const double *normal = NULL;
  abut_status status = abut_surface_normals(surface, &normal);
  facing f;
  memset(&f, 0, sizeof(f));
  abut_array *all[] = {&f.point, &f.normal, &f.gradient, &f.distance, &f.same};
  for (int k = 0; k < 5; ++k)
  {
    all[k]->element = k < 4 ? sizeof(double) : sizeof(uint8_t);
    if (status == ABUT_SUCCESS)
      status = abut_array_reserve(context, all[k], 0,
                                  (int64_t)n_nodes * (k < 3 ? dim : 1));
  }
  int32_t n = 0;
  for (int32_t i = 0; i < n_nodes && status == ABUT_SUCCESS; ++i)
    if (wanted == NULL || wanted[i] != 0)
    {
      const size_t bytes = (size_t)dim * sizeof(double);
      memcpy((double *)f.point.data + (int64_t)n * dim,
             surface->view.position + (int64_t)i * dim, bytes);
      memcpy((double *)f.normal.data + (int64_t)n * dim,
             normal + (int64_t)i * dim, bytes);
      ++n;
    }
  *same = *material = 0;
  if (status == ABUT_SUCCESS)
    status = count_material(obstacle, n, dim, depth, &f, same, material);
  for (int k = 0; k < 5; ++k)
    abut_array_release(context, all[k]);
  return status;
}

abut_status
abut_surface_bends(abut_surface *surface, double angle, const uint8_t *marked,
                   bool *bends)
{
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_surface_view *v = &surface->view;
  if (bends == NULL || (v->n_nodes > 0 && marked == NULL))
    return abut_fail(surface->context, ABUT_INVALID_ARGUMENT,
                     "abut_surface_bends", "marks or the result are NULL");
  *bends = false;
  abut_array mask = {NULL, 0, sizeof(uint8_t)};
  abut_status status =
      abut_array_reserve(surface->context, &mask, 0, v->n_facets);
  if (status == ABUT_SUCCESS && v->n_facets > 0)
    status = abut_surface_features(surface, angle, mask.data);
  const uint8_t *side = mask.data;
  for (int32_t f = 0; f < v->n_facets && status == ABUT_SUCCESS; ++f)
    for (int k = 0; k < 4 && !*bends; ++k)
      *bends = (side[f] >> k & 1) != 0 && v->neighbour[4 * (int64_t)f + k] >= 0
               && abut_surface_has_mark(v, f, marked);
  abut_array_release(surface->context, &mask);
  return status;
}

abut_status
abut_points_nearest_pair(const abut_points *points, const double *gap,
                         int32_t n_nodes, int32_t *pair)
{
  static const char call[] = "abut_points_nearest_pair";
  const double nearly = 1. - 1e-8; /* round-off decides nothing */
  abut_points_view v;
  abut_places_view places;
  abut_status status = abut_points_get_placed(points, &v, &places);
  if (status != ABUT_SUCCESS)
    return status;
  abut_context *context = abut_points_context(points);
  if (places.n_nodes > n_nodes || (v.n_points > 0 && gap == NULL)
      || (n_nodes > 0 && pair == NULL))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "gaps or pairs are NULL, or a node is out of range");
  abut_array list = {NULL, 0, sizeof(double)};
  status = abut_array_reserve(context, &list, 0, n_nodes);
  double *least = list.data;
  for (int32_t i = 0; i < n_nodes && status == ABUT_SUCCESS; ++i)
  {
    least[i] = INFINITY;
    pair[i] = -1;
  }
  for (int32_t i = 0; i < v.n_points && status == ABUT_SUCCESS; ++i)
  {
    const int32_t node = places.node[i];
    if (node < 0)
      continue;
    const double distance = fabs(gap[v.component_start[i]]);
    if (distance < nearly * least[node])
    {
      least[node] = distance;
      pair[node] = places.pair[i];
    }
  }
  abut_array_release(context, &list);
  return status;
}
