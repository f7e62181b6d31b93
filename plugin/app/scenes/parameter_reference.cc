// SPDX-License-Identifier: LGPL-2.1-or-later
#include "parameter_reference.h"

#include "app/input/effect_rules.h"
#include "app/input/input_error.h"
#include "common_parameters.h"
#include "scene.h"

#include <abut/dealii/pair_measures.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <vector>

namespace abut::app
{
  namespace
  {
    using Names = std::vector<std::string>;

    void add_once(Names &names, const std::string &name)
    {
      if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }

    /** Where a kind of scenes has a parameter. */
    struct Place
    {
      std::string kind, section, default_value;
    };

    /** A parameter that one or more sections have. */
    struct Entry
    {
      std::string name;
      DeclaredParameter parameter;
      std::vector<Place> places;

      Names kinds() const
      {
        Names result;
        for (const Place &place : places)
          add_once(result, place.kind);
        return result;
      }

      bool is_in(const std::string &section) const
      {
        return std::any_of(places.begin(), places.end(),
                           [&](const Place &place)
                           { return place.section == section; });
      }
    };

    /** A section with the entries that it is the first to have, and the
     * sections that have its other ones. */
    struct Section
    {
      std::string name;
      Names elsewhere;
      std::vector<Entry> entries;
      std::string only_kind; ///< of a section without entries of its own

      Names kinds() const
      {
        Names result;
        for (const Entry &entry : entries)
          for (const std::string &kind : entry.kinds())
            add_once(result, kind);
        return result;
      }
    };

    /** "Body N" for the sections `Body 1`, `Body 2`, ... */
    std::string without_number(std::string section)
    {
      const std::size_t number = section.find(" 1");
      if (number != std::string::npos
          && (number + 2 == section.size() || section[number + 2] == '/'))
        section.replace(number, 2, " N");
      return section;
    }

    std::string last_name(const std::string &path)
    {
      return path.substr(path.rfind('/') + 1);
    }

    bool is_same(const Entry &entry, const DeclaredParameter &parameter)
    {
      return entry.name == last_name(parameter.path)
             && entry.parameter.pattern == parameter.pattern
             && entry.parameter.documentation == parameter.documentation;
    }

    class Reference
    {
    public:
      explicit Reference(const ReferenceOptions &options) : options(options)
      {
        for (const SceneKind &kind : scene_kinds())
          if (options.kind.empty() || options.kind == kind.name)
            add(kind);
      }

      /** Sections of several kinds of scenes. */
      Names shared() const
      {
        Names result;
        for (const Section &section : sections)
          if (section.kinds().size() > 1)
            result.push_back(section.name);
        return result;
      }

      /** Sections that one kind alone has. */
      Names own(const std::string &kind) const
      {
        Names result;
        for (const Section &section : sections)
          if (of_kind(section) == kind)
            result.push_back(section.name);
        return result;
      }

      void write(std::ostream &out, const std::string &name) const
      {
        const Section &section = *find(name);
        if (section.entries.empty() && section.elsewhere.empty())
          return;
        out << "\n### " << heading(name) << "\n\n";
        if (section.kinds().size() > 1)
          out << "Used in: " << uses(section) << ".\n\n";
        for (const Entry &entry : section.entries)
          write(out, section, entry);
        for (const std::string &other : section.elsewhere)
          write_elsewhere(out, name, other);
      }

      static std::string heading(const std::string &name)
      {
        return name.empty() ? "Scene" : name;
      }

      static std::string anchor(const std::string &text)
      {
        std::string result;
        for (const char c : text)
          if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            result +=
                static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
          else if (c == ' ' || c == '-')
            result += '-';
        return result;
      }

    private:
      void add(const SceneKind &kind)
      {
        const auto scene = kind.create(kind.dimensions[0]);
        dealii::ParameterHandler prm;
        declare_all(prm, kind, *scene);
        const std::vector<EffectRule> rules = scene->effects();
        for (const DeclaredParameter &parameter : declared_parameters(prm))
        {
          const bool never = std::any_of(
              rules.begin(), rules.end(),
              [&](const EffectRule &rule)
              { return rule.never && fits(rule.parameters, parameter.path); });
          if (!never && parameter.note.level <= options.level)
            add(kind.name, parameter);
        }
      }

