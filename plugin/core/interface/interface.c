/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A pair: its coupling, where its surfaces stand, and the places of its points.
 */
#include "constraint/places.h"
#include "constraint/points.h"
#include "geometry/surface.h"
#include "geometry/vector.h"
#include "interface/inside.h"
#include "interface/pair.h"

#include <string.h>

static int32_t
n_nodes_of(const abut_side *s)
{
  return s->surface == NULL ? 0 : s->surface->view.n_nodes;
}

/* Numbers 0 .. n - 1 after the first, or those given. */
static abut_status
copy_numbers(abut_context *context, abut_array *array, int32_t n,
             const int32_t *given, int32_t first)
{
  const abut_status status = abut_array_reserve(context, array, 0, n);
  for (int32_t i = 0; i < n && status == ABUT_SUCCESS; ++i)
    ((int32_t *)array->data)[i] = given == NULL ? first + i : given[i];
  return status;
}

static abut_status
set_up_side(abut_interface *p, abut_side *s, const int32_t *node, int32_t first)
{
  const int32_t n = n_nodes_of(s);
  const int64_t size = (int64_t)n * p->dimension;
  s->node.element = sizeof(int32_t);
  s->reference.element = s->current.element = sizeof(double);
  abut_status status = copy_numbers(p->context, &s->node, n, node, first);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(p->context, &s->reference, 0, size);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(p->context, &s->current, 0, size);
  if (status == ABUT_SUCCESS && n > 0)
    memcpy(s->reference.data, s->surface->view.position,
           (size_t)size * sizeof(double));
  return status;
}

static abut_status
create_coupling(abut_interface *p, const abut_coupling_options *given)
{
  abut_coupling_options options = *given;
  const bool displaced = p->kinematics->points != ABUT_CONFIGURATION_REFERENCE;
  options.interpolated_gaps =
      p->kinematics->points != ABUT_CONFIGURATION_COMMITTED
      || p->obstacle != NULL;
  /* The longer lists of candidates are, the longer they serve. */
  if (options.search.skin == 0. && displaced && p->obstacle == NULL)
    options.search.skin = p->facet_size;
  return p->obstacle != NULL
             ? abut_coupling_create_obstacle(p->context, p->secondary.surface,
                                             p->obstacle, &options,
                                             &p->coupling)
             : abut_coupling_create(p->context, p->secondary.surface,
                                    p->primary.surface, &options, &p->coupling);
}

abut_status
abut_interface_create(abut_context *context, abut_surface *secondary,
                      abut_surface *primary, abut_obstacle *obstacle,
                      const abut_interface_options *options,
                      abut_interface **made)
{
  static const char call[] = "abut_interface_create";
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_interface_options chosen = abut_interface_defaults();
  abut_status status =
      abut_copy_in(context, call, &chosen, sizeof(chosen), options);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_kinematics_info *kinematics =
      abut_kinematics_get(chosen.kinematics);
  if (made == NULL || secondary == NULL
      || (primary == NULL) == (obstacle == NULL) || kinematics == NULL
      || chosen.number < 0 || !(chosen.facet_size >= 0.))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "there are not two sides, no such kinematics, or a number "
                     "is negative");
  abut_interface *p = abut_object_create(context, sizeof(abut_interface));
  if (p == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, call, "no memory");
  p->context = context;
  p->kinematics = kinematics;
  p->word = chosen.kinematics;
  p->dimension = secondary->view.dimension;
  p->number = chosen.number;
  p->tangents = chosen.tangents;
  p->flush = chosen.flush;
  p->facet_size = chosen.facet_size;
  p->obstacle = obstacle;
  p->discretisation = chosen.coupling.discretisation;
  p->secondary.surface = secondary;
  p->primary.surface = primary;
  p->facet.element = p->line.element = sizeof(int32_t);
  status = set_up_side(p, &p->secondary, chosen.secondary_node, 0);
  if (status == ABUT_SUCCESS)
    status = set_up_side(p, &p->primary, chosen.primary_node,
                         secondary->view.n_nodes);
  if (status == ABUT_SUCCESS)
    status = copy_numbers(context, &p->facet, secondary->view.n_facets,
                          chosen.secondary_facet, 0);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &p->line, 0, ABUT_FACET_MAX_NODES);
  if (status == ABUT_SUCCESS)
    status = create_coupling(p, &chosen.coupling);
  if (status != ABUT_SUCCESS)
    (void)abut_interface_destroy(&p);
  *made = p;
  return status;
}

