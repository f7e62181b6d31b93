/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Shape functions of lines. */
#include "geometry/kernels.h"

void
abut_shape2(abut_facet_kind kind, double xi, abut_shape *s)
{
  if (kind == ABUT_FACET_LINE2)
  {
    s->n[0] = 0.5 * (1. - xi);
    s->n[1] = 0.5 * (1. + xi);
    s->d[0][0] = -0.5;
    s->d[0][1] = 0.5;
    s->dd[0][0] = s->dd[0][1] = 0.;
    return;
  }
  s->n[0] = 0.5 * xi * (xi - 1.);
  s->n[1] = 0.5 * xi * (xi + 1.);
  s->n[2] = (1. - xi) * (1. + xi);
  s->d[0][0] = xi - 0.5;
  s->d[0][1] = xi + 0.5;
  s->d[0][2] = -2. * xi;
  s->dd[0][0] = s->dd[0][1] = 1.;
  s->dd[0][2] = -2.;
}
