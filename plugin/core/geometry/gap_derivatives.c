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
 * Cost O(n^2), n = number of components of x and the nodes. */
#include "geometry/finish.h"
#include <string.h>

enum
{
  max_unknowns = 3 * (1 + ABUT_FACET_MAX_NODES)
};

/* Everything at the projection that the two derivatives need. */
typedef struct stages
{
  int32_t dimension, n_nodes, n; /* n: unknowns */
  abut_shape shape;
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

static void
load(stages *s, abut_facet_kind kind, const double *nodes,
     const abut_projection *p)
{
  static const int which[2][2] = {{0, 2}, {2, 1}};
  s->dimension = abut_facet_dimension(kind);
  s->n_nodes = abut_facet_n_nodes(kind);
  s->n = s->dimension * (1 + s->n_nodes);
  s->gap = p->gap;
  memcpy(s->normal, p->normal, sizeof(s->normal));
  const int m = s->dimension - 1;
  if (m == 1)
    abut_shape2(kind, p->local[0], &s->shape);
  else
    abut_shape3(kind, p->local[0], p->local[1], &s->shape);
  for (int i = 0; i < m; ++i)
    sum_nodes(s, nodes, s->shape.d[i], s->y1[i]);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
    {
      double second[3];
      sum_nodes(s, nodes, s->shape.dd[which[i][j]], second);
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
  for (int i = 0; i < dim - 1; ++i)
    for (int32_t d = 0; d < dim; ++d)
    {
      t[i][d] = s->y1[i][d];
      e[i][d] = 0.;
      for (int32_t k = 0; k < s->n_nodes; ++k)
      {
        t[i][dim * (1 + k) + d] = -s->shape.n[k] * s->y1[i][d];
        e[i][dim * (1 + k) + d] = s->shape.d[i][k] * s->normal[d];
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
  const int m = s->dimension - 1;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      h[i][j] = s->a[i][j] - s->gap * s->b[i][j];
  if (!invert(m, s->a, a_inverse) || !invert(m, h, h_inverse))
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
  stages s = {0};
  load(&s, kind, nodes, projection);
  if (hessian && !assemble_hessian(&s, hessian))
    return ABUT_UNSUPPORTED;
  for (int32_t d = 0; gradient && d < dimension; ++d)
  {
    gradient[d] = s.normal[d];
    for (int32_t k = 0; k < n_nodes; ++k)
      gradient[dimension * (1 + k) + d] = -s.shape.n[k] * s.normal[d];
  }
  return ABUT_SUCCESS;
}
