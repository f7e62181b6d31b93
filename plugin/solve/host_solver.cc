// SPDX-License-Identifier: LGPL-2.1-or-later
#include "host_solver.h"

#include <abut/dealii/coded.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

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

  void HostSolver::take_host(const Stiffness &stiffness,
                             const PointOperator &rows)
  {
    stiffness_ = stiffness;
    take(stiffness, rows);
    check_diagonal();
    is_symmetric_ = is_symmetric(stiffness);
    scaled_ = stiffness.make_vector();
  }

  void HostSolver::reinit(const Stiffness &stiffness, const PointOperator &rows,
                          const std::vector<double> &)
  {
    take_host(stiffness, rows);
    check_entry();
    check_prescribed();
  }

  void HostSolver::renew(const Stiffness &stiffness, const PointOperator &rows,
                         const std::vector<double> &)
  {
    take_host(stiffness, rows);
  }

  void HostSolver::check_diagonal() const
  {
    // The first on any rank that is wrong.
    const dealii::IndexSet &owned = rows_->owned();
    double first = INFINITY;
    for (std::size_t i = diagonal_.size(); i-- > 0;)
      if (!(diagonal_[i] > 0. && std::isfinite(diagonal_[i])))
        first = static_cast<double>(owned.nth_index_in_set(i));
    first = MPI::min(first, rows_->communicator());
    if (std::isfinite(first))
    {
      std::ostringstream text;
      text << "HostOperator::diagonal() must be positive and finite, that of "
              "constrained unknowns too, and is not at unknown "
           << first << '.';
      throw std::invalid_argument(text.str());
    }
  }

  void HostSolver::check_entry() const
  {
    // Of the first unknown of a row on the first rank that has one.
    constexpr double round_off = 1e-9;
    double first = INFINITY;
    for (int i = 0; i < rows_->n_rows() && std::isinf(first); ++i)
      for (auto e = rows_->begin(i); e < rows_->end(i); ++e)
        if (rows_->column(e) < rows_->n_owned())
        {
          first = static_cast<double>(rows_->global_column(rows_->column(e)));
          break;
        }
    first = MPI::min(first, rows_->communicator());
    if (std::isinf(first))
      return;
    const auto unknown = static_cast<dealii::types::global_dof_index>(first);
    la::Vector unit = stiffness_.make_vector(), force(unit);
    const bool is_here = rows_->owned().is_element(unknown);
    const std::size_t i =
        is_here ? rows_->owned().index_within_set(unknown) : 0;
    if (is_here)
      la::data(unit)[i] = 1.;
    stiffness_.vmult(force, unit);
    double both[2] = {is_here ? diagonal_[i] : 0.,
                      is_here ? la::data(force)[i] : 0.};
    MPI::sum(both, rows_->communicator(), both);
    if (std::abs(both[0] - both[1]) <= round_off * std::abs(both[0]))
      return;
    std::ostringstream text;
    text << "HostOperator::diagonal() has " << both[0] << " at unknown "
         << unknown << ", where vmult() of its unit vector gives " << both[1]
         << ": penalties and tolerances are multiples of the diagonal.";
    throw std::invalid_argument(text.str());
  }

  void HostSolver::check_prescribed() const
  {
    if (!MPI::logical_or(!prescribed_.empty(), rows_->communicator()))
      return;
    check_apart(true, "puts forces on free unknowns by displacements of "
                      "prescribed ones");
    check_apart(false, "puts forces on prescribed unknowns by displacements of "
                       "free ones");
  }

  void HostSolver::check_apart(const bool from_prescribed,
                               const std::string &what) const
  {
    constexpr double round_off = 1e-9;
    la::Vector displacement = noise(stiffness_, 0), force(displacement);
    const auto moves = [&](const std::size_t i) {
      return (!prescribed_.empty() && prescribed_[i] != 0) == from_prescribed;
    };
    for (std::size_t i = 0; i < diagonal_.size(); ++i)
      if (!moves(i))
        la::data(displacement)[i] = 0.;
    stiffness_.vmult(force, displacement);
    double largest = 0.;
    for (std::size_t i = 0; i < diagonal_.size(); ++i)
      if (!moves(i))
        largest =
            std::max(largest, std::abs(la::data(force)[i]) / diagonal_[i]);
    if (MPI::max(largest, rows_->communicator()) > round_off)
      throw std::invalid_argument(
          "HostOperator::vmult() " + what
          + ". Leave no more than the diagonal in rows and columns of unknowns "
            "that the constraints eliminate.");
  }

  bool HostSolver::is_definite() const
  {
    return is_symmetric_ && !matrix_.has_blocks();
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
    stiffness_.host().hold(held);
    report.method =
        std::string(is_definite() ? "conjugate gradients" : "FGMRES")
        + ", preconditioner of the host";
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

  std::string HostSolver::faults() const
  {
    constexpr double round_off = 1e-8;
    const la::Vector x = noise(stiffness_, 0), y = noise(stiffness_, 1);
    la::Vector mx(x), my(y), again(x);
    const HostOperator &host = stiffness_.host();
    host.precondition(mx, x);
    host.precondition(my, y);
    host.precondition(again, x);
    const double size = x.l2_norm() * my.l2_norm();
    const double forth = x * my, back = y * mx, energy = x * mx;
    again -= mx;
    std::ostringstream text;
    if (!std::isfinite(size))
      text << " precondition() gives values that are not finite.";
    else if (again.l2_norm() > round_off * mx.l2_norm())
      text << " precondition() gives something else each time.";
    else if (std::abs(forth - back) > round_off * size)
      text << " precondition() is not symmetric: x.My = " << forth
           << ", y.Mx = " << back << " for two vectors without structure.";
    else if (energy <= 0.)
      text << " precondition() is not positive: x.Mx = " << energy << '.';
    if (!is_symmetric_)
      text << " vmult() is not symmetric.";
    return text.str();
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
      if (is_definite())
      {
        dealii::SolverCG<la::Vector> solver(control);
        solver.connect_condition_number_slot([&](const double estimate)
                                             { report.condition = estimate; });
        solver.solve(matrix_, x, rhs, Cycle(*this));
      }
      else
        dealii::SolverFGMRES<la::Vector>(
            control, dealii::SolverFGMRES<la::Vector>::AdditionalData(60))
            .solve(matrix_, x, rhs, Cycle(*this));
    }
    catch (const dealii::SolverControl::NoConvergence &failure)
    {
      std::ostringstream text;
      text << (is_definite() ? "Conjugate gradients" : "FGMRES")
           << " with the preconditioner of the program ended after "
           << failure.last_step << " iterations with a residual of "
           << failure.last_residual << " where " << tolerance
           << " was asked for." << faults()
           << " Try more Solver/Maximum iterations, or give a matrix.";
      throw SolverFailure(coded(std::isfinite(failure.last_residual)
                                    ? ABUT_FAILURE_LINEAR_SOLVER
                                    : ABUT_FAILURE_NOT_FINITE,
                                text.str()));
    }
    report.n_iterations = control.last_step();
    report.n_matvecs = control.last_step();
    report.solve_seconds = timer.wall_time();
    return report;
  }
} // namespace abut::solve
