/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A surface that touches itself, as two sides: a greedy colouring with two
 * colours by a union-find structure that stores for each facet whether it is on
 * the side of its root (parity). Cost: the search, a sort of the pairs, and
 * nearly O(1) per pair. */
#include "geometry/surface.h"
#include "geometry/vector.h"
#include "search/order.h"

#include <abut/search.h>
#include <abut/self_contact.h>

#include <math.h>
#include <string.h>

/* Depth behind another facet, in sizes of the smaller one, above which two
 * facets count as skins of a thin part rather than as an overlap. */
static const double least_thickness = 0.1;

/* Weight of the distance beside the normals when pairs are put in order. In a
 * circle the chord at an angle a from the diameter is shorter by cos a, and
 * beside by sin a of itself: any weight above 1 puts the diameter first. */
static const double aside = 3.;

typedef struct facet_place
{
  double centre[3], normal[3], radius, size;
} facet_place;

typedef struct facet_pair
{
  int32_t a, b;
  double gap;   /* negative: behind each other */
  double apart; /* square of the distance of the centres, and again of what is
                   beside the normals: what is opposite comes before what is
                   nearer by being aside, as across a round hole */
} facet_pair;

typedef struct work
{
  abut_context *context;
  const abut_surface *surface;
  abut_split_options options;
  abut_array places; /* facet_place */
  abut_array rank;   /* int32_t: order by the facets' numbers, */
  abut_array order;  /* int32_t: its inverse */
  abut_array pairs;  /* facet_pair */
  abut_array keyed;  /* abut_keyed */
  abut_array parent; /* int32_t */
  abut_array parity; /* uint8_t: on the other side than the parent */
  abut_array side;   /* uint8_t: of the roots */
  int64_t n_pairs;
  double least_size; /* of the facets */
  abut_split_report report;
} work;

static abut_status
reserve(work *w)
{
  const int64_t n = w->surface->view.n_facets;
  struct
  {
    abut_array *array;
    size_t element;
    int64_t n;
  } const list[] = {{&w->places, sizeof(facet_place), n},
                    {&w->rank, sizeof(int32_t), n},
                    {&w->order, sizeof(int32_t), n},
                    {&w->pairs, sizeof(facet_pair), n},
                    {&w->keyed, sizeof(abut_keyed), 2 * n},
                    {&w->parent, sizeof(int32_t), n},
                    {&w->parity, sizeof(uint8_t), n},
                    {&w->side, sizeof(uint8_t), n}};
  abut_status status = ABUT_SUCCESS;
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
  {
    list[i].array->element = list[i].element;
    if (status == ABUT_SUCCESS)
      status = abut_array_reserve(w->context, list[i].array, 0, list[i].n + 1);
  }
  return status;
}

static void
release(work *w)
{
  abut_array *const list[] = {&w->places, &w->rank,   &w->order,  &w->pairs,
                              &w->keyed,  &w->parent, &w->parity, &w->side};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
    abut_array_release(w->context, list[i]);
}

static abut_status
place_facets(work *w)
{
  const abut_surface_view *v = &w->surface->view;
  facet_place *place = w->places.data;
  abut_keyed *items = w->keyed.data;
  for (int32_t f = 0; f < v->n_facets; ++f)
  {
    double x[3 * ABUT_FACET_MAX_NODES];
    abut_facet_measures m;
    const abut_facet_kind kind = (abut_facet_kind)v->kinds[f];
    abut_surface_gather(w->surface, f, x);
    const abut_status status = abut_facet_measure(kind, x, &m);
    if (status != ABUT_SUCCESS)
      return status;
    memcpy(place[f].centre, m.centre, sizeof(m.centre));
    memcpy(place[f].normal, m.normal, sizeof(m.normal));
    place[f].radius = m.radius;
    place[f].size = abut_surface_longest_side(kind, x);
    w->least_size = f == 0 ? place[f].size : fmin(w->least_size, place[f].size);
    items[f].key = (uint64_t)(v->facet_id != NULL ? v->facet_id[f] : f)
                   ^ UINT64_C(0x8000000000000000);
    items[f].index = f;
    items[f].unused = 0;
  }
  abut_order_sort(items, items + v->n_facets, v->n_facets);
  for (int32_t i = 0; i < v->n_facets; ++i)
  {
    ((int32_t *)w->order.data)[i] = items[i].index;
    ((int32_t *)w->rank.data)[items[i].index] = i;
  }
  return ABUT_SUCCESS;
}

