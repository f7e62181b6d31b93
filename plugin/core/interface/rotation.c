/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Rotation of the directions of forces since points were made. */
#include "constraint/places.h"
#include "constraint/points.h"
#include "geometry/surface.h"
#include "geometry/vector.h"
#include "interface/pair.h"

#include <abut/law.h>
#include <abut/obstacle_edge.h>

#include <string.h>

/* The points of a pair that carry a force. */
typedef struct work
{
  abut_interface *pair;
  const abut_points *points;
  abut_points_view view;
  abut_places_view places;
  abut_node_positions nodes;
  int32_t n;
  abut_array point;  /* int32_t, [n] */
  abut_array force;  /* double, [n] magnitudes */
  abut_array value;  /* double, [n_nodes * dimension] */
  abut_array before; /* double, [n * dimension] directions */
  abut_array after;  /* the same */
  abut_array place;  /* the same, positions at an obstacle */
  abut_array into;   /* the same, normals of the points */
  abut_array size;   /* double, [n] of facets */
  abut_array distance;
} work;

static void
finish(work *w)
{
  abut_array *all[] = {&w->point, &w->force, &w->value, &w->before,  &w->after,
                       &w->place, &w->into,  &w->size,  &w->distance};
  for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); ++i)
    abut_array_release(w->pair->context, all[i]);
}

/* Room for all points of the set. */
static abut_status
make_room(work *w)
{
  const int64_t n = w->view.n_points, dim = w->view.dimension;
  struct
  {
    abut_array *array;
    int64_t n;
  } const list[] = {{&w->point, n},
                    {&w->force, n},
                    {&w->before, n * dim},
                    {&w->after, n * dim},
                    {&w->place, n * dim},
                    {&w->into, n * dim},
                    {&w->size, n},
                    {&w->distance, n},
                    {&w->value, w->nodes.n_nodes * dim}};
  abut_status status = ABUT_SUCCESS;
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
  {
    list[i].array->element = i == 0 ? sizeof(int32_t) : sizeof(double);
    if (status == ABUT_SUCCESS)
      status =
          abut_array_reserve(w->pair->context, list[i].array, 0, list[i].n);
  }
  return status;
}

static void
find_pressed(work *w, const double *value, const uint8_t *state)
{
  const abut_points_view *v = &w->view;
  for (int32_t i = 0; i < v->n_points && state != NULL; ++i)
  {
    const int32_t row = v->component_start[i];
    const double force = v->weight[i] * fabs(value[row]);
    if (w->places.pair[i] != w->pair->number || !(force > 0.)
        || v->kind[i] == ABUT_POINT_TIE || state[row] == ABUT_STATE_OPEN)
      continue;
    ((int32_t *)w->point.data)[w->n] = i;
    ((double *)w->force.data)[w->n++] = force;
  }
}

static bool
is_displaced(const work *w)
{
  return w->pair->kinematics->directions != ABUT_CONFIGURATION_REFERENCE
         && w->nodes.made != NULL;
}

/* Directions at the points by the inward normals of a side, where its surface
 * stands: where the forces on the other side go. */
static abut_status
add_normals(work *w, bool of_primary, double *direction)
{
  const abut_side *side = of_primary ? &w->pair->primary : &w->pair->secondary;
  const int32_t dim = w->view.dimension, *node = side->node.data;
  const double *normal = NULL;
  double *value = w->value.data;
  const abut_status status = abut_surface_normals(side->surface, &normal);
  if (status != ABUT_SUCCESS)
    return status;
  for (int64_t k = 0; k < (int64_t)w->nodes.n_nodes * dim; ++k)
    value[k] = 0.;
  for (int32_t i = 0; i < side->surface->view.n_nodes; ++i)
    for (int32_t d = 0; d < dim; ++d)
      value[(int64_t)node[i] * dim + d] = -normal[(int64_t)i * dim + d];
  return abut_points_sum(
      w->points, of_primary ? ABUT_SIDE_PRIMARY : ABUT_SIDE_SECONDARY, w->n,
      w->point.data, w->nodes.n_nodes, value, direction);
}

/* Nearest points have the direction of the primary's facets, all others that of
 * the secondary, see abut/coupling.h. */
static abut_status
find_at_bodies(work *w)
{
  abut_discretisation_info info;
  abut_status status =
      abut_discretisation_describe(w->pair->discretisation, &info);
  const bool of_primary = !info.is_weighted && !info.row_per_point;
  const int64_t size = (int64_t)w->nodes.n_nodes * w->view.dimension;
  if (status == ABUT_SUCCESS)
    status = abut_interface_move(w->pair, w->nodes.n_nodes,
                                 is_displaced(w) ? w->nodes.made
                                                 : w->nodes.reference);
  if (status == ABUT_SUCCESS)
    status = add_normals(w, of_primary, w->before.data);
  double *now = w->value.data;
  for (int64_t k = 0; k < size; ++k)
    now[k] = w->nodes.reference[k] + w->nodes.displacement[k];
  if (status == ABUT_SUCCESS)
    status = abut_interface_move(w->pair, w->nodes.n_nodes, now);
  if (status == ABUT_SUCCESS)
    status = add_normals(w, of_primary, w->after.data);
  const abut_status back = abut_interface_move(w->pair, 0, NULL);
  return status == ABUT_SUCCESS ? back : status;
}

