// SPDX-License-Identifier: LGPL-2.1-or-later
#include "membrane_model.h"

#include "app/adapt/estimator.h"
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "app/mesh/boundary_parts.h"
#include "app/mesh/memory_check.h"
#include "app/physics/nodal_interpolation.h"
#include "app/pictures/outline.h"
#include "app/restart/archive.h"
#include "app/scenes/automatic_law.h"
#include "app/scenes/method_words.h"
#include "membrane_report.h"

#include <abut/dealii/versions.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::app
{
  template <int dim>
  MembraneModel<dim>::MembraneModel(const ObstacleParameters &parameters,
                                    ContactRunState<dim> &run)
      : MovingModel<dim>(run),
        parameters(parameters),
        membrane(this->triangulation, parameters.degree),
        series(run.options.output_folder, "fields", run.communicator)
  {
    if (parameters.time.is_on)
      motion = std::make_unique<ModelMotion<dim>>(
          parameters.time, motion_words(), run, membrane);
  }

  template <int dim> void MembraneModel<dim>::create_mesh()
  {
    const MeshFileExtras<dim> extras =
        app::create_mesh(parameters.mesh, run.options, this->triangulation);
    names = names_of(extras, this->triangulation);
    for (const auto &[name, warning] : extras.warnings)
      run.report.warn(parameters.mesh.section + "/" + name + ": " + warning);
    if (!run.options.output_folder.empty())
      write_outline<dim>(run.options.output_folder, run.communicator,
                         this->triangulation,
                         [this](const dealii::types::boundary_id id) {
                           return SurfaceName{1, id, names.names_of(id)};
                         });
    const double factor =
        std::pow(2., dim * double(parameters.refinement.level));
    check_memory(dim, factor * this->triangulation.n_global_active_cells(),
                 parameters.degree, run.communicator, "Refinement/Level");
  }

  template <int dim> void MembraneModel<dim>::create_functions()
  {
    conductivity = std::make_unique<Expression<dim>>(parameters.conductivity,
                                                     "Membrane/Conductivity");
    load = std::make_unique<Expression<dim>>(parameters.load,
                                             "Membrane/Body force");
    dirichlet = std::make_unique<BoundaryExpressions<dim>>(
        parameters.dirichlet, "Membrane/Prescribed displacement");
    neumann = std::make_unique<BoundaryExpressions<dim>>(parameters.neumann,
                                                         "Membrane/Traction");
    if (!parameters.exact_displacement.empty())
      exact = std::make_unique<ExactSolution<dim>>(
          parameters.exact_displacement, "Exact solution/Displacement",
          parameters.exact_gradient, "Exact solution/Gradient");
    if (motion)
      create_functions_of_motion();
  }

  template <int dim> void MembraneModel<dim>::set_data()
  {
    if (exact)
      exact->set_length(half_extent(this->triangulation));
    if (!parameters.boundary_ids.empty())
      contact_ids = parse_boundary_ids(parameters.boundary_ids,
                                       "Contact/Boundary ids", names);

    obstacle.boundary_ids = contact_ids;
    if (!parameters.height_map.file.empty())
      obstacle.lower = std::make_shared<HeightMap<dim>>(
          parameters.height_map,
          run.options.input_file(parameters.height_map.file));
    else if (!parameters.obstacle.empty())
      obstacle.lower = lower = std::make_shared<Expression<dim>>(
          parameters.obstacle, "Contact/Obstacle");
    if (!parameters.upper_obstacle.empty())
      obstacle.upper = upper = std::make_shared<Expression<dim>>(
          parameters.upper_obstacle, "Contact/Upper obstacle");

    data.conductivity = conductivity.get();
    data.load = load.get();
    data.constant_conductivity = conductivity->is_constant();
    data.constant_load = load->is_constant();
    data.constant_dirichlet = dirichlet->is_constant();
    data.constant_neumann = neumann->is_constant();
    const std::set<dealii::types::boundary_id> prescribed =
        dirichlet->named(names);
    const auto refuse_prescribed =
        [&](const auto &ids, const std::string &name, const std::string &what)
    {
      for (const dealii::types::boundary_id id : ids)
        if (prescribed.count(id) > 0)
          throw InputError(
              name, what + " on boundary " + std::to_string(id)
                        + " has no effect: Membrane/Prescribed displacement "
                          "prescribes the displacement there.");
    };
    // What both lists name themselves is a mistake; their * mean the ids that
    // are left.
    refuse_prescribed(neumann->named(names), "Membrane/Traction", "the flux");
    refuse_prescribed(contact_ids, "Contact/Boundary ids", "contact");
    data.neumann = neumann->functions(names, prescribed);
    std::set<dealii::types::boundary_id> taken = contact_ids;
    for (const auto &entry : data.neumann)
      taken.insert(entry.first);
    data.dirichlet = dirichlet->functions(names, taken);
  }

  template <int dim> void MembraneModel<dim>::setup_mesh()
  {
    {
      SectionTimes::Scope scope(run.report.times, "unknowns and pattern");
      membrane.renumber = parameters.refinement.renumber;
      membrane.setup(data);
    }
    if (!motion)
      return;
    SectionTimes::Scope scope(run.report.times, "assembly");
    membrane.assemble_stiffness(data);
    motion->setup(checked_density(), contact_ids);
    is_loaded = false;
  }

  template <int dim>
  void MembraneModel<dim>::choose_law(MethodParameters &method)
  {
    // Each step begins close to its end.
    if (motion)
      return;
    const double nodes = double(membrane.dof_handler.n_dofs());
    choose_law_of_membrane(method, !parameters.refinement.nested,
                           contact_ids.empty() ? std::pow(nodes, 1. / dim)
                                               : 0.);
    if (method.law_is_automatic)
      run.report.model("automatic law", true, method.options.law->name);
  }

  template <int dim> void MembraneModel<dim>::assemble()
  {
    SectionTimes::Scope scope(run.report.times, "assembly");
    if (!motion)
      membrane.assemble(data);
    else if (!is_loaded || load->depends_on_time() || neumann->depends_on_time()
             || dirichlet->depends_on_time())
      membrane.assemble_load(data);
    is_loaded = true;
  }

  template <int dim>
  void MembraneModel<dim>::set_contact(ContactAssembler<dim> &contact, double)
  {
    // Obstacles that move are asked where they are.
    if (!motion || !is_told)
      contact.set_obstacle(obstacle);
    is_told = true;
    this->renew_tangent(contact);
  }

  template <int dim> la::Vector MembraneModel<dim>::held_nodes() const
  {
    la::Vector flags = run.contact.results().status();
    double *value = la::data(flags);
    for (int i = 0; i < la::n_owned(flags); ++i)
      value[i] = value[i] > 0. ? 1. : 0.;
    flags.compress(dealii::VectorOperation::insert);
    membrane.hanging.distribute(flags);
    value = la::data(flags);
    for (int i = 0; i < la::n_owned(flags); ++i)
      value[i] = value[i] > 0.999 ? 1. : 0.;
    flags.compress(dealii::VectorOperation::insert);
    la::Vector ghosted = membrane.ghosted_field(run.contact.results().status());
    ghosted = flags;
    return ghosted;
  }

  template <int dim>
  double MembraneModel<dim>::estimate(dealii::Vector<float> &squared) const
  {
    const la::Vector active = held_nodes();
    const la::Vector solution = membrane.ghosted(run.u);
    const la::Vector p =
        membrane.ghosted_field(run.contact.results().pressure());
    EstimatorInput<dim> input{membrane.mapping, membrane.dof_handler, solution,
                              *load};
    input.coefficient = conductivity.get();
    input.neumann = data.neumann;
    for (const auto &entry : data.dirichlet)
      input.dirichlet.insert(entry.first);
    input.contact = contact_ids;
    if (contact_ids.empty())
      input.active = &active;
    else
      input.pressure = &p;
    return estimate_error(input, squared);
  }

  template <int dim> double MembraneModel<dim>::solution_norm() const
  {
    const dealii::Functions::ZeroFunction<dim> no_load;
    return std::sqrt(2.
                     * membrane_energy(membrane.mapping, membrane.dof_handler,
                                       membrane.ghosted(run.u), no_load,
                                       conductivity.get()));
  }

  template <int dim>
  std::optional<double>
  MembraneModel<dim>::work_on_gaps(const la::Vector &forces, const double) const
  {
    // Obstacles push up from below and down from above, and gaps are counted
    // from each.
    const la::Vector gap = run.contact.results().gap();
    double sum = 0.;
    for (int i = 0; i < la::n_owned(gap); ++i)
      sum += std::abs(la::data(forces)[i]) * la::data(gap)[i];
    return dealii::Utilities::MPI::sum(sum, run.communicator);
  }

  template <int dim>
  std::optional<ErrorNorms> MembraneModel<dim>::errors() const
  {
    if (!exact)
      return {};
    return error_norms(membrane.mapping, membrane.dof_handler,
                       membrane.ghosted(run.u), *exact);
  }

  template <int dim> std::string MembraneModel<dim>::description() const
  {
    std::string text = std::string(dim == 2 ? "membrane" : "scalar field")
                       + ", " + law_in_words(run.method);
    if (motion)
      text += std::string(", in time by ") + parameters.time.scheme.name;
    return text + (parameters.fields ? parameters.field_steps.in_words() : "");
  }

  template <int dim>
  std::string MembraneModel<dim>::line_of(const ContactResult &result) const
  {
    if (motion)
      return "time " + short_number(result.time, 6) + ": "
             + std::to_string(result.active) + " in contact, energy "
             + short_number(result.energy, 8);
    return "mesh " + std::to_string(result.level) + ": "
           + std::to_string(result.dofs) + " unknowns, "
           + counted(result.active, "point", "points") + " in contact, "
           + std::to_string(result.steps) + " active set iterations, energy "
           + short_number(result.energy, 8);
  }

  template <int dim> void MembraneModel<dim>::declare_tables()
  {
    std::vector<std::string> columns(
        {"level", "cells", "dofs", "constraints", "active", "steps",
         "linear_iterations", "matvecs", "setups", "energy", "contact_force",
         "penetration", "l2_error", "h1_error", "estimate", "estimated_error",
         "setup_seconds", "krylov_seconds", "seconds"});
    if (motion)
    {
      columns.insert(columns.begin(), {"load_step", "time"});
      for (const std::string &column : motion->columns())
        columns.push_back(column);
    }
    run.report.declare_columns(columns);
  }

  template <int dim>
  void MembraneModel<dim>::add_to_row(ContactResult &result,
                                      std::map<std::string, double> &row) const
  {
    if (!motion)
      return;
    motion->add_to_row(row);
    row["load_step"] = result.load_step;
    row["time"] = result.time;
  }

  template <int dim> la::Vector MembraneModel<dim>::gaps() const
  {
    la::Vector gap = run.contact.results().gap();
    const la::Vector status = run.contact.results().status();
    const auto points =
        versions::support_points(membrane.mapping, membrane.dof_handler);
    for (const auto dof : membrane.dof_handler.locally_owned_dofs())
    {
      if (status(dof) > -0.5)
        continue;
      double distance = std::numeric_limits<double>::infinity();
      if (obstacle.lower)
        distance = run.u(dof) - obstacle.lower->value(points.at(dof));
      if (obstacle.upper)
        distance = std::min(distance,
                            obstacle.upper->value(points.at(dof)) - run.u(dof));
      if (std::isfinite(distance))
        gap(dof) = distance;
    }
    gap.compress(dealii::VectorOperation::insert);
    return membrane.ghosted_field(gap);
  }

  template <int dim> void MembraneModel<dim>::write_fields()
  {
    if (parameters.fields)
      write_present();
  }

  template <int dim> void MembraneModel<dim>::write_present()
  {
    SectionTimes::Scope scope(run.report.times, "output");
    const la::Vector displacement = membrane.ghosted(run.u);
    const la::Vector p =
        membrane.ghosted_field(run.contact.results().pressure());
    const la::Vector g = gaps();
    const la::Vector status =
        membrane.ghosted_field(run.contact.results().status());
    Fields<dim> fields{membrane.mapping,
                       membrane.dof_handler,
                       {{"displacement", &displacement},
                        {"pressure", &p},
                        {"gap", &g},
                        {"status", &status}},
                       {}};
    if (run.present.estimate)
      fields.cells = {{"squared_error_estimate", &run.squared_estimate}};
    series.write(motion ? run.present.time : run.present.level, fields);
  }

  template <int dim> std::string MembraneModel<dim>::save_state() const
  {
    return to_bytes(std::make_pair(to_bytes(series), this->motion_state()));
  }

  template <int dim>
  void MembraneModel<dim>::load_state(const std::string &bytes)
  {
    std::pair<std::string, std::string> parts;
    from_bytes(bytes, parts);
    from_bytes(parts.first, series);
    this->load_motion(parts.second);
  }

  template <int dim> void MembraneModel<dim>::finish()
  {
    MembraneReport<dim> report(*this);
    if (parameters.nodal_values && !run.results.empty())
      report.write_nodal_values();
    if (parameters.linear_solves > 0)
      report.compare_with_linear_solves(membrane);
    if (run.results.empty())
      return;
    if (motion)
      motion->write_table();
    if (run.options.pictures && !parameters.fields)
      write_present();
  }

  template <int dim> void MembraneModel<dim>::report_check()
  {
    run.report.set("constraints", run.contact.results().measures().n_rows);
    for (const BoundaryPart<dim> &part :
         boundary_parts(this->triangulation, run.communicator))
      run.report.print("  " + names.describe(part.id) + ": " + in_words(part));
  }

  template <int dim>
  void MembraneModel<dim>::report_result(const bool converged)
  {
    MembraneReport<dim>(*this).result(converged);
  }

  template <int dim> void MembraneModel<dim>::report_model()
  {
    MembraneReport<dim>(*this).model_lines();
  }

  // What it has of its own when it moves: formulas that know the time, and
  // obstacles that work.

  template <int dim> MotionWords MembraneModel<dim>::motion_words() const
  {
    MotionWords words;
    words.components = {""};
    if (!parameters.obstacle.empty() || !parameters.height_map.file.empty())
      words.sides.push_back("obstacle");
    if (!parameters.upper_obstacle.empty())
      words.sides.push_back("upper_obstacle");
    words.stops = parameters.boundary_ids.empty();
    return words;
  }

  template <int dim> void MembraneModel<dim>::create_functions_of_motion()
  {
    const auto read = [](const std::string &text, const std::string &name)
    {
      return text.empty()
                 ? nullptr
                 : std::make_unique<Expression<dim>>(text, "Membrane/" + name);
    };
    density =
        read(parameters.density.empty() ? "0" : parameters.density, "Density");
    displacement =
        read(parameters.initial_displacement, "Initial displacement");
    velocity = read(parameters.initial_velocity, "Initial velocity");
  }

  template <int dim>
  typename MassData<dim>::Density MembraneModel<dim>::checked_density() const
  {
    return [this](const dealii::types::material_id,
                  const std::vector<dealii::Point<dim>> &points)
    {
      std::vector<double> values = density->evaluate(points);
      for (const double value : values)
        if (!(value > 0.))
          throw InputError(
              "Membrane/Density",
              "dynamics needs mass everywhere; Membrane/Density is "
                  + short_number(value)
                  + " at some point. Set a positive density, or Time "
                    "stepping/Scheme = quasi-static.");
      return values;
    };
  }

  template <int dim> bool MembraneModel<dim>::obstacles_move() const
  {
    return (lower && lower->depends_on_time())
           || (upper && upper->depends_on_time());
  }

  template <int dim> void MembraneModel<dim>::set_time(const double time)
  {
    if (!motion)
      return;
    load->set_time(time);
    for (const auto &side : {lower, upper})
      if (side)
        side->set_time(time);
    dirichlet->set_time(time);
    neumann->set_time(time);
    if (exact)
      exact->set_time(time);
    // The first mesh gets its values with its unknowns.
    if (dirichlet->depends_on_time() && membrane.dof_handler.has_active_dofs())
      membrane.prescribe(data);
  }

  template <int dim>
  std::pair<la::Vector, la::Vector> MembraneModel<dim>::initial_motion() const
  {
    const auto at_nodes = [&](const std::unique_ptr<Expression<dim>> &formula)
    {
      return values_at_nodes<dim>(membrane,
                                  [&](const dealii::types::material_id)
                                  { return formula.get(); });
    };
    std::pair<la::Vector, la::Vector> result{at_nodes(displacement),
                                             at_nodes(velocity)};
    require_outside(result.first);
    return result;
  }

  template <int dim>
  typename MembraneModel<dim>::Heights MembraneModel<dim>::heights() const
  {
    const dealii::IndexSet &owned = membrane.dof_handler.locally_owned_dofs();
    const auto places =
        versions::support_points(membrane.mapping, membrane.dof_handler);
    dealii::IndexSet touching = owned;
    if (!contact_ids.empty())
      touching = dealii::DoFTools::extract_boundary_dofs(
          membrane.dof_handler, dealii::ComponentMask(), contact_ids);
    Heights result;
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const auto dof : owned)
    {
      const bool touches = touching.is_element(dof);
      const auto at = [&](const auto &side)
      { return touches && side ? side->value(places.at(dof)) : none; };
      result.lower.push_back(at(obstacle.lower));
      result.upper.push_back(at(obstacle.upper));
    }
    return result;
  }

  template <int dim>
  void MembraneModel<dim>::require_outside(const la::Vector &start) const
  {
    const Heights limits = heights();
    const dealii::IndexSet &owned = membrane.dof_handler.locally_owned_dofs();
    const double *u = la::data(start);
    double depth = 0.;
    for (int i = 0; i < la::n_owned(start); ++i)
    {
      if (membrane.constraints.is_constrained(owned.nth_index_in_set(i)))
        continue;
      // Where there is no obstacle there is no depth.
      depth = std::fmax(depth, limits.lower[i] - u[i]);
      depth = std::fmax(depth, u[i] - limits.upper[i]);
    }
    depth = dealii::Utilities::MPI::max(depth, run.communicator);
    if (depth > 1e-10 * start.linfty_norm())
      throw InputError("Membrane/Initial displacement",
                       "the membrane starts beyond an obstacle, by up to "
                           + short_number(depth)
                           + ". Start between the obstacles.");
  }

  template <int dim> la::Vector MembraneModel<dim>::start()
  {
    la::Vector result = MovingModel<dim>::start();
    if (obstacles_move())
      before = heights();
    return result;
  }

  template <int dim>
  void MembraneModel<dim>::resume(std::vector<la::Vector> fields)
  {
    MovingModel<dim>::resume(std::move(fields));
    if (motion && obstacles_move())
      before = heights();
  }

  template <int dim>
  std::vector<ContactAction> MembraneModel<dim>::contact_actions() const
  {
    la::Vector forces = membrane.vector();
    run.contact.results().add_forces(forces);
    double sums[2] = {0., 0.};
    for (int i = 0; i < la::n_owned(forces); ++i)
      sums[la::data(forces)[i] < 0. ? 1 : 0] += la::data(forces)[i];
    dealii::Utilities::MPI::sum(sums, run.communicator, sums);
    std::vector<ContactAction> actions;
    if (obstacle.lower)
      actions.emplace_back().force = {sums[0]};
    if (obstacle.upper)
      actions.emplace_back().force = {sums[1]};
    return actions;
  }

  template <int dim> void MembraneModel<dim>::end_solve()
  {
    MovingModel<dim>::end_solve();
    if (!motion || !obstacles_move())
      return;
    present_heights = heights();
    motion->add_work(work_of_obstacles());
  }

  template <int dim> double MembraneModel<dim>::work_of_obstacles() const
  {
    const BodyMotion<dim> &bodies = motion->bodies();
    const double now = part_of_end(parameters.time.scheme);
    la::Vector force(bodies.holding_forces());
    force *= now;
    force.add(1. - now, bodies.holding_forces_before());
    membrane.constraints.set_zero(force);
    double work = 0.;
    for (int i = 0; i < la::n_owned(force); ++i)
    {
      const double f = la::data(force)[i];
      const double way = f > 0. ? present_heights.lower[i] - before.lower[i]
                                : present_heights.upper[i] - before.upper[i];
      work += std::isfinite(way) ? f * way : 0.;
    }
    return dealii::Utilities::MPI::sum(work, run.communicator);
  }

  template <int dim> Message MembraneModel<dim>::commit()
  {
    before = present_heights;
    return MovingModel<dim>::commit();
  }

  template class MembraneModel<2>;
  template class MembraneModel<3>;
} // namespace abut::app
