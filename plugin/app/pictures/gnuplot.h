// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_GNUPLOT_H
#define ABUT_APP_GNUPLOT_H

/** @file
 * Pictures by the program gnuplot.
 */

#include "app/report/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** Beginning of every script: SVG of the given size written to
   * `<name>.svg`, one look for all pictures, line styles 1 to 8, grid. */
  std::string gnuplot_header(const std::string &name, unsigned int width = 760,
                             unsigned int height = 480);

  /** An inline data block `$name << EOD` with one line per row; NaN becomes an
   * empty line (a gap in a curve). */
  std::string gnuplot_data(const std::string &name,
                           const std::vector<std::vector<double>> &rows);

  /** Write @p script (begun by gnuplot_header()) to `<folder>/<name>.gp` and
   * run gnuplot on it in that folder. Returns whether the picture was made; a
   * missing or failing gnuplot is a warning of the report, not an error. To be
   * called on rank 0 only or on all ranks; only rank 0 acts. */
  bool draw_picture(Report &report, const std::filesystem::path &folder,
                    const std::string &name, const std::string &script);
} // namespace abut::app

#endif
