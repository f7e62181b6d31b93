/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Couplings of arbitrary surfaces with arbitrary options and nodes: points are
 * finite, have positive weights and coefficients that add up to one, and are
 * the same when built again. */
#include "two_surfaces.h"

#include <abut/coupling.h>

static abut_coupling_options
take_coupling_options(input *in)
{
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation = (abut_discretisation)(take_byte(in) % 5);
  o.multiplier_degree = take_below(in, 3);
  o.quadrature_degree = take_below(in, 10);
  const int flags = take_byte(in);
  o.segments = flags % 4 != 0;
  o.axisymmetric = flags % 8 == 5;
  /* Mostly any: sheets all face the same way. */
  o.normal_cosine = flags & 16 ? take_grid(in) / 8. : 1.;
  o.thickness = flags & 32 ? take_raw(in) : 0.;
  o.search = take_options(in);
  return o;
}

typedef struct node_arrays
{
  uint8_t wanted[max_nodes], wanted_facet[max_facets], dropped[max_nodes];
  int32_t hanging[max_nodes], start[max_nodes + 1], parent[2 * max_nodes];
  double weight[2 * max_nodes];
} node_arrays;

static abut_coupling_nodes
take_nodes(input *in, int32_t n_nodes, node_arrays *a)
{
  abut_coupling_nodes n = abut_coupling_nodes_defaults();
  const int flags = take_byte(in);
  for (int i = 0; i < max_nodes; ++i)
  {
    const int bits = flags & 7 ? take_byte(in) : 0;
    a->wanted[i] = bits & 1;
    a->dropped[i] = bits % 8 == 3;
    a->wanted_facet[i] = bits & 1;
  }
  n.wanted = flags & 1 ? a->wanted : NULL;
  n.wanted_facet = flags & 1 ? a->wanted_facet : NULL;
  n.dropped = flags & 2 ? a->dropped : NULL;
  n.n_hanging = flags & 4 && n_nodes > 0 ? take_below(in, 8) : 0;
  a->start[0] = 0;
  for (int h = 0; h < n.n_hanging; ++h)
  {
    const double w = take_grid(in) / 8.;
    a->hanging[h] = (int32_t)take_byte(in) % n_nodes;
    a->start[h + 1] = 2 * h + 2;
    for (int e = 2 * h; e < 2 * h + 2; ++e)
    {
      a->parent[e] = (int32_t)take_byte(in) % n_nodes;
      a->weight[e] = e % 2 ? w : 1. - w;
    }
  }
  n.hanging_node = a->hanging;
  n.hanging_start = a->start;
  n.hanging_parent = a->parent;
  n.hanging_weight = a->weight;
  return n;
}

/* Finite entries from..to in range that add up to one with this sign. */
static void
check_side(const abut_points_view *v, int64_t from, int64_t to, double sign,
           int32_t first, int32_t n_nodes)
{
  double sum = 0., size = 0.;
  REQUIRE(to > from);
  for (int64_t e = from; e < to; ++e)
  {
    REQUIRE(v->node[e] >= first && v->node[e] < first + n_nodes);
    REQUIRE(isfinite(v->coefficient[e]));
    sum += sign * v->coefficient[e];
    size += fabs(v->coefficient[e]);
  }
  REQUIRE(fabs(sum - 1.) <= 1e-12 * (1. + size));
}

static void
check_points(const abut_coupling_view *c, const abut_points_view *v,
             int32_t n_secondary, int32_t n_primary)
{
  for (int32_t j = 0; j < v->n_points; ++j)
  {
    REQUIRE(c->node[j] >= -1 && c->node[j] < n_secondary);
    REQUIRE(v->weight[j] > 0. && isfinite(v->weight[j]));
    REQUIRE(isfinite(v->gap[j]) && isfinite(c->full_weight[j]));
    for (int d = 0; d < v->dimension; ++d)
      REQUIRE(fabs(v->frame[v->dimension * j + d]) <= 1. + 1e-12);
    const int64_t middle = v->start[j] + v->n_secondary[j];
    check_side(v, v->start[j], middle, 1., 0, n_secondary);
    check_side(v, middle, v->start[j + 1], -1., n_secondary, n_primary);
  }
}

void
run(input *in, abut_context *context, abut_surface *secondary,
    abut_surface *primary, arrays *moved)
{
  static node_arrays arrays_of_nodes;
  abut_coupling *coupling = NULL;
  abut_points *points = NULL;
  abut_coupling_view view;
  abut_points_view set;
  abut_surface_view s, m;
  const abut_coupling_options o = take_coupling_options(in);
  REQUIRE(abut_surface_get(secondary, &s) == ABUT_SUCCESS);
  REQUIRE(abut_surface_get(primary, &m) == ABUT_SUCCESS);
  const abut_coupling_nodes nodes = take_nodes(in, s.n_nodes, &arrays_of_nodes);
  if (abut_coupling_create(context, secondary, primary, &o, &coupling)
      != ABUT_SUCCESS)
    return;
  REQUIRE(abut_points_create(context, s.dimension, &points) == ABUT_SUCCESS);
  const abut_coupling_target target = abut_coupling_target_defaults(points);
  double area = -1.;
  for (int k = 0; k < 3; ++k)
  {
    abut_coupling_statistics statistics;
    if (k == 2)
    {
      for (int i = 0; i < moved->data.n_nodes * moved->data.dimension; ++i)
        moved->position[i] += take_grid(in) * 0.1;
      (void)abut_surface_update(primary, moved->position);
    }
    REQUIRE(abut_points_clear(points) == ABUT_SUCCESS);
    const abut_status status =
        abut_coupling_build(coupling, &nodes, 0., &target);
    REQUIRE(status >= 0);
    REQUIRE(abut_coupling_get(coupling, &view) == ABUT_SUCCESS);
    REQUIRE(abut_points_get(points, &set) == ABUT_SUCCESS);
    REQUIRE(view.n_points == set.n_points);
    REQUIRE(status == ABUT_SUCCESS || view.n_points == 0);
    check_points(&view, &set, s.n_nodes, m.n_nodes);
    REQUIRE(abut_coupling_get_statistics(coupling, &statistics)
            == ABUT_SUCCESS);
    REQUIRE(k != 1 || statistics.covered_area == area);
    area = statistics.covered_area;
  }
  REQUIRE(abut_points_destroy(&points) == ABUT_SUCCESS);
  REQUIRE(abut_coupling_destroy(&coupling) == ABUT_SUCCESS);
}
