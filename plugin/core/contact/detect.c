/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The detection, in the steps by which contact codes for finite elements have
 * long described it:
 *
 *   1      average normals of the secondary nodes
 *   2      global buckets for the detection
 *   3      for each group (secondary, primary) the candidate facets per node
 *   4      loop over the nodes of the group
 *   5      the bucket(s) of the node
 *   6      radius of influence of the node, R_r: the reach
 *   7-8    visit only facets entered in buckets around it
 *   9      skip a facet that has this node among its own
 *   10     radius of influence of the facet, R_s: its radius
 *   11     skip it if the distance to its centre d_rs > R_r + R_s
 *   12     project the node; how far do the local coordinates violate the
 *          facet
 *   13     cost of the candidate
 *   14     keep the cheapest
 *   15-16  a node with a facet has a contact element: its connectivity
 *   17     a node without loses the one it had
 *   18     all nodes are done
 *   19     has any connectivity changed: raise a flag
 *   20     rebuild pointers and sparsity: the caller's, when the flag is up
 *
 * Steps 2 to 11 are the search (search/search.c, query.c): it works on blocks
 * of nodes instead of single ones, and leaves step 9 to the ranking (rank.c),
 * where most candidates have dropped out for cheaper reasons. All groups are
 * searched at once; a node knows the groups it is paired with. */
#include "contact/detect.h"

#include <math.h>
#include <string.h>

static void
prepare(abut_detection *d)
{
  struct
  {
    abut_array *array;
    size_t element;
  } const list[] = {{&d->node_groups, sizeof(uint64_t)},
                    {&d->thickness, sizeof(double)},
                    {&d->thickness_group, sizeof(int32_t)},
                    {&d->facet, sizeof(int32_t)},
                    {&d->local, sizeof(double)},
                    {&d->gap, sizeof(double)},
                    {&d->distance, sizeof(double)},
                    {&d->normal, sizeof(double)},
                    {&d->reversed, sizeof(uint8_t)},
                    {&d->bound, sizeof(double)},
                    {&d->cost, sizeof(double)}};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
    list[i].array->element = list[i].element;
  abut_skin_list_prepare(&d->list);
}

static const char *
fault_of(const abut_detection_options *o)
{
  if (o->struct_size != sizeof(*o))
    return "options of another version";
  if (!(o->normal_cosine >= -1 && o->normal_cosine <= 1))
    return "normal_cosine is not in [-1, 1]";
  if (!(o->extension >= 0 && o->extension <= ABUT_FACET_LIMIT))
    return "extension is negative or not finite";
  if (o->n_thicknesses < 0
      || (o->n_thicknesses > 0
          && (o->thickness == NULL || o->thickness_group == NULL)))
    return "n_thicknesses is negative, or their arrays are NULL";
  for (int32_t k = 0; k < o->n_thicknesses; ++k)
    if (!(o->thickness[k] > 0))
      return "a thickness is not positive";
  return NULL;
}

/* All nodes start without a facet and, if they have facets of their own,
 * paired with all groups. */
static abut_status
reserve(abut_detection *d)
{
  const int64_t n = d->secondary->view.n_nodes;
  const int64_t t = d->options.n_thicknesses;
  struct
  {
    abut_array *array;
    int64_t n;
  } const list[] = {
      {&d->node_groups, n}, {&d->facet, n},     {&d->local, 2 * n},
      {&d->gap, n},         {&d->distance, n},  {&d->normal, 3 * n},
      {&d->reversed, n},    {&d->thickness, t}, {&d->thickness_group, t}};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
  {
    const abut_status status =
        abut_array_reserve(d->context, list[i].array, 0, list[i].n + 1);
    if (status != ABUT_SUCCESS)
      return status;
  }
  uint64_t *groups = d->node_groups.data;
  int32_t *facet = d->facet.data;
  const int32_t *start = d->secondary->view.node_start;
  for (int32_t i = 0; i < n; ++i)
  {
    groups[i] = start[i + 1] > start[i] ? UINT64_MAX : 0;
    facet[i] = -1;
  }
  if (t > 0)
  {
    memcpy(d->thickness.data, d->options.thickness, (size_t)t * sizeof(double));
    memcpy(d->thickness_group.data, d->options.thickness_group,
           (size_t)t * sizeof(int32_t));
  }
  return ABUT_SUCCESS;
}

static void
release(abut_detection *d)
{
  abut_array *arrays[] = {&d->node_groups, &d->thickness, &d->thickness_group,
                          &d->facet,       &d->local,     &d->gap,
                          &d->distance,    &d->normal,    &d->reversed,
                          &d->bound,       &d->cost};
  for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i)
    abut_array_release(d->context, arrays[i]);
  abut_skin_list_release(d->context, &d->list);
  (void)abut_search_destroy(&d->search);
}

