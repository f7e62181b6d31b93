// SPDX-License-Identifier: LGPL-2.1-or-later
#include "child_process.h"

#include <fcntl.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    /** Exit code by which a child says that it could not become the program;
     * shells use the same. */
    constexpr int cannot_begin = 127;

    /** What the child does before it becomes another program. Between fork and
     * exec only calls that are safe in signal handlers are allowed: no memory
     * may be allocated. */
    [[noreturn]] void become(char **words, const char *log, const pid_t parent)
    {
      end_with(parent);
      if (log[0] != 0)
      {
        const int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (file < 0 || dup2(file, STDOUT_FILENO) < 0
            || dup2(file, STDERR_FILENO) < 0)
          _exit(cannot_begin);
      }
      execvp(words[0], words);
      _exit(cannot_begin);
    }
  } // namespace

  void end_with(const pid_t parent)
  {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) // it has ended before the line above
      _exit(cannot_begin);
#else
    (void)parent;
#endif
  }

  ChildResult run_child(const std::vector<std::string> &words,
                        const std::filesystem::path &log)
  {
    std::vector<char *> arguments;
    for (const std::string &word : words)
      arguments.push_back(const_cast<char *>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process < 0)
      throw std::runtime_error("cannot start '" + words[0]
                               + "': the system has no room for a process");
    if (process == 0)
      become(arguments.data(), log.c_str(), parent);
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
      continue;
    using Ended = ChildResult::Ended;
    if (!WIFEXITED(status))
      return {Ended::signalled, WTERMSIG(status)};
    const int code = WEXITSTATUS(status);
    return {code == cannot_begin ? Ended::not_found : Ended::exited, code};
  }
} // namespace abut::app
