// SPDX-License-Identifier: LGPL-2.1-or-later
#include "command_line.h"

#include "app/input/input_error.h"

#include <abut/dealii/nearest_word.h>

#include <map>

namespace abut::app
{
  namespace
  {
    using Command = CommandLine::Command;

    const std::map<std::string, Command> commands = {
        {"run", Command::run},       {"check", Command::check},
        {"search", Command::search}, {"chart", Command::chart},
        {"atlas", Command::atlas},   {"draw", Command::tool},
        {"report", Command::tool},   {"parameters", Command::parameters},
        {"help", Command::help},     {"--help", Command::help},
        {"-h", Command::help},       {"--version", Command::version}};

    const char *const general_help =
        R"(abut - contact mechanics with deal.II

  abut run SCENE.prm      solve a scene
  abut check SCENE.prm    read a scene, check its data and stop before solving
  abut draw FOLDER        draw pictures of a run
  abut report FOLDER      write a page about a run
  abut search SCENE.prm   search contact on two surfaces: pairs, time, memory
  abut chart FILE.prm     run a scene in many ways: error against time, work, ...
  abut atlas [FOLDER]     run the scenes of known failures and their cures
  abut parameters         print the reference of all parameters (Markdown)
  abut help COMMAND       explain a command
  abut --version          print the versions of abut, deal.II and Trilinos

In parallel: mpirun -n 4 abut run SCENE.prm
)";

    const std::map<std::string, std::string> topics = {
        {"run", R"(abut run SCENE.prm [options]

Solve the scene and write its results.

  --set "Section/Name=value"  override a parameter of the file; may be repeated
  --set-if-used "..."         the same, for series of runs: not an error where
                              the run does not use it; --set counts more
  --output DIR                folder of the results
                              (default: output/<name of the scene file>)
  --resume                    go on from the last checkpoint in that folder, of
                              the same scene, on any number of ranks
  --quiet                     print warnings and errors only
  --explain                   say at the end what could be left out, at the
                              target error if there is one

Results: summary.json (the figures of the run), levels.csv (a row per mesh
level or outer step), and what the section Output of the scene asks for. Data of
the problem that change nothing are an error; settings of methods that the run
does not use are listed at the end, and are an error if --set gave them.

Exit code: 0 solved, 2 wrong input, 3 no answer to rely on (what there is was
written), 4 stopped by SIGTERM or SIGINT after a checkpoint was written (go on
with --resume), 1 internal error.
)"},
        {"check", R"(abut check SCENE.prm [--set "Section/Name=value"]...

Read the scene, check everything that can be found out without solving, and
print what would be solved, on the first mesh: unknowns, boundary ids with the
number of their faces and where they are, pairs. Exit code 0 when all is well, 2 when not.
)"},
        {"search", R"(abut search SCENE.prm [options]

Run the contact search of a scene of kind 'search' by itself: print pairs, time
per node, memory, a report on what was found, and the time of the search over
the size of its buckets for each algorithm. Options, results and exit codes are
those of 'abut run'; the sweep is written as sweep.csv and, with
--set Output/Pictures=true, as search.svg. It uses one rank.
)"},
        {"chart", R"(abut chart FILE.prm [options]

Run one scene with many methods, meshes and parameters, as FILE.prm asks
(prm/charts has examples), each run in a process of its own on one thread, and
chart errors against time, work and parameters.

  --set "Name=value"  override a parameter of FILE.prm; may be repeated
  --output DIR        folder of the results (default: output/<name of FILE>)
  --plan              print the points and stop before the first run
  --quiet             print warnings and errors only

Results: runs.csv (a row per run, failed ones included), cheapest.md (the
cheapest way to reach each error), pictures (SVG), and the runs themselves in
the folder 'runs'. Started again, it makes only the runs that are missing; a
changed setting, scene or program is a new run.

Exit code: 0 charted, 2 wrong input, 3 no run gave an answer to chart, 1
internal error.
)"},
        {"atlas", R"(abut atlas [FOLDER | SCENE.prm] [options]

Run the failure atlas, pairs of scenes NAME.prm that fail and NAME.cure.prm
that do not (default: prm/failures), or one pair of it. Compare what the runs
show with what the comments in the files expect, and write a page about it.

  --output DIR    folder of the runs (default: output/atlas)
  --report FILE   the page (default: failures.md in that folder)
  --quiet         print only what is not as expected

Exit code: 0 all as expected, 3 not all, 2 wrong input.
)"},
        {"draw", R"(abut draw FOLDER [options]

Draw the pictures of a run from the files in its output folder, as SVG and PNG.
It needs Python 3 with NumPy and Matplotlib.

  --output DIR     folder of the pictures (default: FOLDER)
  --width MM       width in mm, 84 (a column) or 174 (a page; default)
  --picture NAME   draw this picture only; may be repeated
  --quiet          print warnings and errors only

ABUT_PYTHON in the environment names the Python interpreter; otherwise the first
of python3 and /usr/bin/python3 that has both packages is used.

Exit code: 0 drawn, 2 wrong input or no such Python, 3 nothing to draw.
)"},
        {"report", R"(abut report FOLDER [options]

Write report.html, a page about a run, from the files in its output folder: how
it ended, a sketch of the problem, results, pictures, the examination of the
answer, its cost, parameters and files. It is one file, needs no network, and
can be printed; doc/report.md explains it. Runs that were killed or whose scene
has an error have a page, too. It needs Python 3 with NumPy and Matplotlib, see
abut help draw.

  --output FILE  the page (default: report.html in FOLDER)
  --quiet        print warnings and errors only

Exit code: 0 written, 2 wrong input or no such Python.
)"},
        {"parameters", R"(abut parameters

Print all parameters of all scenes with their defaults, legal values and
meaning, as Markdown.
)"},
        {"help", R"(abut help [COMMAND]

Print the commands, or explain one.
)"}};

    std::vector<std::string> names(const std::map<std::string, Command> &map)
    {
      std::vector<std::string> result;
      for (const auto &entry : map)
        result.push_back(entry.first);
      return result;
    }

    /** The value of option @p words[i], which the next word must be. */
    const std::string &value_of(const std::vector<std::string> &words,
                                std::size_t &i)
    {
      if (i + 1 == words.size())
        throw InputError("", "option '" + words[i] + "' needs a value.");
      return words[++i];
    }

    bool takes_scene(const Command command)
    {
      return command == Command::run || command == Command::check
             || command == Command::search;
    }

    std::vector<std::string> options_of(const Command command)
    {
      if (command == Command::atlas)
        return {"--output", "--report", "--quiet"};
      if (takes_scene(command))
        return {"--set", "--set-if-used", "--output", "--quiet"};
      return {"--set", "--output", "--quiet"};
    }

    void parse_file_command(const std::vector<std::string> &words,
                            CommandLine &result)
    {
      for (std::size_t i = 1; i < words.size(); ++i)
        if (words[i] == "--set" && result.command != Command::atlas)
          result.overrides.push_back(value_of(words, i));
        else if (words[i] == "--set-if-used" && takes_scene(result.command))
          result.offers.push_back(value_of(words, i));
        else if (words[i] == "--output")
          result.output = value_of(words, i);
        else if (words[i] == "--quiet")
          result.quiet = true;
        else if (words[i] == "--resume" && result.command == Command::run)
          result.resume = true;
        else if (words[i] == "--explain" && result.command == Command::run)
          result.explain = true;
        else if (words[i] == "--plan" && result.command == Command::chart)
          result.plan = true;
        else if (words[i] == "--report" && result.command == Command::atlas)
          result.report = value_of(words, i);
        else if (words[i].size() > 1 && words[i][0] == '-')
          throw InputError(
              "", "'" + words[0] + "' has no option '" + words[i] + "'."
                      + did_you_mean(words[i], options_of(result.command)));
        else if (!result.file.empty())
          throw InputError("", "one file at a time: '" + result.file + "' and '"
                                   + words[i] + "' were given.");
        else
          result.file = words[i];
      if (result.file.empty() && result.command == Command::atlas)
        result.file = "prm/failures";
      if (result.file.empty())
        throw InputError("", "'" + words[0] + "' needs a scene file: abut "
                                 + words[0] + " FILE.prm");
    }
  } // namespace

