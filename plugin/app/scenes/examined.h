// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_EXAMINED_H
#define ABUT_APP_EXAMINED_H

#include "app/report/report.h"

#include <limits>
#include <string>

namespace abut::app
{
  /** Where a measure has no such limit. */
  inline constexpr double no_limit = std::numeric_limits<double>::quiet_NaN();

  /** Note a measure of the examination of an answer with the limits above which
   * it is a warning, and an error: the summary has them in `examination`. */
  inline void examined(Report &report, const std::string &name,
                       const double value, const double warning,
                       const double error)
  {
    report.set("examination/" + name,
               std::vector<double>{value, warning, error});
  }
} // namespace abut::app

#endif
