// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time_parameters.h"

#include "app/input/input_error.h"
#include "app/input/short_number.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/number_pattern.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Most steps of a run: more than any comes to the end of. */
    constexpr double most_steps = 1e7;

    /** Least Beta of newmark that leaves accelerations enough digits. */
    constexpr double least_beta = 1e-6;

    /** What the file gives, before it is looked at. */
    struct Given
    {
      std::string scheme;
      abut_time_options options = abut_time_defaults();
    };

    abut_time_scheme make_scheme(const Given &given)
    {
      abut_time_options options = given.options;
      options.name = given.scheme.c_str();
      abut_time_scheme scheme;
      if (abut_time_scheme_make(&options, &scheme) != ABUT_SUCCESS)
        throw InputError("Time/Scheme", "'" + given.scheme
                                            + "' does not go together with "
                                              "its numbers in section Time.");
      return scheme;
    }
  } // namespace

  Message text_of_loss(const abut_time_scheme &scheme,
                       const abut_time_balance &balance, const double begin,
                       const double end, const bool stops)
  {
    const auto percent = [](const double part)
    { return short_number(100. * part, 3) + " %"; };
    const std::string other =
        scheme.projects != 0 ? "; or Time/Scheme = hht with modified mass"
        : scheme.gamma > 0.5 ? "; or Time/Scheme = trapezoid with modified "
                               "mass, which does not damp"
                             : "";
    return coded(
        ABUT_FAILURE_ENERGY_LOSS,
        "the scheme has lost " + percent(balance.loss)
            + " of the energy that there was, beside what friction and "
              "damping have taken: "
            + percent(balance.fall / balance.scale) + " in the step from time "
            + short_number(begin, 6) + " to " + short_number(end, 6)
            + ", the largest part of one step. Make Time/Step shorter, half "
              "of it, until the loss stays the same; what then is left is "
            + (stops ? "that of impacts: what touches over an area loses its "
                       "velocity there, without restitution, on any mesh."
                     : "that of the mesh at impacts, which a finer one "
                       "lessens"
                           + other + "."));
  }

  Message text_of_lost_motion(const abut_time_scheme &scheme,
                              const abut_time_balance &before,
                              const abut_time_balance &after,
                              const double force, const double way,
                              const double begin, const double end)
  {
    // A load that is there at once loses half of its work where it is only
    // damped; and a scheme may take the contact's force at either end.
    constexpr double most = 0.6, ends = 2.;
    const double fall = before.last - after.last;
    if (scheme.impulses != 0 || before.n == 0 || fall <= most * after.scale
        || fall <= ends * force * way)
      return "";
    return coded(
        ABUT_FAILURE_ENERGY_LOSS,
        "inertia vanishes beside the stiffness: the step from time "
            + short_number(begin, 6) + " to " + short_number(end, 6) + " loses "
            + short_number(100. * fall / after.scale, 3)
            + " % of the energy without contact that could take it. The step "
              "is longer than the slowest oscillation, and the motion is "
              "damped away. Use a shorter Time/Step, a larger density or mass, "
              "or less stiffness.");
  }

  void TimeParameters::declare(dealii::ParameterHandler &prm,
                               const std::string &schemes,
                               const std::string &about_steps)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection("Time");
    prm.declare_entry(
        "Scheme", schemes.substr(0, schemes.find('|')),
        Patterns::Selection(schemes),
        "How what has mass moves. none: each load step is in equilibrium.");
    const bool has_impulses =
        schemes.find("velocity level") != std::string::npos;
    prm.declare_entry(
        "Step", "0", NumberPattern::from(0.),
        "Length of a time step; a little less where `End` is no multiple of "
        "it. "
            + about_steps);
    prm.declare_entry("End", "1", NumberPattern::positive(),
                      "Time of the end; the motion begins at 0.");
    prm.declare_entry("Alpha", "-0.1", NumberPattern::between(-1. / 3., 0.),
                      "Of hht: 0 is the trapezoid; the lower, the sooner high "
                      "frequencies die out.");
    prm.declare_entry("Rho infinity", "0.8", NumberPattern::between(0., 1.),
                      "Of generalised alpha: what a step leaves of the highest "
                      "frequencies.");
    prm.declare_entry("Beta", "0.25", NumberPattern::positive(), "Of newmark.");
    prm.declare_entry("Gamma", "0.5", NumberPattern::from(0.5), "Of newmark.");
    if (has_impulses)
      prm.declare_entry("Restitution", "0", NumberPattern::between(0., 1.),
                        "Of velocity level: part of the velocity that an "
                        "impact gives back.");
    prm.leave_subsection();
  }

  void TimeParameters::parse(dealii::ParameterHandler &prm,
                             const bool finds_step)
  {
    prm.enter_subsection("Time");
    Given given;
    given.scheme = prm.get("Scheme");
    given.options.alpha = prm.get_double("Alpha");
    given.options.rho_infinity = prm.get_double("Rho infinity");
    given.options.beta = prm.get_double("Beta");
    given.options.gamma = prm.get_double("Gamma");
    step = prm.get_double("Step");
    end = prm.get_double("End");
    is_on = given.scheme != "none";
    if (given.scheme == "velocity level")
      restitution = prm.get_double("Restitution");
    prm.leave_subsection();
    if (!is_on)
      return;
    if (given.scheme == "newmark" && given.options.beta < least_beta)
      throw InputError("Time/Beta",
                       "accelerations are differences of displacements over "
                       "Beta, and have no digits below "
                           + short_number(least_beta)
                           + "; Beta = 0 is Time/Scheme = central difference.");
    scheme = make_scheme(given);
    if (step == 0. && finds_step)
      return;
    if (step == 0.)
      throw InputError("Time/Step", "Time/Scheme = " + given.scheme
                                        + " needs the length of a time step.");
    check_step();
  }

  void TimeParameters::check_mass(const abut_time_mass mass) const
  {
    const std::string name = scheme.name;
    const bool is_modified = mass == ABUT_TIME_MASS_MODIFIED;
    if (scheme.beta == 0. && mass != ABUT_TIME_MASS_LUMPED)
      throw InputError("Time/Mass",
                       name + " is explicit and needs a lumped mass.");
    if (scheme.keeps_springs != 0 && is_modified)
      throw InputError("Time/Mass", "energy momentum keeps the energy of "
                                    "nodes with mass: consistent or lumped.");
    if (scheme.projects != 0 && is_modified)
      throw InputError("Time/Mass",
                       name
                           + " moves what would penetrate by its mass, and "
                             "needs mass where bodies meet: consistent or "
                             "lumped.");
    if (scheme.impulses != 0 && is_modified)
      throw InputError("Time/Mass",
                       "velocity level needs mass where bodies meet: lumped "
                       "or consistent.");
  }

  void TimeParameters::check_step() const
  {
    if (end / step > most_steps)
      throw InputError("Time/Step", "more than 1e7 steps to Time/End.");
    if (step > end * (1. + 1e-9))
      throw InputError("Time/Step", "one step is longer than the time to "
                                    "Time/End.");
  }

  LoadStepOptions TimeParameters::steps(const LoadStepOptions &given) const
  {
    LoadStepOptions result = given;
    result.end_time = end;
    // A multiple but for round-off is one.
    result.steps = static_cast<unsigned int>(
        std::max(1., std::ceil(end / step * (1. - 1e-9))));
    // Steps of a motion are many: what is too short is a part of one.
    result.smallest_step = given.smallest_step / result.steps;
    return result;
  }
} // namespace abut::app
