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
 * searched at once; a node has the groups that it is paired with. */
#include "contact/detect.h"

#include <math.h>
#include <string.h>

enum
{
  AHEAD = 8 /* nodes between a prefetch and its use */
};

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
                    {&d->contact, sizeof(abut_contact)},
                    {&d->listed, sizeof(uint8_t)},
                    {&d->reversed, sizeof(uint8_t)},
                    {&d->scratch, sizeof(abut_candidate)}};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
    list[i].array->element = list[i].element;
  abut_skin_list_prepare(&d->list);
}

static const char *
fault_of(const abut_detection_options *o)
{
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
  } const list[] = {{&d->node_groups, n}, {&d->contact, n},
                    {&d->listed, n},      {&d->reversed, n},
                    {&d->thickness, t},   {&d->thickness_group, t}};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
  {
    const abut_status status =
        abut_array_reserve(d->context, list[i].array, 0, list[i].n + 1);
    if (status != ABUT_SUCCESS)
      return status;
  }
  uint64_t *groups = d->node_groups.data;
  abut_contact *contact = d->contact.data;
  const int32_t *start = d->secondary->view.node_start;
  for (int32_t i = 0; i < n; ++i)
  {
    groups[i] = start[i + 1] > start[i] ? UINT64_MAX : 0;
    contact[i].facet = -1;
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
                          &d->contact,     &d->listed,    &d->reversed,
                          &d->scratch};
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
  abut_detection_options chosen = abut_detection_defaults();
  abut_status status =
      abut_copy_in(context, call, &chosen, sizeof(chosen), options);
  if (status != ABUT_SUCCESS)
    return status;
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
  status = reserve(d);
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

/* Steps 15 to 17 for one node. */
static void
connect(abut_detection *d, int32_t node, int32_t facet,
        const abut_projection *p)
{
  abut_contact *c = (abut_contact *)d->contact.data + node;
  const int32_t old = c->facet;
  d->view.n_gained += old < 0 && facet >= 0;
  d->view.n_lost += old >= 0 && facet < 0;
  d->view.n_exchanged += old >= 0 && facet >= 0 && old != facet;
  d->view.n_paired += facet >= 0;
  c->facet = facet;
  c->reserved = 0;
  c->gap = facet >= 0 ? p->gap : 0;
  c->distance = facet >= 0 ? p->distance : 0;
  c->local[0] = facet >= 0 ? p->local[0] : 0;
  c->local[1] = facet >= 0 ? p->local[1] : 0;
  for (int k = 0; k < 3; ++k)
    c->normal[k] = facet >= 0 ? p->normal[k] : 0;
}

/* Steps 12 to 17 for the k-th of the answers. */
static void
pair_node(abut_detection *d, const abut_answers *a, int32_t k)
{
  const int32_t dimension = d->secondary->view.dimension;
  const abut_query query = {0, dimension, d->secondary->view.position, NULL};
  abut_ranking r;
  abut_projection p;
  r.node = a->order[k];
  r.groups = ((const uint64_t *)d->node_groups.data)[r.node];
  r.slot = a->slot + a->start[k];
  r.n = (int32_t)(a->start[k + 1] - a->start[k]);
  abut_query_point(&query, r.node, r.x);
  r.normal[2] = 0;
  for (int32_t i = 0; i < dimension; ++i)
    r.normal[i] = d->normals[(int64_t)dimension * r.node + i];
  int32_t facet = -1;
  if (r.groups != 0)
  {
    const int64_t candidates = d->view.n_candidates;
    const int64_t away = d->rejected[ABUT_REJECTION_FACING_AWAY];
    facet = abut_detection_rank(d, &r, &p);
    ((uint8_t *)d->reversed.data)[r.node] =
        d->view.n_candidates > candidates
        && d->view.n_candidates - candidates
               == d->rejected[ABUT_REJECTION_FACING_AWAY] - away;
  }
  ((uint8_t *)d->listed.data)[r.node] = 1;
  connect(d, r.node, facet, &p);
}

/* Ask for what the k-th node will need: its result, normal and groups, and the
 * nodes of the facet with the nearest centre. */
