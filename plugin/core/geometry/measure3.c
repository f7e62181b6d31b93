/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Measures of triangles and quadrilaterals. The control points of the Bezier
 * form contain the facet, so box and radius are bounds, not samples. */
#include "geometry/kernels.h"
#include "geometry/measure.h"
#include "geometry/quadrature.h"
#include "geometry/vector.h"

/* y_,xi x y_,eta */
static void
area_vector(abut_facet_kind kind, const double *nodes, double xi, double eta,
            double *n)
{
  abut_shape s;
  double t[2][3] = {{0.}};
  abut_shape3(kind, xi, eta, &s);
  for (int a = 1; a < abut_facet_n_nodes(kind); ++a)
    for (int i = 0; i < 2; ++i)
      for (int d = 0; d < 3; ++d)
        t[i][d] += s.d[i][a] * (nodes[3 * a + d] - nodes[d]);
  cross3(t[0], t[1], n);
}

/* Area and its vector by a product rule; triangles as squares with one side
 * collapsed, whose Jacobian is (1 - v)/8. */
static double
integrate_area(abut_facet_kind kind, const double *nodes, double *vector)
{
  const int triangle = abut_facet_n_corners(kind) == 3;
  double area = 0.;
  vector[0] = vector[1] = vector[2] = 0.;
  const double *point = abut_gauss_points(4), *weight = abut_gauss_weights(4);
  for (int q = 0; q < 16; ++q)
  {
    const double u = point[q % 4], v = point[q / 4];
    double w = weight[q % 4] * weight[q / 4], xi = u, eta = v, n[3];
    if (triangle)
    {
      xi = 0.25 * (1. + u) * (1. - v);
      eta = 0.5 * (1. + v);
      w *= 0.125 * (1. - v);
    }
    area_vector(kind, nodes, xi, eta, n);
    area += w * norm3(n);
    axpy3(vector, w, n, vector);
  }
  return area;
}

static void
linear_area(abut_facet_kind kind, const double *nodes, double *vector)
{
  double u[3], v[3];
  const int quad = kind == ABUT_FACET_QUAD4;
  sub3(nodes + (quad ? 9 : 3), nodes, u);
  sub3(nodes + 6, nodes + (quad ? 3 : 0), v);
  cross3(u, v, vector);
  for (int d = 0; d < 3; ++d)
    vector[d] *= 0.5;
}

/* Control points of the Bezier form; returns their number. */
static int
control_points(abut_facet_kind kind, const double *nodes, double *hull)
{
  static const int ends[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  static const int rows[3][3] = {{0, 1, 6}, {2, 3, 7}, {4, 5, 8}};
  const int n = abut_facet_n_nodes(kind);
  const ptrdiff_t step = 3;
  for (int i = 0; i < 3 * n; ++i)
    hull[i] = nodes[i];
  for (int d = 0; d < 3; ++d)
  {
    double *h = hull + d;
    /* Middle control point of a parabola: 2 m - (l + r)/2. */
    for (int e = 0; e < 3 && kind == ABUT_FACET_TRI6; ++e)
      h[9 + e * step] += h[9 + e * step] - 0.5 * h[step * ends[e][0]]
                         - 0.5 * h[step * ends[e][1]];
    for (int pass = 0; pass < 2 && kind == ABUT_FACET_QUAD9; ++pass)
      for (int r = 0; r < 3; ++r)
      {
        const int l = pass == 0 ? rows[r][0] : rows[0][r],
                  u = pass == 0 ? rows[r][1] : rows[1][r],
                  m = pass == 0 ? rows[r][2] : rows[2][r];
        h[step * m] += h[step * m] - 0.5 * h[step * l] - 0.5 * h[step * u];
      }
  }
  return n;
}

void
abut_measure_hull(const double *points, int n, int dimension,
                  abut_facet_measures *m)
{
  double square = 0.;
  for (int d = 0; d < 3; ++d)
    m->lower[d] = m->upper[d] = d < dimension ? points[d] : 0.;
  for (int a = 0; a < n; ++a)
  {
    double s = 0.;
    for (int d = 0; d < dimension; ++d)
    {
      const double x = points[dimension * a + d], y = x - m->centre[d];
      m->lower[d] = min2(m->lower[d], x);
      m->upper[d] = max2(m->upper[d], x);
      s += y * y;
    }
    square = max2(square, s);
  }
  m->radius = sqrt(square);
}

static double
largest_distance(const double *nodes, int n)
{
  double square = 0.;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < a; ++b)
    {
      double r[3];
      sub3(nodes + (ptrdiff_t)3 * a, nodes + (ptrdiff_t)3 * b, r);
      square = max2(square, dot3(r, r));
    }
  return sqrt(square);
}

/* Largest angle of the nodes' normals with the mean normal. */
static void
measure_warping(abut_facet_kind kind, const double *nodes, const double *normal,
                double *warping, double *lowest_cosine)
{
  const int n = abut_facet_n_nodes(kind);
  *warping = 0.;
  *lowest_cosine = 1.;
  for (int a = 0; a < n && kind != ABUT_FACET_TRI3; ++a)
  {
    const double *at = abut_facet_node_local(kind, a);
    double v[3], s[3];
    area_vector(kind, nodes, at[0], at[1], v);
    const double length = norm3(v), c = dot3(v, normal);
    cross3(v, normal, s);
    *lowest_cosine = min2(*lowest_cosine, length > 0. ? c / length : 0.);
    *warping = max2(*warping, atan2(norm3(s), c));
  }
}

void
abut_measure3(abut_facet_kind kind, const double *nodes, abut_facet_measures *m,
              double *vector_area, double *lowest_cosine)
{
  const int n = abut_facet_n_nodes(kind), triangle = n == 3 || n == 6;
  const int linear = n <= 4;
  double hull[3 * ABUT_FACET_MAX_NODES] = {0.};
  abut_shape s;
  abut_shape3(kind, triangle ? 1. / 3. : 0., triangle ? 1. / 3. : 0., &s);
  for (int d = 0; d < 3; ++d)
  {
    m->centre[d] = nodes[d];
    for (int a = 1; a < n; ++a)
      m->centre[d] += s.n[a] * (nodes[3 * a + d] - nodes[d]);
  }
  m->area = 0.;
  if (linear)
    linear_area(kind, nodes, m->normal);
  else
    m->area = integrate_area(kind, nodes, m->normal);
  *vector_area = unit3(m->normal, ABUT_TINY);
  measure_warping(kind, nodes, m->normal, &m->warping, lowest_cosine);
  m->diameter = largest_distance(nodes, n);
  if (kind == ABUT_FACET_TRI3
      || (linear && *lowest_cosine > 0. && m->warping < 1e-7))
    m->area = *vector_area;
  else if (linear)
  {
    double unused[3];
    m->area = integrate_area(kind, nodes, unused);
  }
  m->aspect = m->area > 0. ? m->diameter * m->diameter / m->area : INFINITY;
  const int n_hull = control_points(kind, nodes, hull);
  abut_measure_hull(hull, n_hull, 3, m);
}
