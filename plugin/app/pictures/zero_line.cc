// SPDX-License-Identifier: LGPL-2.1-or-later
#include "zero_line.h"

#include <array>
#include <cmath>
#include <limits>

namespace abut::app
{
  namespace
  {
    struct Corner
    {
      dealii::Point<2> place;
      double value;
    };

    /** Append the piece of the line in a triangle, if there is one. */
    void cut(const std::array<Corner, 3> &corners,
             std::vector<std::vector<double>> &rows)
    {
      std::vector<dealii::Point<2>> ends;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const Corner &a = corners[i], &b = corners[(i + 1) % 3];
        if (std::isnan(a.value) || std::isnan(b.value))
          return;
        if ((a.value < 0.) == (b.value < 0.))
          continue;
        const double t = a.value / (a.value - b.value);
        ends.push_back(a.place + t * (b.place - a.place));
      }
      if (ends.size() != 2)
        return;
      for (const dealii::Point<2> &end : ends)
        rows.push_back({end[0], end[1]});
      rows.push_back({std::numeric_limits<double>::quiet_NaN()});
    }
  } // namespace

  std::vector<std::vector<double>>
  zero_line(const Raster &frame, const std::size_t n,
            const std::function<double(const dealii::Point<2> &)> &value)
  {
    std::vector<Corner> corners;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
      {
        const double s = double(i) / double(n - 1),
                     t = double(j) / double(n - 1);
        const dealii::Point<2> place(
            frame.x_min + s * (frame.x_max - frame.x_min),
            frame.y_min + t * (frame.y_max - frame.y_min));
        corners.push_back({place, value(place)});
      }
    std::vector<std::vector<double>> rows;
    for (std::size_t j = 0; j + 1 < n; ++j)
      for (std::size_t i = 0; i + 1 < n; ++i)
      {
        const Corner *c = &corners[j * n + i];
        cut({{c[0], c[1], c[n + 1]}}, rows);
        cut({{c[0], c[n + 1], c[n]}}, rows);
      }
    return rows;
  }
} // namespace abut::app
