// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nitsche_solver.h"

#include "direct_solver.h"
#include "failures.h"

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_gmres.h>

namespace abut::solve
{
  using dealii::types::global_dof_index;

  namespace
  {
    /** A vector over few unknowns: a row of B + factor S. */
    struct Line
    {
      std::vector<global_dof_index> column;
      std::vector<double> value;

      void take(const PointOperator &rows, const int i, const double factor)
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

    /** Springs of this method are never so stiff that they need a filter. */
    SolverParameters unfiltered(SolverParameters parameters)
    {
      parameters.contact_filter = false;
      return parameters;
    }

    /** Visit the lines of factor * test trial^T. */
    template <typename Visit>
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
    model_.set_near_null_space(space);
  }

  void NitscheSolver::reinit(const la::Matrix &stiffness,
                             const PointOperator &rows,
                             const std::vector<double> &row_stiffness)
  {
    stiffness_ = &stiffness;
    rows_ = &rows;
    model_.reinit(stiffness, rows, row_stiffness);
  }

  void NitscheSolver::renew(const la::Matrix &stiffness,
                            const PointOperator &rows,
                            const std::vector<double> &row_stiffness)
  {
    stiffness_ = &stiffness;
    rows_ = &rows;
    model_.renew(stiffness, rows, row_stiffness);
  }

  la::Vector NitscheSolver::right_hand_side(const la::Vector &residual) const
  {
    la::Vector result(residual);
    result *= -1.;
    std::vector<double> couple(rows_->n_rows());
    for (int i = 0; i < rows_->n_rows(); ++i)
      couple[i] =
          terms_.theta * terms_.compliance[i]
          * (local_.force()[i] + rows_->weight(i) * terms_.normal_stress[i]);
    rows_->add_transposed(local_.force().data(), result);
    terms_.stress.add_transposed(couple.data(), result);
    return result;
  }

  la::Matrix NitscheSolver::assemble() const
  {
    const std::vector<double> &spring = local_.spring();
    dealii::IndexSet ghosts = rows_->ghosts();
    ghosts.add_indices(terms_.stress.ghosts());
    return la::sum(
        *stiffness_,
        la::assemble(rows_->owned(), ghosts, rows_->communicator(),
                     [&](const auto &visit)
                     {
                       for (int i = 0; i < rows_->n_rows(); ++i)
                       {
                         const double c = terms_.compliance[i];
                         Line test, trial, stress;
                         test.take(*rows_, i, 1.);
                         test.take(terms_.stress, i, terms_.theta * c);
                         trial.take(*rows_, i, 1.);
                         trial.take(terms_.stress, i, c);
                         stress.take(terms_.stress, i, 1.);
                         if (spring[i] != 0.)
                           visit_product(spring[i], test, trial, visit);
                         if (terms_.theta != 0.)
                           visit_product(-terms_.theta * rows_->weight(i) * c,
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
    report.setup_seconds +=
        model_
            .prepare({local_.spring(), std::vector<std::int64_t>(
                                           rows_->n_rows(), Condensate::none)})
            .setup_seconds;
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
    const la::Vector rhs = right_hand_side(residual);
    const la::Matrix matrix = assemble();
    const double norm = rhs.l2_norm();
    const double tolerance =
        std::max(request.linear_tolerance * norm, smallest_residual);
    increment = 0.;
    report.n_setups = 1;
    report.setup_seconds = timer.wall_time();
    report.method = is_direct() ? DirectSolver::name() : "FGMRES, ML";
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
