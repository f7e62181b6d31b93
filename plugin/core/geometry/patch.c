/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Polynomial form of surface facets. */
#include "geometry/patch.h"
#include "geometry/vector.h"
#include <string.h>

/* Coefficients of 1, t, t^2 from the values at t = -1, 1, 0. */
static void
line_coefficients(const double *l, const double *r, const double *m,
                  double c[3][3])
{
  for (int i = 0; i < 3; ++i)
  {
    c[0][i] = m[i];
    c[1][i] = 0.5 * (r[i] - l[i]);
    c[2][i] = 0.5 * (r[i] - m[i]) + 0.5 * (l[i] - m[i]);
  }
}

static void
init_quad4(abut_patch *p, double x[9][3])
{
  for (int i = 0; i < 3; ++i)
  {
    p->c[1][i] = 0.25 * ((x[1][i] - x[0][i]) + (x[3][i] - x[2][i]));
    p->c[2][i] = 0.25 * ((x[2][i] - x[0][i]) + (x[3][i] - x[1][i]));
    p->c[3][i] = 0.25 * ((x[0][i] - x[1][i]) + (x[3][i] - x[2][i]));
    p->c[0][i] = 0.25 * ((x[0][i] + x[3][i]) + (x[1][i] + x[2][i]));
  }
}

static void
init_tri6(abut_patch *p, double x[9][3])
{
  for (int i = 0; i < 3; ++i)
  {
    const double e1 = x[1][i] - x[0][i], e2 = x[2][i] - x[0][i],
                 m1 = x[3][i] - x[0][i], m2 = x[5][i] - x[0][i];
    p->c[0][i] = x[0][i];
    p->c[1][i] = 4. * m1 - e1;
    p->c[2][i] = 4. * m2 - e2;
    p->c[3][i] = 4. * ((x[4][i] - x[0][i]) - m1 - m2);
    p->c[4][i] = 2. * e1 - 4. * m1;
    p->c[5][i] = 2. * e2 - 4. * m2;
  }
}

static void
init_quad9(abut_patch *p, double x[9][3])
{
  /* Rows of nodes at eta = -1, 1, 0, each as 1, xi, xi^2; then along eta. */
  static const int row[3][3] = {{0, 1, 6}, {2, 3, 7}, {4, 5, 8}};
  static const int term[3][3] = {{0, 2, 5}, {1, 3, 7}, {4, 6, 8}};
  double c[3][3][3];
  for (int j = 0; j < 3; ++j)
    line_coefficients(x[row[j][0]], x[row[j][1]], x[row[j][2]], c[j]);
  for (int k = 0; k < 3; ++k)
  {
    double d[3][3];
    line_coefficients(c[0][k], c[1][k], c[2][k], d);
    for (int j = 0; j < 3; ++j)
      memcpy(p->c[term[k][j]], d[j], sizeof(d[j]));
  }
}

void
abut_patch_init(abut_patch *p, abut_facet_kind kind, const double *nodes)
{
  double x[9][3] = {{0.}};
  const int n = abut_facet_n_nodes(kind);
  memset(p->c, 0, sizeof(p->c));
  p->triangle = kind == ABUT_FACET_TRI6 || kind == ABUT_FACET_TRI3;
  p->n_terms = n;
  for (int i = 0; i < 3; ++i)
    p->origin[i] = kind == ABUT_FACET_QUAD9
                       ? nodes[24 + i]
                       : nodes[i] + 0.5 * (nodes[3 + i] - nodes[i]);
  for (int a = 0; a < n; ++a)
    sub3(nodes + (ptrdiff_t)3 * a, p->origin, x[a]);
  if (kind == ABUT_FACET_QUAD4)
    init_quad4(p, x);
  else if (kind == ABUT_FACET_TRI6)
    init_tri6(p, x);
  else
    init_quad9(p, x);
  p->size = 0.;
  for (int k = 1; k < n; ++k)
    p->size += 2. * norm3(p->c[k]);
}

void
abut_patch_evaluate(const abut_patch *patch, double s, double t,
                    abut_patch_point *point)
{
  for (int i = 0; i < 3; ++i)
  {
#define C(k) patch->c[k][i]
    point->y[i] = C(0) + s * C(1) + t * (C(2) + s * C(3));
    point->y1[i] = C(1) + t * C(3);
    point->y2[i] = C(2) + s * C(3);
    point->y12[i] = C(3);
    point->y11[i] = point->y22[i] = 0.;
    if (patch->n_terms > 4)
    {
      point->y[i] += s * s * C(4) + t * t * C(5);
      point->y1[i] += 2. * s * C(4);
      point->y2[i] += 2. * t * C(5);
      point->y11[i] = 2. * C(4);
      point->y22[i] = 2. * C(5);
    }
    if (patch->n_terms > 6)
    {
      const double u = C(6) + t * C(8), v = C(7) + s * C(8);
      point->y[i] += s * t * (s * C(6) + t * v);
      point->y1[i] += t * (2. * s * u + t * C(7));
      point->y2[i] += s * (2. * t * v + s * C(6));
      point->y11[i] += 2. * t * u;
      point->y22[i] += 2. * s * v;
      point->y12[i] += 2. * (s * C(6) + t * C(7)) + 4. * s * t * C(8);
    }
#undef C
  }
}
