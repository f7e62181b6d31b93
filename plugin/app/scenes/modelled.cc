// SPDX-License-Identifier: LGPL-2.1-or-later
#include "modelled.h"

namespace abut::app
{
  void model_meshes(Report &report, const RefinementParameters &refinement)
  {
    report.model("nested iteration", refinement.nested,
                 refinement.nested
                     ? "each level starts from the one before"
                     : "switched off: the start is displacement 0");
    report.model("adaptive refinement", refinement.adaptive_cycles > 0,
                 refinement.has_target() ? "refined where the estimate is "
                                           "large, until the target is met"
                 : refinement.adaptive_cycles > 0
                     ? "refined where the estimate is large"
                     : "Refinement/Adaptive cycles is 0",
                 {"error estimate"});
  }

  void model_linear_systems(Report &report, const std::string &how_many,
                            const LinearReport &last)
  {
    report.set("linear_solver", last.method);
    report.model(
        "linear systems", true,
        how_many + (last.method.empty() ? "" : "; the last: " + last.method),
        {"solve"});
  }

  void model_files(Report &report, const bool are_written)
  {
    report.model("files", are_written, "fields and pictures by section Output",
                 {"output"});
  }
} // namespace abut::app
