// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_CONDENSATE_SOLVER_H
#define ABUT_SOLVE_CONDENSATE_SOLVER_H

#include "condensed_matrix.h"
#include "near_null_space.h"
#include "preconditioner_state.h"

#include <abut/dealii/solver_parameters.h>

#include <deal.II/lac/solver_control.h>

#include <string>

namespace abut::solve
{
  /** Solves with a CondensedMatrix. */
  class CondensateSolver
  {
  public:
    virtual ~CondensateSolver() = default;

    /** Set the description of the unknowns, for the stiffness that comes. */
    virtual void set_near_null_space(const NearNullSpace &space) = 0;

    /** Take a new stiffness and rows, which must outlive this object or the
     * next call, with the local stiffness of each row, see row_stiffness().
     * Collective. */
    virtual void reinit(const Stiffness &stiffness, const PointOperator &rows,
                        const std::vector<double> &row_stiffness) = 0;

    /** The same when only values of the stiffness are new, and not very
     * different: a preconditioner may be kept until it is slow. Collective. */
    virtual void renew(const Stiffness &stiffness, const PointOperator &rows,
                       const std::vector<double> &row_stiffness) = 0;

    /** Take what is condensed, and make the preconditioner or factorisation
     * fit it. Collective. */
    virtual LinearReport prepare(const Condensate &condensate) = 0;

    /** The matrix of the last prepare(). */
    const CondensedMatrix &matrix() const
    {
      return matrix_;
    }

    /** Norm of the force @p rhs, springs that are much stiffer than the body
     * not counted. Tolerances are multiples of it. Collective. */
    double load(const la::Vector &rhs) const;

    /** Solve for @p x, which starts as 0, with @p rhs = P^T f, to a residual
     * of norm @p tolerance. Pivots of @p x stay 0. Throws SolverFailure.
     * Collective. */
    virtual LinearReport solve(const la::Vector &rhs, double tolerance,
                               la::Vector &x) = 0;

    /** One cycle of the preconditioner of the last prepare(). Collective. */
    virtual void precondition(la::Vector &dst, const la::Vector &src) const = 0;

    /** State that the preconditioner was built for. Not collective. */
    virtual PreconditionerState state() const
    {
      return {};
    }

    /** Build that of another solver, see RowSolver::restore(). Collective. */
    virtual void restore(const PreconditionerState &)
    {
    }

  protected:
    /** Set what is below and the matrix, with nothing condensed. Collective. */
    void set_stiffness(const Stiffness &stiffness, const PointOperator &rows);

    /** [owned] what springs make of the diagonal, as a part of what it is then:
     * 1 without springs. Collective. */
    std::vector<double> softness() const;

    /** Whether conjugate gradients may be used. */
    bool is_definite() const
    {
      return is_symmetric_ && !matrix_.has_blocks();
    }

    /** Name of the iteration. */
    std::string krylov_method() const
    {
      return is_definite() ? "conjugate gradients" : "FGMRES";
    }

    /** Iterate from @p x by precondition(), and count in @p report. Throws
     * what @p control does. Collective. */
    void iterate(const la::Vector &rhs, dealii::SolverControl &control,
                 la::Vector &x, LinearReport &report) const;

    const PointOperator *rows_ = nullptr;
    std::vector<double> diagonal_; ///< [owned] of K
    bool is_symmetric_ = true;     ///< K
    CondensedMatrix matrix_;
  };

  /** Its preconditioner as deal.II's solvers want it. */
  class Cycle
  {
  public:
    explicit Cycle(const CondensateSolver &solver) : solver_(solver)
    {
    }

    void vmult(la::Vector &dst, const la::Vector &src) const
    {
      solver_.precondition(dst, src);
    }

  private:
    const CondensateSolver &solver_;
  };
} // namespace abut::solve

#endif
