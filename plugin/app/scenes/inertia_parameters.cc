// SPDX-License-Identifier: LGPL-2.1-or-later
#include "inertia_parameters.h"

#include "app/input/input_error.h"

#include <abut/dealii/number_pattern.h>

namespace abut::app
{
  namespace Patterns = dealii::Patterns;

  void InertiaParameters::declare(dealii::ParameterHandler &prm,
                                  const std::string &schemes,
                                  const std::string &failing_steps)
  {
    TimeParameters::declare(prm, schemes, failing_steps);
    prm.enter_subsection("Time");
    prm.declare_entry("Mass", "auto",
                      Patterns::Selection("auto|modified|consistent|lumped"),
                      "Where mass sits: modified takes it from the nodes of "
                      "secondary surfaces, or of contact on a membrane's "
                      "boundary, and hands it to their neighbours inside, so "
                      "that impacts neither gain energy "
                      "nor ring; consistent is that of the elements, lumped "
                      "its row sums at the nodes. auto: what the scheme is "
                      "made for, which is modified, but consistent for contact "
                      "stabilised and lumped for explicit schemes.");
    prm.declare_entry("Mass damping", "0", NumberPattern::from(0.),
                      "Rayleigh damping: forces of this number (per time) "
                      "times mass times velocity.");
    prm.declare_entry("Stiffness damping", "0", NumberPattern::from(0.),
                      "Rayleigh damping: forces of this time times stiffness "
                      "times velocity.");
    prm.leave_subsection();
  }

  void InertiaParameters::parse(dealii::ParameterHandler &prm)
  {
    TimeParameters::parse(prm);
    prm.enter_subsection("Time");
    const std::string word = prm.get("Mass");
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
      throw InputError("Time/Stiffness damping",
                       "nodes without mass have no velocity of their own that "
                       "could be damped: set Time/Mass = consistent or "
                       "lumped.");
    if (stiffness_damping > 0. && scheme.beta == 0.)
      throw InputError("Time/Stiffness damping",
                       std::string(scheme.name)
                           + " would need shorter steps for it: use Time/Mass "
                             "damping, or hht.");
  }

  void InertiaParameters::fit(RefinementParameters &refinement) const
  {
    const std::string why = "the mesh of a motion stays as it is; set "
                            "Time/Scheme = none, or no ";
    if (refinement.adaptive_cycles > 0)
      throw InputError("Refinement/Adaptive cycles", why + "cycles.");
    if (refinement.has_target())
      throw InputError("Refinement/Target error", why + "target.");
    refinement.nested = false;
  }
} // namespace abut::app
