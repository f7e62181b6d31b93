/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_TREE_H
#define ABUT_SEARCH_TREE_H

/* Adaptive buckets.
 *
 * Facets are classed by the ratio of their inflated half-extent to the
 * smallest one (a class spans a factor of eight), sorted by class and, within
 * a class, along Morton's curve. Runs of `capacity` facets of this order are
 * the buckets; eight buckets make a larger one, and so on up to the root. No
 * pointers: bucket b of a level holds the buckets 8 b .. 8 b + 7 of the level
 * below, and eight sibling boxes lie side by side so that one pass of vector
 * instructions tests them all. Facets that share a cell of the finest lattice
 * are sorted again on a lattice of their own, so that clusters far smaller
 * than the scene do not pile up.
 *
 * Build O(n); a query box visits O(log n) buckets in addition to the ones it
 * touches. */

#include "search/order.h"
#include "search/record.h"
#include "search/runs.h"

enum
{
  ABUT_TREE_FAN = 8,
  ABUT_TREE_DEPTH = 12
};

/* Eight sibling boxes; unused lanes are empty. */
typedef struct abut_tree_group
{
  double lower[3][ABUT_TREE_FAN];
  double upper[3][ABUT_TREE_FAN];
} abut_tree_group;

typedef struct abut_tree
{
  int32_t capacity; /* facets per bucket */
  int32_t n_facets;
  int32_t n_buckets;                    /* on the lowest level */
  int32_t n_classes;                    /* classes of size */
  int32_t n_levels;                     /* levels of groups; 0 without facets */
  int32_t level_start[ABUT_TREE_DEPTH]; /* first group of each level */
  double extent_built; /* sum of the buckets' extents when sorted */
  abut_array groups;   /* abut_tree_group */
} abut_tree;

/* Input of the order of facets: centre of box, inflated half-extent. */
typedef struct abut_site
{
  double centre[3];
  double half;
} abut_site;

/* Put the facets into search order: items[i].index is the i-th facet. */
void abut_tree_order(abut_tree *tree, const abut_site *sites, int32_t n,
                     abut_keyed *items, abut_keyed *room);

/* Room for the boxes of n facets. */
abut_status abut_tree_reserve(abut_context *context, abut_tree *tree, int32_t n,
                              int32_t capacity);

/* Set the box of bucket b of the lowest level; returns its extent. */
double abut_tree_fit_bucket(abut_tree *tree, int32_t b, const double *lower,
                            const double *upper);

/* Compute the boxes of all levels above the lowest. */
void abut_tree_fit(abut_tree *tree);

/* Runs of records in all buckets that the box touches. */
void abut_tree_gather(const abut_tree *tree, const double *lower,
                      const double *upper, abut_runs *runs);

#endif
