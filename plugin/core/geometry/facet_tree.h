/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_FACET_TREE_H
#define ABUT_GEOMETRY_FACET_TREE_H

/* A binary tree of boxes over the facets of a surface, for the nearest facet of
 * a point however far away it is; the search (search/search.h) answers what is
 * within a reach. */

#include "geometry/surface.h"

#include <abut/projection.h>

typedef struct abut_facet_tree
{
  int32_t n_facets;
  int32_t depth;      /* levels below the root */
  abut_array facet;   /* int32_t, [n_facets] in the order of the leaves */
  abut_array box;     /* double, [2^(depth + 1) - 1][6] lower and upper corner;
                         children of box k: 2k + 1 and 2k + 2 */
  abut_array measure; /* double, [n_facets][9] centre and box, for building */
} abut_facet_tree;

/* Empty tree. */
void abut_facet_tree_prepare(abut_facet_tree *tree);
void abut_facet_tree_release(abut_context *context, abut_facet_tree *tree);

/* Build the tree at the current positions. O(n log n). */
abut_status abut_facet_tree_build(abut_context *context,
                                  const abut_surface *surface,
                                  abut_facet_tree *tree);

/* The facet nearest to x (three components) if it is at most limit away, of
 * equally near ones the first, with the projection; else -1. O(log n) for
 * points near the surface. */
int32_t abut_facet_tree_nearest(const abut_facet_tree *tree,
                                const abut_surface *surface, const double *x,
                                double limit, abut_projection *projection);

#endif
