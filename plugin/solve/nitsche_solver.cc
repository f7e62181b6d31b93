// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nitsche_solver.h"

#include "direct_solver.h"
#include "failures.h"

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_gmres.h>

namespace abut::solve
{
  using dealii::types::global_dof_index;

  /** A vector over few unknowns: a row of B + factor S. */
  struct NitscheSolver::Line
  {
    std::vector<global_dof_index> column;
    std::vector<double> value;

    void add_row(const PointOperator &rows, const int i, const double factor)
    {
      if (factor == 0.)
        return;
      for (auto e = rows.begin(i); e < rows.end(i); ++e)
      {
        column.push_back(rows.global_column(rows.column(e)));
        value.push_back(factor * rows.coefficient(e));
      }
    }
  };

  namespace
  {
    /** Springs of this method are never so stiff that they need a filter. */
    SolverParameters unfiltered(SolverParameters parameters)
    {
      parameters.contact_filter = false;
      return parameters;
    }

    /** Visit the lines of factor * test trial^T. */
    template <typename Line, typename Visit>
    void visit_product(const double factor, const Line &test, const Line &trial,
                       const Visit &visit)
    {
      std::vector<double> values(trial.value.size());
      for (std::size_t i = 0; i < test.column.size(); ++i)
      {
        for (std::size_t j = 0; j < values.size(); ++j)
          values[j] = factor * test.value[i] * trial.value[j];
        visit(test.column[i], trial.column, values);
      }
    }

    /** Call function(row, other, force per length) for all springs, which with
     * friction couple the rows of a point. */
    template <typename Function>
    void for_each_spring(const LocalElimination &local, const int n_rows,
                         const Function &function)
    {
      const RowBlocks &blocks = local.blocks();
      for (int i = 0; blocks.empty() && i < n_rows; ++i)
        if (local.spring()[i] != 0.)
          function(i, i, local.spring()[i]);
      for (int b = 0; !blocks.empty() && b < blocks.n_blocks(); ++b)
        for (int r = 0, k = blocks.size(b); r < k; ++r)
          for (int c = 0; c < k; ++c)
            if (const double spring =
                    local.spring_blocks()[blocks.at[b] + r * k + c];
                spring != 0.)
              function(blocks.first[b] + r, blocks.first[b] + c, spring);
    }
  } // namespace

  NitscheSolver::NitscheSolver(const SolverParameters &parameters,
                               const NitscheTerms &terms)
      : parameters_(parameters),
        terms_(terms),
        model_(unfiltered(parameters), PreconditionerKeeper::never())
  {
  }

