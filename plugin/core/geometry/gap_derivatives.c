/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* First and second derivatives of the gap, by stages.
 *
 * With y = sum N_a x_a, r = x - y = g n and T_i = y_,i . (dx - sum N_a dx_a),
 * E_i = n . sum N_a,i dx_a:
 *
 *   dg = n . (dx - sum N_a dx_a), since n . dn = 0 and n . y_,i = 0;
 *   the condition r . y_,i = 0 gives  H dxi = T + g E,  H = A - g B;
 *   n . y_,i = 0 gives  dn = -(E_i + B_ij dxi_j) A^-1_ik y_,k.
 *
 * The derivative of dg is then dn . (dx - sum N dx) - E . dxi, and with
 * A = H + g B it takes the symmetric form
 *
 *   d2g = -T'H^-1 E - E'H^-1 T - g E'H^-1 E - T'A^-1 B H^-1 T.
 *
 * On an edge the one tangent is that of the edge, at a corner there is none; n
 * turns also about the edge, or the corner, which adds
 *
 *   v' (I - n n' - A^-1_ij y_,i y_,j') v / g,  v = dx - sum N_a dx_a.
 *
 * Cost O(n^2), n = number of components of x and the nodes. */
#include "geometry/finish.h"
#include <stdbool.h>
#include <string.h>

enum
{
  max_unknowns = 3 * (1 + ABUT_FACET_MAX_NODES)
};

/* Everything at the projection that the two derivatives need. */
typedef struct stages
{
  int32_t dimension, n_nodes, n; /* n: unknowns */
  int m;                         /* tangents */
  double along[2][2];            /* their directions in local coordinates */
  double shape[ABUT_FACET_MAX_NODES], slope[2][ABUT_FACET_MAX_NODES];
  double normal[3], gap;
  double y1[2][3]; /* tangents */
  double a[2][2];  /* metric A */
  double b[2][2];  /* curvature B */
} stages;

static void
sum_nodes(const stages *s, const double *nodes, const double *weight, double *v)
{
  v[0] = v[1] = v[2] = 0.;
  /* Weights of derivatives sum up to 0: positions relative to a node. */
  for (int32_t k = 1; k < s->n_nodes; ++k)
    for (int32_t d = 0; d < s->dimension; ++d)
      v[d] += weight[k] * (nodes[k * s->dimension + d] - nodes[d]);
}

/* Tangents in all directions of the facet. */
static void
take_inside(stages *s, abut_facet_kind kind)
{
  memset(s, 0, sizeof(*s));
  s->m = abut_facet_dimension(kind) - 1;
  s->along[0][0] = s->along[1][1] = 1.;
}

/* Tangents along the edge that the local coordinates are on, none at a corner;
 * false if they are on none. */
static bool
take_edge(stages *s, abut_facet_kind kind, const double *local)
{
  const double near = 1e-12;
  const int n_corners = abut_facet_n_corners(kind);
  const bool triangle = n_corners == 3;
  const double last = 1. - local[0] - local[1];
  const bool on[3] = {triangle ? local[0] <= near : 1. - fabs(local[0]) <= near,
                      triangle ? local[1] <= near : 1. - fabs(local[1]) <= near,
                      triangle && last <= near};
  static const double along[3][2] = {{0., 1.}, {1., 0.}, {1., -1.}};
  memset(s, 0, sizeof(*s));
  if (abut_facet_dimension(kind) == 2)
    return on[0];
  const int n = on[0] + on[1] + on[2];
  s->m = n == 1;
  for (int k = 0; k < 3; ++k)
    if (on[k])
      memcpy(s->along[0], along[k], sizeof(s->along[0]));
  return n > 0;
}

