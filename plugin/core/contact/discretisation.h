/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONTACT_DISCRETISATION_H
#define ABUT_CONTACT_DISCRETISATION_H

/* A discretisation as a table: its public properties, and its functions. A new
 * one is an entry of ABUT_DISCRETISATION_LIST, an entry here, and its functions
 * in a file of its own. */

#include "contact/coupling.h"

struct abut_discretisation_methods
{
  abut_discretisation_info info;
  /* Why there are no weighting functions of degree 1 on quadratic facets, and
   * none of the facets' own degree on tri6; NULL: there are. */
  const char *no_linear;
  const char *no_tri6;
  /* Weighting functions that are biorthogonal to the shape functions. */
  bool dual;
  /* Pairs are found by the detection, node by node, instead of by the search
   * for facets; against an obstacle, its distance is evaluated at the nodes. */
  bool detects_nodes;
  /* Take the share of a facet, whose points on the covered part are in
   * c->points; `whole` is the area of the facet. */
  abut_status (*take_facet)(abut_coupling *c, const abut_coupling_facet *facet,
                            abut_coupling_functions *f, double whole);
  /* After all facets; NULL: nothing. */
  abut_status (*finish)(abut_coupling *c);
};

/* Entry of a discretisation; NULL if there is no such one. */
const abut_discretisation_methods *
abut_discretisation_methods_get(abut_discretisation discretisation);

/* Add the integrals of the weighting functions over the current points to sum
 * [n_nodes]; returns their area. */
double abut_coupling_add_integrals(abut_coupling *c,
                                   const abut_coupling_facet *facet,
                                   const abut_coupling_functions *f,
                                   double *sum);

#endif
