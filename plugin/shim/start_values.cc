// SPDX-License-Identifier: LGPL-2.1-or-later
#include "start_values.h"

#include <abut/strategy.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace abut::shim
{
  namespace
  {
    std::vector<std::int64_t> numbers_of(const solve::PointOperator &rows)
    {
      return {rows.ids(), rows.ids() + rows.n_rows()};
    }
  } // namespace

  bool StartValues::is_pressed(const MPI_Comm communicator) const
  {
    const bool pressed = std::any_of(pressure_.begin(), pressure_.end(),
                                     [](const double p) { return p > 0.; });
    return dealii::Utilities::MPI::logical_or(pressed, communicator);
  }

  std::vector<std::uint8_t>
  StartValues::states(const solve::PointOperator &rows) const
  {
    std::vector<std::uint8_t> result(rows.n_rows(), ABUT_STATE_OPEN);
    for (std::size_t row = 0; row < pressure_.size(); ++row)
      if (rows.bilateral()[row] != 0 || pressure_[row] != 0.)
        result[row] = ABUT_STATE_CLOSED;
    // Tangents have the state of their normal.
    for (std::size_t row = 1; row < pressure_.size(); ++row)
      if (rows.is_tangent(static_cast<int>(row)))
        result[row] = result[row - 1];
    return result;
  }

  void StartValues::keep_field(const RowSource &source,
                               const std::vector<double> &row_pressure)
  {
    if (!is_forgotten_)
      kept_field_ = source.pressure(row_pressure.data());
  }

  void StartValues::abandon()
  {
    is_restarted_ = false;
    given_field_ = la::Vector();
    state_.clear();
  }

  void StartValues::limit(const StartRows &rows)
  {
    if (rows.may_pull)
      return;
    for (int i = 0; i < rows.rows.n_rows(); ++i)
      if (rows.rows.bilateral()[i] == 0 && !rows.rows.is_tangent(i))
        pressure_[i] = std::max(0., pressure_[i]);
  }

  void StartValues::start_from_history(const StartRows &rows,
                                       ContactHistory &history)
  {
    pressure_ = history.pressures(numbers_of(rows.rows), rows.placed);
    resumed_ = history.penalty_to_resume();
    limit(rows);
  }

  void StartValues::start_from_field(const StartRows &rows,
                                     ContactHistory &history,
                                     const la::Vector &given)
  {
    pressure_ = rows.source.row_pressure(given);
    limit(rows);
    const std::vector<std::int64_t> numbers = numbers_of(rows.rows);
    if (history.knows(ABUT_HISTORY_TRIAL, rows.mesh))
    {
      // The field that the rows' own values make stands for these values.
      constexpr double same_field = 1e-8;
      const std::vector<double> own = history.pressures(numbers, rows.placed);
      const la::Vector field = rows.source.pressure(own.data());
      la::Vector difference(field);
      difference = given;
      difference -= field;
      if (difference.linfty_norm() <= same_field * field.linfty_norm())
      {
        start_from_history(rows, history);
        return;
      }
    }
    history.record(rows.mesh, numbers, rows.placed, pressure_,
                   states(rows.rows), ContactHistory::Penalty());
    // Only this can be restored from another mesh.
    if (!history.knows(ABUT_HISTORY_COMMITTED, rows.mesh))
      history.commit();
  }

  void StartValues::find(const StartRows &rows, ContactHistory &history)
  {
    pressure_.clear();
    resumed_ = ContactHistory::Penalty();
    if (given_field_.size() > 0)
      start_from_field(rows, history, given_field_);
    else if (is_forgotten_)
      history.forget_trial();
    else if (history.knows(ABUT_HISTORY_TRIAL, rows.mesh))
      start_from_history(rows, history);
    else if (kept_field_.size() > 0)
      start_from_field(rows, history, kept_field_);
    kept_field_ = la::Vector();
    is_forgotten_ = false;
  }

  void StartValues::return_to_history(const StartRows *const rows,
                                      ContactHistory &history)
  {
    is_forgotten_ = false;
    pressure_.clear();
    if (rows != nullptr && history.knows(ABUT_HISTORY_TRIAL, rows->mesh))
      start_from_history(*rows, history);
  }

  void StartValues::go_on(const StartRows &rows, const RowValues &before)
  {
    const int n = rows.rows.n_rows();
    pressure_.assign(n, 0.);
    state_.assign(before.has_states ? n : 0, ABUT_STATE_OPEN);
    for (int row = 0; row < n; ++row)
    {
      const auto it = before.of.find(rows.rows.ids()[row]);
      if (it == before.of.end())
        continue;
      pressure_[row] = it->second.first;
      if (before.has_states)
        state_[row] = it->second.second;
    }
    limit(rows);
  }

  void StartValues::go_on(const StartRows &rows, std::vector<double> pressure,
                          std::vector<std::uint8_t> state)
  {
    pressure_ = std::move(pressure);
    state_ = std::move(state);
    is_restarted_ = true;
    limit(rows);
  }

  double
  StartValues::resumed_penalty(const ContactHistory::Penalty &penalty) const
  {
    return resumed_.reached > 0. && resumed_.law == penalty.law
                   && resumed_.first == penalty.first
               ? resumed_.reached
               : 0.;
  }
} // namespace abut::shim
