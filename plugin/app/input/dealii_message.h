// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_DEALII_MESSAGE_H
#define ABUT_APP_DEALII_MESSAGE_H

#include <cstddef>
#include <exception>
#include <string>

namespace abut::app
{
  /** What an exception of deal.II has to say to a user, in one line: its
   * additional information without place in the source and stack. The whole
   * text of other exceptions. */
  std::string dealii_message(const std::exception &error);

  /** Whether such a message is that of a generator without this name, or not in
   * this dimension: deal.II has no type for it. */
  bool says_not_implemented(const std::string &message);

  /** How many arguments a generator needs by such a message; 0 where it does
   * not say. */
  std::size_t wanted_arguments(const std::string &message);
} // namespace abut::app

#endif
