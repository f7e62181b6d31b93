/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Creation of a coupling. */
#include "contact/coupling.h"
#include "contact/detect.h"
#include "contact/discretisation.h"
#include "search/order.h"

#include <string.h>

typedef struct array_size
{
  abut_array *array;
  size_t element;
} array_size;

enum
{
  N_ARRAYS = 64
};

/* All arrays with the sizes of their elements (segments: set by their users);
 * returns their number. */
static int
list_arrays(abut_coupling *c, array_size *list)
{
  const array_size all[] = {
      {&c->order.facet, sizeof(int32_t)},
      {&c->order.node_rank, sizeof(int32_t)},
      {&c->order.node, sizeof(int32_t)},
      {&c->order.primary_facet_rank, sizeof(int32_t)},
      {&c->order.primary_node_rank, sizeof(int32_t)},
      {&c->order.keyed, sizeof(abut_keyed)},
      {&c->of_node.hanging, sizeof(int32_t)},
      {&c->of_node.dropped_as_given, sizeof(uint8_t)},
      {&c->of_node.dropped, sizeof(uint8_t)},
      {&c->of_node.purpose, sizeof(uint8_t)},
      {&c->of_node.full, sizeof(double)},
      {&c->of_node.covered, sizeof(double)},
      {&c->of_node.hat, sizeof(double)},
      {&c->of_node.covered_hat, sizeof(double)},
      {&c->of_node.reach, sizeof(double)},
      {&c->of_node.lone, sizeof(uint8_t)},
      {&c->of_node.flag, sizeof(uint8_t)},
      {&c->of_node.corner, sizeof(uint8_t)},
      {&c->of_node.bend, sizeof(double)},
      {&c->work.candidates, sizeof(int32_t)},
      {&c->work.segments, 0},
      {&c->work.points, sizeof(abut_coupling_point)},
      {&c->work.values, sizeof(double)},
      {&c->answer.asked, sizeof(double)},
      {&c->answer.distance, sizeof(double)},
      {&c->answer.gradient, sizeof(double)},
      {&c->answer.hessian, sizeof(double)},
      {&c->answer.asked_normal, sizeof(double)},
      {&c->answer.asked_size, sizeof(double)},
      {&c->answer.walkers, sizeof(char)},
      {&c->answer.walk, sizeof(double)},
      {&c->sum.shares, sizeof(abut_coupling_share)},
      {&c->sum.entries, sizeof(abut_coupling_entry)},
      {&c->change.rates, sizeof(double)},
      {&c->change.blocks, sizeof(abut_coupling_block)},
      {&c->change.block_values, sizeof(double)},
      {&c->change.directions, sizeof(abut_coupling_direction)},
      {&c->change.direction_node, sizeof(int32_t)},
      {&c->change.direction_change, sizeof(double)},
      {&c->change.line_place, sizeof(int32_t)},
      {&c->change.column_place, sizeof(int32_t)},
      {&c->sum.share_start, sizeof(int64_t)},
      {&c->sum.share_list, sizeof(int64_t)},
      {&c->sum.of_node[0], sizeof(double)},
      {&c->sum.of_node[1], sizeof(double)},
      {&c->sum.seen[0], sizeof(uint8_t)},
      {&c->sum.seen[1], sizeof(uint8_t)},
      {&c->sum.touched, sizeof(int32_t)},
      {&c->made.node, sizeof(int32_t)},
      {&c->made.facet, sizeof(int32_t)},
      {&c->made.number, sizeof(int32_t)},
      {&c->made.full, sizeof(double)},
      {&c->made.position, sizeof(double)},
      {&c->made.least, sizeof(double)},
      {&c->made.primary, sizeof(int32_t)},
      {&c->made.hessian_start, sizeof(int64_t)},
      {&c->made.hessian, sizeof(double)},
      {&c->made.line_start, sizeof(int64_t)},
      {&c->made.column_start, sizeof(int64_t)},
      {&c->made.line, sizeof(int32_t)},
      {&c->made.column, sizeof(int32_t)},
      {&c->made.stencil_node, sizeof(int32_t)},
      {&c->made.stencil_coefficient, sizeof(double)}};
  const int n = (int)(sizeof(all) / sizeof(all[0]));
  memcpy(list, all, sizeof(all));
  return n;
}

