/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SOLVE_PROJECTED_GAUSS_SEIDEL_H
#define ABUT_SOLVE_PROJECTED_GAUSS_SEIDEL_H

#include <abut/dealii/linear_algebra.h>

namespace abut::solve
{
  /** Symmetric projected Gauss-Seidel sweeps for
   *
   *     minimise 1/2 d'Kd + R'd  subject to  lower <= d <= upper,
   *
   * a start for an active-set iteration: after a few sweeps the set of
   * unknowns at a bound is right up to a layer of nodes. Ranks sweep side by
   * side with the ghosts of the sweep before (block Jacobi).
   * @param lower,upper [owned] bounds, +-infinity where there is none
   * @param correction d; in: start, out: result. Collective; each sweep costs
   * two products with K. */
  void projected_gauss_seidel(const la::Matrix &stiffness,
                              const la::Vector &residual,
                              const std::vector<double> &lower,
                              const std::vector<double> &upper,
                              unsigned int n_sweeps, la::Vector &correction);
} // namespace abut::solve

#endif
