// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nitsche_solver.h"

#include "direct_solver.h"
#include "failures.h"
#include "multigrid.h"

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

      void take(const RowOperator &rows, const int i, const double factor)
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
      : parameters_(parameters), terms_(terms)
  {
  }

  void NitscheSolver::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
  }

  void NitscheSolver::reinit(const la::Matrix &stiffness,
                             const abut_rows_view &rows)
  {
    stiffness_ = &stiffness;
    rows_ = RowOperator(stiffness.locally_owned_range_indices(), rows,
                        stiffness.get_mpi_communicator());
  }

  la::Vector NitscheSolver::right_hand_side(const la::Vector &residual,
                                            const abut_request &request) const
  {
    la::Vector result(residual);
    result *= -1.;
    const int n = rows_.n_rows();
    std::vector<double> force(n), couple(n);
    for (int i = 0; i < n; ++i)
    {
      force[i] =
          rows_.weight(i)
          * (request.pressure[i] - request.residual[i] / request.d_pressure[i]);
      couple[i] = terms_.theta * terms_.compliance[i]
                  * (force[i] + rows_.weight(i) * terms_.normal_stress[i]);
    }
    rows_.add_transposed(force.data(), result);
    terms_.stress.add_transposed(couple.data(), result);
    return result;
  }

  la::Matrix NitscheSolver::assemble(const std::vector<double> &spring) const
  {
    dealii::IndexSet ghosts = rows_.ghosts();
    ghosts.add_indices(terms_.stress.ghosts());
    return la::sum(
        *stiffness_,
        la::assemble(rows_.owned(), ghosts, rows_.communicator(),
                     [&](const auto &visit)
                     {
                       for (int i = 0; i < rows_.n_rows(); ++i)
                       {
                         const double c = terms_.compliance[i];
                         Line test, trial, stress;
                         test.take(rows_, i, 1.);
                         test.take(terms_.stress, i, terms_.theta * c);
                         trial.take(rows_, i, 1.);
                         trial.take(terms_.stress, i, c);
                         stress.take(terms_.stress, i, 1.);
                         if (spring[i] != 0.)
                           visit_product(spring[i], test, trial, visit);
                         if (terms_.theta != 0.)
                           visit_product(-terms_.theta * rows_.weight(i) * c,
                                         stress, stress, visit);
                       }
                     }));
  }

  la::Matrix
  NitscheSolver::assemble_model(const std::vector<double> &spring) const
  {
    return la::sum(
        *stiffness_,
        la::assemble(rows_.owned(), rows_.ghosts(), rows_.communicator(),
                     [&](const auto &visit)
                     {
                       for (int i = 0; i < rows_.n_rows(); ++i)
                       {
                         Line line;
                         line.take(rows_, i, 1.);
                         if (spring[i] != 0.)
                           visit_product(spring[i], line, line, visit);
                       }
                     }));
  }

  bool NitscheSolver::is_direct() const
  {
    return parameters_.is_direct(stiffness_->m(), space_.n_components);
  }

  void NitscheSolver::iterate(const la::Matrix &matrix,
                              const std::vector<double> &spring,
                              const la::Vector &rhs, const double tolerance,
                              la::Vector &x, LinearReport &report) const
  {
    // Multigrid needs a symmetric positive definite model of the matrix.
    const dealii::Timer timer;
    const la::Matrix model = assemble_model(spring);
    const auto multigrid = make_multigrid(model, parameters_, space_);
    report.setup_seconds += timer.wall_time();
    dealii::SolverControl control(parameters_.max_iterations, tolerance);
    dealii::SolverFGMRES<la::Vector> solver(
        control, dealii::SolverFGMRES<la::Vector>::AdditionalData(60));
    try
    {
      solver.solve(matrix, x, rhs, *multigrid);
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
    std::vector<double> change(rows_.n_rows());
    rows_.times(increment, request.gap_change);
    terms_.stress.times(increment, change.data());
    for (int i = 0; i < rows_.n_rows(); ++i)
    {
      request.gap_change[i] += terms_.compliance[i] * change[i];
      request.pressure_change[i] =
          -(request.residual[i] + request.d_gap[i] * request.gap_change[i])
          / request.d_pressure[i];
    }
  }

  LinearReport NitscheSolver::solve(const la::Vector &residual,
                                    const abut_request &request,
                                    const double smallest_residual,
                                    la::Vector &increment)
  {
    LinearReport report;
    const dealii::Timer timer;
    const la::Vector rhs = right_hand_side(residual, request);
    std::vector<double> spring(rows_.n_rows());
    for (int i = 0; i < rows_.n_rows(); ++i)
      spring[i] = rows_.weight(i) * request.d_gap[i] / request.d_pressure[i];
    const la::Matrix matrix = assemble(spring);
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
      iterate(matrix, spring, rhs, tolerance, increment, report);
    recover(request, increment);
    report.solve_seconds = timer.wall_time() - report.setup_seconds;
    return report;
  }
} // namespace abut::solve
