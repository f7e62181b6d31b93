/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Shape functions of triangles and quadrilaterals. */
#include "geometry/kernels.h"
#include <string.h>

static void
shape_tri3(double xi, double eta, abut_shape *s)
{
  static const double d1[] = {-1., 1., 0.}, d2[] = {-1., 0., 1.};
  s->n[0] = 1. - xi - eta;
  s->n[1] = xi;
  s->n[2] = eta;
  memcpy(s->d[0], d1, sizeof(d1));
  memcpy(s->d[1], d2, sizeof(d2));
  memset(s->dd, 0, sizeof(s->dd));
}

static void
shape_tri6(double xi, double eta, abut_shape *s)
{
  static const double dd0[] = {4., 4., 0., -8., 0., 0.},
                      dd1[] = {4., 0., 4., 0., 0., -8.},
                      dd2[] = {4., 0., 0., -4., 4., -4.};
  const double l = 1. - xi - eta;
  s->n[0] = l * (2. * l - 1.);
  s->n[1] = xi * (2. * xi - 1.);
  s->n[2] = eta * (2. * eta - 1.);
  s->n[3] = 4. * l * xi;
  s->n[4] = 4. * xi * eta;
  s->n[5] = 4. * eta * l;
  s->d[0][0] = s->d[1][0] = 1. - 4. * l;
  s->d[0][1] = 4. * xi - 1.;
  s->d[1][1] = 0.;
  s->d[0][2] = 0.;
  s->d[1][2] = 4. * eta - 1.;
  s->d[0][3] = 4. * (l - xi);
  s->d[1][3] = -4. * xi;
  s->d[0][4] = 4. * eta;
  s->d[1][4] = 4. * xi;
  s->d[0][5] = -4. * eta;
  s->d[1][5] = 4. * (l - eta);
  memcpy(s->dd[0], dd0, sizeof(dd0));
  memcpy(s->dd[1], dd1, sizeof(dd1));
  memcpy(s->dd[2], dd2, sizeof(dd2));
}

/* Node a of a quadrilateral is the product of the one-dimensional functions
 * number along_xi[a] and along_eta[a]; the order of quad9 begins with that of
 * quad4 (0, 1: ends; 2: middle). */
static void
shape_quad(abut_facet_kind kind, double xi, double eta, abut_shape *s)
{
  static const int along_xi[] = {0, 1, 0, 1, 0, 1, 2, 2, 2},
                   along_eta[] = {0, 0, 1, 1, 2, 2, 0, 1, 2};
  const abut_facet_kind line =
      kind == ABUT_FACET_QUAD4 ? ABUT_FACET_LINE2 : ABUT_FACET_LINE3;
  const int n = kind == ABUT_FACET_QUAD4 ? 4 : 9;
  abut_shape f, g;
  abut_shape2(line, xi, &f);
  abut_shape2(line, eta, &g);
  for (int a = 0; a < n; ++a)
  {
    const int i = along_xi[a], j = along_eta[a];
    s->n[a] = f.n[i] * g.n[j];
    s->d[0][a] = f.d[0][i] * g.n[j];
    s->d[1][a] = f.n[i] * g.d[0][j];
    s->dd[0][a] = f.dd[0][i] * g.n[j];
    s->dd[1][a] = f.n[i] * g.dd[0][j];
    s->dd[2][a] = f.d[0][i] * g.d[0][j];
  }
}

void
abut_shape3(abut_facet_kind kind, double xi, double eta, abut_shape *s)
{
  if (kind == ABUT_FACET_TRI3)
    shape_tri3(xi, eta, s);
  else if (kind == ABUT_FACET_TRI6)
    shape_tri6(xi, eta, s);
  else
    shape_quad(kind, xi, eta, s);
}
