// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PICTURES_H
#define ABUT_APP_PICTURES_H

/** @file
 * The pictures of a scalar scene: solution, active set, convergence.
 */

#include "app/report/report.h"
#include "raster.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** `<name>.svg`: field number @p field of @p raster as a surface seen from
   * the side and as a colour map with level lines. Rank 0 acts; returns whether
   * the picture was made, as all functions here. */
  bool draw_solution(Report &report, const std::filesystem::path &folder,
                     const std::string &name, const Raster &raster,
                     std::size_t field, const std::string &title);

  /** A value of a status field and what it means. */
  struct StatusWord
  {
    int value;
    std::string word;
  };

  /** `<name>.svg`: map of a status field, one flat colour per value, with a
   * legend of the values that occur. The first two words get pale colours: for
   * what is not in contact. */
  bool draw_status(Report &report, const std::filesystem::path &folder,
                   const std::string &name, const Raster &raster,
                   std::size_t field, const std::vector<StatusWord> &words,
                   const std::string &title);

  /** A curve of the convergence picture. */
  struct Curve
  {
    std::string label;
    /** Degrees of freedom and value; values <= 0 or NaN are left out. */
    std::vector<std::pair<double, double>> points;
  };

  /** `<name>.svg`: above, errors over degrees of freedom, double logarithmic,
   * each labelled with the slope of its last half; below, numbers such as
   * active-set steps over degrees of freedom. Either list may be empty. */
  bool draw_convergence(Report &report, const std::filesystem::path &folder,
                        const std::string &name,
                        const std::vector<Curve> &errors,
                        const std::vector<Curve> &counts,
                        const std::string &title);
} // namespace abut::app

#endif
