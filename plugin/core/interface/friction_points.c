/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Sums over points with friction, and points that share a node. Points of one
 * node form a list: head[node], then next[point], ascending. */
#include "constraint/places.h"
#include "constraint/points.h"
#include "geometry/vector.h"

#include <abut/friction_points.h>
#include <abut/law.h>

#include <string.h>

typedef struct work
{
  abut_context *context;
  abut_points_view view;
  abut_places_view places;
  abut_array head; /* int32_t, [n_nodes]; -1: none */
  abut_array next; /* int32_t, [n_points]; -1: the last one */
} work;

/* The points of pairs below n_pairs. */
static abut_status
begin(work *w, const char *call, const abut_points *points, int32_t n_pairs)
{
  memset(w, 0, sizeof(*w));
  const abut_status status =
      abut_points_get_placed(points, &w->view, &w->places);
  if (status != ABUT_SUCCESS)
    return status;
  w->context = abut_points_context(points);
  return w->places.n_pairs <= n_pairs
             ? ABUT_SUCCESS
             : abut_fail(w->context, ABUT_INVALID_ARGUMENT, call,
                         "points are of more pairs");
}

/* Lists of the points of each node. */
static abut_status
list_points(work *w)
{
  w->head.element = w->next.element = sizeof(int32_t);
  abut_status status =
      abut_array_reserve(w->context, &w->head, 0, w->places.n_nodes);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(w->context, &w->next, 0, w->view.n_points);
  if (status != ABUT_SUCCESS)
    return status;
  int32_t *head = w->head.data, *next = w->next.data;
  for (int32_t k = 0; k < w->places.n_nodes; ++k)
    head[k] = -1;
  for (int32_t i = w->view.n_points - 1; i >= 0; --i)
  {
    const int32_t node = w->places.node[i];
    if (node < 0)
      continue;
    next[i] = head[node];
    head[node] = i;
  }
  return ABUT_SUCCESS;
}

static void
finish(work *w)
{
  abut_array_release(w->context, &w->head);
  abut_array_release(w->context, &w->next);
}

static int32_t
first_at_node(const work *w, int32_t i)
{
  const int32_t node = w->places.node[i];
  return node < 0 ? -1 : ((const int32_t *)w->head.data)[node];
}

static int32_t
next_at_node(const work *w, int32_t i)
{
  return ((const int32_t *)w->next.data)[i];
}

static bool
is_contact(const work *w, int32_t i)
{
  return w->view.kind[i] == ABUT_POINT_CONTACT;
}

/* Add the components of a point of contact. */
static void
add_point(const abut_points_view *v, int32_t i, const double *value,
          const double *slip, bool slips, abut_friction_sums *s)
{
  const int32_t first = v->component_start[i];
  const double w = v->weight[i];
  double square = 0., done = 0.;
  s->normal_force += w * value[first];
  s->n_slipping += slips;
  for (int32_t row = first + 1; row < v->component_start[i + 1]; ++row)
  {
    square += value[row] * value[row];
    /* The springs of sticking points store their work. */
    if (slips)
      done -= value[row] * slip[row];
    for (int32_t d = 0; d < v->dimension; ++d)
      s->force[d] += w * value[row] * v->frame[(int64_t)row * v->dimension + d];
  }
  s->friction_force += w * sqrt(square);
  s->traction = max2(s->traction, sqrt(square));
  s->dissipation += w * max2(0., done);
}

static bool
is_closed(const work *w, int32_t i, const uint8_t *state)
{
  return is_contact(w, i) && w->places.node[i] >= 0
         && state[w->view.component_start[i]] != ABUT_STATE_OPEN;
}

/* Whether another point at the node of point i is closed. */
static bool
is_shared(const work *w, int32_t i, const uint8_t *state)
{
  for (int32_t j = first_at_node(w, i); j >= 0; j = next_at_node(w, j))
    if (j != i && is_closed(w, j, state))
      return true;
  return false;
}

static void
add_shared_sticks(const work *w, const double *value, const uint8_t *state,
                  abut_friction_sums *sums)
{
  const abut_points_view *v = &w->view;
  for (int32_t i = 0; i < v->n_points; ++i)
  {
    const int32_t row = v->component_start[i];
    if (is_closed(w, i, state) && v->component_start[i + 1] > row + 1
        && state[row] == ABUT_STATE_CLOSED && is_shared(w, i, state))
      sums[w->places.pair[i]].shared_stick_force += v->weight[i] * value[row];
  }
}