  CommandLine parse_command_line(const std::vector<std::string> &words)
  {
    CommandLine result;
    if (words.empty())
      return result;
    const auto command = commands.find(words[0]);
    if (command == commands.end())
      throw InputError("", "there is no command '" + words[0] + "'."
                               + did_you_mean(words[0], names(commands))
                               + " 'abut --help' lists the commands.");
    result.command = command->second;
    result.words = words;
    if (words.size() == 2 && (words[1] == "--help" || words[1] == "-h"))
    {
      result.command = Command::help;
      result.topic = words[0];
    }
    else if (result.command == Command::run || result.command == Command::check
             || result.command == Command::search
             || result.command == Command::chart
             || result.command == Command::atlas)
      parse_file_command(words, result);
    else if (result.command == Command::help && words.size() == 2)
      result.topic = words[1];
    else if (words.size() > 1 && result.command != Command::tool)
      throw InputError("", "'" + words[0] + "' takes no '" + words[1] + "'.");
    return result;
  }

  std::string help_text(const std::string &topic)
  {
    if (topic.empty())
      return general_help;
    const auto found = topics.find(topic);
    if (found == topics.end())
    {
      std::vector<std::string> words;
      for (const auto &entry : topics)
        words.push_back(entry.first);
      throw InputError("", "there is no help on '" + topic + "'."
                               + did_you_mean(topic, words));
    }
    return found->second;
  }
} // namespace abut::app
