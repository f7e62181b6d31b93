// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHILD_PROCESS_H
#define ABUT_APP_CHILD_PROCESS_H

/** @file
 * Other programs, run to their end.
 */

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  struct ChildOptions
  {
    /** Working folder; empty: that of this process. */
    std::filesystem::path folder;
    /** File for all that the child prints, relative to @ref folder; empty: it
     * prints where this process does. */
    std::filesystem::path log;
    /** `NAME=value`; empty: that of this process. */
    std::vector<std::string> environment;
    /** Processor seconds (rounded up) after which the child is ended, or ten
     * times as long on the wall; 0: no limit. */
    double limit = 0;
  };

  struct ChildResult
  {
    enum class Ended
    {
      exited,      /**< with @ref code */
      signalled,   /**< by signal @ref code */
      out_of_time, /**< ended at the limit */
      not_found    /**< there is no such program, or the log cannot be made */
    };
    Ended ended = Ended::not_found;
    int code = 0;

    bool well() const
    {
      return ended == Ended::exited && code == 0;
    }
  };

  /** What main() does. */
  using MainFunction = int (*)(int argc, char *argv[]);

  /** For a process just forked: end when @p parent ends (on Linux). Safe in
   * signal handlers. */
  void end_with(pid_t parent);

  /** Run @p words, the first being the program, and wait for its end. The child
   * does not outlive this process (on Linux). Where @p program is given it does
   * that instead of becoming another program: for processes without threads.
   * Throws std::runtime_error when the system has no room for another process.
   */
  ChildResult run_child(const std::vector<std::string> &words,
                        const ChildOptions &options,
                        MainFunction program = nullptr);

  /** The environment of this process for a serial child: without what MPI's
   * start has put into it, and with one thread. */
  std::vector<std::string> serial_environment();
} // namespace abut::app

#endif
