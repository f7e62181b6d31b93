// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RESTART_H
#define ABUT_APP_RESTART_H

#include "checkpoint_parameters.h"
#include "checkpoint_store.h"
#include "run_identity.h"
#include "stop_signal.h"

#include <chrono>

namespace abut::app
{
  /** The checkpoints of one run: where it goes on, when the next one is due,
   * and whether the run has been asked to stop.
   *
   * A checkpoint holds a file of bytes for each rank, whatever else save() puts
   * into its folder, and whose it is. Functions are collective. */
  class Restart
  {
  public:
    /** @param resumes go on from the latest checkpoint in @p folder. Throws
     * InputError if there is none, if it is damaged, and if it belongs to
     * another scene or program: nothing is changed then. */
    Restart(const std::filesystem::path &folder, MPI_Comm communicator,
            const CheckpointParameters &parameters, const RunIdentity &identity,
            bool resumes);

    /** Whether the run goes on from a checkpoint. Not collective. */
    bool is_resumed() const
    {
      return source_.has_value();
    }

    /** Folder of that checkpoint. Not collective. */
    const std::filesystem::path &source() const
    {
      return *source_;
    }

    /** Whether it was written on as many ranks as there are now. Not
     * collective. */
    bool has_same_ranks() const
    {
      return same_ranks_;
    }

    /** The bytes that this rank has written; on another number of ranks those
     * of rank 0. Not collective. */
    std::string bytes() const;

    /** To be asked once at each place from which the run could go on later:
     * whether it is time for a checkpoint. */
    bool is_due();

    /** Whether someone asks the run to stop. */
    bool must_stop() const
    {
      return stop_.has_come(communicator_);
    }

    /** Write a checkpoint of the bytes that @p save returns on each rank. It
     * may put other files into the folder that it is given. */
    void write(
        const std::function<std::string(const std::filesystem::path &)> &save);

    /** The run has ended by itself: its checkpoints are of no use any more. */
    void finish()
    {
      store_.remove();
    }

  private:
    using Clock = std::chrono::steady_clock;

    void find(const RunIdentity &identity);

    MPI_Comm communicator_;
    CheckpointStore store_;
    CheckpointParameters parameters_;
    std::string identity_;
    StopSignal stop_;
    std::optional<std::filesystem::path> source_;
    bool same_ranks_ = false;
    unsigned int steps_ = 0; ///< since the last checkpoint
    Clock::time_point last_ = Clock::now();
  };
} // namespace abut::app

#endif
