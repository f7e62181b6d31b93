/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Measures of the points of pairs. O(entries). */
#include "base/context.h"
#include "constraint/places.h"
#include "constraint/points.h"
#include "geometry/vector.h"

#include <abut/contact_measures.h>
#include <abut/law.h>

#include <stdbool.h>
#include <string.h>

typedef struct work
{
  abut_points_view view;
  abut_places_view places;
  abut_node_positions nodes;
} work;

static abut_status
begin(work *w, const char *call, const abut_points *points,
      const abut_node_positions *nodes)
{
  memset(w, 0, sizeof(*w));
  abut_status status = abut_points_get_placed(points, &w->view, &w->places);
  if (status != ABUT_SUCCESS)
    return status;
  abut_context *context = abut_points_context(points);
  if (nodes == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "nodes is NULL");
  status = abut_copy_in(context, call, &w->nodes, sizeof(w->nodes), nodes);
  if (status != ABUT_SUCCESS)
    return status;
  if (w->nodes.reference == NULL || w->nodes.kinematics == NULL
      || w->places.n_pairs > w->nodes.n_pairs)
    return w->view.n_points == 0
               ? ABUT_SUCCESS
               : abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                           "positions or kinematics are NULL, or there are "
                           "more pairs");
  for (int32_t p = 0; p < w->nodes.n_pairs; ++p)
    if (abut_kinematics_get(w->nodes.kinematics[p]) == NULL)
      return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                       "there is no such kinematics");
  return abut_points_check_nodes(points, call, w->nodes.n_nodes);
}

static const abut_kinematics_info *
kinematics_of(const work *w, int32_t pair)
{
  return abut_kinematics_get(w->nodes.kinematics[pair]);
}

/* Displacement of a component of a node where points were made. */
static double
made_at(const work *w, int64_t k)
{
  return w->nodes.made == NULL ? 0. : w->nodes.made[k] - w->nodes.reference[k];
}

static double
displacement_of(const work *w, int64_t k)
{
  return w->nodes.displacement == NULL ? 0. : w->nodes.displacement[k];
}

static void
add_row(const abut_points_view *v, int32_t i, int32_t row, bool is_fixed,
        const double *value, const double *gap, const uint8_t *state,
        abut_contact_sums *s)
{
  const bool tied = v->kind[i] == ABUT_POINT_TIE;
  const double weight = v->weight[i], p = value[row],
               area = weight / (tied ? v->dimension : 1.);
  const bool closed = state == NULL ? p != 0. : state[row] != ABUT_STATE_OPEN;
  ++s->n_rows;
  s->covered_area += area;
  if (state != NULL && closed)
  {
    ++s->n_active;
    s->contact_area += area;
  }
  s->penetration = max2(s->penetration, tied ? fabs(gap[row]) : -gap[row]);
  s->pressure = max2(s->pressure, p);
  if (!tied)
    s->largest_tension = max2(s->largest_tension, -p);
  if (!tied && closed)
    s->least_pressure = min2(s->least_pressure, p);
  /* Points that move have no gaps at displacement 0. */
  if (is_fixed)
    s->initial_gap_work += weight * p * v->gap[row];
}

/* Add c total at a node. */
static void
add_force(const work *w, int32_t node, bool displaced, double c,
          const double *total, abut_side_forces *s)
{
  const int32_t dim = w->view.dimension;
  const double *position =
      displaced && w->nodes.made != NULL ? w->nodes.made : w->nodes.reference;
  double x[3], y[3] = {0.},
               part[3] = {c * total[0], c * total[1], c * total[2]}, moment[3];
  load3(position, dim, node, x);
  cross3(x, part, moment);
  axpy3(s->force, 1., part, s->force);
  axpy3(s->moment, 1., moment, s->moment);
  if (w->nodes.displacement != NULL)
  {
    for (int32_t d = 0; d < dim; ++d)
    {
      const int64_t k = (int64_t)node * dim + d;
      y[d] = w->nodes.reference[k] + w->nodes.displacement[k];
    }
    cross3(y, part, moment);
  }
  axpy3(s->present_moment, 1., moment, s->present_moment);
}

static void
add_forces(const work *w, int32_t i, int32_t row, double value,
           abut_contact_sums *s)
{
  const abut_points_view *v = &w->view;
  const int32_t dim = v->dimension;
  const double sign = abut_point_sign(v->kind[i], row - v->component_start[i]);
  const bool displaced = kinematics_of(w, w->places.pair[i])->directions
                         != ABUT_CONFIGURATION_REFERENCE;
  double total[3] = {0.};
  for (int32_t d = 0; d < dim; ++d)
    total[d] =
        -v->weight[i] * value * (-sign * v->frame[(int64_t)row * dim + d]);
  for (int64_t e = v->start[i]; e < v->start[i + 1]; ++e)
    add_force(w, v->node[e], displaced, v->coefficient[e], total,
              e < v->start[i] + v->n_secondary[i] ? &s->secondary
                                                  : &s->primary);
}

