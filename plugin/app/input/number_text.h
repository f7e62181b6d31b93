// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NUMBER_TEXT_H
#define ABUT_APP_NUMBER_TEXT_H

/** @file
 * Numbers in a scene file that are easily misread: decimal commas, typographic
 * minus signs, hexadecimal digits, exponents beyond the range of numbers; and
 * letters and digits of words.
 */

#include <string>

namespace abut::app
{
  /** Throw InputError that names @p parameter if @p text has a number that
   * would be read as another one: hexadecimal, or of a magnitude beyond the
   * range of numbers, such as 1e400 and 1e-400. */
  void check_numbers(const std::string &text, const std::string &parameter);

  /** Why @p text, which is not what it must be, may have been written: a
   * sentence about a decimal comma, a typographic minus, a blank within a
   * number or a unit, after a blank; else empty. */
  std::string misread_hint(const std::string &text);

  /** "'part' in 'whole'", or "'part'" where it is the whole. */
  std::string quoted_in(const std::string &part, const std::string &whole);

  /** A word without capital letters, of ASCII. */
  std::string lower_case(std::string word);

  /** Whether a word has digits only, and one at least. */
  bool are_digits(const std::string &word);

  /** Asks for a decimal comma where more numbers are given than needed. */
  inline std::string count_hint(const std::size_t given,
                                const std::size_t needed)
  {
    return given > needed ? " Is it a decimal comma?" : "";
  }

  /** Throw InputError that names @p parameter if @p text, of @p value, has a
   * comma outside of brackets: it is one formula or number. */
  void check_one_formula(const std::string &text, const std::string &value,
                         const std::string &parameter);
} // namespace abut::app

#endif
