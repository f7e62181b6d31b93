/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "search/tree.h"

#include <math.h>

/* Class of size: log_8 of the ratio to the smallest, at most 63. */
static uint64_t
size_class(double half, double smallest)
{
  if (!(smallest > 0))
    return half > 0 ? 1 : 0;
  const int e = ilogb(half / smallest) / 3;
  return (uint64_t)(e < 0 ? 0 : e > 63 ? 63 : e);
}

static void
bound_sites(const abut_site *sites, const abut_keyed *items, int32_t n,
            double *lower, double *upper)
{
  for (int d = 0; d < 3; ++d)
  {
    lower[d] = INFINITY;
    upper[d] = -INFINITY;
  }
  for (int32_t i = 0; i < n; ++i)
  {
    const double *c = sites[items[i].index].centre;
    for (int d = 0; d < 3; ++d)
    {
      lower[d] = c[d] < lower[d] ? c[d] : lower[d];
      upper[d] = c[d] > upper[d] ? c[d] : upper[d];
    }
  }
}

static void sort_cluster(const abut_tree *tree, const abut_site *sites,
                         abut_keyed *items, abut_keyed *room, int32_t n);

/* Sort by key, then by finer keys what more than a bucket has in common. */
static void
sort_and_split(const abut_tree *tree, const abut_site *sites, abut_keyed *items,
               abut_keyed *room, int32_t n)
{
  abut_order_sort(items, room, n);
  for (int32_t i = 0; i < n;)
  {
    int32_t j = i + 1;
    while (j < n && items[j].key == items[i].key)
      ++j;
    if (j - i > tree->capacity)
      sort_cluster(tree, sites, items + i, room + i, j - i);
    i = j;
  }
}

/* Sort facets that share a cell on the finest lattice over them, and so on
 * until cells hold no more than a bucket or all centres are one point. Each
 * step divides the extent by 2^19, so that the depth is small. */
static void
sort_cluster(const abut_tree *tree, const abut_site *sites, abut_keyed *items,
             abut_keyed *room, int32_t n)
{
  double lower[3], upper[3];
  bound_sites(sites, items, n, lower, upper);
  const abut_lattice lattice = abut_lattice_make(lower, upper, 0);
  if (lattice.bits == 0)
    return;
  for (int32_t i = 0; i < n; ++i)
    items[i].key = abut_lattice_key(&lattice, sites[items[i].index].centre);
  sort_and_split(tree, sites, items, room, n);
}

void
abut_tree_order(abut_tree *tree, const abut_site *sites, int32_t n,
                abut_keyed *items, abut_keyed *room)
{
  double lower[3], upper[3], smallest = INFINITY;
  uint64_t classes = 0;
  for (int32_t i = 0; i < n; ++i)
  {
    items[i].index = i;
    smallest = sites[i].half < smallest ? sites[i].half : smallest;
  }
  bound_sites(sites, items, n, lower, upper);
  const abut_lattice lattice = abut_lattice_make(lower, upper, smallest);
  for (int32_t i = 0; i < n; ++i)
  {
    const uint64_t class = size_class(sites[i].half, smallest);
    items[i].key = abut_lattice_key(&lattice, sites[i].centre)
                   | class << (3 * lattice.bits);
    classes |= UINT64_C(1) << class;
  }
  tree->n_classes = 0;
  for (; classes != 0; classes &= classes - 1)
    ++tree->n_classes;
  sort_and_split(tree, sites, items, room, n);
}

abut_status
abut_tree_reserve(abut_context *context, abut_tree *tree, int32_t n,
                  int32_t capacity)
{
  tree->capacity = capacity;
  tree->n_facets = n;
  tree->n_buckets = (n + capacity - 1) / capacity;
  tree->n_levels = 0;
  int32_t n_groups = 0;
  for (int32_t boxes = tree->n_buckets; boxes > 0;)
  {
    const int32_t groups = (boxes + ABUT_TREE_FAN - 1) / ABUT_TREE_FAN;
    tree->level_start[tree->n_levels++] = n_groups;
    n_groups += groups;
    boxes = groups > 1 ? groups : 0;
  }
  return abut_array_reserve(context, &tree->groups, 0, n_groups);
}

static void
clear_lane(abut_tree_group *g, int lane)
{
  for (int d = 0; d < 3; ++d)
  {
    g->lower[d][lane] = INFINITY;
    g->upper[d][lane] = -INFINITY;
  }
}

