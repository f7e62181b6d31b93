// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tighten_method.h"

#include <algorithm>

namespace abut::app
{
  namespace
  {
    // What double precision leaves to tolerances.
    constexpr double smallest_tolerance = 1e-13;
  } // namespace

  bool tighten_law(MethodParameters &method, const double factor,
                   const double present_penalty)
  {
    abut_strategy_options &o = method.options;
    o.gap_tolerance = std::max(o.gap_tolerance / factor, smallest_tolerance);
    o.pressure_tolerance =
        std::max(o.pressure_tolerance / factor, smallest_tolerance);
    o.barrier_end = std::max(o.barrier_end / factor, smallest_tolerance);
    if (!abut_law_solves_once(o.law) || abut_law_is_exact(o.law))
      return true;
    if (present_penalty >= o.penalty_cap)
      return false;
    o.penalty = std::min(o.penalty_cap, factor * present_penalty);
    return true;
  }

  void tighten_solver(MethodParameters &method, const double factor)
  {
    abut_strategy_options &o = method.options;
    o.final_linear_tolerance =
        std::max(o.final_linear_tolerance / factor, smallest_tolerance);
  }
} // namespace abut::app
