// SPDX-License-Identifier: LGPL-2.1-or-later
#include <abut/dealii/parameter_entry.h>

#include <deal.II/base/utilities.h>

#include <cctype>
#include <cstddef>

namespace abut::parameter
{
  namespace
  {
    const char *const level_names[] = {"basic", "advanced", "expert"};

    /** A number in place of `*`, and what a path has around it. */
    struct Star
    {
      bool fits = false;
      std::string number;
    };

    /** Whether @p path is @p pattern with digits for its `*`. */
    Star match(const std::string &pattern, const std::string &path)
    {
      const std::size_t star = pattern.find('*');
      if (star == std::string::npos)
        return {pattern == path, ""};
      const std::string tail = pattern.substr(star + 1);
      if (path.size() <= star + tail.size()
          || path.compare(0, star, pattern, 0, star) != 0
          || path.compare(path.size() - tail.size(), tail.size(), tail) != 0)
        return {};
      const std::string number =
          path.substr(star, path.size() - star - tail.size());
      for (const char c : number)
        if (std::isdigit(static_cast<unsigned char>(c)) == 0)
          return {};
      return {true, number};
    }

    std::string filled(std::string pattern, const std::string &number)
    {
      const std::size_t star = pattern.find('*');
      if (star != std::string::npos)
        pattern.replace(star, 1, number);
      return pattern;
    }
  } // namespace

  const char *level_name(const Level level)
  {
    return level_names[static_cast<int>(level)];
  }

  void declare(dealii::ParameterHandler &prm, const std::string &name,
               const std::string &default_value,
               const dealii::Patterns::PatternBase &pattern, const Note &note,
               const std::string &text)
  {
    prm.declare_entry(name, default_value, pattern,
                      text + " [" + level_name(note.level) + "; " + note.unit
                          + "; " + note.example + "]");
  }

  Documentation::Documentation(const std::string &documentation)
      : text(documentation)
  {
    // Examples have brackets of their own at most as "[2]": the last blank
    // before a bracket with a level begins the note.
    const std::size_t begin = documentation.rfind(" [");
    if (begin == std::string::npos || documentation.back() != ']')
      return;
    const std::string inside =
        documentation.substr(begin + 2, documentation.size() - begin - 3);
    const std::size_t first = inside.find("; "),
                      second = inside.find("; ", first + 2);
    if (first == std::string::npos || second == std::string::npos)
      return;
    for (int i = 0; i < 3; ++i)
      if (inside.compare(0, first, level_names[i]) == 0)
      {
        note = {static_cast<Level>(i),
                inside.substr(first + 2, second - first - 2),
                inside.substr(second + 2)};
        text = documentation.substr(0, begin);
      }
  }

  double number_or_zero(const dealii::ParameterHandler &prm,
                        const std::string &name)
  {
    const std::string value = prm.get(name);
    return std::isalpha(static_cast<unsigned char>(value[0])) != 0
               ? 0.
               : dealii::Utilities::string_to_double(value);
  }

  const std::vector<OldName> &old_names()
  {
    static const std::vector<OldName> all = {
        {"Method/Penalty", "Method/Penalty factor"},
        {"Method/Sliding", "Method/Contact geometry"},
        {"Method/Turning terms", "Method/Geometric contact tangent"},
        {"Method/Maximum steps", "Method/Maximum linear systems"},
        {"Method/Maximum outer steps", "Method/Maximum outer iterations"},
        {"Solid/Run what fails", "Solid/Solve known failures"},
        {"Solid/Allow large strain",
         "Solid/Accept strains beyond linear theory"},
        {"Body */Support", "Body */Prescribed displacement"},
        {"Membrane/Dirichlet", "Membrane/Prescribed displacement"},
        {"Membrane/Neumann", "Membrane/Traction"},
        {"Membrane/Load", "Membrane/Body force"},
        {"Pair */Mesh gap", "Pair */Use mesh gap"},
        {"Load steps/Steps", "Time stepping/Number of steps"},
        {"Load steps/End time", "Time stepping/End time"},
        {"Load steps/Cut back", "Time stepping/Cut back"},
        {"Load steps/Smallest step", "Time stepping/Smallest step"},
        {"Load steps/Newton steps", "Time stepping/Maximum Newton iterations"},
        {"Load steps/Newton tolerance", "Time stepping/Newton tolerance"},
        {"Time/Scheme", "Time stepping/Scheme"},
        {"Time/Step", "Time stepping/Step size"},
        {"Time/End", "Time stepping/End time"},
        {"Time/Alpha", "Time stepping/HHT alpha"},
        {"Time/Rho infinity",
         "Time stepping/Generalised alpha spectral radius"},
        {"Time/Beta", "Time stepping/Newmark beta"},
        {"Time/Gamma", "Time stepping/Newmark gamma"},
        {"Time/Restitution", "Time stepping/Restitution"},
        {"Time/Mass", "Time stepping/Mass matrix"},
        {"Time/Mass damping", "Time stepping/Mass damping"},
        {"Time/Stiffness damping", "Time stepping/Stiffness damping"},
        {"Refinement/Most meshes", "Refinement/Maximum meshes"},
        {"Contact/Penalty", "Contact/Penalty factor"},
        {"Sweep/Penalties", "Sweep/Penalty factors"},
        {"Sweep/Most tests", "Sweep/Maximum tests"},
    };
    return all;
  }

  const std::vector<OldValue> &old_values()
  {
    static const std::vector<OldValue> all = {
        {"Method/Contact geometry", "small", "reference"},
        {"Method/Contact geometry", "step", "start of step"},
        {"Method/Contact geometry", "large", "current"},
        {"Time stepping/Scheme", "none", "quasi-static"},
    };
    return all;
  }

  std::string present_path(const std::string &path)
  {
    for (const OldName &name : old_names())
      if (const Star star = match(name.old_path, path); star.fits)
        return filled(name.path, star.number);
    return path;
  }

  std::string present_value(const std::string &path, const std::string &value)
  {
    for (const OldValue &old : old_values())
      if (path == old.path && value == old.old_value)
        return old.value;
    return value;
  }

  void declare_old_names(dealii::ParameterHandler &prm,
                         const std::string &section)
  {
    const std::string folder = section + "/";
    for (const OldName &name : old_names())
    {
      const std::string path = name.path, old_path = name.old_path;
      if (path.compare(0, folder.size(), folder) == 0
          && old_path.compare(0, folder.size(), folder) == 0)
        prm.declare_alias(path.substr(folder.size()),
                          old_path.substr(folder.size()), true);
    }
  }
} // namespace abut::parameter