/* Directions out of the obstacle at the places of the points; at its edges the
 * body's, which are those of the points' normals. */
static abut_status
add_gradients(work *w, double *direction)
{
  const abut_status status =
      abut_obstacle_distance(w->pair->obstacle, w->n, w->place.data,
                             w->distance.data, direction, NULL);
  return status == ABUT_SUCCESS
             ? abut_obstacle_face(w->pair->obstacle, false, w->n, w->place.data,
                                  w->into.data, w->size.data, w->distance.data,
                                  direction, NULL)
             : status;
}

/* For a height along an axis, too, whose force is along the axis by choice: the
 * change of its slope does not count. */
static abut_status
find_at_obstacle(work *w)
{
  const abut_points_view *v = &w->view;
  const int32_t dim = v->dimension, *point = w->point.data;
  double *place = w->place.data, *into = w->into.data, *size = w->size.data,
         *before = w->before.data, *value = w->value.data;
  for (int32_t k = 0; k < w->n; ++k)
  {
    const int32_t i = point[k];
    memcpy(place + (int64_t)k * dim, w->places.position + (int64_t)i * dim,
           (size_t)dim * sizeof(double));
    memcpy(into + (int64_t)k * dim,
           v->frame + (int64_t)v->component_start[i] * dim,
           (size_t)dim * sizeof(double));
    size[k] = pow(v->weight[i], 1. / (dim - 1));
  }
  abut_status status = add_gradients(w, before);
  if (status != ABUT_SUCCESS)
    return status;
  /* Points in a thin obstacle go back the way they came, not through it: the
   * normal is into the material. */
  for (int32_t k = 0; k < w->n; ++k)
  {
    double a[3], b[3];
    load3(before, dim, k, a);
    load3(into, dim, k, b);
    for (int32_t d = 0; d < dim && dot3(a, b) > 0.; ++d)
      before[(int64_t)k * dim + d] = -a[d];
  }
  for (int64_t e = 0; e < (int64_t)w->nodes.n_nodes * dim; ++e)
    value[e] =
        w->nodes.displacement[e]
        - (is_displaced(w) ? w->nodes.made[e] - w->nodes.reference[e] : 0.);
  status = abut_points_sum(w->points, ABUT_SIDE_SECONDARY, w->n, point,
                           w->nodes.n_nodes, value, w->after.data);
  if (status != ABUT_SUCCESS)
    return status;
  for (int64_t e = 0; e < (int64_t)w->n * dim; ++e)
    place[e] += ((const double *)w->after.data)[e];
  return add_gradients(w, w->after.data);
}

abut_status
abut_interface_rotation(abut_interface *pair, const abut_points *points,
                        const abut_node_positions *nodes, const double *value,
                        const uint8_t *state, abut_direction_change *change)
{
  static const char call[] = "abut_interface_rotation";
  if (pair == NULL)
    return ABUT_INVALID_ARGUMENT;
  work w;
  memset(&w, 0, sizeof(w));
  w.pair = pair;
  w.points = points;
  abut_status status = abut_points_get_placed(points, &w.view, &w.places);
  if (status != ABUT_SUCCESS)
    return status;
  if (nodes == NULL || change == NULL || (w.view.n_points > 0 && value == NULL))
    return abut_fail(pair->context, ABUT_INVALID_ARGUMENT, call,
                     "nodes, values or change are NULL");
  const abut_direction_change none = {0., 0., 0., {0., 0., 0.}};
  *change = none;
  status = abut_copy_in(pair->context, call, &w.nodes, sizeof(w.nodes), nodes);
  if (status == ABUT_SUCCESS
      && (w.nodes.reference == NULL || w.nodes.displacement == NULL))
    return w.nodes.n_nodes == 0
               ? ABUT_SUCCESS
               : abut_fail(pair->context, ABUT_INVALID_ARGUMENT, call,
                           "positions or displacements are NULL");
  if (status == ABUT_SUCCESS)
    status = make_room(&w);
  if (status == ABUT_SUCCESS)
  {
    find_pressed(&w, value, state);
    status = pair->obstacle != NULL ? find_at_obstacle(&w) : find_at_bodies(&w);
  }
  if (status == ABUT_SUCCESS)
    status = abut_direction_change_add(w.view.dimension, w.n, w.force.data,
                                       w.before.data, w.after.data, change);
  finish(&w);
  return status;
}
