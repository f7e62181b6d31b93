/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Names of discretisations, and which choices exist. */
#include <abut/coupling.h>
#include <string.h>

static const char *const names[ABUT_DISCRETISATION_N] = {
#define ABUT_DISCRETISATION_TEXT(name, text) text,
    ABUT_DISCRETISATION_LIST(ABUT_DISCRETISATION_TEXT)
#undef ABUT_DISCRETISATION_TEXT
};

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
  const bool quadratic = abut_facet_n_nodes(kind) > abut_facet_n_corners(kind);
  const char *fault = NULL;
  if ((int)discretisation < 0 || discretisation >= ABUT_DISCRETISATION_N
      || abut_facet_n_nodes(kind) == 0)
    return ABUT_INVALID_ARGUMENT;
  if (multiplier_degree < 0 || multiplier_degree > 1)
    fault = "multipliers have the degree of the facet (0) or degree 1";
  else if (multiplier_degree == 1
           && discretisation == ABUT_DISCRETISATION_DUAL_MORTAR && quadratic)
    fault = "dual multipliers of degree 1 on quadratic facets are not "
            "biorthogonal to the shape functions: use mortar, or degree 0";
  else if (multiplier_degree == 1
           && discretisation != ABUT_DISCRETISATION_MORTAR && quadratic)
    fault = "only mortar has multipliers of degree 1 on quadratic facets";
  else if (kind == ABUT_FACET_TRI6
           && discretisation != ABUT_DISCRETISATION_QUADRATURE_POINT
           && multiplier_degree == 0)
    fault = "the shape functions of tri6 have no weight at the corners: use "
            "mortar with multipliers of degree 1, or quadrature points";
  if (reason != NULL && fault != NULL)
    *reason = fault;
  return fault == NULL ? ABUT_SUCCESS : ABUT_UNSUPPORTED;
}
