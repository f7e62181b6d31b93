/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The table of discretisations: names, and which choices exist. */
#include "contact/discretisation.h"

#include <string.h>

static abut_status
take_nodes(abut_coupling *c, const abut_coupling_facet *facet,
           abut_coupling_functions *f, double whole)
{
  (void)whole;
  (void)abut_coupling_add_integrals(c, facet, f, c->of_node.covered.data);
  return ABUT_SUCCESS;
}

static abut_status
take_points(abut_coupling *c, const abut_coupling_facet *facet,
            abut_coupling_functions *f, double whole)
{
  (void)whole;
  return abut_coupling_add_points(c, facet, f);
}

static abut_status
take_mortar(abut_coupling *c, const abut_coupling_facet *facet,
            abut_coupling_functions *f, double whole)
{
  abut_coupling_make_psi(c, facet, whole, f);
  c->statistics.n_lumped += f->lumped;
  return abut_coupling_add_shares(c, facet, f);
}

#define NO_LINEAR "only mortar has multipliers of degree 1 on quadratic facets"
#define NO_TRI6                                                                \
  "the shape functions of tri6 have no weight at the corners: use mortar "     \
  "with "                                                                      \
  "multipliers of degree 1, or quadrature points"

#define ENTRY(name, text) [ABUT_DISCRETISATION_##name] = text,
static const char *const names[ABUT_DISCRETISATION_N] = {
    ABUT_DISCRETISATION_LIST(ENTRY)};
#undef ENTRY

static const abut_discretisation_methods table[ABUT_DISCRETISATION_N] = {
    [ABUT_DISCRETISATION_NODE_TO_SEGMENT] =
        {.info = {.help = "at each node of the secondary surface against the "
                          "nearest point of the primary; simple, but a "
                          "constant pressure is not transferred exactly",
                  .row_per_point = false,
                  .is_weighted = false,
                  .couples_rows = false,
                  .has_degree = false},
         .no_linear = NO_LINEAR,
         .no_tri6 = NO_TRI6,
         .detects_nodes = true,
         .take_facet = take_nodes,
         .finish = abut_coupling_add_nodal},
    [ABUT_DISCRETISATION_QUADRATURE_POINT] =
        {.info = {.help = "at points of a quadrature rule on each common part "
                          "of two facets, for `penalty` and `augmented "
                          "lagrangian`",
                  .row_per_point = true,
                  .is_weighted = false,
                  .couples_rows = false,
                  .has_degree = false},
         .no_linear = NO_LINEAR,
         .take_facet = take_points},
    [ABUT_DISCRETISATION_MORTAR] = {.info = {.help = "gaps in weighted mean",
                                             .row_per_point = false,
                                             .is_weighted = true,
                                             .couples_rows = true,
                                             .has_degree = true},
                                    .no_tri6 = NO_TRI6,
                                    .take_facet = take_mortar},
    [ABUT_DISCRETISATION_DUAL_MORTAR] = {
        .info = {.help = "the same with multipliers that can be eliminated "
                         "node by node",
                 .row_per_point = false,
                 .is_weighted = true,
                 .couples_rows = false,
                 .has_degree = false},
        .no_linear =
            "dual multipliers of degree 1 on quadratic facets are not "
            "biorthogonal to the shape functions: use mortar, or degree 0",
        .no_tri6 = NO_TRI6,
        .dual = true,
        .take_facet = take_mortar}};

const abut_discretisation_methods *
abut_discretisation_methods_get(abut_discretisation discretisation)
{
  const int i = (int)discretisation;
  return i >= 0 && i < ABUT_DISCRETISATION_N ? &table[i] : NULL;
}

abut_status
abut_discretisation_describe_sized(abut_discretisation discretisation,
                                   abut_discretisation_info *info)
{
  const abut_discretisation_methods *m =
      abut_discretisation_methods_get(discretisation);
  if (m == NULL || info == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_copy_out(NULL, "abut_discretisation_describe", info,
                       sizeof(m->info), &m->info);
}

const char *
abut_discretisation_name(abut_discretisation discretisation)
{
  const int i = (int)discretisation;
  return i >= 0 && i < ABUT_DISCRETISATION_N ? names[i] : "";
}

abut_status
abut_discretisation_find(const char *name, abut_discretisation *discretisation)
{
  if (name == NULL || discretisation == NULL)
    return ABUT_INVALID_ARGUMENT;
  for (int i = 0; i < ABUT_DISCRETISATION_N; ++i)
    if (strcmp(name, names[i]) == 0)
    {
      *discretisation = (abut_discretisation)i;
      return ABUT_SUCCESS;
    }
  return ABUT_INVALID_ARGUMENT;
}

abut_status
abut_coupling_check(abut_discretisation discretisation,
                    int32_t multiplier_degree, abut_facet_kind kind,
                    const char **reason)
{
  const abut_discretisation_methods *m =
      abut_discretisation_methods_get(discretisation);
  const bool quadratic = abut_facet_n_nodes(kind) > abut_facet_n_corners(kind);
  const char *fault = NULL;
  if (m == NULL || abut_facet_n_nodes(kind) == 0)
    return ABUT_INVALID_ARGUMENT;
  if (multiplier_degree < 0 || multiplier_degree > 1)
    fault = "multipliers have the degree of the facet (0) or degree 1";
  else if (multiplier_degree == 1 && quadratic)
    fault = m->no_linear;
  else if (kind == ABUT_FACET_TRI6)
    fault = m->no_tri6;
  if (reason != NULL && fault != NULL)
    *reason = fault;
  return fault == NULL ? ABUT_SUCCESS : ABUT_UNSUPPORTED;
}
