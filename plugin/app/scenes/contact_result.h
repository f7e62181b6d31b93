// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CONTACT_RESULT_H
#define ABUT_APP_CONTACT_RESULT_H

#include "app/adapt/error_target.h"
#include "app/physics/error_norms.h"

#include <abut/dealii/detection_report.h>
#include <abut/dealii/solver_parameters.h>
#include <abut/strategy.h>

#include <deal.II/base/types.h>

#include <map>
#include <optional>
#include <string>

namespace abut::app
{
  /** Results of one mesh, or of one load step on the last mesh. */
  struct ContactResult
  {
    unsigned int load_step = 0;
    double time = 0.;
    unsigned int level = 0; ///< number of the mesh
    unsigned int steps = 0; ///< linear systems
    unsigned int linearisations = 0;
    LinearReport linear;
    abut_progress progress = {};
    dealii::types::global_dof_index cells = 0, dofs = 0, rows = 0, active = 0;
    double energy = 0., force = 0., penetration = 0.;
    /** With friction: taken up since the last load step, energy; and the sum of
     * the tractions along the surfaces, force. */
    double dissipation = 0., friction_force = 0.;
    /** With friction, by pair: PairResult::late_force, and the part of the
     * normal force that points which stick have by their number. */
    std::vector<double> late_force, stick_force;
    /** What detection took since the result before, and the contact elements
     * that have changed since the last load step. */
    DetectionReport detection;
    std::optional<ErrorNorms> errors;
    std::optional<double> estimate;
    std::optional<ErrorParts> error_parts; ///< with a target only
    double seconds = 0.; ///< since the end of the one before, counted parts
  };

  /** The columns of `levels.csv` that all models have. */
  std::map<std::string, double> result_row(const ContactResult &result);
} // namespace abut::app

#endif
