/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A list made with the reach enlarged by skin holds all pairs for as long as
 *
 *     m_q + k m_s + r <= skin,   k = 3 + 2 relative_reach,
 *
 * where m_q and m_s are the largest motions of secondary and primary nodes
 * since, less the mean motion of the primary nodes (pairs do not notice a
 * common translation), and r is by how much the absolute reach has grown. For
 * facets with straight sides the box moves by at most m_s; centre and
 * distances from it by m_s and 2 m_s; the size, and with it the relative
 * reach, by 2 m_s times relative_reach. The boxes of curved facets follow from
 * control points that are combinations of the nodes with weights of sum at
 * most 9 in magnitude, so that 3 becomes 27. */
#include "search/reuse.h"

#include <math.h>
#include <string.h>

void
abut_skin_list_prepare(abut_skin_list *list)
{
  memset(list, 0, sizeof(*list));
  abut_list_prepare(&list->list);
  list->primary_position.element = sizeof(double);
  list->secondary_position.element = sizeof(double);
}

void
abut_skin_list_release(abut_context *context, abut_skin_list *list)
{
  abut_list_release(context, &list->list);
  abut_array_release(context, &list->primary_position);
  abut_array_release(context, &list->secondary_position);
  list->search = NULL;
}

static bool
is_straight(const abut_surface *s)
{
  if (s->uniform_kind >= 0)
    return abut_facet_n_nodes((abut_facet_kind)s->uniform_kind)
           == abut_facet_n_corners((abut_facet_kind)s->uniform_kind);
  for (int32_t f = 0; f < s->view.n_facets; ++f)
    if (abut_facet_n_nodes((abut_facet_kind)s->view.kinds[f])
        != abut_facet_n_corners((abut_facet_kind)s->view.kinds[f]))
      return false;
  return true;
}

/* Mean displacement of the nodes of a surface. */
static void
mean_motion(const abut_surface *s, const double *old, double *mean)
{
  const int dim = s->view.dimension == 2 ? 2 : 3;
  const double *now = s->view.position;
  const int32_t n = s->view.n_nodes;
  mean[0] = mean[1] = mean[2] = 0;
  for (int32_t i = 0; i < n; ++i)
    for (int d = 0; d < dim; ++d)
      mean[d] += now[(int64_t)dim * i + d] - old[(int64_t)dim * i + d];
  for (int d = 0; d < dim; ++d)
    mean[d] = n > 0 ? mean[d] / n : 0;
}

/* Largest displacement of a node beside the mean, and largest coordinate. */
static double
largest_motion(const abut_surface *s, const double *old, const double *mean,
               double *magnitude)
{
  const int dim = s->view.dimension == 2 ? 2 : 3;
  const double *now = s->view.position;
  double largest = 0;
  for (int32_t i = 0; i < s->view.n_nodes; ++i)
  {
    double square = 0;
    for (int d = 0; d < dim; ++d)
    {
      const double x = now[(int64_t)dim * i + d];
      const double u = x - old[(int64_t)dim * i + d] - mean[d];
      square += u * u;
      *magnitude = fabs(x) > *magnitude ? fabs(x) : *magnitude;
    }
    largest = square > largest ? square : largest;
  }
  return sqrt(largest);
}

bool
abut_skin_list_serves(const abut_skin_list *l, const abut_search *s,
                      const abut_surface *secondary, bool facets)
{
  if (l->search != s || l->secondary != secondary || l->serial != s->serial
      || l->facets != facets || l->skin != s->skin || !(s->skin > 0)
      || l->reach.relative != s->reach.relative)
    return false;
  double mean[3], magnitude = 0;
  mean_motion(s->surface, l->primary_position.data, mean);
  const double primary =
      largest_motion(s->surface, l->primary_position.data, mean, &magnitude);
  const double other =
      largest_motion(secondary, l->secondary_position.data, mean, &magnitude);
  const double factor = is_straight(s->surface) ? 3 : 27;
  const double own = facets && !is_straight(secondary) ? 9 * other : other;
  const double grown = fmax(0, s->reach.absolute - l->reach.absolute);
  const double moved = own + (factor + 2 * s->reach.relative) * primary + grown;
  return moved * (1 + 1e-9) + 1e-13 * magnitude <= s->skin;
}

/* Boxes of all facets of a surface into the search's scratch. */
static abut_status
facet_boxes(abut_search *s, const abut_surface *secondary)
{
  const int32_t n = secondary->view.n_facets;
  const abut_status status =
      abut_array_reserve(s->context, &s->query_box, 0, 6 * (int64_t)n);
  if (status != ABUT_SUCCESS)
    return status;
  double *box = s->query_box.data;
  for (int32_t f = 0; f < n; f += ABUT_LANES)
  {
    abut_lanes m;
    const int32_t some = n - f < ABUT_LANES ? n - f : ABUT_LANES;
    abut_lanes_bound(secondary, f, some, &m);
    for (int32_t l = 0; l < some; ++l, box += 6)
      for (int d = 0; d < 3; ++d)
      {
        box[d] = m.lower[d][l];
        box[3 + d] = m.upper[d][l];
      }
  }
  return ABUT_SUCCESS;
}

abut_status
abut_search_query_of(abut_search *s, const abut_surface *secondary, bool facets,
                     abut_query *query)
{
  const abut_query none = {0, secondary->view.dimension, NULL, NULL};
  *query = none;
  if (!facets)
  {
    query->n = secondary->view.n_nodes;
    query->points = secondary->view.position;
    return ABUT_SUCCESS;
  }
  const abut_status status = facet_boxes(s, secondary);
  query->n = secondary->view.n_facets;
  query->boxes = s->query_box.data;
  return status;
}

static abut_status
remember(abut_context *context, const abut_surface *s, abut_array *to)
{
  const int64_t n = (int64_t)s->view.n_nodes * s->view.dimension;
  const abut_status status = abut_array_reserve(context, to, 0, n);
  if (status == ABUT_SUCCESS && n > 0)
    memcpy(to->data, s->view.position, (size_t)n * sizeof(double));
  return status;
}

abut_status
abut_skin_list_make(abut_skin_list *l, abut_search *s,
                    const abut_surface *secondary, bool facets)
{
  abut_query query;
  l->search = NULL;
  abut_status status = abut_search_query_of(s, secondary, facets, &query);
  if (status == ABUT_SUCCESS)
    status = abut_search_list(s, &query, s->skin, &l->list, NULL, NULL);
  if (status == ABUT_SUCCESS && s->skin > 0)
    status = remember(s->context, s->surface, &l->primary_position);
  if (status == ABUT_SUCCESS && s->skin > 0)
    status = remember(s->context, secondary, &l->secondary_position);
  if (status != ABUT_SUCCESS)
    return status;
  l->search = s;
  l->secondary = secondary;
  l->serial = s->serial;
  l->skin = s->skin;
  l->reach = s->reach;
  l->facets = facets;
  return ABUT_SUCCESS;
}
