// SPDX-License-Identifier: LGPL-2.1-or-later
#include "membrane_model.h"

#include "app/adapt/estimator.h"
#include "app/input/input_error.h"
#include "app/mesh/boundary_parts.h"
#include "app/mesh/memory_check.h"
#include "app/restart/archive.h"
#include "app/scenes/automatic_law.h"
#include "membrane_report.h"

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::app
{
  template <int dim>
  MembraneModel<dim>::MembraneModel(const ObstacleParameters &parameters,
                                    ContactRunState<dim> &run)
      : ContactModel<dim>(run.communicator),
        parameters(parameters),
        run(run),
        membrane(this->triangulation, parameters.degree),
        series(run.options.output_folder, "fields", run.communicator)
  {
  }

  template <int dim> void MembraneModel<dim>::create_mesh()
  {
    app::create_mesh(parameters.mesh, run.options, this->triangulation);
    const double factor =
        std::pow(2., dim * double(parameters.refinement.level));
    check_memory(dim, factor * this->triangulation.n_global_active_cells(),
                 parameters.degree, run.communicator, "Refinement/Level");
  }

  template <int dim> void MembraneModel<dim>::create_functions()
  {
    conductivity = std::make_unique<Expression<dim>>(parameters.conductivity,
                                                     "Membrane/Conductivity");
    load = std::make_unique<Expression<dim>>(parameters.load, "Membrane/Load");
    dirichlet = std::make_unique<BoundaryExpressions<dim>>(
        parameters.dirichlet, "Membrane/Dirichlet");
    neumann = std::make_unique<BoundaryExpressions<dim>>(parameters.neumann,
                                                         "Membrane/Neumann");
    if (!parameters.exact_displacement.empty())
      exact = std::make_unique<ExactSolution<dim>>(
          parameters.exact_displacement, "Exact solution/Displacement",
          parameters.exact_gradient, "Exact solution/Gradient");
  }

  template <int dim> void MembraneModel<dim>::set_data()
  {
    if (exact)
      exact->set_length(half_extent(this->triangulation));
    if (!parameters.boundary_ids.empty())
      contact_ids =
          parse_boundary_ids(parameters.boundary_ids, "Contact/Boundary ids",
                             this->triangulation.get_boundary_ids());

    obstacle.boundary_ids = contact_ids;
    if (!parameters.height_map.file.empty())
      obstacle.lower = std::make_shared<HeightMap<dim>>(
          parameters.height_map,
          run.options.input_file(parameters.height_map.file));
    else if (!parameters.obstacle.empty())
      obstacle.lower = std::make_shared<Expression<dim>>(parameters.obstacle,
                                                         "Contact/Obstacle");
    if (!parameters.upper_obstacle.empty())
      obstacle.upper = std::make_shared<Expression<dim>>(
          parameters.upper_obstacle, "Contact/Upper obstacle");

    data.conductivity = conductivity.get();
    data.load = load.get();
    data.constant_conductivity = conductivity->is_constant();
    data.constant_load = load->is_constant();
    const std::set<dealii::types::boundary_id> prescribed = dirichlet->named();
    const auto refuse_prescribed =
        [&](const auto &ids, const std::string &name, const std::string &what)
    {
      for (const dealii::types::boundary_id id : ids)
        if (prescribed.count(id) > 0)
          throw InputError(name, what + " on boundary " + std::to_string(id)
                                     + " has no effect: Membrane/Dirichlet "
                                       "prescribes the displacement there.");
    };
    // What both lists name themselves is a mistake; their * mean the ids that
    // are left.
    refuse_prescribed(neumann->named(), "Membrane/Neumann", "the flux");
    refuse_prescribed(contact_ids, "Contact/Boundary ids", "contact");
    data.neumann = neumann->functions(this->triangulation, prescribed);
    std::set<dealii::types::boundary_id> taken = contact_ids;
    for (const auto &entry : data.neumann)
      taken.insert(entry.first);
    data.dirichlet = dirichlet->functions(this->triangulation, taken);
  }

  template <int dim> void MembraneModel<dim>::setup_mesh()
  {
    SectionTimes::Scope scope(run.report.times, "unknowns and pattern");
    membrane.renumber = parameters.refinement.renumber;
    membrane.setup(data);
  }

  template <int dim>
  void MembraneModel<dim>::choose_law(MethodParameters &method)
  {
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
    membrane.assemble(data);
  }

  template <int dim>
  void MembraneModel<dim>::set_contact(ContactAssembler<dim> &contact, double)
  {
    contact.set_obstacle(obstacle);
  }

  template <int dim> la::Vector MembraneModel<dim>::held_nodes() const
  {
    la::Vector flags = run.contact.status();
    double *value = la::data(flags);
    for (int i = 0; i < la::n_owned(flags); ++i)
      value[i] = value[i] > 0. ? 1. : 0.;
    flags.compress(dealii::VectorOperation::insert);
    membrane.hanging.distribute(flags);
    value = la::data(flags);
    for (int i = 0; i < la::n_owned(flags); ++i)
      value[i] = value[i] > 0.999 ? 1. : 0.;
    flags.compress(dealii::VectorOperation::insert);
    la::Vector ghosted = membrane.ghosted_field(run.contact.status());
    ghosted = flags;
    return ghosted;
  }

  template <int dim>
  double MembraneModel<dim>::estimate(dealii::Vector<float> &squared) const
  {
    const la::Vector active = held_nodes();
    const la::Vector solution = membrane.ghosted(run.u);
    const la::Vector p = membrane.ghosted_field(run.contact.pressure());
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
    const la::Vector gap = run.contact.gap();
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

  template <int dim>
  std::string MembraneModel<dim>::line_of(const ContactResult &result) const
  {
    return "level " + std::to_string(result.level) + ": "
           + std::to_string(result.dofs) + " unknowns, "
           + std::to_string(result.active) + " in contact, "
           + std::to_string(result.steps) + " steps, "
           + std::to_string(result.linear.n_iterations)
           + " linear iterations, energy " + std::to_string(result.energy);
  }

  template <int dim> void MembraneModel<dim>::declare_tables()
  {
    run.report.declare_columns(
        {"level", "cells", "dofs", "constraints", "active", "steps",
         "linear_iterations", "matvecs", "setups", "energy", "contact_force",
         "penetration", "l2_error", "h1_error", "estimate", "estimated_error",
         "setup_seconds", "krylov_seconds", "seconds"});
  }

  template <int dim> la::Vector MembraneModel<dim>::gaps() const
  {
    la::Vector gap = run.contact.gap();
    const la::Vector status = run.contact.status();
    std::map<dealii::types::global_dof_index, dealii::Point<dim>> points;
    dealii::DoFTools::map_dofs_to_support_points(membrane.mapping,
                                                 membrane.dof_handler, points);
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
    if (!parameters.fields)
      return;
    SectionTimes::Scope scope(run.report.times, "output");
    const la::Vector displacement = membrane.ghosted(run.u);
    const la::Vector p = membrane.ghosted_field(run.contact.pressure());
    const la::Vector g = gaps();
    const la::Vector status = membrane.ghosted_field(run.contact.status());
    Fields<dim> fields{membrane.mapping,
                       membrane.dof_handler,
                       {{"displacement", &displacement},
                        {"pressure", &p},
                        {"gap", &g},
                        {"status", &status}},
                       {}};
    if (run.present.estimate)
      fields.cells = {{"squared_error_estimate", &run.squared_estimate}};
    series.write(run.present.level, fields);
  }

  template <int dim> std::string MembraneModel<dim>::save_state() const
  {
    return to_bytes(series);
  }

  template <int dim>
  void MembraneModel<dim>::load_state(const std::string &bytes)
  {
    from_bytes(bytes, series);
  }

  template <int dim> void MembraneModel<dim>::finish()
  {
    MembraneReport<dim> report(*this);
    if (parameters.nodal_values)
      report.write_nodal_values();
    if (parameters.linear_solves > 0)
      report.compare_with_linear_solves(membrane);
  }

  template <int dim> void MembraneModel<dim>::draw()
  {
    MembraneReport<dim>(*this).draw();
  }

  template <int dim> void MembraneModel<dim>::report_check()
  {
    run.report.set("constraints", run.contact.n_rows());
    for (const BoundaryPart<dim> &part :
         boundary_parts(this->triangulation, run.communicator))
      run.report.progress("boundary " + std::to_string(part.id) + ": "
                          + in_words(part));
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

  template class MembraneModel<2>;
  template class MembraneModel<3>;
} // namespace abut::app
