// SPDX-License-Identifier: LGPL-2.1-or-later
#include "condensation.h"

#include "condensed_solver.h"
#include "host_solver.h"

#include <cmath>

namespace abut::solve
{
  Condensation::Condensation(const SolverParameters &parameters,
                             const bool has_matrix)
      : parameters_(parameters)
  {
    if (has_matrix)
      solver_ = std::make_unique<CondensedSolver>(parameters);
    else
      solver_ = std::make_unique<HostSolver>(parameters);
  }

  void Condensation::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
    solver_->set_near_null_space(space);
  }

  void Condensation::reinit(const Stiffness &stiffness,
                            const PointOperator &rows,
                            const std::vector<double> &row_stiffness)
  {
    solver_->reinit(stiffness, rows, row_stiffness);
    set_stiffness(stiffness, rows, row_stiffness);
    saddle_point_.reset();
  }

  void Condensation::renew(const Stiffness &stiffness,
                           const PointOperator &rows,
                           const std::vector<double> &row_stiffness)
  {
    solver_->renew(stiffness, rows, row_stiffness);
    set_stiffness(stiffness, rows, row_stiffness);
    if (saddle_point_ != nullptr)
      saddle_point_->renew(stiffness, rows, row_stiffness);
  }

  void Condensation::set_stiffness(const Stiffness &stiffness,
                                   const PointOperator &rows,
                                   const std::vector<double> &row_stiffness)
  {
    stiffness_ = stiffness;
    rows_ = &rows;
    row_stiffness_ = row_stiffness;
  }

  void Condensation::make_saddle_point()
  {
    if (!stiffness_.has_matrix())
      throw SolverFailure("Constraints share all their unknowns: the system is "
                          "a saddle point, which needs a matrix. Give solve() "
                          "a matrix, or use dual multipliers.");
    saddle_point_ = std::make_unique<SaddlePoint>(parameters_);
    saddle_point_->set_near_null_space(space_);
    saddle_point_->reinit(stiffness_, *rows_, row_stiffness_);
  }

  std::vector<PreconditionerState> Condensation::state() const
  {
    std::vector<PreconditionerState> result = {solver_->state()};
    if (saddle_point_ != nullptr)
      for (const PreconditionerState &inner : saddle_point_->state())
        result.push_back(inner);
    return result;
  }

  void Condensation::restore(const std::vector<PreconditionerState> &state)
  {
    solver_->restore(state.at(0));
    if (state.size() == 1)
      return;
    make_saddle_point();
    saddle_point_->restore({state[1]});
  }

  bool Condensation::condense()
  {
    if (!local_.blocks().empty())
      return choose_pivots(*rows_, local_, condensate_);
    condensate_ = Condensate();
    condensate_.stiffness = local_.spring();
    return choose_pivots(*rows_, local_.held(), condensate_.pivot);
  }

  la::Vector Condensation::lift() const
  {
    la::Vector result(rows_->owned(), rows_->communicator());
    double *const values = la::data(result);
    const RowBlocks &blocks = condensate_.blocks;
    for (int block = 0; !blocks.empty() && block < blocks.n_blocks(); ++block)
      for (int r = 0, k = blocks.size(block); r < k; ++r)
      {
        const int i = blocks.first[block] + r;
        for (int h = 0; h < k && local_.is_held(i); ++h)
          values[rows_->column(condensate_.pivot[i])] +=
              condensate_.trial[blocks.at[block] + r * k + h]
              * local_.value()[blocks.first[block] + h];
      }
    for (int i = 0; blocks.empty() && i < rows_->n_rows(); ++i)
      if (local_.is_held(i))
      {
        const std::int64_t pivot = condensate_.pivot[i];
        values[rows_->column(pivot)] =
            local_.value()[i] / rows_->coefficient(pivot);
      }
    return result;
  }

  la::Vector Condensation::right_hand_side(const la::Vector &residual,
                                           const la::Vector &lift) const
  {
    la::Vector result(residual);
    solver_->matrix().multiply_whole(result, lift);
    result.add(1., residual);
    result *= -1.;
    rows_->add_transposed(local_.force().data(), result);
    solver_->matrix().restrict(result);
    return result;
  }

  void Condensation::add_spring_forces(const abut_request &request,
                                       la::Vector &reaction) const
  {
    std::vector<double> force(rows_->n_rows(), 0.);
    if (local_.blocks().empty())
    {
      for (int i = 0; i < rows_->n_rows(); ++i)
        if (!local_.is_held(i))
          force[i] = -rows_->weight(i)
                     * (request.pressure[i] + request.pressure_change[i]);
    }
    else
    {
      // The part that does not depend on the pressures of constraints, which
      // are not known yet.
      force.assign(request.gap_change, request.gap_change + rows_->n_rows());
      solver_->matrix().apply_springs(force);
      for (int i = 0; i < rows_->n_rows(); ++i)
        force[i] -= local_.force()[i];
    }
    rows_->add_transposed(force.data(), reaction);
  }

  void Condensation::recover_held(const la::Vector &reaction,
                                  const abut_request &request) const
  {
    // The reaction at the pivots is the force of their rows.
    const double *const values = la::data(reaction);
    const RowBlocks &blocks = condensate_.blocks;
    for (int block = 0; !blocks.empty() && block < blocks.n_blocks(); ++block)
      for (int h = 0, k = blocks.size(block); h < k; ++h)
      {
        const int i = blocks.first[block] + h;
        if (!local_.is_held(i))
          continue;
        double sum = 0.;
        for (int r = 0; r < k; ++r)
          if (local_.is_held(blocks.first[block] + r))
            sum += condensate_.test[blocks.at[block] + r * k + h]
                   * values[rows_->column(
                       condensate_.pivot[blocks.first[block] + r])];
        request.pressure_change[i] =
            sum / rows_->weight(i) - request.pressure[i];
      }
    for (int i = 0; blocks.empty() && i < rows_->n_rows(); ++i)
      if (local_.is_held(i))
      {
        const std::int64_t pivot = condensate_.pivot[i];
        request.pressure_change[i] =
            values[rows_->column(pivot)]
                / (rows_->weight(i) * rows_->coefficient(pivot))
            - request.pressure[i];
      }
  }

  void Condensation::recover(const la::Vector &residual,
                             const abut_request &request,
                             const la::Vector &increment) const
  {
    rows_->times(increment, request.gap_change);
    const bool has_blocks = !local_.blocks().empty();
    if (!has_blocks)
      local_.recover(request);
    la::Vector reaction(residual);
    stiffness_.vmult(reaction, increment);
    reaction.add(1., residual);
    add_spring_forces(request, reaction);
    recover_held(reaction, request);
    // Tractions of slipping points follow from the pressures.
    if (has_blocks)
      local_.recover(request);
  }

  LinearReport Condensation::solve(const la::Vector &residual,
                                   const abut_request &request,
                                   const double smallest_residual,
                                   la::Vector &increment)
  {
    local_.reinit(request, rows_->n_rows(), rows_->weights(),
                  rows_->communicator());
    if (!condense())
    {
      if (saddle_point_ == nullptr)
        make_saddle_point();
      LinearReport report =
          saddle_point_->solve(residual, request, smallest_residual, increment);
      report.method += " (constraints share all their unknowns)";
      return report;
    }
    LinearReport report = solver_->prepare(condensate_);
    const la::Vector start = lift();
    const la::Vector rhs = right_hand_side(residual, start);
    const double tolerance = std::max(
        request.linear_tolerance * solver_->load(rhs), smallest_residual);
    report += solver_->solve(rhs, tolerance, increment);
    solver_->matrix().expand(increment);
    increment.add(1., start);
    recover(residual, request, increment);
    report.n_matvecs += 2;
    return report;
  }
} // namespace abut::solve
