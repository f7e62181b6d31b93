// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time_parameters.h"

#include "load_step_parameters.h"

#include "app/input/input_error.h"
#include "app/input/short_number.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

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
        throw InputError("Time stepping/Scheme",
                         "'" + given.scheme
                             + "' does not agree with its parameters in "
                               "section Time stepping.");
      return scheme;
    }

    /** The rest of the text about lost energy: what it comes from. */
    std::string cause_of_loss(const abut_time_scheme &scheme,
                              const Touching what)
    {
      const std::string halve =
          "Halve Time stepping/Step size until the loss is constant; the rest "
          "is the loss ";
      if (what == Touching::areas)
        return halve
               + "of impacts: areas in contact lose their velocity, without "
                 "restitution, on any mesh.";
      if (what == Touching::nodes)
        return halve + "of the mesh at impacts, smaller on a finer one"
               + (scheme.projects != 0
                      ? "; or Time stepping/Scheme = hht with modified mass."
                  : scheme.gamma > 0.5
                      ? "; or Time stepping/Scheme = trapezoid with modified "
                        "mass, which does not damp."
                      : ".");
      const std::string choose = "For a given restitution use Time "
                                 "stepping/Scheme = velocity level with Time "
                                 "stepping/Restitution.";
      if (scheme.projects != 0)
        return "Masses in contact lose their velocity: impacts have "
               "restitution 0, with any Time stepping/Step size. "
               + choose;
      if (scheme.beta > 0. && scheme.keeps_springs == 0)
        return "The velocity of a mass after an impact depends on where in a "
               "step it touches, so the loss has no limit for small steps. "
               + choose;
      return "Use a smaller Time stepping/Step size. " + choose;
    }
  } // namespace

  Message text_of_loss(const abut_time_scheme &scheme,
                       const abut_time_balance &balance, const double begin,
                       const double end, const Touching what)
  {
    return coded(
        ABUT_FAILURE_ENERGY_LOSS,
        "the scheme has lost " + percent(balance.loss)
            + " of the energy of the start and the loads, in addition to "
              "friction and damping: "
            + percent(balance.fall / balance.scale) + " in the step from time "
            + short_number(begin, 6) + " to " + short_number(end, 6)
            + ", the largest part of one step. " + cause_of_loss(scheme, what),
        {{"lost part of the energy", balance.loss}});
  }

  bool loses_motion(const abut_time_scheme &scheme,
                    const abut_time_balance &before,
                    const abut_time_balance &after, const double force,
                    const double way)
  {
    // A load that is there at once loses half of its work where it is only
    // damped; and a scheme may take the contact's force at either end.
    constexpr double most = 0.6, ends = 2.;
    const double fall = before.last - after.last;
    return scheme.impulses == 0 && before.n > 0 && fall > most * after.scale
           && fall > ends * force * way;
  }

  Message text_of_lost_motion(const abut_time_balance &before,
                              const abut_time_balance &after,
                              const double force, const double period,
                              const double begin, const double end)
  {
    const double part = (before.last - after.last) / after.scale;
    const bool is_long = end - begin > period;
    if (force > 0. && !is_long)
      return "";
    return coded(
        ABUT_FAILURE_ENERGY_LOSS,
        "inertia is negligible relative to the stiffness: the step from time "
            + short_number(begin, 6) + " to " + short_number(end, 6) + " loses "
            + short_number(100. * part, 3) + " % of the energy"
            + (force > 0. ? ". " : " without contact as a cause. ")
            + (is_long ? "The step is longer than the slowest oscillation. "
                       : "")
            + "Use a smaller Time stepping/Step size, a larger density or "
              "mass, or less stiffness.",
        {{"lost part of the energy", part}});
  }

  void TimeParameters::declare(dealii::ParameterHandler &prm,
                               const std::string &schemes,
                               const std::string &about_steps)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection("Time stepping");
    parameter::declare(prm, "Scheme", schemes.substr(0, schemes.find('|')),
                       Patterns::Selection(schemes), parameter::basic(),
                       "Time integration scheme. quasi-static: load steps in "
                       "equilibrium, without inertia.");
    const bool has_impulses =
        schemes.find("velocity level") != std::string::npos;
    parameter::declare(prm, "Step size", "auto",
                       OrWord(NumberPattern::from(0.), "auto"),
                       parameter::basic("time", "0.01"),
                       "Length of a time step, required in dynamics. Slightly "
                       "less where `End time` is not a multiple of it. "
                           + about_steps);
    declare_end_time(prm);
    parameter::declare(prm, "HHT alpha", "-0.1",
                       NumberPattern::between(-1. / 3., 0.),
                       parameter::advanced("1", "-0.05"),
                       "Parameter alpha of hht. 0 is the trapezoidal rule; "
                       "lower values damp high frequencies more.");
    parameter::declare(prm, "Generalised alpha spectral radius", "0.8",
                       NumberPattern::between(0., 1.),
                       parameter::advanced("1", "0.9"),
                       "Parameter rho_infinity of generalised alpha: part of "
                       "the highest frequencies that a step leaves.");
    parameter::declare(prm, "Newmark beta", "0.25", NumberPattern::positive(),
                       parameter::advanced("1", "0.3025"),
                       "Parameter beta of newmark.");
    parameter::declare(
        prm, "Newmark gamma", "0.5", NumberPattern::from(0.5),
        parameter::advanced("1", "0.6"),
        "Parameter gamma of newmark; above 0.5 high frequencies are damped.");
    if (has_impulses)
      parameter::declare(
          prm, "Restitution", "0", NumberPattern::between(0., 1.),
          parameter::basic("1", "0.8"),
          "Coefficient of restitution of velocity level: velocity after an "
          "impact divided by the velocity before.");
    prm.leave_subsection();
  }

  void TimeParameters::parse(dealii::ParameterHandler &prm,
                             const bool finds_step)
  {
    prm.enter_subsection("Time stepping");
    Given given;
    given.scheme = prm.get("Scheme");
    given.options.alpha = prm.get_double("HHT alpha");
    given.options.rho_infinity =
        prm.get_double("Generalised alpha spectral radius");
    given.options.beta = prm.get_double("Newmark beta");
    given.options.gamma = prm.get_double("Newmark gamma");
    step = parameter::number_or_zero(prm, "Step size");
    end = prm.get_double("End time");
    is_on = given.scheme != "quasi-static";
    if (given.scheme == "velocity level")
      restitution = prm.get_double("Restitution");
    prm.leave_subsection();
    if (!is_on)
      return;
    if (given.scheme == "newmark" && given.options.beta < least_beta)
      throw InputError("Time stepping/Newmark beta",
                       "accelerations are differences of displacements divided "
                       "by beta, and are dominated by round-off below "
                           + short_number(least_beta)
                           + "; Newmark beta = 0 is Time stepping/Scheme = "
                             "central difference.");
    scheme = make_scheme(given);
    if (step == 0. && finds_step)
      return;
    if (step == 0.)
      throw InputError("Time stepping/Step size",
                       "Time stepping/Scheme = " + given.scheme
                           + " needs a Time stepping/Step size.");
    check_step();
  }

  void TimeParameters::check_mass(const abut_time_mass mass) const
  {
    const std::string name = scheme.name;
    const bool is_modified = mass == ABUT_TIME_MASS_MODIFIED;
    if (scheme.beta == 0. && mass != ABUT_TIME_MASS_LUMPED)
      throw InputError("Time stepping/Mass matrix",
                       name + " is explicit and needs a lumped mass.");
    if (scheme.keeps_springs != 0 && is_modified)
      throw InputError("Time stepping/Mass matrix",
                       "energy momentum conserves the energy of nodes with "
                       "mass: consistent or lumped.");
    if (scheme.projects != 0 && is_modified)
      throw InputError("Time stepping/Mass matrix",
                       name
                           + " needs mass at contact to remove penetration: "
                             "consistent or lumped.");
    if (scheme.impulses != 0 && is_modified)
      throw InputError(
          "Time stepping/Mass matrix",
          "velocity level needs mass at contact: lumped or consistent.");
  }

  void TimeParameters::check_step() const
  {
    if (end / step > most_steps)
      throw InputError("Time stepping/Step size",
                       "more than 1e7 steps to Time stepping/End time.");
    if (step > end * (1. + 1e-9))
      throw InputError("Time stepping/Step size",
                       "one step is longer than Time stepping/End time.");
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
