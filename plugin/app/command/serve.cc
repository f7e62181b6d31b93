// SPDX-License-Identifier: LGPL-2.1-or-later
/* Most of what a small scene takes is the dynamic linker's work, some 300000
 * references of deal.II and of all that it is linked to. A program that runs
 * `abut` a hundred times starts `abut serve` once; each run is a process of its
 * own, forked before MPI or deal.II have begun.
 *
 * A request on standard input: the number of words, the folder to run in, files
 * that output and errors are appended to, the seconds of processor time and the
 * bytes of memory that the run may take (0: any), and the words of the command
 * line, each ended by a zero byte. The answer is a line with the exit code, or
 * minus the number of the signal that has ended the run.
 * plugin/tools/abut_tools/served.py sends requests. No run outlives who asked
 * for it (on Linux). */
#include "serve.h"

#include "app/process/child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace abut::app
{
  namespace
  {
    struct Request
    {
      std::string folder, output, errors;
      unsigned long seconds = 0, memory = 0;
      std::vector<std::string> words;
    };

    /** False at the end of the input. */
    bool read(std::istream &in, Request &request)
    {
      const auto next = [&in](std::string &word)
      { return static_cast<bool>(std::getline(in, word, '\0')); };
      std::string number, seconds, memory;
      if (!next(number) || !next(request.folder) || !next(request.output)
          || !next(request.errors) || !next(seconds) || !next(memory))
        return false;
      request.seconds = std::stoul(seconds);
      request.memory = std::stoul(memory);
      request.words.resize(std::stoul(number));
      for (std::string &word : request.words)
        if (!next(word))
          return false;
      return true;
    }

    bool redirect(const int descriptor, const std::string &file,
                  const int flags)
    {
      const int opened = open(file.c_str(), flags, 0666);
      return opened >= 0 && dup2(opened, descriptor) == descriptor
             && close(opened) == 0;
    }

    /** Limits of this process; the system's own end comes two seconds later. */
    bool limit(const Request &request)
    {
      const rlimit time = {request.seconds, request.seconds + 2};
      const rlimit memory = {request.memory, request.memory};
      const rlimit core = {0, 0};
      return (request.seconds == 0
              || (setrlimit(RLIMIT_CPU, &time) == 0
                  && setrlimit(RLIMIT_CORE, &core) == 0))
             && (request.memory == 0 || setrlimit(RLIMIT_AS, &memory) == 0);
    }

    /** What the new process does. */
    [[noreturn]] void become(const char *name, Request &request,
                             int (*const run)(int, char *[]))
    {
      const int flags = O_WRONLY | O_CREAT | O_APPEND;
      if (!redirect(0, "/dev/null", O_RDONLY)
          || !redirect(1, request.output, flags)
          || !redirect(2, request.errors, flags)
          || chdir(request.folder.c_str()) != 0 || !limit(request))
        _exit(127);
      std::string first = name;
      std::vector<char *> words = {first.data()};
      for (std::string &word : request.words)
        words.push_back(word.data());
      const int n = static_cast<int>(words.size());
      words.push_back(nullptr);
      std::exit(run(n, words.data()));
    }
  } // namespace

  int serve(const char *const name, int (*const run)(int argc, char *argv[]))
  {
    end_with(getppid());
    const pid_t self = getpid();
    for (Request request; read(std::cin, request);)
    {
      const pid_t child = fork();
      if (child == 0)
      {
        end_with(self);
        become(name, request, run);
      }
      int status = 0;
      if (child < 0 || waitpid(child, &status, 0) != child)
        return 1;
      std::cout << (WIFSIGNALED(status) ? -WTERMSIG(status)
                                        : WEXITSTATUS(status))
                << std::endl;
    }
    return 0;
  }
} // namespace abut::app
