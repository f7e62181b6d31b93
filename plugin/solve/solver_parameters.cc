/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/dealii/number_pattern.h>
#include <abut/dealii/solver_parameters.h>

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
    prm.declare_entry(
        "Linear solver", "auto", Selection("auto|iterative|direct|geometric"),
        "iterative: conjugate gradients with smoothed aggregation (FGMRES for "
        "saddle points) by Trilinos' ML, or MueLu where there is no ML; "
        "direct: a factorisation by Trilinos' Amesos or Amesos2 (MUMPS where "
        "it "
        "is built in, else KLU); geometric: conjugate gradients with "
        "multigrid over the meshes that the mesh was refined from, for "
        "elements of degree 1 and 2 (elsewhere as iterative, and the report "
        "says why); auto: direct up to `Direct limit` unknowns, else geometric "
        "where that is possible and the tangent symmetric, else iterative.");
    prm.declare_entry("Maximum iterations",
                      std::to_string(standard.max_iterations), Integer(1),
                      "Iterations after which a linear solve is given up.");
    prm.declare_entry("Direct limit", std::to_string(standard.direct_limit),
                      Integer(0),
                      "Unknowns up to which auto takes the direct solver. 0: "
                      "500 for scalar fields, 20000 for displacements in the "
                      "plane, 3000 in space; a factorisation then takes some "
                      "tenths of a second at most.");
    prm.declare_entry("Aggregation threshold",
                      std::to_string(standard.aggregation_threshold),
                      NumberPattern::between(0., 1.),
                      "Smoothed aggregation: connections weaker than this "
                      "fraction are dropped. Displacements keep all.");
    prm.declare_entry(
        "Smoother sweeps", std::to_string(standard.smoother_sweeps), Integer(1),
        "Smoothed aggregation: degree of the Chebyshev smoother.");
    prm.declare_entry("Saddle point augmentation",
                      std::to_string(standard.augmentation),
                      NumberPattern::from(0.),
                      "Saddle-point systems: the leading block is augmented "
                      "by this multiple of the local stiffness on rows in "
                      "contact, which changes the condition number and not "
                      "the solution.");
    prm.declare_entry(
        "Contact filter", standard.contact_filter ? "true" : "false",
        dealii::Patterns::Bool(),
        "Whether contact springs that are too stiff for multigrid are filtered "
        "by a direct solve on the unknowns that they act on. Off, to see what "
        "that saves.");
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
    direct_limit = prm.get_integer("Direct limit");
    aggregation_threshold = prm.get_double("Aggregation threshold");
    smoother_sweeps = prm.get_integer("Smoother sweeps");
    augmentation = prm.get_double("Saddle point augmentation");
    contact_filter = prm.get_bool("Contact filter");
    prm.leave_subsection();
  }
} // namespace abut
