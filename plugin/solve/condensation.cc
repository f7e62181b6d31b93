// SPDX-License-Identifier: LGPL-2.1-or-later
#include "condensation.h"

#include <cmath>

namespace abut::solve
{
  namespace
  {
    bool is_constraint(const abut_request &request, const int i)
    {
      return request.d_pressure[i] == 0.;
    }
  } // namespace

  Condensation::Condensation(const SolverParameters &parameters)
      : parameters_(parameters), solver_(parameters)
  {
  }

  void Condensation::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
    solver_.set_near_null_space(space);
  }

  void Condensation::reinit(const la::Matrix &stiffness,
                            const abut_rows_view &rows)
  {
    stiffness_ = &stiffness;
    view_ = rows;
    rows_ = RowOperator(stiffness.locally_owned_range_indices(), rows,
                        stiffness.get_mpi_communicator());
    solver_.reinit(stiffness, rows_);
    floating_.reinit(stiffness, rows_, space_);
    saddle_point_.reset();
  }

  bool Condensation::condense(const abut_request &request)
  {
    std::vector<std::uint8_t> wanted(rows_.n_rows());
    condensate_.stiffness.assign(rows_.n_rows(), 0.);
    for (int i = 0; i < rows_.n_rows(); ++i)
      if (is_constraint(request, i))
        wanted[i] = 1;
      else
        condensate_.stiffness[i] =
            rows_.weight(i) * request.d_gap[i] / request.d_pressure[i];
    return choose_pivots(rows_, wanted, condensate_.pivot);
  }

  la::Vector Condensation::lift(const abut_request &request) const
  {
    la::Vector result(rows_.owned(), rows_.communicator());
    for (int i = 0; i < rows_.n_rows(); ++i)
      if (is_constraint(request, i))
      {
        const std::int64_t pivot = condensate_.pivot[i];
        la::data(result)[rows_.column(pivot)] =
            -request.residual[i]
            / (request.d_gap[i] * rows_.coefficient(pivot));
      }
    return result;
  }

  la::Vector Condensation::right_hand_side(const la::Vector &residual,
                                           const abut_request &request,
                                           const la::Vector &lift) const
  {
    la::Vector result(residual);
    solver_.matrix().multiply_whole(result, lift);
    result.add(1., residual);
    result *= -1.;
    std::vector<double> force(rows_.n_rows(), 0.);
    for (int i = 0; i < rows_.n_rows(); ++i)
      if (!is_constraint(request, i))
        force[i] = rows_.weight(i)
                   * (request.pressure[i]
                      - request.residual[i] / request.d_pressure[i]);
    rows_.add_transposed(force.data(), result);
    solver_.matrix().restrict(result);
    return result;
  }

  void Condensation::recover(const la::Vector &residual,
                             const abut_request &request,
                             const la::Vector &increment) const
  {
    rows_.times(increment, request.gap_change);
    std::vector<double> force(rows_.n_rows(), 0.);
    for (int i = 0; i < rows_.n_rows(); ++i)
      if (!is_constraint(request, i))
      {
        request.pressure_change[i] =
            -(request.residual[i] + request.d_gap[i] * request.gap_change[i])
            / request.d_pressure[i];
        force[i] = -rows_.weight(i)
                   * (request.pressure[i] + request.pressure_change[i]);
      }
    // What holds the pivot is the force of its row.
    la::Vector reaction(residual);
    stiffness_->vmult(reaction, increment);
    reaction.add(1., residual);
    rows_.add_transposed(force.data(), reaction);
    for (int i = 0; i < rows_.n_rows(); ++i)
      if (is_constraint(request, i))
      {
        const std::int64_t pivot = condensate_.pivot[i];
        request.pressure_change[i] =
            la::data(reaction)[rows_.column(pivot)]
                / (rows_.weight(i) * rows_.coefficient(pivot))
            - request.pressure[i];
      }
  }

  LinearReport Condensation::solve(const la::Vector &residual,
                                   const abut_request &request,
                                   const double smallest_residual,
                                   la::Vector &increment)
  {
    std::vector<std::uint8_t> resists(rows_.n_rows());
    for (int i = 0; i < rows_.n_rows(); ++i)
      resists[i] = is_constraint(request, i) || request.d_gap[i] != 0.;
    floating_.check(rows_, resists);
    if (!condense(request))
    {
      if (saddle_point_ == nullptr)
      {
        saddle_point_ = std::make_unique<SaddlePoint>(parameters_);
        saddle_point_->set_near_null_space(space_);
        saddle_point_->reinit(*stiffness_, view_);
      }
      LinearReport report =
          saddle_point_->solve(residual, request, smallest_residual, increment);
      report.method += " (constraints share all their unknowns)";
      return report;
    }
    LinearReport report = solver_.prepare(condensate_);
    const la::Vector start = lift(request);
    const la::Vector rhs = right_hand_side(residual, request, start);
    const double tolerance = std::max(
        request.linear_tolerance * solver_.load(rhs), smallest_residual);
    report += solver_.solve(rhs, tolerance, increment);
    solver_.matrix().expand(increment);
    increment.add(1., start);
    recover(residual, request, increment);
    report.n_matvecs += 2;
    return report;
  }
} // namespace abut::solve
