// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields, contact boundaries and pictures of the scene `solid`.
#include "app/input/collective.h"
#include "app/physics/stress_output.h"
#include "app/pictures/body_pictures.h"
#include "app/pictures/contact_output.h"
#include "app/pictures/pictures.h"
#include "solid_run.h"

#include <deal.II/base/mpi.h>

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

  template <int dim> double SolidRun<dim>::output_time() const
  {
    // Coarser meshes come before the time of the first load step.
    const double last = parameters.refinement.last_mesh();
    return is_last_mesh() ? present.time : present.level - last;
  }

  template <int dim> void SolidRun<dim>::write_fields()
  {
    if (!parameters.fields)
      return;
    SectionTimes::Scope scope(report.times, "output");
    const la::Vector displacement = elasticity.ghosted(u);
    dealii::Vector<float> body(triangulation.n_active_cells());
    for (const auto &cell : triangulation.active_cell_iterators())
      body(cell->active_cell_index()) = float(cell->material_id() + 1);
    Fields<dim> fields{elasticity.mapping,
                       elasticity.dof_handler,
                       {{"displacement", &displacement}},
                       {{"body", &body}}};
    const StressPostprocessor<dim> stresses(data.materials);
    fields.derived = {{&displacement, &stresses}};
    if (present.estimate)
      fields.cells.emplace_back("squared_error_estimate", &squared_estimate);
    series.write(output_time(), fields);
    if (!pairs->empty())
      write_contact(displacement);
  }

  template <int dim>
  void SolidRun<dim>::write_contact(const la::Vector &displacement)
  {
    const ContactFields contact_values = contact_fields();
    const SignedLength<dim> pressures("pressure", -1.);
    const FirstComponent<dim> gaps("gap");
    const FirstComponent<dim> states("status");
    Fields<dim> fields{elasticity.mapping,
                       elasticity.dof_handler,
                       {{"displacement", &displacement},
                        {"traction", &contact_values.traction}},
                       {}};
    fields.derived = {{&contact_values.traction, &pressures},
                      {&contact_values.gap, &gaps},
                      {&contact_values.status, &states}};
    fields.faces = pairs->surfaces();
    contact_series.write(output_time(), fields);
    if constexpr (dim == 2)
    {
      const std::vector<PressureCurve> curves = pressure_curves(contact_values);
      collective(communicator,
                 [&]
                 {
                   if (dealii::Utilities::MPI::this_mpi_process(communicator)
                       > 0)
                     return;
                   for (std::size_t i = 0; i < curves.size(); ++i)
                     write_contact_lines(
                         options.output_folder
                             / ("pair_" + std::to_string(i + 1) + ".csv"),
                         curves[i].lines);
                 });
    }
  }

  template <int dim>
  std::vector<PressureCurve>
  SolidRun<dim>::pressure_curves(const ContactFields &fields) const
  {
    std::vector<PressureCurve> curves;
    if constexpr (dim == 2)
    {
      for (const ContactPair<dim> &pair : pairs->pairs())
        curves.push_back(
            {pair.name,
             contact_lines(elasticity.mapping, elasticity.dof_handler,
                           pair.secondary,
                           {fields.traction, &fields.gap, &fields.status})});
    }
    return curves;
  }

  template <int dim> void SolidRun<dim>::draw()
  {
    SectionTimes::Scope scope(report.times, "output");
    if constexpr (dim == 2)
      draw_bodies(report, options.output_folder, "bodies", elasticity.mapping,
                  elasticity.dof_handler, elasticity.ghosted(u), data.materials,
                  pressure_curves(contact_fields()), "Deformed bodies");
    Curve count{"linear systems", {}};
    for (const SolidState &state : states)
      if (state.load_step == states.front().load_step)
        count.points.emplace_back(double(state.dofs), double(state.steps));
    draw_convergence(report, options.output_folder, "convergence",
                     error_curves(states), {count}, "Convergence");
  }

  template double SolidRun<2>::output_time() const;
  template void SolidRun<2>::write_fields();
  template void SolidRun<2>::write_contact(const la::Vector &);
  template std::vector<PressureCurve>
  SolidRun<2>::pressure_curves(const ContactFields &) const;
  template void SolidRun<2>::draw();
  template double SolidRun<3>::output_time() const;
  template void SolidRun<3>::write_fields();
  template void SolidRun<3>::write_contact(const la::Vector &);
  template std::vector<PressureCurve>
  SolidRun<3>::pressure_curves(const ContactFields &) const;
  template void SolidRun<3>::draw();
} // namespace abut::app
