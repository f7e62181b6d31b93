// SPDX-License-Identifier: LGPL-2.1-or-later
#include "diagnosis.h"

#include "app/input/short_number.h"

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Layers that a set gains or loses from a cold start, which a start from
     * a coarser mesh would save. Bodies that move, and points that begin to
     * slip, change sets in other ways. */
    constexpr int many_steps = 12;

    /** Forces out of balance that make an answer useless. */
    constexpr double useless_imbalance = 1e-2;

    /** Part of the energy by which works may be off, and what tolerances leave
     * of works that cancel each other, and of gaps in sizes of a cell. */
    constexpr double visible_work = 0.05, useless_work = 0.1,
                     tolerance_of_works = 1e-6;

    /** Digits that the energy of a body loses that moves and is hardly
     * deformed, and what tolerances leave of that of one that is unloaded. */
    constexpr double round_off_of_works = 1e-12;

    /** Parts of the force of loads, and of prescribed displacements, that cells
     * may miss. Nodes follow a wave with six facets. */
    constexpr double visible_load_error = 0.02, visible_nodal_error = 0.1;

    /** Order below which an energy converges slowly: smooth data gives 2, the
     * corners of bodies some 1.4. */
    constexpr double slow_order = 1.25;

    /** Order below which there is none. */
    constexpr double least_order = 0.2;

    /** Part of the energy that the last mesh may still miss unsaid. */
    constexpr double visible_energy = 1e-3;

    /** Penalties, as multiples of the local stiffness, that are of use. Below,
     * the contact is not felt; above, round-off of the springs disturbs the
     * rest of the matrix. */
    constexpr double softest = 1e-3, stiffest = 1e10;

    /** Condition number that costs hundreds of iterations. */
    constexpr double large_condition = 1e4;
  } // namespace

  void diagnose_penalty(Report &report, const MethodParameters &method)
  {
    const double penalty = abut_strategy_first_penalty(&method.options);
    if (penalty == 0. || (penalty >= softest && penalty <= stiffest))
      return;
    const bool nitsche = abut_law_needs_stress(method.options.law);
    report.warn(coded(
        nitsche ? ABUT_FAILURE_NITSCHE : ABUT_FAILURE_PENALTY,
        "Method/Penalty factor is " + short_number(penalty, 3)
            + " times the local stiffness, outside of the sensible range "
            + short_number(softest, 2) + " to " + short_number(stiffest, 2)
            + ". It is dimensionless: use auto.",
        {{"penalty", penalty}, {"least", softest}, {"largest", stiffest}}));
  }

  namespace
  {
    /** A part of data that the mesh does not have. @p words around its per cent
     * and the limit. */
    void diagnose_part(Report &report, const std::string &name,
                       const std::optional<double> part, const double limit,
                       const std::string &before, const std::string &after)
    {
      if (!part)
        return;
      report.set(name, *part);
      report.examined(name, *part, limit, no_limit, ABUT_FAILURE_NARROW_LOAD);
      if (*part > limit)
        report.warn(coded(ABUT_FAILURE_NARROW_LOAD,
                          before + short_number(100. * *part, 3) + " % of "
                              + after + " (limit "
                              + short_number(100. * limit, 2)
                              + " %). Let cells end where the formula changes, "
                                "or refine there: a larger Refinement/Level.",
                          {{"part", *part}, {"limit", limit}}));
    }
  } // namespace

  void diagnose_data(Report &report, const std::optional<double> load_error,
                     const std::optional<double> support_error)
  {
    diagnose_part(report, "load_error", load_error, visible_load_error,
                  "Loads change within facets or cells: ",
                  "the force of tractions, pressures and body forces is "
                  "missing or too much, as their formulas are evaluated at few "
                  "points of each");
    diagnose_part(report, "support_error", support_error, visible_nodal_error,
                  "Prescribed displacements change within facets: ",
                  "them is missing or too much, as their formulas are "
                  "evaluated at nodes");
  }

  void diagnose_friction_data(Report &report, const std::string &name,
                              const std::string &pair,
                              const std::optional<double> error)
  {
    diagnose_part(report, name, error, visible_nodal_error,
                  pair + ": friction changes within facets: ",
                  "its coefficient or largest value is missing or too much, as "
                  "the formula is evaluated at nodes");
  }

  void report_estimate(Report &report, const double estimate, const double norm)
  {
    report.set("estimate", estimate);
    if (norm > 0.)
      report.set("relative_estimate", estimate / norm);
  }

  Message diagnose_solver_failure(const Message &message, const double penalty)
  {
    if (penalty <= stiffest)
      return message;
    return coded(ABUT_FAILURE_PENALTY,
                 "The penalty of " + short_number(penalty, 2)
                     + " times the local stiffness makes the matrix too badly "
                       "conditioned: use a smaller Method/Penalty factor. "
                       "Message of the linear solver: "
                     + uncoded(message),
                 {{"penalty", penalty}});
  }

  void diagnose_iteration(Report &report, const abut_progress &progress,
                          const bool is_cold, const int n_layers)
  {
    report.set("cycle_length", progress.cycle_length);
    report.add("fallback_steps", progress.fallback_steps);
    if (progress.fallback_steps > 0)
      report.warn(
          coded(ABUT_FAILURE_CYCLE,
                "The active set cycled"
                    + (progress.cycle_length > 0
                           ? " after " + std::to_string(progress.cycle_length)
                                 + " steps"
                           : std::string())
                    + ", so that " + std::to_string(progress.fallback_steps)
                    + " iterations changed one constraint each. The solution "
                      "is correct; Method/Enforcement = interior point has no "
                      "active set.",
                {{"steps before the cycle", progress.cycle_length},
                 {"iterations", progress.fallback_steps}}));
    if (is_cold && n_layers > many_steps)
      report.warn(coded(
          ABUT_FAILURE_COLD_START,
          std::to_string(progress.step)
              + " active set iterations from displacement 0: each changes "
                "the set by one layer of nodes, and twice as fine a mesh "
                "needs twice as many. Set Refinement/Nested "
                "iteration = true, which starts from coarser meshes.",
          {{"iterations", progress.step}}));
  }

  bool diagnose_balance(Report &report, const double imbalance,
                        const double penalty, const SolvedBy &by,
                        Message &failure)
  {
    report.set("imbalance", imbalance);
    const bool is_exact = by.to_round_off && penalty == 0.;
    const abut_failure cause =
        penalty > 0. ? ABUT_FAILURE_PENALTY : ABUT_FAILURE_LINEAR_SOLVER;
    report.examined("imbalance", imbalance,
                    is_exact ? no_limit : visible_imbalance, useless_imbalance,
                    cause);
    if (imbalance <= (is_exact ? useless_imbalance : visible_imbalance))
      return true;
    const std::string seen = std::isfinite(imbalance)
                                 ? "Forces are out of balance by "
                                       + short_number(imbalance, 2)
                                       + " of the contact forces: "
                                 : "Forces are not finite: ";
    const std::string digits = "a smaller Method/Final linear tolerance";
    std::string why;
    if (penalty > 0.)
      why = "the linear system was not solved to its tolerance. The penalty of "
            + short_number(penalty, 2)
            + " times the local stiffness makes the matrix too badly "
              "conditioned: use a smaller Method/Penalty factor, or "
              "Method/Enforcement = augmented lagrangian or lagrange.";
    else if (by.newton)
      why = "Newton's method has reached its tolerance, which larger forces "
            "determine. Try a smaller Time stepping/Newton tolerance"
            + (by.factors ? "." : " and " + digits + ".");
    else
      why =
          by.factors
              ? std::string("round-off: the matrix is badly conditioned. Check "
                            "for a weakly supported body, stiffnesses that "
                            "differ by many orders of magnitude, thin cells, "
                            "and contact forces far below the other forces.")
              : "the linear system was not solved to its tolerance. Try "
                    + digits + " or Solver/Linear solver = direct.";
    const Message text = coded(cause, seen + why,
                               {{"imbalance", imbalance},
                                {"warning limit", visible_imbalance},
                                {"error limit", useless_imbalance}});
    if (!(imbalance <= useless_imbalance))
    {
      failure = text;
      return false;
    }
    report.warn(text);
    return true;
  }

  std::optional<ContactFinding> diagnose_works(Report &report,
                                               const Works &works,
                                               const double length,
                                               const double penalty)
  {
    // Balance is a matter of the linear solver, gaps are one of the law.
    const double unbalanced = works.stored - works.given - works.contact;
    const double off = std::abs(unbalanced + works.open_gaps);
    const double part = off == 0. ? 0. : off / std::abs(works.stored);
    const double least =
        tolerance_of_works * (works.size + length * works.force)
        + round_off_of_works * (works.apart + works.before);
    const bool is_law = std::abs(works.open_gaps) > std::abs(unbalanced);
    const abut_failure cause = is_law && works.open_gaps < 0. && penalty > 0.
                                   ? ABUT_FAILURE_PENALTY
                                   : ABUT_FAILURE_UNBALANCED;
    report.set("work_error", off > least ? part : 0.);
    report.examined("work_error", off > least ? part : 0., visible_work,
                    useless_work, cause);
    if (part <= visible_work || off <= least)
      return {};
    const Message text = coded(
        cause,
        "Twice the energy, " + short_number(works.stored, 4)
            + ", differs from the work of loads, supports and contact (on "
              "initial "
              "gaps) by "
            + short_number(100. * part, 2) + " %. "
            + (!is_law
                   ? "Forces are not in balance: use a smaller Method/Final "
                     "linear tolerance, or Solver/Linear solver = direct."
               : works.open_gaps > 0.
                   ? "Contact acts across open gaps: use a smaller "
                     "Method/Barrier end or Gap tolerance, or "
                     "Method/Enforcement = lagrange."
                   : "Contact allows penetration: use a larger Method/Penalty "
                     "factor or a smaller Gap tolerance, or Method/Enforcement "
                     "= lagrange."),
        {{"energy doubled", works.stored},
         {"difference", part},
         {"warning limit", visible_work},
         {"error limit", useless_work}});
    return ContactFinding(text, part > useless_work);
  }

  void diagnose_order(Report &report, const std::vector<double> &energies)
  {
    const std::size_t n = energies.size();
    if (n < 3)
      return;
    const double last = energies[n - 1] - energies[n - 2];
    const double before = energies[n - 2] - energies[n - 3];
    const double order = std::log2(before / last);
    const double noise = 1e-9 * std::abs(energies[n - 1]);
    if (!std::isfinite(order) || std::abs(last) <= noise)
      return;
    report.set("energy_order", order);
    const double missing = std::abs(last / energies[n - 1])
                           / (std::exp2(std::max(order, least_order)) - 1);
    if (order >= slow_order || missing <= visible_energy)
      return;
    // What is missing follows from the order if that is one.
    const std::string seen =
        order > least_order
            ? "The energy converges with order " + short_number(order, 2)
                  + " in the cell size (smooth data: 2); its error on the last "
                    "mesh is about "
                  + short_number(100. * missing, 2) + " %."
            : "The energy does not converge: the last mesh changed it by "
                  + short_number(100. * std::abs(last / energies[n - 1]), 2)
                  + " %, at least as much as the mesh before.";
    report.warn(
        coded(ABUT_FAILURE_SINGULAR,
              seen
                  + " Reasons are corners of bodies and punches, ends of "
                    "supports and loads, and data that jump or change within a "
                    "cell. "
                    "Refinement/Adaptive cycles refines there only."));
  }

  void diagnose_condition(Report &report, const double condition,
                          const double penalty)
  {
    if (condition == 0.)
      return;
    report.set("condition", condition);
    const abut_failure cause =
        penalty > 0. ? ABUT_FAILURE_PENALTY : ABUT_FAILURE_LINEAR_SOLVER;
    report.examined("condition", condition, large_condition, no_limit, cause);
    if (condition <= large_condition)
      return;
    const std::string seen = "Conjugate gradients found a condition number of "
                             + short_number(condition, 2)
                             + " although the matrix was " + "preconditioned. ";
    report.warn(coded(cause,
                      penalty > 0.
                          ? seen + "The penalty of " + short_number(penalty, 2)
                                + " times the local stiffness is too large "
                                  "for multigrid: set Solver/Contact filter "
                                  "= true, or use a smaller Method/Penalty "
                                  "factor."
                          : seen + "Try Solver/Linear solver = direct.",
                      {{"condition", condition}, {"limit", large_condition}}));
  }
} // namespace abut::app
