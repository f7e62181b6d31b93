// SPDX-License-Identifier: LGPL-2.1-or-later
#include "status_file.h"

#include "app/restart/disk.h"
#include "json.h"

#include <abut/version.h>

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <ctime>
#include <sstream>
#include <utility>

namespace abut::app
{
  namespace
  {
    constexpr int no_code = -1;

    /** UTC, as ISO 8601 has it. */
    std::string now()
    {
      const std::time_t time = std::time(nullptr);
      std::tm parts = {};
      gmtime_r(&time, &parts);
      char text[32];
      std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &parts);
      return text;
    }

    std::string host()
    {
      char name[256] = "";
      gethostname(name, sizeof(name) - 1);
      return name;
    }

    /** A word of a command as a shell takes it. */
    std::string quoted(const std::string &word)
    {
      if (!word.empty()
          && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                    "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                    "0123456789_-+=./,:@%")
                 == std::string::npos)
        return word;
      std::string result = "'";
      for (const char c : word)
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
      return result + "'";
    }

    std::string command_of(const std::vector<std::string> &words,
                           const int n_ranks)
    {
      std::string result =
          n_ranks > 1 ? "mpirun -n " + std::to_string(n_ranks) + " abut"
                      : "abut";
      for (const std::string &word : words)
        result += " " + quoted(word);
      return result;
    }

    const char *status_of(const ExitCode code)
    {
      switch (code)
      {
      case ExitCode::success:
        return "solved";
      case ExitCode::bad_input:
        return "input error";
      case ExitCode::unusable_answer:
        return "no answer";
      case ExitCode::stopped:
        return "stopped";
      case ExitCode::internal_error:
        break;
      }
      return "failed";
    }
  } // namespace

  StatusFile::StatusFile(MPI_Comm communicator, std::filesystem::path folder,
                         const std::vector<std::string> &words,
                         std::string scene_file)
      : folder(std::move(folder)),
        root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0),
        n_ranks(static_cast<int>(
            dealii::Utilities::MPI::n_mpi_processes(communicator))),
        command(command_of(words, n_ranks)),
        scene_file(std::move(scene_file)),
        started(now())
  {
  }

  std::string StatusFile::text(const std::string &status, const Message &error,
                               const bool has_results, const int code) const
  {
    std::ostringstream out;
    JsonWriter json(out);
    json.begin();
    json.value("status", status);
    if (code == no_code)
      json.value("exit_code", std::monostate());
    else
      json.value("exit_code", static_cast<std::int64_t>(code));
    json.value("error", error.text);
    const auto *known = abut_failure_get(error.failure);
    json.value("code", std::string(known ? known->code : ""));
    json.value("has_results", has_results);
    json.value("command", command);
    json.value("scene_file", scene_file);
    json.value("working_folder", std::filesystem::current_path().string());
    json.value("started", started);
    json.value("ended", code == no_code ? std::string() : now());
    json.value("ranks", static_cast<std::int64_t>(n_ranks));
    json.value("host", host());
    json.value("process", static_cast<std::int64_t>(getpid()));
    json.value("abut", std::string(ABUT_VERSION));
    json.value("deal.II", std::string(DEAL_II_PACKAGE_VERSION));
    json.end();
    return out.str();
  }

  void StatusFile::begin()
  {
    if (root)
      replace_on_disk(folder / "run.json", text("running", "", false, no_code));
  }

  void StatusFile::end(const ExitCode code, const Message &error,
                       const bool has_results) noexcept
  try
  {
    if (root && std::filesystem::is_directory(folder))
      replace_on_disk(
          folder / "run.json",
          text(status_of(code), error, has_results, static_cast<int>(code)));
  }
  catch (const std::exception &)
  {
    // The program ends with an error of its own; without room there is none to
    // record it.
    return;
  }
} // namespace abut::app