static inline void
prefetch_node(const abut_detection *d, const abut_answers *a, int32_t k)
{
  const abut_record *records = d->search->records.data;
  const int32_t dimension = d->secondary->view.dimension, node = a->order[k];
  __builtin_prefetch((const abut_contact *)d->contact.data + node, 1);
  __builtin_prefetch(d->normals + (int64_t)dimension * node);
  __builtin_prefetch((const uint64_t *)d->node_groups.data + node);
  if (a->start[k + 1] > a->start[k])
    abut_prefetch_nodes(d->primary, records[a->slot[a->start[k]]].facet);
}

/* Steps 12 to 17 for a block of nodes. */
static abut_status
pair_block(void *user, const abut_answers *a)
{
  abut_detection *d = user;
  int64_t most = 0;
  for (int32_t k = 0; k < a->n; ++k)
    most = a->start[k + 1] - a->start[k] > most ? a->start[k + 1] - a->start[k]
                                                : most;
  const abut_status status =
      abut_array_reserve(d->context, &d->scratch, 0, most);
  if (status != ABUT_SUCCESS)
    return status;
  for (int32_t k = 0; k < a->n && k < AHEAD; ++k)
    prefetch_node(d, a, k);
  for (int32_t k = 0; k < a->n; ++k)
  {
    if (k + AHEAD < a->n)
      prefetch_node(d, a, k + AHEAD);
    pair_node(d, a, k);
  }
  return ABUT_SUCCESS;
}

/* Steps 2 to 17: candidates of a block of nodes and, while they are in the
 * cache, the pairing of these nodes; with a skin from a list that is made again
 * only when it must be. */
static abut_status
search_and_pair(abut_detection *d, double motion)
{
  const abut_search_options *o = &d->options.search;
  abut_search *s = d->search;
  d->view.reach = fmax(o->reach, 1.5 * motion);
  abut_status status =
      abut_search_set_reach(s, d->view.reach, o->relative_reach, o->skin);
  if (status == ABUT_SUCCESS)
    status = abut_search_refresh(s);
  if (status != ABUT_SUCCESS)
    return status;
  d->view.searched = !abut_skin_list_serves(&d->list, s, d->secondary, false);
  if (d->view.searched)
    status = abut_search_update(s);
  if (status != ABUT_SUCCESS)
    return status;
  ++*(d->view.searched ? &s->statistics.n_searches : &s->statistics.n_reuses);
  if (s->skin > 0)
  {
    if (d->view.searched)
      status = abut_skin_list_make(&d->list, s, d->secondary, false);
    return status == ABUT_SUCCESS
               ? abut_list_consume(&d->list.list, pair_block, d)
               : status;
  }
  abut_query query;
  status = abut_search_query_of(s, d->secondary, false, &query);
  return status == ABUT_SUCCESS
             ? abut_search_list(s, &query, 0, &s->list, pair_block, d)
             : status;
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
  abut_status status = abut_surface_normals(d->secondary, &d->normals); /* 1 */
  if (status != ABUT_SUCCESS)
    return status;
  const int32_t n = d->secondary->view.n_nodes;
  const abut_detection_view empty = {0};
  d->view = empty;
  memset(d->rejected, 0, sizeof(d->rejected));
  d->view.rejected = d->rejected;
  if (n > 0)
  {
    memset(d->listed.data, 0, (size_t)n);
    memset(d->reversed.data, 0, (size_t)n);
  }
  status = search_and_pair(d, motion); /* 2-17 */
  if (status != ABUT_SUCCESS)
    return status;
  const uint8_t *listed = d->listed.data;
  for (int32_t i = 0; i < n; ++i) /* 17: nodes far from all facets */
    if (!listed[i])
      connect(d, i, -1, NULL);
  d->view.changed = d->view.n_gained + d->view.n_lost + d->view.n_exchanged > 0;
  d->view.n_nodes = n; /* 18-19 */
  d->view.contact = d->contact.data;
  return ABUT_SUCCESS;
}

abut_status
abut_detection_get_sized(const abut_detection *detection,
                         abut_detection_view *view)
{
  if (detection == NULL || view == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_copy_out(detection->context, "abut_detection_get", view,
                       sizeof(detection->view), &detection->view);
}

const abut_search *
abut_detection_search(const abut_detection *detection)
{
  return detection != NULL ? detection->search : NULL;
}
