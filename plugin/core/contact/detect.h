/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONTACT_DETECT_H
#define ABUT_CONTACT_DETECT_H

/* The inside of a detection. */

#include "search/reuse.h"

#include <abut/detect.h>
#include <abut/projection.h>

enum
{
  ABUT_MAX_GROUPS = 64
};

struct abut_detection
{
  abut_context *context;
  abut_surface *secondary;
  abut_surface *primary;
  abut_detection_options options; /* without the arrays of thicknesses */
  bool compare_nodes; /* node numbers of both surfaces mean the same nodes */
  bool exclude_ring;
  abut_search *search;
  abut_skin_list list;

  int32_t n_groups; /* primary groups in pairs; 0: all groups are paired */
  int32_t groups[ABUT_MAX_GROUPS];
  abut_array node_groups;     /* uint64_t, [n_nodes] bits of paired groups */
  abut_array thickness;       /* double, [n_thicknesses] */
  abut_array thickness_group; /* int32_t */

  abut_array contact;    /* abut_contact, [n_nodes] */
  abut_array listed;     /* uint8_t, [n_nodes] the node has candidates */
  abut_array reversed;   /* uint8_t, [n_nodes] all of them face away */
  abut_array scratch;    /* abut_candidate, of one node */
  const double *normals; /* of the secondary nodes, while running */
  abut_detection_view view;
  int64_t rejected[ABUT_REJECTION_N]; /* of the view */
};

/* A candidate that passed the filters that need no projection. */
typedef struct abut_candidate
{
  const abut_record *record;
  double bound;  /* squared distance to its box: not more than cost^2 */
  double centre; /* squared distance to its centre */
  double cost;
  bool inside; /* its nearest point is inside the facet */
} abut_candidate;

/* One node and its candidates. */
typedef struct abut_ranking
{
  int32_t node;
  double x[3];
  double normal[3];
  uint64_t groups;
  const int32_t *slot; /* [n] */
  int32_t n;
} abut_ranking;

/* Steps 12 to 14: the facet of the node, with its projection, or -1. Counts
 * rejections in the view. Scratch must hold k->n candidates. */
int32_t abut_detection_rank(abut_detection *d, const abut_ranking *k,
                            abut_projection *projection);

/* Bit of a primary group in pairs, or 0. */
uint64_t abut_detection_group_bit(const abut_detection *detection,
                                  int32_t group);

#endif
