/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SOLVE_ROW_SOLVER_H
#define ABUT_SOLVE_ROW_SOLVER_H

#include "near_null_space.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dealii/solver_parameters.h>
#include <abut/rows.h>
#include <abut/strategy.h>

#include <memory>

namespace abut::solve
{
  class RowOperator;

  /** One linearised step of a contact problem: find du and dp with
   *
   *     K du - sum_i w_i dp_i B_i^T = -R + sum_i w_i p_i B_i^T
   *     a_i dp_i + b_i B_i du       = -c_i
   *
   * for constraint rows (w, B), a residual R = internal - external forces
   * and the linearised law (a, b, c) of a request of the core. Knows
   * matrices, no geometry and no method. */
  class RowSolver
  {
  public:
    virtual ~RowSolver() = default;

    /** What is known of the unknowns. Call before reinit(), and again when the
     * mesh changes. Not collective. */
    virtual void set_near_null_space(const NearNullSpace &space) = 0;

    /** Take a matrix and the rows that go with it. Both must outlive the
     * calls to solve(). Columns of rows may be unknowns of other ranks.
     * Collective. */
    virtual void reinit(const la::Matrix &stiffness,
                        const abut_rows_view &rows) = 0;

    /** The same when only the values of the matrix are new, and not very
     * different: a preconditioner may be kept as long as it is good.
     * Collective. */
    virtual void renew(const la::Matrix &stiffness, const abut_rows_view &rows)
    {
      reinit(stiffness, rows);
    }

    /** Solve with relative tolerance request.linear_tolerance for the
     * residual on the free unknowns, but not below
     * @p smallest_residual. Writes dp and dg into the request's arrays.
     * Throws when the iteration fails. Collective. */
    virtual LinearReport solve(const la::Vector &residual,
                               const abut_request &request,
                               double smallest_residual,
                               la::Vector &increment) = 0;
  };

  /** The local stiffness 1 / (w_i sum_j B_ij^2 / K_jj) of each row, pressure
   * per length: what penalties are multiples of. It is the pressure that opens
   * the gap by one if each unknown were held by its own stiffness alone: the
   * two sides of a pair act in series. Collective. */
  std::vector<double> row_stiffness(const la::Matrix &stiffness,
                                    const RowOperator &rows);

  /** The same for rows that no operator was made of yet. Collective. */
  std::vector<double> row_stiffness(const la::Matrix &stiffness,
                                    const abut_rows_view &rows);

  /** Whether each row is one owned unknown alone, on all ranks. Collective. */
  bool are_nodal(const la::Matrix &stiffness, const abut_rows_view &rows);

  /** The solver for a set of rows: by elimination unless the user's word
   * @p system asks for a saddle point. Collective. */
  std::unique_ptr<RowSolver> make_row_solver(System system,
                                             const SolverParameters &parameters,
                                             const la::Matrix &stiffness,
                                             const abut_rows_view &rows);
} // namespace abut::solve

#endif
