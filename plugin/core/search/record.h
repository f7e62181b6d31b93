/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_RECORD_H
#define ABUT_SEARCH_RECORD_H

/* Data of a facet for the search, two cache lines, kept in search order; and
 * the two exact tests that define the set of pairs. */

#include "geometry/surface.h"

typedef struct abut_record
{
  /* First line: what decides whether the facet is near. */
  double lower[3]; /* box of the facet */
  double upper[3];
  double reach; /* max(reach, relative reach * size) */
  double radius;
  /* Second line. */
  double centre[3];
  double normal[3]; /* unit mean normal */
  double size;      /* longest side */
  int32_t facet;
  int32_t group;
} abut_record;

/* Reach of a search, as in abut_search_options. */
typedef struct abut_reach
{
  double absolute;
  double relative;
} abut_reach;

static inline double
abut_reach_of(const abut_reach *reach, double size)
{
  const double relative = reach->relative * size;
  return relative > reach->absolute ? relative : reach->absolute;
}

/* Whether point and facet are a pair when the reach is enlarged by skin;
 * *square is the squared distance to the centre. */
static inline int
abut_record_near_point(const abut_record *r, const double *x, double skin,
                       double *square)
{
  const double reach = r->reach + skin;
  int in = 1;
  double d2 = 0;
  for (int d = 0; d < 3; ++d)
  {
    in &= (x[d] >= r->lower[d] - reach) & (x[d] <= r->upper[d] + reach);
    d2 += (x[d] - r->centre[d]) * (x[d] - r->centre[d]);
  }
  const double limit = reach + r->radius;
  *square = d2;
  return in & (d2 <= limit * limit);
}

/* Whether a box and the facet are a pair. */
static inline int
abut_record_near_box(const abut_record *r, const double *lower,
                     const double *upper, double skin)
{
  const double reach = r->reach + skin;
  int in = 1;
  for (int d = 0; d < 3; ++d)
    in &= (upper[d] >= r->lower[d] - reach) & (lower[d] <= r->upper[d] + reach);
  return in;
}

enum
{
  ABUT_LANES = 8 /* facets that are measured together */
};

/* Measures of some facets, side by side for vector instructions. */
typedef struct abut_lanes
{
  double lower[3][ABUT_LANES];
  double upper[3][ABUT_LANES];
  double centre[3][ABUT_LANES];
  double normal[3][ABUT_LANES];
  double radius[ABUT_LANES];
  double size[ABUT_LANES];
} abut_lanes;

/* Bounds of inflated boxes, and the smallest half of a largest extent. */
typedef struct abut_bounds
{
  double lower[3];
  double upper[3];
  double smallest;
} abut_bounds;

/* Box and size of the n facets from `first` on at the current positions, 1 <= n
 * <= ABUT_LANES; lanes beyond n repeat the last one. */
void abut_lanes_bound(const abut_surface *surface, int32_t first, int32_t n,
                      abut_lanes *lanes);

/* The records of facets[n], 1 <= n <= ABUT_LANES; bounds are extended. */
void abut_records_compute(const abut_surface *surface, const int32_t *facets,
                          int32_t n, const abut_reach *reach,
                          abut_record *records, abut_bounds *bounds);

/* Ask for the nodes of facet f: first stage the connectivity, then, some
 * facets later, the positions. */
static inline void
abut_prefetch_facet(const abut_surface *s, int32_t f)
{
  __builtin_prefetch(s->view.facet_start + f);
  if (s->uniform_kind == ABUT_FACET_QUAD4)
    __builtin_prefetch(s->view.connectivity + 4 * (int64_t)f);
}

static inline void
abut_prefetch_nodes(const abut_surface *s, int32_t f)
{
  const int32_t first = s->view.facet_start[f];
  const int32_t n = s->view.facet_start[f + 1] - first;
  for (int32_t a = 0; a < n; ++a)
  {
    const double *x =
        s->view.position
        + (int64_t)s->view.dimension * s->view.connectivity[first + a];
    /* A position may lie across two cache lines. */
    __builtin_prefetch(x);
    __builtin_prefetch(x + s->view.dimension - 1);
  }
}

#endif
