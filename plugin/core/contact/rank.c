/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Steps 12 to 14 of the detection, for one node: filter the candidates,
 * project, take the cheapest.
 *
 * The cost of a candidate is the distance to its nearest point, which joins
 * the gap (distance along the normal) and the violation of the local
 * coordinates (distance beyond the edge): cost^2 = gap^2 + overshoot^2. Lower
 * bounds of it are the distances to the facet's box and, for a quadrilateral,
 * to the strips of its parallelogram. Candidates are taken in the order of the
 * first until it exceeds the least cost so far, and projected unless the
 * second does, so that of the handful of candidates of a node usually one is
 * projected.
 *
 * A node beyond the border of the surface has no facet. The facets behind the
 * border are not nearer for being allowed: a facet whose nearest point is on
 * its edge is no candidate where the border is nearer.
 *
 * Costs that differ by round-off are a tie, and the facet with the lowest
 * number wins; the result then does not depend on the order in which
 * candidates come, on the numbering of the arrays, or on the frame. */
#include "contact/detect.h"

#include "geometry/kernels.h"
#include "geometry/pseudonormal.h"

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
  return square > limit * limit && abut_beyond_border(d->primary, r->facet, p);
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

/* Lower bound of the distance to a quadrilateral y = c + a xi + b eta +
 * d xi eta, |xi|, |eta| <= 1: the distance from the plane, or from the strips
 * |xi| <= 1 and |eta| <= 1 of the parallelogram, less |d|. */
static double
strip_bound(const double *X, const double *x)
{
  double a[3], b[3], q[3], n[3], u[3], v[3];
  double dd = 0, aa = 0, bb = 0, nn = 0, xi = 0, eta = 0, gap = 0;
  for (int i = 0; i < 3; ++i)
  {
    const double l = 0.25 * (X[3 + i] - X[i]), r = 0.25 * (X[9 + i] - X[6 + i]);
    a[i] = l + r;
    b[i] = 0.25 * ((X[6 + i] - X[i]) + (X[9 + i] - X[3 + i]));
    q[i] = x[i] - 0.25 * ((X[i] + X[9 + i]) + (X[3 + i] + X[6 + i]));
    dd += (r - l) * (r - l);
    aa += a[i] * a[i];
    bb += b[i] * b[i];
  }
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = a[j] * b[k] - a[k] * b[j];
    u[i] = q[j] * b[k] - q[k] * b[j];
    v[i] = a[j] * q[k] - a[k] * q[j];
  }
  for (int i = 0; i < 3; ++i)
  {
    nn += n[i] * n[i];
    gap += q[i] * n[i];
    xi += u[i] * n[i];
    eta += v[i] * n[i];
  }
  if (!(nn > 1e-20 * aa * bb))
    return 0;
  /* |xi| - 1 times the height of the parallelogram over b, |n| / |b|. */
  const double s = fabs(xi) - nn, t = fabs(eta) - nn;
  const double beyond_a = s > 0 ? s * s / (nn * bb) : 0;
  const double beyond_b = t > 0 ? t * t / (nn * aa) : 0;
  const double beyond = beyond_a > beyond_b ? beyond_a : beyond_b;
  return sqrt(gap * gap / nn + beyond) - sqrt(dd);
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
  return 1e-10 * r->size + 1e-15 * (fabs(x[0]) + fabs(x[1]) + fabs(x[2]));
}

/* Step 12: the cost of a candidate, or infinity if it is rejected or surely
 * costs more than `least`; *border becomes the distance of a border that the
 * node lies beyond, if that is less. */
static double
cost_of(abut_detection *d, const abut_ranking *k, const abut_record *r,
        double least, double *border, abut_projection *p)
{
  double nodes[3 * ABUT_FACET_MAX_NODES];
  const abut_facet_kind kind =
      (abut_facet_kind)d->primary->view.kinds[r->facet];
  abut_rejection reason = ABUT_REJECTION_COSTLIER;
  abut_surface_gather(d->primary, r->facet, nodes);
  if (least == INFINITY || kind != ABUT_FACET_QUAD4
      || !(strip_bound(nodes, k->x) > least + 2 * tie(r, k->x)))
  {
    abut_project(kind, nodes, k->x, p);
    reason = judge(d, r, p);
  }
  if (reason == ABUT_REJECTION_N)
    return p->distance;
  if (reason == ABUT_REJECTION_BEYOND_BORDER)
    *border = fmin(*border, p->distance);
  ++d->rejected[reason];
  return INFINITY;
}

/* Candidates that pass the filters without projection, with their bounds;
 * returns their number. */
