// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_run.h"

#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "app/scenes/diagnosis.h"

namespace abut::app
{
  using dealii::types::boundary_id;

  template <int dim>
  SolidRun<dim>::SolidRun(const SolidParameters &parameters,
                          const MethodParameters &method,
                          const SolverParameters &solver,
                          const SearchParameters &search,
                          const RunOptions &options, Report &report)
      : parameters(parameters),
        method(method),
        solver(solver),
        options(options),
        report(report),
        communicator(options.communicator),
        bodies(parameters.bodies),
        triangulation(communicator),
        elasticity(triangulation, parameters.degree),
        contact(communicator),
        load_steps(parameters.load_steps),
        control(parameters.refinement, method),
        series(options.output_folder, "fields", communicator),
        contact_series(options.output_folder, "contact", communicator)
  {
    contact.assume_constant_matrix(true);
    contact.set_search_parameters(search);
    contact.set_axisymmetric(dim == 2
                             && parameters.plane == PlaneModel::axisymmetric);
  }

  template <int dim> void SolidRun<dim>::create_functions()
  {
    functions = std::make_unique<SolidFunctions<dim>>(parameters);
    pairs = std::make_unique<SolidPairs<dim>>(parameters, options);
    if (!parameters.exact_displacement.empty())
      exact = std::make_unique<ExactSolution<dim>>(
          parameters.exact_displacement, "Exact solution/Displacement",
          parameters.exact_gradient, "Exact solution/Gradient", dim);
  }

  template <int dim> void SolidRun<dim>::create_mesh()
  {
    SectionTimes::Scope scope(report.times, "mesh");
    const RefinementParameters &levels = parameters.refinement;
    bodies.create(options, parameters.degree, levels.level, triangulation);
    mesh_number = levels.first_level();
    triangulation.refine_global(mesh_number);
  }

  template <int dim> void SolidRun<dim>::set_data()
  {
    pairs->find_surfaces(bodies);
    data = functions->data(bodies, pairs->surfaces());
  }

  template <int dim> void SolidRun<dim>::check_supports()
  {
    std::map<boundary_id, dealii::ComponentMask> held;
    for (const auto &[id, support] : data.supports)
      held[id] = support.components;
    freedom = rigid_freedom(elasticity.mapping, elasticity.dof_handler,
                            bodies.size(), parameters.plane, held);
    std::set<unsigned int> touched, floating;
    for (const boundary_id id : pairs->surfaces())
      touched.insert(bodies.body_of(id));
    for (unsigned int body = 0; body < bodies.size(); ++body)
    {
      if (freedom[body].n_modes == 0)
        continue;
      floating.insert(body);
      if (touched.count(body) == 0)
        throw InputError(bodies[body].parameter("Support"),
                         coded(ABUT_FAILURE_FLOATING_BODY,
                               "body " + std::to_string(body + 1)
                                   + " is held too little: its supports allow "
                                   + freedom[body].description
                                   + ", and it is in no contact pair."));
    }
    pairs->hold(bodies, floating);
  }

  template <int dim> void SolidRun<dim>::prepare()
  {
    collective(communicator, [&] { create_functions(); });
    create_mesh();
    collective(communicator, [&] { set_data(); });
    functions->set_time(load_steps.target());
    setup_mesh();
    check_supports();
    u = elasticity.vector();
  }

  template <int dim> void SolidRun<dim>::check()
  {
    prepare();
    assemble_load();
    if (!pairs->empty())
    {
      present.time = load_steps.target();
      elasticity.constraints.distribute(u);
      begin_contact();
      detect();
      has_warned = false;
      report_checks();
    }
    report_shares();
    report.set("dofs", elasticity.dof_handler.n_dofs());
    report.set("bodies", bodies.size());
  }

  template <int dim> void SolidRun<dim>::setup_mesh()
  {
    // Solvers refer to the matrix that goes away.
    linear_solver.reset();
    contact.set_parameters(method, solver);
    contact_is_ready = false;
    {
      SectionTimes::Scope scope(report.times, "unknowns and pattern");
      elasticity.renumber = parameters.refinement.renumber;
      elasticity.setup(data);
    }
    SectionTimes::Scope scope(report.times, "assembly");
    elasticity.assemble_stiffness(data);
    if (!pairs->empty())
      return;
    linear_solver = std::make_unique<solve::MaskedSolver>(solver);
    linear_solver->reinit(elasticity.stiffness);
  }

