// SPDX-License-Identifier: LGPL-2.1-or-later
#include "refinement_parameters.h"

#include "app/input/input_error.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

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
    parameter::declare(prm, "Level", default_level, Patterns::Integer(0, 30),
                       parameter::basic("1", "4"),
                       "Uniform refinements of the coarse mesh (initial global "
                       "refinement). Each halves the size of the cells.");
    parameter::declare(
        prm, "Coarsest level", default_coarsest_level, Patterns::Integer(0, 30),
        parameter::advanced("1", "1"),
        "Level on which nested iteration starts; at most `Level`.");
    parameter::declare(
        prm, "Nested iteration", "true", Patterns::Bool(),
        parameter::advanced(),
        "Whether all levels from the coarsest on are solved, each started from "
        "the one before. false: solve on `Level` from displacement 0.");
    parameter::declare(
        prm, "Coarse level tolerance", "1e-3", NumberPattern::between(0., 1.),
        parameter::expert("1", "1e-4"),
        "Linear, gap and pressure tolerance on all meshes but the last, whose "
        "results are a start only (barrier: a thousandth of it). Meshes with "
        "wanted results (exact solution given, or `Output/All levels`) use "
        "`Method/Final linear tolerance`.");
    parameter::declare(prm, "Relaxation sweeps", "3",
                       Patterns::Integer(0, 1000), parameter::expert("1", "0"),
                       "Symmetric projected Gauss-Seidel sweeps that improve "
                       "each start of nested iteration.");
    parameter::declare(prm, "Renumber", "none",
                       Patterns::Selection("none|Cuthill-McKee"),
                       parameter::expert(),
                       "Order of the unknowns on each mesh: of deal.II, or "
                       "with a small bandwidth. Results do not depend on it.");
    parameter::declare(prm, "Adaptive cycles", "0", Patterns::Integer(0, 1000),
                       parameter::basic("1", "5"),
                       "Number of further meshes, refined where the error "
                       "estimate is large (adaptive refinement).");
    parameter::declare(prm, "Refine fraction", "0.6",
                       NumberPattern::between(0., 1.),
                       parameter::advanced("1", "0.5"),
                       "Part of the squared error estimate whose cells are "
                       "refined in an adaptive cycle.");
    parameter::declare(prm, "Coarsen fraction", "0.02",
                       NumberPattern::between(0., 1.),
                       parameter::advanced("1", "0.05"),
                       "Part of the squared error estimate whose cells are "
                       "coarsened in an adaptive cycle.");
    parameter::declare(
        prm, "Target error", "none",
        OrWord(NumberPattern::between(0., 1.), "none"),
        parameter::basic("1", "1e-2"),
        "Relative error of `Target quantity` at which refinement stops. The "
        "mesh is then refined from `Coarsest level` on by the error estimate "
        "(`Level` and `Adaptive cycles` are not used), and tolerances, penalty "
        "and barrier follow the error. With load steps the first step makes "
        "the mesh.");
    parameter::declare(prm, "Target quantity", "energy norm",
                       Patterns::Selection("energy norm|contact force"),
                       parameter::advanced(), "Quantity of `Target error`.");
    parameter::declare(prm, "Maximum meshes", "60", Patterns::Integer(1, 1000),
                       parameter::advanced("1", "20"),
                       "Number of meshes after which the run ends without "
                       "reaching the target.");
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
    target_error = parameter::number_or_zero(prm, "Target error");
    const unsigned int most_meshes = prm.get_integer("Maximum meshes");
    target_quantity = prm.get("Target quantity") == "contact force"
                          ? TargetQuantity::contact_force
                          : TargetQuantity::energy_norm;
    prm.leave_subsection();
    coarsest_level = std::min(coarsest_level, level);
    if (target_error > 0. && target_error < least_target)
      throw InputError(
          "Refinement/Target error",
          "is below 1e-10, where round-off is larger than the error.");
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
