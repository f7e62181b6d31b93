// SPDX-License-Identifier: LGPL-2.1-or-later
#include "failure_list.h"

#include <map>

namespace abut::app
{
  std::string remedy(const abut_failure_entry &failure)
  {
    static const std::map<abut_failure, const char *> parameters = {
        {ABUT_FAILURE_PENALTY,
         "Method/Penalty factor = auto, or augmented lagrangian or lagrange"},
        {ABUT_FAILURE_MULTIPLIERS_STALL,
         "Method/Adaptive penalty = true, or a larger Method/Penalty factor"},
        {ABUT_FAILURE_COLD_START, "Refinement/Nested iteration = true"},
        {ABUT_FAILURE_OVERLAP, "move the bodies apart, or set the "
                               "interference as Pair N/Initial gap"},
        {ABUT_FAILURE_LOCKING,
         "Body N/Element = mean dilatation, or Solid/Degree = 2"},
        {ABUT_FAILURE_BUCKETS,
         "Search/Bucket size = auto, or adaptive buckets"},
        {ABUT_FAILURE_LINEAR_SOLVER, "Solver/Linear solver = direct or auto"},
        {ABUT_FAILURE_NITSCHE,
         "Method/Penalty factor = auto, or Method/Nitsche theta = -1"},
        {ABUT_FAILURE_NEGATIVE_WEIGHTS, "Method/Discretisation = mortar"},
        {ABUT_FAILURE_INTERIOR, "lagrange, or a looser Method/Gap tolerance"},
        {ABUT_FAILURE_STICK_SLIP,
         "Method/Friction iteration = primal-dual; smaller load steps, or a "
         "smaller coefficient of friction"},
        {ABUT_FAILURE_UNBALANCED,
         "Method/Barrier end = 1e-8, or lagrange; in a program of one's own, "
         "look at the sign of the residual"},
        {ABUT_FAILURE_SINGULAR, "Refinement/Adaptive cycles; smooth data"},
        {ABUT_FAILURE_FEW_POINTS,
         "Refinement/Adaptive cycles, or a larger Refinement/Level"},
        {ABUT_FAILURE_NARROW_LOAD,
         "a mesh whose cells end where the load does, or a larger "
         "Refinement/Level"},
        {ABUT_FAILURE_UNSTABLE,
         "a small Body N/Body force across, or Time stepping/Scheme = hht"}};
    const auto entry = parameters.find(failure.failure);
    return entry != parameters.end() ? entry->second : failure.remedy;
  }

  std::string failure_list()
  {
    std::string text = "| code | failure | remedy |\n|---|---|---|\n";
    for (int i = 0; abut_failure_at(i) != nullptr; ++i)
    {
      const abut_failure_entry &failure = *abut_failure_at(i);
      text += std::string("| ") + failure.code + " | " + failure.name + " | "
              + remedy(failure) + " |\n";
    }
    return text;
  }
} // namespace abut::app
