// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_STATUS_FILE_H
#define ABUT_APP_STATUS_FILE_H

#include "app/input/input_error.h"

#include <abut/dealii/coded.h>

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** `run.json` in the output folder: how a run was started and how it ended.
   * Its status is "running" until the end, so that a run which is killed leaves
   * that word. Rank 0 writes, no function is collective. */
  class StatusFile
  {
  public:
    /** @param words of the command line without the program
     * @param scene_file as given */
    StatusFile(MPI_Comm communicator, std::filesystem::path folder,
               const std::vector<std::string> &words, std::string scene_file);

    /** The run begins in its folder, which exists. */
    void begin();

    /** The run ends. Nothing is written if there is no folder or no room.
     * @param error what the program prints at the end; may be empty
     * @param has_results this run has written summary.json */
    void end(ExitCode code, const Message &error, bool has_results) noexcept;

    const std::filesystem::path folder;

  private:
    std::string text(const std::string &status, const Message &error,
                     bool has_results, int code) const;

    const bool root;
    const int n_ranks;
    std::string command, scene_file, started;
  };
} // namespace abut::app

#endif
