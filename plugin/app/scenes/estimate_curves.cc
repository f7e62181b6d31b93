// SPDX-License-Identifier: LGPL-2.1-or-later
#include "estimate_curves.h"

#include "app/input/short_number.h"

namespace abut::app
{
  std::vector<Curve> estimate_curves(const std::vector<ContactResult> &results,
                                     const RefinementParameters &refinement)
  {
    Curve estimate{"estimated error in energy norm", {}};
    Curve judged{"estimated relative error"
                     + std::string(refinement.target_quantity
                                           == TargetQuantity::contact_force
                                       ? " of the contact force"
                                       : ""),
                 {}};
    Curve target{"target " + short_number(refinement.target_error, 3), {}};
    for (const ContactResult &result : results)
    {
      if (result.load_step != results.front().load_step)
        continue;
      const double n = double(result.dofs);
      if (result.error_parts)
      {
        judged.points.emplace_back(n, result.error_parts->total());
        target.points.emplace_back(n, refinement.target_error);
      }
      else if (result.estimate)
        estimate.points.emplace_back(n, *result.estimate);
    }
    return {estimate, judged, target};
  }
} // namespace abut::app