static const char *
fault_of(const abut_coupling_options *o, int32_t dimension)
{
  if (abut_discretisation_methods_get(o->discretisation) == NULL)
    return "unknown discretisation";
  if (o->quadrature_degree < 0 || o->quadrature_degree > 8)
    return "quadrature_degree is not in 0 .. 8";
  if (o->axisymmetric && dimension != 2)
    return "axisymmetric is for two dimensions";
  if (!(o->normal_cosine >= -1 && o->normal_cosine <= 1))
    return "normal_cosine is not in [-1, 1]";
  if (!(o->thickness >= 0 && o->thickness <= ABUT_FACET_LIMIT))
    return "thickness is negative or not finite";
  return NULL;
}

/* Every kind of the secondary's facets must be able to carry the
 * multipliers. */
static abut_status
check_kinds(const abut_surface *s, const abut_coupling_options *o,
            bool *quadratic, const char **reason)
{
  for (int32_t f = 0; f < s->view.n_facets; ++f)
  {
    const abut_facet_kind kind = (abut_facet_kind)s->view.kinds[f];
    const abut_status status = abut_coupling_check(
        o->discretisation, o->multiplier_degree, kind, reason);
    if (status != ABUT_SUCCESS)
      return status;
    *quadratic |= abut_facet_n_nodes(kind) > abut_facet_n_corners(kind);
  }
  return ABUT_SUCCESS;
}

/* Sort 0 .. n - 1 by the caller's numbers; order and rank (its inverse) may be
 * NULL. */
static abut_status
sort_numbers(abut_coupling *c, int32_t n, const int64_t *id, abut_array *order,
             abut_array *rank)
{
  abut_status status =
      abut_array_reserve(c->context, &c->order.keyed, 0, 2 * (int64_t)n + 1);
  if (status == ABUT_SUCCESS && order != NULL)
    status = abut_array_reserve(c->context, order, 0, (int64_t)n + 1);
  if (status == ABUT_SUCCESS && rank != NULL)
    status = abut_array_reserve(c->context, rank, 0, (int64_t)n + 1);
  if (status != ABUT_SUCCESS)
    return status;
  abut_keyed *items = c->order.keyed.data;
  for (int32_t i = 0; i < n; ++i)
  {
    const int64_t number = id != NULL ? id[i] : i;
    items[i].key = (uint64_t)number ^ UINT64_C(0x8000000000000000);
    items[i].index = i;
    items[i].unused = 0;
  }
  abut_order_sort(items, items + n, n);
  for (int32_t i = 0; i < n; ++i)
  {
    if (order != NULL)
      ((int32_t *)order->data)[i] = items[i].index;
    if (rank != NULL)
      ((int32_t *)rank->data)[items[i].index] = i;
  }
  return ABUT_SUCCESS;
}

static abut_status
sort_surfaces(abut_coupling *c)
{
  const abut_surface_view *s = &c->secondary->view;
  abut_status status =
      sort_numbers(c, s->n_facets, s->facet_id, &c->order.facet, NULL);
  if (status == ABUT_SUCCESS)
    status = sort_numbers(c, s->n_nodes, s->node_id, &c->order.node,
                          &c->order.node_rank);
  if (c->primary == NULL || status != ABUT_SUCCESS)
    return status;
  const abut_surface_view *m = &c->primary->view;
  status = sort_numbers(c, m->n_facets, m->facet_id, NULL,
                        &c->order.primary_facet_rank);
  if (status == ABUT_SUCCESS)
    status = sort_numbers(c, m->n_nodes, m->node_id, NULL,
                          &c->order.primary_node_rank);
  return status;
}

/* Node to segment finds its pairs by the detection. All groups of the primary
 * have the thickness. */
static abut_status
create_detection(abut_coupling *c)
{
  int32_t group[ABUT_MAX_GROUPS], n = 0;
  double thickness[ABUT_MAX_GROUPS];
  abut_detection_options o = abut_detection_defaults();
  o.search = c->options.search;
  o.normal_cosine = c->options.normal_cosine;
  o.thickness_group = group;
  o.thickness = thickness;
  for (int32_t f = 0;
       c->options.thickness > 0. && f < c->primary->view.n_facets; ++f)
  {
    const int32_t g = abut_surface_group(c->primary, f);
    int32_t i = 0;
    while (i < n && group[i] != g)
      ++i;
    if (i == ABUT_MAX_GROUPS)
      return abut_fail(c->context, ABUT_UNSUPPORTED, "abut_coupling_create",
                       "a thickness for more than 64 groups");
    group[i] = g;
    thickness[i] = c->options.thickness;
    n = i == n ? n + 1 : n;
  }
  o.n_thicknesses = n;
  return abut_detection_create(c->context, c->secondary, c->primary, &o,
                               &c->detection);
}

