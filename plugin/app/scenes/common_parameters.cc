// SPDX-License-Identifier: LGPL-2.1-or-later
#include "common_parameters.h"

#include "app/input/effect_rules.h"
#include "app/input/input_error.h"

#include <abut/dealii/pair_measures.h>

#include <ostream>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;

    std::vector<std::string> kind_names()
    {
      std::vector<std::string> names;
      for (const SceneKind &kind : scene_kinds())
        names.push_back(kind.name);
      return names;
    }

    std::string joined(const std::vector<std::string> &words,
                       const std::string &separator)
    {
      std::string text;
      for (const std::string &word : words)
        text += (text.empty() ? "" : separator) + word;
      return text;
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

    void write_parameter(std::ostream &out, const DeclaredParameter &parameter)
    {
      const std::size_t slash = parameter.path.rfind('/');
      const std::string name = slash == std::string::npos
                                   ? parameter.path
                                   : parameter.path.substr(slash + 1);
      out << "- **" << name << "** = ";
      if (parameter.default_value.empty())
        out << "(empty)";
      else
        out << "`" << parameter.default_value << "`";
      out << " (" << parameter.pattern << "). " << parameter.documentation
          << "\n";
    }
  } // namespace

  const SceneKind &scene_kind(const ParameterFile &file)
  {
    const std::string name = file.get("Scene", "");
    for (const SceneKind &kind : scene_kinds())
      if (name == kind.name)
        return kind;
    const std::string legal = "one of " + joined(kind_names(), ", ") + ".";
    if (name.empty())
      throw InputError("Scene", "the file does not say what kind of scene it "
                                "is: 'set Scene' to "
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
    prm.declare_entry("Scene", kind.name,
                      Patterns::Selection(joined(kind_names(), "|")),
                      "Kind of scene; it decides which parameters there are.");
    const std::vector<std::string> words = dimension_words(kind);
    if (!words.empty())
      prm.declare_entry("Dimension", words[0],
                        Patterns::Selection(joined(words, "|")),
                        "Number of space dimensions.");
    prm.declare_entry("Title", "", Patterns::Anything(),
                      "A line about the scene, for the summary and the "
                      "pictures.");
    scene.declare(prm);
    prm.enter_subsection("Output");
    prm.declare_entry("Pictures", "false", Patterns::Bool(),
                      "Draw pictures (SVG and PNG) at the end, as `abut "
                      "draw FOLDER` does; it needs Python with Matplotlib.");
    prm.declare_entry("Report", "false", Patterns::Bool(),
                      "Write a page about the run, report.html, as `abut "
                      "report` does; also where the scene has an error.");
    prm.leave_subsection();
  }

  void require_law_without_stress(const MethodParameters &method)
  {
    if (abut_law_needs_stress(method.options.law))
      throw InputError("Method/Enforcement",
                       std::string(method.options.law->name)
                           + " works with the stress of elastic bodies, of "
                             "which this scene has none: use lagrange or "
                             "augmented lagrangian.");
  }

  void write_parameters(std::ostream &out, const ParameterHandler &prm,
                        const std::string &what)
  {
    const std::vector<DeclaredParameter> all = declared_parameters(prm);
    std::string section;
    // Those outside of sections come first.
    for (const DeclaredParameter &parameter : all)
      if (section_of(parameter.path).empty())
        write_parameter(out, parameter);
    for (const DeclaredParameter &parameter : all)
    {
      if (section_of(parameter.path).empty())
        continue;
      if (section_of(parameter.path) != section)
        out << "\n### " << section_of(parameter.path) << " (" << what
            << ")\n\n";
      section = section_of(parameter.path);
      write_parameter(out, parameter);
    }
  }

  void write_reference(std::ostream &out)
  {
    out << "# Parameters\n\n"
           "Printed by `abut parameters`; do not edit. Each entry gives name, "
           "default,\nlegal values and meaning. A parameter `Name` of section "
           "`Section` is set in a\nscene file by\n\n"
           "    subsection Section\n      set Name = value\n    end\n\n"
           "and on the command line by `--set \"Section/Name=value\"`.\n";
    for (const SceneKind &kind : scene_kinds())
    {
      ParameterHandler prm;
      declare_all(prm, kind, *kind.create(kind.dimensions[0]));
      out << "\n## Scene `" << kind.name << "`\n\n"
          << kind.description << "\n\n";
      write_parameters(out, prm, kind.name);
    }
    out << "\n## Pairs in `summary.json`\n\n"
           "Keys of pair `N` begin with `pair_N_`.\n\n"
           "| key | unit | quantity |\n|---|---|---|\n";
    for (const PairMeasure<3> &measure : pair_measures<3>())
      if (measure.reported != ReportedOf::none)
        out << "| `" << measure.name << "` | " << measure.unit << " | "
            << measure.text
            << (measure.reported == ReportedOf::friction ? ", with friction"
                                                         : "")
            << " |\n";
  }
} // namespace abut::app