abut_status
abut_detection_create(abut_context *context, abut_surface *secondary,
                      abut_surface *primary,
                      const abut_detection_options *options,
                      abut_detection **detection)
{
  static const char call[] = "abut_detection_create";
  if (context == NULL || secondary == NULL || primary == NULL
      || detection == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context, surface or result is NULL");
  if (secondary->view.dimension != primary->view.dimension)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "the surfaces have different dimensions");
  const abut_detection_options chosen =
      options != NULL ? *options : abut_detection_defaults();
  const char *fault = fault_of(&chosen);
  if (fault != NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, fault);
  abut_detection *d = abut_object_create(context, sizeof(*d));
  if (d == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, call, "no memory");
  d->context = context;
  d->secondary = secondary;
  d->primary = primary;
  d->options = chosen;
  d->compare_nodes =
      secondary == primary
      || (secondary->view.node_id != NULL && primary->view.node_id != NULL);
  d->exclude_ring =
      secondary == primary || (chosen.self_contact && d->compare_nodes);
  prepare(d);
  abut_status status = reserve(d);
  if (status == ABUT_SUCCESS)
    status = abut_search_create(context, primary, &chosen.search, &d->search);
  if (status != ABUT_SUCCESS)
  {
    release(d);
    abut_object_destroy(context, d, sizeof(*d));
    return status;
  }
  d->options.thickness = NULL;
  d->options.thickness_group = NULL;
  *detection = d;
  return ABUT_SUCCESS;
}

