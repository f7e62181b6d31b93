/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SOLVE_NODAL_CONDENSATION_H
#define ABUT_SOLVE_NODAL_CONDENSATION_H

#include "floating_bodies.h"
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

    void reinit(const la::Matrix &stiffness,
                const abut_rows_view &rows) override;

    void renew(const la::Matrix &stiffness,
               const abut_rows_view &rows) override;

    LinearReport solve(const la::Vector &residual, const abut_request &request,
                       double smallest_residual,
                       la::Vector &increment) override;

  private:
    void fill_mask(const abut_request &request);
    void fill_right_hand_side(const la::Vector &residual,
                              const abut_request &request,
                              la::Vector &rhs) const;
    bool fill_held_values(const abut_request &request,
                          la::Vector &increment) const;
    /** The load when there is none but the held values of @p increment. */
    double load_by_held(const la::Vector &increment) const;
    void recover(const la::Vector &residual, const abut_request &request,
                 const la::Vector &increment);

    MaskedSolver solver_;
    NearNullSpace space_;
    RowOperator operator_; ///< for displacements alone
    FloatingBodies floating_;
    const la::Matrix *stiffness_ = nullptr;
    abut_rows_view rows_ = {};
    std::vector<int> unknown_; ///< [n_rows] local number of the unknown
    Mask mask_;
    std::vector<int> holder_; ///< [owned] row that holds it, or -1
  };
} // namespace abut::solve

#endif
