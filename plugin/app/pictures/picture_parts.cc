// SPDX-License-Identifier: LGPL-2.1-or-later

#include "picture_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace abut::app
{
  const char *palette()
  {
    return "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', "
           "3 '#2c728e', 4 '#21918c', 5 '#28ae80', 6 '#5ec962', 7 '#addc30', "
           "8 '#fde725')\n";
  }

  std::string quoted(const std::string &text)
  {
    std::string result = "'";
    for (const char c : text)
      result += c == '\'' ? "''" : std::string(1, c);
    return result + "'";
  }

  std::pair<double, double> value_range(const std::vector<double> &values)
  {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : values)
      if (!std::isnan(value))
      {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    return {low, high};
  }

  std::string full_title(const std::string &title, const Raster &raster)
  {
    if (std::isnan(raster.z))
      return quoted(title);
    std::ostringstream text;
    text << title << ", plane z = " << raster.z;
    return quoted(text.str());
  }

  namespace
  {
    /** The point with a value that is nearest to (i, j), at most @p reach
     * away in each direction; (i, j) itself if there is none. */
    std::pair<std::size_t, std::size_t>
    nearest_value(const Raster &raster, const std::vector<double> &values,
                  const std::size_t i, const std::size_t j,
                  const std::size_t reach)
    {
      std::pair<std::size_t, std::size_t> best = {i, j};
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t b = j - std::min(j, reach);
           b < std::min(raster.ny, j + reach + 1); ++b)
        for (std::size_t a = i - std::min(i, reach);
             a < std::min(raster.nx, i + reach + 1); ++a)
        {
          const double distance =
              std::hypot(double(a) - double(i), double(b) - double(j));
          if (distance < least && !std::isnan(values[b * raster.nx + a]))
          {
            least = distance;
            best = {a, b};
          }
        }
      return best;
    }
  } // namespace

  std::string grid_block(const std::string &name, const Raster &raster,
                         const std::vector<double> &values,
                         const std::size_t stride, const std::size_t snap)
  {
    const auto indices = [stride](const std::size_t n)
    {
      std::vector<std::size_t> result;
      for (std::size_t i = 0; i < n; i += stride)
        result.push_back(i);
      if (result.back() != n - 1)
        result.push_back(n - 1);
      return result;
    };
    std::ostringstream out;
    out.precision(5);
    out << '$' << name << " << EOD\n";
    for (const std::size_t row : indices(raster.ny))
    {
      for (const std::size_t column : indices(raster.nx))
      {
        const auto [i, j] =
            std::isnan(values[row * raster.nx + column])
                ? nearest_value(raster, values, column, row, snap)
                : std::pair(column, row);
        const double value = values[j * raster.nx + i];
        out << raster.x(i) << ' ' << raster.y(j) << ' ';
        if (std::isnan(value))
          out << "NaN\n";
        else
          out << value << '\n';
      }
      out << '\n';
    }
    out << "EOD\n";
    return out.str();
  }

  std::string ranges(const Raster &raster)
  {
    std::ostringstream out;
    out.precision(12);
    out << "set xrange [" << raster.x_min << ':' << raster.x_max
        << "]\nset yrange [" << raster.y_min << ':' << raster.y_max << "]\n";
    return out.str();
  }

  unsigned int map_height(const Raster &raster, const unsigned int map_width,
                          const unsigned int rest)
  {
    const double aspect =
        (raster.y_max - raster.y_min) / (raster.x_max - raster.x_min);
    return rest
           + static_cast<unsigned int>(map_width
                                       * std::clamp(aspect, 0.15, 1.6));
  }

  double level_step(const double range)
  {
    const double raw = range / 10;
    const double power = std::pow(10., std::floor(std::log10(raw)));
    for (const double digit : {1., 2., 5.})
      if (raw <= digit * power)
        return digit * power;
    return 10 * power;
  }

  namespace
  {
    /** Ticks at 1, 2, 5 times powers of ten, which gnuplot itself does not
     * set on a logarithmic axis of less than two decades; on a shorter one
     * at round steps. */
    std::string logarithmic_ticks(const double low, const double high)
    {
      const double decades = std::log10(high / low);
      if (decades > 2.)
        return "autofreq";
      std::ostringstream ticks;
      ticks.precision(12);
      const auto add = [&](const double tick)
      {
        if (tick >= low && tick <= high)
          ticks << (ticks.tellp() > 0 ? ", " : "(") << tick;
      };
      if (decades > 0.7)
        for (int power = static_cast<int>(std::floor(std::log10(low)));
             std::pow(10., power) <= high; ++power)
          for (const double digit : {1., 2., 5.})
            add(digit * std::pow(10., power));
      else
      {
        const double step = level_step(2. * (high - low));
        for (double tick = std::ceil(low / step); tick * step <= high; ++tick)
          add(tick * step);
      }
      return ticks.str() + ")";
    }

    bool all_whole(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(),
                         [](const double value)
                         { return value == std::round(value); });
    }

    constexpr double axis_margin = 0.04; ///< part of the range
  }                                      // namespace

  std::string fitted_axis(const char axis, std::vector<double> values,
                          const bool logarithmic)
  {
    values.erase(std::remove_if(values.begin(), values.end(),
                                [&](const double value) {
                                  return !std::isfinite(value)
                                         || (logarithmic && value <= 0.);
                                }),
                 values.end());
    if (values.empty())
      return "";
    auto [low, high] = value_range(values);
    std::string ticks = "autofreq";
    if (logarithmic)
    {
      const double factor =
          std::max(std::pow(high / low, axis_margin), 1. + axis_margin);
      low /= factor;
      high *= factor;
      ticks = logarithmic_ticks(low, high);
    }
    else
    {
      const double range = high > low ? high - low : std::max(1., high);
      low -= axis_margin * range;
      high += axis_margin * range;
      if (all_whole(values))
        ticks = std::to_string(std::lround(std::max(1., level_step(range))));
    }
    std::ostringstream script;
    script.precision(12);
    script << (logarithmic ? "set" : "unset") << " logscale " << axis
           << "\nset " << axis << "range [" << low << ':' << high << "]\nset "
           << axis << "tics " << ticks << '\n';
    return script.str();
  }
} // namespace abut::app