      void add(const std::string &kind, const DeclaredParameter &parameter)
      {
        const std::string where = without_number(section_of(parameter.path));
        if (find(where) == sections.end())
          sections.push_back({where, {}, {}, ""});
        const Place place = {kind, where, parameter.default_value};
        Section &section = *find(where);
        for (Section &other : sections)
          for (Entry &entry : other.entries)
            if (is_same(entry, parameter))
            {
              if (&other != &section)
              {
                add_once(section.elsewhere, other.name);
                section.only_kind = kind;
              }
              entry.places.push_back(place);
              return;
            }
        section.entries.push_back(
            {last_name(parameter.path), parameter, {place}});
      }

      /** The kind that has a section, empty if several do. */
      static std::string of_kind(const Section &section)
      {
        const Names kinds = section.kinds();
        return kinds.empty()       ? section.only_kind
               : kinds.size() == 1 ? kinds[0]
                                   : "";
      }

      /** "obstacle, solid (Body N/Mesh)": kinds, and the names of sections that
       * are not this one's. */
      static std::string uses(const Section &section)
      {
        std::string text;
        for (const std::string &kind : section.kinds())
        {
          Names others;
          for (const Entry &entry : section.entries)
            for (const Place &place : entry.places)
              if (place.kind == kind && place.section != section.name)
                add_once(others, place.section);
          text += (text.empty() ? "" : ", ") + kind
                  + (others.empty() ? "" : " (" + joined(others, ", ") + ")");
        }
        return text;
      }

      /** "`5`", or by kind "`5` (obstacle), `2` (solid)". */
      static std::string defaults(const Entry &entry)
      {
        Names values, by_kind;
        for (const Place &place : entry.places)
        {
          const std::string value = place.default_value.empty()
                                        ? "(empty)"
                                        : "`" + place.default_value + "`";
          add_once(values, value);
          add_once(by_kind, value + " (" + place.kind + ")");
        }
        return entry.name == "Scene" ? "(required)"
               : values.size() == 1  ? values[0]
                                     : joined(by_kind, ", ");
      }

      std::vector<Section>::iterator find(const std::string &name)
      {
        return std::find_if(sections.begin(), sections.end(),
                            [&](const Section &section)
                            { return section.name == name; });
      }

      std::vector<Section>::const_iterator find(const std::string &name) const
      {
        return std::find_if(sections.begin(), sections.end(),
                            [&](const Section &section)
                            { return section.name == name; });
      }

      void write(std::ostream &out, const Section &section,
                 const Entry &entry) const
      {
        const DeclaredParameter &parameter = entry.parameter;
        out << "- ";
        if (options.is_all())
          out << "<a id=\"" << anchor_of(section, entry) << "\"></a>";
        out << "**" << entry.name << "** = " << defaults(entry);
        out << " (" << parameter.pattern;
        if (!parameter.note.unit.empty())
          out << "; "
              << (parameter.note.unit == "1" ? "dimensionless"
                                             : parameter.note.unit);
        out << "; " << level_name(parameter.note.level) << "). "
            << parameter.documentation;
        if (!parameter.note.example.empty())
          out << " Example: `" << parameter.note.example << "`.";
        if (entry.kinds() != section.kinds())
          out << " Only in: " << joined(entry.kinds(), ", ") << ".";
        out << "\n";
      }

      /** Of entries with one name in a section, others than the first have
       * their kind of scenes. */
      static std::string anchor_of(const Section &section, const Entry &entry)
      {
        const Entry &first = *std::find_if(
            section.entries.begin(), section.entries.end(),
            [&](const Entry &each) { return each.name == entry.name; });
        return anchor(heading(section.name) + " " + entry.name
                      + (&first == &entry ? "" : " " + entry.kinds()[0]));
      }

      /** A line with the entries of section @p name that @p other has. */
      void write_elsewhere(std::ostream &out, const std::string &name,
                           const std::string &other) const
      {
        Names names;
        for (const Entry &entry : find(other)->entries)
          if (entry.is_in(name))
            names.push_back(entry.name);
        out << "\nAlso, as in "
            << (options.is_all() ? "[" + heading(other) + "](#"
                                       + anchor(heading(other)) + ")"
                                 : heading(other))
            << ": " << joined(names, ", ") << ".\n";
      }

