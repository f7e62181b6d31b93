// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ESTIMATE_CURVES_H
#define ABUT_APP_ESTIMATE_CURVES_H

#include "app/adapt/refinement_parameters.h"
#include "app/pictures/pictures.h"
#include "contact_result.h"

#include <vector>

namespace abut::app
{
  /** What a run itself says of its errors on the meshes of the first load
   * step, for the convergence picture: estimates in the energy norm, and with a
   * target the relative error that it was held against. Without either, empty
   * curves. */
  std::vector<Curve> estimate_curves(const std::vector<ContactResult> &results,
                                     const RefinementParameters &refinement);
} // namespace abut::app

#endif
