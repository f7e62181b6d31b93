// SPDX-License-Identifier: LGPL-2.1-or-later
#include "number_text.h"

#include "expression.h"
#include "input_error.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace abut::app
{
  namespace
  {
    bool is_digit(const char c)
    {
      return std::isdigit(static_cast<unsigned char>(c)) != 0;
    }

    bool is_letter(const char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    /** What is wrong with the number at the beginning of @p text; sets its
     * length. */
    std::string wrong_number(const std::string &text, std::size_t &length)
    {
      char *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      length = std::max<std::size_t>(
          1, static_cast<std::size_t>(end - text.c_str()));
      if (text.size() > 2 && text[0] == '0'
          && std::tolower(static_cast<unsigned char>(text[1])) == 'x'
          && std::isxdigit(static_cast<unsigned char>(text[2])) != 0)
        return "is hexadecimal; numbers are decimal.";
      if (!std::isfinite(value))
        return "is not a finite number: it is too large for the range of "
               "numbers, up to 1.8e308.";
      const std::string mantissa =
          text.substr(0, std::min(length, text.find_first_of("eE")));
      if (value == 0.
          && mantissa.find_first_of("123456789") != std::string::npos)
        return "is too small for the range of numbers, from 2.2e-308; write "
               "0.";
      return "";
    }

    /** The text with points for commas between digits. */
    std::string with_points(std::string text)
    {
      for (std::size_t i = 1; i + 1 < text.size(); ++i)
        if (text[i] == ',' && is_digit(text[i - 1]) && is_digit(text[i + 1]))
          text[i] = '.';
      return text;
    }

    std::string decimal_comma_hint(const std::string &text)
    {
      const std::string better = with_points(text);
      const bool is_clear =
          better != text && text.find('.') == std::string::npos;
      return !is_clear ? " Is it a decimal comma?"
                       : " Is it a decimal comma? Write '" + better + "'.";
    }
  } // namespace

  std::string quoted_in(const std::string &part, const std::string &whole)
  {
    return "'" + part + "'" + (part == whole ? "" : " in '" + whole + "'");
  }

  void check_numbers(const std::string &text, const std::string &parameter)
  {
    for (std::size_t i = 0; i < text.size(); ++i)
    {
      std::size_t length = 1;
      if (is_letter(text[i]))
        while (i + 1 < text.size()
               && (is_letter(text[i + 1]) || is_digit(text[i + 1])))
          ++i;
      else if (is_digit(text[i])
               || (text[i] == '.' && i + 1 < text.size()
                   && is_digit(text[i + 1])))
      {
        const std::string wrong = wrong_number(text.substr(i), length);
        if (!wrong.empty())
          throw InputError(parameter, quoted_in(text.substr(i, length), text)
                                          + " " + wrong);
        i += length - 1;
      }
    }
  }

  std::string misread_hint(const std::string &text)
  {
    for (const char *minus : {"\xE2\x88\x92", "\xE2\x80\x93", "\xE2\x80\x94"})
      if (text.find(minus) != std::string::npos)
        return " Its minus is a typographic one: write '-'.";
    if (std::any_of(text.begin(), text.end(),
                    [](const char c)
                    { return static_cast<unsigned char>(c) > 127; }))
      return " It has a character that is not ASCII, perhaps a blank.";
    if (with_points(text) != text)
      return decimal_comma_hint(text);
    char *end = nullptr;
    std::strtod(text.c_str(), &end);
    const std::string rest(end);
    if (rest == text)
      return "";
    const std::size_t next = rest.find_first_not_of(" \t");
    if (next == std::string::npos)
      return "";
    if (next > 0 && is_digit(rest[next]))
      return " It has a blank within a number, or is several numbers.";
    if (is_letter(rest[next]))
      return " Values have no units; a product requires '*'.";
    return "";
  }

  void check_one_formula(const std::string &text, const std::string &value,
                         const std::string &parameter)
  {
    if (split_list(text, ',').size() > 1)
      throw InputError(parameter,
                       quoted_in(text, value)
                           + " has a comma outside of brackets, where one "
                             "number or formula is required."
                           + decimal_comma_hint(text));
  }

  std::string lower_case(std::string word)
  {
    for (char &c : word)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return word;
  }

  bool are_digits(const std::string &word)
  {
    return !word.empty() && std::all_of(word.begin(), word.end(), is_digit);
  }
} // namespace abut::app
