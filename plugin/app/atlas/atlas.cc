// SPDX-License-Identifier: LGPL-2.1-or-later
#include "atlas.h"

#include "app/input/output_folder.h"
#include "app/process/loaded_program.h"

#include <fstream>
#include <iostream>

namespace abut::app
{
  namespace
  {
    /** Processor seconds after which a run of the atlas counts as hanging. */
    constexpr double time_limit = 300.;

    /** The warnings and errors in what a run has printed. */
    std::vector<std::string> messages_of(const std::filesystem::path &log)
    {
      const std::string mark = "abut: ";
      std::vector<std::string> messages;
      std::ifstream in(log);
      std::string line;
      while (std::getline(in, line))
        if (line.rfind(mark, 0) == 0)
          messages.push_back(line.substr(mark.size()));
      return messages;
    }

    AtlasRun run_scene(const AtlasEntry &entry, const AtlasScene &scene,
                       const std::filesystem::path &folder,
                       const std::string &value)
    {
      // What an earlier run has left must not be taken for this one's.
      std::filesystem::remove_all(folder);
      make_output_folder(folder);
      std::vector<std::string> words = {"run",
                                        scene.file.string(),
                                        "--quiet",
                                        "--output",
                                        folder.string(),
                                        "--set",
                                        "Output/Pictures=false",
                                        "--set",
                                        "Output/Report=false"};
      if (!value.empty())
      {
        words.push_back("--set");
        words.push_back(entry.varied + "=" + value);
      }
      AtlasRun run;
      ChildOptions options;
      options.log = folder / "log.txt";
      options.environment = serial_environment();
      options.limit = time_limit;
      const ChildResult child = run_this_program(words, options);
      run.exit_code =
          child.ended == ChildResult::Ended::exited ? child.code : -child.code;
      run.figures = RunFigures(folder);
      run.messages = messages_of(options.log);
      for (const std::string &message : run.messages)
        run.says_code =
            run.says_code
            || message.find(entry.failure != nullptr ? entry.failure->code
                                                     : "ABUT-F")
                   != std::string::npos;
      return run;
    }

    void check_run(const AtlasScene &scene, const AtlasRun &run,
                   const RunFigures &cure, AtlasResult &result)
    {
      const std::string file = scene.file.filename().string();
      const int code = run.exit_code;
      if (code != scene.exit_code)
        result.complaints.push_back(file + ": exit code " + std::to_string(code)
                                    + " instead of "
                                    + std::to_string(scene.exit_code));
      for (const Symptom &symptom : scene.symptoms)
        if (!symptom.holds(run.figures, cure))
          result.complaints.push_back(file
                                      + ": does not hold: " + symptom.text);
    }

    void check(AtlasResult &result)
    {
      const AtlasEntry &entry = result.entry;
      const bool must_say = entry.failure != nullptr;
      check_run(entry.failing, result.failing, result.cure.figures, result);
      check_run(entry.cure, result.cure, result.failing.figures, result);
      const std::string code = must_say ? entry.failure->code : "any code";
      if (must_say && !result.failing.says_code)
        result.complaints.push_back("the run that fails does not say " + code);
      if (!must_say && result.failing.says_code)
        result.complaints.push_back("a run that does not fail names a code");
      if (result.cure.says_code)
        result.complaints.push_back("the cure still says " + code);
    }
  } // namespace

  AtlasResult run_entry(const AtlasEntry &entry,
                        const std::filesystem::path &folder)
  {
    AtlasResult result;
    result.entry = entry;
    result.failing = run_scene(entry, entry.failing, folder / "failing", "");
    result.cure = run_scene(entry, entry.cure, folder / "cure", "");
    for (const std::string &value : entry.values)
      result.varied.emplace_back(
          run_scene(entry, entry.failing, folder / "failing-varied", value)
              .figures,
          run_scene(entry, entry.cure, folder / "cure-varied", value).figures);
    check(result);
    return result;
  }

  ExitCode run_atlas(const AtlasOptions &options)
  {
    std::vector<AtlasResult> results;
    bool all_hold = true;
    for (const AtlasEntry &entry : read_atlas(options.path))
    {
      results.push_back(run_entry(entry, options.output / entry.name));
      const std::vector<std::string> &complaints = results.back().complaints;
      all_hold = all_hold && complaints.empty();
      if (!options.quiet || !complaints.empty())
        std::cout << (entry.failure ? entry.failure->code : "none    ") << "  "
                  << (complaints.empty() ? "as expected  " : "UNEXPECTED   ")
                  << entry.name << std::endl;
      for (const std::string &complaint : complaints)
        std::cout << "            " << complaint << std::endl;
    }
    std::ofstream page(options.report);
    write_atlas(results, page);
    if (!page.flush())
      throw InputError("", "cannot write '" + options.report.string() + "'.");
    if (!options.quiet)
      std::cout << results.size() << " entries, page in "
                << options.report.string() << std::endl;
    return all_hold ? ExitCode::success : ExitCode::unusable_answer;
  }
} // namespace abut::app
