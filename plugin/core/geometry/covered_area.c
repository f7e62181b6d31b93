/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The public face of the common area of two facets. */
#include "geometry/clip.h"

#include <math.h>

static int
all_finite(abut_facet_kind kind, const double *nodes)
{
  const int32_t n = abut_facet_n_nodes(kind) * abut_facet_dimension(kind);
  int ok = 1;
  for (int32_t i = 0; i < n; ++i)
    ok &= fabs(nodes[i]) <= ABUT_FACET_LIMIT;
  return ok;
}

abut_status
abut_facet_covered_area(abut_facet_kind secondary_kind, const double *secondary,
                        abut_facet_kind primary_kind, const double *primary,
                        double *area)
{
  const int32_t dimension = abut_facet_dimension(secondary_kind);
  if (secondary == NULL || primary == NULL || area == NULL || dimension == 0
      || dimension != abut_facet_dimension(primary_kind))
    return ABUT_INVALID_ARGUMENT;
  if (!all_finite(secondary_kind, secondary)
      || !all_finite(primary_kind, primary))
    return ABUT_NOT_FINITE;
  *area =
      abut_facet_common_area(secondary_kind, secondary, primary_kind, primary);
  return ABUT_SUCCESS;
}
