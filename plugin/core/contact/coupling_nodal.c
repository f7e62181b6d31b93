/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Node to segment: the node against its contact element, or the obstacle. The
 * share of the node has its full weight; the entries are itself and the shape
 * functions of the facet at the nearest point. Nodes that move follow that
 * point (coupling_near.c). */
#include "contact/coupling.h"
#include "contact/detect.h"

#include <math.h>
#include <string.h>

/* Distance from the axis, relative to the facet, that counts as 0. */
static const double round_off = 1e-10;

/* A node of a quadratic facet on the axis of revolution has no area: with
 * phi = (1 - s)(1 - 2 s) and r = s the integral of phi r is 0. Without a row
 * nothing would hold it. With this share of the area L r of the ring its
 * pressure is the difference of those at the ends of the facet, where pressures
 * are parabolas 1 - a s^2, whose integral with phi r is a / 60. */
static const double axis_share = 1. / 60.;

/* The share of a node with this facet; without its gap. */
static abut_coupling_share *
new_share(abut_coupling *c, int32_t node, int32_t f)
{
  abut_coupling_share *s = abut_coupling_new_share(c);
  if (s == NULL)
    return NULL;
  s->node = node;
  s->facet = f;
  s->weight = ((const double *)c->of_node.full.data)[node];
  return s;
}

static abut_status
add_entries(abut_coupling *c, int32_t node, abut_coupling_share *s,
            const double *shape)
{
  const abut_surface_view *v = &c->primary->view;
  const int32_t *nodes = v->connectivity + v->facet_start[s->facet];
  const int32_t n = v->facet_start[s->facet + 1] - v->facet_start[s->facet];
  abut_status status =
      abut_coupling_new_entry(c, &s->n_secondary, node, s->weight);
  for (int32_t a = 0; a < n && status == ABUT_SUCCESS; ++a)
    status = abut_coupling_new_entry(c, &s->n_primary, nodes[a],
                                     s->weight * shape[a]);
  return status;
}

static abut_status
add_node(abut_coupling *c, int32_t node, const abut_contact *contact)
{
  const int32_t dim = c->secondary->view.dimension, f = contact->facet;
  double nodes[3 * ABUT_FACET_MAX_NODES], shape[ABUT_FACET_MAX_NODES];
  const int32_t n = abut_surface_gather(c->primary, f, nodes);
  abut_coupling_shape((abut_facet_kind)c->primary->view.kinds[f], nodes,
                      contact->local, shape, NULL);
  abut_coupling_share *s = new_share(c, node, f);
  if (s == NULL)
    return ABUT_OUT_OF_MEMORY;
  for (int32_t d = 0; d < dim; ++d)
  {
    double y = 0.;
    for (int32_t a = 0; a < n; ++a)
      y += shape[a] * nodes[a * dim + d];
    s->gap[d] =
        s->weight * (y - c->secondary->view.position[(int64_t)dim * node + d]);
    s->normal[d] = -s->weight * contact->normal[d];
  }
  return add_entries(c, node, s, shape);
}

static abut_status
add_moving(abut_coupling *c, int32_t node, int32_t f)
{
  const int32_t dim = c->secondary->view.dimension;
  abut_coupling_opposite opposite;
  bool found = false;
  const abut_status status = abut_coupling_follow(
      c, f, c->secondary->view.position + (int64_t)dim * node, &found,
      &opposite);
  if (status != ABUT_SUCCESS || !found)
    return status;
  abut_coupling_share *s = new_share(c, node, f);
  if (s == NULL)
    return ABUT_OUT_OF_MEMORY;
  s->primary = f;
  s->hessian = opposite.hessian;
  s->distance = s->weight * opposite.gap;
  for (int32_t d = 0; d < dim; ++d)
    s->normal[d] = s->weight * opposite.normal[d];
  return add_entries(c, node, s, opposite.shape);
}

void
abut_coupling_add_axis(const abut_coupling *c, const abut_coupling_facet *facet,
                       double *sum)
{
  if (!c->options.axisymmetric || facet->kind != ABUT_FACET_LINE3)
    return;
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *node = v->connectivity + v->facet_start[facet->index];
  for (int a = 0; a < 2; ++a)
    if (fabs(facet->reference[2 * a]) <= round_off * facet->size)
      sum[node[a]] += axis_share * 2. * 3.14159265358979323846 * facet->size
                      * facet->reference[2 * (1 - a)];
}

abut_status
abut_coupling_add_nodal(abut_coupling *c)
{
  const int32_t *hanging = c->of_node.hanging.data, *order = c->order.node.data;
  const uint8_t *dropped = c->of_node.dropped.data,
                *wanted = c->of_node.given->wanted;
  const double *weight =
      c->obstacle != NULL ? c->of_node.covered.data : c->of_node.full.data;
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
      status = abut_coupling_moves(c)
                   ? add_moving(c, node, view.contact[node].facet)
                   : add_node(c, node, view.contact + node);
  }
  return status;
}
