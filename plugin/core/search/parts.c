/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The facets of a part of a surface near the bounds of another. */
#include "search/search.h"

#include <abut/parts.h>

#include <math.h>
#include <string.h>

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
