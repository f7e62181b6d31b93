// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_DEALII_MESSAGE_H
#define ABUT_APP_DEALII_MESSAGE_H

#include <exception>
#include <string>

namespace abut::app
{
  /** What an exception of deal.II has to say to a user, in one line: its
   * additional information without place in the source and stack. The whole
   * text of other exceptions. */
  std::string dealii_message(const std::exception &error);
} // namespace abut::app

#endif
