// SPDX-License-Identifier: LGPL-2.1-or-later
#include "loaded_scene.h"

#include "app/input/dealii_message.h"
#include "app/input/input_error.h"
#include "app/report/json.h"
#include "app/restart/disk.h"
#include "common_parameters.h"
#include "method_effects.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <sstream>
#include <utility>

namespace abut::app
{
  namespace
  {
    /** Its checksum; who needs the file says better why it cannot be read. */
    std::string checksum_of(const std::filesystem::path &file)
    {
      try
      {
        return checksum(read_from_disk(file));
      }
      catch (const InputError &)
      {
        return "unreadable";
      }
    }

    /** The same parameters, or ones of the same name, in other kinds of scenes;
     * empty if there are none. */
    std::string in_other_kinds(const SceneKind &kind, const std::string &path)
    {
      const auto last = [](const std::string &each)
      { return each.substr(each.rfind('/') + 1); };
      std::string same, similar;
      for (const SceneKind &other : scene_kinds())
      {
        if (std::string(other.name) == kind.name)
          continue;
        dealii::ParameterHandler prm;
        declare_all(prm, other, *other.create(other.dimensions.front()));
        for (const DeclaredParameter &each : declared_parameters(prm))
          if (last(each.path) == last(path))
            (each.path == path ? same : similar) += std::string(" Scene = ")
                                                    + other.name + " has '"
                                                    + each.path + "'.";
      }
      return same.empty() ? similar : same;
    }

    /** Checksum of the file that @p value may be the name of, else empty. */
    std::string content_of(const RunOptions &options, const std::string &value)
    {
      std::error_code error;
      const auto folder = options.scene_file.parent_path();
      for (const std::filesystem::path &file :
           {folder / value, std::filesystem::path(value)})
        if (!value.empty() && std::filesystem::is_regular_file(file, error))
          return checksum_of(file);
      return "";
    }
  } // namespace

  LoadedScene::LoadedScene(ParameterFile values)
      : file(std::move(values)),
        scene_kind(app::scene_kind(file)),
        dimension(scene_dimension(file, scene_kind))
  {
    scene = scene_kind.create(dimension);
    scene->count(file);
    declare_all(prm, scene_kind, *scene);
    declared = file.apply(prm, [this](const std::string &path)
                          { return in_other_kinds(scene_kind, path); });
    old_words = file.old_words(declared);
  }

  void LoadedScene::find_law()
  {
    RunOptions options;
    options.scene_file = file.path();
    for (const std::string name : {"Law file", "Friction file"})
    {
      const std::string law = file.get("Method/" + name, "");
      if (law.empty())
        continue;
      const std::string path = options.input_file(law).string();
      prm.enter_subsection("Method");
      prm.set(name, path);
      prm.leave_subsection();
      for (DeclaredParameter &parameter : declared)
        if (parameter.path == "Method/" + name)
          parameter.value = path;
    }
  }

  InputError LoadedScene::blamed(const std::string &message) const
  {
    // Sections that libraries declare begin their messages with the parameter.
    std::string path;
    for (const DeclaredParameter &parameter : declared)
      if (message.compare(0, parameter.path.size(), parameter.path) == 0
          && parameter.path.size() > path.size())
        path = parameter.path;
    const std::size_t rest = message.find_first_not_of(": ", path.size());
    if (path.empty() || rest == std::string::npos)
      return {"", message};
    // "Section/Name = value goes with ..." is a sentence of its own.
    return {path, message[rest] == '=' ? message : message.substr(rest)};
  }

  void LoadedScene::parse()
  {
    find_law();
    // Errors of deal.II's own carry much text that no user needs.
    try
    {
      scene->parse(prm);
    }
    catch (const dealii::ExceptionBase &error)
    {
      throw blamed(dealii_message(error));
    }
    expected = parse_expected(get("Output", "Expected"));
    not_used =
        values_without_effect(scene->effects(), SceneValues(declared, file));
  }

  void LoadedScene::describe(Report &report) const
  {
    report.set("scene", file.name());
    const std::string title = prm.get("Title");
    if (!title.empty())
      report.set("title", title);
    if (dimension > 0)
      report.set("dimension", dimension);
    const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(report.communicator);
    report.print(
        file.name() + ": " + (title.empty() ? "" : title + ", ")
        + "scene of kind " + scene_kind.name
        + (dimension > 0 ? " in " + std::to_string(dimension) + "D" : "")
        + (n_ranks > 1 ? ", " + std::to_string(n_ranks) + " ranks" : ""));
    for (const ExpectedFigure &figure : expected)
      report.expect(figure.key, figure.value);
    for (const std::string &line : not_used)
      report.not_used(line);
    std::string old;
    for (const std::string &line : old_words)
      old += (old.empty() ? "old names: " : "; ") + line;
    if (!old.empty())
      report.print("  " + old + ".");
  }

  void LoadedScene::describe_solution(Report &report) const
  {
    const SceneValues values(declared, file);
    if (values("Solver/Linear solver") != "auto"
        || report.number("linear_iterations") != 0.)
      return;
    for (const EffectRule &rule : iteration_effects())
      if (values.is_set(rule.parameters))
        report.not_used(rule.parameters
                        + ": all linear systems were solved directly.");
  }

  std::string LoadedScene::parameters_json() const
  {
    std::ostringstream out;
    JsonWriter json(out);
    json.begin();
    json.value("scene", file.name());
    json.value("file", file.path());
    json.value("kind", std::string(kind()));
    json.value("dimension", static_cast<std::int64_t>(dimension));
    json.begin("parameters");
    const auto given = file.values();
    for (const DeclaredParameter &parameter : declared)
    {
      json.begin(parameter.path);
      json.value("value", parameter.value);
      json.value("default", parameter.default_value);
      json.value("given", given.count(parameter.path) > 0);
      json.value("origin", file.origin(parameter.path));
      json.end();
    }
    json.end();
    json.end();
    return out.str();
  }

  RunIdentity LoadedScene::identity() const
  {
    RunOptions options;
    options.scene_file = file.path();
    RunIdentity result = program_identity();
    for (const DeclaredParameter &parameter : declared)
    {
      // Checkpoints and expected figures change no result.
      if (parameter.path.rfind("Checkpoint/", 0) == 0
          || parameter.path == "Output/Expected")
        continue;
      result[parameter.path] = parameter.value;
      const std::string content = content_of(options, parameter.value);
      if (!content.empty())
        result["content of " + parameter.path] = content;
    }
    return result;
  }

  const char *LoadedScene::kind() const
  {
    return scene_kind.name;
  }

  std::string LoadedScene::get(const std::string &section,
                               const std::string &name)
  {
    prm.enter_subsection(section);
    const std::string value = prm.get(name);
    prm.leave_subsection();
    return value;
  }
} // namespace abut::app