  void NitscheSolver::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
    model_.set_near_null_space(space);
  }

  void NitscheSolver::find_unsupported_bodies()
  {
    // Rigid motions have no stress: what resists them is what does elsewhere.
    if (dealii::Utilities::MPI::logical_or(rows_->has_tangents(),
                                           rows_->communicator()))
      unsupported_.reinit(*stiffness_, *rows_, space_);
  }

  void NitscheSolver::reinit(const Stiffness &stiffness,
                             const PointOperator &rows,
                             const std::vector<double> &row_stiffness)
  {
    stiffness_ = &stiffness.matrix();
    rows_ = &rows;
    model_.reinit(stiffness, rows, row_stiffness);
    find_unsupported_bodies();
  }

  void NitscheSolver::renew(const Stiffness &stiffness,
                            const PointOperator &rows,
                            const std::vector<double> &row_stiffness)
  {
    stiffness_ = &stiffness.matrix();
    rows_ = &rows;
    model_.renew(stiffness, rows, row_stiffness);
    find_unsupported_bodies();
  }

  la::Vector NitscheSolver::right_hand_side(const la::Vector &residual) const
  {
    la::Vector result(residual);
    result *= -1.;
    std::vector<double> couple(rows_->n_rows());
    for (int i = 0; i < rows_->n_rows(); ++i)
      couple[i] = terms_.theta * terms_.compliance[i]
                  * (local_.force()[i] + rows_->weight(i) * terms_.present[i]);
    rows_->add_transposed(local_.force().data(), result);
    terms_.stress.add_transposed(couple.data(), result);
    return result;
  }

  NitscheSolver::Line NitscheSolver::line(const int row,
                                          const double part) const
  {
    Line result;
    result.add_row(*rows_, row, 1.);
    result.add_row(terms_.stress, row, part * terms_.compliance[row]);
    return result;
  }

  Condensate NitscheSolver::springs() const
  {
    Condensate result(local_.spring(), std::vector<std::int64_t>(
                                           rows_->n_rows(), Condensate::none));
    if (!local_.blocks().empty())
      choose_pivots(*rows_, local_, result);
    return result;
  }

  la::Matrix NitscheSolver::assemble() const
  {
    dealii::IndexSet ghosts = rows_->ghosts();
    ghosts.add_indices(terms_.stress.ghosts());
    return la::sum(
        *stiffness_,
        la::assemble(rows_->owned(), ghosts, rows_->communicator(),
                     [&](const auto &visit)
                     {
                       for_each_spring(
                           local_, rows_->n_rows(),
                           [&](const int i, const int j, const double spring) {
                             visit_product(spring, line(i, terms_.theta),
                                           line(j, 1.), visit);
                           });
                       for (int i = 0;
                            terms_.theta != 0. && i < rows_->n_rows(); ++i)
                       {
                         Line stress;
                         stress.add_row(terms_.stress, i, 1.);
                         visit_product(-terms_.theta * rows_->weight(i)
                                           * terms_.compliance[i],
                                       stress, stress, visit);
                       }
                     }));
  }

  bool NitscheSolver::is_direct() const
  {
    return model_.is_direct();
  }

  void NitscheSolver::iterate(const la::Matrix &matrix, const la::Vector &rhs,
                              const double tolerance, la::Vector &x,
                              LinearReport &report)
  {
    report.setup_seconds += model_.prepare(springs()).setup_seconds;
    dealii::SolverControl control(parameters_.max_iterations, tolerance);
    dealii::SolverFGMRES<la::Vector> solver(
        control, dealii::SolverFGMRES<la::Vector>::AdditionalData(60));
    try
    {
      solver.solve(matrix, x, rhs, Cycle(model_));
    }
    catch (const dealii::SolverControl::NoConvergence &failure)
    {
      throw_failure("FGMRES", failure, tolerance);
    }
    report.n_iterations += control.last_step();
    report.n_matvecs += control.last_step();
  }

  void NitscheSolver::recover(const abut_request &request,
                              const la::Vector &increment) const
  {
    std::vector<double> change(rows_->n_rows());
    rows_->times(increment, request.gap_change);
    terms_.stress.times(increment, change.data());
    for (int i = 0; i < rows_->n_rows(); ++i)
      request.gap_change[i] += terms_.compliance[i] * change[i];
    local_.recover(request);
  }

  LinearReport NitscheSolver::solve(const la::Vector &residual,
                                    const abut_request &request,
                                    const double smallest_residual,
                                    la::Vector &increment)
  {
    LinearReport report;
    const dealii::Timer timer;
    local_.reinit(request, rows_->n_rows(), rows_->weights(),
                  rows_->communicator());
    if (!local_.blocks().empty())
      unsupported_.check(*rows_, local_, request, model_.row_stiffness());
    const la::Vector rhs = right_hand_side(residual);
    const la::Matrix matrix = assemble();
    const double norm = rhs.l2_norm();
    const double tolerance =
        std::max(request.linear_tolerance * norm, smallest_residual);
    increment = 0.;
    report.n_setups = 1;
    report.setup_seconds = timer.wall_time();
    report.method = is_direct() ? DirectSolver::name(matrix)
                                : "FGMRES, algebraic multigrid";
    if (norm > tolerance && is_direct())
    {
      DirectSolver(matrix).solve(increment, rhs);
      la::Vector rest(rhs);
      matrix.vmult(rest, increment);
      rest -= rhs;
      check_direct_solution(norm, rest.l2_norm());
      ++report.n_matvecs;
    }
    else if (norm > tolerance)
      iterate(matrix, rhs, tolerance, increment, report);
    recover(request, increment);
    report.solve_seconds = timer.wall_time() - report.setup_seconds;
    return report;
  }
} // namespace abut::solve
