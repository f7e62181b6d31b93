/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SOLVE_NODAL_CONDENSATION_H
#define ABUT_SOLVE_NODAL_CONDENSATION_H

#include "local_elimination.h"
#include "masked_solver.h"
#include "row_solver.h"

namespace abut::solve
{
  /** Rows with one entry each (membranes, nodal obstacles): constraints
   * (a = 0) hold their unknown, all other rows are condensed into the
   * diagonal and the right-hand side,
   *     dp = -(c + b dg) / a.
   * The size of the system does not change and the matrix is not touched.
   */
  class NodalCondensation : public RowSolver
  {
  public:
    explicit NodalCondensation(const SolverParameters &parameters);

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
    /** The unknown of a row, and what the gap is per unit of it. */
    int unknown(const int row) const
    {
      return rows_->column(rows_->begin(row));
    }
    double slope(const int row) const
    {
      return rows_->coefficient(rows_->begin(row));
    }

    void set_stiffness(const la::Matrix &stiffness, const PointOperator &rows);
    void fill_mask();
    void fill_right_hand_side(const la::Vector &residual,
                              la::Vector &rhs) const;
    /** Returns whether they are all 0. */
    bool fill_held_values(la::Vector &increment) const;
    /** The load when there is none but the held values of @p increment. */
    double load_by_held(const la::Vector &increment) const;
    void recover(const la::Vector &residual, const abut_request &request,
                 const la::Vector &increment);

    MaskedSolver solver_;
    NearNullSpace space_;
    const la::Matrix *stiffness_ = nullptr;
    const PointOperator *rows_ = nullptr;
    LocalElimination local_;
    Mask mask_;
    std::vector<int> holder_; ///< [owned] row that holds it, or -1
  };
} // namespace abut::solve

#endif
