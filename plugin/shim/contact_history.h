// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CONTACT_HISTORY_H
#define ABUT_SHIM_CONTACT_HISTORY_H

#include "handles.h"
#include "point_number.h"
#include "point_to_point.h"

#include <abut/history.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace abut::shim
{
  /** History of contact on all ranks: the core's history, and the way to it
   * where the points have come to other ranks.
   *
   * Entries stay on the rank that recorded them. As long as the mesh is not
   * partitioned again, that rank has the points; afterwards requests go through
   * a third rank, see contact_history.cc, until the values are recorded again.
   */
  class ContactHistory
  {
  public:
    /** The penalty of an outer iteration, and the method that it belongs to. */
    struct Penalty
    {
      std::string law;
      double first = 0., reached = 0.;
    };

    /** @p context must outlive this object. */
    ContactHistory(abut_context *context, MPI_Comm communicator);

    /** Make the trial version the values [rows] of the rows with these numbers,
     * of a mesh with this signature. Not collective, but to be called on all
     * ranks. */
    void record(std::uint64_t mesh, const std::vector<std::int64_t> &id,
                const std::vector<PlacedRow> &placed,
                const std::vector<double> &pressure,
                const std::vector<std::uint8_t> &state, const Penalty &penalty);

    /** Empty the trial version. Not collective, but to be called on all ranks.
     */
    void forget_trial();

    /** Whether a version is of the mesh with this signature. Not collective. */
    bool knows(abut_history_version version, std::uint64_t mesh) const;

    /** Pressures (tractions of tangents) of a version at rows, 0 where a point
     * has no past; of placed ones those of the nearest old point of the facet.
     * Collective. */
    std::vector<double>
    pressures(const std::vector<std::int64_t> &id,
              const std::vector<PlacedRow> &placed,
              abut_history_version version = ABUT_HISTORY_TRIAL);

    /** The penalty that the next solve goes on with; without a law if there is
     * none. Not collective. */
    Penalty penalty_to_resume() const;

    /** Points may come to other ranks from here on, and the penalties reached
     * go with them. Not collective, but to be called on all ranks. */
    void leave_ranks();

    /** As in the core. Not collective, but to be called on all ranks. */
    void commit();
    void rollback();

    /** Write the committed version: rank 0 into @p stream. Throws HistoryError
     * on all ranks. Collective. */
    void save(std::ostream &stream);

    /** Make both versions what save() wrote, which rank 0 reads. Throws
     * HistoryError on all ranks, without any change, if it is anything else or
     * of another mesh than that with this signature. The rest of the stream is
     * for @p read_rest, which may throw so, too. Collective. */
    void load(std::istream &stream, std::uint64_t mesh,
              const std::function<void()> &read_rest);

    /** Data that this rank has sent. */
    const CommunicationReport &sent() const
    {
      return post_.sent();
    }

  private:
    abut_history_problem problem(abut_history_version version) const;
    std::vector<double>
    pressures_here(abut_history *history, abut_history_version version,
                   const std::vector<std::int64_t> &id,
                   const std::vector<PlacedRow> &placed) const;
    Handle<abut_history> meet(abut_history_version version);

    abut_context *const context_;
    PointToPoint post_;
    Handle<abut_history> history_;
    /** [versions] whether points are where their entries are. */
    std::array<bool, 2> is_here_ = {{true, true}};
  };
} // namespace abut::shim

#endif
