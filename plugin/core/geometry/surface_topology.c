/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Which facets a node belongs to, and which facet lies across a side. */
#include "geometry/surface.h"

/* Facets of each node in ascending order, by counting. */
static abut_status
build_node_facets(abut_surface *s)
{
  const int32_t n_entries = s->view.facet_start[s->view.n_facets];
  abut_status status = abut_array_reserve(s->context, &s->node_start, 0,
                                          (int64_t)s->view.n_nodes + 2);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->node_facet, 0,
                                (int64_t)n_entries + 1);
  if (status != ABUT_SUCCESS)
    return status;
  int32_t *start = s->node_start.data;
  int32_t *facet = s->node_facet.data;
  const int32_t *c = s->view.connectivity;
  for (int32_t i = 0; i < s->view.n_nodes + 2; ++i)
    start[i] = 0;
  /* Counted two places ahead, so that filling leaves start in its place. */
  for (int32_t e = 0; e < n_entries; ++e)
    ++start[c[e] + 2];
  for (int32_t i = 2; i < s->view.n_nodes + 2; ++i)
    start[i] += start[i - 1];
  for (int32_t f = 0; f < s->view.n_facets; ++f)
    for (int32_t e = s->view.facet_start[f]; e < s->view.facet_start[f + 1];
         ++e)
      facet[start[c[e] + 1]++] = f;
  s->view.node_start = start;
  s->view.node_facet = facet;
  return ABUT_SUCCESS;
}

/* Whether facet g has a side (2D: an end) with the nodes a and b. */
static bool
has_side(const abut_surface *s, int32_t g, int32_t a, int32_t b)
{
  const int32_t *c = s->view.connectivity + s->view.facet_start[g];
  const int32_t n = abut_facet_n_corners((abut_facet_kind)s->view.kinds[g]);
  if (n == 2)
    return c[0] == a || c[1] == a;
  for (int32_t k = 0; k < n; ++k)
  {
    const int32_t p = c[abut_facet_loop(n, k)];
    const int32_t q = c[abut_facet_loop(n, k + 1)];
    if ((p == a && q == b) || (p == b && q == a))
      return true;
  }
  return false;
}

static int32_t
find_neighbour(const abut_surface *s, int32_t f, int32_t a, int32_t b)
{
  int32_t found = ABUT_NEIGHBOUR_BORDER;
  for (int32_t e = s->view.node_start[a]; e < s->view.node_start[a + 1]; ++e)
  {
    const int32_t g = s->view.node_facet[e];
    if (g == f || !has_side(s, g, a, b))
      continue;
    if (found >= 0)
      return ABUT_NEIGHBOUR_MANY;
    found = g;
  }
  return found;
}

abut_status
abut_surface_topology(abut_surface *s)
{
  abut_status status = build_node_facets(s);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->neighbour, 0,
                                4 * (int64_t)s->view.n_facets + 1);
  if (status != ABUT_SUCCESS)
    return status;
  int32_t *neighbour = s->neighbour.data;
  for (int32_t f = 0; f < s->view.n_facets; ++f)
  {
    const int32_t *c = s->view.connectivity + s->view.facet_start[f];
    const int32_t n = abut_facet_n_corners((abut_facet_kind)s->view.kinds[f]);
    for (int32_t k = 0; k < 4; ++k)
    {
      int32_t *out = neighbour + 4 * (int64_t)f + k;
      if (k >= n)
        *out = ABUT_NEIGHBOUR_UNUSED;
      else if (n == 2)
        *out = find_neighbour(s, f, c[k], c[k]);
      else
        *out = find_neighbour(s, f, c[abut_facet_loop(n, k)],
                              c[abut_facet_loop(n, k + 1)]);
    }
  }
  s->view.neighbour = neighbour;
  return ABUT_SUCCESS;
}
