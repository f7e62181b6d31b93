/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Steps 12 to 14 of the detection, for one node: filter the candidates,
 * project, take the cheapest.
 *
 * The cost of a candidate is the distance to its nearest point, which joins
 * the gap (distance along the normal) and the violation of the local
 * coordinates (distance beyond the edge): cost^2 = gap^2 + overshoot^2. The
 * distance to the facet's box is a lower bound of it, so that of the handful
 * of candidates of a node usually one or two are projected.
 *
 * Costs that differ by round-off are a tie, and the facet with the lowest
 * number wins; the result then does not depend on the order in which
 * candidates come, on the numbering of the arrays, or on the frame. */
#include "contact/detect.h"

#include <math.h>

const char *
abut_rejection_text(abut_rejection reason)
{
  switch (reason)
  {
#define ABUT_REJECTION_CASE(name, text)                                        \
  case ABUT_REJECTION_##name:                                                  \
    return text;
    ABUT_REJECTION_LIST(ABUT_REJECTION_CASE)
#undef ABUT_REJECTION_CASE
  case ABUT_REJECTION_N:
    break;
  }
  return "unknown reason";
}

uint64_t
abut_detection_group_bit(const abut_detection *d, int32_t group)
{
  for (int32_t k = 0; k < d->n_groups; ++k)
    if (d->groups[k] == group)
      return UINT64_C(1) << k;
  return 0;
}

/* Whether facet f has a node with this number (step 9). */
static bool
has_node(const abut_surface *s, int32_t f, int64_t id)
{
  for (int32_t e = s->view.facet_start[f]; e < s->view.facet_start[f + 1]; ++e)
    if (abut_surface_node_id(s, s->view.connectivity[e]) == id)
      return true;
  return false;
}

/* Whether facet f shares a node with one of the node's own facets. */
static bool
is_neighbour(const abut_detection *d, int32_t node, int32_t f)
{
  const abut_surface_view *v = &d->secondary->view;
  for (int32_t k = v->node_start[node]; k < v->node_start[node + 1]; ++k)
  {
    const int32_t own = v->node_facet[k];
    for (int32_t e = v->facet_start[own]; e < v->facet_start[own + 1]; ++e)
      if (has_node(d->primary, f,
                   abut_surface_node_id(d->secondary, v->connectivity[e])))
        return true;
  }
  return false;
}

/* Square of the distance to the box of a facet. */
static inline double
box_distance(const abut_record *r, const double *x)
{
  double square = 0;
  for (int d = 0; d < 3; ++d)
  {
    const double below = r->lower[d] - x[d], above = x[d] - r->upper[d];
    double out = below > above ? below : above;
    out = out > 0 ? out : 0;
    square += out * out;
  }
  return square;
}

/* Filters that need no projection; ABUT_REJECTION_N if the candidate stays. */
static abut_rejection
screen(const abut_detection *d, const abut_ranking *k, const abut_record *r)
{
  if (d->n_groups > 0
      && (k->groups & abut_detection_group_bit(d, r->group)) == 0)
    return ABUT_REJECTION_GROUP;
  const double cosine = k->normal[0] * r->normal[0]
                        + k->normal[1] * r->normal[1]
                        + k->normal[2] * r->normal[2];
  if (!(cosine <= d->options.normal_cosine))
    return ABUT_REJECTION_FACING_AWAY;
  if (d->compare_nodes
      && has_node(d->primary, r->facet,
                  abut_surface_node_id(d->secondary, k->node)))
    return ABUT_REJECTION_OWN_NODE;
  if (d->exclude_ring && is_neighbour(d, k->node, r->facet))
    return ABUT_REJECTION_NEIGHBOUR;
  return ABUT_REJECTION_N;
}

/* Whether the nearest point lies on side `side` of the facet. */
static bool
on_side(abut_facet_kind kind, int side, const double *local)
{
  const int32_t n = abut_facet_n_corners(kind);
  const double a = local[0], b = local[1], e = 1e-9;
  if (n == 2)
    return side == 0 ? a <= -1 + e : a >= 1 - e;
  if (n == 3)
    return side == 0 ? b <= e : side == 1 ? a + b >= 1 - e : a <= e;
  return side == 0   ? b <= -1 + e
         : side == 1 ? a >= 1 - e
         : side == 2 ? b >= 1 - e
                     : a <= -1 + e;
}

/* Whether the node lies beyond the border of the primary surface by more than
 * the extension. */
static bool
beyond_border(const abut_detection *d, const abut_record *r,
              const abut_projection *p)
{
  if (p->inside)
    return false;
  const double square = p->distance * p->distance - p->gap * p->gap;
  const double limit = d->options.extension * r->size;
  if (square <= limit * limit)
    return false;
  const abut_surface_view *v = &d->primary->view;
  const abut_facet_kind kind = (abut_facet_kind)v->kinds[r->facet];
  for (int side = 0; side < 4; ++side)
    if (v->neighbour[4 * (int64_t)r->facet + side] == ABUT_NEIGHBOUR_BORDER
        && on_side(kind, side, p->local))
      return true;
  return false;
}

