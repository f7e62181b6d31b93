/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* How the shares of mortar that moves change as nodes do.
 *
 * Points of integration are held at their places on the secondary facet, so
 * that weights, which are areas of the reference configuration, and the
 * functions psi and phi stay: what changes is the opposite point. In the sum
 * over all points of a secondary facet that is the whole change, since the
 * integrand is continuous where one primary facet follows another; but for
 * facets that the border of the primary surface cuts, whose covered part
 * changes, too.
 *
 * In the plane, with x(s), n(s) and y(t) the linear functions of the two ends,
 *
 *     (y - x) x n = 0 :
 *     dt = -( (sum phi dy - sum phi dx) x n + (y - x) x sum phi dn ) / (y,t x
 * n)
 *
 * in space, along the normal n of a linear patch of the facet, with x and y on
 * such patches of both sides, y = x + g n, and
 *
 *     y,1 dxi + y,2 deta - n dg = dx - dy + g dn . */
#include "contact/coupling.h"
#include "geometry/clip.h"
#include "geometry/kernels.h"
#include "geometry/linear_patch.h"
#include "geometry/normal_change.h"
#include "geometry/vector.h"

#include <string.h>

/* Room for the rate of a point; its columns are zero. */
static double *
new_rate(abut_coupling *c, abut_coupling_point *p, int32_t n_nodes,
         int32_t n_columns)
{
  const int64_t n = (int64_t)n_nodes * n_columns;
  if (abut_array_reserve(c->context, &c->change.rates, c->change.n_rates,
                         c->change.n_rates + n)
      != ABUT_SUCCESS)
    return NULL;
  double *rate = (double *)c->change.rates.data + c->change.n_rates;
  memset(rate, 0, sizeof(double) * (size_t)n);
  p->rate = c->change.n_rates;
  c->change.n_rates += n;
  return rate;
}

/* Add the derivative of a local coordinate by a column to the shape functions,
 * whose derivatives by the coordinate are slope. */
static void
add_column(double *rate, int32_t n_nodes, int32_t n_columns, int32_t column,
           const double *slope, double change)
{
  for (int32_t a = 0; a < n_nodes; ++a)
    rate[a * n_columns + column] += slope[a] * change;
}

/* A linear part of a line at one of its parameters. */
typedef struct part_point
{
  abut_part part;
  const int8_t *corner; /* its nodes on the facet */
  double share[2], x[2];
} part_point;

static void
place_on(abut_facet_kind kind, const double *nodes, int part, double s,
         part_point *p)
{
  p->corner = abut_facet_part_corners(kind, part);
  abut_facet_part(kind, nodes, part, &p->part);
  p->share[0] = 0.5 * (1. - s);
  p->share[1] = 0.5 * (1. + s);
  for (int d = 0; d < 2; ++d)
    p->x[d] = p->share[0] * p->part.x[0][d] + p->share[1] * p->part.x[1][d];
}

abut_status
abut_coupling_rate2(abut_coupling *c, const abut_coupling_facet *facet,
                    int part, double s, int primary_part, double t,
                    abut_coupling_point *p)
{
  const abut_facet_kind kind =
      (abut_facet_kind)c->primary->view.kinds[p->primary];
  const int32_t n_m = abut_facet_n_nodes(kind), n_s = facet->n,
                n_columns = abut_coupling_columns(c, n_s, n_m);
  const int n_parts = abut_facet_n_parts(kind);
  double nodes[3 * ABUT_FACET_MAX_NODES], n[2] = {0., 0.}, r[2], half[2];
  part_point x, y;
  abut_shape shape;
  abut_surface_gather(c->primary, p->primary, nodes);
  place_on(facet->kind, facet->x, part, s, &x);
  place_on(kind, nodes, primary_part, t, &y);
  for (int d = 0; d < 2; ++d)
  {
    for (int i = 0; i < 2; ++i)
      n[d] += x.share[i] * facet->node_normal[3 * x.corner[i] + d];
    r[d] = y.x[d] - x.x[d];
    half[d] = 0.5 * (y.part.x[1][d] - y.part.x[0][d]);
  }
  double *rate = new_rate(c, p, n_m, n_columns);
  if (rate == NULL)
    return ABUT_OUT_OF_MEMORY;
  const double along = half[0] * n[1] - half[1] * n[0];
  if (along == 0.)
    return ABUT_SUCCESS;
  abut_shape2(kind,
              n_parts == 1 ? t : 0.5 * t + (primary_part == 0 ? -0.5 : 0.5),
              &shape);
  const double each = 1. / (along * n_parts);
  /* v x n and r x v for the unit vectors v. */
  const double with_n[2] = {n[1], -n[0]}, with_r[2] = {-r[1], r[0]};
  for (int i = 0; i < 2; ++i)
    for (int d = 0; d < 2; ++d)
    {
      const int32_t of_x = 2 * x.corner[i] + d;
      add_column(rate, n_m, n_columns, of_x, shape.d[0],
                 each * x.share[i] * with_n[d]);
      add_column(rate, n_m, n_columns, 2 * (n_s + y.corner[i]) + d, shape.d[0],
                 -each * y.share[i] * with_n[d]);
      add_column(rate, n_m, n_columns, 2 * (n_s + n_m) + of_x, shape.d[0],
                 -each * x.share[i] * with_r[d]);
    }
  return ABUT_SUCCESS;
}