abut_status
abut_interface_destroy(abut_interface **pair)
{
  if (pair == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_interface *p = *pair;
  if (p == NULL)
    return ABUT_SUCCESS;
  (void)abut_coupling_destroy(&p->coupling);
  abut_side *sides[2] = {&p->secondary, &p->primary};
  for (int k = 0; k < 2; ++k)
  {
    abut_array_release(p->context, &sides[k]->node);
    abut_array_release(p->context, &sides[k]->reference);
    abut_array_release(p->context, &sides[k]->current);
  }
  abut_array_release(p->context, &p->facet);
  abut_array_release(p->context, &p->line);
  abut_object_destroy(p->context, p, sizeof(*p));
  *pair = NULL;
  return ABUT_SUCCESS;
}

abut_coupling *
abut_interface_coupling(abut_interface *pair)
{
  return pair == NULL ? NULL : pair->coupling;
}

/* Whether the caller's numbers of nodes are below n_nodes. */
static abut_status
check_numbers(const abut_interface *p, const char *call, int32_t n_nodes)
{
  const abut_side *sides[2] = {&p->secondary, &p->primary};
  for (int k = 0; k < 2; ++k)
    for (int32_t i = 0; i < n_nodes_of(sides[k]); ++i)
    {
      const int32_t node = ((const int32_t *)sides[k]->node.data)[i];
      if (node < 0 || node >= n_nodes)
        return abut_fail(p->context, ABUT_INVALID_ARGUMENT, call,
                         "a node of a surface is outside the range of the "
                         "nodes");
    }
  return ABUT_SUCCESS;
}

static abut_status
move_side(const abut_interface *p, abut_side *s, const double *position)
{
  const int32_t *node = s->node.data, dim = p->dimension;
  double *x = s->current.data;
  if (s->surface == NULL)
    return ABUT_SUCCESS;
  if (position == NULL)
    return abut_surface_update(s->surface, s->reference.data);
  for (int32_t i = 0; i < n_nodes_of(s); ++i)
    memcpy(x + (int64_t)i * dim, position + (int64_t)node[i] * dim,
           (size_t)dim * sizeof(double));
  return abut_surface_update(s->surface, x);
}

abut_status
abut_interface_move(abut_interface *pair, int32_t n_nodes,
                    const double *position)
{
  static const char call[] = "abut_interface_move";
  if (pair == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_status status =
      position == NULL ? ABUT_SUCCESS : check_numbers(pair, call, n_nodes);
  if (status == ABUT_SUCCESS)
    status = move_side(pair, &pair->secondary, position);
  return status == ABUT_SUCCESS ? move_side(pair, &pair->primary, position)
                                : status;
}

/* Current positions of a side whose surface stands in the reference
 * configuration. */
static const double *
displaced(const abut_interface *p, abut_side *s, const double *displacement)
{
  const int32_t *node = s->node.data, dim = p->dimension;
  const double *reference = s->reference.data;
  double *x = s->current.data;
  for (int32_t i = 0; i < n_nodes_of(s); ++i)
    for (int32_t d = 0; d < dim; ++d)
    {
      const int64_t k = (int64_t)i * dim + d;
      x[k] =
          reference[k]
          + (displacement == NULL ? 0.
                                  : displacement[(int64_t)node[i] * dim + d]);
    }
  return x;
}

/* The caller's numbers of the nodes of a primary facet. */
static int32_t
nodes_of_facet(const abut_interface *p, int32_t facet, int32_t *node)
{
  const abut_surface_view *view = &p->primary.surface->view;
  const int32_t first = view->facet_start[facet],
                n = view->facet_start[facet + 1] - first;
  for (int32_t a = 0; a < n; ++a)
    node[a] =
        ((const int32_t *)p->primary.node.data)[view->connectivity[first + a]];
  return n;
}

static abut_place
place_of(const abut_interface *p, const abut_coupling_view *v, int32_t i)
{
  const int32_t *node = p->secondary.node.data, *facet = p->facet.data;
  abut_place place = abut_place_defaults();
  place.pair = p->number;
  place.node = v->node[i] < 0 ? -1 : node[v->node[i]];
  place.facet = v->node[i] < 0 ? facet[v->facet[i]] : -1;
  place.position = v->position + (int64_t)i * p->dimension;
  if (p->kinematics->directions != ABUT_CONFIGURATION_CURRENT)
    return place;
  if (v->hessian_start[i + 1] > v->hessian_start[i])
    place.block = v->hessian + v->hessian_start[i];
  if (v->least != NULL)
    place.least = v->least[i];
  if (v->line != NULL)
  {
    place.line = v->line + v->line_start[i];
    place.n_lines = (int32_t)(v->line_start[i + 1] - v->line_start[i]);
    place.column = v->column + v->column_start[i];
    place.n_columns = (int32_t)(v->column_start[i + 1] - v->column_start[i]);
  }
  else if (v->primary[i] >= 0)
  {
    place.n_lines = nodes_of_facet(p, v->primary[i], p->line.data);
    place.line = p->line.data;
  }
  return place;
}

static abut_status
append_places(const abut_interface *p, const abut_interface_target *t)
{
  abut_coupling_view view;
  abut_status status = abut_coupling_get(p->coupling, &view);
  for (int32_t i = 0; i < view.n_points && status == ABUT_SUCCESS; ++i)
  {
    const abut_place place = place_of(p, &view, i);
    status = abut_points_append_place(t->points, &place);
  }
  if (status == ABUT_SUCCESS && t->displacement != NULL
      && p->kinematics->directions != ABUT_CONFIGURATION_REFERENCE)
    status = abut_points_set_origin(t->points, view.first, view.n_points,
                                    t->n_nodes, t->displacement);
  if (status != ABUT_SUCCESS)
    abut_points_truncate(t->points, view.first);
  return status;
}

abut_status
abut_interface_build(abut_interface *pair, const abut_interface_target *target)
{
  static const char call[] = "abut_interface_build";
  if (pair == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_interface *p = pair;
  abut_interface_target t = abut_interface_target_defaults(NULL);
  abut_status status = abut_copy_in(p->context, call, &t, sizeof(t), target);
  if (status == ABUT_SUCCESS && t.displacement != NULL)
    status = check_numbers(p, call, t.n_nodes);
  if (status != ABUT_SUCCESS)
    return status;
  abut_coupling_target to = abut_coupling_target_defaults(t.points);
  to.secondary_node = p->secondary.node.data;
  to.primary_node = p->primary.node.data;
  to.id = t.id;
  to.tie_axes = t.tie_axes;
  to.gap = t.gap;
  to.flush = p->flush;
  to.tangents = p->tangents;
  to.kinematics = p->word;
  if (p->kinematics->points != ABUT_CONFIGURATION_REFERENCE)
    to.reference = p->secondary.reference.data;
  else if (p->kinematics->directions != p->kinematics->points)
  {
    to.current = displaced(p, &p->secondary, t.displacement);
    to.current_primary = displaced(p, &p->primary, t.displacement);
  }
  status = abut_coupling_build(p->coupling, t.nodes, t.motion, &to);
  return status == ABUT_SUCCESS ? append_places(p, &t) : status;
}

/* Distances of the nodes of one surface from the facets of the other. */
static abut_status
find_distances(const abut_interface *p, const abut_side *nodes,
               const abut_side *facets, const abut_detection_options *options,
               double *distance)
{
  abut_detection *detection = NULL;
  abut_detection_view view = {0};
  const abut_status status = abut_detect(
      p->context, nodes->surface, facets->surface, options, &detection, &view);
  const int32_t *number = nodes->node.data;
  for (int32_t i = 0; i < view.n_nodes && status == ABUT_SUCCESS; ++i)
    if (view.contact[i].facet >= 0 && view.contact[i].gap > -p->facet_size)
      distance[number[i]] = view.contact[i].gap;
  (void)abut_detection_destroy(&detection);
  return status;
}

/* A point sees the facets around its node: the least of their nodes. */
static void
spread_distances(abut_interface *p, double *distance)
{
  const abut_surface_view *v = &p->secondary.surface->view;
  const int32_t *number = p->secondary.node.data;
  double *around = p->secondary.current.data;
  for (int32_t i = 0; i < v->n_nodes; ++i)
    around[i] = distance[number[i]];
  for (int32_t f = 0; f < v->n_facets; ++f)
  {
    double least = INFINITY;
    for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
      least = min2(least, distance[number[v->connectivity[e]]]);
    for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
      around[v->connectivity[e]] = min2(around[v->connectivity[e]], least);
  }
  for (int32_t i = 0; i < v->n_nodes; ++i)
    distance[number[i]] = around[i];
}

static void
find_clearances(const abut_interface *p, const abut_points_view *v,
                const abut_places_view *places, const double *distance,
                double gap, double *clearance)
{
  for (int32_t i = 0; i < v->n_points; ++i)
  {
    if (places->pair[i] != p->number)
      continue;
    double least = INFINITY;
    for (int64_t e = v->start[i]; e < v->start[i + 1]; ++e)
      least = min2(least, distance[v->node[e]]);
    /* Edges may cross between nodes. */
    if (places->least[i] > -p->facet_size)
      least = min2(least, places->least[i]);
    clearance[v->component_start[i]] = least + gap;
  }
}

abut_status
abut_interface_clearances(abut_interface *pair, const abut_points *points,
                          const abut_detection_options *detection, double reach,
                          double gap, int32_t n_nodes, double *clearance)
{
  static const char call[] = "abut_interface_clearances";
  if (pair == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_points_view v;
  abut_places_view places;
  abut_status status = abut_points_get_placed(points, &v, &places);
  if (status == ABUT_SUCCESS)
    status = abut_points_check_nodes(points, call, n_nodes);
  if (status == ABUT_SUCCESS)
    status = check_numbers(pair, call, n_nodes);
  if (status != ABUT_SUCCESS)
    return status;
  if (pair->primary.surface == NULL || (v.n_points > 0 && clearance == NULL))
    return abut_fail(pair->context, ABUT_INVALID_ARGUMENT, call,
                     "there is no primary surface, or clearance is NULL");
  abut_detection_options options = abut_detection_defaults();
  status =
      abut_copy_in(pair->context, call, &options, sizeof(options), detection);
  if (status != ABUT_SUCCESS)
    return status;
  options.search.reach = max2(options.search.reach, reach);
  options.extension = 0.;
  abut_array list = {NULL, 0, sizeof(double)};
  status = abut_array_reserve(pair->context, &list, 0, n_nodes);
  double *distance = list.data;
  for (int32_t i = 0; i < n_nodes && status == ABUT_SUCCESS; ++i)
    distance[i] = INFINITY;
  if (status == ABUT_SUCCESS)
    status = find_distances(pair, &pair->secondary, &pair->primary, &options,
                            distance);
  if (status == ABUT_SUCCESS)
    status = find_distances(pair, &pair->primary, &pair->secondary, &options,
                            distance);
  if (status == ABUT_SUCCESS)
  {
    spread_distances(pair, distance);
    find_clearances(pair, &v, &places, distance, gap, clearance);
  }
  abut_array_release(pair->context, &list);
  return status;
}
