/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/solver_parameters.h>
#include <abut/dealii/text_pattern.h>

namespace abut
{
  bool SolverParameters::is_direct(const unsigned long long n_unknowns,
                                   const unsigned int n_components) const
  {
    if (linear != Linear::automatic)
      return linear == Linear::direct;
    const unsigned int standard = n_components == 1   ? 500
                                  : n_components == 2 ? 20000
                                                      : 3000;
    return n_unknowns <= (direct_limit > 0 ? direct_limit : standard);
  }

  void SolverParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;
    const SolverParameters standard;
    prm.enter_subsection("Solver");
    parameter::declare(
        prm, "Linear solver", "auto",
        Selection("auto|iterative|direct|geometric"), parameter::advanced(),
        "Linear solver. iterative: conjugate gradients with smoothed "
        "aggregation of Trilinos' ML (MueLu where ML is missing), FGMRES for "
        "saddle points. direct: factorisation by Trilinos' Amesos or Amesos2 "
        "(MUMPS; KLU without it, and on one rank up to 3000 unknowns). "
        "geometric: conjugate gradients with multigrid over the meshes of "
        "refinement, for degree 1 and 2. auto: direct up to `Direct limit` "
        "unknowns, then geometric for symmetric tangents where it is possible, "
        "else iterative, and direct again where iterations have no solution, "
        "up to ten times that limit.");
    parameter::declare(prm, "Maximum iterations",
                       std::to_string(standard.max_iterations), Integer(1),
                       parameter::advanced("1", "2000"),
                       "Iterations after which a linear solve has failed.");
    parameter::declare(prm, "Direct limit", "auto", OrWord(Integer(1), "auto"),
                       parameter::expert("unknowns", "50000"),
                       "Number of unknowns up to which `Linear solver = auto` "
                       "is direct. auto: 500 for scalar fields, 20000 for "
                       "displacements in 2D, 3000 in 3D.");
    parameter::declare(
        prm, "Aggregation threshold",
        std::to_string(standard.aggregation_threshold),
        NumberPattern::between(0., 1.), parameter::expert("1", "0.01"),
        "Smoothed aggregation of scalar fields: relative size below which "
        "connections are dropped. Displacements keep all connections.");
    parameter::declare(
        prm, "Smoother sweeps", std::to_string(standard.smoother_sweeps),
        Integer(1), parameter::expert("1", "3"),
        "Smoothed aggregation: degree of the Chebyshev smoother.");
    parameter::declare(
        prm, "Saddle point augmentation", std::to_string(standard.augmentation),
        NumberPattern::from(0.), parameter::expert("local stiffness", "1"),
        "Saddle point systems: augmentation of the leading block at active "
        "constraints. Changes the condition number, not the solution.");
    parameter::declare(
        prm, "Contact filter", standard.contact_filter ? "true" : "false",
        dealii::Patterns::Bool(), parameter::expert(),
        "Whether contact springs that are too stiff for multigrid are filtered "
        "by a direct solve on their unknowns. false: for comparison only.");
    prm.leave_subsection();
  }

  void SolverParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Solver");
    const std::string word = prm.get("Linear solver");
    linear = word == "direct"      ? Linear::direct
             : word == "iterative" ? Linear::iterative
             : word == "geometric" ? Linear::geometric
                                   : Linear::automatic;
    max_iterations = prm.get_integer("Maximum iterations");
    direct_limit = static_cast<unsigned int>(
        parameter::number_or_zero(prm, "Direct limit"));
    aggregation_threshold = prm.get_double("Aggregation threshold");
    smoother_sweeps = prm.get_integer("Smoother sweeps");
    augmentation = prm.get_double("Saddle point augmentation");
    contact_filter = prm.get_bool("Contact filter");
    prm.leave_subsection();
  }
} // namespace abut