/* Everything at a nearest point whose tangents are taken. */
static void
load(stages *s, abut_facet_kind kind, const double *nodes, const double *local,
     const double *normal, double gap)
{
  static const int which[2][2] = {{0, 2}, {2, 1}};
  abut_shape shape;
  s->dimension = abut_facet_dimension(kind);
  s->n_nodes = abut_facet_n_nodes(kind);
  s->n = s->dimension * (1 + s->n_nodes);
  s->gap = gap;
  for (int d = 0; d < s->dimension; ++d)
    s->normal[d] = normal[d];
  const int n_local = s->dimension - 1;
  if (n_local == 1)
    abut_shape2(kind, local[0], &shape);
  else
    abut_shape3(kind, local[0], local[1], &shape);
  memcpy(s->shape, shape.n, sizeof(double) * (size_t)s->n_nodes);
  for (int i = 0; i < s->m; ++i)
  {
    for (int k = 0; k < s->n_nodes; ++k)
      for (int a = 0; a < n_local; ++a)
        s->slope[i][k] += s->along[i][a] * shape.d[a][k];
    sum_nodes(s, nodes, s->slope[i], s->y1[i]);
  }
  for (int i = 0; i < s->m; ++i)
    for (int j = 0; j < s->m; ++j)
    {
      double second[3], weight[ABUT_FACET_MAX_NODES] = {0.};
      for (int k = 0; k < s->n_nodes; ++k)
        for (int a = 0; a < n_local; ++a)
          for (int b = 0; b < n_local; ++b)
            weight[k] +=
                s->along[i][a] * s->along[j][b] * shape.dd[which[a][b]][k];
      sum_nodes(s, nodes, weight, second);
      s->a[i][j] = dot3(s->y1[i], s->y1[j]);
      s->b[i][j] = dot3(s->normal, second);
    }
}

/* Inverse of a symmetric matrix of order m; zero if it is singular. */
static int
invert(int m, double h[2][2], double inverse[2][2])
{
  if (m == 1)
  {
    if (h[0][0] == 0.)
      return 0;
    inverse[0][0] = 1. / h[0][0];
    return 1;
  }
  const double det = h[0][0] * h[1][1] - h[0][1] * h[1][0];
  if (!(fabs(det) > 1e-13 * (fabs(h[0][0] * h[1][1]) + h[0][1] * h[0][1])))
    return 0;
  inverse[0][0] = h[1][1] / det;
  inverse[1][1] = h[0][0] / det;
  inverse[0][1] = inverse[1][0] = -h[0][1] / det;
  return 1;
}

/* T_i and E_i as rows over all unknowns. */
static void
load_rows(const stages *s, double t[2][max_unknowns], double e[2][max_unknowns])
{
  const int32_t dim = s->dimension;
  for (int i = 0; i < s->m; ++i)
    for (int32_t d = 0; d < dim; ++d)
    {
      t[i][d] = s->y1[i][d];
      e[i][d] = 0.;
      for (int32_t k = 0; k < s->n_nodes; ++k)
      {
        t[i][dim * (1 + k) + d] = -s->shape[k] * s->y1[i][d];
        e[i][dim * (1 + k) + d] = s->slope[i][k] * s->normal[d];
      }
    }
}

/* c = A^-1 B H^-1 = (H^-1 - A^-1) / g without the division. */
static void
curvature_term(int m, double a[2][2], double b[2][2], double h[2][2],
               double c[2][2])
{
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
    {
      c[i][j] = 0.;
      for (int k = 0; k < m; ++k)
        for (int l = 0; l < m; ++l)
          c[i][j] += a[i][k] * b[k][l] * h[l][j];
    }
  if (m == 2)
    c[0][1] = c[1][0] = 0.5 * (c[0][1] + c[1][0]);
}

static int
assemble_hessian(stages *s, double *hessian)
{
  double t[2][max_unknowns], e[2][max_unknowns];
  double h[2][2] = {{0.}}, h_inverse[2][2], a_inverse[2][2], c[2][2];
  const int m = s->m;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      h[i][j] = s->a[i][j] - s->gap * s->b[i][j];
  if (m > 0 && (!invert(m, s->a, a_inverse) || !invert(m, h, h_inverse)))
    return 0;
  curvature_term(m, a_inverse, s->b, h_inverse, c);
  load_rows(s, t, e);
  for (int32_t u = 0; u < s->n; ++u)
    for (int32_t v = 0; v <= u; ++v)
    {
      double sum = 0.;
      for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j)
          sum += h_inverse[i][j]
                     * (t[i][u] * e[j][v] + e[i][u] * t[j][v]
                        + s->gap * e[i][u] * e[j][v])
                 + c[i][j] * t[i][u] * t[j][v];
      hessian[u * s->n + v] = hessian[v * s->n + u] = -sum;
    }
  return 1;
}

