/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_INTERFACE_INSIDE_H
#define ABUT_INTERFACE_INSIDE_H

/* Nodes of a surface that are inside another one, or have gone through it. */

#include <abut/detect.h>

/* A node and the facet that it is deep behind. */
typedef struct abut_inside
{
  int32_t node;
  int32_t facet;
  double depth;
} abut_inside;

/* Detect the contacts of the nodes once. The view is that of the detection,
 * which is the caller's to destroy. */
abut_status abut_detect(abut_context *context, abut_surface *nodes,
                        abut_surface *facets,
                        const abut_detection_options *options,
                        abut_detection **detection, abut_detection_view *view);

/* Nodes deeper than depth in the facets, but not than half of the thickness (0:
 * not known) of the body behind them, which would be near its other skin.
 * Results are [n_nodes] and ascend; *n is their number. */
abut_status abut_nodes_inside(abut_context *context, abut_surface *nodes,
                              abut_surface *facets,
                              const abut_detection_options *options,
                              double depth, double thickness,
                              abut_inside *found, int32_t *n);

/* Positions of two surfaces at the beginning of a step. */
typedef struct abut_starts
{
  const double *nodes;  /* [n_nodes * dimension] */
  const double *facets; /* [n_nodes of the facets * dimension] */
} abut_starts;

/* Nodes that go through a facet, from outside to deeper than depth behind its
 * plane, each with the facet that it is deepest behind; of equal ones the
 * first. Only facets count that the surface at the node faces. See
 * abut_missed_contact(). Results as above. */
abut_status abut_nodes_through(abut_context *context, abut_surface *nodes,
                               abut_surface *facets,
                               const abut_search_options *options,
                               abut_starts start, double depth,
                               abut_inside *found, int32_t *n);

#endif
