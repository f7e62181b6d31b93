// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_run.h"

#include "app/adapt/estimator.h"
#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "app/mesh/memory_check.h"
#include "app/report/result_row.h"
#include "app/scenes/automatic_law.h"
#include "app/scenes/diagnosis.h"

#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/distributed/solution_transfer.h>

#include <cmath>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  template <int dim>
  ObstacleRun<dim>::ObstacleRun(const ObstacleParameters &parameters,
                                const MethodParameters &method,
                                const SolverParameters &solver,
                                const RunOptions &options, Report &report)
      : parameters(parameters),
        method(method),
        solver(solver),
        options(options),
        report(report),
        communicator(options.communicator),
        triangulation(communicator),
        membrane(triangulation, parameters.degree),
        contact(communicator),
        control(parameters.refinement, method),
        series(options.output_folder, "fields", communicator)
  {
    contact.assume_constant_matrix(true);
  }

  template <int dim> void ObstacleRun<dim>::create_coarse_mesh()
  {
    SectionTimes::Scope scope(report.times, "mesh");
    create_mesh(parameters.mesh, options, triangulation);
    const double factor =
        std::pow(2., dim * double(parameters.refinement.level));
    check_memory(dim, factor * triangulation.n_global_active_cells(),
                 parameters.degree, communicator, "Refinement/Level");
    triangulation.refine_global(parameters.refinement.first_level());
  }

  template <int dim> void ObstacleRun<dim>::create_functions()
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

  template <int dim> void ObstacleRun<dim>::set_obstacle()
  {
    if (!parameters.boundary_ids.empty())
      contact_ids =
          parse_boundary_ids(parameters.boundary_ids, "Contact/Boundary ids",
                             triangulation.get_boundary_ids());

    Obstacle<dim> obstacle;
    obstacle.boundary_ids = contact_ids;
    if (!parameters.height_map.file.empty())
      obstacle.lower = std::make_shared<HeightMap<dim>>(
          parameters.height_map,
          options.input_file(parameters.height_map.file));
    else if (!parameters.obstacle.empty())
      obstacle.lower = std::make_shared<Expression<dim>>(parameters.obstacle,
                                                         "Contact/Obstacle");
    if (!parameters.upper_obstacle.empty())
      obstacle.upper = std::make_shared<Expression<dim>>(
          parameters.upper_obstacle, "Contact/Upper obstacle");
    contact.set_obstacle(obstacle);

    data.conductivity = conductivity.get();
    data.load = load.get();
    data.constant_conductivity = conductivity->is_constant();
    data.constant_load = load->is_constant();
    data.neumann = neumann->functions(triangulation);
    std::set<dealii::types::boundary_id> taken = contact_ids;
    for (const auto &entry : data.neumann)
      taken.insert(entry.first);
    data.dirichlet = dirichlet->functions(triangulation, taken);
  }

  template <int dim> void ObstacleRun<dim>::check()
  {
    collective(communicator, [&] { create_functions(); });
    create_coarse_mesh();
    collective(communicator, [&] { set_obstacle(); });
    setup_level();
    choose_law();
    contact.set_parameters(method, solver);
    contact.reinit(membrane.mapping, membrane.dof_handler,
                   membrane.constraints);
    u = membrane.vector();
    membrane.constraints.distribute(u);
    try
    {
      contact.detect(u);
    }
    catch (const ObstacleError &error)
    {
      throw InputError("Contact/Obstacle", error.what());
    }
    report.set("dofs", membrane.dof_handler.n_dofs());
    report.set("constraints", contact.n_rows());
  }

  template <int dim> void ObstacleRun<dim>::setup_level()
  {
    SectionTimes::Scope scope(report.times, "unknowns and pattern");
    membrane.renumber = parameters.refinement.renumber;
    membrane.setup(data);
  }

  template <int dim> void ObstacleRun<dim>::choose_law()
  {
    const double nodes = double(membrane.dof_handler.n_dofs());
    choose_law_of_membrane(method, !parameters.refinement.nested,
                           contact_ids.empty() ? std::pow(nodes, 1. / dim)
                                               : 0.);
    control.set_law(method.options.law);
    if (method.law_is_automatic)
      report.model("automatic law", true, method.options.law->name);
  }

  template <int dim> void ObstacleRun<dim>::assemble()
  {
    SectionTimes::Scope scope(report.times, "assembly");
    membrane.assemble(data);
  }

  template <int dim> void ObstacleRun<dim>::estimate()
  {
    SectionTimes::Scope scope(report.times, "error estimate");
    la::Vector active = membrane.ghosted_field(contact.status());
    {
      // Held are nodes in contact, and hanging nodes between two of them.
      la::Vector flags = contact.status();
      double *value = la::data(flags);
      for (int i = 0; i < la::n_owned(flags); ++i)
        value[i] = value[i] > 0. ? 1. : 0.;
      flags.compress(dealii::VectorOperation::insert);
      membrane.hanging.distribute(flags);
      value = la::data(flags);
      for (int i = 0; i < la::n_owned(flags); ++i)
        value[i] = value[i] > 0.999 ? 1. : 0.;
      flags.compress(dealii::VectorOperation::insert);
      active = flags;
    }
    const la::Vector solution = membrane.ghosted(u);
    const la::Vector p = membrane.ghosted_field(contact.pressure());
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
    present.estimate = estimate_error(input, squared_estimate);
  }

  template <int dim> void ObstacleRun<dim>::refine(const bool adaptive)
  {
    using Transfer =
        dealii::parallel::distributed::SolutionTransfer<dim, la::Vector>;
    const la::Vector u_old = membrane.ghosted(u);
    const la::Vector p_old = membrane.ghosted_field(contact.pressure());
    Transfer transfer(membrane.dof_handler);
    {
      SectionTimes::Scope scope(report.times, "mesh");
      if (adaptive)
        dealii::parallel::distributed::GridRefinement::
            refine_and_coarsen_fixed_fraction(
                triangulation, squared_estimate,
                control.is_on() ? control.refine_fraction()
                                : parameters.refinement.refine_fraction,
                parameters.refinement.coarsen_fraction);
      else
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            cell->set_refine_flag();
      triangulation.prepare_coarsening_and_refinement();
      if (control.is_on())
        check_memory_of_flags(triangulation, parameters.degree,
                              "Refinement/Target error");
      transfer.prepare_for_coarsening_and_refinement(
          std::vector<const la::Vector *>{&u_old, &p_old});
      triangulation.execute_coarsening_and_refinement();
    }
    setup_level();
    {
      SectionTimes::Scope scope(report.times, "transfer");
      u = membrane.vector();
      pressure = membrane.vector();
      std::vector<la::Vector *> result = {&u, &pressure};
      transfer.interpolate(result);
      membrane.constraints.distribute(u);
    }
    control.begin_mesh(u);
  }

  template <int dim> void ObstacleRun<dim>::set_tolerance(const bool last)
  {
    const bool loose = !last && !exact && !parameters.all_levels;
    contact.set_parameters(loose && !control.is_on()
                               ? parameters.refinement.loosened(method)
                               : control.method(),
                           solver);
  }

  template <int dim>
  void ObstacleRun<dim>::prepare_start(const bool warm, la::Vector &residual)
  {
    SectionTimes::Scope scope(report.times, "contact rows and start");
    if (!warm)
    {
      u = membrane.vector();
      membrane.constraints.distribute(u);
    }
    contact.reinit(membrane.mapping, membrane.dof_handler,
                   membrane.constraints);
    if (warm)
      contact.set_pressure(pressure);
    try
    {
      contact.detect(u);
    }
    catch (const ObstacleError &error)
    {
      throw InputError("Contact/Obstacle", error.what());
    }
    const bool feasible = abut_law_needs_open_start(method.options.law);
    if (feasible || (warm && parameters.refinement.relaxation_sweeps > 0))
    {
      membrane.residual(u, residual);
      contact.relax(membrane.stiffness, residual,
                    parameters.refinement.relaxation_sweeps, u);
    }
  }

  template <int dim>
  void ObstacleRun<dim>::record_step(const LinearReport &linear)
  {
    present.linear += linear;
    present.steps += linear.n_systems;
    steps.add(report, present.level, present.steps, contact.progress(), linear);
  }

  template <int dim> void ObstacleRun<dim>::iterate(la::Vector &residual)
  {
    SectionTimes::Scope scope(report.times, "solve");
    la::Vector increment = membrane.vector();
    bool go_on = true;
    while (go_on)
    {
      membrane.residual(u, residual);
      const LinearReport linear =
          contact.solve(membrane.stiffness, residual, increment);
      u += increment;
      go_on = contact.update(u);
      record_step(linear);
      if (control.is_on())
        control.note_step(membrane.energy_norm(increment), linear.tolerance);
    }
    membrane.constraints.distribute(u);
  }

  template <int dim> bool ObstacleRun<dim>::solve_level(const bool warm)
  {
    assemble();
    la::Vector residual = membrane.vector();
    prepare_start(warm, residual);
    try
    {
      iterate(residual);
    }
    catch (const SolverFailure &failure)
    {
      report.warn(
          diagnose_solver_failure(failure.what(), contact.progress().penalty));
      return false;
    }
    present.reason = contact.reason();
    if (present.reason == ABUT_REASON_CONVERGED)
      diagnose_iteration(report, contact.progress(),
                         !parameters.refinement.nested
                             && abut_law_solves_once(method.options.law));
    else
      report.warn(coded(contact.failure(),
                        "The contact iteration ended without an answer after "
                            + std::to_string(present.steps)
                            + " steps: " + contact.explanation()));
    return present.reason == ABUT_REASON_CONVERGED && is_balanced();
  }

  template <int dim> bool ObstacleRun<dim>::is_balanced()
  {
    // Coarser meshes are solved roughly on purpose, and with a target error
    // all are.
    if (present.level != parameters.refinement.last_mesh()
        || parameters.refinement.has_target())
      return true;
    la::Vector residual = membrane.vector();
    membrane.residual(u, residual);
    std::string failure;
    if (diagnose_balance(
            report, contact.imbalance(residual, 1e-4 * membrane.load.l2_norm()),
            contact.progress().penalty, failure))
      return true;
    report.warn(failure);
    return false;
  }

  template <int dim> double ObstacleRun<dim>::energy() const
  {
    if (membrane.constraints.has_inhomogeneities())
      return membrane_energy(membrane.mapping, membrane.dof_handler,
                             membrane.ghosted(u), *load, conductivity.get(),
                             data.neumann);
    // Without prescribed values the assembled system has it.
    la::Vector free(u), internal(u);
    membrane.constraints.set_zero(free);
    membrane.stiffness.vmult(internal, free);
    internal.sadd(0.5, -1., membrane.load);
    return internal * free;
  }

  template <int dim> double ObstacleRun<dim>::solution_norm() const
  {
    const dealii::Functions::ZeroFunction<dim> no_load;
    return std::sqrt(2.
                     * membrane_energy(membrane.mapping, membrane.dof_handler,
                                       membrane.ghosted(u), no_load,
                                       conductivity.get()));
  }

  template <int dim> void ObstacleRun<dim>::judge()
  {
    if (!control.is_on())
      return;
    MeshEvidence evidence;
    evidence.residual = *present.estimate;
    evidence.law = contact.complementarity_error();
    if (control.start().size() > 0)
    {
      la::Vector change(u);
      change -= control.start();
      evidence.change = membrane.energy_norm(change);
    }
    evidence.norm = solution_norm();
    evidence.contact_force = contact.contact_force();
    present.error_parts = control.judge(evidence);
  }

  template <int dim> double ObstacleRun<dim>::counted_seconds() const
  {
    return report.times.seconds("assembly") + report.times.seconds("transfer")
           + report.times.seconds("contact rows and start")
           + report.times.seconds("solve");
  }

  template <int dim>
  void ObstacleRun<dim>::finish_level(const unsigned int number)
  {
    const double counted = counted_seconds();
    present.seconds = counted - counted_before;
    counted_before = counted;
    SectionTimes::Scope scope(report.times, "results");
    present.cells = triangulation.n_global_active_cells();
    present.dofs = membrane.dof_handler.n_dofs();
    present.rows = contact.n_rows();
    present.active = contact.n_active();
    present.progress = contact.progress();
    present.energy = energy();
    present.force = contact.contact_force();
    if (exact)
      present.errors = error_norms(membrane.mapping, membrane.dof_handler,
                                   membrane.ghosted(u), *exact);
    std::map<std::string, double> row = result_row(present);
    row["level"] = number;
    row["penetration"] = contact.penetration();
    report.add_row(row);
    levels.push_back(present);
    report.add("nonlinear_iterations", present.steps);
    report.add("linear_iterations", present.linear.n_iterations);
    report.add("matvecs", present.linear.n_matvecs);
    report.progress("level " + std::to_string(number) + ": "
                    + std::to_string(present.dofs) + " unknowns, "
                    + std::to_string(present.active) + " in contact, "
                    + std::to_string(present.steps) + " steps, "
                    + std::to_string(present.linear.n_iterations)
                    + " linear iterations, energy "
                    + std::to_string(present.energy) + control.progress());
  }

  template <int dim>
  bool ObstacleRun<dim>::go_on(unsigned int &number, bool &warm)
  {
    const unsigned int last = parameters.refinement.last_mesh();
    if (control.is_on())
      switch (control.next(contact.progress().penalty))
      {
      case ErrorTarget::Step::stop:
        return false;
      case ErrorTarget::Step::refine:
        break;
      case ErrorTarget::Step::tighten_law:
      case ErrorTarget::Step::tighten_solver:
        pressure = contact.pressure();
        warm = true;
        return true;
      }
    if (number == last)
      return false;
    if (parameters.all_levels)
      write_fields();
    ++number;
    refine(number > parameters.refinement.level);
    warm = true;
    return true;
  }

  template <int dim> bool ObstacleRun<dim>::solve_on_hierarchy()
  {
    unsigned int number = parameters.refinement.first_level();
    bool warm = false;
    do
    {
      present = ObstacleLevel();
      present.level = number;
      set_tolerance(number == parameters.refinement.last_mesh());
      const bool converged = solve_level(warm);
      if (parameters.refinement.is_adaptive(number))
        estimate();
      judge();
      finish_level(number);
      if (!converged)
        return false;
    } while (go_on(number, warm));
    if (!control.is_on() || control.is_met())
      return true;
    report.warn(control.failure());
    return false;
  }

  template <int dim> Outcome ObstacleRun<dim>::run()
  {
    collective(communicator, [&] { create_functions(); });
    create_coarse_mesh();
    collective(communicator, [&] { set_obstacle(); });
    declare_tables();
    diagnose_penalty(report, method);
    setup_level();
    choose_law();

    const bool converged = solve_on_hierarchy();
    write_fields();
    steps.write(communicator, options.output_folder);
    if (parameters.nodal_values)
      write_nodal_values();
    if (parameters.linear_solves > 0)
      compare_with_linear_solves();
    if (options.pictures)
      draw();
    report_result(levels.back(), converged);
    report_model();
    return converged ? Outcome::converged : Outcome::unusable;
  }

  template class ObstacleRun<2>;
  template class ObstacleRun<3>;
} // namespace abut::app
