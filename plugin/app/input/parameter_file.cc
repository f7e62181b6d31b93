// SPDX-License-Identifier: LGPL-2.1-or-later
#include "parameters.h"

#include "expression.h"
#include "number_text.h"

#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Utilities = dealii::Utilities;

    /** Text without blanks at both ends and with single blanks within. */
    std::string squeezed(const std::string &text)
    {
      std::istringstream in(text);
      std::string word, result;
      while (in >> word)
        result += (result.empty() ? "" : " ") + word;
      return result;
    }

    /** How the origin of values from the command line begins. */
    const std::string set_option = "--set ";

    std::string join(const std::vector<std::string> &sections,
                     const std::string &name)
    {
      std::string path;
      for (const std::string &section : sections)
        path += section + "/";
      return path + name;
    }

    std::string text_of(const ParameterFile::Place &place)
    {
      return place.file + ":" + std::to_string(place.line);
    }

    /** How @p assignment was given: all with the same word count together. */
    std::string source_of(const Assignment &assignment)
    {
      return assignment.origin.compare(0, 2, "--") == 0
                 ? assignment.origin.substr(0, assignment.origin.find(' '))
                 : "file";
    }

    [[noreturn]] void complain(const ParameterFile::Place &place,
                               const std::string &message)
    {
      throw InputError("", text_of(place) + ": " + message);
    }

    /** Complain about @p path, which is not declared: name the section when
     * that is wrong, else the parameter. */
    [[noreturn]] void
    throw_undeclared(const std::string &path,
                     const std::vector<DeclaredParameter> &declared,
                     const AdviceFor &elsewhere)
    {
      const std::size_t slash = path.rfind('/');
      const std::string section =
          slash == std::string::npos ? "" : path.substr(0, slash);
      const std::string name = path.substr(section.empty() ? 0 : slash + 1);
      std::set<std::string> sections;
      std::vector<std::string> names, same_name;
      for (const DeclaredParameter &parameter : declared)
      {
        const std::size_t end = parameter.path.rfind('/');
        const std::string where =
            end == std::string::npos ? "" : parameter.path.substr(0, end);
        const std::string last =
            where.empty() ? parameter.path : parameter.path.substr(end + 1);
        sections.insert(where);
        if (where == section)
          names.push_back(last);
        if (last == name)
          same_name.push_back(parameter.path);
      }
      const auto or_elsewhere = [&](const std::string &advice)
      { return advice.empty() && elsewhere ? elsewhere(path) : advice; };
      if (!section.empty() && names.empty())
        throw InputError(path,
                         "there is no section '" + section + "'."
                             + or_elsewhere(did_you_mean(
                                 section, {sections.begin(), sections.end()})));
      // Under another section, or under its old name.
      for (const parameter::OldName &old : parameter::old_names())
        if (std::filesystem::path(old.old_path).filename() == name)
          for (const DeclaredParameter &parameter : declared)
            if (parameter.path == old.path)
              same_name.push_back(parameter.path);
      std::string advice = did_you_mean(name, names);
      const auto in_common = [&path](const std::string &other)
      {
        return std::mismatch(path.begin(),
                             path.begin()
                                 + static_cast<std::ptrdiff_t>(
                                     std::min(path.size(), other.size())),
                             other.begin())
                   .first
               - path.begin();
      };
      if (advice.empty() && !same_name.empty())
        advice =
            " There is a parameter '"
            + *std::max_element(same_name.begin(), same_name.end(),
                                [&](const std::string &a, const std::string &b)
                                { return in_common(a) < in_common(b); })
            + "'.";
      throw InputError(path,
                       "there is no such parameter." + or_elsewhere(advice));
    }

    void set_value(ParameterHandler &prm, const DeclaredParameter &parameter)
    {
      const std::string &value = parameter.value;
      const std::string &words = parameter.pattern;
      const bool is_number = words.rfind("a number", 0) == 0
                             || words.rfind("a whole number", 0) == 0;
      if (is_number)
        check_numbers(value, parameter.path);
      // Here, since scenes do not read formulas without effect.
      if (words == "a formula")
        check_one_formula(value, value, parameter.path);
      std::vector<std::string> sections =
          Utilities::split_string_list(parameter.path, '/');
      const std::string name = sections.back();
      sections.pop_back();
      for (const std::string &section : sections)
        prm.enter_subsection(section);
      bool legal = true;
      try
      {
        prm.set(name, value);
      }
      catch (const dealii::ExceptionBase &)
      {
        legal = false;
      }
      for (std::size_t i = 0; i < sections.size(); ++i)
        prm.leave_subsection();
      if (!legal)
        throw InputError(parameter.path,
                         "'" + value + "' is not " + parameter.pattern + "."
                             + did_you_mean(value, parameter.choices)
                             + (is_number ? misread_hint(value) : ""));
    }
  } // namespace

  ParameterFile::ParameterFile(const std::string &file,
                               const std::vector<std::string> &overrides,
                               const std::vector<std::string> &offers)
      : file(file)
  {
    read(file, 0);
    for (const std::string &argument : offers)
      override_with("--set-if-used ", argument);
    for (const std::string &argument : overrides)
      override_with(set_option, argument);
    refuse_two_names();
  }

  void ParameterFile::assign(const std::string &path, const std::string &value,
                             const std::string &origin)
  {
    const std::string now = parameter::present_path(path);
    assignments.push_back(
        {now, parameter::present_value(now, value), origin, path, value});
  }

  void ParameterFile::refuse_two_names() const
  {
    std::map<std::pair<std::string, std::string>, const Assignment *> first;
    for (const Assignment &assignment : assignments)
    {
      const Assignment *&other =
          first[{source_of(assignment), assignment.path}];
      if (other == nullptr)
        other = &assignment;
      else if (other->written != assignment.written)
        throw InputError("", assignment.origin + ": '" + assignment.written
                                 + "' and '" + other->written + "' ("
                                 + other->origin
                                 + ") are names of one parameter. Keep '"
                                 + assignment.path + "' alone.");
    }
  }

  std::vector<std::string>
  ParameterFile::old_words(const std::vector<DeclaredParameter> &declared) const
  {
    std::set<std::string> seen;
    std::vector<std::string> lines;
    const auto add = [&](const std::string &old, const std::string &now)
    {
      const std::string line = "'" + old + "' is now '" + now + "'";
      if (seen.insert(line).second)
        lines.push_back(line);
    };
    for (const Assignment &assignment : assignments)
    {
      if (assignment.written != assignment.path)
        add(assignment.written, assignment.path);
      if (assignment.written_value != assignment.value)
        add(assignment.path + " = " + assignment.written_value,
            assignment.value);
      for (const DeclaredParameter &parameter : declared)
        if (parameter.path == assignment.path && !parameter.zero_word.empty()
            && OrWord::is_zero(assignment.value))
          add(assignment.path + " = " + assignment.value, parameter.zero_word);
    }
    return lines;
  }

  void ParameterFile::read(const std::string &name, const unsigned int depth)
  {
    std::ifstream in(name);
    if (!in || std::filesystem::is_directory(name))
      throw InputError("", "cannot read the scene file '" + name + "'.");
    if (depth > 10)
      throw InputError("", name + ": files include each other without end.");

    std::vector<std::string> sections;
    std::string line, continued;
    unsigned int number = 0;
    while (std::getline(in, line))
    {
      ++number;
      line = Utilities::trim(continued + line.substr(0, line.find('#')));
      continued.clear();
      if (!line.empty() && line.back() == '\\')
      {
        line.pop_back();
        continued = line;
      }
      else if (!line.empty())
        read_line(line, {name, number}, sections, depth);
    }
    if (!sections.empty())
      complain({name, number}, "the file ends within subsection '"
                                   + sections.back()
                                   + "': an 'end' is missing.");
  }

  void ParameterFile::read_line(const std::string &line, const Place &place,
                                std::vector<std::string> &sections,
                                const unsigned int depth)
  {
    std::istringstream words(line);
    std::string keyword, rest;
    words >> keyword;
    std::getline(words, rest);
    const std::string command = lower_case(keyword);
    if (command == "subsection")
      sections.push_back(squeezed(rest));
    else if (command == "end")
    {
      if (sections.empty())
        complain(place, "'end' without 'subsection'.");
      sections.pop_back();
    }
    else if (command == "include")
      read((std::filesystem::path(place.file).parent_path() / squeezed(rest))
               .string(),
           depth + 1);
    else if (command == "set")
    {
      const std::size_t sign = rest.find('=');
      if (sign == std::string::npos)
        complain(place, "'set' without '=': " + line);
      assign(join(sections, squeezed(rest.substr(0, sign))),
             Utilities::trim(rest.substr(sign + 1)), text_of(place));
    }
    else
      complain(place, "'" + keyword + "' is not a word of a scene file."
                          + did_you_mean(keyword, {"set", "subsection", "end",
                                                   "include"}));
  }

  void ParameterFile::override_with(const std::string &option,
                                    const std::string &argument)
  {
    const std::size_t sign = argument.find('=');
    if (sign == std::string::npos)
      throw InputError("", option + "\"" + argument + "\": write " + option
                               + "\"Section/Name=value\".");
    std::vector<std::string> words;
    for (const std::string &word :
         Utilities::split_string_list(argument.substr(0, sign), '/'))
      words.push_back(squeezed(word));
    const std::string name = words.empty() ? "" : words.back();
    if (!words.empty())
      words.pop_back();
    assign(join(words, name), Utilities::trim(argument.substr(sign + 1)),
           option + "\"" + argument + "\"");
  }

  std::string ParameterFile::name() const
  {
    return std::filesystem::path(file).stem().string();
  }

  InputError ParameterFile::placed(const InputError &error) const
  {
    if (error.parameter.empty())
      return error;
    return {"", origin(error.parameter) + ": " + error.parameter + ": "
                    + error.message()};
  }

  std::string ParameterFile::get(const std::string &path,
                                 const std::string &otherwise) const
  {
    std::string value = otherwise;
    for (const Assignment &assignment : assignments)
      if (assignment.path == path)
        value = assignment.value;
    return value;
  }

  std::string ParameterFile::origin(const std::string &path) const
  {
    std::string result = file;
    for (const Assignment &assignment : assignments)
      if (assignment.path == path)
        result = assignment.origin;
    return result;
  }

  bool ParameterFile::is_from_command_line(const std::string &path) const
  {
    return origin(path).compare(0, set_option.size(), set_option) == 0;
  }

  std::map<std::string, std::string> ParameterFile::values() const
  {
    std::map<std::string, std::string> result;
    for (const Assignment &assignment : assignments)
      result[assignment.path] = assignment.value;
    return result;
  }

  std::vector<DeclaredParameter>
  ParameterFile::apply(ParameterHandler &prm, const AdviceFor &elsewhere) const
  {
    std::vector<DeclaredParameter> declared = declared_parameters(prm);
    for (const Assignment &assignment : assignments)
    {
      DeclaredParameter *found = nullptr;
      for (DeclaredParameter &parameter : declared)
        if (parameter.path == assignment.path)
          found = &parameter;
      if (found == nullptr)
        throw_undeclared(assignment.path, declared, elsewhere);
      // The last assignment counts; the others are not looked at.
      found->value = get(assignment.path, "");
      if (!found->zero_word.empty() && OrWord::is_zero(found->value))
        found->value = found->zero_word;
      set_value(prm, *found);
    }
    return declared;
  }

  std::vector<double> parse_numbers(const std::string &text,
                                    const std::string &parameter)
  {
    check_numbers(text, parameter);
    const std::vector<std::string> parts = split_list(text, ',');
    if (std::find(parts.begin(), parts.end(), "") != parts.end())
      throw InputError(parameter, "'" + text
                                      + "' has a comma without a number "
                                        "on both sides.");
    std::string blanks = text;
    for (char &c : blanks)
      if (c == ',')
        c = ' ';
    std::istringstream in(blanks);
    std::vector<double> numbers;
    std::string word;
    while (in >> word)
    {
      char *end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end != '\0' || !std::isfinite(value))
        throw InputError(
            parameter,
            quoted_in(word, text)
                + " is not a finite number; formulas are not supported here."
                + misread_hint(word));
      if (std::abs(value) > largest_value)
        throw InputError(parameter,
                         "'" + word + "' is too large: the limit is 1e100.");
      numbers.push_back(value);
    }
    return numbers;
  }

  double parse_number_or_nan(const std::string &text,
                             const std::string &parameter)
  {
    if (text == "nan" || text.empty())
      return std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> numbers = parse_numbers(text, parameter);
    if (numbers.size() != 1)
      throw InputError(parameter,
                       "'" + text + "' is not a number." + misread_hint(text));
    return numbers[0];
  }
} // namespace abut::app
