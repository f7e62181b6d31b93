// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PARTNER_CHANGES_H
#define ABUT_SHIM_PARTNER_CHANGES_H

#include "pair_points.h"

#include <abut/dealii/detection_report.h>
#include <abut/points.h>

#include <cstdint>
#include <set>
#include <vector>

namespace abut::shim
{
  /** Changes up to @p now of the points @p before whose first component is one
   * of @p pressing, by its number. */
  template <int dim>
  PartnerChanges count_changes(const PairPoints<dim> &before,
                               const PairPoints<dim> &now,
                               const std::set<std::int64_t> &pressing);
} // namespace abut::shim

#endif
