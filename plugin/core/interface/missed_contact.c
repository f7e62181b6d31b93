/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nodes that no constraint keeps out of the other body, of those that are
 * inside it or have gone through its surface. */
#include "geometry/surface.h"
#include "geometry/vector.h"
#include "interface/inside.h"

#include <abut/missed_contact.h>

#include <string.h>

static const char call_name[] = "abut_missed_contact";

typedef struct work
{
  abut_context *context;
  abut_surface *secondary, *primary;
  const uint8_t *secondary_marks, *primary_marks;
  abut_missed_options options;
  abut_array found; /* abut_inside, of one surface in the other */
  abut_missed_node *missed;
  abut_missed_report report;
} work;

static void
add(work *w, int32_t node, double depth, bool on_primary, bool same_side)
{
  const abut_missed_node missed = {node, on_primary, same_side, 0, depth};
  w->missed[w->report.n++] = missed;
}

static void
take_larger(double *largest, double value)
{
  *largest = max2(*largest, value);
}

static bool
has_held_node(const work *w, int32_t facet)
{
  const abut_surface_view *v = &w->secondary->view;
  for (int32_t e = v->facet_start[facet]; e < v->facet_start[facet + 1]; ++e)
    if (w->secondary_marks[v->connectivity[e]] & ABUT_NODE_HELD)
      return true;
  return false;
}

static abut_status
look_in_primary(work *w)
{
  const abut_missed_options *o = &w->options;
  const abut_inside *found = w->found.data;
  int32_t n;
  const abut_status status = abut_nodes_inside(
      w->context, w->secondary, w->primary, &o->detection,
      o->tolerance + o->gap, o->primary_thickness, w->found.data, &n);
  for (int32_t k = 0; k < n; ++k)
  {
    const int marks = w->secondary_marks[found[k].node];
    const double depth = found[k].depth - o->gap;
    if (!(marks & ABUT_NODE_OWNED))
      continue;
    if (marks & ABUT_NODE_PRESCRIBED)
      take_larger(&w->report.prescribed, depth);
    else if (marks & ABUT_NODE_HELD)
      take_larger(&w->report.held_in_mean, depth);
    else
      add(w, found[k].node, depth, false, false);
  }
  return status;
}

static abut_status
look_in_secondary(work *w)
{
  const abut_missed_options *o = &w->options;
  const abut_inside *found = w->found.data;
  int32_t n;
  const abut_status status =
      abut_nodes_inside(w->context, w->primary, w->secondary, &o->detection,
                        o->gap, o->secondary_thickness, w->found.data, &n);
  for (int32_t k = 0; k < n; ++k)
  {
    const double depth = found[k].depth - o->gap;
    if (!(w->primary_marks[found[k].node] & ABUT_NODE_OWNED))
      continue;
    if (!o->covers_facets || has_held_node(w, found[k].facet))
      take_larger(&w->report.between_points, depth);
    else if (depth > o->tolerance)
      add(w, found[k].node, depth, true, false);
  }
  return status;
}

static abut_status
look_in_same_side(work *w, bool of_primary)
{
  const abut_missed_options *o = &w->options;
  const abut_inside *found = w->found.data;
  abut_surface *side = of_primary ? w->primary : w->secondary;
  const uint8_t *marks = of_primary ? w->primary_marks : w->secondary_marks;
  /* An interference is between sides that are opposite. */
  const double allowed = max2(0., o->gap);
  int32_t n;
  if (!(o->side_thickness[of_primary] > 0.))
    return ABUT_SUCCESS;
  const abut_status status = abut_nodes_inside(
      w->context, side, side, &o->detection, o->tolerance + allowed,
      o->side_thickness[of_primary], w->found.data, &n);
  for (int32_t k = 0; k < n; ++k)
    if (marks[found[k].node] & ABUT_NODE_OWNED)
      add(w, found[k].node, found[k].depth - allowed, of_primary, true);
  return status;
}

