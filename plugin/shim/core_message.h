// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CORE_MESSAGE_H
#define ABUT_SHIM_CORE_MESSAGE_H

#include <abut/context.h>

#include <cstddef>
#include <string>

namespace abut::shim
{
  /** The core's last message for users: without the name of the function in
   * front, which is for programs in C. */
  inline std::string core_message(const abut_context *context)
  {
    const std::string message = abut_context_message(context);
    const std::size_t colon = message.find(": ");
    const bool has_name = message.compare(0, 5, "abut_") == 0
                          && colon != std::string::npos
                          && message.find(' ') > colon;
    return has_name ? message.substr(colon + 2) : message;
  }

  /** Its message about a call that failed; empty if it did not. */
  inline std::string message_of(const abut_context *context,
                                const abut_status status)
  {
    if (status == ABUT_SUCCESS)
      return "";
    const std::string message = context == nullptr ? "" : core_message(context);
    return message.empty() ? abut_status_text(status) : message;
  }
} // namespace abut::shim

#endif
