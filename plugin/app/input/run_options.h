// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RUN_OPTIONS_H
#define ABUT_APP_RUN_OPTIONS_H

#include <mpi.h>

#include <filesystem>
#include <string>

namespace abut::app
{
  class Restart;

  /** What a scene is told about the run beside its parameters. */
  struct RunOptions
  {
    MPI_Comm communicator = MPI_COMM_NULL;
    std::filesystem::path scene_file;
    /** Folder of the results; exists and is writable when run() is called.
     * Empty: a check that writes nothing. */
    std::filesystem::path output_folder;
    /** `set Pictures` of section `Output`. */
    bool pictures = false;
    /** Checkpoints of the run; null for kinds of scenes that write none, and
     * for check(). */
    Restart *restart = nullptr;

    /** A file named in the scene: relative names are relative to the folder of
     * the scene file, else to the working directory. */
    std::filesystem::path input_file(const std::string &name) const;
  };
} // namespace abut::app

#endif
