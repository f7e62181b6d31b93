// SPDX-License-Identifier: LGPL-2.1-or-later
#include "loaded_program.h"

#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    /** Our end of the line to the process that is kept loaded; -1: there is
     * none. */
    int line_to_loaded = -1;

    /** How many bytes follow, and texts, each ended by a zero byte. */
    bool send(const int line, const std::vector<std::string> &texts)
    {
      std::string all;
      for (const std::string &text : texts)
        all.append(text).push_back('\0');
      const std::uint64_t size = all.size();
      all.insert(0, reinterpret_cast<const char *>(&size), sizeof(size));
      for (std::size_t done = 0; done < all.size();)
      {
        const ssize_t n =
            ::send(line, all.data() + done, all.size() - done, MSG_NOSIGNAL);
        if (n < 0 && errno != EINTR)
          return false;
        done += n > 0 ? static_cast<std::size_t>(n) : 0;
      }
      return true;
    }

    bool receive(const int line, char *data, const std::size_t size)
    {
      for (std::size_t done = 0; done < size;)
      {
        const ssize_t n = recv(line, data + done, size - done, 0);
        if (n == 0 || (n < 0 && errno != EINTR))
          return false;
        done += n > 0 ? static_cast<std::size_t>(n) : 0;
      }
      return true;
    }

    /** False: nobody is left at the other end. */
    bool receive(const int line, std::vector<std::string> &texts)
    {
      std::uint64_t size = 0;
      if (!receive(line, reinterpret_cast<char *>(&size), sizeof(size)))
        return false;
      std::string all(size, '\0');
      if (!receive(line, all.data(), size))
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
#ifdef __linux__
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent)
        _exit(0);
#else
      (void)parent;
#endif
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
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
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
