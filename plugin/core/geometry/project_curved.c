/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Projection onto the quadratic surface facets, and dispatch by kind. */
#include "geometry/kernels.h"
#include "geometry/patch.h"

void
abut_project_tri6(const double *nodes, const double *x, abut_projection *p)
{
  abut_patch patch;
  abut_patch_init(&patch, ABUT_FACET_TRI6, nodes);
  abut_patch_project(&patch, x, p);
}

void
abut_project_quad9(const double *nodes, const double *x, abut_projection *p)
{
  abut_patch patch;
  abut_patch_init(&patch, ABUT_FACET_QUAD9, nodes);
  abut_patch_project(&patch, x, p);
}

void
abut_project(abut_facet_kind kind, const double *nodes, const double *x,
             abut_projection *p)
{
  switch (kind)
  {
  case ABUT_FACET_LINE2:
    abut_project_line2(nodes, x, p);
    break;
  case ABUT_FACET_LINE3:
    abut_project_line3(nodes, x, p);
    break;
  case ABUT_FACET_TRI3:
    abut_project_tri3(nodes, x, p);
    break;
  case ABUT_FACET_TRI6:
    abut_project_tri6(nodes, x, p);
    break;
  case ABUT_FACET_QUAD4:
    abut_project_quad4(nodes, x, p);
    break;
  case ABUT_FACET_QUAD9:
  case ABUT_FACET_N_KINDS:
    abut_project_quad9(nodes, x, p);
    break;
  }
}