abut_status
abut_points_friction(const abut_points *points, int32_t n_pairs,
                     const double *value, const double *slip,
                     const uint8_t *state, abut_friction_sums *sums)
{
  static const char call[] = "abut_points_friction";
  work w;
  abut_status status = begin(&w, call, points, n_pairs);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_points_view *v = &w.view;
  if ((v->n_components > 0 && (value == NULL || slip == NULL))
      || (n_pairs > 0 && sums == NULL))
    return abut_fail(w.context, ABUT_INVALID_ARGUMENT, call,
                     "values, slips or sums are NULL");
  if (state != NULL)
    status = list_points(&w);
  if (status == ABUT_SUCCESS && n_pairs > 0)
    memset(sums, 0, (size_t)n_pairs * sizeof(*sums));
  for (int32_t i = 0; i < v->n_points && status == ABUT_SUCCESS; ++i)
    if (is_contact(&w, i))
      add_point(v, i, value, slip,
                state != NULL
                    && state[v->component_start[i]] == ABUT_STATE_SLIP,
                &sums[w.places.pair[i]]);
  if (status == ABUT_SUCCESS && state != NULL)
    add_shared_sticks(&w, value, state, sums);
  finish(&w);
  return status;
}

/* Whether two points of a node have the same normal. */
static bool
have_same_normal(const abut_points_view *v, int32_t i, int32_t j)
{
  const double same = 1e-12; /* 1 - cosine */
  const double *a = v->frame + (int64_t)v->component_start[i] * v->dimension,
               *b = v->frame + (int64_t)v->component_start[j] * v->dimension;
  double cosine = 0.;
  for (int32_t d = 0; d < v->dimension; ++d)
    cosine += a[d] * b[d];
  return cosine >= 1. - same;
}

abut_status
abut_points_cover(const abut_points *points, int32_t n_pairs,
                  const uint8_t *marks, uint8_t *keep)
{
  static const char call[] = "abut_points_cover";
  work w;
  abut_status status = begin(&w, call, points, n_pairs);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_points_view *v = &w.view;
  if (v->n_points > 0 && (marks == NULL || keep == NULL))
    return abut_fail(w.context, ABUT_INVALID_ARGUMENT, call,
                     "marks or keep is NULL");
  status = list_points(&w);
  for (int32_t i = 0; i < v->n_points && status == ABUT_SUCCESS; ++i)
    for (int32_t j = first_at_node(&w, i); j >= 0 && j < i;
         j = next_at_node(&w, j))
    {
      const int a = marks[w.places.pair[i]], b = marks[w.places.pair[j]];
      if (!(a & b & ABUT_PAIR_FIXED_POINTS) || !((a | b) & ABUT_PAIR_FRICTION)
          || !have_same_normal(v, i, j))
        continue;
      const int32_t behind =
          v->gap[v->component_start[i]] >= v->gap[v->component_start[j]] ? i
                                                                         : j;
      for (int32_t row = v->component_start[behind];
           row < v->component_start[behind + 1]; ++row)
        keep[row] = 0;
    }
  finish(&w);
  return status;
}

abut_status
abut_points_rivals(const abut_points *points, int32_t n, const int32_t *first,
                   int32_t *n_rivals, int32_t *rival_point, int32_t *rival_row)
{
  static const char call[] = "abut_points_rivals";
  work w;
  abut_status status = begin(&w, call, points, INT32_MAX);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_points_view *v = &w.view;
  if (n < 0 || (n > 0 && first == NULL) || n_rivals == NULL
      || (rival_point == NULL) != (rival_row == NULL))
    return abut_fail(w.context, ABUT_INVALID_ARGUMENT, call,
                     "n is negative or an array NULL");
  *n_rivals = 0;
  status = list_points(&w);
  for (int32_t i = 0, k = 0; i < v->n_points && k < n && status == ABUT_SUCCESS;
       ++i)
  {
    if (first[k] != v->component_start[i])
      continue;
    for (int32_t j = first_at_node(&w, i); j >= 0; j = next_at_node(&w, j))
    {
      if (j == i || !is_contact(&w, j))
        continue;
      if (rival_point != NULL)
      {
        rival_point[*n_rivals] = k;
        rival_row[*n_rivals] = v->component_start[j];
      }
      ++*n_rivals;
    }
    ++k;
  }
  finish(&w);
  return status;
}
