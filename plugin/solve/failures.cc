// SPDX-License-Identifier: LGPL-2.1-or-later
#include "failures.h"

#include "kept_parts.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/solver_parameters.h>

#include <cctype>
#include <cmath>
#include <sstream>

namespace abut::solve
{
  void throw_failure(const std::string &method,
                     const dealii::SolverControl::NoConvergence &failure,
                     const double tolerance)
  {
    std::ostringstream text;
    text << static_cast<char>(std::toupper(method[0])) << method.substr(1)
         << " ended after " << failure.last_step
         << " iterations with a residual of " << failure.last_residual
         << " where " << tolerance << " is required. ";
    if (std::isfinite(failure.last_residual))
      text << "The matrix is badly conditioned or nearly singular. Check for "
              "bodies without supports; try Solver/Linear solver = direct, a "
              "smaller Method/Penalty factor, or more Solver/Maximum "
              "iterations.";
    else
      text << "A value is not finite. Check for infinite data and for bodies "
              "without supports.";
    throw SolverFailure(coded(std::isfinite(failure.last_residual)
                                  ? ABUT_FAILURE_LINEAR_SOLVER
                                  : ABUT_FAILURE_NOT_FINITE,
                              text.str(),
                              {{"iterations", failure.last_step},
                               {"residual", failure.last_residual},
                               {"tolerance", tolerance}}));
  }

  bool may_factorise(const SolverParameters &parameters,
                     const unsigned long long n_unknowns,
                     const NearNullSpace &space)
  {
    // Times the number that `auto` factorises at once: slow, but an answer.
    constexpr unsigned long long more = 10;
    return parameters.linear == SolverParameters::Linear::automatic
           && parameters.is_direct(n_unknowns / more, space.n_components);
  }

  void factorise_from_now(SolverParameters &parameters,
                          const NearNullSpace &space,
                          const unsigned int n_iterations)
  {
    parameters.linear = SolverParameters::Linear::direct;
    space.kept->useless_iterations = n_iterations;
  }

  SolverParameters parameters_on(const NearNullSpace &space,
                                 const SolverParameters &parameters)
  {
    SolverParameters result = parameters;
    if (space.kept->useless_iterations > 0)
      result.linear = SolverParameters::Linear::direct;
    return result;
  }

  std::string direct_method(const std::string &name, const NearNullSpace &space)
  {
    const unsigned int n = space.kept->useless_iterations;
    return n == 0 ? name
                  : name + " (no solution after " + std::to_string(n)
                        + " iterations)";
  }

  void check_direct_solution(const double before, const double after)
  {
    if (after <= 1e-6 * before)
      return;
    std::ostringstream text;
    text << "The direct solver left a residual of " << after << " of " << before
         << ". The matrix is singular or nearly singular. Check for bodies "
            "without supports and for materials or penalties of very different "
            "stiffness.";
    throw SolverFailure(coded(ABUT_FAILURE_LINEAR_SOLVER, text.str(),
                              {{"residual", after}, {"before", before}}));
  }
} // namespace abut::solve
