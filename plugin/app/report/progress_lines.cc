// SPDX-License-Identifier: LGPL-2.1-or-later
#include "progress_lines.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace abut::app
{
  namespace
  {
    /** Seconds below which no time left is printed, and the part of a run from
     * which on it is known. */
    constexpr double short_time = 5., least_part = 0.02;

    /** 0: not a terminal, or the one that mpirun puts between a rank and its
     * own output, which may be a file. */
    std::size_t columns_of_terminal()
    {
      winsize size = {};
      return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
    }

    std::string after(const double seconds)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%8.2f s  ", seconds);
      return text;
    }

    std::string duration(const double seconds)
    {
      const bool is_long = seconds >= 5400.;
      const double unit = seconds < 90. ? 1. : is_long ? 3600. : 60.;
      char text[32];
      std::snprintf(text, sizeof(text), "%.*f %s", is_long ? 1 : 0,
                    seconds / unit,
                    unit == 1. ? "s"
                    : is_long  ? "h"
                               : "min");
      return text;
    }

    std::string time_left(const double seconds,
                          const std::optional<double> done)
    {
      if (!done || *done < least_part)
        return "";
      const double left = seconds * (1. - *done) / *done;
      return left < short_time ? "" : ", about " + duration(left) + " left";
    }
  } // namespace

  ProgressLines::ProgressLines(const bool all)
      : all(all), terminal(!all && columns_of_terminal() > 0)
  {
  }

  bool ProgressLines::is_wanted(const std::optional<double> done)
  {
    ++n_steps;
    const bool is_power_of_4 =
        (n_steps & (n_steps - 1)) == 0 && (n_steps & 0x55555555u) != 0;
    if (!done)
      return n_steps == 2 || is_power_of_4;
    const auto fifths = static_cast<unsigned int>(5. * *done * (1. + 1e-12));
    const bool is_next = fifths > n_fifths;
    n_fifths = fifths;
    return is_next || n_steps == 1;
  }

  void ProgressLines::write(const std::string &text)
  {
    end_line();
    std::cout << text << "\n" << std::flush;
    ++n;
  }

  void ProgressLines::overwrite(const std::string &text)
  {
    // To the first column, and from the end of the text nothing.
    const std::size_t columns = std::max<std::size_t>(columns_of_terminal(), 2);
    std::cout << "\r" << text.substr(0, columns - 1) << "\033[K" << std::flush;
    is_open = true;
  }

  void ProgressLines::step(const std::string &line, const double seconds,
                           const std::optional<double> done)
  {
    const std::string text = after(seconds) + line + time_left(seconds, done);
    if (all)
      write(text);
    else if (terminal)
      overwrite(text);
    else if (is_wanted(done))
    {
      left_out.clear();
      write(text);
    }
    else
      left_out = text;
  }

  void ProgressLines::detail(const std::string &line, const double seconds)
  {
    if (all)
      write(after(seconds) + line);
    else if (terminal)
      overwrite(after(seconds) + line);
  }

  void ProgressLines::print(const std::string &line)
  {
    write(line);
  }

  void ProgressLines::interrupt()
  {
    end_line();
    ++n;
  }

  void ProgressLines::end_line()
  {
    if (is_open)
    {
      std::cout << "\n" << std::flush;
      ++n;
    }
    is_open = false;
  }

  void ProgressLines::finish()
  {
    end_line();
    if (!left_out.empty())
      write(left_out);
    left_out.clear();
  }
} // namespace abut::app
