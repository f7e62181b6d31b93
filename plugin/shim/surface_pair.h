// SPDX-License-Identifier: LGPL-2.1-or-later
// A pair of surfaces, or a surface against an obstacle, and data of its points
// in addition to the set that they are in.
#ifndef ABUT_SHIM_SURFACE_PAIR_H
#define ABUT_SHIM_SURFACE_PAIR_H

#include "bodies_overlap.h"
#include "handles.h"
#include "surface_side.h"

#include <abut/contact_motion.h>
#include <abut/dealii/contact_examination.h>
#include <abut/dealii/contact_pair.h>
#include <abut/dealii/method_parameters.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace abut::shim
{
  /** An obstacle beside a facet near it. */
  struct ObstacleWidth
  {
    /** See RigidObstacle::width(); infinite where there is none. */
    double width = INFINITY;
    double facet = 1.; ///< size, length

    /** Whether a facet is wider, so that nodes on both sides may miss it. */
    bool is_below_facets() const
    {
      return width < facet;
    }

    /** Its width, the facet's size and the remedy. */
    std::string text() const;
  };

  /** PairPoints::dropped() of a node that supports hold. */
  constexpr std::uint8_t of_supports = 2;

  /** A pair with its two sides. */
  template <int dim> struct SurfacePair
  {
    ContactPair<dim> data;
    /** On its secondary, of any rank. */
    bool has_quadratic_triangles = false;
    /** For discretisations that have one; 0: that of the facets. */
    unsigned int multiplier_degree = 0;
    abut_kinematics kinematics = ABUT_KINEMATICS_REFERENCE;
    /** Configurations that it makes points in, and that its directions and
     * gaps refer to. */
    abut_configuration points = ABUT_CONFIGURATION_REFERENCE;
    abut_configuration directions = ABUT_CONFIGURATION_REFERENCE;

    void set_kinematics(const abut_kinematics chosen)
    {
      const abut_kinematics_info &info = kinematics_info(chosen);
      kinematics = chosen;
      points = info.points;
      directions = info.directions;
    }

    bool has_current_points() const
    {
      return points == ABUT_CONFIGURATION_CURRENT;
    }

    bool has_committed_points() const
    {
      return points == ABUT_CONFIGURATION_COMMITTED;
    }

    /** Whether its sides are somewhere else when points are made. */
    bool has_displaced_sides() const
    {
      return points != ABUT_CONFIGURATION_REFERENCE;
    }

    bool has_current_directions() const
    {
      return directions == ABUT_CONFIGURATION_CURRENT;
    }

    /** Whether directions and gaps are not those of the reference
     * configuration. */
    bool is_displaced() const
    {
      return directions != ABUT_CONFIGURATION_REFERENCE;
    }

    /** Whether gaps are weighted means around its nodes. */
    bool has_mean_gaps() const
    {
      return discretisation_info(discretisation).is_weighted;
    }

    double facet_size() const
    {
      return std::max(secondary.everywhere.median, primary.everywhere.median);
    }

    abut_discretisation discretisation = ABUT_DISCRETISATION_DUAL_MORTAR;

    /** Whether there are rows at the corners of facets of degree 2 alone. */
    bool has_linear_multipliers() const
    {
      return discretisation_info(discretisation).has_degree
             && multiplier_degree == 1;
    }
    SurfaceSide<dim> secondary, primary;
    Handle<abut_interface> interface;
    /** Thickness of the body that a point must not be pushed through, the
     * primary's or, at an obstacle, its own; and that of the secondary's body;
     * length, 0: not known. */
    double thickness = 0., own_thickness = 0.;
    /** Distances that the facets known here suffice for. */
    double reach = 0., margin = 0.;
    /** Parts of this rank, by the last examine() and penetrations(). */
    PairResult<dim> measured;
    /** How deep nodes of the secondary that have rows are in the other side,
     * length >= 0, by the last penetrations(): rows of mortar hold them in the
     * mean of the facets around them alone. */
    double held_in_the_mean = 0.;
    /** The deepest node in the other body, or in an obstacle that bodies fly
     * towards, before anything is displaced. */
    NodeInside<dim> first_inside;
    /** Extent of the thinner body; 0: was not needed. */
    double least_extent = 0.;
    /** Known failures that it was made with all the same. */
    std::vector<Message> refused;
    dealii::Point<dim> gap_error_place; ///< of PairResult::gap_error
    /** Change of the directions of its forces since points were made. */
    abut_direction_change rotation = {};
    ObstacleWidth narrowest; ///< for the facets, by the last examine()
  };

  /** Input of the points of a pair that may change from one find() to the next;
   * positions, supports and settings do not. */
  struct PointsOrigin
  {
    double reach, gap; ///< reach 0: a part of each facet's size

    bool operator==(const PointsOrigin &other) const
    {
      return reach == other.reach && gap == other.gap;
    }
  };

  /** Where a point belongs, see abut/places.h. */
  template <int dim> struct PointPlace
  {
    std::size_t pair;
    std::int32_t node;           ///< -1: quadrature point
    std::int32_t facet;          ///< of a quadrature point
    dealii::Point<dim> position; ///< where the point sits
  };

  /** The opposite points of a tangent's point of mortar that moves, at the last
   * commit(). */
  struct CommittedPartners
  {
    std::vector<std::pair<std::int32_t, double>> stencil;
    double offset = 0.; ///< sum of c x along the direction of the row then
  };

  /** Directions of a tie that the same nodes are dropped for. */
  struct TiedAxes
  {
    std::uint32_t axes = 0; ///< bits
    std::vector<std::uint8_t> dropped;
  };
} // namespace abut::shim

#endif
