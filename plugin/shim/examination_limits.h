// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_EXAMINATION_LIMITS_H
#define ABUT_SHIM_EXAMINATION_LIMITS_H

/** @file
 * Limits that the measures of an answer are compared with.
 */

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  /** Part of a whole by which an answer may contradict itself. */
  inline constexpr double useless = 0.1;

  /** Distance of facets from their curve, relative to the largest motion,
   * that leaves a pressure without accuracy. */
  inline constexpr double useless_chord = 1.;

  /** Strains at which the error of small-strain theory is visible, and at
   * which it is of no use. A body that is a third of its size shorter has
   * such a mean. */
  inline constexpr double visible_strain = 0.05, useless_strain = 0.5,
                          useless_mean_strain = 1. / 3.;

  /** Differences of a displacement from its constraints, by the largest
   * displacement: what iterative solvers leave is less. */
  inline constexpr double visible_violation = 1e-3, useless_violation = 0.1;

  /** Error of small-strain theory for a rotation by an angle, radian: the
   * stretch of u = angle x X. It is judged as a strain. */
  inline double rotation_stretch(const double angle)
  {
    return std::hypot(1., angle) - 1.;
  }

  /** The angle with that stretch, radian. */
  inline double rotation_with(const double stretch)
  {
    return std::sqrt(stretch * (2. + stretch));
  }

  /** Forces out of balance that are worth a word. */
  inline constexpr double visible_imbalance = 1e-2;

  /** Error of gaps that is worth a word, by what bodies are deformed. */
  inline constexpr double visible_gap_error = 0.05;

  /** Turn of directions, radian, and so the part of a force that is beside
   * the normal, that is worth a word; and part of the resultant that may go
   * to the side without one, whatever else is there. */
  inline constexpr double visible_rotation = 0.05, visible_side_force = 0.02;

  /** Part of the normal force at points that slip and have closed within a
   * load step: the resultant of friction then changes by some 5 % with the
   * number of steps. */
  inline constexpr double visible_late_share = 0.2;

  /** Part of a pressure that alternates from node to node. */
  inline constexpr double visible_oscillation = 0.1;

  /** Bodies in obstacles where no surface meets them, likewise. */
  inline constexpr double visible_inside = 0.01;

  /** Depth of an obstacle in a facet without contact, in sizes of the facet
   * or of the obstacle, that is no matter of its curvature. */
  inline constexpr double missed_part = 0.05;

  /** Depths of this part of a facet are round-off of coordinates. */
  inline constexpr double round_off_of_places = 1e-9;

  /** Scales of depths on a pair: deformation of the bodies. */
  struct DepthScale
  {
    double way = 0.;   ///< deformation of the bodies
    double far = 0.;   ///< largest displacement
    double least = 0.; ///< that is no round-off of places

    /** Far from its place, a body's gaps have the round-off of its way. */
    double limit(const double part) const
    {
      constexpr double round_off = 1e-9;
      return std::max({part * way, round_off * far, least});
    }

    bool is_more(const double depth, const double part) const
    {
      return depth > limit(part);
    }
  };
} // namespace abut::shim

#endif
