// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHECKPOINT_STORE_H
#define ABUT_APP_CHECKPOINT_STORE_H

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace abut::app
{
  /** The checkpoints of an output folder, each a folder `checkpoint.N` of
   * files.
   *
   * A checkpoint is written as `checkpoint.N.new`, brought to the disk, and
   * only then given its name; the one before is removed afterwards, again by
   * a change of its name first. So whatever has the name of a checkpoint is
   * whole, whenever the program or the machine stops, and the one with the
   * largest N is the latest. Its file `contents` lists size and checksum of
   * all others.
   *
   * Functions are collective over the communicator; what fails on one rank is
   * an exception on all. */
  class CheckpointStore
  {
  public:
    CheckpointStore(std::filesystem::path folder, MPI_Comm communicator);

    /** The latest checkpoint. */
    std::optional<std::filesystem::path> latest() const;

    /** Let @p write fill a new checkpoint's folder on each rank, with files of
     * different names, and make it the latest. Throws std::runtime_error where
     * a file cannot be written: the one before is still the latest then. */
    void write(const std::function<void(const std::filesystem::path &)> &write);

    /** Compare the files of @p checkpoint with its list. Throws InputError for
     * one that is damaged or missing. */
    void verify(const std::filesystem::path &checkpoint) const;

    /** Remove all checkpoints. */
    void remove();

  private:
    std::filesystem::path numbered(unsigned int number) const;
    unsigned int latest_number() const;
    void publish(unsigned int number) const;
    void remove_all_but(unsigned int number) const;

    std::filesystem::path folder;
    MPI_Comm communicator;
    bool is_root;
  };
} // namespace abut::app

#endif
