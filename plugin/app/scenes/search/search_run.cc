// SPDX-License-Identifier: LGPL-2.1-or-later
/* The scene `search`, step by step. */
#include "search_run.h"

#include "app/input/input_error.h"
#include "app/pictures/surface_output.h"
#include "app/report/processor_time.h"
#include "app/restart/disk.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::app
{
  SearchRun::SearchRun(const SearchSceneParameters &parameters,
                       const RunOptions &options, Report &report)
      : parameters(parameters),
        options(options),
        report(report),
        context(shim::create_context())
  {
  }

  template <int dim> void SearchRun::check()
  {
    refuse_ranks();
    make_surfaces<dim>();
    report_sizes();
    detect();
    count_pairs();
    report_detection();
    report_model();
  }

  template <int dim> void SearchRun::run()
  {
    check<dim>();
    measure_times();
    report_statistics();
    sweep();
    write_fields<dim>();
  }

  void SearchRun::refuse_ranks() const
  {
    const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(options.communicator);
    if (n_ranks > 1)
      throw InputError("Scene", "the scene 'search' uses one rank: its "
                                "surfaces are not distributed. It was started "
                                "on "
                                    + std::to_string(n_ranks)
                                    + "; start it without mpirun.");
  }

  template <int dim> void SearchRun::make_surfaces()
  {
    SectionTimes::Scope scope(report.times, "surfaces");
    secondary.arrays = make_surface<dim>(parameters.secondary, options);
    make_surface_object(secondary, "Secondary");
    if (!parameters.search.detection.self_contact)
    {
      primary.arrays = make_surface<dim>(parameters.primary, options);
      make_surface_object(primary, "Primary");
    }
  }

  void SearchRun::make_surface_object(Side &side, const std::string &name)
  {
    const SurfaceArrays &arrays = side.arrays;
    abut_surface_data data = abut_surface_data_defaults();
    data.dimension = arrays.dimension;
    data.n_nodes = arrays.n_nodes();
    data.n_facets = arrays.n_facets();
    data.kind = arrays.kind;
    data.connectivity = arrays.connectivity.data();
    data.position = arrays.position.data();
    data.group = arrays.group.data();
    data.check_orientation = parameters.search.check_orientation;
    data.feature_angle = parameters.search.feature_angle;
    abut_surface *surface = nullptr;
    const abut_status status =
        abut_surface_create(context.get(), &data, &surface);
    if (status > 0)
    {
      std::string fault = abut_context_message(context.get());
      const std::string call = "abut_surface_create: ";
      if (fault.compare(0, call.size(), call) == 0)
        fault = fault.substr(call.size());
      throw InputError(arrays.parameter,
                       "the surface '" + name + "' (" + arrays.origin
                           + ") cannot be used: " + fault
                           + ". Facets and nodes are counted from 0.");
    }
    shim::check(context.get(), status);
    side.surface.reset(surface);
  }

  SearchRun::Side &SearchRun::primary_side()
  {
    return parameters.search.detection.self_contact ? secondary : primary;
  }

  abut_detection_options SearchRun::detection_options()
  {
    thicknesses =
        parameters.search.group_thicknesses(primary_side().arrays.groups());
    abut_detection_options result = parameters.search.detection;
    result.n_thicknesses = static_cast<std::int32_t>(thicknesses.groups.size());
    result.thickness_group = thicknesses.groups.data();
    result.thickness = thicknesses.values.data();
    return result;
  }

  void SearchRun::detect()
  {
    SectionTimes::Scope scope(report.times, "detection");
    detection = shim::create_detection(context.get(), secondary.surface.get(),
                                       primary_side().surface.get(),
                                       detection_options());
    shim::check(context.get(), abut_detection_run(detection.get(), 0));
    shim::check(context.get(), abut_detection_get(detection.get(), &view));
  }

  namespace
  {
    /** Nodes and unit normals of all facets, facet after facet. */
    struct FacetGeometry
    {
      std::vector<double> nodes;
      std::vector<double> normal;
      std::size_t stride = 0;

      FacetGeometry(const abut_context *context, const SurfaceArrays &surface)
      {
        const auto n =
            static_cast<std::size_t>(abut_facet_n_nodes(surface.kind));
        const auto dim = static_cast<std::size_t>(surface.dimension);
        stride = n * dim;
        for (const std::int32_t node : surface.connectivity)
          for (std::size_t d = 0; d < dim; ++d)
            nodes.push_back(
                surface.position[dim * static_cast<std::size_t>(node) + d]);
        for (std::size_t f = 0; f < surface.group.size(); ++f)
        {
          abut_facet_measures m;
          shim::check(context,
                      abut_facet_measure(surface.kind, &nodes[stride * f], &m));
          normal.insert(normal.end(), m.normal, m.normal + 3);
        }
      }
    };
  } // namespace

  void SearchRun::count_pairs()
  {
    SectionTimes::Scope scope(report.times, "facet pairs");
    Side &other = primary_side();
    const auto search = shim::create_search(context.get(), other.surface.get(),
                                            parameters.search.detection.search);
    const auto pairs = shim::create_pairs(context.get());
    shim::check(
        context.get(),
        abut_search_facets(search.get(), secondary.surface.get(), pairs.get()));
    abut_pairs_view list;
    shim::check(context.get(), abut_pairs_get(pairs.get(), &list));

    const FacetGeometry mine(context.get(), secondary.arrays);
    const FacetGeometry theirs(context.get(), other.arrays);
    std::int64_t n_with_area = 0;
    double total = 0;
    for (std::int32_t q = 0; q < list.n_queries; ++q)
      for (std::int64_t k = list.start[q]; k < list.start[q + 1]; ++k)
      {
        const auto i = static_cast<std::size_t>(q);
        const auto j = static_cast<std::size_t>(list.facet[k]);
        double cosine = 0;
        for (std::size_t d = 0; d < 3; ++d)
          cosine += mine.normal[3 * i + d] * theirs.normal[3 * j + d];
        if (cosine > parameters.search.detection.normal_cosine)
          continue;
        double area = 0;
        shim::check(context.get(),
                    abut_facet_covered_area(
                        secondary.arrays.kind, &mine.nodes[mine.stride * i],
                        other.arrays.kind, &theirs.nodes[theirs.stride * j],
                        &area));
        n_with_area += area > 0 ? 1 : 0;
        total += area;
      }
    report.set("pairs", list.n_queries > 0 ? list.start[list.n_queries] : 0);
    report.set("pairs_with_area", n_with_area);
    report.set("common_area", total);
  }

  void SearchRun::measure_times()
  {
    SectionTimes::Scope scope(report.times, "timing");
    Side &other = primary_side();
    std::vector<double> seconds;
    for (unsigned int i = 0; i < parameters.sweep.repeats; ++i)
    {
      // Told to be new, so that normals are computed again.
      for (Side *side : {&secondary, &other})
        shim::check(context.get(),
                    abut_surface_update(side->surface.get(),
                                        side->arrays.position.data()));
      const abut_detection_options chosen = detection_options();
      const double start = processor_seconds();
      const auto again = shim::create_detection(
          context.get(), secondary.surface.get(), other.surface.get(), chosen);
      shim::check(context.get(), abut_detection_run(again.get(), 0));
      seconds.push_back(processor_seconds() - start);
    }
    report.set("ns_per_node",
               1e9 * *std::min_element(seconds.begin(), seconds.end())
                   / std::max(1, secondary.arrays.n_nodes()));
  }

  void SearchRun::sweep()
  {
    if (parameters.sweep.bucket_sizes.empty())
      return;
    Side &other = primary_side();
    SweepHeading heading;
    heading.n_nodes = secondary.arrays.n_nodes();
    heading.n_facets = other.arrays.n_facets();
    std::vector<SweepPoint> points;
    {
      SectionTimes::Scope scope(report.times, "sweep");
      print_sweep_head(report);
      points =
          run_sweep(context.get(), secondary.surface.get(), other.surface.get(),
                    parameters.search.detection.search, parameters.sweep,
                    [&](const SweepPoint &point)
                    { print_sweep_point(report, point, heading); });
    }
    SectionTimes::Scope scope(report.times, "output");
    write_sweep(options.output_folder, points, heading);
  }

  template <int dim> void SearchRun::write_fields()
  {
    if (!parameters.fields && !options.pictures)
      return;
    SectionTimes::Scope scope(report.times, "output");
    write_candidates();
    const auto n = static_cast<std::size_t>(view.n_nodes);
    std::vector<double> gap(n), distance(n), status(n), facet(n), node(n);
    std::vector<std::vector<double>> to_foot(dim, std::vector<double>(n));
    for (std::size_t i = 0; i < n; ++i)
    {
      const abut_contact &contact = view.contact[i];
      gap[i] = contact.gap;
      distance[i] = contact.distance;
      facet[i] = contact.facet;
      node[i] = static_cast<double>(i);
      status[i] = contact.facet < 0 ? 0 : contact.gap < 0 ? 2 : 1;
      for (unsigned int d = 0; d < dim && contact.facet >= 0; ++d)
        to_foot[d][i] = -contact.gap * contact.normal[d];
    }
    const auto ids = [](const SurfaceArrays &surface)
    { return std::vector<double>(surface.group.begin(), surface.group.end()); };
    SurfaceFields fields;
    fields.nodal = {{"gap", gap},
                    {"distance", distance},
                    {"status", status},
                    {"facet", facet},
                    {"node", node}};
    for (unsigned int d = 0; d < dim; ++d)
      fields.nodal.emplace_back(std::string("to_projection_") + "xyz"[d],
                                to_foot[d]);
    fields.facets = {{"boundary_id", ids(secondary.arrays)}};
    write_surface<dim>(options.output_folder / "secondary.vtu",
                       secondary.arrays, fields);
    if (!parameters.search.detection.self_contact)
      write_surface<dim>(options.output_folder / "primary.vtu", primary.arrays,
                         {{}, {{"boundary_id", ids(primary.arrays)}}});
  }

  void SearchRun::write_candidates()
  {
    const abut_detection_options &chosen = parameters.search.detection;
    const auto search = shim::create_search(
        context.get(), primary_side().surface.get(), chosen.search);
    const auto pairs = shim::create_pairs(context.get());
    shim::check(context.get(),
                abut_search_set_reach(search.get(), view.reach,
                                      chosen.search.relative_reach, 0.));
    shim::check(
        context.get(),
        abut_search_nodes(search.get(), secondary.surface.get(), pairs.get()));
    abut_pairs_view list;
    shim::check(context.get(), abut_pairs_get(pairs.get(), &list));
    std::ostringstream out;
    out << "node,facet\n";
    for (std::int32_t q = 0; q < list.n_queries; ++q)
      for (std::int64_t k = list.start[q]; k < list.start[q + 1]; ++k)
        out << q << ',' << list.facet[k] << '\n';
    write_file(options.output_folder / "candidates.csv", out.str());
  }

  template void SearchRun::check<2>();
  template void SearchRun::check<3>();
  template void SearchRun::run<2>();
  template void SearchRun::run<3>();
} // namespace abut::app
