/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "search/record.h"

#include <math.h>

static inline double
min2(double a, double b)
{
  return a < b ? a : b;
}

static inline double
max2(double a, double b)
{
  return a > b ? a : b;
}

static inline double
square_distance(const double *a, const double *b)
{
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/* Kinds with few nodes and straight sides are measured in place, because the
 * general measures (areas, warping, diameters) cost several times as much. */
static inline void
compute_quad4(const double *x0, const double *x1, const double *x2,
              const double *x3, abut_record *r)
{
  double n[3], a[3], b[3], c[3];
  for (int d = 0; d < 3; ++d)
  {
    r->lower[d] = min2(min2(x0[d], x1[d]), min2(x2[d], x3[d]));
    r->upper[d] = max2(max2(x0[d], x1[d]), max2(x2[d], x3[d]));
    r->centre[d] = c[d] = 0.25 * ((x0[d] + x1[d]) + (x2[d] + x3[d]));
    a[d] = x3[d] - x0[d];
    b[d] = x2[d] - x1[d];
  }
  n[0] = a[1] * b[2] - a[2] * b[1];
  n[1] = a[2] * b[0] - a[0] * b[2];
  n[2] = a[0] * b[1] - a[1] * b[0];
  const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const double scale = length > 0 ? 1 / length : 0;
  for (int d = 0; d < 3; ++d)
    r->normal[d] = scale * n[d];
  r->radius = sqrt(max2(max2(square_distance(x0, c), square_distance(x1, c)),
                        max2(square_distance(x2, c), square_distance(x3, c))));
  r->size = sqrt(max2(max2(square_distance(x0, x1), square_distance(x1, x3)),
                      max2(square_distance(x3, x2), square_distance(x2, x0))));
}

static void
compute_general(const abut_surface *s, int32_t f, abut_record *r)
{
  double nodes[3 * ABUT_FACET_MAX_NODES];
  abut_facet_measures m;
  const abut_facet_kind kind = (abut_facet_kind)s->view.kinds[f];
  abut_surface_gather(s, f, nodes);
  /* Cannot fail: kind and positions were checked by the surface. */
  (void)abut_facet_measure(kind, nodes, &m);
  for (int d = 0; d < 3; ++d)
  {
    r->lower[d] = m.lower[d];
    r->upper[d] = m.upper[d];
    r->centre[d] = m.centre[d];
    r->normal[d] = m.normal[d];
  }
  r->radius = m.radius;
  r->size = abut_surface_longest_side(kind, nodes);
}

static inline void
compute(const abut_surface *s, int32_t f, abut_record *r)
{
  if (s->uniform_kind == ABUT_FACET_QUAD4)
  {
    const int32_t *c = s->view.connectivity + 4 * (int64_t)f;
    const double *p = s->view.position;
    compute_quad4(p + 3 * (int64_t)c[0], p + 3 * (int64_t)c[1],
                  p + 3 * (int64_t)c[2], p + 3 * (int64_t)c[3], r);
  }
  else
    compute_general(s, f, r);
}

void
abut_record_compute(const abut_surface *s, int32_t f, const abut_reach *reach,
                    abut_record *record)
{
  compute(s, f, record);
  record->reach = abut_reach_of(reach, record->size);
  record->facet = f;
  record->group = abut_surface_group(s, f);
}

/* As compute(), without what needs roots. */
static inline double
extent_quad4(const double *x0, const double *x1, const double *x2,
             const double *x3, double *lower, double *upper)
{
  for (int d = 0; d < 3; ++d)
  {
    lower[d] = min2(min2(x0[d], x1[d]), min2(x2[d], x3[d]));
    upper[d] = max2(max2(x0[d], x1[d]), max2(x2[d], x3[d]));
  }
  return sqrt(max2(max2(square_distance(x0, x1), square_distance(x1, x3)),
                   max2(square_distance(x3, x2), square_distance(x2, x0))));
}

void
abut_record_extent(const abut_surface *s, int32_t f, double *lower,
                   double *upper, double *size)
{
  if (s->uniform_kind == ABUT_FACET_QUAD4)
  {
    const int32_t *c = s->view.connectivity + 4 * (int64_t)f;
    const double *p = s->view.position;
    *size = extent_quad4(p + 3 * (int64_t)c[0], p + 3 * (int64_t)c[1],
                         p + 3 * (int64_t)c[2], p + 3 * (int64_t)c[3], lower,
                         upper);
    return;
  }
  abut_record r;
  compute_general(s, f, &r);
  for (int d = 0; d < 3; ++d)
  {
    lower[d] = r.lower[d];
    upper[d] = r.upper[d];
  }
  *size = r.size;
}