double
abut_tree_fit_bucket(abut_tree *tree, int32_t b, const double *lower,
                     const double *upper)
{
  abut_tree_group *g = (abut_tree_group *)tree->groups.data + b / ABUT_TREE_FAN;
  const int lane = b % ABUT_TREE_FAN;
  double extent = 0;
  for (int d = 0; d < 3; ++d)
  {
    g->lower[d][lane] = lower[d];
    g->upper[d][lane] = upper[d];
    extent += upper[d] - lower[d];
  }
  return extent;
}

/* Box of a group into a lane of the level above. */
static void
fit_group(const abut_tree_group *from, abut_tree_group *g, int lane)
{
  for (int d = 0; d < 3; ++d)
  {
    double lower = from->lower[d][0], upper = from->upper[d][0];
    for (int k = 1; k < ABUT_TREE_FAN; ++k)
    {
      lower = from->lower[d][k] < lower ? from->lower[d][k] : lower;
      upper = from->upper[d][k] > upper ? from->upper[d][k] : upper;
    }
    g->lower[d][lane] = lower;
    g->upper[d][lane] = upper;
  }
}

void
abut_tree_fit(abut_tree *tree)
{
  abut_tree_group *groups = tree->groups.data;
  int32_t boxes = tree->n_buckets;
  for (int32_t level = 0; level < tree->n_levels; ++level)
  {
    const abut_tree_group *below =
        level > 0 ? groups + tree->level_start[level - 1] : NULL;
    abut_tree_group *at = groups + tree->level_start[level];
    const int32_t n_groups = (boxes + ABUT_TREE_FAN - 1) / ABUT_TREE_FAN;
    for (int32_t b = level > 0 ? 0 : boxes; b < n_groups * ABUT_TREE_FAN; ++b)
    {
      abut_tree_group *g = at + b / ABUT_TREE_FAN;
      if (b >= boxes)
        clear_lane(g, b % ABUT_TREE_FAN);
      else
        fit_group(below + b, g, b % ABUT_TREE_FAN);
    }
    boxes = n_groups;
  }
}

/* Bit k is set if box k of the group touches the box. */
static inline unsigned
touched(const abut_tree_group *g, const double *lower, const double *upper)
{
  uint8_t hit[ABUT_TREE_FAN];
  for (int k = 0; k < ABUT_TREE_FAN; ++k)
    hit[k] = (g->lower[0][k] <= upper[0]) & (g->upper[0][k] >= lower[0])
             & (g->lower[1][k] <= upper[1]) & (g->upper[1][k] >= lower[1])
             & (g->lower[2][k] <= upper[2]) & (g->upper[2][k] >= lower[2]);
  unsigned mask = 0;
  for (int k = 0; k < ABUT_TREE_FAN; ++k)
    mask |= (unsigned)hit[k] << k;
  return mask;
}

void
abut_tree_gather(const abut_tree *tree, const double *lower,
                 const double *upper, abut_runs *runs)
{
  /* Groups yet to be visited, the next one on top. Each level leaves at most
   * seven siblings behind. */
  int32_t stack[ABUT_TREE_DEPTH * ABUT_TREE_FAN];
  int8_t level_of[ABUT_TREE_DEPTH * ABUT_TREE_FAN];
  int top = 0;
  const abut_tree_group *groups = tree->groups.data;
  if (tree->n_levels == 0)
    return;
  stack[top] = 0;
  level_of[top++] = (int8_t)(tree->n_levels - 1);
  while (top > 0)
  {
    const int32_t group = stack[--top];
    const int level = level_of[top];
    const unsigned mask =
        touched(groups + tree->level_start[level] + group, lower, upper);
    if (level > 0)
    {
      for (int k = ABUT_TREE_FAN - 1; k >= 0; --k)
        if ((mask >> k & 1) != 0)
        {
          stack[top] = group * ABUT_TREE_FAN + k;
          level_of[top++] = (int8_t)(level - 1);
        }
      continue;
    }
    for (int k = 0; k < ABUT_TREE_FAN; ++k)
      if ((mask >> k & 1) != 0)
      {
        const int32_t first = (group * ABUT_TREE_FAN + k) * tree->capacity;
        const int32_t last = first + tree->capacity;
        abut_runs_add(runs, first,
                      last < tree->n_facets ? last : tree->n_facets);
      }
  }
}
