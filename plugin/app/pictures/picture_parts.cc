// SPDX-License-Identifier: LGPL-2.1-or-later

#include "picture_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace abut::app
{
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
