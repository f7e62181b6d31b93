// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PICTURE_PARTS_H
#define ABUT_APP_PICTURE_PARTS_H

/** @file
 * Pieces of gnuplot scripts that several pictures share.
 */

#include "raster.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** Command that sets the colours of a field: viridis, evenly bright steps
   * that every kind of colour vision tells apart, and that survive a grey
   * print. */
  const char *palette();

  /** Text as gnuplot reads it literally. */
  std::string quoted(const std::string &text);

  /** Smallest and largest value that is a number; (inf, -inf) if none is. */
  std::pair<double, double> value_range(const std::vector<double> &values);

  /** The title, and in 3D the plane that is shown, quoted. */
  std::string full_title(const std::string &title, const Raster &raster);

  /** Data block of lines "x y value", an empty line after each row; every
   * @p stride -th point, the outermost included. A point outside the mesh
   * moves to its border if that is nearer than @p snap points. */
  std::string grid_block(const std::string &name, const Raster &raster,
                         const std::vector<double> &values, std::size_t stride,
                         std::size_t snap = 0);

  /** Commands that set the ranges of both axes to the raster's. */
  std::string ranges(const Raster &raster);

  /** Picture height for a map of the raster's aspect in a given width. */
  unsigned int map_height(const Raster &raster, unsigned int map_width,
                          unsigned int rest);

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
