// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RUN_LOCK_H
#define ABUT_APP_RUN_LOCK_H

#include <filesystem>

#include <mpi.h>

namespace abut::app
{
  /** Keeps other processes from writing into an output folder: a lock of the
   * operating system on the file `.abut-lock` there, held by rank 0, which
   * goes with the process however it ends. Where the file system knows no
   * locks, there is none. */
  class RunLock
  {
  public:
    /** Throws InputError if another run has the folder. Collective. */
    RunLock(const std::filesystem::path &folder, MPI_Comm communicator);
    ~RunLock();
    RunLock(const RunLock &) = delete;
    RunLock &operator=(const RunLock &) = delete;

  private:
    std::filesystem::path file;
    int descriptor = -1;
  };
} // namespace abut::app

#endif
