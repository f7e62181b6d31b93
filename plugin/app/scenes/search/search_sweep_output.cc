// SPDX-License-Identifier: LGPL-2.1-or-later
#include "app/input/short_number.h"
#include "app/pictures/gnuplot.h"
#include "app/restart/disk.h"
#include "search_sweep.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

namespace abut::app
{
  namespace
  {
    double per_node(const SweepPoint &point, const SweepHeading &heading)
    {
      return heading.n_nodes > 0
                 ? 1e9 * (point.build_seconds + point.query_seconds)
                       / heading.n_nodes
                 : 0;
    }

    bool is_automatic(const SweepPoint &point)
    {
      return point.algorithm != ABUT_SEARCH_ALL_PAIRS && point.bucket_size == 0;
    }

    /** Points of one algorithm with a bucket size: {bucket size, ns}. */
    std::vector<std::vector<double>>
    curve(const std::vector<SweepPoint> &points,
          const abut_search_algorithm algorithm, const bool automatic,
          const SweepHeading &heading)
    {
      std::vector<std::vector<double>> rows;
      for (const SweepPoint &point : points)
        if (point.algorithm == algorithm && is_automatic(point) == automatic)
          rows.push_back({automatic ? point.bucket_in_use : point.bucket_size,
                          per_node(point, heading)});
      return rows;
    }

    /** Smallest and largest bucket size of the picture, then smallest and
     * largest time. */
    std::array<double, 4> ranges(const std::vector<SweepPoint> &points,
                                 const SweepHeading &heading)
    {
      std::array<double, 4> r = {{1e300, 0, 1e300, 0}};
      for (const SweepPoint &point : points)
      {
        const double size =
            is_automatic(point) ? point.bucket_in_use : point.bucket_size;
        const double time = per_node(point, heading);
        r = {{size > 0 ? std::min(r[0], size) : r[0], std::max(r[1], size),
              std::min(r[2], time), std::max(r[3], time)}};
      }
      return {{r[0] / 1.3, r[1] * 1.3, r[2] / 1.6, r[3] * 1.6}};
    }

    std::string escaped(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += c == '\'' ? std::string("''") : std::string(1, c);
      return result;
    }

    std::string thousands(const double number)
    {
      std::string digits = short_number(number, 15);
      for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3)
        digits.insert(static_cast<std::size_t>(i), " ");
      return digits;
    }
  } // namespace

  void write_sweep(const std::filesystem::path &folder,
                   const std::vector<SweepPoint> &points,
                   const SweepHeading &heading)
  {
    std::ostringstream out;
    out << "algorithm,bucket_size,automatic,bucket_in_use,raised,ns_per_node,"
           "build_ns_per_facet,query_ns_per_node,structure_bytes_per_facet,"
           "buckets,capacity,tests_per_node,candidates\n"
        << std::setprecision(10);
    const double facets = std::max(heading.n_facets, 1.);
    const double nodes = std::max(heading.n_nodes, 1.);
    for (const SweepPoint &point : points)
    {
      const abut_search_statistics &s = point.statistics;
      out << abut_search_name(point.algorithm) << ',' << point.bucket_size
          << ',' << (is_automatic(point) ? 1 : 0) << ',' << point.bucket_in_use
          << ',' << (s.bucket_raised != 0 ? 1 : 0) << ','
          << per_node(point, heading) << ','
          << 1e9 * point.build_seconds / facets << ','
          << 1e9 * point.query_seconds / nodes << ','
          << double(s.structure_bytes) / facets << ',' << s.n_buckets << ','
          << s.capacity << ','
          << double(s.n_block_tests + s.n_box_tests) / nodes << ',' << s.n_pairs
          << '\n';
    }
    write_file(folder / "sweep.csv", out.str());
  }

  void print_sweep_head(Report &report)
  {
    report.detail("search by algorithm        bucket size   in use   ns per "
                  "node  bytes per facet");
  }

  void print_sweep_point(Report &report, const SweepPoint &point,
                         const SweepHeading &heading)
  {
    const bool raised = point.statistics.bucket_raised != 0;
    std::ostringstream line;
    line << "  " << std::left << std::setw(24)
         << abut_search_name(point.algorithm) << std::right << std::setw(12)
         << (point.algorithm == ABUT_SEARCH_ALL_PAIRS ? "-"
             : is_automatic(point)                    ? "automatic"
                                   : short_number(point.bucket_size, 4))
         << std::setw(9)
         << (point.bucket_in_use > 0 ? short_number(point.bucket_in_use, 3)
                                     : "-")
         << std::setw(12) << short_number(per_node(point, heading), 4)
         << std::setw(17)
         << short_number(double(point.statistics.structure_bytes)
                             / std::max(heading.n_facets, 1.),
                         3)
         << (raised ? "  raised to the search radius" : "");
    report.detail(line.str());
  }

  bool draw_sweep(Report &report, const std::filesystem::path &folder,
                  const std::vector<SweepPoint> &points,
                  const SweepHeading &heading)
  {
    if (points.empty())
      return false;
    const auto [low, high, fastest, slowest] = ranges(points, heading);
    if (!(low < high && fastest < slowest))
      return false;
    std::ostringstream script, plot;
    script << gnuplot_header("search", 760, 480);
    plot << "plot ";
    const char *separator = "";
    for (int a = ABUT_SEARCH_N_ALGORITHMS - 1; a >= 0; --a)
    {
      const auto algorithm = static_cast<abut_search_algorithm>(a);
      auto rows = curve(points, algorithm, false, heading);
      const auto chosen = curve(points, algorithm, true, heading);
      if (algorithm == ABUT_SEARCH_ALL_PAIRS && !rows.empty())
        rows = {{low, rows[0][1]}, {high, rows[0][1]}};
      const std::string name = "curve" + std::to_string(a);
      const std::string style = std::to_string(ABUT_SEARCH_N_ALGORITHMS - a);
      if (!rows.empty())
      {
        script << gnuplot_data(name, rows);
        plot << separator << '$' << name << " using 1:2 with "
             << (algorithm == ABUT_SEARCH_ALL_PAIRS ? "lines" : "linespoints")
             << " lt " << style << " title '" << abut_search_name(algorithm)
             << '\'';
        separator = ", ";
      }
      if (!chosen.empty())
      {
        script << gnuplot_data("chosen" + std::to_string(a), chosen);
        plot << separator << "$chosen" << a
             << " using 1:2 with points pt 6 ps 1.8 lw 2.5 lc "
                "rgb '#000000' notitle, $chosen"
             << a
             << " using 1:2:(sprintf('%.0f ns', $2)) with labels boxed offset "
                "0,1.1 "
                "notitle";
        separator = ", ";
      }
    }
    plot << separator
         << "NaN with points pt 6 ps 1.8 lw 2.5 lc rgb '#000000' title "
            "'automatic choice'\n";
    script << "set title '" << escaped(heading.title)
           << (heading.title.empty() ? "" : ": ") << thousands(heading.n_nodes)
           << " nodes, " << thousands(heading.n_facets)
           << " facets' font ',15'\n"
           << "set logscale xy\nset xrange [" << low << ':' << high
           << "]\nset yrange [" << fastest << ':' << slowest << "]\n"
           << "set xlabel 'bucket size / median facet size'\n"
           << "set ylabel 'time to find all candidates, ns per node'\n"
           << "set key outside top center horizontal\n"
           << plot.str();
    return draw_picture(report, folder, "search", script.str());
  }
} // namespace abut::app
