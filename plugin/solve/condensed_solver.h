// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_CONDENSED_SOLVER_H
#define ABUT_SOLVE_CONDENSED_SOLVER_H

#include "condensed_matrix.h"
#include "contact_filter.h"
#include "direct_solver.h"
#include "geometric_multigrid.h"
#include "near_null_space.h"
#include "preconditioner_state.h"

#include <abut/dealii/solver_parameters.h>

#include <memory>

namespace abut::solve
{
  /** Solves with a CondensedMatrix: conjugate gradients (FGMRES if the matrix
   * is not symmetric) with ML, or a factorisation.
   *
   * The operator always is the present one; the multigrid hierarchy, which
   * costs as much as a solve, is kept while few rows change. It is built anew
   * when many have changed or the iteration slows down. Rows that are stiff
   * springs spoil it; then a direct solve on their unknowns is wrapped around
   * it, see ContactFilter. */
  class CondensedSolver
  {
  public:
    explicit CondensedSolver(
        const SolverParameters &parameters,
        const PreconditionerKeeper &keeper = PreconditionerKeeper(1. / 2.));

    /** What is known of the unknowns, for the matrices that come. */
    void set_near_null_space(const NearNullSpace &space);

    /** Take a new matrix and rows, which must outlive this object or the next
     * call, with the local stiffness of each row, see row_stiffness().
     * Collective. */
    void reinit(const la::Matrix &stiffness, const PointOperator &rows,
                const std::vector<double> &row_stiffness);

    /** The same when only values of the matrix are new, and not very
     * different: a multigrid is kept until it is slow. Collective. */
    void renew(const la::Matrix &stiffness, const PointOperator &rows,
               const std::vector<double> &row_stiffness);

    /** Take what is condensed, and make the preconditioner or factorisation
     * fit it. Collective. */
    LinearReport prepare(const Condensate &condensate);

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
    LinearReport solve(const la::Vector &rhs, double tolerance, la::Vector &x);

    /** Build the preconditioner anew if it was kept from another matrix;
     * returns whether it was. Collective. */
    bool refresh();

    /** What the preconditioner was built for. Not collective. */
    PreconditionerState state() const;

    /** Build that of another solver, see RowSolver::restore(). Collective. */
    void restore(const PreconditionerState &state);

    /** One cycle of the preconditioner of the last prepare(). Collective. */
    void precondition(la::Vector &dst, const la::Vector &src) const;

    /** Whether systems are factorised. */
    bool is_direct() const;

    /** Local stiffness of each row. */
    const std::vector<double> &row_stiffness() const
    {
      return row_stiffness_;
    }

  private:
    void take(const la::Matrix &stiffness, const PointOperator &rows,
              const std::vector<double> &row_stiffness);
    bool is_outdated() const;
    void find_friction();
    /** Take from @p force the friction that goes with what presses on stiff
     * springs. What a symmetric preconditioner does not know is then of the
     * size of the stiffness, not of the springs. Collective. */
    void subtract_friction(la::Vector &force) const;
    void cycle(la::Vector &dst, const la::Vector &src) const;
    /** Whether conjugate gradients may be used. */
    bool is_definite() const
    {
      return is_symmetric_ && !matrix_.has_blocks();
    }
    void build();
    std::string method() const;
    bool has_stiff_springs() const;
    void build_filter();
    /** Bring the hierarchy to the present matrix, terms and pivots. */
    void build_geometric();
    /** A multigrid cycle for a matrix with the present pivots. */
    std::unique_ptr<Multigrid> make_cycle(const la::Matrix &system) const;
    /** [owned] unknowns that are pivots. */
    std::vector<std::uint8_t> held_by_pivots() const;
    /** What a symmetric preconditioner is built for. */
    Condensate without_friction_forces() const;
    bool iterate(const la::Vector &rhs, unsigned int max_iterations,
                 double digits, double tolerance, la::Vector &x,
                 LinearReport &report);
    void solve_iteratively(const la::Vector &rhs, double tolerance,
                           la::Vector &x, LinearReport &report);
    void solve_directly(const la::Vector &rhs, double tolerance, la::Vector &x,
                        LinearReport &report) const;

    SolverParameters parameters_;
    NearNullSpace space_;
    const la::Matrix *stiffness_ = nullptr;
    const PointOperator *rows_ = nullptr;
    std::vector<double> diagonal_, row_stiffness_;
    bool is_symmetric_ = true;
    CondensedMatrix matrix_;
    MultigridChoice choice_;

    /** What the preconditioner was built on. */
    std::unique_ptr<la::Matrix> assembled_;
    std::unique_ptr<la::Matrix> softened_; ///< and its multigrid, if filtered
    Condensate built_;
    /** [rows] by tangents: traction by the force along the normal; empty: no
     * springs have friction. */
    std::vector<double> friction_;
    PreconditionerKeeper keeper_;
    std::unique_ptr<Multigrid> multigrid_;
    /** In place of it: K, and apart from it what contact adds to K, so that a
     * new set costs what is near it. */
    std::unique_ptr<GeometricMultigrid> geometric_;
    bool has_new_matrix_ = true; ///< than the one in it
    std::unique_ptr<ContactFilter> filter_;
    std::unique_ptr<DirectSolver> direct_;
  };

  /** Its preconditioner as deal.II's solvers want it. */
  class Cycle
  {
  public:
    explicit Cycle(const CondensedSolver &solver) : solver_(solver)
    {
    }

    void vmult(la::Vector &dst, const la::Vector &src) const
    {
      solver_.precondition(dst, src);
    }

  private:
    const CondensedSolver &solver_;
  };
} // namespace abut::solve

#endif