static bool
share_node(const work *w, int32_t f, int32_t g)
{
  const abut_surface_view *v = &w->surface->view;
  for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
    for (int32_t k = v->facet_start[g]; k < v->facet_start[g + 1]; ++k)
      if (abut_surface_node_id(w->surface, v->connectivity[e])
          == abut_surface_node_id(w->surface, v->connectivity[k]))
        return true;
  return false;
}

/* Whether two facets face each other, or are two skins, within reach. */
static bool
faces(const work *w, facet_pair *p)
{
  const facet_place *a = (const facet_place *)w->places.data + p->a,
                    *b = (const facet_place *)w->places.data + p->b;
  const double size = a->size > b->size ? a->size : b->size;
  const double relative = w->options.relative_reach * size;
  const double reach =
      relative > w->options.reach ? relative : w->options.reach;
  if (!(dot3(a->normal, b->normal) <= w->options.normal_cosine))
    return false;
  double d[3];
  sub3(b->centre, a->centre, d);
  const double distance2 = dot3(d, d);
  p->gap = 0.5 * (dot3(a->normal, d) - dot3(b->normal, d));
  const double beside2 = distance2 - p->gap * p->gap;
  p->apart = distance2 + aside * beside2;
  const double radii = a->radius + b->radius;
  return fabs(p->gap) <= reach && beside2 <= radii * radii
         && !share_node(w, p->a, p->b);
}

static abut_status
collect(work *w, const abut_pairs_view *found)
{
  const int32_t *rank = w->rank.data;
  for (int32_t f = 0; f < found->n_queries; ++f)
    for (int64_t k = found->start[f]; k < found->start[f + 1]; ++k)
    {
      facet_pair p = {f, found->facet[k], 0., 0.};
      if (rank[p.a] >= rank[p.b] || !faces(w, &p))
        continue;
      const abut_status status =
          abut_array_reserve(w->context, &w->pairs, w->n_pairs, w->n_pairs + 1);
      if (status != ABUT_SUCCESS)
        return status;
      ((facet_pair *)w->pairs.data)[w->n_pairs++] = p;
    }
  return w->n_pairs <= INT32_MAX / 2
             ? ABUT_SUCCESS
             : abut_fail(w->context, ABUT_UNSUPPORTED, "abut_surface_split",
                         "too many pairs of facets");
}

static abut_status
search(work *w, abut_surface *surface)
{
  abut_search_options o = abut_search_defaults();
  abut_search *search = NULL;
  abut_pairs *pairs = NULL;
  abut_pairs_view found;
  o.reach = w->options.reach;
  o.relative_reach = w->options.relative_reach;
  abut_status status = abut_search_create(w->context, surface, &o, &search);
  if (status == ABUT_SUCCESS)
    status = abut_pairs_create(w->context, &pairs);
  if (status == ABUT_SUCCESS)
    status = abut_search_facets(search, surface, pairs);
  if (status == ABUT_SUCCESS)
    status = abut_pairs_get(pairs, &found);
  if (status == ABUT_SUCCESS)
    status = collect(w, &found);
  (void)abut_pairs_destroy(&pairs);
  (void)abut_search_destroy(&search);
  return status;
}

