// SPDX-License-Identifier: LGPL-2.1-or-later
#include "refinement_parameters.h"

#include "app/input/input_error.h"

#include <abut/dealii/number_pattern.h>

#include <algorithm>

namespace abut::app
{
  namespace
  {
    /** Tolerances as parts of the target: below what its error shows. */
    constexpr double target_part = 1e-2;

    /** Smallest error that can be asked for. */
    constexpr double least_target = 1e-10;

    /** The method with tolerances that are not finer than @p enough needs. */
    MethodParameters with_tolerance(const MethodParameters &method,
                                    const double enough)
    {
      MethodParameters here = method;
      abut_strategy_options &o = here.options;
      // Outer steps need linear solves that are finer than what they look at,
      // and so do gaps that only the linear solver closes.
      const bool rough =
          abut_law_solves_once(o.law) && here.system != System::saddle_point;
      const double linear = rough ? enough : 1e-2 * enough;
      o.final_linear_tolerance = std::max(o.final_linear_tolerance,
                                          std::min(linear, o.linear_tolerance));
      o.gap_tolerance = std::max(o.gap_tolerance, enough);
      o.pressure_tolerance = std::max(o.pressure_tolerance, enough);
      o.barrier_end =
          std::max(o.barrier_end, std::min(1e-3 * enough, o.barrier_start));
      return here;
    }
  } // namespace

  void RefinementParameters::declare(dealii::ParameterHandler &prm,
                                     const std::string &default_level,
                                     const std::string &default_coarsest_level)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection("Refinement");
    prm.declare_entry("Level", default_level, Patterns::Integer(0, 30),
                      "Uniform refinements of the coarse mesh.");
    prm.declare_entry("Coarsest level", default_coarsest_level,
                      Patterns::Integer(0, 30),
                      "Level on which nested iteration begins; at most "
                      "`Level`.");
    prm.declare_entry("Nested iteration", "true", Patterns::Bool(),
                      "Solve on all levels from the coarsest on, each "
                      "started from the one before. Off: solve on `Level` "
                      "from displacement 0.");
    prm.declare_entry("Coarse level tolerance", "1e-3",
                      NumberPattern::between(0., 1.),
                      "Linear, gap and pressure tolerance in the end on all "
                      "meshes but the last, whose results are only a start "
                      "(a thousandth of it for the barrier). Meshes whose "
                      "results "
                      "are wanted (an exact solution is given, or `All "
                      "levels`) are solved to `Method/Final linear "
                      "tolerance`.");
    prm.declare_entry("Relaxation sweeps", "3", Patterns::Integer(0, 1000),
                      "Symmetric projected Gauss-Seidel sweeps that improve "
                      "each start of nested iteration.");
    prm.declare_entry("Renumber", "none",
                      Patterns::Selection("none|Cuthill-McKee"),
                      "Order of the unknowns on each mesh: as deal.II makes "
                      "it, or with a small bandwidth. Results do not depend "
                      "on it.");
    prm.declare_entry("Adaptive cycles", "0", Patterns::Integer(0, 1000),
                      "Further meshes, refined where the error estimate is "
                      "large.");
    prm.declare_entry("Refine fraction", "0.6", NumberPattern::between(0., 1.),
                      "Part of the squared error estimate whose cells are "
                      "refined in an adaptive cycle.");
    prm.declare_entry("Coarsen fraction", "0.02",
                      NumberPattern::between(0., 1.),
                      "Part of it whose cells are coarsened.");
    prm.declare_entry("Target error", "0", NumberPattern::between(0., 1.),
                      "Relative error of `Target quantity` at which to stop, "
                      "for example 1e-2; 0: none. With a target the mesh is "
                      "refined from `Coarsest level` on where the error "
                      "estimate is large (neither `Level` nor `Adaptive "
                      "cycles` is used), and penalty, barrier and tolerances "
                      "are made finer only where the answer shows it. With "
                      "load steps it is met on the first one, whose mesh the "
                      "others keep.");
    prm.declare_entry("Target quantity", "energy norm",
                      Patterns::Selection("energy norm|contact force"),
                      "What the target is a relative error of.");
    prm.declare_entry("Most meshes", "60", Patterns::Integer(1, 1000),
                      "Meshes after which a target is given up.");
    prm.leave_subsection();
  }

  void RefinementParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Refinement");
    level = prm.get_integer("Level");
    coarsest_level = prm.get_integer("Coarsest level");
    nested = prm.get_bool("Nested iteration");
    relaxation_sweeps = prm.get_integer("Relaxation sweeps");
    coarse_tolerance = prm.get_double("Coarse level tolerance");
    renumber = prm.get("Renumber") != "none";
    adaptive_cycles = prm.get_integer("Adaptive cycles");
    refine_fraction = prm.get_double("Refine fraction");
    coarsen_fraction = prm.get_double("Coarsen fraction");
    target_error = prm.get_double("Target error");
    const unsigned int most_meshes = prm.get_integer("Most meshes");
    target_quantity = prm.get("Target quantity") == "contact force"
                          ? TargetQuantity::contact_force
                          : TargetQuantity::energy_norm;
    prm.leave_subsection();
    coarsest_level = std::min(coarsest_level, level);
    if (target_error > 0. && target_error < least_target)
      throw InputError("Refinement/Target error",
                       "is below 1e-10: round-off hides such errors, and no "
                       "memory holds the meshes.");
    if (has_target())
    {
      level = coarsest_level;
      adaptive_cycles = most_meshes - 1;
    }
    if (refine_fraction + coarsen_fraction > 1.)
      throw InputError("Refinement/Coarsen fraction",
                       "The fractions that are refined and coarsened add up "
                       "to more than 1.");
  }

  MethodParameters
  RefinementParameters::for_target(const MethodParameters &method) const
  {
    return with_tolerance(method, target_part * target_error);
  }

  MethodParameters
  RefinementParameters::loosened(const MethodParameters &method) const
  {
    return with_tolerance(method, coarse_tolerance);
  }
} // namespace abut::app
