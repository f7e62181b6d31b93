// SPDX-License-Identifier: LGPL-2.1-or-later
#include "loaded_program.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    /** Our end of the line to the process that is kept loaded; -1: there is
     * none. */
    int line_to_loaded = -1;

    /** A message of texts, each ended by a zero byte. False: it is too long, or
     * nobody is at the other end. */
    bool send(const int line, const std::vector<std::string> &texts)
    {
      std::string all;
      for (const std::string &text : texts)
        all.append(text).push_back('\0');
      return ::send(line, all.data(), all.size(), MSG_NOSIGNAL)
             == static_cast<ssize_t>(all.size());
    }

    /** recv() that goes on after a signal. */
    ssize_t receive(const int line, std::string &all, const int flags)
    {
      ssize_t n;
      do
        n = recv(line, all.data(), all.size(), flags);
      while (n < 0 && errno == EINTR);
      return n;
    }

    /** False: nobody is left at the other end. */
    bool receive(const int line, std::vector<std::string> &texts)
    {
      std::string all;
      const ssize_t size = receive(line, all, MSG_PEEK | MSG_TRUNC);
      if (size <= 0)
        return false;
      all.resize(static_cast<std::size_t>(size));
      if (receive(line, all, 0) != size)
        return false;
      texts.clear();
      for (std::size_t begin = 0; begin < all.size();)
      {
        const std::size_t end = all.find('\0', begin);
        texts.push_back(all.substr(begin, end - begin));
        begin = end + 1;
      }
      return true;
    }

    /** What the kept process does as long as somebody may ask it. */
    [[noreturn]] void stand_by(const int line, const MainFunction program,
                               const pid_t parent)
    {
      end_with(parent);
      // What ends the run that is on is for that to say.
      std::signal(SIGINT, SIG_IGN);
      std::signal(SIGTERM, SIG_IGN);
      std::vector<std::string> texts;
      while (receive(line, texts))
      {
        ChildOptions options;
        options.folder = texts[0];
        options.log = texts[1];
        options.limit = std::stod(texts[2]);
        const auto n = static_cast<std::ptrdiff_t>(std::stoul(texts[3]));
        const auto words = texts.begin() + 4;
        options.environment.assign(words + n, texts.end());
        ChildResult result;
        try
        {
          result = run_child({words, words + n}, options, program);
        }
        catch (const std::runtime_error &)
        {
          result.ended = ChildResult::Ended::not_found;
        }
        if (!send(line, {std::to_string(static_cast<int>(result.ended)),
                         std::to_string(result.code)}))
          break;
      }
      _exit(0);
    }

    /** Let it run @p words; false: it is gone. */
    bool ask_loaded(const std::vector<std::string> &words,
                    const ChildOptions &options, ChildResult &result)
    {
      std::vector<std::string> texts = {
          options.folder.string(), options.log.string(),
          std::to_string(options.limit), std::to_string(words.size())};
      texts.insert(texts.end(), words.begin(), words.end());
      texts.insert(texts.end(), options.environment.begin(),
                   options.environment.end());
      if (!send(line_to_loaded, texts) || !receive(line_to_loaded, texts))
        return false;
      result = {static_cast<ChildResult::Ended>(std::stoi(texts[0])),
                std::stoi(texts[1])};
      return true;
    }
  } // namespace

  void keep_loaded(const MainFunction program)
  {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
      return;
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process == 0)
    {
      close(ends[0]);
      stand_by(ends[1], program, parent);
    }
    close(ends[1]);
    if (process > 0)
      line_to_loaded = ends[0];
    else
      close(ends[0]);
  }

  ChildResult run_this_program(std::vector<std::string> words,
                               const ChildOptions &options)
  {
    words.insert(words.begin(),
                 std::filesystem::read_symlink("/proc/self/exe").string());
    ChildResult result;
    if (line_to_loaded >= 0 && ask_loaded(words, options, result))
      return result;
    return run_child(words, options);
  }
} // namespace abut::app
