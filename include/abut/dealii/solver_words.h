// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_SOLVER_WORDS_H
#define ABUT_DEALII_SOLVER_WORDS_H

/** @file
 * Texts of ContactSolver. Programs that load Abut have no table of codes: texts
 * are without.
 */

#include <abut/dealii/coded.h>
#include <abut/dealii/contact_pair.h>
#include <abut/dealii/step_scales.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace abut
{
  /** A number with three digits. */
  inline std::string three_digits(const double value)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g", value);
    return text;
  }

  /** A sentence, with a blank before it, if the tangent was not positive along
   * some of the steps. */
  inline std::string negative_steps_in_words(const unsigned int n_negative,
                                             const unsigned int n_steps)
  {
    if (n_negative == 0)
      return "";
    return " The tangent K was not positive (d . K d <= 0) along "
           + std::to_string(n_negative) + " of " + std::to_string(n_steps)
           + " increments d, as for softening or snap-through: there may be no "
             "equilibrium nearby. Prescribe displacements instead of forces, "
             "or use smaller load steps.";
  }

  /** The same if bodies have left what contact takes for opposite. */
  inline std::string sliding_in_words(const std::vector<StepMotion> &pairs)
  {
    constexpr double too_far = 0.25;
    for (const StepMotion &pair : pairs)
      if (pair.stays && pair.facet > 0. && pair.slip > too_far * pair.facet)
        return " Bodies have slid on each other by "
               + three_digits(pair.slip / pair.facet)
               + " facets, but contact has the partners of the reference "
                 "configuration. Use Method/Contact geometry = current.";
    return "";
  }

  /** A step that does not lower what was left @p before it. */
  inline std::string line_search_in_words(const StepScales &scales,
                                          const StepRest &after)
  {
    const StepRest &before = scales.before;
    std::string text = "No step lowers the residual, "
                       + three_digits(before.residual) + " before and "
                       + three_digits(after.residual)
                       + " after the shortest one tried";
    if (before.defect + after.defect != 0.)
      text += ", including the error of the contact law, "
              + three_digits(scales.as_force(before.defect)) + " before and "
              + three_digits(scales.as_force(after.defect))
              + " after as a force";
    return text
           + ". Check that the tangent is the derivative of the residual, and "
             "use smaller load steps.";
  }

  /** Nodes that searches do not find. */
  template <int dim>
  Message missed_in_words(const std::vector<Penetration<dim>> &missed,
                          const unsigned int n_searches)
  {
    double depth = 0.;
    std::size_t n_same_direction = 0, n_same_side = 0;
    for (const Penetration<dim> &node : missed)
    {
      depth = std::max(depth, node.depth);
      n_same_direction += node.same_direction;
      n_same_side += node.same_side;
    }
    Message result("Nodes still penetrate without a constraint after "
                   + std::to_string(n_searches) + " searches, "
                   + std::to_string(missed.size()) + " of them by up to "
                   + three_digits(depth));
    result.failure = ABUT_FAILURE_NO_PARTNER;
    if (2 * n_same_side > missed.size())
      result.text += ": a surface that touches itself has two sides only, and "
                     "parts of the same side have met. Give parts that touch "
                     "each other their own boundary ids and pairs.";
    else if (2 * n_same_direction <= missed.size())
      result.text += ": use smaller load steps, or a larger reach of the pair.";
    else
    {
      result.failure = ABUT_FAILURE_WRONG_SIDE;
      result.text +=
          ". At " + std::to_string(n_same_direction)
          + " the outward normals of the surface and of the obstacle point in "
            "the same direction: its material is inside the body, or nodes "
            "have left it on its far side. Reverse the obstacle (Normal, sign "
            "of a distance, Axis or Hollow), or use the side of the body that "
            "faces it.";
    }
    return result;
  }
} // namespace abut

#endif
