// SPDX-License-Identifier: LGPL-2.1-or-later
#include "app/input/short_number.h"
#include "app/restart/disk.h"
#include "search_sweep.h"

#include <algorithm>
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
    report.progress("search by algorithm        bucket size   in use   ns per "
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
    report.progress(line.str());
  }
} // namespace abut::app
