// SPDX-License-Identifier: LGPL-2.1-or-later
#include "condensate_solver.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>

namespace abut::solve
{
  void CondensateSolver::set_stiffness(const Stiffness &stiffness,
                                       const PointOperator &rows)
  {
    rows_ = &rows;
    diagonal_ = stiffness.diagonal();
    is_symmetric_ = stiffness.is_symmetric();
    matrix_.reinit(stiffness, rows);
  }

  std::vector<double> CondensateSolver::softness() const
  {
    la::Vector springs(rows_->owned(), rows_->communicator());
    rows_->add_squares(matrix_.condensate().stiffness.data(), springs);
    std::vector<double> result(diagonal_.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = diagonal_[i] / (diagonal_[i] + la::data(springs)[i]);
    return result;
  }

  double CondensateSolver::load(const la::Vector &rhs) const
  {
    const std::vector<double> soft = softness();
    la::Vector force(rhs);
    for (std::size_t i = 0; i < soft.size(); ++i)
      la::data(force)[i] *= soft[i] * soft[i];
    return force.l2_norm();
  }

  void CondensateSolver::iterate(const la::Vector &rhs,
                                 dealii::SolverControl &control, la::Vector &x,
                                 LinearReport &report) const
  {
    const auto count = [&]
    {
      report.n_iterations += control.last_step();
      report.n_matvecs += control.last_step();
    };
    try
    {
      if (is_definite())
      {
        dealii::SolverCG<la::Vector> solver(control);
        solver.connect_condition_number_slot(
            [&](const double estimate)
            { report.condition = std::max(report.condition, estimate); });
        solver.solve(matrix_, x, rhs, Cycle(*this));
      }
      else
        dealii::SolverFGMRES<la::Vector>(
            control, dealii::SolverFGMRES<la::Vector>::AdditionalData(60))
            .solve(matrix_, x, rhs, Cycle(*this));
    }
    catch (...)
    {
      count();
      throw;
    }
    count();
  }
} // namespace abut::solve
