// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_MULTIGRID_H
#define ABUT_SOLVE_MULTIGRID_H

#include "near_null_space.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/solver_parameters.h>

#include <memory>

namespace abut::solve
{
  /** One multigrid cycle: what preconditions a system that is symmetric and
   * positive definite. */
  class Multigrid
  {
  public:
    virtual ~Multigrid() = default;

    /** dst = about A^-1 src. */
    virtual void vmult(la::Vector &dst, const la::Vector &src) const = 0;
  };

  /** Smoothed aggregation for @p matrix, with the rigid motions of the
   * near-null space as coarse functions: of displacements the translations
   * and, where positions are known, the rotations, which halve the number of
   * iterations. With @p slides, on one rank, aggregates do not reach from
   * one body to the next, as what slides would stick on coarse levels then:
   * that halves the iterations with friction and nearly doubles the set-up. The
   * matrix must outlive the result. Collective. */
  std::unique_ptr<Multigrid> make_multigrid(const la::Matrix &matrix,
                                            const SolverParameters &parameters,
                                            const NearNullSpace &space,
                                            bool slides = false);
} // namespace abut::solve

#endif
