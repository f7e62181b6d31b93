/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Tree of boxes. The facets of a box are halved by number at the median of
 * their centres along the longest extent of the centres, down to leaves of at
 * most LEAF facets; so the shape of the tree follows from the number of facets
 * and needs no pointers. The nearest facet is found by descending into the
 * nearer half first and leaving out boxes farther than the best facet so far.
 */
#include "geometry/facet_tree.h"

#include "geometry/kernels.h"
#include "geometry/vector.h"

#include <string.h>

enum
{
  LEAF = 4,
  MOST_LEVELS = 32
};

void
abut_facet_tree_prepare(abut_facet_tree *tree)
{
  memset(tree, 0, sizeof(*tree));
  tree->facet.element = sizeof(int32_t);
  tree->box.element = 6 * sizeof(double);
  tree->measure.element = 9 * sizeof(double);
}

void
abut_facet_tree_release(abut_context *context, abut_facet_tree *tree)
{
  abut_array_release(context, &tree->facet);
  abut_array_release(context, &tree->box);
  abut_array_release(context, &tree->measure);
}

/* A part of the facets: those at first .. last - 1 in the order of the leaves,
 * with the box of this number. */
typedef struct part
{
  int64_t box;
  int32_t first, last, level;
} part;

static void
halves(const part *p, part *half)
{
  const int32_t middle = p->first + (p->last - p->first) / 2;
  const part left = {2 * p->box + 1, p->first, middle, p->level + 1};
  const part right = {2 * p->box + 2, middle, p->last, p->level + 1};
  half[0] = left;
  half[1] = right;
}

/* Centres and boxes of all facets. */
static abut_status
measure(const abut_surface *surface, double *m)
{
  for (int32_t f = 0; f < surface->view.n_facets; ++f, m += 9)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    abut_facet_measures measures;
    abut_surface_gather(surface, f, nodes);
    const abut_status status = abut_facet_measure(
        (abut_facet_kind)surface->view.kinds[f], nodes, &measures);
    if (status != ABUT_SUCCESS)
      return status;
    memcpy(m, measures.centre, sizeof(measures.centre));
    memcpy(m + 3, measures.lower, sizeof(measures.lower));
    memcpy(m + 6, measures.upper, sizeof(measures.upper));
  }
  return ABUT_SUCCESS;
}

/* Put a box around the facets of a part; returns the direction in which their
 * centres extend most. */
static int
bound(const double *measures, const int32_t *facet, const part *p, double *box)
{
  double lower[3], upper[3];
  for (int d = 0; d < 3; ++d)
  {
    box[d] = lower[d] = INFINITY;
    box[3 + d] = upper[d] = -INFINITY;
  }
  for (int32_t i = p->first; i < p->last; ++i)
  {
    const double *m = measures + 9 * (int64_t)facet[i];
    for (int d = 0; d < 3; ++d)
    {
      lower[d] = min2(lower[d], m[d]);
      upper[d] = max2(upper[d], m[d]);
      box[d] = min2(box[d], m[3 + d]);
      box[3 + d] = max2(box[3 + d], m[6 + d]);
    }
  }
  int longest = 0;
  for (int d = 1; d < 3; ++d)
    if (upper[d] - lower[d] > upper[longest] - lower[longest])
      longest = d;
  return longest;
}

/* Whether facet a comes before facet b along direction d; ties by number, so
 * that the order is strict. */
static bool
before(const double *measures, int d, int32_t a, int32_t b)
{
  const double x = measures[9 * (int64_t)a + d];
  const double y = measures[9 * (int64_t)b + d];
  return x < y || (x == y && a < b);
}

/* Hoare's selection: the facets before place `middle` come before the others
 * along direction d. Expected O(n). */
