// SPDX-License-Identifier: LGPL-2.1-or-later

#include "pictures.h"

#include "gnuplot.h"
#include "picture_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace abut::app
{

  bool draw_solution(Report &report, const std::filesystem::path &folder,
                     const std::string &name, const Raster &raster,
                     const std::size_t field, const std::string &title)
  {
    const std::vector<double> &values = raster.fields.at(field);
    const auto [low, high] = value_range(values);
    if (!(low <= high))
      return false;
    const double range = high > low ? high - low : 1.;
    // The surface and the level lines are drawn as polygons and paths, of
    // which the file must not hold too many; the map is an image.
    const std::size_t longer = std::max(raster.nx, raster.ny);
    const std::size_t surface_stride = std::max<std::size_t>(1, longer / 20);
    const std::size_t lines_stride = std::max<std::size_t>(1, longer / 70);
    const double step = level_step(range);

    std::ostringstream script;
    script << gnuplot_header(name, 960, map_height(raster, 330, 140))
           << grid_block("fine", raster, values, 1)
           << grid_block("coarse", raster, values, surface_stride,
                         surface_stride)
           << grid_block("middle", raster, values, lines_stride) << palette()
           << "set multiplot title " << full_title(title, raster)
           << " font ',16'\n"
           << "unset key\nunset grid\nset format z '%g'\nset format cb '%g'\n"
           << ranges(raster) << "set cbrange [" << low << ':' << low + range
           << "]\n"
           << "set contour base\nset cntrparam levels incremental "
           << std::ceil(low / step) * step << ", " << step << ", " << high
           << "\nunset surface\nset table $lines\nsplot $middle using 1:2:3\n"
           << "unset table\nunset contour\nset surface\n";
    script << "set origin 0, 0\nset size 0.5, 0.95\n"
           << "set view 60, 322, 0.9, 0.9\nset view equal xy\n"
           << "set xyplane at " << low << "\nset border 21 lw 0.6\n"
           << "set pm3d depthorder border lc rgb '#60ffffff' lw 0.2\n"
           << "set zrange [" << low << ':' << low + range << "]\n"
           << "set xtics offset 0, -0.3\nset ytics offset 0, -0.3\n"
           << "set xtics " << level_step(2 * (raster.x_max - raster.x_min))
           << "\nset ytics " << level_step(2 * (raster.y_max - raster.y_min))
           << "\nset ztics " << level_step(2 * range)
           << "\nset xlabel 'x' offset 0, -0.5\nset ylabel 'y' offset 0, "
              "-0.5\nunset colorbox\n"
           << "splot $coarse using 1:2:3 with pm3d\n";
    script << "unset pm3d\nset view noequal\nset zrange [*:*]\nset border 15\n"
           << "set xtics autofreq offset 0, 0\n"
           << "set ytics autofreq offset 0, 0\n"
           << "set xlabel 'x' offset 0, 0\nset ylabel 'y' offset 0, 0\n"
           << "set colorbox\nset size ratio -1\n"
           << "set lmargin at screen 0.57\nset rmargin at screen 0.9\n"
           << "set tmargin at screen 0.88\nset bmargin at screen 0.16\n"
           << "plot $fine using 1:2:3 with image, "
           << "$lines using 1:2 with lines lc rgb '#70ffffff' lw 0.8\n"
           << "unset multiplot\n";
    return draw_picture(report, folder, name, script.str());
  }

  bool draw_status(Report &report, const std::filesystem::path &folder,
                   const std::string &name, const Raster &raster,
                   const std::size_t field,
                   const std::vector<StatusWord> &words,
                   const std::string &title)
  {
    // Dark colours of Okabe and Ito's for what is in contact, pale ones for
    // the first two, which are not.
    static const std::vector<const char *> colours = {
        "#f2f2f2", "#c6dff0", "#d55e00", "#0072b2",
        "#009e73", "#f0e442", "#cc79a7"};
    const std::vector<double> &values = raster.fields.at(field);
    std::vector<double> kinds(values.size(),
                              std::numeric_limits<double>::quiet_NaN());
    std::vector<bool> occurs(words.size(), false);
    for (std::size_t i = 0; i < values.size(); ++i)
      for (std::size_t w = 0; w < words.size(); ++w)
        if (std::lround(values[i]) == words[w].value && !std::isnan(values[i]))
        {
          kinds[i] = double(w);
          occurs[w] = true;
        }

    std::ostringstream script;
    script << gnuplot_header(name, 640, map_height(raster, 500, 130))
           << grid_block("kinds", raster, kinds, 1) << "set title "
           << full_title(title, raster) << " font ',15'\n"
           << ranges(raster)
           << "set size ratio -1\nunset grid\nunset colorbox\n"
           << "set xlabel 'x'\nset ylabel 'y'\n"
           << "set key below horizontal samplen 1.5\nset bmargin 5.5\n"
           << "set cbrange [-0.5:" << double(words.size()) - 0.5
           << "]\nset palette maxcolors " << words.size() << "\n"
           << "set palette defined (";
    for (std::size_t w = 0; w < words.size(); ++w)
      script << (w > 0 ? ", " : "") << double(w) - 0.5 << " '"
             << colours[w % colours.size()] << "', " << double(w) + 0.5 << " '"
             << colours[w % colours.size()] << '\'';
    script << ")\nplot $kinds using 1:2:3 with image notitle";
    for (std::size_t w = 0; w < words.size(); ++w)
      if (occurs[w])
        script << ", NaN with points pt 5 ps 1.6 lc rgb '"
               << colours[w % colours.size()] << "' title "
               << quoted(words[w].word);
    script << '\n';
    return draw_picture(report, folder, name, script.str());
  }

  namespace
  {
    /** The points that a logarithmic picture can show. */
    std::vector<std::pair<double, double>> shown(const Curve &curve)
    {
      std::vector<std::pair<double, double>> points;
      for (const auto &point : curve.points)
        if (point.first > 0 && point.second > 0 && std::isfinite(point.second))
          points.push_back(point);
      return points;
    }

    /** Slope of the last half of a curve (at least two points) by least
     * squares in logarithms, as " (slope -0.50)". */
    std::string slope_text(const std::vector<std::pair<double, double>> &points)
    {
      const std::size_t n = points.size() / 2 + 1;
      const bool is_level =
          std::all_of(points.begin(), points.end(),
                      [&](const auto &point)
                      { return point.second == points.front().second; });
      if (points.size() < 3 || is_level)
        return "";
      double sx = 0;
      double sy = 0;
      double sxx = 0;
      double sxy = 0;
      for (std::size_t i = points.size() - n; i < points.size(); ++i)
      {
        const double x = std::log(points[i].first);
        const double y = std::log(points[i].second);
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
      }
      const double m = double(n);
      const double below = m * sxx - sx * sx;
      if (!(below > 0))
        return "";
      std::ostringstream text;
      text.precision(2);
      text << std::fixed << " (slope " << (m * sxy - sx * sy) / below << ')';
      return text.str();
    }

    std::string curves(const std::vector<Curve> &all, const std::string &prefix,
                       const bool slopes, std::ostringstream &blocks)
    {
      std::string plot;
      std::size_t number = 0;
      for (const Curve &curve : all)
      {
        const auto points = shown(curve);
        if (points.empty())
          continue;
        ++number;
        std::vector<std::vector<double>> rows;
        for (const auto &point : points)
          rows.push_back({point.first, point.second});
        const std::string block = prefix + std::to_string(number);
        blocks << gnuplot_data(block, rows);
        plot += (plot.empty() ? "plot $" : ", $") + block
                + " using 1:2 with linespoints ls "
                + std::to_string((number - 1) % 8 + 1) + " title "
                + quoted(curve.label + (slopes ? slope_text(points) : ""));
      }
      return plot;
    }
  } // namespace

  bool draw_convergence(Report &report, const std::filesystem::path &folder,
                        const std::string &name,
                        const std::vector<Curve> &errors,
                        const std::vector<Curve> &counts,
                        const std::string &title)
  {
    std::ostringstream blocks;
    const std::string above = curves(errors, "error", true, blocks);
    const std::string below = curves(counts, "count", false, blocks);
    const unsigned int n_plots =
        (above.empty() ? 0U : 1U) + (below.empty() ? 0U : 1U);
    if (n_plots == 0)
      return false;

    std::vector<double> unknowns, values, numbers = {0.};
    for (const Curve &curve : errors)
      for (const auto &[x, y] : shown(curve))
      {
        unknowns.push_back(x);
        values.push_back(y);
      }
    for (const Curve &curve : counts)
      for (const auto &[x, y] : shown(curve))
      {
        unknowns.push_back(x);
        numbers.push_back(y);
      }

    std::ostringstream script;
    script << gnuplot_header(name, 760, 100 + 340 * n_plots) << blocks.str()
           << "set multiplot layout " << n_plots << ",1 title " << quoted(title)
           << " font ',15'\n"
           << "set lmargin 11\nset rmargin 3\nset format '%g'\n"
           << fitted_axis('x', unknowns, true)
           // Above the curves, where it hides no point.
           << "set key tmargin center vertical maxrows 3 Left reverse\n";
    if (!above.empty())
      script << fitted_axis('y', values, true) << "set ylabel 'error'\n"
             << (below.empty() ? "set xlabel 'degrees of freedom'\n" : "")
             << above << '\n';
    if (!below.empty())
      script << fitted_axis('y', numbers, false)
             << "set ylabel 'number'\nset xlabel 'degrees of freedom'\n"
             << below << '\n';
    script << "unset multiplot\n";
    return draw_picture(report, folder, name, script.str());
  }
} // namespace abut::app