static int32_t
select(abut_detection *d, const abut_ranking *k, abut_candidate *c)
{
  const abut_record *records = d->search->records.data;
  const double skin = d->search->skin;
  int32_t n = 0;
  for (int32_t i = 0; i < k->n; ++i)
  {
    const abut_record *r = records + k->slot[i];
    double square = 0;
    if (skin > 0 && !abut_record_near_point(r, k->x, 0, &square))
      continue;
    ++d->view.n_candidates;
    const abut_rejection reason = screen(d, k, r);
    if (reason != ABUT_REJECTION_N)
    {
      ++d->rejected[reason];
      continue;
    }
    square = 0;
    for (int j = 0; j < 3; ++j)
      square += (k->x[j] - r->centre[j]) * (k->x[j] - r->centre[j]);
    c[n].record = r;
    c[n].bound = box_distance(r, k->x);
    c[n].centre = square;
    c[n].cost = INFINITY;
    ++n;
  }
  return n;
}

/* Whether candidate a is to be looked at before b. */
static inline bool
before(const abut_candidate *a, const abut_candidate *b)
{
  if (a->bound != b->bound)
    return a->bound < b->bound;
  if (a->centre != b->centre)
    return a->centre < b->centre;
  return a->record->facet < b->record->facet;
}

/* Bring the most promising one of c[n] to the front. */
static void
bring_forward(abut_candidate *c, int32_t n)
{
  int32_t first = 0;
  for (int32_t i = 1; i < n; ++i)
    first = before(c + i, c + first) ? i : first;
  const abut_candidate swap = c[0];
  c[0] = c[first];
  c[first] = swap;
}

/* Among costs within a tie of the least one, the lowest facet number. */
static const abut_record *
settle(const abut_detection *d, const abut_ranking *k, const abut_candidate *c,
       int32_t n, double least)
{
  const abut_record *best = NULL;
  int64_t best_id = INT64_MAX;
  for (int32_t i = 0; i < n; ++i)
  {
    if (!(c[i].cost <= least + tie(c[i].record, k->x)))
      continue;
    const int64_t id = abut_surface_facet_id(d->primary, c[i].record->facet);
    if (best == NULL || id < best_id)
    {
      best = c[i].record;
      best_id = id;
    }
  }
  return best;
}

/* The cheapest of the candidates c[n] so far. */
typedef struct best_so_far
{
  const abut_record *record;
  double least;
  int32_t n_costs;
} best_so_far;

/* Drop the candidates that the border is in front of; whether the best one was
 * among them. */
static bool
drop_behind_border(abut_detection *d, const abut_ranking *k, abut_candidate *c,
                   int32_t n, double border, best_so_far *best)
{
  if (!(border < best->least) || best->record == NULL)
    return false;
  const abut_record *held = best->record;
  *best = (best_so_far){NULL, INFINITY, 0};
  for (int32_t i = 0; i < n; ++i)
  {
    if (c[i].cost == INFINITY)
      continue;
    if (!c[i].inside && c[i].cost > border + tie(c[i].record, k->x))
    {
      c[i].cost = INFINITY;
      ++d->rejected[ABUT_REJECTION_BEYOND_BORDER];
      continue;
    }
    ++best->n_costs;
    if (c[i].cost < best->least)
    {
      best->least = c[i].cost;
      best->record = c[i].record;
    }
  }
  return best->record != held;
}

int32_t
abut_detection_rank(abut_detection *d, const abut_ranking *k,
                    abut_projection *projection)
{
  abut_candidate *c = d->scratch.data;
  abut_projection p;
  best_so_far best = {NULL, INFINITY, 0};
  double border = INFINITY;
  bool fresh = true;
  int32_t i = 0;
  const int32_t n = select(d, k, c);
  do
  {
    for (; i < n; ++i)
    {
      bring_forward(c + i, n - i);
      const double limit = best.least + tie(c[i].record, k->x);
      if (c[i].bound > limit * limit)
        break;
      c[i].cost = cost_of(d, k, c[i].record, best.least, &border, &p);
      if (c[i].cost == INFINITY)
        continue;
      c[i].inside = p.inside;
      ++best.n_costs;
      if (!(c[i].cost < best.least))
        continue;
      best.least = c[i].cost;
      best.record = c[i].record;
      *projection = p;
      fresh = true;
    }
    if (!drop_behind_border(d, k, c, i, border, &best))
      break;
    fresh = false;
  } while (i < n);
  d->rejected[ABUT_REJECTION_COSTLIER] += n - i;
  if (best.record == NULL)
    return -1;
  d->rejected[ABUT_REJECTION_COSTLIER] += best.n_costs - 1;
  const abut_record *chosen =
      best.n_costs > 1 ? settle(d, k, c, i, best.least) : best.record;
  if (chosen != best.record || !fresh)
    (void)cost_of(d, k, chosen, INFINITY, &border, projection);
  return chosen->facet;
}
