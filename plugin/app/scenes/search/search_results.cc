// SPDX-License-Identifier: LGPL-2.1-or-later
/* What the scene `search` tells: sizes, detection, statistics, warnings. */
#include "search_run.h"

#include "app/input/number_text.h"
#include "app/input/short_number.h"

#include <algorithm>
#include <limits>

namespace abut::app
{
  namespace
  {
    /** Facets looked at for each pair, above which buckets do not help. */
    constexpr double wasteful_tests = 50.;

    /** "rejected_facing_away": keys of the summary, by reason. */
    std::string rejection_key(const int reason)
    {
      static const char *const names[] = {
#define ABUT_APP_NAME(name, text) #name,
          ABUT_REJECTION_LIST(ABUT_APP_NAME)
#undef ABUT_APP_NAME
      };
      return "rejected_" + lower_case(names[reason]);
    }

    std::string short_text(const double value)
    {
      return short_number(value, 4);
    }
  } // namespace

  void SearchRun::report_sizes()
  {
    Side &other = primary_side();
    report.set("nodes", secondary.arrays.n_nodes());
    report.set("facets", other.arrays.n_facets());
    report.set("secondary_facets", secondary.arrays.n_facets());
    const auto sizes = [this](const std::string &name, const Side &side)
    {
      abut_surface_sizes s;
      shim::check(context.get(), abut_surface_measure(side.surface.get(), &s));
      report.set(name + "_area", s.area);
      report.set(name + "_facet_sizes",
                 std::vector<double>{s.smallest, s.median, s.largest});
      report.print("  " + name + ": " + side.arrays.origin + ", "
                   + std::to_string(side.arrays.n_nodes()) + " nodes, "
                   + std::to_string(side.arrays.n_facets()) + " "
                   + abut_facet_name(side.arrays.kind) + " facets of size "
                   + short_text(s.smallest) + " to " + short_text(s.largest));
    };
    sizes("secondary", secondary);
    if (&other != &secondary)
      sizes("primary", other);
  }

  void SearchRun::report_detection()
  {
    abut_detection_report found;
    shim::check(context.get(),
                abut_detection_make_report(detection.get(), &found));
    report.set("candidates", view.n_candidates);
    report.set("contact_elements", found.n_paired);
    report.set("uncovered_area", found.uncovered_area);
    if (found.n_paired > 0)
    {
      double smallest = std::numeric_limits<double>::max();
      double largest = -smallest;
      for (std::int32_t i = 0; i < view.n_nodes; ++i)
        if (view.contact[i].facet >= 0)
        {
          smallest = std::min(smallest, view.contact[i].gap);
          largest = std::max(largest, view.contact[i].gap);
        }
      report.set("smallest_gap", smallest);
      report.set("largest_gap", largest);
    }
    report.set("initial_overlaps", found.n_overlaps);
    report.set("largest_overlap", found.largest_overlap);
    report.set("reversed_normals", found.n_reversed);
    report.set("size_ratio", found.size_ratio);
    for (int reason = 0; reason < ABUT_REJECTION_N; ++reason)
      report.set(rejection_key(reason), view.rejected[reason]);
    report_warnings(found);
  }

