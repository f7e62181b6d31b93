/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SOLVE_MASKED_SOLVER_H
#define ABUT_SOLVE_MASKED_SOLVER_H

#include "direct_solver.h"
#include "geometric_multigrid.h"
#include "near_null_space.h"
#include "preconditioner_state.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/solver_parameters.h>

#include <deal.II/lac/solver_control.h>

#include <cstdint>
#include <memory>

namespace abut::solve
{
  /** Difference between the system to be solved and the matrix K. */
  struct Mask
  {
    /** [owned] nonzero where the unknown is held at its given value. */
    std::vector<std::uint8_t> held;
    /** [owned] added to the diagonal of K, >= 0; empty: nothing. */
    std::vector<double> diagonal;
  };

  /** P K P + D, and the identity on held unknowns, which stay 0. On one rank
   * their rows are passed over. */
  class MaskedOperator
  {
  public:
    MaskedOperator(const la::Matrix &matrix, const Mask &mask)
        : matrix_(matrix),
          mask_(mask),
          is_alone_(dealii::Utilities::MPI::n_mpi_processes(
                        matrix.get_mpi_communicator())
                    == 1),
          rows_(is_alone_ ? la::local_rows(matrix) : la::LocalRows())
    {
    }

    void vmult(la::Vector &dst, const la::Vector &src) const
    {
      double *out = la::data(dst);
      const double *in = la::data(src);
      const std::size_t n = mask_.held.size();
      if (is_alone_)
        multiply_free(in, out);
      else
        matrix_.vmult(dst, src);
      if (!mask_.diagonal.empty())
        for (std::size_t i = 0; i < n; ++i)
          out[i] += mask_.diagonal[i] * in[i];
      for (std::size_t i = 0; i < n; ++i)
        out[i] = mask_.held[i] ? 0. : out[i];
    }

  private:
    void multiply_free(const double *in, double *out) const
    {
      for (int i = 0; i < rows_.n_rows; ++i)
      {
        double sum = 0.;
        const int end = rows_.start[mask_.held[i] ? i : i + 1];
        for (int k = rows_.start[i]; k < end; ++k)
          sum += rows_.value[k] * in[rows_.column[k]];
        out[i] = sum;
      }
    }

    const la::Matrix &matrix_;
    const Mask &mask_;
    const bool is_alone_;
    const la::LocalRows rows_;
  };

  /** S M S with the scaling of MaskedSolver, 0 at held unknowns. */
  class ScaledPreconditioner
  {
  public:
    /** @p scaling [owned], or empty: 1 where @p mask, which must live as long,
     * holds nothing. Vectors that come in must be 0 where it is 0. */
    ScaledPreconditioner(const Multigrid &inner, const Mask &mask,
                         std::vector<double> scaling, const la::Vector &model)
        : inner_(inner), mask_(mask), scaling_(std::move(scaling))
    {
      if (!scaling_.empty())
        scaled_.reinit(model, true);
    }

    void vmult(la::Vector &dst, const la::Vector &src) const
    {
      if (scaling_.empty())
      {
        inner_.vmult(dst, src);
        double *const out = la::data(dst);
        for (std::size_t i = 0; i < mask_.held.size(); ++i)
          out[i] = mask_.held[i] ? 0. : out[i];
        return;
      }
      const double *const in = la::data(src);
      double *const middle = la::data(scaled_);
      for (std::size_t i = 0; i < scaling_.size(); ++i)
        middle[i] = scaling_[i] * in[i];
      inner_.vmult(dst, scaled_);
      double *const out = la::data(dst);
      for (std::size_t i = 0; i < scaling_.size(); ++i)
        out[i] *= scaling_[i];
    }

  private:
    const Multigrid &inner_;
    const Mask &mask_;
    std::vector<double> scaling_;
    mutable la::Vector scaled_;
  };

