// SPDX-License-Identifier: LGPL-2.1-or-later
#include "restart.h"

#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "archive.h"
#include "disk.h"

#include <deal.II/base/mpi.h>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    const char *const identity_name = "run";
    const char *const rank_number = "number of ranks";

    std::string rank_name(const unsigned int rank)
    {
      return "rank." + std::to_string(rank);
    }
  } // namespace

  Restart::Restart(const std::filesystem::path &folder,
                   const MPI_Comm communicator,
                   const CheckpointParameters &parameters,
                   const RunIdentity &identity, const bool resumes)
      : communicator_(communicator),
        store_(folder, communicator),
        parameters_(parameters)
  {
    RunIdentity all = identity;
    all[rank_number] = std::to_string(MPI::n_mpi_processes(communicator));
    identity_ = to_bytes(all);
    if (!resumes)
      return;
    source_ = store_.latest();
    if (!source_)
      throw InputError("", "there is no checkpoint in '" + folder.string()
                               + "': run the scene without --resume.");
    store_.verify(*source_);
    collective(communicator, [&] { find(all); });
  }

  void Restart::find(const RunIdentity &identity)
  {
    RunIdentity before, now = identity;
    from_bytes(read_from_disk(*source_ / identity_name), before);
    same_ranks_ = before[rank_number] == now[rank_number];
    before.erase(rank_number);
    now.erase(rank_number);
    const std::string what = difference(with_present_names(before, now), now);
    if (!what.empty())
      throw InputError("", "the checkpoint '" + source_->string()
                               + "' is of another run: " + what
                               + ". Use the settings that it was started with, "
                                 "or run the scene without --resume.");
  }

  std::string Restart::bytes() const
  {
    const unsigned int rank =
        same_ranks_ ? MPI::this_mpi_process(communicator_) : 0;
    return read_from_disk(*source_ / rank_name(rank));
  }

  bool Restart::is_due()
  {
    ++steps_;
    const double minutes =
        std::chrono::duration<double>(Clock::now() - last_).count() / 60.;
    const bool due =
        (parameters_.every_steps > 0 && steps_ >= parameters_.every_steps)
        || (parameters_.every_minutes > 0.
            && minutes >= parameters_.every_minutes);
    return MPI::logical_or(due, communicator_);
  }

  void Restart::write(
      const std::function<std::string(const std::filesystem::path &)> &save)
  {
    store_.write(
        [&](const std::filesystem::path &folder)
        {
          const std::string bytes = save(folder);
          const unsigned int rank = MPI::this_mpi_process(communicator_);
          collective(communicator_,
                     [&]
                     {
                       write_to_disk(folder / rank_name(rank), bytes);
                       if (rank == 0)
                         write_to_disk(folder / identity_name, identity_);
                     });
        });
    steps_ = 0;
    last_ = Clock::now();
  }
} // namespace abut::app
