// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_FAILURES_H
#define ABUT_SOLVE_FAILURES_H

#include "near_null_space.h"

#include <abut/dealii/solver_parameters.h>

#include <deal.II/lac/solver_control.h>

#include <string>

namespace abut::solve
{
  /** Throw a SolverFailure with the cause. */
  [[noreturn]] void
  throw_failure(const std::string &method,
                const dealii::SolverControl::NoConvergence &failure,
                double tolerance);

  /** Whether a system of @p n_unknowns that iterations do not solve is
   * factorised: `auto` has chosen them, and it is not much too large. */
  bool may_factorise(const SolverParameters &parameters,
                     unsigned long long n_unknowns, const NearNullSpace &space);

  /** Factorise this and the next systems on the mesh, after so many iterations
   * with no solution. */
  void factorise_from_now(SolverParameters &parameters,
                          const NearNullSpace &space,
                          unsigned int n_iterations);

  /** The parameters of a system, by what systems on the mesh have been. */
  SolverParameters parameters_on(const NearNullSpace &space,
                                 const SolverParameters &parameters);

  /** Name of a direct solver, with the reason if `auto` has chosen iterations
   * first. */
  std::string direct_method(const std::string &name,
                            const NearNullSpace &space);

  /** Throw a SolverFailure if a factorisation has not reduced the residual of
   * norm @p before: @p after should be some digits smaller. */
  void check_direct_solution(double before, double after);
} // namespace abut::solve

#endif
