/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_INTERFACE_PAIR_H
#define ABUT_INTERFACE_PAIR_H

/* The inside of a pair. */

#include "base/memory.h"

#include <abut/interface.h>

/* A surface of a pair. */
typedef struct abut_side
{
  abut_surface *surface; /* NULL: an obstacle is opposite */
  abut_array node;       /* int32_t, [n_nodes] the caller's numbers */
  abut_array reference;  /* double, [n_nodes * dimension] */
  abut_array current;    /* the same, scratch */
} abut_side;

struct abut_interface
{
  abut_context *context;
  abut_coupling *coupling;
  abut_obstacle *obstacle; /* or NULL */
  abut_discretisation discretisation;
  const abut_kinematics_info *kinematics;
  abut_kinematics word;
  int32_t dimension, number;
  bool tangents, flush;
  double facet_size;
  abut_side secondary, primary;
  abut_array facet; /* int32_t, [n_facets of the secondary] */
  abut_array line;  /* int32_t, nodes of a facet */
};

#endif
