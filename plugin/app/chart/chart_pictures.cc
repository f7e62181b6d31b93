// SPDX-License-Identifier: LGPL-2.1-or-later
#include "chart_output.h"

#include "app/pictures/gnuplot.h"
#include "app/pictures/picture_parts.h"

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>

namespace abut::app
{
  namespace
  {
    using Points = std::vector<std::vector<double>>;

    /** One picture: what is drawn over what. */
    struct Axes
    {
      std::string name;
      double ChartRow::*x;
      double ChartRow::*y;
      std::string x_label, y_label;
      bool ChartRow::*front = nullptr;
    };

    constexpr int n_line_types = 8;

    constexpr unsigned int width = 900, height = 500; // of a picture

    const std::string front_label = "front: nothing is better";

    std::string time_label(const ChartFile &chart)
    {
      if (chart.time == "processor_seconds")
        return "processor time, seconds";
      return chart.time == "wall_seconds" ? "time, seconds" : chart.time;
    }

    std::string error_label(const ChartFile &chart)
    {
      const ChartError &error = chart.error;
      if (!error.label.empty())
        return error.label;
      if (error.is_error())
        return error.quantity + (error.scale > 0 ? ", relative" : "");
      return "relative error of " + error.quantity;
    }

    std::set<std::string> axis_names(const ChartFile &chart)
    {
      std::set<std::string> names;
      for (const ChartCurve &curve : chart.curves)
        names.insert(axis_name(curve));
      return names;
    }

    std::string axis_label(const ChartFile &chart)
    {
      if (!chart.axis_label.empty())
        return chart.axis_label;
      if (!chart.axis_quantity.empty())
        return chart.axis_quantity;
      const std::set<std::string> names = axis_names(chart);
      return names.size() == 1 ? *names.begin() : "parameter";
    }

    /** Points of a curve in the order of the runs; those that a picture on
     * logarithmic scales cannot show, or without a result, are gaps. */
    Points points_of(const Axes &axes, const std::vector<ChartRow> &rows,
                     const std::function<bool(const ChartRow &)> &wanted)
    {
      Points points;
      for (const ChartRow &row : rows)
        if (wanted(row))
        {
          const bool shown = row.ok() && row.*axes.y > 0;
          points.push_back(
              {row.*axes.x, shown ? row.*axes.y : ChartRow::unknown});
        }
      return points;
    }

    /** Whether the values of an axis are all positive and differ by more than
     * @p factor. */
    bool is_wide(const std::vector<ChartRow> &rows, double ChartRow::*x,
                 const double factor)
    {
      double smallest = 1e300, largest = 0;
      for (const ChartRow &row : rows)
        if (!std::isnan(row.*x))
        {
          smallest = std::min(smallest, row.*x);
          largest = std::max(largest, row.*x);
        }
      return smallest > 0 && largest > factor * smallest;
    }

    /** The steps below which no run lies, and rings on the runs of the
     * front. */
    void add_front(const Axes &axes, const std::vector<ChartRow> &rows,
                   std::ostringstream &data, std::string &below,
                   std::string &above)
    {
      Points front = points_of(
          axes, rows, [&](const ChartRow &row) { return row.*axes.front; });
      std::sort(front.begin(), front.end());
      if (front.empty())
        return;
      data << gnuplot_data("front", front);
      below = "$front using 1:2 with steps lw 7 lc rgb '#dcdcdc' title "
              + quoted(front_label) + ", ";
      above = ", $front using 1:2 with points pt 6 ps 1.7 lw 1.6 lc rgb "
              "'#000000' notitle";
    }

    /** Put the legend beside the curves, and leave it no more room than its
     * longest label needs: gnuplot guesses too wide a font. */
    std::string legend_beside(const std::vector<double> &label_lengths,
                              const bool with_front)
    {
      double longest = with_front ? double(front_label.size()) : 0.;
      for (const double length : label_lengths)
        longest = std::max(longest, length);
      const double letter = 8., sample = 75.;
      const double share =
          std::min(0.5, (sample + letter * longest) / double(width));
      std::ostringstream script;
      script << "set rmargin at screen " << 1. - share << "\nset key at screen "
             << 1.01 - share
             << ", graph 1 left top vertical Left reverse noenhanced\n";
      return script.str();
    }

