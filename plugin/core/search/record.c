/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "search/record.h"

#include "base/clones.h"
#include "geometry/vector.h"

/* Corners of quadrilaterals, side by side. */
typedef double corners[4][3][ABUT_LANES];

/* Lanes beyond n repeat the last facet. */
ABUT_INLINE void
gather_corners(const abut_surface *s, const int32_t *facets, int32_t n,
               corners x)
{
  for (int32_t l = 0; l < ABUT_LANES; ++l)
  {
    const int32_t f = facets[l < n ? l : n - 1];
    const int32_t *c = s->view.connectivity + 4 * (int64_t)f;
    for (int a = 0; a < 4; ++a)
    {
      const double *p = s->view.position + 3 * (int64_t)c[a];
      x[a][0][l] = p[0];
      x[a][1][l] = p[1];
      x[a][2][l] = p[2];
    }
  }
}

static inline double
square3(double x, double y, double z)
{
  return x * x + y * y + z * z;
}

#define DISTANCE(p, q)                                                         \
  square3((p)[0][l] - (q)[0][l], (p)[1][l] - (q)[1][l], (p)[2][l] - (q)[2][l])

/* Kinds with few nodes and straight sides are measured in place, because the
 * general measures (areas, warping, diameters) cost several times as much. */
ABUT_INLINE void
bound_quad4(const double (*restrict x)[3][ABUT_LANES], abut_lanes *restrict m)
{
  for (int d = 0; d < 3; ++d)
    for (int l = 0; l < ABUT_LANES; ++l)
    {
      m->lower[d][l] =
          min2(min2(x[0][d][l], x[1][d][l]), min2(x[2][d][l], x[3][d][l]));
      m->upper[d][l] =
          max2(max2(x[0][d][l], x[1][d][l]), max2(x[2][d][l], x[3][d][l]));
    }
  for (int l = 0; l < ABUT_LANES; ++l)
    m->size[l] = sqrt(max2(max2(DISTANCE(x[0], x[1]), DISTANCE(x[1], x[3])),
                           max2(DISTANCE(x[3], x[2]), DISTANCE(x[2], x[0]))));
}

ABUT_INLINE void
measure_quad4(const double (*restrict x)[3][ABUT_LANES], abut_lanes *restrict m)
{
  bound_quad4(x, m);
  for (int d = 0; d < 3; ++d)
    for (int l = 0; l < ABUT_LANES; ++l)
      m->centre[d][l] =
          0.25 * ((x[0][d][l] + x[1][d][l]) + (x[2][d][l] + x[3][d][l]));
  for (int l = 0; l < ABUT_LANES; ++l)
  {
    double a[3], b[3], n[3];
    for (int d = 0; d < 3; ++d)
    {
      a[d] = x[3][d][l] - x[0][d][l];
      b[d] = x[2][d][l] - x[1][d][l];
    }
    n[0] = a[1] * b[2] - a[2] * b[1];
    n[1] = a[2] * b[0] - a[0] * b[2];
    n[2] = a[0] * b[1] - a[1] * b[0];
    const double length = sqrt(square3(n[0], n[1], n[2]));
    /* A folded facet has the normal zero. */
    const double scale = 1 / max2(length, 1e-300);
    for (int d = 0; d < 3; ++d)
      m->normal[d][l] = scale * n[d];
  }
  for (int l = 0; l < ABUT_LANES; ++l)
    m->radius[l] =
        sqrt(max2(max2(DISTANCE(x[0], m->centre), DISTANCE(x[1], m->centre)),
                  max2(DISTANCE(x[2], m->centre), DISTANCE(x[3], m->centre))));
}

static void
measure_general(const abut_surface *s, const int32_t *facets, int32_t n,
                abut_lanes *m)
{
  abut_facet_measures one = {0};
  double nodes[3 * ABUT_FACET_MAX_NODES], size = 0;
  for (int32_t l = 0; l < ABUT_LANES; ++l)
  {
    if (l < n)
    {
      const abut_facet_kind kind = (abut_facet_kind)s->view.kinds[facets[l]];
      abut_surface_gather(s, facets[l], nodes);
      /* Cannot fail: kind and positions were checked by the surface. */
      (void)abut_facet_measure(kind, nodes, &one);
      size = abut_surface_longest_side(kind, nodes);
    }
    for (int d = 0; d < 3; ++d)
    {
      m->lower[d][l] = one.lower[d];
      m->upper[d][l] = one.upper[d];
      m->centre[d][l] = one.centre[d];
      m->normal[d][l] = one.normal[d];
    }
    m->radius[l] = one.radius;
    m->size[l] = size;
  }
}

ABUT_CLONES void
abut_lanes_bound(const abut_surface *s, int32_t first, int32_t n,
                 abut_lanes *lanes)
{
  corners x;
  int32_t facets[ABUT_LANES];
  for (int32_t l = 0; l < ABUT_LANES; ++l)
    facets[l] = first + l;
  if (s->uniform_kind != ABUT_FACET_QUAD4)
  {
    measure_general(s, facets, n, lanes);
    return;
  }
  gather_corners(s, facets, n, x);
  bound_quad4((const double(*)[3][ABUT_LANES])x, lanes);
}

ABUT_INLINE double
least_of(double *v)
{
  for (int k = 2; k < ABUT_LANES; k += 2)
    for (int l = 0; l < 2; ++l)
      v[l] = min2(v[l], v[k + l]);
  return min2(v[0], v[1]);
}

ABUT_INLINE void
extend_bounds(const abut_lanes *m, const double *restrict inflate,
              abut_bounds *bounds)
{
  double least[ABUT_LANES], most[ABUT_LANES], extent[ABUT_LANES] = {0};
  for (int d = 0; d < 3; ++d)
  {
    for (int l = 0; l < ABUT_LANES; ++l)
    {
      const double lower = m->lower[d][l] - inflate[l];
      const double upper = m->upper[d][l] + inflate[l];
      least[l] = lower;
      most[l] = -upper;
      extent[l] = max2(extent[l], upper - lower);
    }
    bounds->lower[d] = min2(bounds->lower[d], least_of(least));
    bounds->upper[d] = max2(bounds->upper[d], -least_of(most));
  }
  bounds->smallest = min2(bounds->smallest, 0.5 * least_of(extent));
}

ABUT_CLONES void
abut_records_compute(const abut_surface *s, const int32_t *facets, int32_t n,
                     const abut_reach *reach, abut_record *records,
                     abut_bounds *bounds)
{
  abut_lanes m;
  if (s->uniform_kind == ABUT_FACET_QUAD4)
  {
    corners x;
    gather_corners(s, facets, n, x);
    measure_quad4((const double(*)[3][ABUT_LANES])x, &m);
  }
  else
    measure_general(s, facets, n, &m);
  double inflate[ABUT_LANES];
  for (int l = 0; l < ABUT_LANES; ++l)
    inflate[l] = abut_reach_of(reach, m.size[l]);
  for (int32_t l = 0; l < n; ++l)
  {
    abut_record *r = records + l;
    for (int d = 0; d < 3; ++d)
    {
      r->lower[d] = m.lower[d][l];
      r->upper[d] = m.upper[d][l];
      r->centre[d] = m.centre[d][l];
      r->normal[d] = m.normal[d][l];
    }
    r->reach = inflate[l];
    r->radius = m.radius[l];
    r->size = m.size[l];
    r->facet = facets[l];
    r->group = abut_surface_group(s, facets[l]);
  }
  extend_bounds(&m, inflate, bounds);
}
