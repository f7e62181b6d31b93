// SPDX-License-Identifier: LGPL-2.1-or-later
/* The declared parameters of a ParameterHandler, by way of its JSON output:
 * the handler has no other access to names, patterns and texts. */
#include "parameters.h"

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <sstream>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Utilities = dealii::Utilities;

    /** ParameterHandler writes each character of a name other than letters and
     * digits as an underscore and two hexadecimal digits. */
    std::string demangle(const std::string &name)
    {
      std::string result;
      for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == '_' && i + 2 < name.size())
        {
          const std::string digits = name.substr(i + 1, 2);
          result += static_cast<char>(std::stoi(digits, nullptr, 16));
          i += 2;
        }
        else
          result += name[i];
      return result;
    }

    /** Words of "[Selection a|b|c ]". */
    std::vector<std::string> selection_words(const std::string &pattern)
    {
      const std::string begin = "[Selection ";
      if (pattern.compare(0, begin.size(), begin) != 0)
        return {};
      return Utilities::split_string_list(
          pattern.substr(begin.size(), pattern.size() - begin.size() - 1), '|');
    }

    const std::string or_word = "[Or ";

    /** The word of "[Or auto [Number above 0]]". */
    std::string word_of(const std::string &pattern)
    {
      if (pattern.compare(0, or_word.size(), or_word) != 0)
        return "";
      const std::size_t end = pattern.find(' ', or_word.size());
      return pattern.substr(or_word.size(), end - or_word.size());
    }

    /** A pattern's description in words. */
    std::string pattern_words(std::string pattern)
    {
      const std::string word = word_of(pattern);
      if (!word.empty())
      {
        const std::size_t begin = or_word.size() + word.size() + 1;
        return pattern_words(pattern.substr(begin, pattern.size() - begin - 1))
               + ", or " + word;
      }
      const std::vector<std::string> choices = selection_words(pattern);
      if (!choices.empty())
      {
        std::string words = "one of ";
        for (std::size_t i = 0; i < choices.size(); ++i)
          words += (i == 0 ? "" : ", ") + choices[i];
        return words;
      }
      if (pattern == "[Bool]")
        return "true or false";
      if (pattern == "[Anything]")
        return "text";
      if (pattern.compare(0, 4, "[Map") == 0)
        return "a list of `name: number`";
      const std::string text = "[Text ";
      if (pattern.compare(0, text.size(), text) == 0)
        return pattern.substr(text.size(), pattern.size() - text.size() - 1);
      const std::string number = "[Number";
      if (pattern.compare(0, number.size(), number) == 0)
        return "a number"
               + pattern.substr(number.size(),
                                pattern.size() - number.size() - 1);
      std::istringstream in(pattern);
      std::string kind, range;
      in >> kind >> range;
      if (range == "range")
        in >> range;
      if (kind != "[Double" && kind != "[Integer")
        return pattern;
      std::string words = kind == "[Double" ? "a number" : "a whole number";
      const std::size_t dots = range.find("...");
      if (dots == std::string::npos)
        return words;
      const std::string low = range.substr(0, dots),
                        high = range.substr(dots + 3);
      const bool bounded_below =
          low.find("MAX") == std::string::npos && low != "-2147483648";
      const bool bounded_above =
          high.find("MAX") == std::string::npos && high != "2147483647";
      if (bounded_below && bounded_above)
        words += " from " + low + " to " + high;
      else if (bounded_below)
        words += " of at least " + low;
      else if (bounded_above)
        words += " of at most " + high;
      return words;
    }

    void collect(const boost::property_tree::ptree &tree,
                 const std::string &path,
                 std::vector<DeclaredParameter> &result)
    {
      for (const auto &[mangled, node] : tree)
      {
        const std::string name = path + demangle(mangled);
        if (const auto value = node.get_optional<std::string>("default_value"))
        {
          const std::string pattern =
              node.get<std::string>("pattern_description", "");
          const parameter::Documentation documentation(
              node.get<std::string>("documentation", ""));
          result.push_back({name, node.get<std::string>("value", *value),
                            *value, documentation.text, pattern_words(pattern),
                            selection_words(pattern), word_of(pattern),
                            documentation.note});
        }
        else if (!node.get_optional<std::string>("alias"))
          collect(node, name + "/", result);
      }
    }
  } // namespace

  std::vector<DeclaredParameter>
  declared_parameters(const ParameterHandler &prm)
  {
    std::stringstream json;
    prm.print_parameters(json, ParameterHandler::JSON
                                   | ParameterHandler::KeepDeclarationOrder);
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(json, tree);
    std::vector<DeclaredParameter> result;
    collect(tree, "", result);
    return result;
  }
} // namespace abut::app