/* The terms that are added where n rotates about an edge or a corner. */
static int
add_normal_rotation(const stages *s, double *hessian)
{
  const int32_t dim = s->dimension;
  double p[3][3];
  for (int32_t c = 0; c < dim; ++c)
    for (int32_t d = 0; d < dim; ++d)
      p[c][d] = ((c == d) - s->normal[c] * s->normal[d]
                 - (s->m > 0 ? s->y1[0][c] * s->y1[0][d] / s->a[0][0] : 0.))
                / s->gap;
  for (int32_t u = 0; u < s->n; ++u)
    for (int32_t v = 0; v < s->n; ++v)
    {
      const double a = u < dim ? 1. : -s->shape[u / dim - 1],
                   b = v < dim ? 1. : -s->shape[v / dim - 1];
      hessian[u * s->n + v] += a * b * p[u % dim][v % dim];
      if (!isfinite(hessian[u * s->n + v]))
        return 0;
    }
  return 1;
}

static void
fill_gradient(const stages *s, double *gradient)
{
  for (int32_t d = 0; gradient && d < s->dimension; ++d)
  {
    gradient[d] = s->normal[d];
    for (int32_t k = 0; k < s->n_nodes; ++k)
      gradient[s->dimension * (1 + k) + d] = -s->shape[k] * s->normal[d];
  }
}

abut_status
abut_facet_gap_derivatives(abut_facet_kind kind, const double *nodes,
                           const abut_projection *projection, double *gradient,
                           double *hessian)
{
  const int32_t n_nodes = abut_facet_n_nodes(kind),
                dimension = abut_facet_dimension(kind);
  if (n_nodes == 0 || !nodes || !projection)
    return ABUT_INVALID_ARGUMENT;
  if (!abut_facet_finite(nodes, n_nodes * dimension)
      || !abut_facet_finite(projection->local, dimension - 1)
      || !abut_facet_finite(projection->normal, dimension)
      || !abut_facet_finite(&projection->gap, 1))
    return ABUT_NOT_FINITE;
  if (!projection->inside || dot3(projection->normal, projection->normal) == 0.)
    return ABUT_UNSUPPORTED;
  stages s;
  take_inside(&s, kind);
  load(&s, kind, nodes, projection->local, projection->normal, projection->gap);
  if (hessian && !assemble_hessian(&s, hessian))
    return ABUT_UNSUPPORTED;
  fill_gradient(&s, gradient);
  return ABUT_SUCCESS;
}

abut_status
abut_facet_distance_derivatives(abut_facet_kind kind, const double *nodes,
                                const double *x,
                                const abut_projection *projection, double side,
                                double *gradient, double *hessian)
{
  if (abut_facet_n_nodes(kind) == 0 || !nodes || !x || !projection
      || (side != 1. && side != -1.))
    return ABUT_INVALID_ARGUMENT;
  if (projection->inside)
    return abut_facet_gap_derivatives(kind, nodes, projection, gradient,
                                      hessian);
  const int32_t dimension = abut_facet_dimension(kind);
  if (!abut_facet_finite(nodes, abut_facet_n_nodes(kind) * dimension)
      || !abut_facet_finite(x, dimension)
      || !abut_facet_finite(projection->local, dimension - 1)
      || !abut_facet_finite(projection->point, dimension))
    return ABUT_NOT_FINITE;
  double normal[3] = {0., 0., 0.};
  for (int32_t d = 0; d < dimension; ++d)
    normal[d] = side * (x[d] - projection->point[d]);
  const double distance = unit3(normal, 0.);
  stages s;
  if (!(distance > 0.) || !take_edge(&s, kind, projection->local))
    return ABUT_UNSUPPORTED;
  load(&s, kind, nodes, projection->local, normal, side * distance);
  if (hessian
      && (!assemble_hessian(&s, hessian) || !add_normal_rotation(&s, hessian)))
    return ABUT_UNSUPPORTED;
  fill_gradient(&s, gradient);
  return ABUT_SUCCESS;
}