static void
divide(const double *measures, int d, int32_t *facet, int32_t first,
       int32_t last, int32_t middle)
{
  while (last - first > 1)
  {
    const int32_t pivot = facet[first + (last - first) / 2];
    int32_t i = first, j = last - 1;
    while (i <= j)
    {
      while (before(measures, d, facet[i], pivot))
        ++i;
      while (before(measures, d, pivot, facet[j]))
        --j;
      if (i > j)
        break;
      const int32_t swap = facet[i];
      facet[i++] = facet[j];
      facet[j--] = swap;
    }
    if (middle <= j)
      last = j + 1;
    else if (middle >= i)
      first = i;
    else
      return;
  }
}

abut_status
abut_facet_tree_build(abut_context *context, const abut_surface *surface,
                      abut_facet_tree *tree)
{
  const int32_t n = surface->view.n_facets;
  int32_t depth = 0;
  while ((int64_t)LEAF << depth < n)
    ++depth;
  abut_status status = abut_array_reserve(context, &tree->facet, 0, n);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &tree->measure, 0, n);
  if (status == ABUT_SUCCESS)
    status =
        abut_array_reserve(context, &tree->box, 0, ((int64_t)2 << depth) - 1);
  if (status == ABUT_SUCCESS)
    status = measure(surface, tree->measure.data);
  if (status != ABUT_SUCCESS)
    return status;
  tree->n_facets = n;
  tree->depth = depth;
  int32_t *facet = tree->facet.data, n_stacked = 1;
  for (int32_t f = 0; f < n; ++f)
    facet[f] = f;
  part stack[2 * MOST_LEVELS] = {{0, 0, n, 0}};
  while (n_stacked > 0)
  {
    const part p = stack[--n_stacked];
    const int longest = bound(tree->measure.data, facet, &p,
                              (double *)tree->box.data + 6 * p.box);
    if (p.level == depth)
      continue;
    halves(&p, stack + n_stacked);
    divide(tree->measure.data, longest, facet, p.first, p.last,
           stack[n_stacked].last);
    n_stacked += 2;
  }
  return ABUT_SUCCESS;
}

/* Squared distance of a point to a box. */
static double
distance_to(const double *box, const double *x)
{
  double s = 0.;
  for (int d = 0; d < 3; ++d)
  {
    const double out = max2(max2(box[d] - x[d], x[d] - box[3 + d]), 0.);
    s += out * out;
  }
  return s;
}

/* A facet of the part that is nearer than the best one so far. */
static int32_t
nearest_of(const abut_facet_tree *tree, const abut_surface *surface,
           const part *p, const double *x, int32_t found, double limit,
           abut_projection *best)
{
  const int32_t *facet = tree->facet.data;
  for (int32_t i = p->first; i < p->last; ++i)
  {
    const int32_t f = facet[i];
    double nodes[3 * ABUT_FACET_MAX_NODES];
    abut_projection q;
    abut_surface_gather(surface, f, nodes);
    abut_project((abut_facet_kind)surface->view.kinds[f], nodes, x, &q);
    if (found < 0 ? q.distance <= limit
                  : q.distance < best->distance
                        || (q.distance == best->distance && f < found))
    {
      *best = q;
      found = f;
    }
  }
  return found;
}

int32_t
abut_facet_tree_nearest(const abut_facet_tree *tree,
                        const abut_surface *surface, const double *x,
                        double limit, abut_projection *projection)
{
  const double *box = tree->box.data;
  part stack[2 * MOST_LEVELS] = {{0, 0, tree->n_facets, 0}};
  int32_t n_stacked = tree->n_facets > 0 ? 1 : 0, found = -1;
  while (n_stacked > 0)
  {
    const part p = stack[--n_stacked];
    const double upper = found < 0 ? limit : projection->distance;
    /* Round-off of either distance must not decide. */
    if (distance_to(box + 6 * p.box, x) > upper * upper * (1. + 1e-12))
      continue;
    if (p.level == tree->depth)
    {
      found = nearest_of(tree, surface, &p, x, found, limit, projection);
      continue;
    }
    part *half = stack + n_stacked;
    halves(&p, half);
    if (distance_to(box + 6 * half[0].box, x)
        < distance_to(box + 6 * half[1].box, x))
    {
      const part swap = half[0];
      half[0] = half[1];
      half[1] = swap;
    }
    n_stacked += 2;
  }
  return found;
}
