// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_EXAMINATION_H
#define ABUT_DEALII_CONTACT_EXAMINATION_H

/** @file
 * Quality of an answer: measures that its iteration does not have. */

#include <abut/dealii/coded.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace abut
{
  /** Forces |K| |u| of the entries of a tangent K, without their signs. */
  struct ForceSize
  {
    double norm = 0.;   ///< of the forces
    double energy = 0.; ///< root of |u| . |K| |u|
  };

  /** Something that was found about an answer. */
  struct ContactFinding : Message
  {
    ContactFinding() = default;

    /** The measured values, and the remedy. */
    ContactFinding(Message message, const bool is_error)
        : Message(std::move(message)), is_error(is_error)
    {
    }

    /** The answer contradicts itself, or what it was computed with, by so much
     * that it should not be used. If not, it is a warning. */
    bool is_error = false;
    /** Where the other side comes between nodes by less than a twentieth of a
     * facet, and of the obstacle: that depth, length, which is too much
     * compared with the deformation of bodies; else 0. A surface that is fine
     * enough has it, too, while it touches for the first or the last time: in a
     * row of load or time steps compare it with the largest deformation of the
     * pair's contact. */
    double between_nodes = 0.;
    std::size_t pair_number = 0; /**< from 0 */
  };

  /** The rigid part of the displacement of a body without sufficient supports,
   * in the mean square over the body. */
  struct BodyMotion
  {
    unsigned int body = 0; ///< from 0
    /** Displacement of its centre; along motions that supports stop it is 0. */
    dealii::Tensor<1, 3> translation;
    /** Axis times angle, radian; the plane's axis is the third. */
    dealii::Tensor<1, 3> rotation;
    /** "body 1 has moved by 0.01 along (1, 0)". */
    std::string text;
  };

  /** Measures of ContactChecks::examine(). The same on all ranks. */
  struct ContactExamination
  {
    /** Largest magnitude of a principal small strain at points of quadrature; 0
     * for scalar fields. */
    double strain = 0.;
    /** Mean of that magnitude over the cells of the material id where it is
     * largest. */
    double mean_strain = 0.;
    /** Largest rotation, radian: of the skew part of the displacement gradient.
     * Small strain stretches what rotates by r by (1 + r^2)^(1/2) - 1. */
    double rotation = 0.;
    /** Its mean, likewise over the cells of a material id. */
    double mean_rotation = 0.;
    /** How far bodies are deformed at the most, length: what depths are
     * compared with. */
    double deformation = 0.;
    /** Forces that nothing balances, as a part of all; 0 if not requested. */
    double imbalance = 0.;
    /** How deep obstacles are in facets, or cells of a membrane, that have no
     * contact, length. */
    double missed_depth = 0.;
    std::vector<ContactFinding> findings; /**< errors and warnings */
    /** Bodies that contact alone supports: how far they have moved. */
    std::vector<BodyMotion> motions;
    /** By pair: whether it has forces, or its sides are in each other. */
    std::vector<bool> touches;

    /** Whether there is no error among the findings. */
    bool is_usable() const
    {
      return std::none_of(findings.begin(), findings.end(),
                          [](const ContactFinding &finding)
                          { return finding.is_error; });
    }
  };
} // namespace abut

#endif
