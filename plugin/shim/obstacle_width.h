// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_OBSTACLE_WIDTH_H
#define ABUT_SHIM_OBSTACLE_WIDTH_H

#include "pair_points.h"

#include <abut/obstacle_facets.h>

namespace abut::shim
{
  /** Throw when a call for an obstacle failed: its message, if it is the cause.
   */
  template <int dim>
  void check(const abut_context *context, const RigidObstacle<dim> &obstacle,
             const abut_status status)
  {
    if (status == ABUT_CALLBACK_FAILED || status == ABUT_NOT_FINITE)
      throw ContactError(obstacle.failure());
    check(context, status);
  }

  /** This rank's facets of the secondary of a pair as the core wants them. */
  template <int dim> class FacetSamples
  {
  public:
    /** Nodes are displaced by @p u. */
    FacetSamples(const PairPoints<dim> &points, const SurfacePair<dim> &pair,
                 const std::vector<Direction<dim>> &u);

    abut_facet_samples view = abut_facet_samples_defaults();

  private:
    std::vector<double> position_;
    std::vector<std::uint8_t> wanted_;
  };

  /** The obstacle of a pair where it is narrowest for the facets, whose nodes
   * are displaced by @p u. Collective. */
  template <int dim>
  ObstacleWidth narrowest_width(const PairPoints<dim> &points,
                                const SurfacePair<dim> &pair,
                                const std::vector<Direction<dim>> &u);

  /** Width of the obstacle and size of the nearest facet, if the point of
   * the obstacle that is now at @p place came through that facet within the
   * present step, or was at it; infinite otherwise. Collective. */
  template <int dim>
  ObstacleWidth passed_between(const PairPoints<dim> &points, std::size_t pair,
                               const dealii::Point<dim> &place);
} // namespace abut::shim

#endif
