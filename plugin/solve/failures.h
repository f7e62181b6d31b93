// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_FAILURES_H
#define ABUT_SOLVE_FAILURES_H

#include <deal.II/lac/solver_control.h>

#include <string>

namespace abut::solve
{
  /** Throw a SolverFailure with the cause. */
  [[noreturn]] void
  throw_failure(const std::string &method,
                const dealii::SolverControl::NoConvergence &failure,
                double tolerance);

  /** Throw a SolverFailure if a factorisation has not reduced the residual of
   * norm @p before: @p after should be some digits smaller. */
  void check_direct_solution(double before, double after);
} // namespace abut::solve

#endif
