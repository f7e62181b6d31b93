// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_SADDLE_POINT_H
#define ABUT_SOLVE_SADDLE_POINT_H

#include "condensed_solver.h"
#include "local_elimination.h"
#include "row_solver.h"

namespace abut::solve
{
  /** The pressures of rows in contact are unknowns of the linear system,
   *
   *     [ K + D   -C^T ] [du]   [ f ]
   *     [  -C      0   ] [dp] = [ h ],      C = W B on constraints (a = 0);
   *
   * rows whose pressure follows from the gap (a != 0) are condensed into D =
   * B^T diag(w b/a) B. With friction the point is what is condensed: D has a
   * block for each, and the forces of constraints are C'^T dp, which have the
   * friction of slipping points, while C has not; the matrix is unsymmetric.
   * Iteratively: FGMRES with the block-triangular preconditioner of the
   * augmented system, one multigrid cycle for K + D + gamma s W B^T B and the
   * diagonal 3 w / ((1 + gamma) s) for the Schur complement, s being the local
   * stiffness. Directly: a factorisation of the whole by a direct solver. */
  class SaddlePoint : public RowSolver
  {
  public:
    explicit SaddlePoint(const SolverParameters &parameters);

    void set_near_null_space(const NearNullSpace &space) override;

    void reinit(const Stiffness &stiffness, const PointOperator &rows,
                const std::vector<double> &row_stiffness) override;

    void renew(const Stiffness &stiffness, const PointOperator &rows,
               const std::vector<double> &row_stiffness) override;

    std::vector<PreconditionerState> state() const override;

    void restore(const std::vector<PreconditionerState> &state) override;

    LinearReport solve(const la::Vector &residual, const abut_request &request,
                       double smallest_residual,
                       la::Vector &increment) override;

  private:
    struct System;

    System assemble(const la::Vector &residual,
                    const abut_request &request) const;
    void augment(System &system, la::Vector &force) const;
    /** D alone. */
    Condensate springs() const;
    unsigned int solve_iteratively(const System &system,
                                   const la::Vector &force, double tolerance,
                                   la::Vector &increment,
                                   std::vector<double> &multiplier);
    la::Matrix assemble_matrix(const System &system) const;
    /** Call function(line, row, trial, test) for each row that is in the
     * trial or the test direction of a constraint. */
    template <typename Function>
    void for_each_constraint(const System &system,
                             const Function &function) const;
    std::string solve_directly(const System &system, double smallest_residual,
                               la::Vector &increment,
                               std::vector<double> &multiplier) const;
    void recover(const abut_request &request, const System &system,
                 const std::vector<double> &multiplier,
                 const la::Vector &increment) const;

    SolverParameters parameters_;
    NearNullSpace space_;
    CondensedSolver leading_;
    const la::Matrix *stiffness_ = nullptr;
    const PointOperator *rows_ = nullptr;
    LocalElimination local_;
  };
} // namespace abut::solve

#endif
