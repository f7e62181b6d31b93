// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields, contact boundaries and pictures of the scene `solid`.
#include "app/input/collective.h"
#include "app/physics/stress_output.h"
#include "app/pictures/body_pictures.h"
#include "app/pictures/contact_output.h"
#include "app/pictures/pictures.h"
#include "app/scenes/estimate_curves.h"
#include "app/scenes/nodal_forces.h"
#include "solid_model.h"

#include <deal.II/base/mpi.h>

namespace abut::app
{
  namespace
  {
    /** Errors over unknowns of the meshes of the first load step. */
    std::vector<Curve> error_curves(const std::vector<ContactResult> &states,
                                    const RefinementParameters &refinement)
    {
      Curve l2{"L2 error", {}};
      Curve energy{"error in energy norm", {}};
      for (const ContactResult &state : states)
        if (state.load_step == states.front().load_step)
        {
          const double n = double(state.dofs);
          if (state.errors)
          {
            l2.points.emplace_back(n, state.errors->l2);
            energy.points.emplace_back(n, *state.errors->energy);
          }
        }
      std::vector<Curve> curves = estimate_curves(states, refinement);
      curves.insert(curves.begin(), {l2, energy});
      return curves;
    }
  } // namespace

  template <int dim>
  SolidOutput<dim>::SolidOutput(const SolidModel<dim> &model)
      : model(model),
        series(model.run.options.output_folder, "fields",
               model.run.communicator),
        contact_series(model.run.options.output_folder, "contact",
                       model.run.communicator)
  {
  }

  template <int dim> double SolidOutput<dim>::time() const
  {
    // Coarser meshes come before the time of the first load step.
    const double last = model.parameters.refinement.last_mesh();
    return model.run.is_last_mesh() ? model.run.present.time
                                    : model.run.present.level - last;
  }

  template <int dim> void SolidOutput<dim>::write_fields()
  {
    if (!model.parameters.fields)
      return;
    SectionTimes::Scope scope(model.run.report.times, "output");
    const la::Vector displacement = model.elasticity.ghosted(model.run.u);
    dealii::Vector<float> body(model.triangulation.n_active_cells());
    for (const auto &cell : model.triangulation.active_cell_iterators())
      body(cell->active_cell_index()) = float(cell->material_id() + 1);
    Fields<dim> fields{model.elasticity.mapping,
                       model.elasticity.dof_handler,
                       {{"displacement", &displacement}},
                       {{"body", &body}}};
    const CellMaterials<dim> materials(model.elasticity.mapping,
                                       model.elasticity.dof_handler,
                                       displacement, model.data.materials);
    const StressPostprocessor<dim> stresses(materials);
    fields.derived = {{&displacement, &stresses}};
    if (model.run.present.estimate)
      fields.cells.emplace_back("squared_error_estimate",
                                &model.run.squared_estimate);
    series.write(time(), fields);
    if (!model.pairs->empty())
      write_contact(displacement);
  }

  template <int dim>
  void SolidOutput<dim>::write_contact(const la::Vector &displacement)
  {
    const ContactFields contact_values = model.contact_fields();
    const SignedLength<dim> pressures("pressure", -1.);
    const bool has_friction = model.pairs->has_friction();
    // Facets would take, at an edge, the friction of one for the pressure of
    // the other, and are only asked where nodes do not know.
    const bool is_split = model.tells_friction_apart();
    using Traction = TractionPart<dim>;
    const Traction normal("pressure", Traction::Part::pressure);
    const Traction of_facet("friction", Traction::Part::friction);
    const Traction of_node("friction", Traction::Part::all);
    const Traction slips("slip", Traction::Part::friction);
    const GapOfRows<dim> gaps("gap");
    const FirstComponent<dim> states("status");
    const NumberOfBoundary<dim> numbers_of_bodies(
        "body", [this](const dealii::types::boundary_id id)
        { return model.bodies.body_of(id) + 1.; });
    const NumberOfBoundary<dim> ids("boundary_id",
                                    [this](const dealii::types::boundary_id id)
                                    { return model.bodies.user_id(id); });
    Fields<dim> fields{model.elasticity.mapping,
                       model.elasticity.dof_handler,
                       {{"displacement", &displacement},
                        {"traction", &contact_values.traction}},
                       {}};
    fields.derived = {
        {&contact_values.normal,
         has_friction && !is_split
             ? static_cast<const dealii::DataPostprocessor<dim> *>(&normal)
             : &pressures},
        {&contact_values.row_gap, &gaps},
        {&contact_values.status, &states},
        {&displacement, &numbers_of_bodies},
        {&displacement, &ids}};
    if (has_friction)
    {
      fields.derived.emplace_back(is_split ? &contact_values.along
                                           : &contact_values.traction,
                                  is_split ? &of_node : &of_facet);
      fields.derived.emplace_back(&contact_values.slip, &slips);
    }
    fields.faces = model.pairs->surfaces();
    contact_series.write(time(), fields);
    if constexpr (dim == 2)
    {
      const std::vector<PressureCurve> curves = pressure_curves(contact_values);
      collective(
          model.run.communicator,
          [&]
          {
            if (dealii::Utilities::MPI::this_mpi_process(model.run.communicator)
                > 0)
              return;
            for (std::size_t i = 0; i < curves.size(); ++i)
              write_contact_lines(
                  model.run.options.output_folder
                      / ("pair_" + std::to_string(i + 1) + ".csv"),
                  curves[i].lines);
          });
    }
  }