  void SearchRun::report_warnings(const abut_detection_report &found)
  {
    if (found.n_paired == 0)
      report.warn(coded(
          ABUT_FAILURE_NO_PARTNER,
          "no node of the secondary surface is paired: "
              + std::string(view.n_candidates == 0
                                ? "no facet is within reach (Search/Reach "
                                  "and Search/Relative reach)."
                                : "all candidates were rejected, see "
                                  "the reasons.")));
    if (found.n_reversed > 0)
      report.warn(coded(
          ABUT_FAILURE_WRONG_SIDE,
          std::to_string(found.n_reversed)
              + " nodes have facets within reach, but all face in the same "
                "direction as the node. Is one of the surfaces inside out?",
          {{"nodes", found.n_reversed}}));
    if (found.n_overlaps > 0)
    {
      const auto dim = static_cast<std::size_t>(secondary.arrays.dimension);
      std::string place;
      for (std::size_t d = 0; d < dim; ++d)
        place += (d > 0 ? ", " : "")
                 + short_text(
                     secondary.arrays
                         .position[dim * std::size_t(found.deepest_node) + d]);
      report.warn(coded(
          ABUT_FAILURE_OVERLAP,
          std::to_string(found.n_overlaps)
              + " nodes overlap the primary surface from the start, by up to "
              + short_text(found.largest_overlap) + " at (" + place + ").",
          {{"nodes", found.n_overlaps}, {"overlap", found.largest_overlap}}));
    }
    if (found.size_ratio > 3)
      report.warn(
          coded(ABUT_FAILURE_COARSE_SECONDARY,
                "the facets of the secondary surface are "
                    + short_text(found.size_ratio)
                    + " times as large as those of the primary surface, which "
                      "may pass between its nodes: exchange the two surfaces.",
                {{"ratio of facets", found.size_ratio}}));
  }

  void SearchRun::report_statistics()
  {
    abut_search_statistics s;
    shim::check(context.get(), abut_search_get_statistics(
                                   abut_detection_search(detection.get()), &s));
    const double n = s.n_facets > 0 ? double(s.n_facets) : 1.;
    report.set("search_rebuilds", s.n_builds);
    report.set("bytes_per_facet", double(s.structure_bytes) / n);
    report.set("record_bytes_per_facet", double(s.record_bytes) / n);
    report.set("buckets", s.n_buckets);
    report.set("bucket_capacity", s.capacity);
    report.set("bucket_edge", s.bucket_edge);
    report.set("core_peak_mb",
               double(abut_context_memory(context.get()).peak_bytes)
                   / 1048576.);
    const double tests = double(s.n_block_tests + s.n_box_tests);
    const Report::Value candidates = report.get("candidates");
    const auto *found = std::get_if<std::int64_t>(&candidates);
    const double per_pair =
        tests / std::max(1., found != nullptr ? double(*found) : 0.);
    report.set("facets_tested", tests);
    report.set("tests_per_pair", per_pair);
    if (per_pair > wasteful_tests
        && parameters.search.detection.search.algorithm
               != ABUT_SEARCH_ALL_PAIRS)
      report.warn(
          coded(ABUT_FAILURE_BUCKETS,
                short_text(per_pair)
                    + " facets were tested for each pair found: the bucket "
                      "size is far from the size of the facets. Set "
                      "Search/Bucket size = auto, or Search/Algorithm = "
                      "adaptive buckets if sizes differ much.",
                {{"tests per pair", per_pair}}));
    if (s.bucket_raised != 0)
      report.warn(
          coded(ABUT_FAILURE_BUCKETS,
                "Search/Bucket size is below the search radius; the edge "
                    + short_text(s.bucket_edge) + " was used."));
  }

  void SearchRun::report_model()
  {
    const SearchParameters &p = parameters.search;
    const abut_search_options &lists = p.detection.search;
    report.model(abut_search_name(lists.algorithm), true,
                 lists.bucket_size > 0 || lists.capacity > 0
                     ? "buckets as set in the scene"
                     : "buckets chosen from the data");
    report.model("self contact", p.detection.self_contact,
                 p.detection.self_contact
                     ? "the secondary surface against itself"
                     : "two surfaces");
    report.model("thickness of bodies",
                 p.other_thickness || !p.thickness.empty(), "Search/Thickness");
    report.model("skin", lists.skin > 0,
                 lists.skin > 0 ? "lists are reused after small motion"
                                : "nothing moves");
    report.model("bucket-size sweep", !parameters.sweep.bucket_sizes.empty(),
                 "Sweep/Bucket sizes");
  }
} // namespace abut::app
