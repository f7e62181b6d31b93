// SPDX-License-Identifier: LGPL-2.1-or-later
#include "effect_rules.h"

#include "expression.h"

#include <cstdlib>
#include <utility>

namespace abut::app
{
  namespace
  {
    /** Whether @p text is @p pattern with any text for each `*`. */
    bool fits_text(const char *pattern, const char *text)
    {
      if (*pattern == '\0')
        return *text == '\0';
      if (*pattern != '*')
        return *pattern == *text && fits_text(pattern + 1, text + 1);
      for (;; ++text)
      {
        if (fits_text(pattern + 1, text))
          return true;
        if (*text == '\0')
          return false;
      }
    }

    /** Whether two values mean the same: 1e-3 is 0.001. */
    bool same_value(const std::string &a, const std::string &b)
    {
      if (a == b)
        return true;
      if (a.empty() || b.empty())
        return false;
      char *end_a = nullptr;
      char *end_b = nullptr;
      const double x = std::strtod(a.c_str(), &end_a);
      const double y = std::strtod(b.c_str(), &end_b);
      return *end_a == '\0' && *end_b == '\0' && x == y;
    }
  } // namespace

  SceneValues::SceneValues(const std::vector<DeclaredParameter> &parameters,
                           const ParameterFile &file)
      : file(file), parameters(parameters)
  {
  }

  std::string SceneValues::operator()(const std::string &path) const
  {
    for (const DeclaredParameter &parameter : parameters)
      if (parameter.path == path)
        return parameter.value;
    return "";
  }

  double SceneValues::number(const std::string &path) const
  {
    return std::atof((*this)(path).c_str());
  }

  bool SceneValues::is_true(const std::string &path) const
  {
    return (*this)(path) == "true";
  }

  bool SceneValues::is_set(const std::string &path) const
  {
    for (const DeclaredParameter &parameter : parameters)
      if (parameter.path == path)
        return !same_value(parameter.value, parameter.default_value);
    return false;
  }

  bool SceneValues::is_from_command_line(const std::string &path) const
  {
    return file.is_from_command_line(path);
  }

  std::vector<std::string>
  SceneValues::matching(const std::string &pattern) const
  {
    std::vector<std::string> paths;
    for (const DeclaredParameter &parameter : parameters)
      if (fits(pattern, parameter.path))
        paths.push_back(parameter.path);
    return paths;
  }

  std::string section_of(const std::string &path)
  {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
  }

  EffectRule
  effective_if(const std::string &parameters, const Weight weight,
               std::function<bool(const SceneValues &values)> condition,
               const std::string &otherwise)
  {
    return {parameters, weight,
            [condition = std::move(condition),
             otherwise](const SceneValues &values, const std::string &)
            { return condition(values) ? "" : otherwise; }};
  }

  EffectRule never_effective(const std::string &parameters, const Weight weight,
                             const std::string &why)
  {
    return {parameters, weight,
            [why](const SceneValues &, const std::string &) { return why; },
            true};
  }

  bool fits(const std::string &pattern, const std::string &path)
  {
    return fits_text(pattern.c_str(), path.c_str());
  }

  EffectRule without_time(const std::string &parameters, const std::string &why)
  {
    return {parameters, Weight::data,
            [why](const SceneValues &values, const std::string &path)
            {
              const std::string text = values(path);
              return names_in(text).count("t") == 0
                         ? ""
                         : "'" + text + "' depends on t, but " + why;
            }};
  }

  std::vector<std::string>
  values_without_effect(const std::vector<EffectRule> &rules,
                        const SceneValues &values)
  {
    std::vector<std::string> listed;
    std::set<std::string> seen;
    for (const EffectRule &rule : rules)
      for (const std::string &path : values.matching(rule.parameters))
      {
        if (!values.is_set(path) || seen.count(path) > 0)
          continue;
        const std::string why = rule.without_effect(values, path);
        if (why.empty())
          continue;
        if (rule.weight == Weight::data
            || (rule.weight == Weight::setting
                && values.is_from_command_line(path)))
          throw InputError(path, "has no effect: " + why);
        listed.push_back(path + ": " + why);
        seen.insert(path);
      }
    return listed;
  }
} // namespace abut::app
