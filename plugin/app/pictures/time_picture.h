// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_TIME_PICTURE_H
#define ABUT_APP_TIME_PICTURE_H

#include "app/report/report.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** Curves over time with one axis. */
  struct TimePanel
  {
    std::string label; ///< of the axis
    /** Names, and values at the times of the picture. */
    std::vector<std::pair<std::string, std::vector<double>>> curves;
  };

  /** `<name>.svg`: panels below each other over the same @p times; curves that
   * are 0 at all of them, and panels without curves, are left out. Rank 0 acts;
   * returns whether the picture was made. */
  bool draw_over_time(Report &report, const std::filesystem::path &folder,
                      const std::string &name, const std::vector<double> &times,
                      const std::vector<TimePanel> &panels,
                      const std::string &title);
} // namespace abut::app

#endif
