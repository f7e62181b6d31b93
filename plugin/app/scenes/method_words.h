// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_METHOD_WORDS_H
#define ABUT_APP_METHOD_WORDS_H

/** @file
 * How contact is solved, in the words of the field: for the head of a run.
 */

#include <abut/dealii/method_parameters.h>

#include <string>

namespace abut::app
{
  /** "Lagrange multipliers" of the law `lagrange`. */
  std::string law_in_words(const MethodParameters &method);

  /** "2 bodies", "1 body". */
  std::string counted(std::size_t n, const std::string &one,
                      const std::string &several);
} // namespace abut::app

#endif
