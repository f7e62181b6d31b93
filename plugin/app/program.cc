// SPDX-License-Identifier: LGPL-2.1-or-later
#include "program.h"

#include "collective.h"
#include "command_line.h"
#include "common_parameters.h"
#include "output_folder.h"
#include "scene.h"

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <iostream>
#include <optional>
#include <sstream>

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

    /** A scene read from its file, and what the run has to know. */
    class LoadedScene
    {
    public:
      LoadedScene(MPI_Comm communicator, const CommandLine &line)
          : file(line.scene_file, line.overrides)
      {
        const SceneKind &kind = scene_kind(file);
        if (line.command == Command::search
            && std::string(kind.name) != "search")
          throw InputError("Scene", std::string("'abut search' takes scenes "
                                                "of kind 'search'; this one "
                                                "is of kind '")
                                        + kind.name
                                        + "', which searches no "
                                          "facets.");
        const unsigned int dimension = scene_dimension(file, kind);
        scene = kind.create(dimension);
        scene->count(file);
        declare_all(prm, kind, *scene);
        file.apply(prm);
        parse();

        options.communicator = communicator;
        options.scene_file = line.scene_file;
        options.output_folder =
            line.output.empty()
                ? "output" / options.scene_file.filename().stem()
                : std::filesystem::path(line.output);
        prm.enter_subsection("Output");
        options.pictures = prm.get_bool("Pictures");
        prm.leave_subsection();
        name = options.scene_file.filename().stem().string();
        title = prm.get("Title");
        kind_dimension = dimension;
      }

      /** Write what is known before the solve. */
      void describe(Report &report) const
      {
        report.set("scene", name);
        if (!title.empty())
          report.set("title", title);
        if (kind_dimension > 0)
          report.set("dimension", kind_dimension);
      }

      ParameterFile file;
      std::unique_ptr<Scene> scene;
      RunOptions options;

    private:
      /** Errors of deal.II's own carry much text that no user needs. */
      void parse()
      {
        try
        {
          scene->parse(prm);
        }
        catch (const dealii::ExceptionBase &error)
        {
          std::ostringstream text;
          error.print_info(text);
          throw InputError("", dealii::Utilities::trim(text.str()));
        }
      }

      dealii::ParameterHandler prm;
      std::string name, title;
      unsigned int kind_dimension = 0;
    };

    void prepare_output(const LoadedScene &loaded)
    {
      MPI_Comm communicator = loaded.options.communicator;
      collective(communicator,
                 [&]
                 {
                   if (is_root(communicator))
                     make_output_folder(loaded.options.output_folder);
                 });
    }

    ExitCode run_scene(LoadedScene &loaded, const CommandLine &line)
    {
      MPI_Comm communicator = loaded.options.communicator;
      prepare_output(loaded);
      Report report(communicator, line.quiet);
      loaded.describe(report);
      const Outcome outcome = loaded.scene->run(loaded.options, report);
      report.set("converged", outcome == Outcome::converged);
      report.finish();
      collective(communicator,
                 [&] { report.write(loaded.options.output_folder); });
      report.print_summary();
      if (is_root(communicator) && !line.quiet)
        std::cout << "\n  results in " << loaded.options.output_folder.string()
                  << std::endl;
      return outcome == Outcome::converged ? ExitCode::success
                                           : ExitCode::unusable_answer;
    }

    ExitCode check_scene(LoadedScene &loaded, const CommandLine &line)
    {
      Report report(loaded.options.communicator, line.quiet);
      loaded.describe(report);
      loaded.scene->check(loaded.options, report);
      report.print_summary();
      if (is_root(loaded.options.communicator) && !line.quiet)
        std::cout << "\n  " << line.scene_file << ": no errors found"
                  << std::endl;
      return ExitCode::success;
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
                     file.emplace(line.scene_file, line.overrides);
                     loaded.emplace(communicator, line);
                   });
        return line.command == Command::check ? check_scene(*loaded, line)
                                              : run_scene(*loaded, line);
      }
      catch (const InputError &error)
      {
        if (error.parameter.empty() || !file)
          throw;
        throw InputError("", file->origin(error.parameter) + ": "
                                 + error.parameter + ": " + error.what());
      }
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
    case Command::parameters:
      write_reference(text);
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