/* Leave out the pairs through the body. */
static void
remove_skins(work *w)
{
  facet_pair *p = w->pairs.data;
  const facet_place *place = w->places.data;
  double thickness = w->options.thickness;
  if (!(thickness > 0.))
  {
    thickness = INFINITY;
    for (int64_t i = 0; i < w->n_pairs; ++i)
    {
      const double size = place[p[i].a].size < place[p[i].b].size
                              ? place[p[i].a].size
                              : place[p[i].b].size;
      if (-p[i].gap > least_thickness * size && -p[i].gap < thickness)
        thickness = -p[i].gap;
    }
  }
  int64_t n = 0;
  for (int64_t i = 0; i < w->n_pairs; ++i)
    if (-p[i].gap > 0.5 * thickness)
      ++w->report.n_skins;
    else
      p[n++] = p[i];
  w->n_pairs = w->report.n_pairs = n;
  w->report.thickness = thickness < INFINITY ? thickness : 0.;
}

/* Root of a facet and on which side of it the facet is; paths are halved. */
static int32_t
find_root(work *w, int32_t f, uint8_t *side)
{
  int32_t *parent = w->parent.data;
  uint8_t *parity = w->parity.data;
  *side = 0;
  while (parent[f] != f)
  {
    const int32_t next = parent[f];
    parity[f] ^= parity[next];
    parent[f] = parent[next];
    *side ^= parity[f];
    f = parent[f];
  }
  return f;
}

/* Put two facets on the same side (differ = 0) or on different ones (1), if
 * nothing is settled yet; returns whether they are so. The root is the facet
 * with the smallest number. */
static bool
relate(work *w, int32_t f, int32_t g, uint8_t differ)
{
  const int32_t *rank = w->rank.data;
  uint8_t side_f, side_g;
  const int32_t a = find_root(w, f, &side_f), b = find_root(w, g, &side_g);
  if (a == b)
    return (side_f ^ side_g) == differ;
  const int32_t root = rank[a] < rank[b] ? a : b, other = root == a ? b : a;
  ((int32_t *)w->parent.data)[other] = root;
  ((uint8_t *)w->parity.data)[other] = (uint8_t)(side_f ^ side_g ^ differ);
  return true;
}

static abut_status
relate_pairs(work *w)
{
  const int32_t n = (int32_t)w->n_pairs;
  abut_status status =
      abut_array_reserve(w->context, &w->keyed, 0, 2 * (int64_t)n + 1);
  if (status != ABUT_SUCCESS)
    return status;
  const facet_pair *p = w->pairs.data;
  abut_keyed *items = w->keyed.data;
  for (int32_t i = 0; i < n; ++i)
  {
    /* Bits of positive numbers are in the order of the numbers. */
    memcpy(&items[i].key, &p[i].apart, sizeof(items[i].key));
    items[i].index = i;
    items[i].unused = 0;
  }
  abut_order_sort(items, items + n, n);
  for (int32_t i = 0; i < n; ++i)
    w->report.n_conflicts +=
        !relate(w, p[items[i].index].a, p[items[i].index].b, 1);
  return ABUT_SUCCESS;
}

static void
relate_neighbours(work *w)
{
  const abut_surface_view *v = &w->surface->view;
  const int32_t *order = w->order.data;
  for (int32_t i = 0; i < v->n_facets; ++i)
    for (int32_t e = v->facet_start[order[i]]; e < v->facet_start[order[i] + 1];
         ++e)
    {
      const int32_t node = v->connectivity[e];
      for (int32_t k = v->node_start[node]; k < v->node_start[node + 1]; ++k)
        (void)relate(w, order[i], v->node_facet[k], 0);
    }
}

/* The least gap of two facets that face each other on one side; and how many
 * are near each other. */
static double
least_met(const work *w, const uint8_t *side, int64_t *n_near)
{
  const facet_pair *p = w->pairs.data;
  double least = INFINITY;
  *n_near = 0;
  for (int64_t i = 0; i < w->n_pairs; ++i)
    if (side[p[i].a] == side[p[i].b])
    {
      *n_near += p[i].gap <= w->options.near;
      least = p[i].gap < least ? p[i].gap : least;
    }
  return least;
}

/* Sides of the roots: 0, or as they were at the nearest pair of each part that
 * was on two sides, or else at the root. Pairs are in order. */
