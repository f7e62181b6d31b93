// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ZERO_LINE_H
#define ABUT_APP_ZERO_LINE_H

#include "raster.h"

#include <deal.II/base/point.h>

#include <functional>
#include <vector>

namespace abut::app
{
  /** Where a function is zero in the frame of @p frame, as pieces of lines for
   * gnuplot_data(): two points each, then a row that is not a number. It is
   * linear on the triangles between @p n points along each side; triangles with
   * a corner without a value are left out. */
  std::vector<std::vector<double>>
  zero_line(const Raster &frame, std::size_t n,
            const std::function<double(const dealii::Point<2> &)> &value);
} // namespace abut::app

#endif
