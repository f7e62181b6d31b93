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
  struct ChildResult
  {
    enum class Ended
    {
      exited,    /**< with @ref code */
      signalled, /**< by signal @ref code */
      not_found  /**< there is no such program, or the log cannot be made */
    };
    Ended ended = Ended::not_found;
    int code = 0;

    bool well() const
    {
      return ended == Ended::exited && code == 0;
    }
  };

  /** For a process just forked: end when @p parent ends (on Linux). Safe in
   * signal handlers. */
  void end_with(pid_t parent);

  /** Run @p words, the first being the program, and wait for its end. The child
   * does not outlive this process (on Linux). Throws std::runtime_error when
   * the system has no room for another process.
   * @param log file for all that the child prints; empty: it prints where this
   * process does */
  ChildResult run_child(const std::vector<std::string> &words,
                        const std::filesystem::path &log);
} // namespace abut::app

#endif
