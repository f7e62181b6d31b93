// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_STEP_SCALES_H
#define ABUT_DEALII_STEP_SCALES_H

/** @file
 * Measures of a Newton step, see ContactSolver.
 */

#include <algorithm>
#include <cmath>

namespace abut
{
  /** Forces out of balance (norm), and how far the law of contact is off (root
   * of an energy). */
  struct StepRest
  {
    double residual = 0.; ///< force
    double defect = 0.;   ///< root of an energy
  };

  /** Scales that a step is compared with. */
  struct StepScales
  {
    StepRest before;         ///< in the linear model
    double length = 0.;      ///< of the step, in the energy norm
    double energy = 0.;      ///< energy norm of the displacement
    double force = 0.;       ///< largest of the forces, norm
    bool is_positive = true; ///< whether energies are a measure
    /** No solver lowers these: round-off of the products of the entries of the
     * tangent with the displacement. */
    StepRest round_off;
    /** Whether prescribed values change, with the squares and the product of
     * forces out of balance and of what the change makes of them. */
    bool has_change = false;
    double squares[3] = {0., 0., 0.}; ///< force squared

    /** A defect as a force, so that both can be added. */
    double as_force(const double defect) const
    {
      return defect > 0. && energy > 0. ? defect / energy * force : 0.;
    }

    /** Forces and defect as a force. */
    double sum(const StepRest &rest) const
    {
      return rest.residual + as_force(rest.defect);
    }

    /** Whether forces and the law are satisfied but for round-off. */
    bool is_round_off(const StepRest &rest) const
    {
      return rest.residual <= round_off.residual
             && rest.defect <= round_off.defect;
    }

    /** Whether the step is so short that its residual is but round-off. */
    bool is_at_end(const StepRest &rest, const double tolerance) const
    {
      if (is_round_off(rest))
        return true;
      return is_positive ? length <= tolerance * energy
                         : rest.residual <= tolerance * force;
    }

    /** Forces and defect that this part of a step has to lower: with this part
     * of the change of prescribed values, or without it. */
    StepRest to_lower(const double part) const
    {
      if (!has_change)
        return before;
      const double *s = squares;
      return {std::sqrt(std::max(
                  {0., s[0], s[0] + part * (2. * s[1] + part * s[2])})),
              before.defect};
    }
  };
} // namespace abut

#endif
