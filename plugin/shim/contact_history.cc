// SPDX-License-Identifier: LGPL-2.1-or-later
// The history of contact on several ranks. Old and new owner of a point do not
// know each other: they meet at a third rank, which follows from the point's
// number. O(points / ranks) memory for balanced surfaces, three exchanges.
#include "contact_history.h"

#include "agree.h"

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** The rank to request a point from: the same rank for all points of a
     * facet. Numbers come in strides; their products by an odd constant do not
     * (Knuth, TAOCP 6.4). */
    unsigned int meeting_rank(const std::int64_t id, const unsigned int n_ranks)
    {
      const std::uint64_t scattered =
          static_cast<std::uint64_t>(PointNumber::group(id))
          * 0x9e3779b97f4a7c15u;
      return static_cast<unsigned int>((scattered >> 32) % n_ranks);
    }

    /** A point with all that is known of it. */
    struct Entry
    {
      std::int64_t id;
      double pressure;
      std::uint8_t state;
      std::array<double, 3> place;
    };

    void write(const abut_history_entries &entries, const std::int64_t i,
               Parcel &parcel)
    {
      parcel.write(entries.id[i]);
      parcel.write(entries.state[i]);
      parcel.write_value(entries.pressure[i]);
      for (int d = 0; d < 3; ++d)
        parcel.write_value(entries.place == nullptr ? 0.
                                                    : entries.place[3 * i + d]);
    }

    Entry read_entry(Parcel &parcel)
    {
      Entry entry;
      entry.id = parcel.read();
      entry.state = static_cast<std::uint8_t>(parcel.read());
      entry.pressure = parcel.read_value();
      for (double &x : entry.place)
        x = parcel.read_value();
      return entry;
    }

    abut_history_entries view_of(const abut_context *context,
                                 const abut_history *history,
                                 const abut_history_version version)
    {
      abut_history_entries view = {};
      view.struct_size = sizeof(view);
      check(context, abut_history_view(history, version, &view));
      return view;
    }

    void set(const abut_context *context, abut_history *history,
             std::vector<Entry> entries)
    {
      std::sort(entries.begin(), entries.end(),
                [](const Entry &a, const Entry &b) { return a.id < b.id; });
      std::vector<std::int64_t> id;
      std::vector<double> pressure, place;
      std::vector<std::uint8_t> state;
      for (const Entry &entry : entries)
      {
        id.push_back(entry.id);
        pressure.push_back(entry.pressure);
        state.push_back(entry.state);
        place.insert(place.end(), entry.place.begin(), entry.place.end());
      }
      const abut_history_entries given = {
          sizeof(given), static_cast<std::int64_t>(id.size()),
          id.data(),     pressure.data(),
          state.data(),  place.data()};
      check(context, abut_history_set(history, &given));
    }

    /** Where a solve ended in a pressure that is not finite, the next begins
     * without pressure. */
    double finite_pressure(const double pressure)
    {
      return std::isfinite(pressure) ? pressure : 0.;
    }

    /** Points by ascending numbers. Points that are open and have no pressure
     * are left out: the history has the same answer for points that it does not
     * know. */
    void set_loaded(const abut_context *context, abut_history *history,
                    const std::vector<std::int64_t> &id,
                    const std::vector<double> &pressure,
                    const std::vector<std::uint8_t> &state)
    {
      std::vector<std::int64_t> ids;
      std::vector<double> pressures;
      std::vector<std::uint8_t> states;
      for (std::size_t i = 0; i < id.size(); ++i)
        if (const double p = finite_pressure(pressure[i]);
            p != 0. || state[i] != ABUT_STATE_OPEN)
        {
          ids.push_back(id[i]);
          pressures.push_back(p);
          states.push_back(state[i]);
        }
      const abut_history_entries entries = {
          sizeof(entries), static_cast<std::int64_t>(ids.size()),
          ids.data(),      pressures.data(),
          states.data(),   nullptr};
      check(context, abut_history_set(history, &entries));
    }
  } // namespace

  ContactHistory::ContactHistory(abut_context *context,
                                 const MPI_Comm communicator)
      : context_(context),
        post_(communicator),
        history_(create_history(context))
  {
  }

  abut_history_problem
  ContactHistory::problem(const abut_history_version version) const
  {
    abut_history_problem result = {};
    result.struct_size = sizeof(result);
    check(context_, abut_history_get_problem(history_.get(), version, &result));
    return result;
  }

  void ContactHistory::record(const std::uint64_t mesh,
                              const std::vector<std::int64_t> &id,
                              const std::vector<PlacedRow> &placed,
                              const std::vector<double> &pressure,
                              const std::vector<std::uint8_t> &state,
                              const Penalty &penalty)
  {
    check(context_, abut_history_begin_step(history_.get()));
    if (placed.empty() && std::is_sorted(id.begin(), id.end()))
      set_loaded(context_, history_.get(), id, pressure, state);
    else
    {
      std::vector<Entry> entries(id.size());
      for (std::size_t i = 0; i < id.size(); ++i)
        entries[i] = {id[i], finite_pressure(pressure[i]), state[i], {}};
      for (const PlacedRow &row : placed)
        entries[row.row].place = row.place;
      set(context_, history_.get(), std::move(entries));
    }

    abut_history_problem known = {};
    known.struct_size = sizeof(known);
    known.mesh = mesh;
    penalty.law.copy(known.law, sizeof(known.law) - 1);
    known.first_penalty = penalty.first;
    known.penalty = penalty.reached;
    check(context_,
          abut_history_set_problem(history_.get(), ABUT_HISTORY_TRIAL, &known));
    is_here_[ABUT_HISTORY_TRIAL] = true;
  }

  void ContactHistory::forget_trial()
  {
    abut_history_problem none = {};
    none.struct_size = sizeof(none);
    check(context_, abut_history_begin_step(history_.get()));
    check(context_,
          abut_history_set_problem(history_.get(), ABUT_HISTORY_TRIAL, &none));
    is_here_[ABUT_HISTORY_TRIAL] = true;
  }

  bool ContactHistory::knows(const abut_history_version version,
                             const std::uint64_t mesh) const
  {
    return mesh != 0 && problem(version).mesh == mesh;
  }

  std::vector<double>
  ContactHistory::pressures_here(abut_history *history,
                                 const abut_history_version version,
                                 const std::vector<std::int64_t> &id,
                                 const std::vector<PlacedRow> &placed) const
  {
    std::vector<double> result(id.size());
    abut_history_values past = {};
    past.struct_size = sizeof(past);
    past.pressure = result.data();
    check(context_, abut_history_get(history, version,
                                     static_cast<std::int64_t>(id.size()),
                                     id.data(), &past));
    for (const PlacedRow &row : placed)
    {
      const std::int64_t first = PointNumber::group(id[row.row]);
      const std::int64_t end = first + PointNumber::points_per_facet;
      past.pressure = &result[row.row];
      check(context_, abut_history_nearest(history, version, 1, &first, &end,
                                           row.place.data(), &past));
    }
    return result;
  }

  Handle<abut_history> ContactHistory::meet(const abut_history_version version)
  {
    const unsigned int n_ranks = MPI::n_mpi_processes(post_.communicator());
    const abut_history_entries mine =
        view_of(context_, history_.get(), version);
    Mail known;
    for (std::int64_t i = 0; i < mine.n; ++i)
      write(mine, i, known[meeting_rank(mine.id[i], n_ranks)]);
    std::vector<Entry> met;
    for (auto &[rank, parcel] : post_.exchange(known))
      while (!parcel.at_end())
        met.push_back(read_entry(parcel));
    Handle<abut_history> result = create_history(context_);
    set(context_, result.get(), std::move(met));
    return result;
  }

  std::vector<double>
  ContactHistory::pressures(const std::vector<std::int64_t> &id,
                            const std::vector<PlacedRow> &placed,
                            const abut_history_version version)
  {
    if (is_here_[version])
      return pressures_here(history_.get(), version, id, placed);

    const unsigned int n_ranks = MPI::n_mpi_processes(post_.communicator());
    const Handle<abut_history> met = meet(version);
    std::vector<const PlacedRow *> place(id.size(), nullptr);
    for (const PlacedRow &row : placed)
      place[row.row] = &row;
    Mail questions, answers;
    for (std::size_t i = 0; i < id.size(); ++i)
    {
      Parcel &parcel = questions[meeting_rank(id[i], n_ranks)];
      parcel.write(id[i]);
      parcel.write(place[i] != nullptr);
      for (int d = 0; d < 3 && place[i] != nullptr; ++d)
        parcel.write_value(place[i]->place[d]);
    }
    for (auto &[rank, question] : post_.exchange(questions))
    {
      std::vector<std::int64_t> asked;
      std::vector<PlacedRow> asked_by_place;
      while (!question.at_end())
      {
        asked.push_back(question.read());
        if (question.read() == 0)
          continue;
        PlacedRow row = {static_cast<std::int32_t>(asked.size() - 1), {}};
        for (double &x : row.place)
          x = question.read_value();
        asked_by_place.push_back(row);
      }
      // Whatever the version, it is the trial one of what has met.
      for (const double p :
           pressures_here(met.get(), ABUT_HISTORY_TRIAL, asked, asked_by_place))
        answers[rank].write_value(p);
    }
    Mail received = post_.exchange(answers);
    std::vector<double> result;
    for (const std::int64_t number : id)
      result.push_back(received[meeting_rank(number, n_ranks)].read_value());
    return result;
  }

  ContactHistory::Penalty ContactHistory::penalty_to_resume() const
  {
    const abut_history_problem known = problem(ABUT_HISTORY_TRIAL);
    if (known.resumes == 0)
      return {};
    return {known.law, known.first_penalty, known.penalty};
  }

  void ContactHistory::leave_ranks()
  {
    for (const auto version : {ABUT_HISTORY_COMMITTED, ABUT_HISTORY_TRIAL})
    {
      abut_history_problem known = problem(version);
      known.resumes = 1;
      check(context_,
            abut_history_set_problem(history_.get(), version, &known));
      is_here_[version] = false;
    }
  }

  void ContactHistory::commit()
  {
    check(context_, abut_history_commit(history_.get()));
    is_here_[ABUT_HISTORY_COMMITTED] = is_here_[ABUT_HISTORY_TRIAL];
  }

  void ContactHistory::rollback()
  {
    check(context_, abut_history_rollback(history_.get()));
    is_here_[ABUT_HISTORY_TRIAL] = is_here_[ABUT_HISTORY_COMMITTED];
  }
} // namespace abut::shim
