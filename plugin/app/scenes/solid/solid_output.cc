// SPDX-License-Identifier: LGPL-2.1-or-later
// Fields and contact boundaries of the scene `solid`.
#include "app/input/collective.h"
#include "app/physics/scalar_field.h"
#include "app/physics/stress_output.h"
#include "app/pictures/contact_output.h"
#include "app/scenes/nodal_forces.h"
#include "solid_model.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Tractions that theory has for the forces of a pair. */
    struct ClosedForm
    {
      ClosedForm(const PairParameters &pair, const PairResult<2> &result,
                 const double time)
          : pressure(formula(pair.closed_pressure),
                     pair.parameter("Closed form of pressure"), 1,
                     forces(result)),
            friction(formula(pair.closed_friction),
                     pair.parameter("Closed form of friction"), 1,
                     forces(result))
      {
        pressure.set_time(time);
        friction.set_time(time);
      }

      Expression<2> pressure, friction;

    private:
      static std::map<std::string, double> forces(const PairResult<2> &result)
      {
        return {{"Fx", result.secondary_force[0]},
                {"Fy", result.secondary_force[1]},
                {"Qx", result.secondary_friction[0]},
                {"Qy", result.secondary_friction[1]}};
      }

      static std::string formula(const std::string &text)
      {
        return text.empty() ? "0" : text;
      }
    };
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
    if (model.parameters.fields)
      write_present();
  }

  template <int dim> void SolidOutput<dim>::write_present()
  {
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
    dealii::DoFHandler<dim> linear(model.triangulation);
    distribute_linear(model.elasticity.dof_handler, linear);
    const std::vector<la::Vector> means =
        nodal_stress(model.elasticity.mapping, model.elasticity.dof_handler,
                     displacement, model.data.materials, linear);
    fields.others = {{"mean_von_mises_stress", &linear, &means.back()}};
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
    write_lines(contact_values);
  }

  template <int dim>
  void SolidOutput<dim>::write_lines(const ContactFields &contact_values) const
  {
    if constexpr (dim == 2)
    {
      std::size_t number = 0;
      for (const ContactPair<dim> &pair : model.pairs->pairs())
      {
        const std::vector<ContactLine> lines = lines_of(pair, contact_values);
        ++number;
        on_root(model.run.communicator,
                [&]
                {
                  write_contact_lines(
                      model.run.options.output_folder
                          / ("pair_" + std::to_string(number) + ".csv"),
                      lines);
                });
      }
    }
  }

  template <int dim>
  std::vector<ContactLine>
  SolidOutput<dim>::lines_of(const ContactPair<dim> &pair,
                             const ContactFields &fields) const
  {
    if constexpr (dim == 2)
    {
      const bool is_split = model.tells_friction_apart(),
                 has_friction = pair.friction != nullptr;
      return contact_lines(
          model.elasticity.mapping, model.elasticity.dof_handler,
          pair.secondary,
          {fields.traction, &fields.row_gap, &fields.status,
           has_friction ? &fields.slip : nullptr,
           is_split ? &fields.normal : nullptr,
           is_split && has_friction ? &fields.along : nullptr});
    }
    else
      return {};
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

  template <int dim> void SolidOutput<dim>::finish()
  {
    const bool fields = model.parameters.fields,
               pictures = model.run.options.pictures;
    if (!fields && pictures)
      write_present();
    SectionTimes::Scope scope(model.run.report.times, "output");
    if (fields || pictures)
      write_obstacle_surfaces(model.run.u.linfty_norm());
    else if (!model.pairs->empty())
      write_lines(model.contact_fields());
    write_closed_forms();
  }

  template <int dim>
  void SolidOutput<dim>::write_obstacle_surfaces(const double motion) const
  {
    const auto obstacles = model.pairs->moved_obstacles();
    if (obstacles.empty())
      return;
    const MPI_Comm communicator = model.run.communicator;
    dealii::BoundingBox<dim> box =
        dealii::GridTools::compute_bounding_box(model.triangulation);
    auto &[low, high] = box.get_boundary_points();
    double size = 0.;
    for (unsigned int d = 0; d < dim; ++d)
    {
      low[d] = MPI::min(low[d], communicator) - motion;
      high[d] = MPI::max(high[d], communicator) + motion;
      size = std::max(size, high[d] - low[d]);
    }
    box.extend(0.15 * size);
    on_root(communicator,
            [&]
            {
              write_obstacles(model.run.options.output_folder / "obstacles.vtu",
                              obstacles, box);
            });
  }

  template <int dim> void SolidOutput<dim>::write_closed_forms() const
  {
    if constexpr (dim == 2)
    {
      const auto results = model.run.contact.results().pairs();
      for (std::size_t i = 0; i < results.size(); ++i)
      {
        const PairParameters &pair = model.parameters.pairs.at(i);
        if (pair.closed_pressure.empty() && pair.closed_friction.empty())
          continue;
        const std::string key =
            "pair_" + std::to_string(i + 1) + "_closed_form";
        model.run.report.set(key, pair.closed_form.empty() ? "closed form"
                                                           : pair.closed_form);
        const std::vector<ContactLine> lines =
            lines_of(model.pairs->pairs()[i], model.contact_fields());
        const ClosedForm form(pair, results[i], model.run.present.time);
        on_root(model.run.communicator,
                [&]
                {
                  write_closed_form(model.run.options.output_folder
                                        / (key + ".csv"),
                                    lines, form.pressure, form.friction);
                });
      }
    }
  }

  template class SolidOutput<2>;
  template class SolidOutput<3>;
} // namespace abut::app
