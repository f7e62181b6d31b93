// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PICTURE_PARTS_H
#define ABUT_APP_PICTURE_PARTS_H

/** @file
 * Pieces of gnuplot scripts that several pictures share.
 */

#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** Text as gnuplot reads it literally. */
  std::string quoted(const std::string &text);

  /** Smallest and largest value that is a number; (inf, -inf) if none is. */
  std::pair<double, double> value_range(const std::vector<double> &values);

  /** Gap between level lines: a tenth of the range, rounded up to 1, 2, 5
   * times a power of ten. */
  double level_step(double range);

  /** Commands for the axis 'x' or 'y' of points with these @p values, so that
   * they take all of it: range, ticks, and a logarithmic scale if it is to be
   * one. Values that are whole numbers get whole ticks. Values that the scale
   * cannot show do not count; nothing is set if none is left. */
  std::string fitted_axis(char axis, std::vector<double> values,
                          bool logarithmic);
} // namespace abut::app

#endif
