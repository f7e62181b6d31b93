// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PARTNER_CHANGES_H
#define ABUT_SHIM_PARTNER_CHANGES_H

#include "surface_pair.h"

#include <abut/dealii/detection_report.h>
#include <abut/points.h>

#include <cstdint>
#include <set>
#include <vector>

namespace abut::shim
{
  /** Points, and where each of them sits. */
  template <int dim> struct PlacedPoints
  {
    abut_points_view view;
    const std::vector<PointPlace<dim>> &places;
  };

  /** Changes up to @p now of the points @p before whose first component is one
   * of @p pressing, by its number. */
  template <int dim>
  PartnerChanges count_changes(const PlacedPoints<dim> &before,
                               const PlacedPoints<dim> &now,
                               const std::set<std::int64_t> &pressing);
} // namespace abut::shim

#endif