static void
orient(work *w)
{
  const uint8_t *previous = w->options.previous;
  uint8_t *of_root = w->side.data, side = 0;
  const int32_t n_facets = w->surface->view.n_facets;
  for (int32_t f = 0; f < n_facets; ++f)
    of_root[f] = previous != NULL ? previous[f] : 0;
  if (previous == NULL)
    return;
  const facet_pair *p = w->pairs.data;
  const abut_keyed *items = w->keyed.data;
  for (int64_t i = w->n_pairs - 1; i >= 0; --i)
  {
    const facet_pair *pair = p + items[i].index;
    const int32_t root = find_root(w, pair->a, &side);
    if (previous[pair->a] != previous[pair->b])
      of_root[root] = previous[pair->a] ^ side;
  }
}

static abut_status
split(work *w, abut_surface *surface, uint8_t *side)
{
  const int32_t n_facets = surface->view.n_facets;
  const uint8_t *previous = w->options.previous;
  double before = INFINITY;
  int64_t n_near;
  abut_status status = reserve(w);
  if (status == ABUT_SUCCESS)
    status = place_facets(w);
  if (status == ABUT_SUCCESS)
    status = search(w, surface);
  if (status != ABUT_SUCCESS)
    return status;
  remove_skins(w);
  if (previous != NULL)
  {
    memcpy(side, previous, (size_t)n_facets);
    before = least_met(w, previous, &w->report.n_met);
    if (w->report.n_met == 0)
      return ABUT_SUCCESS;
  }
  for (int32_t f = 0; f < n_facets; ++f)
  {
    ((int32_t *)w->parent.data)[f] = f;
    ((uint8_t *)w->parity.data)[f] = 0;
  }
  status = relate_pairs(w);
  if (status != ABUT_SUCCESS)
    return status;
  relate_neighbours(w);
  orient(w);
  for (int32_t f = 0; f < n_facets; ++f)
  {
    const int32_t root = find_root(w, f, &side[f]);
    side[f] ^= ((const uint8_t *)w->side.data)[root];
  }
  /* Three flanks that meet are on two sides, however they are split. */
  if (previous != NULL
      && least_met(w, side, &n_near)
             <= fmax(2. * before, w->options.relative_reach * w->least_size))
    memcpy(side, previous, (size_t)n_facets);
  return ABUT_SUCCESS;
}

static const char *
fault_of(const abut_split_options *o)
{
  if (!(o->reach >= 0. && o->reach <= ABUT_FACET_LIMIT)
      || !(o->relative_reach >= 0. && o->relative_reach <= ABUT_FACET_LIMIT))
    return "a reach is negative or not finite";
  if (!(o->normal_cosine >= -1. && o->normal_cosine <= 1.))
    return "normal_cosine is not in [-1, 1]";
  if (!(o->thickness >= 0. && o->thickness <= ABUT_FACET_LIMIT))
    return "thickness is negative or not finite";
  if (!(o->near >= 0. && o->near <= ABUT_FACET_LIMIT))
    return "near is negative or not finite";
  return NULL;
}

abut_status
abut_surface_split_sized(abut_context *context, abut_surface *surface,
                         const abut_split_options *options, uint8_t *side,
                         abut_split_report *report)
{
  static const char call[] = "abut_surface_split";
  work w;
  memset(&w, 0, sizeof(w));
  w.options = abut_split_defaults();
  if (context == NULL || surface == NULL
      || (side == NULL && surface->view.n_facets > 0))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context, surface or result is NULL");
  abut_status status =
      abut_copy_in(context, call, &w.options, sizeof(w.options), options);
  if (status != ABUT_SUCCESS)
    return status;
  const char *fault = fault_of(&w.options);
  if (fault != NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, fault);
  w.context = context;
  w.surface = surface;
  status = split(&w, surface, side);
  release(&w);
  if (status != ABUT_SUCCESS || report == NULL)
    return status;
  return abut_copy_out(context, call, report, sizeof(w.report), &w.report);
}