    void draw(Report &report, const std::filesystem::path &folder,
              const ChartFile &chart, const std::vector<ChartRow> &rows,
              const Axes &axes)
    {
      std::ostringstream data;
      std::string below, above, curves;
      std::vector<double> xs, ys, label_lengths;
      if (axes.front != nullptr)
        add_front(axes, rows, data, below, above);
      const bool many_axes = axis_names(chart).size() > 1;
      for (std::size_t c = 0; c < chart.curves.size(); ++c)
      {
        const Points points = points_of(
            axes, rows, [c](const ChartRow &row) { return row.curve == c; });
        const bool empty =
            std::none_of(points.begin(), points.end(),
                         [](const std::vector<double> &point)
                         { return std::isfinite(point[0] + point[1]); });
        if (empty)
          continue;
        const std::string name = "curve" + std::to_string(c);
        data << gnuplot_data(name, points);
        for (const std::vector<double> &point : points)
          if (std::isfinite(point[0] + point[1]))
          {
            xs.push_back(point[0]);
            ys.push_back(point[1]);
          }
        const ChartCurve &curve = chart.curves[c];
        const bool with_axis =
            many_axes && axes.x == &ChartRow::x && chart.axis_quantity.empty();
        const std::string label =
            curve.name + (with_axis ? " (" + axis_name(curve) + ")" : "");
        label_lengths.push_back(double(label.size()));
        curves += (curves.empty() ? "$" : ", $") + name
                  + " using 1:2 with linespoints lt "
                  + std::to_string(1 + c % n_line_types) + " dt "
                  + std::to_string(1 + c / n_line_types) + " title "
                  + quoted(label);
      }
      if (curves.empty())
      {
        report.warn("picture " + axes.name + " not made: no run has both "
                    + axes.x_label + " and " + axes.y_label + ".");
        return;
      }
      std::ostringstream script;
      script << gnuplot_header(axes.name, width, height) << data.str()
             << "set title " << quoted(chart.title) << " noenhanced\n"
             << "set format '%g'\n"
             << fitted_axis('x', xs, is_wide(rows, axes.x, 20.))
             << fitted_axis('y', ys, true)
             << (is_wide(rows, axes.x, 1e6) ? "set format x '10^{%T}'\n" : "")
             << "set xlabel " << quoted(axes.x_label) << " noenhanced\n"
             << "set ylabel " << quoted(axes.y_label) << " noenhanced\n"
             << legend_beside(label_lengths, axes.front != nullptr) << "plot "
             << below << curves << above << '\n';
      draw_picture(report, folder, axes.name, script.str());
    }
  } // namespace

  void draw_chart(Report &report, const std::filesystem::path &folder,
                  const ChartFile &chart, const std::vector<ChartRow> &rows)
  {
    const std::string error = error_label(chart), time = time_label(chart),
                      axis = axis_label(chart);
    const Axes all[] = {
        {"error-time", &ChartRow::time, &ChartRow::error, time, error,
         &ChartRow::time_front},
        {"error-work", &ChartRow::matvecs, &ChartRow::error,
         "matrix-vector products, on all meshes", error, &ChartRow::work_front},
        {"error-axis", &ChartRow::x, &ChartRow::error, axis, error},
        {"time-axis", &ChartRow::x, &ChartRow::time, axis, time},
        {"memory-axis", &ChartRow::x, &ChartRow::peak_memory_mb, axis,
         "peak memory of the process, MiB"}};
    for (const Axes &axes : all)
      if (chart.pictures.count(axes.name) > 0)
        draw(report, folder, chart, rows, axes);
  }
} // namespace abut::app