abut_status
abut_detection_destroy(abut_detection **detection)
{
  if (detection == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_detection *d = *detection;
  if (d == NULL)
    return ABUT_SUCCESS;
  release(d);
  abut_object_destroy(d->context, d, sizeof(*d));
  *detection = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_detection_pair_groups(abut_detection *detection, int32_t secondary_group,
                           int32_t primary_group)
{
  if (detection == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_detection *d = detection;
  const abut_surface_view *v = &d->secondary->view;
  uint64_t *groups = d->node_groups.data;
  if (abut_detection_group_bit(d, primary_group) == 0)
  {
    if (d->n_groups == ABUT_MAX_GROUPS)
      return abut_fail(d->context, ABUT_UNSUPPORTED,
                       "abut_detection_pair_groups",
                       "more than 64 primary groups");
    if (d->n_groups == 0 && v->n_nodes > 0)
      memset(groups, 0, (size_t)v->n_nodes * sizeof(*groups));
    d->groups[d->n_groups++] = primary_group;
  }
  const uint64_t bit = abut_detection_group_bit(d, primary_group);
  for (int32_t f = 0; f < v->n_facets; ++f)
    if (abut_surface_group(d->secondary, f) == secondary_group)
      for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
        groups[v->connectivity[e]] |= bit;
  return ABUT_SUCCESS;
}

/* Steps 2 to 11: lists of candidates, made anew or reused. */
static abut_status
find_candidates(abut_detection *d, double motion)
{
  const abut_search_options *o = &d->options.search;
  const double reach = fmax(o->reach, 1.5 * motion);
  abut_search *s = d->search;
  d->view.reach = reach;
  abut_status status =
      abut_search_set_reach(s, reach, o->relative_reach, o->skin);
  if (status == ABUT_SUCCESS)
    status = abut_search_update(s);
  if (status != ABUT_SUCCESS)
    return status;
  d->view.searched = !abut_skin_list_serves(&d->list, s, d->secondary, false);
  if (d->view.searched)
    status = abut_skin_list_make(&d->list, s, d->secondary, false);
  if (status == ABUT_SUCCESS)
    ++*(d->view.searched ? &s->statistics.n_searches : &s->statistics.n_reuses);
  return status;
}

/* Room for the candidates of the node that has most. */
static abut_status
reserve_ranking(abut_detection *d)
{
  const abut_list *l = &d->list.list;
  const int64_t *start = l->start.data;
  int64_t most = 1;
  for (int32_t k = 0; k < l->n; ++k)
    most = start[k + 1] - start[k] > most ? start[k + 1] - start[k] : most;
  abut_status status = abut_array_reserve(d->context, &d->bound, 0, most);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(d->context, &d->cost, 0, most);
  return status;
}

/* Steps 15 to 17 for one node. */
static void
connect(abut_detection *d, int32_t node, int32_t facet,
        const abut_projection *p)
{
  static const abut_projection none;
  int32_t *old = (int32_t *)d->facet.data + node;
  double *local = (double *)d->local.data + 2 * (int64_t)node;
  double *normal = (double *)d->normal.data + 3 * (int64_t)node;
  if (facet < 0)
    p = &none;
  d->view.n_gained += *old < 0 && facet >= 0;
  d->view.n_lost += *old >= 0 && facet < 0;
  d->view.n_exchanged += *old >= 0 && facet >= 0 && *old != facet;
  d->view.n_paired += facet >= 0;
  *old = facet;
  local[0] = p->local[0];
  local[1] = p->local[1];
  for (int k = 0; k < 3; ++k)
    normal[k] = p->normal[k];
  ((double *)d->gap.data)[node] = p->gap;
  ((double *)d->distance.data)[node] = p->distance;
}

/* Steps 12 to 17 for the k-th node of the list. */
static void
pair_node(abut_detection *d, int32_t k, const double *normals)
{
  const abut_list *l = &d->list.list;
  const int64_t *start = l->start.data;
  const int32_t dimension = d->secondary->view.dimension;
  const abut_query query = {0, dimension, d->secondary->view.position, NULL};
  abut_ranking r;
  abut_projection p;
  r.node = ((const int32_t *)l->order.data)[k];
  r.groups = ((const uint64_t *)d->node_groups.data)[r.node];
  r.slot = (const int32_t *)l->slot.data + start[k];
  r.n = (int32_t)(start[k + 1] - start[k]);
  abut_query_point(&query, r.node, r.x);
  r.normal[2] = 0;
  for (int32_t i = 0; i < dimension; ++i)
    r.normal[i] = normals[(int64_t)dimension * r.node + i];
  int32_t facet = -1;
  if (r.groups != 0)
  {
    const int64_t candidates = d->view.n_candidates;
    const int64_t away = d->view.rejected[ABUT_REJECTION_FACING_AWAY];
    facet = abut_detection_rank(d, &r, &p);
    ((uint8_t *)d->reversed.data)[r.node] =
        d->view.n_candidates > candidates
        && d->view.n_candidates - candidates
               == d->view.rejected[ABUT_REJECTION_FACING_AWAY] - away;
  }
  connect(d, r.node, facet, &p);
}

/* Nodes too far from all facets are not in the list. */
static void
mark_listed(const abut_detection *d, uint8_t *listed)
{
  const abut_list *l = &d->list.list;
  const int32_t *order = l->order.data;
  const int32_t n = d->secondary->view.n_nodes;
  if (n > 0)
    memset(listed, 0, (size_t)n);
  for (int32_t k = 0; k < l->n; ++k)
    listed[order[k]] = 1;
}

abut_status
abut_detection_run(abut_detection *detection, double motion)
{
  if (detection == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_detection *d = detection;
  if (!(motion >= 0 && motion <= ABUT_FACET_LIMIT))
    return abut_fail(d->context, ABUT_INVALID_ARGUMENT, "abut_detection_run",
                     "motion is negative or not finite");
  const double *normals = NULL;
  abut_status status = abut_surface_normals(d->secondary, &normals); /* 1 */
  if (status != ABUT_SUCCESS)
    return status;
  const abut_detection_view empty = {0};
  d->view = empty;
  status = find_candidates(d, motion); /* 2-11 */
  if (status == ABUT_SUCCESS)
    status = reserve_ranking(d);
  if (status != ABUT_SUCCESS)
    return status;
  uint8_t *reversed = d->reversed.data;
  mark_listed(d, reversed);
  for (int32_t i = 0; i < d->secondary->view.n_nodes; ++i) /* 17 */
    if (!reversed[i])
      connect(d, i, -1, NULL);
  for (int32_t k = 0; k < d->list.list.n; ++k) /* 12-17 */
  {
    reversed[((const int32_t *)d->list.list.order.data)[k]] = 0;
    pair_node(d, k, normals);
  }
  d->view.changed = d->view.n_gained + d->view.n_lost + d->view.n_exchanged > 0;
  d->view.n_nodes = d->secondary->view.n_nodes; /* 18-19 */
  d->view.facet = d->facet.data;
  d->view.local = d->local.data;
  d->view.gap = d->gap.data;
  d->view.distance = d->distance.data;
  d->view.normal = d->normal.data;
  return ABUT_SUCCESS;
}

abut_status
abut_detection_get(const abut_detection *detection, abut_detection_view *view)
{
  if (detection == NULL || view == NULL)
    return ABUT_INVALID_ARGUMENT;
  *view = detection->view;
  return ABUT_SUCCESS;
}

const abut_search *
abut_detection_search(const abut_detection *detection)
{
  return detection != NULL ? detection->search : NULL;
}