  /** Solves (K + D) x = b with some unknowns held, without changing K:
   * symmetric positive definite on the free unknowns.
   *
   * Held unknowns are projected out of the Krylov iteration instead of out
   * of the matrix. Only the preconditioner is built on a copy of K whose
   * held rows and columns are cut off. It is kept while the mask changes
   * little: the smoother of its finest level sees the present held unknowns,
   * since the copy is brought up to date, and
   *     M -> S M S,  s = sqrt(d_old / d_new),
   * where d is the diagonal of K + D (s = 0 on held unknowns, which is the
   * limit d -> infinity), accounts for a changed D. It is built again when too
   * many entries changed or the iteration slows down.
   *
   * Geometric multigrid follows each mask, at the cost of what changed. */
  class MaskedSolver
  {
  public:
    explicit MaskedSolver(const SolverParameters &parameters = {});

    ~MaskedSolver();

    /** Set the description of the unknowns, for the matrices that come. */
    void set_near_null_space(const NearNullSpace &space);

    /** Take a new matrix, which must outlive this object or the next call.
     */
    void reinit(const la::Matrix &matrix);

    /** Take new values of the same pattern: a multigrid is kept until it is
     * slow. */
    void renew(const la::Matrix &matrix);

    /** Solve with the Euclidean norm of the residual on the free unknowns at
     * most @p tolerance. @p x holds the values of held unknowns and a start for
     * the free ones; @p start_is_zero: all of it is 0. Throws if the iteration
     * does not converge. Collective. */
    LinearReport solve(const Mask &mask, const la::Vector &rhs,
                       double tolerance, la::Vector &x,
                       bool start_is_zero = false);

    /** Norm of the forces that @p rhs puts on the free unknowns, where D adds
     * to the diagonal k of K counted (k / (k + D))^2 times: very stiff springs
     * then count as held unknowns do, not at all, though the forces in them
     * are large at first. Tolerances are multiples of this norm. Collective.
     */
    double load(const Mask &mask, const la::Vector &rhs) const;

    /** Make the preconditioner (or factorisation) fit the mask. Collective. */
    LinearReport prepare(const Mask &mask);

    /** State that the preconditioner was built for. Not collective. */
    PreconditionerState state() const;

    /** Build that of another solver, see RowSolver::restore(). Collective. */
    void restore(const PreconditionerState &state);

    /** One V-cycle for the mask given, which must be that of prepare(). */
    ScaledPreconditioner preconditioner(const Mask &mask,
                                        const la::Vector &model) const;

    /** Whether systems are factorised. */
    bool is_direct() const;

    /** Diagonal of K, [owned]. */
    const std::vector<double> &diagonal() const
    {
      return diagonal_;
    }

  private:
    void set_stiffness(const la::Matrix &matrix);
    bool is_outdated(const Mask &mask) const;
    bool is_plain(const Mask &mask) const;
    void cut_off(const std::vector<std::uint8_t> &held, const Mask &mask,
                 bool everything);
    void build(const Mask &mask);
    std::string method() const;
    /** Whether that was enough iterations; @p n_iterations counts them. */
    bool iterate(const Mask &mask, const la::Vector &residual, double tolerance,
                 unsigned int max_iterations, la::Vector &correction,
                 LinearReport &report, unsigned int &n_iterations);
    void solve_iteratively(const Mask &mask, const la::Vector &residual,
                           double tolerance, la::Vector &correction,
                           LinearReport &report);

    SolverParameters parameters_;
    NearNullSpace space_;
    const la::Matrix *matrix_ = nullptr;
    std::vector<double> diagonal_;

    /** K with the mask of the last build cut off. */
    la::Matrix truncated_;
    Mask built_mask_;
    std::vector<std::uint8_t> cut_; ///< held unknowns of truncated_
    bool is_plain_ = false;         ///< built on K itself: nothing held, no D
    PreconditionerKeeper keeper_{1. / 3.};
    SolverChoice choice_;
    std::unique_ptr<Multigrid> amg_;
    std::unique_ptr<GeometricMultigrid> geometric_;
    std::unique_ptr<DirectSolver> direct_;
  };

} // namespace abut::solve

#endif
