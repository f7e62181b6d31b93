// SPDX-License-Identifier: LGPL-2.1-or-later
#include "program.h"

#include "app/input/collective.h"
#include "app/input/output_folder.h"
#include "app/report/status_file.h"
#include "app/restart/disk.h"
#include "app/restart/restart.h"
#include "app/restart/run_lock.h"
#include "app/scenes/common_parameters.h"
#include "app/scenes/loaded_scene.h"
#include "app/scenes/parameter_reference.h"
#include "command_line.h"
#include "new_scene.h"
#include "tools.h"

#include <abut/version.h>

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>

#include <fnmatch.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace abut::app
{
  namespace
  {
    using Command = CommandLine::Command;

    bool is_root(MPI_Comm communicator)
    {
      return dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    }

    void print_version(std::ostream &out)
    {
      out << "abut " << ABUT_VERSION << "\n"
          << "deal.II " << DEAL_II_PACKAGE_VERSION << "\n"
          << "Trilinos " << DEAL_II_TRILINOS_VERSION_MAJOR << "."
          << DEAL_II_TRILINOS_VERSION_MINOR << "."
          << DEAL_II_TRILINOS_VERSION_SUBMINOR << "\n";
    }

    void require_search(const LoadedScene &loaded)
    {
      const std::string kind = loaded.kind();
      if (kind != "search")
        throw InputError("Scene", "'abut search' takes scenes of kind "
                                  "'search'; this one is of kind '"
                                      + kind + "', which searches no facets.");
    }

    std::filesystem::path output_folder(const CommandLine &line)
    {
      if (!line.output.empty())
        return line.output;
      return "output" / std::filesystem::path(line.file).stem();
    }

    void prepare_output(MPI_Comm communicator,
                        const std::filesystem::path &folder)
    {
      collective(communicator,
                 [&]
                 {
                   if (is_root(communicator))
                     make_output_folder(folder);
                 });
    }

    RunOptions run_options(MPI_Comm communicator, const CommandLine &line,
                           LoadedScene &loaded)
    {
      RunOptions options;
      options.communicator = communicator;
      options.scene_file = line.file;
      options.output_folder = output_folder(line);
      options.pictures = loaded.get("Output", "Pictures") == "true";
      return options;
    }

    /** Null for scenes that write no checkpoints. */
    std::unique_ptr<Restart> make_restart(const LoadedScene &loaded,
                                          const RunOptions &options,
                                          const bool resumes)
    {
      const CheckpointParameters *parameters = loaded.scene->checkpoints();
      if (parameters == nullptr && resumes)
        throw InputError("Scene", std::string("scenes of kind '")
                                      + loaded.kind()
                                      + "' write no checkpoints: run it "
                                        "without --resume.");
      if (parameters == nullptr)
        return nullptr;
      RunIdentity identity;
      collective(options.communicator, [&] { identity = loaded.identity(); });
      return std::make_unique<Restart>(options.output_folder,
                                       options.communicator, *parameters,
                                       identity, resumes);
    }

    Verbosity verbosity(const CommandLine &line)
    {
      return line.quiet     ? Verbosity::quiet
             : line.verbose ? Verbosity::all
                            : Verbosity::brief;
    }

    /** "2 csv, 1 json, 3 vtu": the files of a folder, by ending. */
    std::string files_in(const std::filesystem::path &folder)
    {
      std::map<std::string, unsigned int> n_files;
      std::error_code error;
      for (const auto &file :
           std::filesystem::directory_iterator(folder, error))
        if (const std::string ending = file.path().extension().string();
            file.is_regular_file(error) && ending.size() > 1)
          ++n_files[ending.substr(1)];
      std::string text;
      for (const auto &[ending, n] : n_files)
        text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + ending;
      return text;
    }

    /** Run the scene. An error that comes when there are results already must
     * not cost them: they are written with it. */
    Outcome run_to_end(LoadedScene &loaded, const RunOptions &options,
                       Report &report)
    {
      try
      {
        return loaded.scene->run(options, report);
      }
      catch (const InputError &error)
      {
        // Nothing collective: perhaps not all ranks know.
        if (report.has_rows())
        {
          report.set("converged", false);
          report.warn("The run ended before its end: "
                      + std::string(error.what()));
          report.write(options.output_folder);
        }
        throw;
      }
    }

    /** Record in @p status that the run ended by an error. */
    void record_error(StatusFile &status, const std::exception &error,
                      const bool has_results)
    {
      if (const auto *input = dynamic_cast<const InputError *>(&error))
        status.end(ExitCode::bad_input, input->message(), has_results);
      else if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr)
        status.end(ExitCode::bad_input, no_memory, has_results);
      else
        status.end(ExitCode::internal_error, error.what(), has_results);
    }

    ExitCode solve_scene(LoadedScene &loaded, const RunOptions &options,
                         const CommandLine &line, Report &report)
    {
      MPI_Comm communicator = options.communicator;
      const Outcome outcome = run_to_end(loaded, options, report);
      loaded.describe_solution(report);
      if (outcome == Outcome::stopped)
      {
        report.print("\n  stopped; 'abut run ... --resume' goes on from the "
                     "checkpoint in "
                     + options.output_folder.string());
        return ExitCode::stopped;
      }
      report.set("converged", outcome == Outcome::converged);
      if (outcome == Outcome::converged)
        report.check_expected();
      report.finish();
      collective(communicator, [&] { report.write(options.output_folder); });
      if (options.restart != nullptr)
        options.restart->finish();
      report.print_summary();
      if (line.explain)
        report.explain();
      report.print("  results in " + options.output_folder.string() + ": "
                   + files_in(options.output_folder));
      if (!line.verbose)
        report.print("  all figures: summary.json, or abut run --verbose");
      return outcome == Outcome::converged ? ExitCode::success
                                           : ExitCode::unusable_answer;
    }

    /** The page about a run that ended in any way, if it is wanted. Rank 0
     * acts. */
    void write_page(MPI_Comm communicator, const std::filesystem::path &folder,
                    const std::string &wanted)
    {
      if (is_root(communicator) && wanted == "true")
        for (const std::string &warning : read_run("report", folder))
          std::cerr << "abut: warning: " << warning << std::endl;
    }

    /** Warnings about pictures are in the summary, too. Rank 0 acts. */
    void draw_pictures(const RunOptions &options, Report &report)
    {
      if (!options.pictures || !is_root(options.communicator))
        return;
      const auto warnings = read_run("draw", options.output_folder);
      for (const std::string &warning : warnings)
        report.warn(warning);
      if (!warnings.empty())
        report.write(options.output_folder);
    }

    /** Files of an earlier run that pages and pictures would take for those of
     * this one, as patterns of fnmatch(): the problem, and the results. */
    using Patterns = std::vector<std::string>;
    const Patterns of_problem = {"parameters.json", "outline.json",
                                 "obstacles.vtu"};

    Patterns of_results()
    {
      Patterns all = {"pair_[0-9]*.csv",     "fields.pvd",
                      "contact.pvd",         "fields_[0-9]*.vtu",
                      "fields_[0-9]*.pvtu",  "contact_[0-9]*.vtu",
                      "contact_[0-9]*.pvtu", "primary.vtu",
                      "secondary.vtu",       "report.html"};
      for (const char *table : {"levels", "steps", "newton", "motion", "masses",
                                "sweep", "nodal", "candidates"})
        all.push_back(std::string(table) + ".csv");
      for (const char *picture :
           {"bodies", "tractions", "convergence", "motion", "displacement",
            "active-set", "energy", "penalty", "lagrangian", "path", "search",
            "detection"})
        for (const char *format : {".svg", ".png"})
          all.push_back(std::string(picture) + format);
      return all;
    }

    void remove_files(const std::filesystem::path &folder,
                      const Patterns &patterns)
    {
      std::error_code ignored;
      std::vector<std::filesystem::path> found;
      for (const auto &file :
           std::filesystem::directory_iterator(folder, ignored))
        if (std::any_of(patterns.begin(), patterns.end(),
                        [&file](const std::string &pattern) {
                          return fnmatch(pattern.c_str(),
                                         file.path().filename().c_str(), 0)
                                 == 0;
                        }))
          found.push_back(file.path());
      for (const std::filesystem::path &file : found)
        std::filesystem::remove(file, ignored);
    }

    ExitCode run_scene(LoadedScene &loaded, RunOptions options,
                       const CommandLine &line)
    {
      MPI_Comm communicator = options.communicator;
      prepare_output(communicator, options.output_folder);
      const RunLock lock(options.output_folder, communicator);
      // An error of --resume changes no file.
      const std::unique_ptr<Restart> restart =
          make_restart(loaded, options, line.resume);
      options.restart = restart.get();
      StatusFile status(communicator, options.output_folder, line.words,
                        line.file);
      on_root(communicator,
              [&]
              {
                status.begin();
                remove_files(options.output_folder, of_problem);
                if (!line.resume)
                  remove_files(options.output_folder, of_results());
                write_file(options.output_folder / "parameters.json",
                           loaded.parameters_json());
              });
      Report report(communicator, verbosity(line));
      loaded.describe(report);
      const std::string page = loaded.get("Output", "Report");
      try
      {
        const ExitCode code = solve_scene(loaded, options, line, report);
        status.end(code, "", code != ExitCode::stopped);
        if (code == ExitCode::stopped)
          return code;
        draw_pictures(options, report);
        write_page(communicator, options.output_folder, page);
        return code;
      }
      catch (const InputError &error)
      {
        record_error(status, loaded.file.placed(error), report.has_rows());
        write_page(communicator, options.output_folder, page);
        throw;
      }
      catch (const std::exception &error)
      {
        record_error(status, error, false);
        throw;
      }
    }

    /** A scene with an error that is found before the run begins leaves its
     * status where there is a folder, or where its report is wanted. */
    void record_early_error(MPI_Comm communicator, const CommandLine &line,
                            const std::optional<ParameterFile> &file,
                            const std::optional<LoadedScene> &loaded,
                            const InputError &error)
    {
      const std::filesystem::path folder = output_folder(line);
      std::error_code ignored;
      const bool has_page = file && file->get("Output/Report", "") == "true";
      const bool wanted =
          line.command != Command::check && !line.resume
          && (has_page || std::filesystem::is_directory(folder, ignored));
      if (!dealii::Utilities::MPI::broadcast(communicator, wanted))
        return;
      try
      {
        prepare_output(communicator, folder);
        const RunLock lock(folder, communicator);
        if (!is_root(communicator))
          return;
        remove_files(folder, of_problem);
        if (loaded)
          write_file(folder / "parameters.json", loaded->parameters_json());
        StatusFile status(communicator, folder, line.words, line.file);
        record_error(status, error, false);
        write_page(communicator, folder,
                   file ? file->get("Output/Report", "") : "");
      }
      catch (const InputError &)
      {
        // Another run writes there, or there is no such folder: it is the
        // scene's error that the program reports.
        return;
      }
    }

    /** Temporary folder with the problem of a check, of which its sketch is
     * drawn. On rank 0. */
    class SketchFolder
    {
    public:
      SketchFolder(const LoadedScene &loaded, const std::string &sketch)
          : sketch(sketch),
            folder(std::filesystem::temp_directory_path()
                   / ("abut-check-" + std::to_string(getpid())))
      {
        make_output_folder(folder);
        write_file(folder / "parameters.json", loaded.parameters_json());
      }

      ~SketchFolder()
      {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
      }

      SketchFolder(const SketchFolder &) = delete;
      SketchFolder &operator=(const SketchFolder &) = delete;

      bool has_outline() const
      {
        return std::filesystem::exists(folder / "outline.json");
      }

      ExitCode draw(Report &report) const
      {
        const ExitCode code = run_tool({"sketch", folder.string(), sketch});
        if (code == ExitCode::success)
          report.print("  sketch: " + sketch);
        return code;
      }

      const std::string sketch;
      const std::filesystem::path folder;
    };

    ExitCode check_scene(LoadedScene &loaded, RunOptions options,
                         const CommandLine &line)
    {
      std::optional<SketchFolder> sketch;
      collective(options.communicator,
                 [&]
                 {
                   if (!is_root(options.communicator))
                     return;
                   check_output_folder(options.output_folder);
                   if (!line.sketch.empty())
                     sketch.emplace(loaded, line.sketch);
                 });
      // A scene writes its outline where there is a folder, which all ranks
      // must agree on; rank 0 alone writes into it.
      options.output_folder = sketch ? sketch->folder.string() : line.sketch;
      Report report(options.communicator, verbosity(line));
      loaded.describe(report);
      try
      {
        loaded.scene->check(options, report);
      }
      catch (const InputError &)
      {
        if (sketch && sketch->has_outline())
          sketch->draw(report);
        throw;
      }
      report.print_summary();
      report.print("\n  " + line.file + ": no errors found");
      return sketch ? sketch->draw(report) : ExitCode::success;
    }

    /** run, check and search. An error in the input is thrown with the place of
     * the parameter in front of the message. */
    ExitCode scene_command(MPI_Comm communicator, const CommandLine &line)
    {
      std::optional<LoadedScene> loaded;
      std::optional<ParameterFile> file;
      try
      {
        collective(communicator,
                   [&]
                   {
                     file.emplace(line.file, line.overrides, line.offers);
                     loaded.emplace(*file);
                     if (line.values && is_root(communicator))
                       std::cout << loaded->parameters_json() << std::flush;
                     if (line.command == Command::search)
                       require_search(*loaded);
                     loaded->parse();
                   });
      }
      catch (const InputError &error)
      {
        const InputError placed = file ? file->placed(error) : error;
        record_early_error(communicator, line, file, loaded, placed);
        throw placed;
      }
      try
      {
        if (line.values)
          return ExitCode::success;
        const RunOptions options = run_options(communicator, line, *loaded);
        return line.command == Command::check
                   ? check_scene(*loaded, options, line)
                   : run_scene(*loaded, options, line);
      }
      catch (const InputError &error)
      {
        throw file->placed(error);
      }
    }

    /** The program as it was called. */
    std::string own_name()
    {
      std::ifstream words("/proc/self/cmdline");
      std::string name;
      std::getline(words, name, '\0');
      return name.empty() ? "abut" : name;
    }

    ExitCode new_command(MPI_Comm communicator, const CommandLine &line)
    {
      on_root(communicator,
              [&]
              {
                const std::string file =
                    write_new_scene(line.topic, line.file).string();
                std::cout << file << " written; solve it: " << own_name()
                          << " run " << file << std::endl;
              });
      return ExitCode::success;
    }

    /** For commands that start other processes. */
    void require_one_rank(MPI_Comm communicator, const CommandLine &line)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
        throw InputError("",
                         std::string("'abut ") + line.words.at(0)
                             + "' runs on one rank: start it without mpirun.");
    }
  } // namespace

  ExitCode run_program(MPI_Comm communicator,
                       const std::vector<std::string> &words)
  {
    const CommandLine line = parse_command_line(words);
    std::ostringstream text;
    switch (line.command)
    {
    case Command::run:
    case Command::check:
    case Command::search:
      return scene_command(communicator, line);
    case Command::new_scene:
      return new_command(communicator, line);
    case Command::tool:
      require_one_rank(communicator, line);
      return run_tool(line.words);
    case Command::parameters:
      write_reference(text, ReferenceOptions::parse(line.kind, line.level));
      break;
    case Command::serve: // by main(), before MPI begins
      break;
    case Command::version:
      print_version(text);
      break;
    case Command::help:
      text << help_text(line.topic);
      break;
    }
    if (is_root(communicator))
      std::cout << text.str() << std::flush;
    return ExitCode::success;
  }
} // namespace abut::app