bool
abut_coupling_is_mortar(const abut_coupling *c)
{
  return c->method->info.is_weighted;
}

static abut_status
create_search(abut_coupling *c)
{
  if (c->primary == NULL)
    return ABUT_SUCCESS;
  if (c->method->detects_nodes)
    return create_detection(c);
  const abut_status status = abut_search_create(c->context, c->primary,
                                                &c->options.search, &c->search);
  return status == ABUT_SUCCESS ? abut_pairs_create(c->context, &c->pairs)
                                : status;
}

abut_status
abut_coupling_create_any(abut_context *context, const char *call,
                         abut_surface *secondary, abut_surface *primary,
                         abut_obstacle *obstacle,
                         const abut_coupling_options *options,
                         abut_coupling **coupling)
{
  abut_coupling_options chosen = abut_coupling_defaults();
  abut_status status =
      abut_copy_in(context, call, &chosen, sizeof(chosen), options);
  if (status != ABUT_SUCCESS)
    return status;
  const char *fault = fault_of(&chosen, secondary->view.dimension);
  bool quadratic = false;
  if (fault != NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, fault);
  status = check_kinds(secondary, &chosen, &quadratic, &fault);
  if (status != ABUT_SUCCESS)
    return abut_fail(context, status, call, fault);
  abut_coupling *c = abut_object_create(context, sizeof(*c));
  if (c == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, call, "no memory");
  array_size arrays[N_ARRAYS];
  c->view.struct_size = sizeof(c->view);
  c->view.dimension = secondary->view.dimension;
  const int n = list_arrays(c, arrays);
  for (int i = 0; i < n; ++i)
    arrays[i].array->element = arrays[i].element;
  c->context = context;
  c->secondary = secondary;
  c->primary = primary;
  c->obstacle = obstacle;
  c->options = chosen;
  c->method = abut_discretisation_methods_get(chosen.discretisation);
  c->quadratic = quadratic;
  c->compare_nodes = primary != NULL
                     && (secondary == primary
                         || (secondary->view.node_id != NULL
                             && primary->view.node_id != NULL));
  *coupling = c;
  status = sort_surfaces(c);
  if (status == ABUT_SUCCESS)
    status = create_search(c);
  if (status != ABUT_SUCCESS)
    (void)abut_coupling_destroy(coupling);
  return status;
}

abut_status
abut_coupling_create(abut_context *context, abut_surface *secondary,
                     abut_surface *primary,
                     const abut_coupling_options *options,
                     abut_coupling **coupling)
{
  static const char call[] = "abut_coupling_create";
  if (context == NULL || secondary == NULL || primary == NULL
      || coupling == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context, surface or result is NULL");
  if (secondary->view.dimension != primary->view.dimension)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "the surfaces have different dimensions");
  return abut_coupling_create_any(context, call, secondary, primary, NULL,
                                  options, coupling);
}

abut_status
abut_coupling_destroy(abut_coupling **coupling)
{
  if (coupling == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_coupling *c = *coupling;
  if (c == NULL)
    return ABUT_SUCCESS;
  array_size arrays[N_ARRAYS];
  const int n = list_arrays(c, arrays);
  for (int i = 0; i < n; ++i)
    abut_array_release(c->context, arrays[i].array);
  (void)abut_detection_destroy(&c->detection);
  (void)abut_pairs_destroy(&c->pairs);
  (void)abut_search_destroy(&c->search);
  abut_object_destroy(c->context, c, sizeof(*c));
  *coupling = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_get_sized(const abut_coupling *coupling, abut_coupling_view *view)
{
  if (coupling == NULL || view == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_copy_out(coupling->context, "abut_coupling_get", view,
                       sizeof(coupling->view), &coupling->view);
}

abut_status
abut_coupling_get_statistics_sized(const abut_coupling *coupling,
                                   abut_coupling_statistics *statistics)
{
  if (coupling == NULL || statistics == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_copy_out(coupling->context, "abut_coupling_get_statistics",
                       statistics, sizeof(coupling->statistics),
                       &coupling->statistics);
}
