// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SEARCH_SWEEP_H
#define ABUT_APP_SEARCH_SWEEP_H

/** @file
 * The search's time over the size of its buckets, for all algorithms.
 */

#include "app/report/report.h"

#include <abut/search.h>

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace abut::app
{
  /** Section `Sweep`. */
  struct SweepParameters
  {
    std::vector<double> bucket_sizes;
    unsigned int repeats = 5;
    double most_tests = 0;

    static void declare(dealii::ParameterHandler &prm);
    void parse(dealii::ParameterHandler &prm);
  };

  /** One search of the sweep; times are those of the processor. */
  struct SweepPoint
  {
    abut_search_algorithm algorithm;
    /** As asked for; 0: chosen from the data. */
    double bucket_size;
    /** In use, as a multiple of the median facet size; all pairs: 0. */
    double bucket_in_use;
    double build_seconds; /**< sorting the facets, in the fastest repeat */
    double query_seconds; /**< finding the candidates of all nodes, then */
    abut_search_statistics statistics;
  };

  /** Search the nodes of @p secondary near the facets of @p primary with each
   * algorithm and bucket size, a new search each time; all pairs are left out
   * where they would look at more than `Most tests` facets. Throws
   * std::logic_error should two sets of pairs differ.
   * @param options reach and all else that does not vary
   * @param measured is called with each point */
  std::vector<SweepPoint>
  run_sweep(abut_context *context, abut_surface *secondary,
            abut_surface *primary, const abut_search_options &options,
            const SweepParameters &parameters,
            const std::function<void(const SweepPoint &)> &measured);

  /** Sizes of the surfaces that are searched. */
  struct SweepHeading
  {
    double n_nodes = 0;
    double n_facets = 0;
  };

  /** `sweep.csv`, a row for each point. */
  void write_sweep(const std::filesystem::path &folder,
                   const std::vector<SweepPoint> &points,
                   const SweepHeading &heading);

  /** The head of the table on the console. */
  void print_sweep_head(Report &report);

  /** A line of it. */
  void print_sweep_point(Report &report, const SweepPoint &point,
                         const SweepHeading &heading);
} // namespace abut::app

#endif
