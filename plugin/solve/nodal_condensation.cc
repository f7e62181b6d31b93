/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "nodal_condensation.h"

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

  NodalCondensation::NodalCondensation(const SolverParameters &parameters)
      : solver_(parameters)
  {
  }

  void NodalCondensation::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
    solver_.set_near_null_space(space);
  }

  void NodalCondensation::reinit(const la::Matrix &stiffness,
                                 const abut_rows_view &rows)
  {
    stiffness_ = &stiffness;
    rows_ = rows;
    solver_.reinit(stiffness);
    if (space_.n_components > 1)
    {
      operator_ = RowOperator(stiffness.locally_owned_range_indices(), rows,
                              stiffness.get_mpi_communicator());
      floating_.reinit(stiffness, operator_, space_);
    }
    const dealii::IndexSet owned = stiffness.locally_owned_range_indices();
    unknown_.resize(rows.n_rows);
    for (int i = 0; i < rows.n_rows; ++i)
    {
      AssertThrow(rows.row_start[i + 1] - rows.row_start[i] == 1,
                  dealii::ExcMessage("Condensation node by node needs rows "
                                     "with one entry; use System = saddle "
                                     "point for others."));
      unknown_[i] = owned.index_within_set(rows.column[rows.row_start[i]]);
    }
  }

  void NodalCondensation::renew(const la::Matrix &stiffness,
                                const abut_rows_view &rows)
  {
    if (&stiffness != stiffness_)
      reinit(stiffness, rows);
    else
      solver_.renew(stiffness);
  }

  void NodalCondensation::fill_mask(const abut_request &request)
  {
    const std::size_t n = solver_.diagonal().size();
    mask_.held.assign(n, 0);
    holder_.assign(n, -1);
    mask_.diagonal.clear();
    for (int i = 0; i < rows_.n_rows; ++i)
    {
      const int j = unknown_[i];
      if (is_constraint(request, i))
      {
        if (!mask_.held[j])
          holder_[j] = i;
        mask_.held[j] = 1;
      }
      else if (request.d_gap[i] != 0.)
      {
        if (mask_.diagonal.empty())
          mask_.diagonal.assign(n, 0.);
        const double slope = rows_.coefficient[rows_.row_start[i]];
        mask_.diagonal[j] += rows_.weight[i] * slope * slope * request.d_gap[i]
                             / request.d_pressure[i];
      }
    }
  }

  void NodalCondensation::fill_right_hand_side(const la::Vector &residual,
                                               const abut_request &request,
                                               la::Vector &rhs) const
  {
    rhs = residual;
    rhs *= -1.;
    double *out = la::data(rhs);
    for (int i = 0; i < rows_.n_rows; ++i)
      if (!is_constraint(request, i))
        out[unknown_[i]] += rows_.weight[i]
                            * rows_.coefficient[rows_.row_start[i]]
                            * (request.pressure[i]
                               - request.residual[i] / request.d_pressure[i]);
  }

  bool NodalCondensation::fill_held_values(const abut_request &request,
                                           la::Vector &increment) const
  {
    increment = 0.;
    double *out = la::data(increment);
    double largest = 0.;
    for (int i = 0; i < rows_.n_rows; ++i)
      if (is_constraint(request, i) && holder_[unknown_[i]] == i)
      {
        const double slope = rows_.coefficient[rows_.row_start[i]];
        out[unknown_[i]] = -request.residual[i] / (request.d_gap[i] * slope);
        largest = std::max(largest, std::abs(out[unknown_[i]]));
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
    for (int i = 0; i < rows_.n_rows; ++i)
    {
      const double slope = rows_.coefficient[rows_.row_start[i]];
      request.gap_change[i] = slope * du[unknown_[i]];
      if (is_constraint(request, i))
      {
        any_held = true;
        request.pressure_change[i] = -request.pressure[i];
      }
      else
        request.pressure_change[i] =
            -(request.residual[i] + request.d_gap[i] * request.gap_change[i])
            / request.d_pressure[i];
    }
    if (!dealii::Utilities::MPI::logical_or(any_held,
                                            stiffness_->get_mpi_communicator()))
      return;

    // The reaction of a held unknown, K du + R, is the force of its rows.
    const auto force_of = [&](const int i)
    { return rows_.weight[i] * rows_.coefficient[rows_.row_start[i]]; };
    for (int i = 0; i < rows_.n_rows; ++i)
      if (!is_constraint(request, i) && mask_.held[unknown_[i]])
      {
        const int holder = holder_[unknown_[i]];
        request.pressure_change[holder] -=
            force_of(i) * (request.pressure[i] + request.pressure_change[i])
            / force_of(holder);
      }
    const la::LocalRows matrix = la::local_rows(*stiffness_);
    const std::vector<double> gathered = la::gather(*stiffness_, increment);
    const double *r = la::data(residual);
    for (int i = 0; i < rows_.n_rows; ++i)
    {
      const int j = unknown_[i];
      if (!is_constraint(request, i) || holder_[j] != i)
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
    if (space_.n_components > 1)
    {
      std::vector<std::uint8_t> resists(rows_.n_rows);
      for (int i = 0; i < rows_.n_rows; ++i)
        resists[i] = is_constraint(request, i) || request.d_gap[i] != 0.;
      floating_.check(operator_, resists);
    }
    fill_mask(request);
    la::Vector rhs(residual);
    fill_right_hand_side(residual, request, rhs);
    const bool start_is_zero = fill_held_values(request, increment);

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
