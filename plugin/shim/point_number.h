// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_POINT_NUMBER_H
#define ABUT_SHIM_POINT_NUMBER_H

#include <array>
#include <cstdint>

namespace abut::shim
{
  /** Numbers of contact points over all ranks, below 2^53 as the core wants
   * them. They follow from numbers along the mesh alone and so last as long as
   * it does: no pair is in them, so that a node that changes pairs is the same
   * point.
   *
   * Points at nodes come first. Points of quadrature have the upper half, where
   * each facet has a range of numbers. */
  struct PointNumber
  {
    /** More than the points of quadrature on any facet. */
    static constexpr std::int64_t points_per_facet = 1 << 24;
    static constexpr std::int64_t first_of_facets = std::int64_t(1) << 52;

    /** The part of the number that is the same for all points of a facet; for a
     * node the number itself. */
    static std::int64_t group(const std::int64_t number)
    {
      return number < first_of_facets ? number
                                      : number - number % points_per_facet;
    }
  };

  /** A row at a point whose number does not last while the mesh does, and where
   * it is in the reference configuration. */
  struct PlacedRow
  {
    std::int32_t row;
    std::array<double, 3> place;
  };
} // namespace abut::shim

#endif
