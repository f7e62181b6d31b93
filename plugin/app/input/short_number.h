// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SHORT_NUMBER_H
#define ABUT_APP_SHORT_NUMBER_H

#include <string>

namespace abut::app
{
  /** A number for tables and lines of progress, with @p digits digits. */
  std::string short_number(double value, int digits = 10);

  /** A part of 1 in per cent. */
  std::string percent(double part, int digits = 3);
} // namespace abut::app

#endif
