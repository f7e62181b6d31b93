// SPDX-License-Identifier: LGPL-2.1-or-later
#include "inertia_parameters.h"

#include "app/input/input_error.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

namespace abut::app
{
  namespace Patterns = dealii::Patterns;

  void InertiaParameters::declare(dealii::ParameterHandler &prm,
                                  const std::string &schemes,
                                  const std::string &failing_steps)
  {
    TimeParameters::declare(prm, schemes, failing_steps);
    prm.enter_subsection("Time stepping");
    parameter::declare(
        prm, "Mass matrix", "auto",
        Patterns::Selection("auto|modified|consistent|lumped"),
        parameter::advanced(),
        "Mass matrix. consistent: of the elements. lumped: row sums at the "
        "nodes. modified: nodes of secondary surfaces (membrane: of "
        "`Contact/Boundary ids`) have no mass, their inner neighbours have it; "
        "impacts then neither gain energy nor oscillate. auto: lumped for "
        "explicit schemes, consistent for contact stabilised, else modified.");
    parameter::declare(prm, "Mass damping", "0", NumberPattern::from(0.),
                       parameter::advanced("1/time", "0.1"),
                       "Rayleigh damping: factor of mass times velocity.");
    parameter::declare(prm, "Stiffness damping", "0", NumberPattern::from(0.),
                       parameter::advanced("time", "1e-4"),
                       "Rayleigh damping: factor of stiffness times velocity.");
    prm.leave_subsection();
  }

  void InertiaParameters::parse(dealii::ParameterHandler &prm)
  {
    TimeParameters::parse(prm);
    prm.enter_subsection("Time stepping");
    const std::string word = prm.get("Mass matrix");
    mass_damping = prm.get_double("Mass damping");
    stiffness_damping = prm.get_double("Stiffness damping");
    prm.leave_subsection();
    mass = word == "modified"     ? ABUT_TIME_MASS_MODIFIED
           : word == "consistent" ? ABUT_TIME_MASS_CONSISTENT
           : word == "lumped"     ? ABUT_TIME_MASS_LUMPED
                                  : static_cast<abut_time_mass>(scheme.mass);
    if (is_on)
      check();
  }

  void InertiaParameters::check() const
  {
    check_mass(mass);
    if (stiffness_damping > 0. && mass == ABUT_TIME_MASS_MODIFIED)
      throw InputError("Time stepping/Stiffness damping",
                       "nodes without mass have no velocity to damp: set Time "
                       "stepping/Mass matrix = consistent or lumped.");
    if (stiffness_damping > 0. && scheme.beta == 0.)
      throw InputError("Time stepping/Stiffness damping",
                       std::string(scheme.name)
                           + " would need smaller steps with it: use Time "
                             "stepping/Mass damping, or Scheme = hht.");
  }

  void InertiaParameters::fit(RefinementParameters &refinement) const
  {
    const std::string why = "the mesh does not change in dynamics; set Time "
                            "stepping/Scheme = quasi-static, or no ";
    if (refinement.adaptive_cycles > 0)
      throw InputError("Refinement/Adaptive cycles", why + "cycles.");
    if (refinement.has_target())
      throw InputError("Refinement/Target error", why + "target.");
    refinement.nested = false;
  }
} // namespace abut::app
