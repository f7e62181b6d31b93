// SPDX-License-Identifier: LGPL-2.1-or-later
#include "load_step_parameters.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

namespace abut::app
{
  namespace
  {
    /** More than any run comes to the end of. */
    constexpr int most_load_steps = 1000000;
  } // namespace

  void declare_end_time(dealii::ParameterHandler &prm)
  {
    parameter::declare(prm, "End time", "1", NumberPattern::positive(),
                       parameter::basic("time", "2"),
                       "Time t at the end of the last step. Loads, prescribed "
                       "displacements and motions are formulas in t.");
  }

  void LoadStepParameters::declare(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection("Time stepping");
    parameter::declare(
        prm, "Number of steps", "1", Patterns::Integer(1, most_load_steps),
        parameter::basic("1", "10"),
        "Number of equal load steps from t = 0 to `End time`, for `Scheme = "
        "quasi-static`. With 1 step all loads are applied at once.");
    declare_end_time(prm);
    parameter::declare(prm, "Cut back", "true", Patterns::Bool(),
                       parameter::advanced(),
                       "Whether a step without a solution is halved and "
                       "repeated. Later steps grow to the full length again.");
    parameter::declare(
        prm, "Smallest step", "1e-3",
        NumberPattern({nullptr, 0., 1., true, false}),
        parameter::expert("1", "1e-4"),
        "Length of a step below which a failure ends the run, relative to `End "
        "time`; in dynamics relative to `Step size`.");
    parameter::declare(
        prm, "Maximum Newton iterations", "20", Patterns::Integer(1),
        parameter::advanced("1", "30"),
        "Finite strain: Newton iterations after which a step has failed. After "
        "a step with more than half of them the next step is half as long.");
    parameter::declare(
        prm, "Newton tolerance", "1e-8",
        NumberPattern({nullptr, 1e-14, 1., false, true}),
        parameter::advanced("1", "1e-10"),
        "Finite strain: error of Newton's method relative to the displacement, "
        "in the energy norm. In dynamics a hundredth of it, or round-off.");
    prm.leave_subsection();
  }

  void LoadStepParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Time stepping");
    steps = prm.get_integer("Number of steps");
    end_time = prm.get_double("End time");
    cut_back = prm.get_bool("Cut back");
    smallest_step = prm.get_double("Smallest step");
    newton_steps = prm.get_integer("Maximum Newton iterations");
    newton_tolerance = prm.get_double("Newton tolerance");
    prm.leave_subsection();
  }
} // namespace abut::app
