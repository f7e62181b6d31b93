/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* All normals are made of cross products of two sums over nodes (lines: of one
 * sum, turned), whose derivatives are plain. The area of a curved facet is by
 * quadrature, as where it is measured. */
#include "geometry/normal_change.h"
#include "geometry/kernels.h"
#include "geometry/quadrature.h"
#include "geometry/vector.h"

#include <stdbool.h>
#include <string.h>

/* A vector with its derivatives. */
typedef struct varied
{
  double v[3];
  double d[3][3 * ABUT_FACET_MAX_NODES];
} varied;

/* A facet whose nodes vary. */
typedef struct facet
{
  abut_facet_kind kind;
  int dim, n;
  const double *x;
} facet;

/* sum_b c_b x_b */
static void
combine(const facet *f, const double *c, double *v)
{
  v[0] = v[1] = v[2] = 0.;
  for (int b = 1; b < f->n; ++b)
    for (int d = 0; d < f->dim; ++d)
      v[d] += c[b] * (f->x[b * f->dim + d] - f->x[d]);
}

/* Add factor times (sum_b u_b x_b) x (sum_b w_b x_b), of which each sum is one
 * of differences; of lines the first one, turned clockwise. */
static void
add_cross(const facet *f, const double *u, const double *w, double factor,
          varied *sum)
{
  double a[3], b[3], c[3];
  combine(f, u, a);
  if (f->dim == 2)
  {
    sum->v[0] += factor * a[1];
    sum->v[1] -= factor * a[0];
    for (int k = 0; k < f->n; ++k)
    {
      sum->d[0][2 * k + 1] += factor * u[k];
      sum->d[1][2 * k] -= factor * u[k];
    }
    return;
  }
  combine(f, w, b);
  cross3(a, b, c);
  axpy3(sum->v, factor, c, sum->v);
  for (int k = 0; k < f->n; ++k)
    for (int e = 0; e < 3; ++e)
    {
      double axis[3] = {0., 0., 0.}, first[3], second[3];
      axis[e] = 1.;
      cross3(axis, b, first);
      cross3(a, axis, second);
      for (int d = 0; d < 3; ++d)
        sum->d[d][3 * k + e] += factor * (u[k] * first[d] + w[k] * second[d]);
    }
}

/* Area times normal of facets with straight sides, and of curved lines the
 * integral of the normal, which is that of the chord. */
static void
add_straight(const facet *f, varied *sum)
{
  static const double chord[3] = {-1., 1., 0.},
                      tri[2][3] = {{-1., 1., 0.}, {-1., 0., 1.}},
                      quad[2][4] = {{-1., 0., 0., 1.}, {0., -1., 1., 0.}};
  if (f->dim == 2)
    add_cross(f, chord, chord, 1., sum);
  else if (f->n == 3)
    add_cross(f, tri[0], tri[1], 0.5, sum);
  else
    add_cross(f, quad[0], quad[1], 0.5, sum);
}

static void
add_at(const facet *f, const double *local, double factor, varied *sum)
{
  abut_shape s;
  if (f->dim == 2)
    abut_shape2(f->kind, local[0], &s);
  else
    abut_shape3(f->kind, local[0], local[1], &s);
  add_cross(f, s.d[0], s.d[1], factor, sum);
}

/* Area of a curved facet, with its derivatives; whole: the integral of the
 * normal. */
static double
measure(const facet *f, double *change, varied *whole)
{
  abut_rule rule;
  double area = 0.;
  abut_rule_facet(f->kind, f->dim == 2 ? 9 : 7, &rule);
  memset(change, 0, sizeof(double) * (size_t)(f->dim * f->n));
  for (int q = 0; q < rule.n; ++q)
  {
    varied here;
    memset(&here, 0, sizeof(here));
    add_at(f, rule.local[q], 1., &here);
    const double size = norm3(here.v), w = rule.weight[q];
    area += w * size;
    for (int k = 0; k < f->dim * f->n; ++k)
      for (int d = 0; d < 3; ++d)
      {
        change[k] += size > 0. ? w * here.v[d] / size * here.d[d][k] : 0.;
        whole->d[d][k] += w * here.d[d][k];
      }
    axpy3(whole->v, w, here.v, whole->v);
  }
  return area;
}

void
abut_unit_change(int n, double *vector,
                 double (*change)[3 * ABUT_FACET_MAX_NODES])
{
  const double length = unit3(vector, ABUT_TINY);
  for (int k = 0; k < n; ++k)
  {
    double along = 0.;
    for (int d = 0; d < 3; ++d)
      along += vector[d] * change[d][k];
    for (int d = 0; d < 3; ++d)
      change[d][k] =
          length > 0. ? (change[d][k] - along * vector[d]) / length : 0.;
  }
}

void
abut_facet_normal_change(abut_facet_kind kind, const double *nodes, int a,
                         double *normal,
                         double (*change)[3 * ABUT_FACET_MAX_NODES])
{
  const facet f = {kind, abut_facet_dimension(kind), abut_facet_n_nodes(kind),
                   nodes};
  const bool curved = f.n > abut_facet_n_corners(kind);
  varied result, whole;
  memset(&result, 0, sizeof(result));
  memset(&whole, 0, sizeof(whole));
  if (!curved || (a < 0 && f.dim == 2))
    add_straight(&f, &result);
  else
  {
    double of_area[3 * ABUT_FACET_MAX_NODES];
    const double area = measure(&f, of_area, &whole);
    if (a < 0)
      result = whole;
    else
    {
      add_at(&f, abut_facet_node_local(kind, a), 1., &result);
      abut_unit_change(f.dim * f.n, result.v, result.d);
      for (int d = 0; d < 3; ++d)
        for (int k = 0; k < f.dim * f.n; ++k)
          result.d[d][k] = area * result.d[d][k] + result.v[d] * of_area[k];
      for (int d = 0; d < 3; ++d)
        result.v[d] *= area;
    }
  }
  memcpy(normal, result.v, sizeof(result.v));
  memcpy(change, result.d, sizeof(result.d));
}