abut_status
abut_points_measure(const abut_points *points, const abut_node_positions *nodes,
                    const double *value, const double *gap,
                    const uint8_t *state, abut_contact_sums *sums)
{
  static const char call[] = "abut_points_measure";
  work w;
  const abut_status status = begin(&w, call, points, nodes);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_points_view *v = &w.view;
  if ((v->n_components > 0 && (value == NULL || gap == NULL))
      || (w.nodes.n_pairs > 0 && sums == NULL))
    return abut_fail(abut_points_context(points), ABUT_INVALID_ARGUMENT, call,
                     "values, gaps or sums are NULL");
  if (w.nodes.n_pairs > 0)
    memset(sums, 0, (size_t)w.nodes.n_pairs * sizeof(*sums));
  for (int32_t p = 0; p < w.nodes.n_pairs; ++p)
    sums[p].least_pressure = INFINITY;
  for (int32_t i = 0; i < v->n_points; ++i)
  {
    abut_contact_sums *s = &sums[w.places.pair[i]];
    for (int32_t row = v->component_start[i]; row < v->component_start[i + 1];
         ++row)
    {
      if (v->kind[i] == ABUT_POINT_TIE || row == v->component_start[i])
        add_row(v, i, row,
                w.places.block_start[i + 1] == w.places.block_start[i], value,
                gap, state, s);
      add_forces(&w, i, row, value[row], s);
    }
  }
  return ABUT_SUCCESS;
}

/* A component of the motions of a node, see abut_points_motion(). */
static double
relative_motion(const work *w, const abut_kinematics_info *kinematics,
                int64_t k)
{
  if (kinematics->directions != kinematics->points)
    return w->nodes.reference[k] + displacement_of(w, k);
  return displacement_of(w, k)
         - (kinematics->points == ABUT_CONFIGURATION_COMMITTED ? made_at(w, k)
                                                               : 0.);
}

static double
motion_since(const work *w, const abut_kinematics_info *kinematics, int64_t k)
{
  return displacement_of(w, k)
         - (kinematics->directions != ABUT_CONFIGURATION_REFERENCE
                ? made_at(w, k)
                : 0.);
}

abut_status
abut_points_motion(const abut_points *points, const abut_node_positions *nodes,
                   double *relative, double *since)
{
  work w;
  const abut_status status = begin(&w, "abut_points_motion", points, nodes);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_points_view *v = &w.view;
  const int32_t dim = v->dimension;
  for (int32_t i = 0; i < v->n_points; ++i)
  {
    const abut_kinematics_info *kinematics =
        kinematics_of(&w, w.places.pair[i]);
    for (int32_t d = 0; d < dim; ++d)
    {
      double r = 0., s = 0.;
      for (int64_t e = v->start[i]; e < v->start[i + 1]; ++e)
      {
        const int64_t k = (int64_t)v->node[e] * dim + d;
        r += v->coefficient[e] * relative_motion(&w, kinematics, k);
        s += v->coefficient[e] * motion_since(&w, kinematics, k);
      }
      if (relative != NULL)
        relative[(int64_t)i * dim + d] = r;
      if (since != NULL)
        since[(int64_t)i * dim + d] = s;
    }
  }
  return ABUT_SUCCESS;
}

/* Whether a component of a point, tangents left out, is not open. */
static bool
is_closed(const abut_points_view *v, int32_t i, const uint8_t *state)
{
  const int32_t first = v->component_start[i],
                end = v->kind[i] == ABUT_POINT_TIE ? v->component_start[i + 1]
                                                   : first + 1;
  for (int32_t row = first; row < end; ++row)
    if (state[row] != ABUT_STATE_OPEN)
      return true;
  return false;
}

abut_status
abut_points_mark_nodes(const abut_points *points, const uint8_t *state,
                       int32_t n_pairs, int32_t n_nodes, uint8_t *marks)
{
  static const char call[] = "abut_points_mark_nodes";
  abut_points_view v;
  abut_places_view places;
  abut_status status = abut_points_get_placed(points, &v, &places);
  if (status == ABUT_SUCCESS)
    status = abut_points_check_nodes(points, call, n_nodes);
  if (status != ABUT_SUCCESS)
    return status;
  if (v.n_points > 0 && (marks == NULL || places.n_pairs > n_pairs))
    return abut_fail(abut_points_context(points), ABUT_INVALID_ARGUMENT, call,
                     "marks is NULL, or there are more pairs");
  for (int32_t i = 0; i < v.n_points; ++i)
    if (state == NULL || is_closed(&v, i, state))
      for (int64_t e = v.start[i]; e < v.start[i] + v.n_secondary[i]; ++e)
        marks[(int64_t)places.pair[i] * n_nodes + v.node[e]] = 1;
  return ABUT_SUCCESS;
}