/* Places on a linear patch as sums over the nodes of its facet, with the
 * derivatives by the facet's local coordinates. */
typedef struct patch_shape
{
  double share[ABUT_FACET_MAX_NODES], slope[2][ABUT_FACET_MAX_NODES];
} patch_shape;

/* Local coordinates of the patch at those of the facet, of which they are an
 * affine function, and their derivatives. */
static void
local_of_patch(const abut_linear_patch *p, const double *local, double *st,
               double (*slope)[2])
{
  const bool tri = p->kind == ABUT_FACET_TRI3;
  double from[2], a[2], b[2];
  for (int d = 0; d < 2; ++d)
  {
    const double l0 = p->local[0][d], l1 = p->local[1][d], l2 = p->local[2][d];
    a[d] = tri ? l1 - l0 : 0.5 * (l1 - l0);
    b[d] = tri ? l2 - l0 : 0.5 * (l2 - l0);
    from[d] = local[d] - (tri ? l0 : 0.5 * (l1 + l2));
  }
  const double det = a[0] * b[1] - a[1] * b[0];
  slope[0][0] = b[1] / det;
  slope[0][1] = -b[0] / det;
  slope[1][0] = -a[1] / det;
  slope[1][1] = a[0] / det;
  for (int m = 0; m < 2; ++m)
    st[m] = slope[m][0] * from[0] + slope[m][1] * from[1];
}

static void
shape_on(abut_facet_kind kind, const abut_linear_patch *p, const double *local,
         patch_shape *result)
{
  double st[2], slope[2][2];
  abut_shape on_patch, corner;
  memset(result, 0, sizeof(*result));
  local_of_patch(p, local, st, slope);
  abut_shape3(p->kind, st[0], st[1], &on_patch);
  for (int i = 0; i < abut_facet_n_nodes(p->kind); ++i)
  {
    abut_shape3(kind, p->local[i][0], p->local[i][1], &corner);
    for (int b = 0; b < abut_facet_n_nodes(kind); ++b)
    {
      result->share[b] += on_patch.n[i] * corner.n[b];
      for (int k = 0; k < 2; ++k)
        for (int m = 0; m < 2; ++m)
          result->slope[k][b] += on_patch.d[m][i] * slope[m][k] * corner.n[b];
    }
  }
}

/* sum_b c_b x_b */
static void
combine(int n, const double *c, const double *nodes, double *x)
{
  x[0] = x[1] = x[2] = 0.;
  for (int b = 0; b < n; ++b)
    axpy3(x, c[b], nodes + (ptrdiff_t)3 * b, x);
}

/* Normal of a patch, with derivatives by the nodes of its facet. */
static void
normal_of_patch(abut_facet_kind kind, const abut_linear_patch *p,
                double *normal, double (*change)[3 * ABUT_FACET_MAX_NODES])
{
  double by_corner[3][3 * ABUT_FACET_MAX_NODES];
  const int n = abut_facet_n_nodes(p->kind);
  abut_facet_normal_change(p->kind, p->x[0], -1, normal, by_corner);
  abut_unit_change(3 * n, normal, by_corner);
  memset(change, 0, sizeof(by_corner));
  for (int i = 0; i < n; ++i)
  {
    abut_shape corner;
    abut_shape3(kind, p->local[i][0], p->local[i][1], &corner);
    for (int b = 0; b < abut_facet_n_nodes(kind); ++b)
      for (int d = 0; d < 3; ++d)
        for (int e = 0; e < 3; ++e)
          change[d][3 * b + e] += corner.n[b] * by_corner[d][3 * i + e];
  }
}

