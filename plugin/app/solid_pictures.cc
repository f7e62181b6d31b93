// SPDX-License-Identifier: LGPL-2.1-or-later
// The pictures of the scene `solid`.
#include "body_pictures.h"
#include "pictures.h"
#include "solid_run.h"

namespace abut::app
{
  namespace
  {
    /** Errors over unknowns of the meshes of the first load step. */
    std::vector<Curve> error_curves(const std::vector<SolidState> &states)
    {
      Curve l2{"L2 error", {}};
      Curve energy{"error in energy norm", {}};
      Curve estimate{"estimate of the latter", {}};
      for (const SolidState &state : states)
        if (state.load_step == states.front().load_step)
        {
          const double n = double(state.dofs);
          if (state.errors)
          {
            l2.points.emplace_back(n, state.errors->l2);
            energy.points.emplace_back(n, *state.errors->energy);
          }
          if (state.estimate)
            estimate.points.emplace_back(n, *state.estimate);
        }
      return {l2, energy, estimate};
    }
  } // namespace

  template <int dim> void SolidRun<dim>::draw()
  {
    SectionTimes::Scope scope(report.times, "output");
    if constexpr (dim == 2)
      draw_bodies(report, options.output_folder, "bodies", elasticity.mapping,
                  elasticity.dof_handler, elasticity.ghosted(u), data.materials,
                  {}, "Deformed bodies");
    Curve count{"linear systems", {}};
    for (const SolidState &state : states)
      if (state.load_step == states.front().load_step)
        count.points.emplace_back(double(state.dofs), double(state.steps));
    draw_convergence(report, options.output_folder, "convergence",
                     error_curves(states), {count}, "Convergence");
  }

  template void SolidRun<2>::draw();
  template void SolidRun<3>::draw();
} // namespace abut::app
