// SPDX-License-Identifier: LGPL-2.1-or-later
#include "command_line.h"

#include "app/input/input_error.h"
#include "app/report/failure_list.h"

#include <abut/dealii/nearest_word.h>

#include <map>

namespace abut::app
{
  namespace
  {
    using Command = CommandLine::Command;

    const std::map<std::string, Command> commands = {
        {"new", Command::new_scene},
        {"run", Command::run},
        {"check", Command::check},
        {"search", Command::search},
        {"chart", Command::tool},
        {"atlas", Command::tool},
        {"draw", Command::tool},
        {"report", Command::tool},
        {"parameters", Command::parameters},
        {"serve", Command::serve},
        {"help", Command::help},
        {"--help", Command::help},
        {"-h", Command::help},
        {"--version", Command::version}};

    const char *const general_help =
        R"(abut - contact mechanics with deal.II

  abut new KIND [FILE]    write a commented scene to begin with: block, hertz,
                          two-bodies, friction, sliding, impact, obstacle,
                          masses
  abut run SCENE.prm      solve a scene
  abut check SCENE.prm    read a scene, check its data and stop before solving
  abut draw FOLDER        draw pictures of a run
  abut report FOLDER      write a page about a run
  abut search SCENE.prm   search contact on two surfaces: pairs, time, memory
  abut chart FILE.prm     run a series of a scene: error against time, work, ...
  abut atlas [FOLDER]     run the scenes of known failures and their cures
  abut parameters         print the reference of all parameters (Markdown)
  abut serve              run the commands that come on standard input
  abut help COMMAND       explain a command
  abut --version          print the versions of abut, deal.II and Trilinos

In parallel: mpirun -n 4 abut run SCENE.prm
)";

