/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_SURFACE_H
#define ABUT_GEOMETRY_SURFACE_H

/* The inside of a surface. */

#include "base/memory.h"
#include "geometry/vector.h"

#include <abut/surface.h>

#include <stdbool.h>

struct abut_surface
{
  abut_context *context;
  abut_surface_view view;
  bool borrow;
  double feature_angle;
  int32_t uniform_kind;      /* kind of all facets, or -1 */
  uint64_t revision;         /* counts updates */
  uint64_t normals_revision; /* revision that normals belong to, or 0 */

  /* Owned memory; the view points into it or to borrowed arrays. */
  abut_array facet_start;  /* int32_t */
  abut_array connectivity; /* int32_t */
  abut_array kinds;        /* uint8_t */
  abut_array position;     /* double */
  abut_array node_id;      /* int64_t */
  abut_array facet_id;     /* int64_t */
  abut_array group;        /* int32_t */
  abut_array node_start;   /* int32_t */
  abut_array node_facet;   /* int32_t */
  abut_array neighbour;    /* int32_t */
  abut_array normal;       /* double */
  abut_array scratch;      /* double */
};

/* Corner k of a surface facet on the way around it, as a node number. */
static inline int32_t
abut_facet_loop(int32_t n_corners, int32_t k)
{
  static const int8_t quad[8] = {0, 1, 3, 2, 0, 1, 3, 2};
  static const int8_t tri[6] = {0, 1, 2, 0, 1, 2};
  return n_corners == 4 ? quad[k] : tri[k];
}

static inline int64_t
abut_surface_facet_id(const abut_surface *s, int32_t f)
{
  return s->view.facet_id != NULL ? s->view.facet_id[f] : f;
}

static inline int64_t
abut_surface_node_id(const abut_surface *s, int32_t i)
{
  return s->view.node_id != NULL ? s->view.node_id[i] : i;
}

static inline int32_t
abut_surface_group(const abut_surface *s, int32_t f)
{
  return s->view.group != NULL ? s->view.group[f] : 0;
}

/* Copy the positions of the nodes of facet f, node after node; returns their
 * number. */
static inline int32_t
abut_surface_gather(const abut_surface *s, int32_t f, double *restrict nodes)
{
  const int32_t *c = s->view.connectivity + s->view.facet_start[f];
  const int32_t n = s->view.facet_start[f + 1] - s->view.facet_start[f];
  const double *p = s->view.position;
  if (s->view.dimension == 3)
    for (int32_t a = 0; a < n; ++a)
      for (int d = 0; d < 3; ++d)
        nodes[3 * a + d] = p[3 * (int64_t)c[a] + d];
  else
    for (int32_t a = 0; a < n; ++a)
      for (int d = 0; d < 2; ++d)
        nodes[2 * a + d] = p[2 * (int64_t)c[a] + d];
  return n;
}

/* Outward normal of facet f, of any length, by its first corners where nodes
 * are at these positions. */
static inline void
abut_surface_corner_normal(const abut_surface_view *v, int32_t f,
                           const double *position, double *n)
{
  double corner[3][3] = {{0.}};
  for (int32_t k = 0; k < v->dimension; ++k)
    load3(position, v->dimension, v->connectivity[v->facet_start[f] + k],
          corner[k]);
  corner_normal3(v->dimension, corner, n);
}

/* Whether a node of facet f is marked. */
static inline bool
abut_surface_has_mark(const abut_surface_view *v, int32_t f,
                      const uint8_t *marked)
{
  for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
    if (marked[v->connectivity[e]] != 0)
      return true;
  return false;
}

/* Sum of the normals of the facets of node i, weighted by their angles there
 * (lines: by one): not of unit length. */
void abut_surface_angle_weighted(const abut_surface *s, int32_t i, double *sum);

/* Angle of facet f with nodes x at its node i; 1 at the ends of lines, pi at
 * nodes that are no corners. */
double abut_surface_angle(const abut_surface *s, int32_t f, int32_t i,
                          const double *x);

/* Length of the longest side of a facet between its corners. */
double abut_surface_longest_side(abut_facet_kind kind, const double *nodes);

/* Build node_start, node_facet and neighbour. */
abut_status abut_surface_topology(abut_surface *surface);

/* Checks of creation, in this order; each reports the first offender. */
abut_status abut_surface_check_data(abut_context *context,
                                    const abut_surface_data *data);
abut_status abut_surface_check_facets(const abut_surface *surface);
abut_status abut_surface_check_orientation(const abut_surface *surface);

/* NOT_FINITE, with the number of the node, unless all positions are legal. */
abut_status abut_surface_check_position(const abut_surface *surface,
                                        const char *call,
                                        const double *position);

#endif
