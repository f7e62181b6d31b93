// SPDX-License-Identifier: LGPL-2.1-or-later
#include "checkpoint_parameters.h"

#include <abut/dealii/number_pattern.h>

namespace abut::app
{
  void CheckpointParameters::declare(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection("Checkpoint");
    prm.declare_entry("Every minutes", "10", NumberPattern::from(0.),
                      "Write a checkpoint, from which `abut run SCENE "
                      "--resume` goes on, at the end of the first mesh or load "
                      "step after so many minutes; 0: not by time. Results do "
                      "not depend on it.");
    prm.declare_entry("Every steps", "0", Patterns::Integer(0),
                      "Write one after every so many meshes and load steps; "
                      "0: not by their number.");
    prm.leave_subsection();
  }

  void CheckpointParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Checkpoint");
    every_steps = static_cast<unsigned int>(prm.get_integer("Every steps"));
    every_minutes = prm.get_double("Every minutes");
    prm.leave_subsection();
  }
} // namespace abut::app
