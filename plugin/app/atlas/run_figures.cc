// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_figures.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace abut::app
{
  namespace
  {
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

  std::optional<double> RunFigures::value(const std::string &name) const
  {
    if (const auto argument = argument_of(name, "starts"))
    {
      const auto column = columns.find(*argument);
      if (column == columns.end())
        return {};
      double before = 0., result = 0.;
      for (const double value : column->second)
      {
        result += before == 0. && value != 0. ? 1. : 0.;
        before = value;
      }
      return result;
    }
    for (const std::string function : {"order", "growth"})
      if (const auto argument = argument_of(name, function))
      {
        const auto column = columns.find(*argument);
        if (column == columns.end() || column->second.size() < 2)
          return {};
        const std::vector<double> &v = column->second;
        const double growth = v[v.size() - 1] / v[v.size() - 2];
        const double result = function == "order" ? -std::log2(growth) : growth;
        return std::isfinite(result) ? std::optional<double>(result)
                                     : std::nullopt;
      }
    return summary.number(name);
  }
} // namespace abut::app
