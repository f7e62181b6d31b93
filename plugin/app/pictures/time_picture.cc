// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time_picture.h"

#include "gnuplot.h"

#include <algorithm>
#include <sstream>

namespace abut::app
{
  namespace
  {
    /** More points than pixels only make the file large. */
    constexpr std::size_t most_points = 2000;

    bool is_flat(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(),
                         [](const double value) { return value == 0.; });
    }

    /** Plot command of a panel, empty if it has no curves; data come into
     * @p blocks. */
    std::string plot_of(const TimePanel &panel,
                        const std::vector<double> &times,
                        const std::size_t number, std::ostringstream &blocks)
    {
      std::string command;
      unsigned int style = 0;
      for (const auto &[label, values] : panel.curves)
      {
        if (is_flat(values))
          continue;
        ++style;
        std::vector<std::vector<double>> rows;
        const std::size_t stride = 1 + times.size() / most_points;
        for (std::size_t i = 0; i < times.size(); i += stride)
          rows.push_back({times[i], values[i]});
        const std::string block =
            "panel" + std::to_string(number) + "_" + std::to_string(style);
        blocks << gnuplot_data(block, rows);
        command += (command.empty() ? "plot $" : ", $") + block
                   + " using 1:2 with lines linestyle "
                   + std::to_string(1 + (style - 1) % 8) + " title '" + label
                   + "'";
      }
      return command;
    }
  } // namespace

  bool draw_over_time(Report &report, const std::filesystem::path &folder,
                      const std::string &name, const std::vector<double> &times,
                      const std::vector<TimePanel> &panels,
                      const std::string &title)
  {
    std::ostringstream blocks, plots;
    unsigned int n = 0;
    for (const TimePanel &panel : panels)
    {
      const std::string plot = plot_of(panel, times, n, blocks);
      if (plot.empty())
        continue;
      ++n;
      plots << "set ylabel '" << panel.label << "'\n" << plot << '\n';
    }
    if (n == 0)
      return false;
    std::ostringstream script;
    script << gnuplot_header(name, 760, 100 + 300 * n) << blocks.str()
           << "set multiplot layout " << n << ",1 title '" << title
           << "' font ',15'\n"
           << "set lmargin 11\nset rmargin 3\nset format '%g'\n"
           << "set key tmargin center horizontal\nset xlabel 'time'\n"
           << plots.str() << "unset multiplot\n";
    return draw_picture(report, folder, name, script.str());
  }
} // namespace abut::app
