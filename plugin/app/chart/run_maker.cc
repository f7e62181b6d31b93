// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_maker.h"

#include "app/input/short_number.h"
#include "app/process/loaded_program.h"
#include "app/report/report.h"

#include <abut/version.h>

#include <deal.II/base/config.h>

#include <chrono>
#include <cstring>
#include <sstream>

namespace abut::app
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string hash_of_file(const fs::path &file)
    {
      return RunStore::key(file_bytes(file));
    }

    /** The file that @p value names, beside the scene or from here; empty if it
     * names none. */
    fs::path named_file(const std::string &value, const fs::path &scene_file)
    {
      std::error_code error;
      for (const fs::path &path :
           {scene_file.parent_path() / value, fs::path(value)})
        if (!value.empty() && fs::is_regular_file(path, error))
          return path;
      return {};
    }

    /** What the run had to say at its end: the error, else the last warning. */
    std::string last_words(const fs::path &log)
    {
      std::istringstream lines(file_bytes(log));
      std::string line, error, warning;
      const auto take = [&line](const char *beginning, std::string &text)
      {
        if (line.compare(0, std::strlen(beginning), beginning) == 0)
          text = line.substr(std::strlen(beginning));
      };
      while (std::getline(lines, line))
      {
        take("abut: error: ", error);
        take("abut: internal error: ", error);
        take("abut: warning: ", warning);
      }
      return error.empty() ? warning : error;
    }

    void judge(const ChildResult &child, RunRecord &record)
    {
      using Ended = ChildResult::Ended;
      record.code = child.ended == Ended::exited ? child.code : -child.code;
      if (child.ended == Ended::out_of_time)
      {
        record.ended = "out of time";
        record.code = 0;
        record.reason = "ended at the limit of " + short_number(record.limit, 6)
                        + " processor seconds";
      }
      else if (child.ended != Ended::exited)
      {
        record.ended = "failed";
        record.reason =
            child.ended == Ended::signalled
                ? std::string("ended by signal: ") + strsignal(child.code)
                : "the program did not start";
      }
      else
        record.ended = child.code == 0   ? "ok"
                       : child.code == 2 ? "refused"
                       : child.code == 3 ? "unusable"
                                         : "failed";
    }
  } // namespace

  RunMaker::RunMaker(const std::string &scene_file)
      : scene_file(scene_file), environment(serial_environment())
  {
    identity = std::string("abut " ABUT_VERSION " ")
               + hash_of_file("/proc/self/exe") + ", deal.II "
               + DEAL_II_PACKAGE_VERSION;
  }

  LoadedScene RunMaker::load(const std::vector<Assignment> &overrides) const
  {
    ParameterFile file(scene_file, {});
    for (const Assignment &assignment : overrides)
      file.append(assignment);
    try
    {
      return LoadedScene(file);
    }
    catch (const InputError &error)
    {
      throw file.placed(error);
    }
  }

  RunSetting RunMaker::setting(const LoadedScene &scene,
                               const std::vector<Assignment> &overrides) const
  {
    std::string text = identity + "\n";
    for (const auto &[path, value] : scene.file.values())
    {
      text += path + " = " + value + "\n";
      const fs::path file = named_file(value, scene_file);
      if (!file.empty())
        text += "  file " + hash_of_file(file) + "\n";
    }
    return {overrides, text};
  }

  RunRecord RunMaker::run(const RunStore &store, const RunSetting &setting,
                          const unsigned int repeat, const double limit,
                          bool &made) const
  {
    const auto finished = store.find(setting.text, repeat, limit);
    made = !finished;
    return finished ? *finished : make(store, setting, repeat, limit);
  }

  RunRecord RunMaker::make(const RunStore &store, const RunSetting &setting,
                           const unsigned int repeat, const double limit) const
  {
    const fs::path folder = store.begin(setting.text, repeat);
    std::vector<std::string> words = {"run", scene_file, "--quiet", "--output",
                                      folder.string()};
    for (const Assignment &assignment : setting.overrides)
    {
      // A curve need not use what the axis changes.
      words.push_back("--set-if-used");
      words.push_back(assignment.path + "=" + assignment.value);
    }
    ChildOptions options;
    options.log = folder / "log.txt";
    options.environment = environment;
    options.limit = limit;
    RunRecord record;
    record.setting = setting.text;
    record.limit = limit;
    const auto start = std::chrono::steady_clock::now();
    const ChildResult child = run_this_program(words, options);
    record.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
            .count();
    judge(child, record);
    if (record.ended != "ok" && record.reason.empty())
      record.reason = last_words(options.log);
    record.figures = RunFigures(folder);
    store.finish(record, repeat);
    return record;
  }
} // namespace abut::app
