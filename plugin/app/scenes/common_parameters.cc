// SPDX-License-Identifier: LGPL-2.1-or-later
#include "common_parameters.h"

#include "app/input/effect_rules.h"
#include "app/input/expression.h"
#include "app/input/input_error.h"

#include <abut/dealii/pair_measures.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <ostream>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;

    const char *const expected_name = "Expected";

    std::vector<std::string> kind_names()
    {
      std::vector<std::string> names;
      for (const SceneKind &kind : scene_kinds())
        names.push_back(kind.name);
      return names;
    }

    /** Words of SceneKind::dimensions; a scene without has {0}. */
    std::vector<std::string> dimension_words(const SceneKind &kind)
    {
      std::vector<std::string> words;
      for (const unsigned int dimension : kind.dimensions)
        if (dimension > 0)
          words.push_back(std::to_string(dimension));
      return words;
    }
  } // namespace

  std::string joined(const std::vector<std::string> &words,
                     const std::string &separator)
  {
    std::string text;
    for (const std::string &word : words)
      text += (text.empty() ? "" : separator) + word;
    return text;
  }

  void declare_mesh_results(ParameterHandler &prm)
  {
    prm.enter_subsection("Exact solution");
    parameter::declare(prm, "Energy", "nan", TextPattern("a number, or nan"),
                       parameter::expert("force*length", "0.25"),
                       "Energy of the exact solution; nan: unknown.");
    prm.leave_subsection();
    prm.enter_subsection("Output");
    parameter::declare(prm, "Every", "auto",
                       OrWord(Patterns::Integer(1), "auto"),
                       parameter::advanced("steps", "10"),
                       "Load or time steps between two sets of fields. The "
                       "last step is always written. auto: about 100 sets in "
                       "a run, or all steps where they are fewer.");
    parameter::declare(
        prm, "All levels", "false", Patterns::Bool(), parameter::advanced(),
        "Whether fields are written on every mesh, not only on the last.");
    parameter::declare(
        prm, "Nodal values", "false", Patterns::Bool(), parameter::advanced(),
        "Whether displacement and forces at all nodes of the last mesh are "
        "written to nodal.csv, in full precision.");
    prm.leave_subsection();
  }

  FieldSteps::FieldSteps(const ParameterHandler &prm,
                         const unsigned int n_steps)
      : every(
          static_cast<unsigned int>(parameter::number_or_zero(prm, "Every"))),
        is_automatic(every == 0)
  {
    constexpr unsigned int most_sets = 100;
    if (is_automatic)
      every = std::max(1u, (n_steps + most_sets - 1) / most_sets);
  }

  std::string FieldSteps::in_words() const
  {
    return is_automatic && every > 1
               ? ", fields of one step in " + std::to_string(every)
                     + " (Output/Every)"
               : "";
  }

  std::vector<ExpectedFigure> parse_expected(const std::string &text)
  {
    const std::string path = std::string("Output/") + expected_name;
    std::vector<ExpectedFigure> figures;
    for (const std::string &part : split_list(text, ';'))
    {
      if (part.empty())
        continue;
      const std::size_t colon = part.find(':');
      if (colon == std::string::npos || colon == 0)
        throw InputError(path, "'" + part
                                   + "' is not a figure, a colon, and its "
                                     "value.");
      const Expression<2> formula(part.substr(colon + 1), path);
      if (!formula.is_constant())
        throw InputError(path, "'" + part + "' depends on x, y or t.");
      figures.push_back({dealii::Utilities::trim(part.substr(0, colon)),
                         formula.evaluate({dealii::Point<2>()})[0]});
    }
    return figures;
  }

  const SceneKind &scene_kind(const ParameterFile &file)
  {
    const std::string name = file.get("Scene", "");
    for (const SceneKind &kind : scene_kinds())
      if (name == kind.name)
        return kind;
    const std::string legal = "one of " + joined(kind_names(), ", ") + ".";
    if (name.empty())
      throw InputError("Scene", "the file has no kind of scene: 'set Scene' to "
                                    + legal);
    throw InputError("Scene", "'" + name + "' is not " + legal
                                  + did_you_mean(name, kind_names()));
  }

  unsigned int scene_dimension(const ParameterFile &file, const SceneKind &kind)
  {
    const std::vector<std::string> words = dimension_words(kind);
    if (words.empty())
      return 0;
    const std::string value = file.get("Dimension", words[0]);
    for (std::size_t i = 0; i < words.size(); ++i)
      if (value == words[i])
        return kind.dimensions[i];
    throw InputError("Dimension",
                     "'" + value + "' is not " + joined(words, " or ") + ".");
  }

  void declare_all(ParameterHandler &prm, const SceneKind &kind,
                   const Scene &scene)
  {
    parameter::declare(prm, "Scene", kind.name,
                       Patterns::Selection(joined(kind_names(), "|")),
                       parameter::basic(),
                       "Kind of scene, which determines the other parameters.");
    const std::vector<std::string> words = dimension_words(kind);
    if (!words.empty())
      parameter::declare(prm, "Dimension", words[0],
                         Patterns::Selection(joined(words, "|")),
                         parameter::basic(), "Number of space dimensions.");
    parameter::declare(prm, "Title", "", TextPattern("a line of text"),
                       parameter::basic("", "Two cylinders"),
                       "Title for the summary and the pictures.");
    scene.declare(prm);
    prm.enter_subsection("Output");
    parameter::declare(prm, "Pictures", "false", Patterns::Bool(),
                       parameter::advanced(),
                       "Whether pictures (SVG and PNG) are drawn at the end "
                       "(`abut draw`). Needs Python with Matplotlib.");
    parameter::declare(prm, "Report", "false", Patterns::Bool(),
                       parameter::basic(),
                       "Whether a page about the run, report.html, is written "
                       "(`abut report`), also for a scene with an error.");
    parameter::declare(
        prm, expected_name, "", TextPattern("figures and their values"),
        parameter::advanced("", "pair_1_pressure: sqrt(2/pi); "
                                "pair_1_force[1]: 5"),
        "Figures of summary.json whose values are known beforehand: numbers, "
        "or formulas with pi. A component of a vector has its number, from 0. "
        "The run prints them with the relative errors of its results.");
    prm.leave_subsection();
  }

  void require_law_without_stress(const MethodParameters &method)
  {
    if (abut_law_needs_stress(method.options.law))
      throw InputError(
          "Method/Enforcement",
          std::string(method.options.law->name)
              + " needs the stress of elastic bodies, and this scene has no "
                "bodies: use lagrange or augmented lagrangian.");
  }
} // namespace abut::app
