/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_RECORD_H
#define ABUT_SEARCH_RECORD_H

/* What the search knows of a facet, two cache lines, kept in search order; and
 * the two exact tests that define the set of pairs. */

#include "geometry/surface.h"

typedef struct abut_record
{
  double lower[3]; /* box of the facet */
  double upper[3];
  double centre[3];
  double normal[3]; /* unit mean normal */
  double radius;
  double reach; /* max(reach, relative reach * size) */
  double size;  /* longest side */
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

/* Whether point and facet are a pair when the reach is enlarged by skin. */
static inline int
abut_record_near_point(const abut_record *r, const double *x, double skin)
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

/* The record of facet f at the present positions. */
void abut_record_compute(const abut_surface *surface, int32_t f,
                         const abut_reach *reach, abut_record *record);

/* Records of the facets order[0..n-1] (NULL: 0..n-1) into records. */
void abut_record_compute_all(const abut_surface *surface, int32_t n,
                             const int32_t *order, const abut_reach *reach,
                             abut_record *records);

/* Box and longest side of facet f: what sorting needs. */
void abut_record_extent(const abut_surface *surface, int32_t f, double *lower,
                        double *upper, double *size);

#endif