static abut_status
look_along_paths(work *w)
{
  const abut_missed_options *o = &w->options;
  const abut_inside *found = w->found.data;
  const double depth = o->tolerance + o->gap;
  const abut_starts of_secondary = {o->secondary_start, o->primary_start},
                    of_primary = {o->primary_start, o->secondary_start};
  int32_t n;
  abut_status status = abut_nodes_through(w->context, w->secondary, w->primary,
                                          &o->detection.search, of_secondary,
                                          depth, w->found.data, &n);
  for (int32_t k = 0; k < n; ++k)
  {
    const int marks = w->secondary_marks[found[k].node];
    if ((marks & ABUT_NODE_OWNED) && !(marks & ABUT_NODE_HELD))
      add(w, found[k].node, found[k].depth - o->gap, false, false);
  }
  if (status == ABUT_SUCCESS)
    status = abut_nodes_through(w->context, w->primary, w->secondary,
                                &o->detection.search, of_primary, depth,
                                w->found.data, &n);
  else
    n = 0;
  for (int32_t k = 0; k < n; ++k)
    if ((w->primary_marks[found[k].node] & ABUT_NODE_OWNED)
        && !has_held_node(w, found[k].facet))
      add(w, found[k].node, found[k].depth - o->gap, true, false);
  return status;
}

static abut_status
find_missed(work *w)
{
  const int64_t a = w->secondary->view.n_nodes, b = w->primary->view.n_nodes;
  w->found.element = sizeof(abut_inside);
  abut_status status =
      abut_array_reserve(w->context, &w->found, 0, a > b ? a : b);
  if (status == ABUT_SUCCESS)
    status = look_in_primary(w);
  if (status == ABUT_SUCCESS)
    status = look_in_secondary(w);
  for (int side = 0; side < 2 && status == ABUT_SUCCESS; ++side)
    status = look_in_same_side(w, side == 1);
  if (status == ABUT_SUCCESS && w->report.n == 0
      && w->options.secondary_start != NULL)
    status = look_along_paths(w);
  return status;
}

static bool
is_length(double value)
{
  return value >= 0. && value <= ABUT_FACET_LIMIT;
}

static const char *
fault_of(const abut_missed_options *o)
{
  if (!(fabs(o->gap) <= ABUT_FACET_LIMIT))
    return "gap is not finite";
  if (!is_length(o->tolerance) || !is_length(o->primary_thickness)
      || !is_length(o->secondary_thickness) || !is_length(o->side_thickness[0])
      || !is_length(o->side_thickness[1]))
    return "a tolerance or thickness is negative or not finite";
  if ((o->secondary_start == NULL) != (o->primary_start == NULL))
    return "only one surface has positions at the start";
  return NULL;
}

static abut_status
check_starts(const work *w)
{
  const abut_missed_options *o = &w->options;
  if (o->secondary_start == NULL)
    return ABUT_SUCCESS;
  const abut_status status =
      abut_surface_check_position(w->secondary, call_name, o->secondary_start);
  return status == ABUT_SUCCESS ? abut_surface_check_position(
             w->primary, call_name, o->primary_start)
                                : status;
}

abut_status
abut_missed_contact_sized(abut_context *context, abut_surface *secondary,
                          abut_surface *primary, const uint8_t *secondary_marks,
                          const uint8_t *primary_marks,
                          const abut_missed_options *options,
                          abut_missed_node *nodes, abut_missed_report *report)
{
  work w;
  if (context == NULL || secondary == NULL || primary == NULL || report == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call_name,
                     "context, surface or report is NULL");
  if (secondary->view.dimension != primary->view.dimension)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call_name,
                     "the surfaces have different dimensions");
  if ((secondary_marks == NULL && secondary->view.n_nodes > 0)
      || (primary_marks == NULL && primary->view.n_nodes > 0)
      || (nodes == NULL && secondary->view.n_nodes + primary->view.n_nodes > 0))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call_name,
                     "marks or nodes are NULL");
  memset(&w, 0, sizeof(w));
  w.options = abut_missed_defaults();
  abut_status status =
      abut_copy_in(context, call_name, &w.options, sizeof(w.options), options);
  if (status != ABUT_SUCCESS)
    return status;
  const char *fault = fault_of(&w.options);
  if (fault != NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call_name, fault);
  w.context = context;
  w.secondary = secondary;
  w.primary = primary;
  w.secondary_marks = secondary_marks;
  w.primary_marks = primary_marks;
  w.missed = nodes;
  status = check_starts(&w);
  if (status == ABUT_SUCCESS)
    status = find_missed(&w);
  abut_array_release(context, &w.found);
  if (status != ABUT_SUCCESS)
    return status;
  return abut_copy_out(context, call_name, report, sizeof(w.report), &w.report);
}
