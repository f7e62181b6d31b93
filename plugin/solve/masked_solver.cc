/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "masked_solver.h"

#include "failures.h"
#include "kept_parts.h"
#include "multigrid.h"

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace abut::solve
{
  namespace
  {
    /** No residual falls below this part of the first one. */
    constexpr double round_off = 1e-15;

    void zero_held(const Mask &mask, la::Vector &vector)
    {
      double *values = la::data(vector);
      for (std::size_t i = 0; i < mask.held.size(); ++i)
        if (mask.held[i])
          values[i] = 0.;
    }

    double added(const Mask &mask, const std::size_t i)
    {
      return mask.diagonal.empty() ? 0. : mask.diagonal[i];
    }
  } // namespace

  MaskedSolver::MaskedSolver(const SolverParameters &parameters)
      : parameters_(parameters), choice_(parameters)
  {
  }

  MaskedSolver::~MaskedSolver()
  {
    if (geometric_ != nullptr)
      space_.kept->geometric = std::move(geometric_);
  }

  void MaskedSolver::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
  }

  void MaskedSolver::reinit(const la::Matrix &matrix)
  {
    set_stiffness(matrix);
    keeper_.forget();
    amg_.reset();
    if (geometric_ != nullptr)
      space_.kept->geometric = std::move(geometric_);
    direct_.reset();
  }

  void MaskedSolver::set_stiffness(const la::Matrix &matrix)
  {
    matrix_ = &matrix;
    diagonal_ = la::diagonal(la::local_rows(matrix));
    choice_.choose(matrix, space_);
  }

  void MaskedSolver::renew(const la::Matrix &matrix)
  {
    if (&matrix != matrix_ || !keeper_.is_built() || is_direct()
        || choice_.is_geometric())
    {
      reinit(matrix);
      return;
    }
    diagonal_ = la::diagonal(la::local_rows(matrix));
    if (!is_plain_)
      cut_off(cut_, built_mask_, true);
  }

  bool MaskedSolver::is_direct() const
  {
    return choice_.is_direct();
  }

  bool MaskedSolver::is_plain(const Mask &mask) const
  {
    const bool has_held =
        std::find(mask.held.begin(), mask.held.end(), 1) != mask.held.end();
    return !dealii::Utilities::MPI::logical_or(
        has_held || !mask.diagonal.empty(), matrix_->get_mpi_communicator());
  }

  bool MaskedSolver::is_outdated(const Mask &mask) const
  {
    if (choice_.is_geometric())
      return geometric_ == nullptr;
    if (keeper_.must_build())
      return true;
    double n_changed = 0.;
    for (std::size_t i = 0; i < mask.held.size(); ++i)
    {
      if (mask.held[i] || built_mask_.held[i])
      {
        n_changed += mask.held[i] != built_mask_.held[i];
        continue;
      }
      const double ratio = (diagonal_[i] + added(mask, i))
                           / (diagonal_[i] + added(built_mask_, i));
      n_changed += PreconditionerKeeper::is_change(ratio, is_direct());
    }
    return PreconditionerKeeper::are_too_many(
        n_changed, static_cast<double>(mask.held.size()), is_direct(),
        matrix_->get_mpi_communicator());
  }

  void MaskedSolver::cut_off(const std::vector<std::uint8_t> &held,
                             const Mask &mask, const bool everything)
  {
    // 1: held; 2: changed since the last call.
    la::Vector flags(la::owned_rows(*matrix_), matrix_->get_mpi_communicator());
    double *flag = la::data(flags);
    for (std::size_t i = 0; i < held.size(); ++i)
      flag[i] = held[i] + (everything || held[i] != cut_[i] ? 2. : 0.);
    const std::vector<double> column_flag = la::gather(*matrix_, flags);
    std::vector<std::uint8_t> state(column_flag.begin(), column_flag.end());

    const la::LocalRows from = la::local_rows(*matrix_);
    const la::LocalRows to = la::local_rows(truncated_);
    for (int i = 0; i < to.n_rows; ++i)
    {
      std::uint8_t any = 0;
      for (int k = to.start[i]; k < to.start[i + 1]; ++k)
        any |= state[to.column[k]];
      if ((any & 2) == 0)
        continue;
      for (int k = to.start[i]; k < to.start[i + 1]; ++k)
      {
        const int j = to.column[k];
        const bool cut = ((state[i] | state[j]) & 1) != 0 && j != i;
        to.value[k] = cut ? 0. : from.value[k];
        if (j == i)
          to.value[k] += added(mask, i);
      }
    }
    cut_ = held;
  }

  void MaskedSolver::build(const Mask &mask)
  {
    built_mask_ = mask;
    keeper_.record_build();
    if (choice_.is_geometric())
    {
      geometric_ = std::move(space_.kept->geometric);
      if (dealii::Utilities::MPI::logical_or(
              geometric_ == nullptr || !geometric_->knows(*matrix_, {}),
              matrix_->get_mpi_communicator()))
        geometric_ =
            std::make_unique<GeometricMultigrid>(*matrix_, *space_.meshes);
      else
      {
        LocalMatrix none;
        geometric_->renew_matrix(*matrix_);
        geometric_->set_terms(none);
      }
      geometric_->set_constrained(mask.held, mask.diagonal);
      cut_ = mask.held;
      return;
    }
    is_plain_ = is_plain(mask);
    if (!is_plain_)
    {
      la::copy(*matrix_, truncated_);
      cut_off(mask.held, mask, true);
    }
    const la::Matrix &system = is_plain_ ? *matrix_ : truncated_;
    if (is_direct())
      direct_ = std::make_unique<DirectSolver>(system);
    else
      amg_ = make_multigrid(system, parameters_, space_);
  }

  double MaskedSolver::load(const Mask &mask, const la::Vector &rhs) const
  {
    la::Vector force(rhs);
    zero_held(mask, force);
    double *values = la::data(force);
    for (std::size_t i = 0; i < mask.diagonal.size(); ++i)
    {
      const double softness = diagonal_[i] / (diagonal_[i] + mask.diagonal[i]);
      values[i] *= softness * softness;
    }
    return force.l2_norm();
  }

  ScaledPreconditioner
  MaskedSolver::preconditioner(const Mask &mask, const la::Vector &model) const
  {
    if (choice_.is_geometric())
      return ScaledPreconditioner(*geometric_, mask, {}, model);
    if (mask.diagonal.empty() && built_mask_.diagonal.empty())
      return ScaledPreconditioner(*amg_, mask, {}, model);
    std::vector<double> scaling(mask.held.size());
    for (std::size_t i = 0; i < scaling.size(); ++i)
      scaling[i] = mask.held[i]
                       ? 0.
                       : std::sqrt((diagonal_[i] + added(built_mask_, i))
                                   / (diagonal_[i] + added(mask, i)));
    return ScaledPreconditioner(*amg_, mask, std::move(scaling), model);
  }

  bool MaskedSolver::iterate(const Mask &mask, const la::Vector &residual,
                             const double tolerance,
                             const unsigned int max_iterations,
                             la::Vector &correction, LinearReport &report,
                             unsigned int &n_iterations)
  {
    const MaskedOperator matrix(*matrix_, mask);
    dealii::SolverControl control(max_iterations, tolerance, false, false);
    dealii::SolverCG<la::Vector> cg(control);
    cg.connect_condition_number_slot(
        [&](const double estimate)
        { report.condition = std::max(report.condition, estimate); });
    bool converged = true;
    try
    {
      cg.solve(matrix, correction, residual, preconditioner(mask, residual));
    }
    catch (const dealii::SolverControl::NoConvergence &failure)
    {
      converged = false;
      if (!choice_.may_give_up())
        throw_failure("Conjugate gradients", failure, tolerance);
    }
    n_iterations = control.last_step();
    report.n_iterations += n_iterations;
    report.n_matvecs += n_iterations;
    return converged;
  }

  void MaskedSolver::solve_iteratively(const Mask &mask,
                                       const la::Vector &residual,
                                       const double tolerance,
                                       la::Vector &correction,
                                       LinearReport &report)
  {
    const double digits = std::log10(residual.l2_norm() / tolerance);
    unsigned int n_iterations = 0;
    while (!iterate(mask, residual, tolerance, choice_.patience(digits),
                    correction, report, n_iterations))
    {
      const dealii::Timer timer;
      choice_.give_up(n_iterations);
      geometric_.reset();
      build(mask);
      report.method = method();
      ++report.n_setups;
      report.setup_seconds += timer.wall_time();
      correction = 0.;
      if (!is_direct())
        continue;
      direct_->solve(correction, residual);
      return;
    }
    keeper_.record_speed(digits, n_iterations);
  }

  PreconditionerState MaskedSolver::state() const
  {
    return {keeper_, built_mask_.diagonal, {}, built_mask_.held, cut_};
  }

  void MaskedSolver::restore(const PreconditionerState &state)
  {
    if (!state.keeper.is_built())
      return;
    build({state.held, state.stiffness});
    if (!choice_.is_geometric() && !is_direct() && !is_plain_)
      cut_off(state.cut, built_mask_, false);
    keeper_.restore(state.keeper);
  }

  LinearReport MaskedSolver::prepare(const Mask &mask)
  {
    LinearReport report;
    if (choice_.is_geometric() && geometric_ != nullptr)
    {
      const dealii::Timer timer;
      geometric_->set_constrained(mask.held, mask.diagonal);
      built_mask_ = mask;
      cut_ = mask.held;
      report.setup_seconds = timer.wall_time();
    }
    else if (is_outdated(mask) || (is_plain_ && !is_plain(mask)))
    {
      const dealii::Timer timer;
      build(mask);
      ++report.n_setups;
      report.setup_seconds = timer.wall_time();
    }
    else if (!is_direct() && !is_plain_)
    {
      const bool changed = dealii::Utilities::MPI::logical_or(
          mask.held != cut_, matrix_->get_mpi_communicator());
      if (changed)
        cut_off(mask.held, built_mask_, false);
    }
    report.method = method();
    return report;
  }

  std::string MaskedSolver::method() const
  {
    return is_direct() ? choice_.direct(DirectSolver::name(*matrix_))
                       : "conjugate gradients, " + choice_.preconditioner();
  }

  LinearReport MaskedSolver::solve(const Mask &mask, const la::Vector &rhs,
                                   const double tolerance, la::Vector &x,
                                   const bool start_is_zero)
  {
    LinearReport report = prepare(mask);
    const double prepared = report.setup_seconds;
    const dealii::Timer timer;
    la::Vector residual(rhs);
    if (!start_is_zero)
    {
      matrix_->vmult(residual, x);
      const double *in = la::data(x);
      double *out = la::data(residual);
      for (std::size_t i = 0; i < mask.diagonal.size(); ++i)
        out[i] += mask.diagonal[i] * in[i];
      residual.sadd(-1., 1., rhs);
      ++report.n_matvecs;
    }
    zero_held(mask, residual);

    la::Vector correction(residual);
    correction = 0.;
    const double norm = residual.l2_norm();
    if (norm > tolerance)
    {
      if (is_direct())
        direct_->solve(correction, residual);
      else
      {
        const double reachable = std::max(tolerance, round_off * norm);
        solve_iteratively(mask, residual, reachable, correction, report);
      }
      zero_held(mask, correction);
      x.add(1., correction);
    }
    report.solve_seconds =
        timer.wall_time() - (report.setup_seconds - prepared);
    return report;
  }
} // namespace abut::solve
