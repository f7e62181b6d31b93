/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Boxes around a part of a surface: the facets are halved in the middle of the
 * longest extent of their centres, those with the longest first, until there
 * are as many boxes as allowed. Compact boxes matter more than equal numbers of
 * facets: what lies in a box without being near a facet is sent for nothing.
 * O((n + max_boxes) max_boxes) at worst, O(n log max_boxes) for surfaces. */
#include "search/search.h"

#include <abut/parts.h>

#include <math.h>

/* Facets [first, last) of the order, and the box of their centres. */
typedef struct
{
  int32_t first, last;
  double lower[3], upper[3];
} group;

static void
box_facets(const abut_surface *s, abut_box *box)
{
  const int32_t n = s->view.n_facets;
  for (int32_t f = 0; f < n; f += ABUT_LANES)
  {
    abut_lanes m;
    const int32_t some = n - f < ABUT_LANES ? n - f : ABUT_LANES;
    abut_lanes_bound(s, f, some, &m);
    for (int32_t l = 0; l < some; ++l)
      for (int d = 0; d < 3; ++d)
      {
        box[f + l].lower[d] = m.lower[d][l];
        box[f + l].upper[d] = m.upper[d][l];
      }
  }
}

static double
centre(const abut_box *box, int d)
{
  return 0.5 * box->lower[d] + 0.5 * box->upper[d];
}

static void
measure(const abut_box *box, const int32_t *order, group *g)
{
  for (int d = 0; d < 3; ++d)
  {
    g->lower[d] = INFINITY;
    g->upper[d] = -INFINITY;
  }
  for (int32_t i = g->first; i < g->last; ++i)
    for (int d = 0; d < 3; ++d)
    {
      const double c = centre(box + order[i], d);
      g->lower[d] = fmin(g->lower[d], c);
      g->upper[d] = fmax(g->upper[d], c);
    }
}

static int
longest_axis(const group *g)
{
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (g->upper[d] - g->lower[d] > g->upper[axis] - g->lower[axis])
      axis = d;
  return axis;
}

/* Cut a group in two; false if all its centres are in one place. */
static bool
halve(const abut_box *box, int32_t *order, group *g, group *other)
{
  const int axis = longest_axis(g);
  const double middle = 0.5 * g->lower[axis] + 0.5 * g->upper[axis];
  int32_t end = g->first;
  for (int32_t i = g->first; i < g->last; ++i)
    if (centre(box + order[i], axis) < middle)
    {
      const int32_t kept = order[end];
      order[end++] = order[i];
      order[i] = kept;
    }
  if (end == g->first || end == g->last)
    return false;
  other->first = end;
  other->last = g->last;
  g->last = end;
  measure(box, order, g);
  measure(box, order, other);
  return true;
}

static int32_t
divide(const abut_box *box, int32_t *order, int32_t n, int32_t max_groups,
       group *groups)
{
  groups[0] = (group){.first = 0, .last = n};
  measure(box, order, &groups[0]);
  int32_t n_groups = 1;
  while (n_groups < max_groups)
  {
    int32_t widest = 0;
    double width = -1;
    for (int32_t k = 0; k < n_groups; ++k)
    {
      const int axis = longest_axis(&groups[k]);
      const double extent = groups[k].upper[axis] - groups[k].lower[axis];
      if (extent > width)
      {
        width = extent;
        widest = k;
      }
    }
    if (!halve(box, order, &groups[widest], &groups[n_groups]))
      break;
    ++n_groups;
  }
  return n_groups;
}

/* Box of the facets of a group. */
static abut_box
enclose(const abut_box *box, const int32_t *order, const group *g, double reach)
{
  abut_box b = box[order[g->first]];
  for (int32_t i = g->first + 1; i < g->last; ++i)
    for (int d = 0; d < 3; ++d)
    {
      b.lower[d] = fmin(b.lower[d], box[order[i]].lower[d]);
      b.upper[d] = fmax(b.upper[d], box[order[i]].upper[d]);
    }
  for (int d = 0; d < 3; ++d)
  {
    b.lower[d] -= reach;
    b.upper[d] += reach;
  }
  return b;
}

static void
cut(const abut_surface *s, double reach, int32_t max_boxes, abut_box *facet_box,
    int32_t *order, group *groups, abut_box *boxes, int32_t *n_boxes)
{
  const int32_t n = s->view.n_facets;
  *n_boxes = 0;
  if (n == 0)
    return;
  box_facets(s, facet_box);
  for (int32_t f = 0; f < n; ++f)
    order[f] = f;
  *n_boxes = divide(facet_box, order, n, max_boxes, groups);
  for (int32_t k = 0; k < *n_boxes; ++k)
  {
    boxes[k] = enclose(facet_box, order, &groups[k], reach);
    if (s->view.dimension == 2)
      boxes[k].lower[2] = boxes[k].upper[2] = 0;
  }
}

abut_status
abut_surface_bounds(abut_surface *surface, double reach, int32_t max_boxes,
                    abut_box *boxes, int32_t *n_boxes)
{
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_surface *s = surface;
  if (boxes == NULL || n_boxes == NULL || max_boxes < 1
      || !(reach >= 0 && reach <= ABUT_FACET_LIMIT))
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "abut_surface_bounds",
                     "a result is NULL, max_boxes < 1, or reach is negative "
                     "or not finite");
  const int64_t n = s->view.n_facets;
  const int64_t most = n < max_boxes ? n : max_boxes;
  abut_array box = {NULL, 0, sizeof(abut_box)};
  abut_array order = {NULL, 0, sizeof(int32_t)};
  abut_array groups = {NULL, 0, sizeof(group)};
  abut_status status = abut_array_reserve(s->context, &box, 0, n + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &order, 0, n + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &groups, 0, most + 1);
  if (status == ABUT_SUCCESS)
    cut(s, reach, max_boxes, box.data, order.data, groups.data, boxes, n_boxes);
  abut_array_release(s->context, &box);
  abut_array_release(s->context, &order);
  abut_array_release(s->context, &groups);
  return status;
}
