// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_summary.h"

#include <abut/dealii/nearest_word.h>

#include <boost/property_tree/json_parser.hpp>

#include <cmath>
#include <cstdlib>

namespace abut::app
{
  namespace
  {
    using boost::property_tree::ptree;

    std::optional<double> number_of(const std::string &text)
    {
      if (text == "true" || text == "false")
        return text == "true" ? 1. : 0.;
      char *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0' || !std::isfinite(value))
        return std::nullopt;
      return value;
    }

    /** Component of an array; elements of arrays have no name. */
    const ptree *component(const ptree &array, std::size_t left)
    {
      for (const auto &[name, element] : array)
        if (left-- == 0)
          return name.empty() ? &element : nullptr;
      return nullptr;
    }
  } // namespace

  RunSummary::RunSummary(const std::filesystem::path &file)
  {
    try
    {
      boost::property_tree::read_json(file.string(), tree);
    }
    catch (const boost::property_tree::json_parser_error &)
    {
      tree.clear();
    }
  }

  std::optional<double> RunSummary::number(const std::string &key) const
  {
    const std::size_t bracket = key.find('[');
    const auto entry =
        tree.get_child_optional(ptree::path_type(key.substr(0, bracket), '/'));
    if (!entry)
      return std::nullopt;
    if (bracket == std::string::npos)
      return number_of(entry->data());
    const ptree *element =
        component(*entry, std::strtoul(&key[bracket + 1], nullptr, 10));
    return element == nullptr ? std::nullopt : number_of(element->data());
  }

  std::optional<double> RunSummary::cost(const std::string &key) const
  {
    auto result = number(key);
    if (result && (key == "processor_seconds" || key == "wall_seconds"))
      for (const std::string name : {"results", "output"})
        *result -= number("sections/" + name + "/"
                          + (key == "wall_seconds" ? "seconds" : key))
                       .value_or(0.);
    return result;
  }

  std::string RunSummary::explain(const std::string &key) const
  {
    const std::string name = key.substr(0, key.find('['));
    const auto entry = tree.get_child_optional(ptree::path_type(name, '/'));
    if (!entry)
    {
      const std::string nearest = nearest_word(name, keys());
      for (const char *end : {"", "[0]"})
        if (number(nearest + end))
          return " Did you mean '" + nearest + end + "'?";
      return "";
    }
    const std::size_t n = entry->size();
    if (n == 0 && number_of(entry->data()))
      return " '" + name + "' is one number, not a list: write '" + name + "'.";
    if (n == 0 || component(*entry, 0) == nullptr)
      return " '" + name + "' is not a number.";
    return " '" + name + "' is a list of " + std::to_string(n) + ": write '"
           + name + "[0]'"
           + (n == 1 ? "." : " or up to '[" + std::to_string(n - 1) + "]'.");
  }

  std::vector<std::string> RunSummary::keys() const
  {
    std::vector<std::string> result;
    for (const auto &entry : tree)
      result.push_back(entry.first);
    return result;
  }
} // namespace abut::app
