// SPDX-License-Identifier: LGPL-2.1-or-later
/* A chart file has declared entries, and sections that hold settings of the
 * scene: `All curves`, `Curve NAME` and `Error/Finer run`. The latter are taken
 * out before the rest is checked; whether the scene knows them is seen when the
 * scene is loaded with them. */
#include "chart_file.h"

#include <abut/dealii/number_pattern.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace abut::app
{
  namespace
  {
    namespace Patterns = dealii::Patterns;
    namespace Utilities = dealii::Utilities;

    const std::string all_curves = "All curves/", one_curve = "Curve",
                      finer_run = "Error/Finer run/";

    bool begins_with(const std::string &text, const std::string &beginning)
    {
      return text.compare(0, beginning.size(), beginning) == 0;
    }

    /** Whether @p path is in a section `Curve` or `Curve NAME`. */
    bool of_curve(const std::string &path)
    {
      return begins_with(path, one_curve + "/")
             || (begins_with(path, one_curve + " ")
                 && path.find('/') != std::string::npos);
    }

    bool holds_settings(const std::string &path)
    {
      return begins_with(path, all_curves) || of_curve(path)
             || begins_with(path, finer_run);
    }

    /** Parts of "a | b | c": bars between blanks, so that formulas may
     * contain ||. */
    std::vector<std::string> alternatives(const std::string &text)
    {
      std::vector<std::string> result;
      std::size_t begin = 0;
      for (;;)
      {
        const std::size_t end = text.find(" | ", begin);
        result.push_back(Utilities::trim(text.substr(begin, end - begin)));
        if (end == std::string::npos)
          return result;
        begin = end + 3;
      }
    }

    /** The settings below @p section, without its name. */
    std::vector<Assignment> below(const std::string &section,
                                  const std::vector<Assignment> &all)
    {
      std::vector<Assignment> result;
      for (const Assignment &assignment : all)
        if (begins_with(assignment.path, section))
          result.push_back({assignment.path.substr(section.size()),
                            assignment.value, assignment.origin});
      return result;
    }

    /** Take entry @p name out of @p settings, if it is there. */
    std::optional<Assignment> take(const std::string &name,
                                   std::vector<Assignment> &settings)
    {
      std::optional<Assignment> found;
      for (auto entry = settings.begin(); entry != settings.end();)
        if (entry->path == name)
        {
          found.emplace(*entry);
          entry = settings.erase(entry);
        }
        else
          ++entry;
      return found;
    }

    /** One curve for each combination of the alternatives in its settings;
     * those that have some are added to its name. */
    std::vector<ChartCurve> multiplied(const ChartCurve &curve)
    {
      std::vector<ChartCurve> result = {curve};
      result[0].settings.clear();
      for (const Assignment &setting : curve.settings)
      {
        const std::vector<std::string> values = alternatives(setting.value);
        std::vector<ChartCurve> longer;
        for (const ChartCurve &part : result)
          for (const std::string &value : values)
          {
            ChartCurve next = part;
            next.settings.push_back({setting.path, value, setting.origin});
            if (values.size() > 1)
              next.name += (next.name.empty() ? "" : ", ") + value;
            longer.push_back(next);
          }
        result = longer;
      }
      return result;
    }

    /** A section that comes back, or says something twice, is another curve
     * with the same name, which would lose the first one. The command line may
     * well say something once more. */
    void check_repeated(const std::vector<Assignment> &all)
    {
      std::set<std::string> paths, sections;
      std::string last;
      for (const Assignment &assignment : all)
      {
        if (!of_curve(assignment.path) || begins_with(assignment.origin, "--"))
          continue;
        const std::string section =
            assignment.path.substr(0, assignment.path.find('/'));
        const bool comes_back =
            section != last && !sections.insert(section).second;
        if (comes_back || !paths.insert(assignment.path).second)
          throw InputError("", assignment.origin + ": '" + assignment.path
                                   + "' is in a second section '" + section
                                   + "', or set twice: give each curve a "
                                     "name of its own.");
        last = section;
      }
    }

    std::vector<std::string> section_names(const std::vector<Assignment> &all)
    {
      std::vector<std::string> names;
      for (const Assignment &assignment : all)
      {
        if (!of_curve(assignment.path))
          continue;
        const std::string name =
            assignment.path.substr(0, assignment.path.find('/'));
        if (std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
      }
      return names;
    }
  } // namespace

  void ChartFile::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Title", "", Patterns::Anything(),
                      "Title of the pictures.");
    prm.declare_entry("Scene file", "", Patterns::Anything(),
                      "The scene that is run; relative names are relative to "
                      "this file.");
    prm.declare_entry("Axis", "Refinement/Level", Patterns::Anything(),
                      "The parameter of the scene that varies along a curve, "
                      "`Section/Name`; several, separated by commas, take the "
                      "same value.");
    prm.declare_entry("Values", "", Patterns::Anything(),
                      "Its values, separated by ` | `, those of the cheapest "
                      "runs first. A curve may have `Axis` and `Values` of its "
                      "own.");
    prm.declare_entry("Axis quantity", "", Patterns::Anything(),
                      "Key of summary.json that takes the place of the value "
                      "in pictures, such as facets or dofs.");
    prm.declare_entry("Axis label", "", Patterns::Anything(),
                      "What the pictures say about the axis. Empty: its name.");
    prm.declare_entry(
        "Time", "processor_seconds", Patterns::Anything(),
        "The cost of a run: processor_seconds or wall_seconds (without the "
        "sections results and output), or another key of summary.json.");
    prm.declare_entry("Repeats", "3", Patterns::Integer(1, 1000),
                      "Timed runs of each setting, of which the median "
                      "counts.");
    prm.declare_entry("Repeat seconds", "10", NumberPattern::from(0.),
                      "Fewer repeats of a setting once they have taken "
                      "so many processor seconds.");
    prm.declare_entry("Time limit", "60", NumberPattern::from(1.),
                      "Processor seconds, rounded up, after which a run is "
                      "ended and counts as failed; ten times as long on the "
                      "wall. The finer run has ten times as much.");
    prm.declare_entry("Targets", "0.1, 0.01, 0.001", Patterns::Anything(),
                      "Errors for which the cheapest run is looked for.");
    prm.declare_entry(
        "Pictures", "error-time, error-work",
        Patterns::MultipleSelection(
            "error-time|error-work|error-axis|time-axis|memory-axis"),
        "What is drawn.");
    prm.enter_subsection("Error");
    prm.declare_entry(
        "Quantity", "", Patterns::Anything(),
        "Key of summary.json. l2_error, h1_error, energy_norm_error and others "
        "that are errors by themselves need an exact solution in the scene; "
        "any other, such as contact_force or point_1[2] (the third component), "
        "needs a reference. So does a function of a column of levels.csv, "
        "which "
        "has a row per load step: mean, ripple (standard deviation by the size "
        "of the mean) or largest (in size), of all rows or those after a time "
        "up to another one, of a column or the ratio of two, such as "
        "ripple(pair_1_force_y, 1, 2) or largest(pair_1_force_x / "
        "pair_1_force_y, 1, 2). Empty: no error is charted.");
    prm.declare_entry("Reference", "", Patterns::Anything(),
                      "Right value of the quantity. In its place a section "
                      "`Finer run` may hold settings of the scene for a run "
                      "that is made once and gives it.");
    prm.declare_entry("Scale", "0", NumberPattern::from(0.),
                      "The error is divided by it. 0: by the size of the "
                      "reference, or not at all.");
    prm.declare_entry("Label", "", Patterns::Anything(),
                      "What the pictures say about the error. Empty: the "
                      "quantity.");
    prm.leave_subsection();
  }

  ChartFile::ChartFile(const std::string &path,
                       const std::vector<std::string> &overrides)
      : file(path, overrides), name(file.name())
  {
    const std::vector<Assignment> free = file.extract(holds_settings);
    try
    {
      read_entries();
      error.finer_run = below(finer_run, free);
      read_error();
      read_curves(free);
    }
    catch (const InputError &error)
    {
      throw file.placed(error);
    }
  }

  void ChartFile::read_entries()
  {
    dealii::ParameterHandler prm;
    declare(prm);
    file.apply(prm);
    title = prm.get("Title").empty() ? name : prm.get("Title");
    const std::string scene = prm.get("Scene file");
    if (scene.empty())
      throw InputError("Scene file", "the chart does not say which scene it is "
                                     "about: 'set Scene file'.");
    scene_file = (std::filesystem::path(file.path()).parent_path() / scene)
                     .lexically_normal();
    if (!std::filesystem::is_regular_file(scene_file))
      throw InputError("Scene file",
                       "there is no scene file '" + scene_file + "'.");
    axis_label = prm.get("Axis label");
    axis_quantity = prm.get("Axis quantity");
    time = prm.get("Time");
    repeats = static_cast<unsigned int>(prm.get_integer("Repeats"));
    repeat_seconds = prm.get_double("Repeat seconds");
    time_limit = prm.get_double("Time limit");
    targets = parse_numbers(prm.get("Targets"), "Targets");
    for (const std::string &word :
         Utilities::split_string_list(prm.get("Pictures")))
      pictures.insert(word);
    prm.enter_subsection("Error");
    error.quantity = prm.get("Quantity");
    error.scale = prm.get_double("Scale");
    error.label = prm.get("Label");
    if (!prm.get("Reference").empty())
      error.reference =
          parse_number_or_nan(prm.get("Reference"), "Error/Reference");
    prm.leave_subsection();
  }

  void ChartFile::read_error()
  {
    if (error.reference && !(std::abs(*error.reference) < 1e300))
      throw InputError("Error/Reference", "the reference must be a number.");
    if (error.reference && !error.finer_run.empty())
      throw InputError("Error/Reference",
                       "there are two references: this value and the section "
                       "'Finer run'.");
    if (error.quantity.empty())
    {
      if (error.reference || !error.finer_run.empty())
        throw InputError("Error/Reference", "of which quantity? 'set Quantity' "
                                            "to a key of summary.json.");
      for (const char *word : {"error-time", "error-work", "error-axis"})
        if (file.get("Pictures", "").find(word) != std::string::npos)
          throw InputError("Pictures", std::string(word)
                                           + " needs an error: "
                                             "'set Quantity' in section "
                                             "Error.");
        else
          pictures.erase(word);
    }
    else if (error.is_error())
    {
      const std::string end = "_error";
      if (error.quantity.size() <= end.size()
          || error.quantity.substr(error.quantity.size() - end.size()) != end)
        throw InputError("Error/Quantity",
                         "'" + error.quantity
                             + "' is not an error by itself: give its right "
                               "value as Reference, or settings for a run "
                               "that finds it in section 'Finer run'.");
    }
  }

  void ChartFile::read_curves(const std::vector<Assignment> &free)
  {
    check_repeated(free);
    const std::vector<Assignment> common = below(all_curves, free);
    std::vector<std::string> names = section_names(free);
    if (names.empty())
      names.push_back(one_curve + " scene");
    for (const std::string &section : names)
    {
      std::vector<Assignment> own = below(section + "/", free);
      ChartCurve curve;
      curve.section = section;
      curve.name = Utilities::trim(section.substr(one_curve.size()));
      const auto axis = take("Axis", own), values = take("Values", own);
      for (const std::string &path : Utilities::split_string_list(
               axis ? axis->value : file.get("Axis", "Refinement/Level")))
        curve.axis.push_back(path);
      curve.axis_origin = values ? values->origin : file.origin("Values");
      curve.values =
          alternatives(values ? values->value : file.get("Values", ""));
      if (curve.values == std::vector<std::string>{""})
        throw InputError("Values", "the curve '" + curve.name
                                       + "' has no values along its axis.");
      curve.settings = common;
      curve.settings.insert(curve.settings.end(), own.begin(), own.end());
      for (const ChartCurve &part : multiplied(curve))
        curves.push_back(part);
    }
    std::map<std::string, int> seen;
    for (const ChartCurve &curve : curves)
      if (seen[curve.name]++ > 0)
        throw InputError("", "two curves are called '" + curve.name + "'.");
  }
} // namespace abut::app
