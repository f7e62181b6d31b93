// SPDX-License-Identifier: LGPL-2.1-or-later
#include "child_process.h"

#include <fcntl.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

extern char **environ;

namespace abut::app
{
  namespace
  {
    /** Exit code by which a child says that it could not become the program;
     * shells use the same. */
    constexpr int cannot_begin = 127;

    std::vector<char *> pointers(const std::vector<std::string> &words)
    {
      std::vector<char *> result;
      for (const std::string &word : words)
        result.push_back(const_cast<char *>(word.c_str()));
      result.push_back(nullptr);
      return result;
    }

    /** What the child does before it becomes another program, or @p program if
     * that is not null. Between fork and exec only calls that are safe in
     * signal handlers are allowed: no memory may be allocated. */
    [[noreturn]] void become(const MainFunction program, char **words,
                             char *const *environment, const char *folder,
                             const char *log, const rlim_t limit,
                             const pid_t parent)
    {
      end_with(parent);
      if (folder[0] != 0 && chdir(folder) != 0)
        _exit(cannot_begin);
      if (log[0] != 0)
      {
        const int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (file < 0 || dup2(file, STDOUT_FILENO) < 0
            || dup2(file, STDERR_FILENO) < 0)
          _exit(cannot_begin);
      }
      if (limit > 0)
      {
        const rlimit processor = {limit, limit + 5}, core = {0, 0};
        setrlimit(RLIMIT_CPU, &processor);
        setrlimit(RLIMIT_CORE, &core);
      }
      environ = const_cast<char **>(environment);
      if (program == nullptr)
      {
        execvp(words[0], words);
        _exit(cannot_begin);
      }
      std::signal(SIGINT, SIG_DFL);
      std::signal(SIGTERM, SIG_DFL);
      int n = 0;
      while (words[n] != nullptr)
        ++n;
      std::exit(program(n, words));
    }

    /** Wait for the end; after @p seconds (0: never) bring it about. Returns
     * whether that was needed. */
    bool wait_for(const pid_t process, const double seconds, int &status)
    {
      using Clock = std::chrono::steady_clock;
      const auto start = Clock::now();
      bool killed = false;
      for (unsigned int rounds = 0;; ++rounds)
      {
        const pid_t ended = waitpid(process, &status, WNOHANG);
        if (ended == process || (ended < 0 && errno != EINTR))
          return killed;
        const std::chrono::duration<double> past = Clock::now() - start;
        if (seconds > 0 && past.count() > seconds && !killed)
        {
          kill(process, SIGKILL);
          killed = true;
        }
        std::this_thread::sleep_for(
            std::chrono::milliseconds(rounds < 100 ? 1 : 10));
      }
    }

    bool starts_with(const std::string &text, const std::string &beginning)
    {
      return text.compare(0, beginning.size(), beginning) == 0;
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
                        const ChildOptions &options, const MainFunction program)
  {
    std::vector<char *> arguments = pointers(words);
    const std::vector<char *> variables = pointers(options.environment);
    char *const *environment =
        options.environment.empty() ? environ : variables.data();
    const auto limit = static_cast<rlim_t>(std::ceil(options.limit));
    const std::string folder = options.folder.string(),
                      log = options.log.string();
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process < 0)
      throw std::runtime_error("cannot start '" + words[0]
                               + "': the system has no room for a process");
    if (process == 0)
      become(program, arguments.data(), environment, folder.c_str(),
             log.c_str(), limit, parent);
    int status = 0;
    const bool killed = wait_for(process, 10 * options.limit, status);
    using Ended = ChildResult::Ended;
    if (WIFEXITED(status) && WEXITSTATUS(status) == cannot_begin)
      return {Ended::not_found, cannot_begin};
    if (WIFEXITED(status))
      return {Ended::exited, WEXITSTATUS(status)};
    const int signal = WTERMSIG(status);
    return {killed || (limit > 0 && signal == SIGXCPU) ? Ended::out_of_time
                                                       : Ended::signalled,
            signal};
  }

  std::vector<std::string> serial_environment()
  {
    std::vector<std::string> result;
    for (char **variable = environ; *variable != nullptr; ++variable)
    {
      const std::string text = *variable;
      const bool of_mpi = starts_with(text, "PMI")
                          || (starts_with(text, "OMPI_")
                              && !starts_with(text, "OMPI_ALLOW_RUN_AS_ROOT"));
      const bool of_threads = starts_with(text, "DEAL_II_NUM_THREADS=")
                              || starts_with(text, "OMP_NUM_THREADS=");
      if (!of_mpi && !of_threads)
        result.push_back(text);
    }
    result.insert(result.end(), {"DEAL_II_NUM_THREADS=1", "OMP_NUM_THREADS=1"});
    return result;
  }
} // namespace abut::app
