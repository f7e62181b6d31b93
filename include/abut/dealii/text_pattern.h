// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_TEXT_PATTERN_H
#define ABUT_DEALII_TEXT_PATTERN_H

/** @file
 * Patterns of parameters that are more than a number or a word: the reference
 * states their type, and tests find them.
 */

#include <deal.II/base/patterns.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace abut
{
  /** Text of a type. All text matches: its reader reports errors better. */
  class TextPattern : public dealii::Patterns::PatternBase
  {
  public:
    /** @param type with its article, such as "a formula" */
    explicit TextPattern(const std::string &type) : type(type)
    {
    }

    /** One number or formula, which may be empty. */
    static TextPattern formula()
    {
      return TextPattern("a formula");
    }

    /** A formula per direction, in commas or semicolons. */
    static TextPattern vector()
    {
      return TextPattern("a vector of formulas");
    }

    /** One formula per boundary id, `1: x; 2, 3: 0`. */
    static TextPattern formula_by_id()
    {
      return TextPattern("a formula by boundary id");
    }

    /** A formula per direction for each boundary id, `1: x, 0; 2, 3: 0, 0`. */
    static TextPattern vector_by_id()
    {
      return TextPattern("a vector of formulas by boundary id");
    }

    /** Numbers, separated by commas. */
    static TextPattern numbers()
    {
      return TextPattern("a list of numbers");
    }

    /** A number per direction, separated by commas. */
    static TextPattern number_vector()
    {
      return TextPattern("a vector");
    }

    /** The name of a file. */
    static TextPattern file()
    {
      return TextPattern("a file");
    }

    /** Each text matches. */
    bool match(const std::string &) const override
    {
      return true;
    }

    /** The type in brackets, as "[Text a formula]". */
    std::string description(const OutputStyle = Machine) const override
    {
      return "[Text " + type + "]";
    }

    /** A copy, as deal.II's ParameterHandler needs it. */
    std::unique_ptr<dealii::Patterns::PatternBase> clone() const override
    {
      return std::make_unique<TextPattern>(*this);
    }

  private:
    std::string type;
  };

  /** Another pattern, or a word in its place, such as `auto`. The number 0, the
   * former spelling of the word, matches as well. */
  class OrWord : public dealii::Patterns::PatternBase
  {
  public:
    /** @p pattern, or @p word. */
    OrWord(const dealii::Patterns::PatternBase &pattern,
           const std::string &word)
        : pattern(pattern.clone()), word(word)
    {
    }

    /** Whether @p text is the number 0. */
    static bool is_zero(const std::string &text)
    {
      char *end = nullptr;
      return !text.empty() && std::strtod(text.c_str(), &end) == 0.
             && *end == '\0';
    }

    /** Whether @p text is the word, 0, or matches the pattern. */
    bool match(const std::string &text) const override
    {
      return text == word || is_zero(text) || pattern->match(text);
    }

    /** As "[Or auto [Number above 0]]". */
    std::string description(const OutputStyle style = Machine) const override
    {
      return "[Or " + word + " " + pattern->description(style) + "]";
    }

    /** A copy, as deal.II's ParameterHandler needs it. */
    std::unique_ptr<dealii::Patterns::PatternBase> clone() const override
    {
      return std::make_unique<OrWord>(*pattern, word);
    }

  private:
    std::unique_ptr<dealii::Patterns::PatternBase> pattern;
    std::string word;
  };
} // namespace abut

#endif
