// SPDX-License-Identifier: LGPL-2.1-or-later

#include "dealii_message.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace abut::app
{
  std::string dealii_message(const std::exception &error)
  {
    std::string text = error.what();
    const std::string before = "Additional information:";
    const std::size_t at = text.find(before);
    // Others may have put words of their own before deal.II's.
    if (at != std::string::npos)
      text = text.substr(0, std::min(at, text.find("\n-----")))
             + text.substr(at + before.size());
    text = text.substr(
        0, std::min(text.find("\nStacktrace"), text.find("\n-----")));
    std::istringstream words(text);
    std::string result;
    for (std::string word; words >> word;)
      result += (result.empty() ? "" : " ") + word;
    return result;
  }

  bool says_not_implemented(const std::string &message)
  {
    return message.find("not implemented") != std::string::npos;
  }

  std::size_t wanted_arguments(const std::string &message)
  {
    const std::string before = "Tuple of <";
    const std::size_t at = message.find(before);
    return at == std::string::npos
               ? 0
               : std::strtoul(message.c_str() + at + before.size(), nullptr,
                              10);
  }
} // namespace abut::app
