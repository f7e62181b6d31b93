/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Public calls about the shape of one facet: measures, faults, points. */
#include "geometry/measure.h"
#include "geometry/kernels.h"
#include "geometry/vector.h"

static void
measure(abut_facet_kind kind, const double *nodes, abut_facet_measures *m,
        double *vector_area, double *lowest_cosine)
{
  if (abut_facet_dimension(kind) == 2)
    abut_measure2(kind, nodes, m, vector_area, lowest_cosine);
  else
    abut_measure3(kind, nodes, m, vector_area, lowest_cosine);
}

abut_status
abut_facet_measure(abut_facet_kind kind, const double *nodes,
                   abut_facet_measures *measures)
{
  const int32_t n = abut_facet_n_nodes(kind);
  if (n == 0 || !nodes || !measures)
    return ABUT_INVALID_ARGUMENT;
  if (!abut_facet_finite(nodes, n * abut_facet_dimension(kind)))
    return ABUT_NOT_FINITE;
  double vector_area, lowest_cosine;
  measure(kind, nodes, measures, &vector_area, &lowest_cosine);
  return ABUT_SUCCESS;
}

/* Smallest distance of two nodes, and the largest coordinate. */
static double
smallest_distance(abut_facet_kind kind, const double *nodes, double *largest)
{
  const int n = abut_facet_n_nodes(kind), dim = abut_facet_dimension(kind);
  double square = INFINITY;
  *largest = 0.;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b <= a; ++b)
    {
      double s = 0.;
      for (int d = 0; d < dim; ++d)
      {
        const double r = nodes[a * dim + d] - nodes[b * dim + d];
        s += r * r;
        *largest = max2(*largest, fabs(nodes[a * dim + d]));
      }
      if (b < a)
        square = min2(square, s);
    }
  return sqrt(square);
}

abut_facet_fault
abut_facet_check(abut_facet_kind kind, const double *nodes)
{
  const int32_t n = abut_facet_n_nodes(kind), dim = abut_facet_dimension(kind);
  if (n == 0)
    return ABUT_FACET_FAULT_KIND;
  if (!nodes || !abut_facet_finite(nodes, n * dim))
    return ABUT_FACET_FAULT_NOT_FINITE;
  abut_facet_measures m;
  double vector_area, lowest_cosine, largest;
  measure(kind, nodes, &m, &vector_area, &lowest_cosine);
  const double nearest = smallest_distance(kind, nodes, &largest);
  const double round_off = 4. * 2.3e-16 * largest;
  if (!(nearest > max2(1e-12 * m.diameter, round_off))
      || !(m.diameter > 1. / ABUT_FACET_LIMIT))
    return ABUT_FACET_FAULT_COINCIDENT;
  const double smallest =
      dim == 2 ? 1e-12 * m.diameter
               : m.diameter * max2(1e-12 * m.diameter, round_off);
  if (!(m.area > smallest))
    return ABUT_FACET_FAULT_ZERO_AREA;
  if (!(vector_area > smallest) || !(lowest_cosine > 0.))
    return ABUT_FACET_FAULT_FOLDED;
  return ABUT_FACET_FAULT_NONE;
}

abut_status
abut_facet_point(abut_facet_kind kind, const double *nodes, const double *local,
                 double *point, double *normal)
{
  const int32_t n = abut_facet_n_nodes(kind), dim = abut_facet_dimension(kind);
  if (n == 0 || !nodes || !local)
    return ABUT_INVALID_ARGUMENT;
  if (!abut_facet_finite(nodes, n * dim) || !abut_facet_finite(local, dim - 1))
    return ABUT_NOT_FINITE;
  abut_shape s;
  double t[2][3] = {{0.}}, y[3] = {0.}, v[3] = {0.};
  if (dim == 2)
    abut_shape2(kind, local[0], &s);
  else
    abut_shape3(kind, local[0], local[1], &s);
  for (int32_t a = 1; a < n; ++a)
    for (int32_t d = 0; d < dim; ++d)
    {
      const double r = nodes[a * dim + d] - nodes[d];
      y[d] += s.n[a] * r;
      for (int i = 0; i < dim - 1; ++i)
        t[i][d] += s.d[i][a] * r;
    }
  if (dim == 2)
    t[1][2] = 1.; /* (tx, ty, 0) x (0, 0, 1) = (ty, -tx, 0) */
  cross3(t[0], t[1], v);
  const double l1 = dot3(t[0], t[0]), l2 = dot3(t[1], t[1]);
  unit3(v, max2(ABUT_PARALLEL * l1 * l2, ABUT_TINY));
  for (int32_t d = 0; d < dim; ++d)
  {
    if (point)
      point[d] = nodes[d] + y[d];
    if (normal)
      normal[d] = v[d];
  }
  return ABUT_SUCCESS;
}
