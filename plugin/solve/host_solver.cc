// SPDX-License-Identifier: LGPL-2.1-or-later
#include "host_solver.h"

#include "host_checks.h"

#include <abut/dealii/coded.h>

#include <deal.II/base/timer.h>

#include <cmath>
#include <sstream>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  HostSolver::HostSolver(const SolverParameters &parameters)
      : parameters_(parameters)
  {
  }

  void HostSolver::set_near_null_space(const NearNullSpace &space)
  {
    prescribed_ = space.prescribed;
  }

  void HostSolver::set_host(const Stiffness &stiffness,
                            const PointOperator &rows)
  {
    stiffness_ = stiffness;
    set_stiffness(stiffness, rows);
    check_diagonal(stiffness, diagonal_);
    scaled_ = stiffness.make_vector();
  }

  void HostSolver::reinit(const Stiffness &stiffness, const PointOperator &rows,
                          const std::vector<double> &)
  {
    set_host(stiffness, rows);
    check_entry(stiffness, diagonal_, rows);
    if (MPI::logical_or(!prescribed_.empty(), rows.communicator()))
      check_prescribed(stiffness, diagonal_, prescribed_);
  }

  void HostSolver::renew(const Stiffness &stiffness, const PointOperator &rows,
                         const std::vector<double> &)
  {
    set_host(stiffness, rows);
  }

  LinearReport HostSolver::prepare(const Condensate &condensate)
  {
    LinearReport report;
    const dealii::Timer timer;
    matrix_.set(condensate);
    scaling_ = softness();
    for (double &s : scaling_)
      s = std::sqrt(s);
    std::vector<std::uint8_t> held(diagonal_.size(), 0);
    for (int i = 0; i < rows_->n_rows(); ++i)
    {
      const std::int64_t pivot = condensate.pivot[i];
      if (pivot == Condensate::none)
        continue;
      scaling_[rows_->column(pivot)] = 0.;
      if (rows_->end(i) - rows_->begin(i) == 1)
        held[rows_->column(pivot)] = 1;
    }
    stiffness_.host().constrain(held);
    report.method = krylov_method() + ", preconditioner of the host";
    report.setup_seconds = timer.wall_time();
    return report;
  }

  void HostSolver::precondition(la::Vector &dst, const la::Vector &src) const
  {
    for (std::size_t i = 0; i < scaling_.size(); ++i)
      la::data(scaled_)[i] = scaling_[i] * la::data(src)[i];
    stiffness_.host().precondition(dst, scaled_);
    for (std::size_t i = 0; i < scaling_.size(); ++i)
      la::data(dst)[i] *= scaling_[i];
  }

  LinearReport HostSolver::solve(const la::Vector &rhs, const double tolerance,
                                 la::Vector &x)
  {
    LinearReport report;
    const dealii::Timer timer;
    x = 0.;
    dealii::SolverControl control(parameters_.max_iterations, tolerance, false,
                                  false);
    try
    {
      iterate(rhs, control, x, report);
    }
    catch (const dealii::SolverControl::NoConvergence &failure)
    {
      std::ostringstream text;
      text << "With the preconditioner of the program, " << krylov_method()
           << " ended after " << failure.last_step
           << " iterations with a residual of " << failure.last_residual
           << " where " << tolerance << " is required."
           << faults(stiffness_, is_symmetric_)
           << " Try more Solver/Maximum iterations, or give a matrix.";
      throw SolverFailure(coded(std::isfinite(failure.last_residual)
                                    ? ABUT_FAILURE_LINEAR_SOLVER
                                    : ABUT_FAILURE_NOT_FINITE,
                                text.str()));
    }
    report.solve_seconds = timer.wall_time();
    return report;
  }
} // namespace abut::solve
