/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "nodal_condensation.h"

#include <cmath>

namespace abut::solve
{
  NodalCondensation::NodalCondensation(const SolverParameters &parameters)
      : solver_(parameters)
  {
  }

  void NodalCondensation::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
    solver_.set_near_null_space(space);
  }

  void NodalCondensation::reinit(const Stiffness &stiffness,
                                 const PointOperator &rows,
                                 const std::vector<double> &)
  {
    solver_.reinit(stiffness.matrix());
    set_stiffness(stiffness.matrix(), rows);
  }

  void NodalCondensation::renew(const Stiffness &stiffness,
                                const PointOperator &rows,
                                const std::vector<double> &)
  {
    solver_.renew(stiffness.matrix());
    set_stiffness(stiffness.matrix(), rows);
  }

  void NodalCondensation::set_stiffness(const la::Matrix &stiffness,
                                        const PointOperator &rows)
  {
    stiffness_ = &stiffness;
    rows_ = &rows;
    for (int i = 0; i < rows.n_rows(); ++i)
      AssertThrow(rows.end(i) - rows.begin(i) == 1
                      && rows.column(rows.begin(i)) < rows.n_owned(),
                  dealii::ExcMessage(
                      "Condensation by node needs constraints with one "
                      "unknown; use Method/System = saddle point for others."));
  }

  std::vector<PreconditionerState> NodalCondensation::state() const
  {
    return {solver_.state()};
  }

  void NodalCondensation::restore(const std::vector<PreconditionerState> &state)
  {
    solver_.restore(state.at(0));
  }

  void NodalCondensation::fill_mask()
  {
    const std::size_t n = solver_.diagonal().size();
    mask_.held.assign(n, 0);
    holder_.assign(n, -1);
    mask_.diagonal.clear();
    for (int i = 0; i < rows_->n_rows(); ++i)
    {
      const int j = unknown(i);
      if (local_.is_held(i))
      {
        if (!mask_.held[j])
          holder_[j] = i;
        mask_.held[j] = 1;
      }
      else if (local_.spring()[i] != 0.)
      {
        if (mask_.diagonal.empty())
          mask_.diagonal.assign(n, 0.);
        mask_.diagonal[j] += slope(i) * slope(i) * local_.spring()[i];
      }
    }
  }

  void NodalCondensation::fill_right_hand_side(const la::Vector &residual,
                                               la::Vector &rhs) const
  {
    rhs = residual;
    rhs *= -1.;
    double *out = la::data(rhs);
    for (int i = 0; i < rows_->n_rows(); ++i)
      if (!local_.is_held(i))
        out[unknown(i)] += slope(i) * local_.force()[i];
  }

  bool NodalCondensation::fill_held_values(la::Vector &increment) const
  {
    increment = 0.;
    double *out = la::data(increment);
    double largest = 0.;
    for (int i = 0; i < rows_->n_rows(); ++i)
      if (local_.is_held(i) && holder_[unknown(i)] == i)
      {
        out[unknown(i)] = local_.value()[i] / slope(i);
        largest = std::max(largest, std::abs(out[unknown(i)]));
      }
    return dealii::Utilities::MPI::max(largest,
                                       stiffness_->get_mpi_communicator())
           == 0.;
  }

  double NodalCondensation::load_by_held(const la::Vector &increment) const
  {
    la::Vector force(increment);
    stiffness_->vmult(force, increment);
    return solver_.load(mask_, force);
  }

  void NodalCondensation::recover(const la::Vector &residual,
                                  const abut_request &request,
                                  const la::Vector &increment)
  {
    const double *du = la::data(increment);
    bool any_held = false;
    for (int i = 0; i < rows_->n_rows(); ++i)
    {
      request.gap_change[i] = slope(i) * du[unknown(i)];
      if (local_.is_held(i))
      {
        any_held = true;
        request.pressure_change[i] = -request.pressure[i];
      }
    }
    local_.recover(request);
    if (!dealii::Utilities::MPI::logical_or(any_held,
                                            stiffness_->get_mpi_communicator()))
      return;

    // The reaction of a held unknown, K du + R, is the force of its rows.
    const auto force_of = [&](const int i)
    { return rows_->weight(i) * slope(i); };
    for (int i = 0; i < rows_->n_rows(); ++i)
      if (!local_.is_held(i) && mask_.held[unknown(i)])
      {
        const int holder = holder_[unknown(i)];
        request.pressure_change[holder] -=
            force_of(i) * (request.pressure[i] + request.pressure_change[i])
            / force_of(holder);
      }
    const la::LocalRows matrix = la::local_rows(*stiffness_);
    const std::vector<double> gathered = la::gather(*stiffness_, increment);
    const double *r = la::data(residual);
    for (int i = 0; i < rows_->n_rows(); ++i)
    {
      const int j = unknown(i);
      if (!local_.is_held(i) || holder_[j] != i)
        continue;
      double reaction = r[j];
      for (int k = matrix.start[j]; k < matrix.start[j + 1]; ++k)
        reaction += matrix.value[k] * gathered[matrix.column[k]];
      request.pressure_change[i] += reaction / force_of(i);
    }
  }

  LinearReport NodalCondensation::solve(const la::Vector &residual,
                                        const abut_request &request,
                                        const double smallest_residual,
                                        la::Vector &increment)
  {
    local_.reinit(request, rows_->n_rows(), rows_->weights(),
                  rows_->communicator());
    fill_mask();
    la::Vector rhs(residual);
    fill_right_hand_side(residual, rhs);
    const bool start_is_zero = fill_held_values(increment);

    double load = solver_.load(mask_, rhs);
    if (load == 0. && !start_is_zero)
      load = load_by_held(increment);
    const double tolerance =
        std::max(request.linear_tolerance * load, smallest_residual);
    LinearReport report =
        solver_.solve(mask_, rhs, tolerance, increment, start_is_zero);
    recover(residual, request, increment);
    ++report.n_matvecs;
    return report;
  }
} // namespace abut::solve