abut_status
abut_coupling_rate3(abut_coupling *c, const abut_coupling_facet *facet,
                    const abut_linear_patch *plane, const abut_linear_patch *s,
                    const abut_linear_patch *m, const double *opposite,
                    abut_coupling_point *p)
{
  const abut_facet_kind kind =
      (abut_facet_kind)c->primary->view.kinds[p->primary];
  const int32_t n_m = abut_facet_n_nodes(kind), n_s = facet->n,
                n_columns = abut_coupling_columns(c, n_s, n_m);
  double nodes[3 * ABUT_FACET_MAX_NODES], x[3], y[3], r[3], t[2][3], way[2][3],
      normal[3], rotation[3][3 * ABUT_FACET_MAX_NODES];
  abut_shape at;
  patch_shape on_s, on_m;
  double *rate = new_rate(c, p, n_m, n_columns);
  if (rate == NULL)
    return ABUT_OUT_OF_MEMORY;
  abut_surface_gather(c->primary, p->primary, nodes);
  abut_shape3(kind, opposite[0], opposite[1], &at);
  shape_on(facet->kind, s, p->local, &on_s);
  shape_on(kind, m, opposite, &on_m);
  normal_of_patch(facet->kind, plane, normal, rotation);
  combine(n_s, on_s.share, facet->x, x);
  combine(n_m, on_m.share, nodes, y);
  for (int k = 0; k < 2; ++k)
    combine(n_m, on_m.slope[k], nodes, t[k]);
  sub3(y, x, r);
  cross3(t[1], normal, way[0]);
  cross3(normal, t[0], way[1]);
  const double det = dot3(t[0], way[0]), gap = dot3(r, normal);
  if (det == 0.)
    return ABUT_SUCCESS;
  for (int k = 0; k < 2; ++k)
  {
    for (int32_t b = 0; b < n_s; ++b)
      for (int e = 0; e < 3; ++e)
      {
        double sum = on_s.share[b] * way[k][e];
        for (int d = 0; d < 3; ++d)
          sum += gap * way[k][d] * rotation[d][3 * b + e];
        add_column(rate, n_m, n_columns, 3 * b + e, at.d[k], sum / det);
      }
    for (int32_t b = 0; b < n_m; ++b)
      for (int e = 0; e < 3; ++e)
        add_column(rate, n_m, n_columns, 3 * (n_s + b) + e, at.d[k],
                   -on_m.share[b] * way[k][e] / det);
  }
  return ABUT_SUCCESS;
}

/* A block for the points of one primary facet, with zeros. */
static double *
new_block(abut_coupling *c, const abut_coupling_facet *facet, int32_t primary,
          int64_t n)
{
  if (abut_array_reserve(c->context, &c->change.blocks, c->change.n_blocks,
                         c->change.n_blocks + 1)
          != ABUT_SUCCESS
      || abut_array_reserve(c->context, &c->change.block_values,
                            c->change.n_block_values,
                            c->change.n_block_values + n)
             != ABUT_SUCCESS)
    return NULL;
  abut_coupling_block *b =
      (abut_coupling_block *)c->change.blocks.data + c->change.n_blocks;
  b->first = c->change.n_block_values;
  b->facet = facet->index;
  b->primary = primary;
  b->own_normals = facet->own_normals;
  b->unused = 0;
  double *value =
      (double *)c->change.block_values.data + c->change.n_block_values;
  memset(value, 0, sizeof(double) * (size_t)n);
  ++c->change.n_blocks;
  c->change.n_block_values += n;
  return value;
}

abut_status
abut_coupling_add_blocks(abut_coupling *c, const abut_coupling_facet *facet,
                         abut_coupling_share *share)
{
  const abut_coupling_point *p = c->work.points.data;
  const double *weight = c->work.values.data;
  share->first_block = c->change.n_blocks;
  for (int32_t q = 0, end; q < c->work.n_points; q = end)
  {
    const int32_t primary = p[q].primary,
                  n_m = abut_facet_n_nodes(
                      (abut_facet_kind)c->primary->view.kinds[primary]);
    const int64_t n = (int64_t)n_m * abut_coupling_columns(c, facet->n, n_m);
    double *value = new_block(c, facet, primary, n);
    if (value == NULL)
      return ABUT_OUT_OF_MEMORY;
    for (end = q; end < c->work.n_points && p[end].primary == primary; ++end)
    {
      const double *rate = (const double *)c->change.rates.data + p[end].rate;
      for (int64_t k = 0; k < n; ++k)
        value[k] += weight[end] * rate[k];
    }
    ++share->n_blocks;
  }
  return ABUT_SUCCESS;
}
