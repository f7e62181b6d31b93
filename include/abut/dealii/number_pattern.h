// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_NUMBER_PATTERN_H
#define ABUT_DEALII_NUMBER_PATTERN_H

/** @file
 * Numbers of parameter files whose range may leave out its ends.
 */

#include <abut/limits.h>

#include <deal.II/base/patterns.h>

#include <memory>
#include <sstream>
#include <string>

namespace abut
{
  /** A number in a range with open or closed ends: dealii::Patterns::Double has
   * closed ones only. Infinity and NaN are in no range. */
  class NumberPattern : public dealii::Patterns::PatternBase
  {
  public:
    /** The name in @p limit is not used. */
    explicit NumberPattern(const abut_limit &limit) : limit(limit)
    {
    }

    /** From @p low on. */
    static NumberPattern from(const double low)
    {
      return NumberPattern({nullptr, low, ABUT_LARGEST_NUMBER, false, false});
    }

    /** Above 0. */
    static NumberPattern positive()
    {
      return from(ABUT_SMALLEST_NUMBER);
    }

    /** From @p low to @p high, both legal. */
    static NumberPattern between(const double low, const double high)
    {
      return NumberPattern({nullptr, low, high, false, false});
    }

    /** Whether @p text is one number in the range. */
    bool match(const std::string &text) const override
    {
      double value;
      return dealii::Patterns::Double().match(text)
             && (std::istringstream(text) >> value)
             && abut_limit_contains(&limit, value);
    }

    /** The range in words, such as "[Number above 0 and below 1]". */
    std::string description(const OutputStyle = Machine) const override
    {
      const bool above =
          limit.low_open
          || (limit.low > 0. && limit.low <= ABUT_SMALLEST_NUMBER);
      const bool below = limit.high < ABUT_LARGEST_NUMBER;
      std::ostringstream words;
      words << "[Number";
      if (above)
        words << " above " << (limit.low_open ? limit.low : 0.);
      else if (limit.low > -ABUT_LARGEST_NUMBER)
        words << (below && !limit.high_open ? " from " : " of at least ")
              << limit.low;
      if (below)
        words << (limit.high_open                    ? " and below "
                  : above                            ? " and up to "
                  : limit.low > -ABUT_LARGEST_NUMBER ? " to "
                                                     : " of at most ")
              << limit.high;
      words << "]";
      return words.str();
    }

    /** The same pattern again. */
    std::unique_ptr<dealii::Patterns::PatternBase> clone() const override
    {
      return std::make_unique<NumberPattern>(limit);
    }

  private:
    abut_limit limit;
  };
} // namespace abut

#endif
