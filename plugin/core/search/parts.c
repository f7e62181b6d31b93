/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Bounds of a part of a surface, and the facets near such bounds. */
#include "search/search.h"

#include <abut/parts.h>

#include <math.h>
#include <string.h>

/* Boxes of all facets, and the box of all. */
static void
box_facets(const abut_surface *s, abut_box *facet_box, abut_box *all)
{
  for (int d = 0; d < 3; ++d)
  {
    all->lower[d] = INFINITY;
    all->upper[d] = -INFINITY;
  }
  const int32_t n = s->view.n_facets;
  for (int32_t f = 0; f < n; f += ABUT_LANES)
  {
    abut_lanes m;
    const int32_t some = n - f < ABUT_LANES ? n - f : ABUT_LANES;
    abut_lanes_bound(s, f, some, &m);
    for (int32_t l = 0; l < some; ++l)
      for (int d = 0; d < 3; ++d)
      {
        abut_box *b = facet_box + f + l;
        b->lower[d] = m.lower[d][l];
        b->upper[d] = m.upper[d][l];
        all->lower[d] = fmin(all->lower[d], b->lower[d]);
        all->upper[d] = fmax(all->upper[d], b->upper[d]);
      }
  }
}

/* Box of a run of facets in their order along the curve. */
static abut_box
run_box(const abut_box *facet_box, const abut_keyed *items, int32_t first,
        int32_t last, double reach)
{
  abut_box b = facet_box[items[first].index];
  for (int32_t i = first + 1; i < last; ++i)
    for (int d = 0; d < 3; ++d)
    {
      const abut_box *f = facet_box + items[i].index;
      b.lower[d] = fmin(b.lower[d], f->lower[d]);
      b.upper[d] = fmax(b.upper[d], f->upper[d]);
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
    abut_keyed *items, abut_box *boxes, int32_t *n_boxes)
{
  const int32_t n = s->view.n_facets;
  abut_box all;
  box_facets(s, facet_box, &all);
  const abut_lattice lattice = abut_lattice_make(all.lower, all.upper, 0);
  for (int32_t f = 0; f < n; ++f)
  {
    double centre[3];
    for (int d = 0; d < 3; ++d)
      centre[d] = 0.5 * (facet_box[f].lower[d] + facet_box[f].upper[d]);
    items[f].key = abut_lattice_key(&lattice, centre);
    items[f].index = f;
  }
  abut_order_sort(items, items + n, n);
  *n_boxes = n < max_boxes ? n : max_boxes;
  for (int32_t k = 0; k < *n_boxes; ++k)
  {
    const int32_t first = (int32_t)((int64_t)k * n / *n_boxes);
    const int32_t last = (int32_t)(((int64_t)k + 1) * n / *n_boxes);
    boxes[k] = run_box(facet_box, items, first, last, reach);
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
  abut_array box = {NULL, 0, sizeof(abut_box)};
  abut_array item = {NULL, 0, sizeof(abut_keyed)};
  abut_status status = abut_array_reserve(s->context, &box, 0, n + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &item, 0, 2 * n + 1);
  if (status == ABUT_SUCCESS)
    cut(s, reach, max_boxes, box.data, item.data, boxes, n_boxes);
  abut_array_release(s->context, &box);
  abut_array_release(s->context, &item);
  return status;
}

/* Marks the facets that answers name. */
typedef struct
{
  const abut_record *records;
  uint8_t *near;
} marks;

static abut_status
mark(void *user, const abut_answers *a)
{
  const marks *m = user;
  for (int64_t e = a->start[0]; e < a->start[a->n]; ++e)
    m->near[m->records[a->slot[e]].facet] = 1;
  return ABUT_SUCCESS;
}

static bool
boxes_are_legal(int32_t n, const abut_box *boxes)
{
  for (int32_t k = 0; k < n; ++k)
    for (int d = 0; d < 3; ++d)
      if (!(isfinite(boxes[k].lower[d]) && isfinite(boxes[k].upper[d])))
        return false;
  return true;
}

abut_status
abut_search_select(abut_search *search, int32_t n_boxes, const abut_box *boxes,
                   int32_t *facets, int32_t *n_facets)
{
  if (search == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_search *s = search;
  if (n_boxes < 0 || (n_boxes > 0 && boxes == NULL) || facets == NULL
      || n_facets == NULL || !boxes_are_legal(n_boxes, boxes))
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "abut_search_select",
                     "a box is not finite, or an array is NULL");
  abut_status status = abut_search_update(s);
  abut_array near = {NULL, 0, sizeof(uint8_t)};
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &near, 0, (int64_t)s->n + 1);
  if (status != ABUT_SUCCESS)
    return status;
  marks m = {s->records.data, near.data};
  memset(near.data, 0, (size_t)s->n + 1);
  /* A box is six numbers, lower before upper. */
  const abut_query query = {n_boxes, s->surface->view.dimension, NULL,
                            n_boxes > 0 ? boxes->lower : NULL};
  status = abut_search_list(s, &query, 0, &s->list, mark, &m);
  *n_facets = 0;
  for (int32_t f = 0; f < s->n && status == ABUT_SUCCESS; ++f)
    if (m.near[f])
      facets[(*n_facets)++] = f;
  abut_array_release(s->context, &near);
  return status;
}
