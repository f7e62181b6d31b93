// SPDX-License-Identifier: LGPL-2.1-or-later
#include "failures.h"

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