  template <int dim>
  std::vector<PressureCurve>
  SolidOutput<dim>::pressure_curves(const ContactFields &fields) const
  {
    std::vector<PressureCurve> curves;
    if constexpr (dim == 2)
    {
      const bool is_split = model.tells_friction_apart();
      for (const ContactPair<dim> &pair : model.pairs->pairs())
        curves.push_back(
            {pair.name,
             contact_lines(model.elasticity.mapping,
                           model.elasticity.dof_handler, pair.secondary,
                           {fields.traction, &fields.row_gap, &fields.status,
                            pair.friction != nullptr ? &fields.slip : nullptr,
                            is_split ? &fields.normal : nullptr,
                            is_split && pair.friction != nullptr ? &fields.along
                                                                 : nullptr}),
             pair.friction != nullptr});
    }
    return curves;
  }

  template <int dim> void SolidOutput<dim>::write_nodal_values() const
  {
    SectionTimes::Scope scope(model.run.report.times, "output");
    const Elasticity<dim> &elasticity = model.elasticity;
    const bool has_contact = !model.pairs->empty();
    const la::Vector unbalanced = model.unbalanced_forces();
    std::vector<NodalColumn> columns = {
        {"displacement", elasticity.ghosted(model.run.u)}};
    for (NodalColumn &column : force_columns(
             elasticity, model.run, elasticity.nodal_forces(model.run.u),
             has_contact, &unbalanced))
      columns.push_back(std::move(column));
    if (has_contact)
      for (const auto &[name, field] :
           {std::make_pair("gap", model.run.contact.results().gap()),
            std::make_pair("status", model.run.contact.results().status())})
        columns.push_back({name, elasticity.ghosted_field(field), true});
    if (has_contact && model.pairs->has_friction())
      columns.push_back({"slip", elasticity.ghosted_field(
                                     model.run.contact.results().slip())});
    write_nodal_table(model.run.options.output_folder / "nodal.csv",
                      elasticity.mapping, elasticity.dof_handler, columns);
  }

  template <int dim> void SolidOutput<dim>::draw() const
  {
    SectionTimes::Scope scope(model.run.report.times, "output");
    if constexpr (dim == 2)
    {
      std::vector<DrawnObstacle> obstacles;
      for (const auto &obstacle : model.pairs->moved_obstacles())
        obstacles.push_back({obstacle.shape, obstacle.motion});
      draw_bodies(model.run.report, model.run.options.output_folder, "bodies",
                  model.elasticity.mapping, model.elasticity.dof_handler,
                  model.elasticity.ghosted(model.run.u), model.data.materials,
                  pressure_curves(model.contact_fields()), obstacles,
                  "Deformed bodies");
    }
    if (model.motion)
    {
      model.motion->draw();
      return;
    }
    Curve count{"linear systems", {}};
    for (const ContactResult &state : model.run.results)
      if (state.load_step == model.run.results.front().load_step)
        count.points.emplace_back(double(state.dofs), double(state.steps));
    draw_convergence(
        model.run.report, model.run.options.output_folder, "convergence",
        error_curves(model.run.results, model.parameters.refinement), {count},
        "Convergence");
  }

  template class SolidOutput<2>;
  template class SolidOutput<3>;
} // namespace abut::app
