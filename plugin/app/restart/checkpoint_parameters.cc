// SPDX-License-Identifier: LGPL-2.1-or-later
#include "checkpoint_parameters.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

namespace abut::app
{
  void CheckpointParameters::declare(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection("Checkpoint");
    parameter::declare(prm, "Every minutes", "10",
                       OrWord(NumberPattern::from(0.), "never"),
                       parameter::advanced("minutes", "30"),
                       "Time between checkpoints, from which `abut run SCENE "
                       "--resume` goes on. Written at the end of the next mesh "
                       "or load step. Results do not depend on it.");
    parameter::declare(prm, "Every steps", "never",
                       OrWord(Patterns::Integer(1), "never"),
                       parameter::advanced("1", "20"),
                       "Number of meshes and load steps between checkpoints.");
    prm.leave_subsection();
  }

  void CheckpointParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Checkpoint");
    every_steps = static_cast<unsigned int>(
        parameter::number_or_zero(prm, "Every steps"));
    every_minutes = parameter::number_or_zero(prm, "Every minutes");
    prm.leave_subsection();
  }
} // namespace abut::app
