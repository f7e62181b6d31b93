// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_CONDENSATION_H
#define ABUT_SOLVE_CONDENSATION_H

#include "condensate_solver.h"
#include "local_elimination.h"
#include "row_solver.h"
#include "saddle_point.h"

namespace abut::solve
{
  /** Rows over several unknowns, without pressures in the linear system:
   *
   * constraints (a = 0) are eliminated, each by one of its unknowns that no
   * other of them touches, and their pressure is found from the equation of
   * that unknown: Wohlmuth and Krause, SIAM J. Sci. Comput. 25 (2003) 324;
   * all other rows (penalties, interior points) become springs,
   *     dp = -(c + b dg) / a,
   * of stiffness w b/a. The system P^T (K + B^T diag(w b/a) B) P stays
   * symmetric and positive definite if K is.
   *
   * With friction, the rows of a point go together: a sticking point is held in
   * all its components; a slipping one along the normal, with a force that has
   * the friction, too, which makes the system unsymmetric (Hueber, Stadler and
   * Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572).
   *
   * Where a constraint has no unknown of its own (standard mortar), the system
   * is solved as a saddle point, which needs a matrix; it is in the report. */
  class Condensation : public RowSolver
  {
  public:
    /** @p has_matrix: whether the stiffnesses that come are matrices. */
    Condensation(const SolverParameters &parameters, bool has_matrix);

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
    void set_stiffness(const Stiffness &stiffness, const PointOperator &rows,
                       const std::vector<double> &row_stiffness);
    void make_saddle_point();
    bool condense();
    la::Vector right_hand_side(const la::Vector &residual,
                               const la::Vector &lift) const;
    la::Vector lift() const;
    void add_spring_forces(const abut_request &request,
                           la::Vector &reaction) const;
    void recover_held(const la::Vector &reaction,
                      const abut_request &request) const;
    void recover(const la::Vector &residual, const abut_request &request,
                 const la::Vector &increment) const;

    SolverParameters parameters_;
    NearNullSpace space_;
    Stiffness stiffness_;
    const PointOperator *rows_ = nullptr;
    std::vector<double> row_stiffness_;
    LocalElimination local_;
    std::unique_ptr<CondensateSolver> solver_;
    Condensate condensate_;
    std::unique_ptr<SaddlePoint> saddle_point_;
  };
} // namespace abut::solve

#endif