    const std::map<std::string, std::string> topics = {
        {"new", R"(abut new KIND [FILE.prm]

Write a scene to begin with, with comments and the exact values that its results
are compared with, into FILE.prm (default: KIND.prm), which must not exist:

  block        a block on a rigid plane
  hertz        two cylinders, refined where they touch
  two-bodies   a block on another one, meshes that do not match
  friction     a rigid plate that slides on a block
  sliding      a block dragged over a soft one: finite strain, large sliding
  impact       a bar that hits a wall
  obstacle     a membrane over an obstacle
  masses       a mass on a spring above a support
)"},
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
  --verbose                   print all lines of progress, all figures of
                              summary.json, the model, its cost
  --explain                   print at the end which parts could be left out, at
                              the target error if there is one

Results: summary.json (the figures of the run), levels.csv (a row per mesh
level or outer step), and the files of section Output. Data of the
problem without effect are an error; settings of methods that the run does not
use are listed at the end, and are an error in --set.

Exit code: 0 solved, 2 wrong input, 3 no reliable result (the last one was
written), 4 stopped by SIGTERM or SIGINT after a checkpoint was written (go on
with --resume), 1 internal error.
)"},
        {"check", R"(abut check SCENE.prm [options]

Read the scene, check it without solving, and print the problem on the first
mesh: boundary ids with areas, positions and mean normals, rigid body modes that
supports leave, sums of the loads on each body, obstacles, pairs, and the
unknowns and memory of the run.
Exit code 0 without errors, else 2.

  --set "Section/Name=value"  override a parameter of the file; may be repeated
  --values                    print all parameters with their values (JSON), and
                              check no more than these
  --draw FILE                 draw a sketch of bodies or membranes (SVG, PNG or
                              PDF): boundary ids, supports, loads, pairs,
                              obstacles; also where a wrong boundary id is an
                              error. It needs Python, see abut help draw
)"},
        {"search", R"(abut search SCENE.prm [options]

Run the contact search of a scene of kind 'search' by itself: print pairs, time
per node, memory, a report on the pairs, and the time of the search over
the size of its buckets for each algorithm. Options, results and exit codes are
those of 'abut run'; the sweep is written as sweep.csv and, with
--set Output/Pictures=true, as search.svg. It uses one rank.
)"},
        {"chart", R"(abut chart FILE.prm [options]

Run one scene with the methods, meshes and parameters of FILE.prm
(prm/charts has examples), each run in a process of its own on one thread, and
chart errors against time, work and parameters.

  --set "Name=value"  override a parameter of FILE.prm; may be repeated
  --output DIR        folder of the results (default: output/<name of FILE>)
  --plan              print the points and stop before the first run
  --parameters        print the parameters of chart files and stop
  --quiet             print warnings and errors only

Results: runs.csv (a row per run, failed ones included), cheapest.md (the
cheapest run for each error), pictures (SVG, PNG), and the runs themselves in
the folder 'runs'. Started again, it makes only the runs that are missing; a
changed setting, scene or program is a new run.

Exit code: 0 charted, 2 wrong input, 3 no run gave an answer to chart, 1
internal error.
)"},
        {"atlas", R"(abut atlas [FOLDER | SCENE.prm] [options]

Run the failure atlas, pairs of scenes NAME.prm that fail and NAME.cure.prm
that do not (default: prm/failures), or one pair of it. Compare the results with
the expectations in the comments of the files, and write a page about it.

  --output DIR    folder of the runs (default: output/atlas)
  --report FILE   the page (default: failures.md in that folder); its pictures
                  are in pictures/failures
  --no-pictures   do not draw the runs
  --quiet         print only unexpected results

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
        {"parameters", R"(abut parameters [options]

Print the parameters of scenes with defaults, types and ranges, units, levels
and meaning, as Markdown.

  --scene KIND   those of one kind of scenes, such as solid
  --level LEVEL  basic, advanced (basic ones as well) or expert (all: default)
)"},
        {"serve", R"(abut serve

Run the commands that come on standard input, one after the other, each in a
process of its own: the program is loaded once. For programs that make many
runs, such as 'abut chart'; serve.cc in the sources describes a request.
)"},
        {"help", R"(abut help [COMMAND | failures]

Print the commands, explain one, or list the known failures by code.
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

    void parse_reference_command(const std::vector<std::string> &words,
                                 CommandLine &result)
    {
      for (std::size_t i = 1; i < words.size(); ++i)
        if (words[i] == "--scene")
          result.kind = value_of(words, i);
        else if (words[i] == "--level")
          result.level = value_of(words, i);
        else
          throw InputError(
              "", "'parameters' takes no '" + words[i] + "'."
                      + did_you_mean(words[i], {"--scene", "--level"}));
    }

    bool takes_scene(const Command command)
    {
      return command == Command::run || command == Command::check
             || command == Command::search;
    }

    std::vector<std::string> options_of(const Command command)
    {
      if (command == Command::check)
        return {"--set",  "--set-if-used", "--values",
                "--draw", "--quiet",       "--verbose"};
      return {"--set", "--set-if-used", "--output", "--quiet", "--verbose"};
    }

    void parse_file_command(const std::vector<std::string> &words,
                            CommandLine &result)
    {
      for (std::size_t i = 1; i < words.size(); ++i)
        if (words[i] == "--set")
          result.overrides.push_back(value_of(words, i));
        else if (words[i] == "--set-if-used")
          result.offers.push_back(value_of(words, i));
        else if (words[i] == "--output")
          result.output = value_of(words, i);
        else if (words[i] == "--quiet")
          result.quiet = true;
        else if (words[i] == "--verbose" && takes_scene(result.command))
          result.verbose = true;
        else if (words[i] == "--resume" && result.command == Command::run)
          result.resume = true;
        else if (words[i] == "--explain" && result.command == Command::run)
          result.explain = true;
        else if (words[i] == "--values" && result.command == Command::check)
          result.values = true;
        else if (words[i] == "--draw" && result.command == Command::check)
          result.sketch = value_of(words, i);
        else if (words[i].size() > 1 && words[i][0] == '-')
          throw InputError(
              "", "'" + words[0] + "' has no option '" + words[i] + "'."
                      + did_you_mean(words[i], options_of(result.command)));
        else if (!result.file.empty())
          throw InputError("", "one file at a time: '" + result.file + "' and '"
                                   + words[i] + "' were given.");
        else
          result.file = words[i];
      if (result.quiet && result.verbose)
        throw InputError("", "--quiet and --verbose exclude each other.");
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
    if (words.size() >= 2 && (words.back() == "--help" || words.back() == "-h"))
    {
      result.command = Command::help;
      result.topic = words[0];
    }
    else if (takes_scene(result.command))
      parse_file_command(words, result);
    else if (result.command == Command::parameters)
      parse_reference_command(words, result);
    else if (result.command == Command::new_scene && words.size() <= 3)
    {
      result.topic = words.size() > 1 ? words[1] : "";
      result.file = words.size() > 2 ? words[2] : "";
      if (result.file.rfind('-', 0) == 0)
        throw InputError("", "'new' has no option '" + result.file
                                 + "': abut new KIND [FILE.prm].");
    }
    else if (result.command == Command::help && words.size() == 2)
      result.topic = words[1];
    else if (words.size() > 1 && result.command != Command::tool)
      throw InputError("",
                       "'" + words[0] + "' takes no '" + words.back() + "'.");
    return result;
  }

  std::string help_text(const std::string &topic)
  {
    if (topic.empty())
      return general_help;
    if (topic == "failures")
      return failure_list();
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
