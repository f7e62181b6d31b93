/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Coulomb's law: rho = min(mu max(p, 0), cap). */
#include "law/law_table.h"

#include <math.h>
#include <stdbool.h>

static abut_status
coulomb_bound(const abut_friction_bounds *points, double *bound,
              double *d_bound)
{
  for (int32_t i = 0; i < points->n; ++i)
  {
    const double mu = points->coefficient[i];
    const double rho = mu * fmax(points->pressure[i], 0);
    const bool capped = points->cap != NULL && rho > points->cap[i];
    bound[i] = capped ? points->cap[i] : rho;
    d_bound[i] = capped ? 0 : mu;
  }
  return ABUT_SUCCESS;
}

const abut_friction abut_friction_coulomb = {sizeof(abut_friction), "coulomb",
                                             coulomb_bound};