      const ReferenceOptions options;
      std::vector<Section> sections;
    };

    void write_head(std::ostream &out)
    {
      out << "# Parameters\n\n"
             "Printed by `abut parameters`; do not edit. Each entry gives "
             "name, default,\ntype and range, unit, level (basic, advanced, "
             "expert), meaning, and an example.\nA parameter `Name` of "
             "section `Section` is set in a scene file by\n\n"
             "    subsection Section\n      set Name = value\n    end\n\n"
             "and on the command line by `--set \"Section/Name=value\"`. "
             "`abut parameters\n--level basic --scene solid` prints the basic "
             "ones of a kind of scenes.\n";
    }

    void write_links(std::ostream &out, const std::string &what,
                     const Names &names)
    {
      if (names.empty())
        return;
      out << "- " << what << ": ";
      for (std::size_t i = 0; i < names.size(); ++i)
        out << (i == 0 ? "" : ", ") << "[" << Reference::heading(names[i])
            << "](#" << Reference::anchor(Reference::heading(names[i])) << ")";
      out << "\n";
    }

    void write_old_words(std::ostream &out)
    {
      out << "\n## Old names\n\n"
             "Scene files, `--set` and charts may still have these names and "
             "words; a run prints\nthe new ones. Both names of a parameter in "
             "one file are an error.\n\n"
             "| old | new |\n|---|---|\n";
      for (const parameter::OldName &name : parameter::old_names())
        out << "| `" << name.old_path << "` | `" << name.path << "` |\n";
      for (const parameter::OldValue &value : parameter::old_values())
        out << "| `" << value.path << " = " << value.old_value << "` | `"
            << value.path << " = " << value.value << "` |\n";
      out << "\nThe number 0 is read as the word (auto, none, never, "
             "infinite) of parameters with one.\n";
    }

    void write_pair_measures(std::ostream &out)
    {
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
  } // namespace

  ReferenceOptions ReferenceOptions::parse(const std::string &kind,
                                           const std::string &level)
  {
    ReferenceOptions options;
    Names kinds, levels;
    for (const SceneKind &each : scene_kinds())
      kinds.emplace_back(each.name);
    for (const auto each : {parameter::Level::basic, parameter::Level::advanced,
                            parameter::Level::expert})
    {
      levels.emplace_back(level_name(each));
      if (level == levels.back())
        options.level = each;
    }
    const auto require = [](const std::string &option, const std::string &word,
                            const Names &legal)
    {
      if (!word.empty()
          && std::find(legal.begin(), legal.end(), word) == legal.end())
        throw InputError("", option + " '" + word + "' is not one of "
                                 + joined(legal, ", ") + "."
                                 + did_you_mean(word, legal));
    };
    require("--scene", kind, kinds);
    require("--level", level, levels);
    options.kind = kind;
    return options;
  }

  void write_reference(std::ostream &out, const ReferenceOptions &options)
  {
    const Reference reference(options);
    if (!options.is_all())
    {
      for (const SceneKind &kind : scene_kinds())
        for (const std::string &name : reference.own(kind.name))
          reference.write(out, name);
      for (const std::string &name : reference.shared())
        reference.write(out, name);
      return;
    }
    write_head(out);
    out << "\n## Contents\n\n";
    write_links(out, "sections of several kinds of scenes", reference.shared());
    for (const SceneKind &kind : scene_kinds())
      write_links(out, std::string("scene `") + kind.name + "`",
                  reference.own(kind.name));
    out << "- [Old names](#old-names), [Pairs in "
           "`summary.json`](#pairs-in-summaryjson)\n"
           "\n## Sections of several kinds of scenes\n";
    for (const std::string &name : reference.shared())
      reference.write(out, name);
    for (const SceneKind &kind : scene_kinds())
    {
      out << "\n## Scene `" << kind.name << "`\n\n" << kind.description << "\n";
      for (const std::string &name : reference.own(kind.name))
        reference.write(out, name);
    }
    write_old_words(out);
    write_pair_measures(out);
  }
} // namespace abut::app
