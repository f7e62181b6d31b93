// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_HOST_SOLVER_H
#define ABUT_SOLVE_HOST_SOLVER_H

#include "condensate_solver.h"

#include <cstdint>
#include <vector>

namespace abut::solve
{
  /** Without a matrix: conjugate gradients (FGMRES if it is not symmetric) with
   * the host's own preconditioner M for K, cut off at pivots and scaled by what
   * springs add to the diagonal D of K,
   *
   *     S M S,   s = sqrt(D / (D + springs)), 0 at pivots.
   *
   * For a few nodes on each other that is as good as M is for K; for surfaces
   * that press on each other the condition number grows with the number of
   * cells along them, as M does not include the contact. The host receives the
   * unknowns that rows of single unknowns hold. */
  class HostSolver : public CondensateSolver
  {
  public:
    explicit HostSolver(const SolverParameters &parameters);

    void set_near_null_space(const NearNullSpace &space) override;

    /** Throws std::invalid_argument if the host's diagonal is not positive, or
     * is not that of its products where a row looks, or if products couple
     * unknowns whose values are prescribed. */
    void reinit(const Stiffness &stiffness, const PointOperator &rows,
                const std::vector<double> &row_stiffness) override;

    void renew(const Stiffness &stiffness, const PointOperator &rows,
               const std::vector<double> &row_stiffness) override;

    LinearReport prepare(const Condensate &condensate) override;

    LinearReport solve(const la::Vector &rhs, double tolerance,
                       la::Vector &x) override;

    void precondition(la::Vector &dst, const la::Vector &src) const override;

  private:
    void set_host(const Stiffness &stiffness, const PointOperator &rows);

    SolverParameters parameters_;
    CommonArray<std::uint8_t> prescribed_; ///< [owned]; empty: not known
    Stiffness stiffness_;
    std::vector<double> scaling_; ///< [owned] S
    mutable la::Vector scaled_;
  };
} // namespace abut::solve

#endif
