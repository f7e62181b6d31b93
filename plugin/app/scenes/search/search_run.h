// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SEARCH_RUN_H
#define ABUT_APP_SEARCH_RUN_H

#include "app/mesh/surface_mesh.h"
#include "search_sweep.h"
#include "shim/handles.h"

#include <abut/dealii/search_parameters.h>

#include <string>

namespace abut::app
{
  /** All parameters of the scene `search`. */
  struct SearchSceneParameters
  {
    SurfaceParameters secondary, primary;
    SearchParameters search;
    SweepParameters sweep;
    bool fields = true;

    static void declare(dealii::ParameterHandler &prm);
    void parse(dealii::ParameterHandler &prm);
  };

  /** One run of the scene `search`: two surfaces (or one and itself), their
   * candidates, contact elements and common areas, the report, the sweep. */
  class SearchRun
  {
  public:
    SearchRun(const SearchSceneParameters &parameters,
              const RunOptions &options, Report &report);

    /** Up to the report on the detection. */
    template <int dim> void check();

    /** All; results into the report and the output folder. */
    template <int dim> void run();

  private:
    /** A surface of the scene with what it was made from. */
    struct Side
    {
      SurfaceArrays arrays;
      shim::Handle<abut_surface> surface;
    };

    void refuse_ranks() const;
    template <int dim> void make_surfaces();
    void make_surface_object(Side &side, const std::string &name);
    Side &primary_side();
    abut_detection_options detection_options();
    void detect();
    void report_sizes();
    void report_detection();
    void report_warnings(const abut_detection_report &found);
    void count_pairs();
    void measure_times();
    void report_statistics();
    void report_model();
    void sweep();
    template <int dim> void write_fields();
    void write_candidates();

    const SearchSceneParameters &parameters;
    const RunOptions &options;
    Report &report;

    shim::Handle<abut_context> context;
    Side secondary, primary;
    GroupThicknesses thicknesses;
    shim::Handle<abut_detection> detection;
    abut_detection_view view = {};
  };
} // namespace abut::app

#endif