  template <int dim> void SolidRun<dim>::assemble_load()
  {
    SectionTimes::Scope scope(report.times, "assembly");
    elasticity.assemble_load(data);
  }

  template <int dim> void SolidRun<dim>::set_time(const double time)
  {
    functions->set_time(time);
    if (exact)
      exact->set_time(time);
    if (functions->supports_move())
      elasticity.set_supports(data);
  }

  template <int dim> bool SolidRun<dim>::is_last_mesh() const
  {
    return mesh_number >= parameters.refinement.last_mesh();
  }

  template <int dim> bool SolidRun<dim>::solve_without_contact()
  {
    SectionTimes::Scope scope(report.times, "solve");
    la::Vector residual = elasticity.vector();
    elasticity.constraints.distribute(u);
    elasticity.residual(u, residual);
    residual *= -1.;
    solve::Mask nothing;
    nothing.held.assign(la::n_owned(u), 0);
    la::Vector load(elasticity.load);
    elasticity.constraints.set_zero(load);
    la::Vector increment = elasticity.vector();
    const double tolerance = control.method().options.final_linear_tolerance;
    const LinearReport linear = linear_solver->solve(
        nothing, residual, tolerance * load.l2_norm(), increment, true);
    u += increment;
    if (control.is_on())
      control.note_step(elasticity.energy_norm(increment), tolerance);
    elasticity.constraints.distribute(u);
    present.linear += linear;
    ++present.steps;
    return true;
  }

  template <int dim> bool SolidRun<dim>::solve()
  {
    present = SolidState();
    present.load_step = load_steps.n_accepted + 1;
    present.time = load_steps.target();
    present.level = mesh_number;
    assemble_load();
    try
    {
      return pairs->empty() ? solve_without_contact() : solve_with_contact();
    }
    catch (const SolverFailure &error)
    {
      failure = diagnose_solver_failure(
          error.what(), pairs->empty() ? 0. : contact.progress().penalty);
      return false;
    }
  }

  template <int dim> std::optional<bool> SolidRun<dim>::follow_target()
  {
    for (;;)
    {
      const ErrorTarget::Step step = control.next(present.progress.penalty);
      if (step == ErrorTarget::Step::stop)
        return true;
      if (step == ErrorTarget::Step::refine)
        break;
      if (!pairs->empty())
        pressure = contact.pressure();
      contact_is_ready = false;
      if (!solve())
        return false;
      finish_state();
    }
    if (!is_last_mesh())
      return {};
    target_is_missed = true;
    return true;
  }

  template <int dim> bool SolidRun<dim>::solve_on_hierarchy()
  {
    while (solve())
    {
      finish_state();
      const std::optional<bool> met =
          control.is_on() ? follow_target() : std::optional<bool>();
      if (met)
        return *met;
      if (is_last_mesh())
        return true;
      if (parameters.all_levels)
        write_fields();
      refine();
    }
    return false;
  }

  template <int dim> double SolidRun<dim>::counted_seconds() const
  {
    return report.times.seconds("assembly") + report.times.seconds("transfer")
           + report.times.seconds("solve");
  }

  template <int dim> Outcome SolidRun<dim>::run()
  {
    prepare();
    declare_tables();
    if (!pairs->empty())
      diagnose_penalty(report, method);
    bool goes_on = true;
    while (goes_on && !target_is_missed && !load_steps.is_finished())
    {
      const la::Vector before(u);
      set_time(load_steps.target());
      const bool first = load_steps.n_accepted == 0;
      const bool solved = first ? solve_on_hierarchy() : solve();
      if (solved)
      {
        if (!first)
          finish_state();
        write_fields();
        if (!pairs->empty())
          pressure = contact.pressure();
        load_steps.accept();
        continue;
      }
      u = first ? elasticity.vector() : before;
      contact_is_ready = false;
      if (first)
        pressure.clear();
      goes_on = load_steps.reject();
      if (goes_on)
        report.progress("load step cut back to time "
                        + short_number(load_steps.target(), 6) + ": "
                        + failure);
      else
        report.warn(failure);
    }
    steps.write(communicator, options.output_folder);
    if (options.pictures && !states.empty())
      draw();
    if (target_is_missed)
      report.warn(control.failure());
    goes_on = goes_on && !target_is_missed;
    report_result(goes_on);
    report_model();
    return goes_on ? Outcome::converged : Outcome::unusable;
  }

  template class SolidRun<2>;
  template class SolidRun<3>;
} // namespace abut::app
