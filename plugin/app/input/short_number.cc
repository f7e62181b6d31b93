// SPDX-License-Identifier: LGPL-2.1-or-later
#include "short_number.h"

#include <cstdio>

namespace abut::app
{
  std::string short_number(const double value, const int digits)
  {
    char text[64];
    std::snprintf(text, sizeof(text), "%.*g", digits, value + 0.); // 0: no sign
    return text;
  }

  std::string percent(const double part, const int digits)
  {
    return short_number(100. * part, digits) + " %";
  }
} // namespace abut::app
