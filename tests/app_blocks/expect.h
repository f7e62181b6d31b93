// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_EXPECT_H
#define ABUT_TESTS_EXPECT_H

/** @file
 * Checks that print what failed and go on; the program's exit code is
 * Expect::failures() > 0.
 */

#include "app/input/input_error.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace abut::app
{
  class Expect
  {
  public:
    static int &failures()
    {
      static int count = 0;
      return count;
    }

    static void that(const bool good, const std::string &what)
    {
      if (good)
        return;
      ++failures();
      std::cout << "FAILED: " << what << std::endl;
    }

    /** |value - expected| <= tolerance; NaN fails. */
    static void near(const double value, const double expected,
                     const double tolerance, const std::string &what)
    {
      const bool good = std::abs(value - expected) <= tolerance;
      that(good, what + " is " + std::to_string(value) + ", expected "
                     + std::to_string(expected) + ", difference "
                     + std::to_string((value - expected) * 1e12) + "e-12");
    }

    /** @p action throws an InputError for @p parameter whose text has all of
     * @p words. */
    static void input_error(const std::function<void()> &action,
                            const std::string &parameter,
                            const std::vector<std::string> &words)
    {
      try
      {
        action();
      }
      catch (const InputError &error)
      {
        const std::string text = error.what();
        that(error.parameter == parameter,
             "parameter of '" + text + "' is '" + error.parameter
                 + "', expected '" + parameter + "'");
        for (const std::string &word : words)
          that(text.find(word) != std::string::npos,
               "'" + word + "' in '" + text + "'");
        return;
      }
      catch (const std::exception &error)
      {
        that(false, std::string("an input error, not: ") + error.what());
        return;
      }
      that(false, "an input error of " + parameter);
    }
  };
} // namespace abut::app

#endif
