// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_NITSCHE_SOLVER_H
#define ABUT_SOLVE_NITSCHE_SOLVER_H

#include "condensed_solver.h"
#include "local_elimination.h"
#include "row_solver.h"
#include "unsupported_bodies.h"

namespace abut::solve
{
  /** Terms of each row that Nitsche's method needs in addition to its gap. */
  struct NitscheTerms
  {
    PointOperator stress; ///< S = d sigma / du, sigma(0) as gap; sigma is
                          ///< sigma_n at normals, -sigma_t at tangents
    std::vector<double> compliance; ///< [rows] 1/gamma, length per pressure
    std::vector<double> present;    ///< [rows] sigma at the present u
    double theta = 0.;              ///< 1: symmetric, 0, -1
  };

  /** Rows under Nitsche's method (Chouly, Hild and Renard, Math. Comp. 84
   * (2015) 1089): the pressure is
   *
   *     p = gamma <-g~>,   g~ = g + sigma_n(u) / gamma,
   *
   * so that the change of g~ is (B + S/gamma) du, where the body's own normal
   * stress sigma_n takes the place of a multiplier; it acts on
   * B + theta S/gamma, and K loses theta S^T w/gamma S. The request's gaps are
   * g~. The matrix is symmetric for theta = 1 only.
   *
   * With friction (theta = 0) the traction is sigma_t - gamma s, projected on
   * the disc of radius rho: the law of a penalty with the slips
   * s - sigma_t/gamma and no reference. */
  class NitscheSolver : public RowSolver
  {
  public:
    /** @p terms must outlive this object and be those of the rows given to
     * reinit() whenever solve() is called. */
    NitscheSolver(const SolverParameters &parameters,
                  const NitscheTerms &terms);

    void set_near_null_space(const NearNullSpace &space) override;

    void reinit(const Stiffness &stiffness, const PointOperator &rows,
                const std::vector<double> &row_stiffness) override;

    void renew(const Stiffness &stiffness, const PointOperator &rows,
               const std::vector<double> &row_stiffness) override;

    LinearReport solve(const la::Vector &residual, const abut_request &request,
                       double smallest_residual,
                       la::Vector &increment) override;

  private:
    struct Line;

    void find_unsupported_bodies();
    la::Vector right_hand_side(const la::Vector &residual) const;
    /** Row @p row of B + part S/gamma. */
    Line line(int row, double part) const;
    Condensate springs() const;
    la::Matrix assemble() const;
    bool is_direct() const;
    void iterate(const la::Matrix &matrix, const la::Vector &rhs,
                 double tolerance, la::Vector &x, LinearReport &report);
    void recover(const abut_request &request,
                 const la::Vector &increment) const;

    SolverParameters parameters_;
    const NitscheTerms &terms_;
    const la::Matrix *stiffness_ = nullptr;
    const PointOperator *rows_ = nullptr;
    LocalElimination local_;
    NearNullSpace space_;
    UnsupportedBodies unsupported_; ///< with friction only
    /** K and the springs alone, symmetric and positive definite as multigrid
     * wants it. */
    CondensedSolver model_;
  };
} // namespace abut::solve

#endif
