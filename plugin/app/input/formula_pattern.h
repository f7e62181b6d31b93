// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_FORMULA_PATTERN_H
#define ABUT_APP_FORMULA_PATTERN_H

/** @file
 * Patterns of parameters that are formulas: the reference gives their number,
 * and tests find them.
 */

#include <deal.II/base/patterns.h>

#include <memory>
#include <string>

namespace abut::app
{
  /** Text that Expression or BoundaryExpressions read. All text matches: they
   * know better what is wrong with it. */
  class FormulaPattern : public dealii::Patterns::PatternBase
  {
  public:
    /** One number or formula, which may be empty. */
    static FormulaPattern one()
    {
      return FormulaPattern("a formula");
    }

    /** A formula per direction, in commas or semicolons. */
    static FormulaPattern vector()
    {
      return FormulaPattern("a formula per direction");
    }

    /** One formula per boundary id, `1: x; 2, 3: 0`. */
    static FormulaPattern by_id()
    {
      return FormulaPattern("a formula per boundary id");
    }

    /** A formula per direction for each boundary id, `1: x, 0; 2, 3: 0, 0`. */
    static FormulaPattern vector_by_id()
    {
      return FormulaPattern("a formula per direction for each boundary id");
    }

    bool match(const std::string &) const override
    {
      return true;
    }

    /** The words in brackets, as "[Formula a formula]". */
    std::string description(const OutputStyle = Machine) const override
    {
      return "[Formula " + words + "]";
    }

    std::unique_ptr<dealii::Patterns::PatternBase> clone() const override
    {
      return std::make_unique<FormulaPattern>(*this);
    }

  private:
    explicit FormulaPattern(const std::string &words) : words(words)
    {
    }

    std::string words;
  };
} // namespace abut::app

#endif
