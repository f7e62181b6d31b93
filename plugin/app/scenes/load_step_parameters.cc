// SPDX-License-Identifier: LGPL-2.1-or-later
#include "load_step_parameters.h"

#include <abut/dealii/number_pattern.h>

namespace abut::app
{
  namespace
  {
    /** More than any run comes to the end of. */
    constexpr int most_load_steps = 1000000;
  } // namespace

  void LoadStepParameters::declare(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection("Load steps");
    prm.declare_entry("Steps", "1", Patterns::Integer(1, most_load_steps),
                      "Number of equal steps from time 0 to the end. The time "
                      "is the t of all formulas; in one step all loads are "
                      "applied at once.");
    prm.declare_entry("End time", "1", NumberPattern::positive(),
                      "Time of the last step.");
    prm.declare_entry("Cut back", "true", Patterns::Bool(),
                      "Halve a step that finds no answer, and try again; "
                      "later steps grow to their length again.");
    prm.declare_entry("Smallest step", "1e-3",
                      NumberPattern({nullptr, 0., 1., true, false}),
                      "Length of a step, as part of the whole time, below "
                      "which a failure ends the run; of a motion as part of "
                      "Time/Step.");
    prm.declare_entry("Newton steps", "20", Patterns::Integer(1),
                      "Of large strain: linearisations after which a step has "
                      "found no answer. After one that needed more than half "
                      "of them the next is half as long.");
    prm.declare_entry("Newton tolerance", "1e-8",
                      NumberPattern({nullptr, 1e-14, 1., false, true}),
                      "Of large strain: error of the iteration relative to the "
                      "displacement, in the energy norm; of motions a "
                      "hundredth of that, or what round-off leaves.");
    prm.leave_subsection();
  }

  void LoadStepParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Load steps");
    steps = prm.get_integer("Steps");
    end_time = prm.get_double("End time");
    cut_back = prm.get_bool("Cut back");
    smallest_step = prm.get_double("Smallest step");
    newton_steps = prm.get_integer("Newton steps");
    newton_tolerance = prm.get_double("Newton tolerance");
    prm.leave_subsection();
  }
} // namespace abut::app
