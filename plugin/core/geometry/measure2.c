/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Measures of lines. The control polygon of a parabola (its Bezier points)
 * contains it, so box and radius are bounds, not samples. */
#include "geometry/kernels.h"
#include "geometry/measure.h"
#include "geometry/quadrature.h"
#include "geometry/vector.h"

static void
tangent(abut_facet_kind kind, const double *nodes, double xi, double *t)
{
  abut_shape s;
  abut_shape2(kind, xi, &s);
  t[0] = t[1] = 0.;
  for (int a = 1; a < abut_facet_n_nodes(kind); ++a)
    for (int d = 0; d < 2; ++d)
      t[d] += s.d[0][a] * (nodes[2 * a + d] - nodes[d]);
}

static double
arc_length(abut_facet_kind kind, const double *nodes)
{
  double sum = 0., t[2];
  const double *point = abut_gauss_points(5), *weight = abut_gauss_weights(5);
  for (int q = 0; q < 5; ++q)
  {
    tangent(kind, nodes, point[q], t);
    sum += weight[q] * sqrt(t[0] * t[0] + t[1] * t[1]);
  }
  return sum;
}

void
abut_measure2(abut_facet_kind kind, const double *nodes, abut_facet_measures *m,
              double *vector_area, double *lowest_cosine)
{
  const int n = abut_facet_n_nodes(kind);
  const double chord[2] = {nodes[2] - nodes[0], nodes[3] - nodes[1]};
  const double length = sqrt(chord[0] * chord[0] + chord[1] * chord[1]);
  double hull[6] = {0.};
  for (int d = 0; d < 2; ++d)
  {
    const double middle = nodes[d] + 0.5 * chord[d];
    m->centre[d] = n == 3 ? nodes[4 + d] : middle;
    hull[d] = nodes[d];
    hull[2 + d] = nodes[2 + d];
    hull[4 + d] = m->centre[d] + (m->centre[d] - middle);
  }
  m->centre[2] = 0.;
  m->normal[0] = length > 0. ? chord[1] / length : 0.;
  m->normal[1] = length > 0. ? -chord[0] / length : 0.;
  m->normal[2] = 0.;
  m->area = n == 2 ? length : arc_length(kind, nodes);
  *vector_area = length;
  *lowest_cosine = 1.;
  m->warping = 0.;
  for (int a = 0; a < n && length > 0.; ++a)
  {
    double t[2];
    tangent(kind, nodes, abut_facet_node_local(kind, a)[0], t);
    const double c = chord[0] * t[0] + chord[1] * t[1],
                 s = chord[0] * t[1] - chord[1] * t[0], l = sqrt(c * c + s * s);
    *lowest_cosine = min2(*lowest_cosine, l > 0. ? c / l : 0.);
    m->warping = max2(m->warping, atan2(fabs(s), c));
  }
  m->diameter = length;
  for (int a = 0; a <= 2 && n == 3; a += 2)
  {
    const double u = nodes[4] - nodes[a], v = nodes[5] - nodes[a + 1];
    m->diameter = max2(m->diameter, sqrt(u * u + v * v));
  }
  m->aspect = m->area > 0. ? m->diameter / m->area : INFINITY;
  abut_measure_hull(hull, n, 2, m);
}
