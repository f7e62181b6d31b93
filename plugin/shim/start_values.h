// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_START_VALUES_H
#define ABUT_SHIM_START_VALUES_H

#include "contact_history.h"
#include "row_source.h"
#include "solve/point_operator.h"

#include <map>

namespace abut::shim
{
  /** Rows that a solve starts with. */
  struct StartRows
  {
    const RowSource &source;
    const solve::PointOperator &rows;
    const std::vector<PlacedRow> &placed;
    std::uint64_t mesh; ///< its signature
    bool may_pull;      ///< a law of the user's: pressures may be negative
  };

  /** Data of rows, by their numbers: pressures and, unless the iteration has
   * none, states. */
  struct RowValues
  {
    std::map<std::int64_t, std::pair<double, std::uint8_t>> of;
    bool has_states = false;
  };

  /** Pressures and states that the next solve starts from. */
  class StartValues
  {
  public:
    /** [rows] at least 0 unless bilateral; empty: 0. */
    const std::vector<double> &pressure() const
    {
      return pressure_;
    }

    bool is_pressed(MPI_Comm communicator) const;

    /** [rows]; empty: by pressures and gaps. */
    const std::vector<std::uint8_t> &state() const
    {
      return state_;
    }

    void set_state(std::vector<std::uint8_t> state)
    {
      state_ = std::move(state);
    }

    /** Value of a row. */
    double pressure(const int row) const
    {
      return pressure_.empty() ? 0. : pressure_[row];
    }

    /** States by the pressures alone. */
    std::vector<std::uint8_t> states(const solve::PointOperator &rows) const;

    /** Whether it goes on from the end of the last iteration. */
    bool is_restarted() const
    {
      return is_restarted_;
    }

    void set_restarted(const bool restarted)
    {
      is_restarted_ = restarted;
    }

    /** A field of pressures that the host gives; empty: none. */
    void give_field(const la::Vector &field)
    {
      given_field_ = field;
    }

    /** Keep the pressures of the present rows as a field, in case that other
     * surfaces follow. */
    void keep_field(const RowSource &source,
                    const std::vector<double> &row_pressure);

    /** reinit(): the history does not hold unless a field follows. */
    void forget_history()
    {
      is_forgotten_ = true;
      pressure_.clear();
    }

    /** The rows have been solved: their history holds, and no field. */
    void use_history()
    {
      given_field_ = la::Vector();
      is_forgotten_ = false;
    }

    /** Forget an iteration without its result. */
    void abandon();

    /** Find the pressures. Collective. */
    void find(const StartRows &rows, ContactHistory &history);

    /** The same of the trial version alone, if it is of these rows; null: no
     * rows. Collective. */
    void return_to_history(const StartRows *rows, ContactHistory &history);

    /** Go on from values of rows that have the same number. */
    void go_on(const StartRows &rows, const RowValues &before);

    /** Go on from the end of an iteration of the same rows; no @p state: by
     * pressures and gaps. */
    void go_on(const StartRows &rows, std::vector<double> pressure,
               std::vector<std::uint8_t> state);

    /** The penalty that an iteration like this goes on with; 0: none. */
    double resumed_penalty(const ContactHistory::Penalty &penalty) const;

  private:
    void start_from_field(const StartRows &rows, ContactHistory &history,
                          const la::Vector &given);
    void start_from_history(const StartRows &rows, ContactHistory &history);
    /** No tension but of ties. */
    void limit(const StartRows &rows);

    la::Vector given_field_;
    la::Vector kept_field_; ///< of other surfaces; empty: none
    std::vector<double> pressure_;
    std::vector<std::uint8_t> state_;
    bool is_restarted_ = false, is_forgotten_ = false;
    ContactHistory::Penalty resumed_; ///< that the iteration may go on with
  };
} // namespace abut::shim

#endif
