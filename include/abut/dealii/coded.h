// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CODED_H
#define ABUT_DEALII_CODED_H

#include <abut/failure.h>

#include <string>

namespace abut
{
  /** A message about a known failure, with its code in front: `ABUT-F06: text`.
   * The text alone for ABUT_FAILURE_NONE. */
  inline std::string coded(const abut_failure failure, const std::string &text)
  {
    const abut_failure_entry *entry = abut_failure_get(failure);
    return entry == nullptr ? text : entry->code + (": " + text);
  }

  /** The failure whose code the message begins with, or ABUT_FAILURE_NONE. */
  inline abut_failure failure_of(const std::string &message)
  {
    for (int i = 0; abut_failure_at(i) != nullptr; ++i)
      if (message.rfind(abut_failure_at(i)->code, 0) == 0)
        return abut_failure_at(i)->failure;
    return ABUT_FAILURE_NONE;
  }

  /** The message without the code that it may begin with. */
  inline std::string uncoded(const std::string &message)
  {
    const bool has_code = message.rfind("ABUT-F", 0) == 0;
    return message.substr(has_code ? std::string("ABUT-F00: ").size() : 0);
  }

  /** The message with what it is about in front of its text, and behind its
   * code if it has one: `ABUT-F11: Pair 1: text`. */
  inline std::string about(const std::string &subject,
                           const std::string &message)
  {
    const std::string text = uncoded(message);
    return message.substr(0, message.size() - text.size()) + subject + ": "
           + text;
  }
} // namespace abut

#endif