static double
thickness_of(const abut_detection *d, int32_t group)
{
  const int32_t *groups = d->thickness_group.data;
  const double *thickness = d->thickness.data;
  for (int32_t k = 0; k < d->options.n_thicknesses; ++k)
    if (groups[k] == group)
      return thickness[k];
  return INFINITY;
}

static void
project(const abut_detection *d, int32_t f, const double *x, abut_projection *p)
{
  double nodes[3 * ABUT_FACET_MAX_NODES];
  abut_surface_gather(d->primary, f, nodes);
  /* Cannot fail: kind and positions were checked by the surface. */
  (void)abut_facet_project((abut_facet_kind)d->primary->view.kinds[f], nodes, x,
                           p);
}

/* Filters that need the projection. */
static abut_rejection
judge(const abut_detection *d, const abut_record *r, const abut_projection *p)
{
  if (p->distance > r->reach)
    return ABUT_REJECTION_BEYOND_REACH;
  if (d->options.n_thicknesses > 0 && -p->gap > 0.5 * thickness_of(d, r->group))
    return ABUT_REJECTION_WRONG_SIDE;
  if (beyond_border(d, r, p))
    return ABUT_REJECTION_BEYOND_BORDER;
  return ABUT_REJECTION_N;
}

/* Difference of costs that is round-off. */
static double
tie(const abut_record *r, const double *x)
{
  const double magnitude = fmax(fmax(fabs(x[0]), fabs(x[1])), fabs(x[2]));
  return 1e-10 * r->size + 1e-15 * magnitude;
}

/* Step 12 for candidate i; the cost, or infinity if it is rejected. */
static double
cost_of(abut_detection *d, const abut_ranking *k, const abut_record *r,
        abut_projection *p)
{
  project(d, r->facet, k->x, p);
  const abut_rejection reason = judge(d, r, p);
  if (reason == ABUT_REJECTION_N)
    return p->distance;
  ++d->view.rejected[reason];
  return INFINITY;
}

/* Bounds of the costs of all candidates, infinite for those screened out;
 * returns the one with the least bound, or -1. */
static int32_t
bound_costs(abut_detection *d, const abut_ranking *k, double *bound)
{
  const abut_record *records = d->search->records.data;
  int32_t first = -1;
  for (int32_t i = 0; i < k->n; ++i)
  {
    const abut_record *r = records + k->slot[i];
    bound[i] = INFINITY;
    if (d->search->skin > 0 && !abut_record_near_point(r, k->x, 0))
      continue;
    ++d->view.n_candidates;
    const abut_rejection reason = screen(d, k, r);
    if (reason != ABUT_REJECTION_N)
    {
      ++d->view.rejected[reason];
      continue;
    }
    bound[i] = sqrt(box_distance(r, k->x));
    if (first < 0 || bound[i] < bound[first]
        || (bound[i] == bound[first] && k->slot[i] < k->slot[first]))
      first = i;
  }
  return first;
}

/* Among the costs within a tie of the least one, the lowest facet number. */
static int32_t
settle(const abut_detection *d, const abut_ranking *k, const double *cost,
       double least)
{
  const abut_record *records = d->search->records.data;
  int32_t best = -1;
  int64_t best_id = INT64_MAX;
  for (int32_t i = 0; i < k->n; ++i)
  {
    const abut_record *r = records + k->slot[i];
    if (!(cost[i] <= least + tie(r, k->x)))
      continue;
    const int64_t id = abut_surface_facet_id(d->primary, r->facet);
    if (best < 0 || id < best_id)
    {
      best = i;
      best_id = id;
    }
  }
  return best;
}

int32_t
abut_detection_rank(abut_detection *d, const abut_ranking *k,
                    abut_projection *projection)
{
  const abut_record *records = d->search->records.data;
  double *bound = d->bound.data, *cost = d->cost.data;
  abut_projection p;
  const int32_t first = bound_costs(d, k, bound);
  if (first < 0)
    return -1;
  double least = INFINITY;
  int32_t held = -1, n_costs = 0;
  /* The most promising one first, then the others in their order. */
  for (int32_t j = -1; j < k->n; ++j)
  {
    const int32_t i = j < 0 ? first : j;
    if (j == first)
      continue;
    const abut_record *r = records + k->slot[i];
    if (j >= 0)
      cost[i] = INFINITY;
    if (bound[i] > least + tie(r, k->x))
    {
      d->view.rejected[ABUT_REJECTION_COSTLIER] += isfinite(bound[i]);
      continue;
    }
    if (isinf(bound[i]))
      continue;
    cost[i] = cost_of(d, k, r, &p);
    n_costs += isfinite(cost[i]);
    if (cost[i] < least)
    {
      least = cost[i];
      held = i;
      *projection = p;
    }
  }
  if (held < 0)
    return -1;
  d->view.rejected[ABUT_REJECTION_COSTLIER] += n_costs - 1;
  const int32_t best = n_costs > 1 ? settle(d, k, cost, least) : held;
  const int32_t facet = records[k->slot[best]].facet;
  if (best != held)
    project(d, facet, k->x, projection);
  return facet;
}
