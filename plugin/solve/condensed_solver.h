// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_CONDENSED_SOLVER_H
#define ABUT_SOLVE_CONDENSED_SOLVER_H

#include "condensate_solver.h"
#include "contact_filter.h"
#include "direct_solver.h"
#include "geometric_multigrid.h"

#include <memory>

namespace abut::solve
{
  /** With a matrix: conjugate gradients (FGMRES if it is not symmetric) with
   * multigrid, or a factorisation.
   *
   * The operator always is the present one; the multigrid hierarchy, which
   * costs as much as a solve, is kept while few rows change. It is built again
   * when many have changed or the iteration slows down. Rows that are stiff
   * springs spoil it; then a direct solve on their unknowns is wrapped around
   * it, see ContactFilter. */
  class CondensedSolver : public CondensateSolver
  {
  public:
    explicit CondensedSolver(
        const SolverParameters &parameters,
        const PreconditionerKeeper &keeper = PreconditionerKeeper(1. / 2.));

    ~CondensedSolver() override;

    void set_near_null_space(const NearNullSpace &space) override;

    void reinit(const Stiffness &stiffness, const PointOperator &rows,
                const std::vector<double> &row_stiffness) override;

    void renew(const Stiffness &stiffness, const PointOperator &rows,
               const std::vector<double> &row_stiffness) override;

    LinearReport prepare(const Condensate &condensate) override;

    LinearReport solve(const la::Vector &rhs, double tolerance,
                       la::Vector &x) override;

    /** Build the preconditioner again if it was kept from another matrix;
     * returns whether it was. Collective. */
    bool refresh();

    PreconditionerState state() const override;

    void restore(const PreconditionerState &state) override;

    void precondition(la::Vector &dst, const la::Vector &src) const override;

    /** Its name, of systems that are not factorised. */
    std::string preconditioner() const;

    /** Whether systems are factorised. */
    bool is_direct() const;

    /** Local stiffness of each row. */
    const std::vector<double> &row_stiffness() const
    {
      return row_stiffness_;
    }

  private:
    void set_stiffness(const Stiffness &stiffness, const PointOperator &rows,
                       const std::vector<double> &row_stiffness);
    bool is_outdated() const;
    void find_friction();
    /** Take from @p force the friction due to the pressure of stiff springs.
     * The part that a symmetric preconditioner does not know is then of the
     * size of the stiffness, not of the springs. Collective. */
    void subtract_friction(la::Vector &force) const;
    void cycle(la::Vector &dst, const la::Vector &src) const;
    void build();
    std::string method() const;
    bool has_stiff_springs() const;
    /** Take the matrix of the last solver on this mesh, if there is none yet.
     */
    void take_kept();
    /** Assemble the matrix of the preconditioner, if it is not the stiffness.
     * Collective. */
    void assemble(bool has_model);
    /** The matrix of the preconditioner. */
    const la::Matrix &system() const
    {
      return is_assembled_ ? assembled_->matrix.matrix() : *stiffness_;
    }
    void build_filter();
    /** Bring the hierarchy to the present matrix, terms and pivots. */
    void build_geometric();
    /** A multigrid cycle for a matrix with the present pivots. */
    std::unique_ptr<Multigrid> make_cycle(const la::Matrix &system) const;
    /** [owned] unknowns that are pivots. */
    std::vector<std::uint8_t> held_by_pivots() const;
    /** Terms that a symmetric preconditioner is built for. */
    Condensate without_friction_forces() const;
    bool iterate(const la::Vector &rhs, unsigned int max_iterations,
                 double digits, double tolerance, la::Vector &x,
                 LinearReport &report);
    void solve_iteratively(const la::Vector &rhs, double tolerance,
                           la::Vector &x, LinearReport &report);
    /** Whether there are factors of another matrix on this mesh. */
    bool has_near_factors();
    /** Iterate with them, as long as that is cheaper than to factorise; false:
     * it is not, and @p x is as far as it came. Collective. */
    bool iterate_with_near_factors(const la::Vector &rhs, double tolerance,
                                   la::Vector &x, LinearReport &report) const;
    void solve_directly(const la::Vector &rhs, double tolerance, la::Vector &x,
                        LinearReport &report);

    SolverParameters parameters_;
    NearNullSpace space_;
    unsigned int step_ = 0; ///< of its kept parts
    const la::Matrix *stiffness_ = nullptr;
    std::vector<double> row_stiffness_;
    SolverChoice choice_;

    /** The matrix that the preconditioner was built on, with factors of direct
     * solvers, unless it is the stiffness. */
    std::unique_ptr<FactorisedMatrix> assembled_;
    bool is_assembled_ = false;
    bool has_old_factors_ = false;         ///< not of the present matrix
    std::unique_ptr<KeptMatrix> softened_; ///< and its multigrid, if filtered
    Condensate built_;
    /** [rows] by tangents: traction by the force along the normal; empty: no
     * springs have friction. */
    std::vector<double> friction_;
    PreconditionerKeeper keeper_;
    std::unique_ptr<Multigrid> multigrid_;
    /** In place of it: K, and apart from it what contact adds to K, so that a
     * new set costs what is near it. */
    std::unique_ptr<GeometricMultigrid> geometric_;
    /** Stiffness::values() of the present matrix, and of the one in it. */
    std::shared_ptr<const void> values_, geometric_of_;
    std::unique_ptr<ContactFilter> filter_;
  };
} // namespace abut::solve

#endif
