/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_OBSTACLE_H
#define ABUT_GEOMETRY_OBSTACLE_H

/* The inside of an obstacle: what all kinds share. A kind is a struct that
 * begins with an abut_obstacle, and its methods. */

#include "base/memory.h"

#include <abut/obstacle.h>

typedef struct abut_obstacle_methods
{
  /* Distances and gradients of n > 0 points of the obstacle's own frame, for
   * material inside; hessian may be NULL. Failures name the point by
   * abut_obstacle_fail(). */
  abut_status (*evaluate)(abut_obstacle *obstacle, int32_t n,
                          const double *points, double *distance,
                          double *gradient, double *hessian);
  /* The same of abut_obstacle_gap(); NULL: evaluate. */
  abut_status (*gap)(abut_obstacle *obstacle, int32_t n, const double *points,
                     double *gap, double *gradient, double *hessian);
  /* Release what the kind owns besides its struct; NULL: nothing. */
  void (*release)(abut_obstacle *obstacle);
} abut_obstacle_methods;

/* Lengths of a bounded shape through its centre, along unit vectors of its own
 * frame; a zero vector: in all directions. */
typedef struct abut_obstacle_extents
{
  int32_t n; /* 0: not bounded */
  double length[4];
  double axis[4][3];
} abut_obstacle_extents;

struct abut_obstacle
{
  abut_context *context;
  const abut_obstacle_methods *methods;
  size_t bytes; /* of the kind's struct */
  abut_obstacle_view view;
  abut_obstacle_extents extents;
  bool smooth;         /* no edges, corners or tips */
  bool placed;         /* the pose is not the identity */
  abut_array local;    /* double, points in the obstacle's own frame */
  abut_array gradient; /* double, for callers that want none */
  const double *space; /* points of the call under way, for messages */
};

/* Zeroed struct of a kind with the identity as its pose; NULL, with the failure
 * recorded, without memory. */
void *abut_obstacle_make(abut_context *context, const char *call, size_t bytes,
                         const abut_obstacle_methods *methods,
                         abut_obstacle_kind kind, int32_t dimension,
                         bool hollow);

/* Record "abut_obstacle_distance: what at point i = (x, y, z)". */
abut_status abut_obstacle_fail(abut_obstacle *obstacle, abut_status status,
                               int32_t i, const char *what);

#endif
