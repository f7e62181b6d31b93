/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Node to segment: the node against its contact element, or the obstacle. The
 * share of the node has its full weight; the entries are itself and the shape
 * functions of the facet at the nearest point. */
#include "contact/coupling.h"
#include "contact/detect.h"

#include <string.h>

static abut_status
add_node(abut_coupling *c, int32_t node, const abut_contact *contact)
{
  const int32_t dim = c->secondary->view.dimension, f = contact->facet;
  const abut_surface_view *v = &c->primary->view;
  const abut_facet_kind kind = (abut_facet_kind)v->kinds[f];
  const double weight = ((const double *)c->full.data)[node];
  double nodes[3 * ABUT_FACET_MAX_NODES], shape[ABUT_FACET_MAX_NODES];
  const int32_t n = abut_surface_gather(c->primary, f, nodes);
  abut_coupling_shape(kind, nodes, contact->local, shape, NULL);
  abut_coupling_share *s = abut_coupling_new_share(c);
  if (s == NULL)
    return ABUT_OUT_OF_MEMORY;
  s->node = node;
  s->facet = f;
  s->weight = weight;
  for (int32_t d = 0; d < dim; ++d)
  {
    double y = 0.;
    for (int32_t a = 0; a < n; ++a)
      y += shape[a] * nodes[a * dim + d];
    s->gap[d] =
        weight * (y - c->secondary->view.position[(int64_t)dim * node + d]);
    s->normal[d] = -weight * contact->normal[d];
  }
  abut_status status =
      abut_coupling_new_entry(c, &s->n_secondary, node, weight);
  for (int32_t a = 0; a < n && status == ABUT_SUCCESS; ++a)
    status = abut_coupling_new_entry(c, &s->n_primary,
                                     v->connectivity[v->facet_start[f] + a],
                                     weight * shape[a]);
  return status;
}

abut_status
abut_coupling_add_nodal(abut_coupling *c)
{
  const int32_t *hanging = c->hanging.data, *order = c->node_order.data;
  const uint8_t *dropped = c->dropped.data, *wanted = c->nodes->wanted;
  const double *weight = c->obstacle != NULL ? c->covered.data : c->full.data;
  abut_detection_view view = {0};
  abut_status status = c->obstacle == NULL
                           ? abut_detection_get(c->detection, &view)
                           : ABUT_SUCCESS;
  for (int32_t i = 0; i < c->secondary->view.n_nodes && status == ABUT_SUCCESS;
       ++i)
  {
    const int32_t node = order[i];
    if (hanging[node] >= 0 || dropped[node] || !(weight[node] > 0.)
        || (wanted != NULL && !wanted[node]))
      continue;
    if (c->obstacle != NULL)
      status = abut_coupling_add_node_obstacle(c, node);
    else if (view.contact[node].facet >= 0)
      status = add_node(c, node, view.contact + node);
  }
  return status;
}
