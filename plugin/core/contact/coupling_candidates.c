/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Which primary facets a secondary facet may be coupled with. */
#include "contact/coupling.h"

/* Whether two facets have a node of the same number. */
static bool
share_node(const abut_coupling *c, int32_t s, int32_t m)
{
  const abut_surface_view *v = &c->secondary->view, *w = &c->primary->view;
  for (int32_t e = v->facet_start[s]; e < v->facet_start[s + 1]; ++e)
    for (int32_t k = w->facet_start[m]; k < w->facet_start[m + 1]; ++k)
      if (abut_surface_node_id(c->secondary, v->connectivity[e])
          == abut_surface_node_id(c->primary, w->connectivity[k]))
        return true;
  return false;
}

abut_status
abut_coupling_find_candidates(abut_coupling *c, int32_t facet, int32_t *n)
{
  const int64_t from = c->pairs_view.start[facet],
                to = c->pairs_view.start[facet + 1];
  const int32_t *rank = c->order.primary_facet_rank.data;
  const abut_status status =
      abut_array_reserve(c->context, &c->work.candidates, 0, to - from);
  *n = 0;
  if (status != ABUT_SUCCESS)
    return status;
  int32_t *list = c->work.candidates.data;
  for (int64_t k = from; k < to; ++k)
  {
    const int32_t m = c->pairs_view.facet[k];
    if (c->compare_nodes && share_node(c, facet, m))
      continue;
    int32_t i = (*n)++;
    for (; i > 0 && rank[list[i - 1]] > rank[m]; --i)
      list[i] = list[i - 1];
    list[i] = m;
  }
  return ABUT_SUCCESS;
}

bool
abut_coupling_in_reach(const abut_coupling *c, double gap, double size)
{
  const double relative = c->options.search.relative_reach * size;
  const double reach = relative > c->reach ? relative : c->reach;
  const double depth =
      c->options.thickness > 0. ? 0.5 * c->options.thickness : reach;
  return gap <= reach && gap >= -depth && gap >= -reach;
}
