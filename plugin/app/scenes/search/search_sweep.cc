// SPDX-License-Identifier: LGPL-2.1-or-later
#include "search_sweep.h"

#include "app/input/input_error.h"
#include "app/input/parameters.h"
#include "app/report/processor_time.h"
#include "shim/handles.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    /** The pairs of a search, to be compared with those of the others. */
    struct Pairs
    {
      std::vector<std::int64_t> start;
      std::vector<std::int32_t> facet;

      bool operator==(const Pairs &other) const
      {
        return start == other.start && facet == other.facet;
      }
    };

    Pairs copy(const abut_context *context, const abut_pairs *pairs)
    {
      abut_pairs_view view;
      shim::check(context, abut_pairs_get(pairs, &view));
      Pairs result;
      result.start.assign(view.start, view.start + view.n_queries + 1);
      result.facet.assign(view.facet, view.facet + view.start[view.n_queries]);
      return result;
    }

    /** Edge of the bucket in use by the median facet size. An adaptive bucket
     * is a patch of as many facets as it holds. */
    double bucket_in_use(const abut_search_statistics &statistics,
                         const abut_search_algorithm algorithm,
                         const std::int32_t dimension, const double median_size)
    {
      if (algorithm == ABUT_SEARCH_UNIFORM_BUCKETS && median_size > 0)
        return statistics.bucket_edge / median_size;
      if (algorithm == ABUT_SEARCH_ADAPTIVE_BUCKETS)
        return std::pow(double(statistics.capacity), 1. / (dimension - 1));
      return 0;
    }

    class Sweep
    {
    public:
      Sweep(abut_context *context, abut_surface *secondary,
            abut_surface *primary, const abut_search_options &options,
            const SweepParameters &parameters)
          : context(context),
            secondary(secondary),
            primary(primary),
            options(options),
            parameters(parameters)
      {
        abut_surface_view view;
        shim::check(context, abut_surface_get(secondary, &view));
        n_nodes = view.n_nodes;
        shim::check(context, abut_surface_get(primary, &view));
        n_facets = view.n_facets;
        dimension = view.dimension;
        abut_surface_sizes sizes;
        shim::check(context, abut_surface_measure(primary, &sizes));
        median_size = sizes.median;
      }

      std::vector<SweepPoint>
      run(const std::function<void(const SweepPoint &)> &measured)
      {
        for (int a = 0; a < ABUT_SEARCH_N_ALGORITHMS; ++a)
        {
          const auto algorithm = static_cast<abut_search_algorithm>(a);
          const bool has_buckets = algorithm != ABUT_SEARCH_ALL_PAIRS;
          if (!has_buckets
              && double(n_nodes) * double(n_facets) > parameters.most_tests)
            continue;
          std::vector<double> sizes = {0};
          if (has_buckets)
            sizes.insert(sizes.end(), parameters.bucket_sizes.begin(),
                         parameters.bucket_sizes.end());
          for (const double size : sizes)
          {
            add(algorithm, size);
            measured(points.back());
          }
        }
        return points;
      }

    private:
      void add(const abut_search_algorithm algorithm, const double bucket_size)
      {
        options.algorithm = algorithm;
        options.bucket_size = bucket_size;
        options.capacity = 0;
        SweepPoint point = {algorithm, bucket_size, 0, 0, 0, {}};
        const double begin = processor_seconds();
        for (unsigned int i = 0; i < parameters.repeats
                                 && (i == 0 || processor_seconds() - begin < 1);
             ++i)
          measure(i == 0, point);
        point.bucket_in_use =
            bucket_in_use(point.statistics, algorithm, dimension, median_size);
        points.push_back(point);
      }

      /** One search; keeps the fastest. */
      void measure(const bool first, SweepPoint &point)
      {
        const double start = processor_seconds();
        const auto search = shim::create_search(context, primary, options);
        shim::check(context, abut_search_update(search.get()));
        const double build = processor_seconds() - start;
        const auto pairs = shim::create_pairs(context);
        const double built = processor_seconds();
        shim::check(context,
                    abut_search_nodes(search.get(), secondary, pairs.get()));
        const double query = processor_seconds() - built;
        if (first || build + query < point.build_seconds + point.query_seconds)
        {
          point.build_seconds = build;
          point.query_seconds = query;
        }
        if (!first)
          return;
        shim::check(context, abut_search_get_statistics(search.get(),
                                                        &point.statistics));
        compare(copy(context, pairs.get()), point.algorithm);
      }

      void compare(const Pairs &found, const abut_search_algorithm algorithm)
      {
        if (points.empty())
          reference = found;
        else if (!(found == reference))
          throw std::logic_error(std::string("the searches by ")
                                 + abut_search_name(algorithm) + " and "
                                 + abut_search_name(points.front().algorithm)
                                 + " found different pairs");
      }

      abut_context *const context;
      abut_surface *const secondary;
      abut_surface *const primary;
      abut_search_options options;
      const SweepParameters &parameters;
      std::int64_t n_nodes = 0, n_facets = 0;
      std::int32_t dimension = 0;
      double median_size = 0;
      std::vector<SweepPoint> points;
      Pairs reference;
    };
  } // namespace

  void SweepParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Sweep");
    parameter::declare(
        prm, "Bucket sizes", "0.5, 1, 2, 4, 8, 16, 32", TextPattern::numbers(),
        parameter::advanced("median facet size", "0.5, 1, 2"),
        "Bucket sizes for which the time of the search is measured, with each "
        "algorithm and in addition to the automatic choice. Empty: no sweep.");
    parameter::declare(prm, "Repeats", "5", Integer(1),
                       parameter::advanced("1", "10"),
                       "Measurements of processor time, of which the fastest "
                       "counts. Fewer if they take longer than a second.");
    parameter::declare(prm, "Maximum tests", "3e8", NumberPattern::from(0),
                       parameter::expert("1", "1e7"),
                       "Product of nodes and facets up to which `all pairs` "
                       "takes part in the sweep.");
    prm.leave_subsection();
  }

  void SweepParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Sweep");
    bucket_sizes = parse_numbers(prm.get("Bucket sizes"), "Sweep/Bucket sizes");
    repeats = static_cast<unsigned int>(prm.get_integer("Repeats"));
    most_tests = prm.get_double("Maximum tests");
    prm.leave_subsection();
    for (const double size : bucket_sizes)
      if (!(size > 0))
        throw InputError("Sweep/Bucket sizes",
                         "bucket sizes must be positive; the automatic choice "
                         "is always included.");
    std::sort(bucket_sizes.begin(), bucket_sizes.end());
  }

  std::vector<SweepPoint>
  run_sweep(abut_context *context, abut_surface *secondary,
            abut_surface *primary, const abut_search_options &options,
            const SweepParameters &parameters,
            const std::function<void(const SweepPoint &)> &measured)
  {
    return Sweep(context, secondary, primary, options, parameters)
        .run(measured);
  }
} // namespace abut::app
