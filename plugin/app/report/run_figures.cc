// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_figures.h"

#include <abut/dealii/nearest_word.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <sstream>

namespace abut::app
{
  namespace
  {
    namespace Utilities = dealii::Utilities;

    std::vector<std::string> cells(const std::string &line)
    {
      std::vector<std::string> result;
      std::istringstream in(line);
      std::string cell;
      while (std::getline(in, cell, ','))
        result.push_back(cell);
      return result;
    }

    /** `name(argument)`: the argument. */
    std::optional<std::string> argument_of(const std::string &text,
                                           const std::string &name)
    {
      if (text.rfind(name + "(", 0) != 0 || text.back() != ')')
        return {};
      return text.substr(name.size() + 1, text.size() - name.size() - 2);
    }

    std::optional<double> finite(const double value)
    {
      return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
    }

    std::optional<double> bound_of(const std::string &text)
    {
      char *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      return text.empty() || *end != '\0' ? std::nullopt : finite(value);
    }

    double starts(const std::vector<double> &column)
    {
      double before = 0., result = 0.;
      for (const double value : column)
      {
        result += before == 0. && value != 0. ? 1. : 0.;
        before = value;
      }
      return result;
    }

    double mean(const std::vector<double> &column)
    {
      return std::accumulate(column.begin(), column.end(), 0.)
             / double(column.size());
    }

    double ripple(const std::vector<double> &column)
    {
      const double middle = mean(column);
      double squares = 0.;
      for (const double value : column)
        squares += (value - middle) * (value - middle);
      return std::sqrt(squares / double(column.size())) / std::abs(middle);
    }

    double largest(const std::vector<double> &column)
    {
      double result = 0.;
      for (const double value : column)
        result = std::max(result, std::abs(value));
      return result;
    }

    struct Function
    {
      const char *name;
      double (*value)(const std::vector<double> &);
    };

    /** Of the rows within a range. */
    constexpr Function of_rows[] = {
        {"mean", mean}, {"ripple", ripple}, {"largest", largest}};

    constexpr const char *of_all_rows[] = {"order", "growth", "starts"};
  } // namespace

  RunFigures::RunFigures(const std::filesystem::path &folder)
      : summary(folder / "summary.json")
  {
    std::ifstream in(folder / "levels.csv");
    std::string line;
    if (!in || !std::getline(in, line))
      return;
    const std::vector<std::string> names = cells(line);
    while (std::getline(in, line))
    {
      const std::vector<std::string> row = cells(line);
      for (std::size_t i = 0; i < names.size(); ++i)
        columns[names[i]].push_back(i < row.size() && !row[i].empty()
                                        ? std::strtod(row[i].c_str(), nullptr)
                                        : NAN);
    }
  }

  std::optional<RunFigures::Column>
  RunFigures::column(const std::string &text) const
  {
    const std::size_t slash = text.find('/');
    const auto numerator = columns.find(Utilities::trim(text.substr(0, slash)));
    if (numerator == columns.end())
      return {};
    Column result = numerator->second;
    if (slash == std::string::npos)
      return result;
    const auto other = columns.find(Utilities::trim(text.substr(slash + 1)));
    if (other == columns.end())
      return {};
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] /= other->second[i];
    return result;
  }

  std::optional<RunFigures::Column>
  RunFigures::column_within(const std::string &text) const
  {
    const std::vector<std::string> parts =
        Utilities::split_string_list(text, ',');
    const auto values = parts.empty() ? std::nullopt : column(parts[0]);
    const auto times = columns.find("time");
    const bool ranged = parts.size() == 3 && times != columns.end();
    if (!values || (parts.size() != 1 && !ranged))
      return {};
    const auto begin = ranged ? bound_of(parts[1]) : -INFINITY,
               end = ranged ? bound_of(parts[2]) : INFINITY;
    if (!begin || !end)
      return {};
    // Times are printed with round-off.
    const double noise =
        ranged ? 1e-9 * (std::abs(*begin) + std::abs(*end)) : 0;
    Column result;
    for (std::size_t i = 0; i < values->size(); ++i)
      if (std::isfinite((*values)[i])
          && (!ranged
              || (times->second[i] > *begin + noise
                  && times->second[i] <= *end + noise)))
        result.push_back((*values)[i]);
    return result.empty() ? std::nullopt : std::optional<Column>(result);
  }

  std::optional<double> RunFigures::value(const std::string &name) const
  {
    if (const auto argument = argument_of(name, "starts"))
    {
      const auto values = column(*argument);
      return values ? finite(starts(*values)) : std::nullopt;
    }
    for (const std::string function : {"order", "growth"})
      if (const auto argument = argument_of(name, function))
      {
        const auto v = column(*argument);
        if (!v || v->size() < 2)
          return {};
        const double growth = (*v)[v->size() - 1] / (*v)[v->size() - 2];
        return finite(function == "order" ? -std::log2(growth) : growth);
      }
    for (const Function &function : of_rows)
      if (const auto argument = argument_of(name, function.name))
      {
        const auto values = column_within(*argument);
        return values ? finite(function.value(*values)) : std::nullopt;
      }
    return summary.number(name);
  }

  std::string RunFigures::explain(const std::string &name) const
  {
    std::vector<std::string> functions(std::begin(of_all_rows),
                                       std::end(of_all_rows));
    for (const Function &function : of_rows)
      functions.emplace_back(function.name);
    const std::string called = name.substr(0, name.find('('));
    if (called == name)
      return summary.explain(name);
    const auto found = std::find(functions.begin(), functions.end(), called);
    const auto argument = argument_of(name, called);
    if (found == functions.end() || !argument)
      return " Functions of a column of levels.csv are order, growth, starts, "
             "mean, ripple and largest: 'mean(contact_force)'.";
    std::vector<std::string> words;
    for (const auto &entry : columns)
      words.push_back(entry.first);
    const std::string first = argument->substr(0, argument->find(','));
    for (const std::string &part : Utilities::split_string_list(first, '/'))
      if (columns.count(part) == 0)
        return " levels.csv has no column '" + part + "'."
               + did_you_mean(part, words);
    return " No row of levels.csv has numbers there. A range of times is "
           "written so: 'mean(contact_force, 1, 2)', the rows after time 1 up "
           "to 2.";
  }
} // namespace abut::app
