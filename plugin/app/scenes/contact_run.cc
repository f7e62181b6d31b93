// SPDX-License-Identifier: LGPL-2.1-or-later
// The order of things: meshes, load steps, solves. What is solved is in a
// model.
#include "contact_run.h"

#include "app/adapt/flag_fraction.h"
#include "app/adapt/refine_mesh.h"
#include "app/adapt/simplex_transfer.h"
#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "app/mesh/memory_check.h"
#include "app/restart/restart.h"
#include "diagnosis.h"
#include "method_words.h"
#include "name_parameter.h"
#include "shim/solver_space.h"

#include <deal.II/distributed/grid_refinement.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Level of the smallest cells that a mesh may have: one less than p4est
     * can number, as neighbours are refined along. */
    template <int dim> constexpr int deepest_level = dim == 2 ? 28 : 17;

    /** Sums of forces have some of the digits of each. */
    constexpr double ten_times = 10.;

    /** Forces are 0 if they are less, as a part of the largest that there have
     * been at a node. */
    constexpr double round_off_of_loads = 1e-8;

    /** Part of the forces of all entries of the matrix that no solver lowers
     * residuals beyond. */
    constexpr double round_off_of_forces = 1e-14;

    /** Forces whose squares still are numbers, which norms are made of. */
    constexpr double least_load = 1e-150;
  } // namespace

  template <int dim>
  ContactRun<dim>::ContactRun(ContactRunState<dim> &state,
                              ContactModel<dim> &model)
      : state(state),
        model(model),
        report(state.report),
        mesh_history(model.triangulation)
  {
  }

  template <int dim> void ContactRun<dim>::prepare()
  {
    collective(state.communicator, [&] { model.create_functions(); });
    {
      SectionTimes::Scope scope(report.times, "mesh");
      model.create_mesh();
      model.refine_mesh(state.mesh_number);
    }
    collective(state.communicator, [&] { model.set_data(); });
    model.set_time(state.load_steps.target());
    setup_mesh();
    model.check_setup();
    model.choose_law(state.method);
    state.control.set_law(state.method.options.law);
    state.u = model.start();
  }

  template <int dim> void ContactRun<dim>::setup_mesh()
  {
    // Solvers refer to the matrix that goes away.
    linear_solver.reset();
    state.contact.set_parameters(state.method, state.settings.solver);
    contact_is_ready = false;
    largest_cell.reset();
    model.setup_mesh();
    if (model.has_contact() || !model.problem().is_linear())
      return;
    const DiscreteProblem<dim> &problem = model.problem();
    linear_solver =
        std::make_unique<solve::MaskedSolver>(state.settings.solver);
    linear_solver->set_near_null_space(
        shim::make_solver_space(problem.mapping, problem.dof_handler,
                                problem.constraints, problem.n_components() > 1,
                                state.settings.solver, problem.vertex_origins));
    linear_solver->reinit(problem.stiffness);
  }

  template <int dim> void ContactRun<dim>::check()
  {
    prepare();
    report.print("  " + model.description());
    model.assemble();
    if (model.has_contact())
    {
      state.present.time = state.load_steps.target();
      model.problem().constraints.distribute(state.u);
      begin_contact();
      name_parameter(model, [&] { state.contact.detect(state.u); });
      Message why = free_motion();
      while (!why.empty() && state.contact.search_farther(state.u))
        why = free_motion();
      if (!why.empty())
        throw InputError(model.support_of(why), why);
    }
    model.report_check();
    report_size();
  }

  template <int dim> void ContactRun<dim>::report_size()
  {
    const DiscreteProblem<dim> &problem = model.problem();
    const RefinementParameters &refinement = state.settings.refinement;
    const unsigned int degree = problem.dof_handler.get_fe(0).degree,
                       n_components = problem.n_components(),
                       first = state.mesh_number;
    // Unknowns inside of the cells, and others on surfaces.
    const double n_dofs = double(problem.dof_handler.n_dofs());
    const double inside = double(model.triangulation.n_global_active_cells())
                          * std::pow(degree, dim) * n_components;
    const double finer = std::pow(2., refinement.level - first);
    const double n_last =
        first < refinement.level
            ? inside * std::pow(finer, dim)
                  + std::max(0., n_dofs - inside) * std::pow(finer, dim - 1)
            : n_dofs;
    const double bytes =
        estimated_bytes(dim, n_last / (n_components * std::pow(degree, dim)),
                        degree, n_components);
    report.set("dofs", problem.dof_handler.n_dofs());
    report.set("expected_dofs", n_last);
    report.set("expected_memory_mb", bytes / 1048576.);
    report.print("  unknowns: " + short_number(n_dofs)
                 + (first < refinement.level
                        ? " on the first mesh, about " + short_number(n_last, 3)
                              + " on mesh " + std::to_string(refinement.level)
                        : "")
                 + (refinement.adaptive_cycles > 0
                        ? ", more on adaptive meshes up to number "
                              + std::to_string(refinement.last_mesh())
                        : ""));
    report.print("  memory: about " + short_number(bytes / 1048576., 2)
                 + " MiB; linear systems: "
                 + (state.settings.solver.is_direct(
                        static_cast<unsigned long long>(n_last), n_components)
                        ? "direct solver"
                        : "iterative solver with multigrid"));
  }

  template <int dim> Message ContactRun<dim>::free_motion()
  {
    if (!model.has_contact() || model.has_inertia())
      return "";
    const la::Vector nothing = model.problem().vector();
    la::Vector residual(nothing);
    model.residual(nothing, residual);
    model.problem().constraints.set_zero(residual);
    try
    {
      state.contact.checks().supports(model.problem().tangent(nothing),
                                      residual);
    }
    catch (const SolverFailure &failure)
    {
      return failure.message();
    }
    return "";
  }

  template <int dim> void ContactRun<dim>::solve_start()
  {
    if (!model.has_contact() || !model.begin_start(state.u))
      return;
    state.present = ContactResult();
    state.present.level = state.mesh_number;
    is_starting = true;
    // Without an answer the first step has to find out what touches.
    if (solve_problem(true))
      model.end_start(state.u);
    else
      state.u = model.start();
    is_starting = false;
    // Nothing of it was committed.
    contact_is_ready = false;
  }

  template <int dim> MethodParameters ContactRun<dim>::present_method() const
  {
    const bool loose = !state.is_last_mesh() && !model.has_exact_solution()
                       && !state.settings.all_levels && !state.control.is_on();
    return loose ? state.settings.refinement.loosened(state.method)
                 : state.control.method();
  }

  template <int dim> void ContactRun<dim>::set_parameters()
  {
    state.contact.set_parameters(present_method(), state.settings.solver);
  }

  template <int dim> void ContactRun<dim>::begin_contact()
  {
    SectionTimes::Scope scope(report.times, model.rows_section());
    if (!contact_is_ready)
    {
      set_parameters();
      const DiscreteProblem<dim> &problem = model.problem();
      state.contact.set_vertex_origins(problem.vertex_origins);
      state.contact.reinit(problem.mapping, problem.dof_handler,
                           problem.constraints);
      if (pressure != nullptr)
        state.contact.state().set_pressure(*pressure);
      model.prepare_contact(state.contact);
      contact_is_ready = true;
      if (model.has_inertia())
      {
        // What begins with a displacement has been there all the time.
        model.set_contact(state.contact, state.load_steps.time());
        state.contact.state().set_committed(model.last_place());
      }
      if (is_starting)
      {
        model.set_contact(state.contact, state.load_steps.target());
        state.contact.state().set_slide(model.first_increment());
      }
    }
    model.set_contact(state.contact, state.present.time);
    if (resumed)
      load_contact();
  }

  template <int dim> NewtonParameters ContactRun<dim>::newton_parameters() const
  {
    NewtonParameters parameters = model.newton_parameters();
    parameters.useless_imbalance = 0.; // refuse() knows better what it is
    // What does not converge as usual does not from a bad start.
    constexpr unsigned int usual = 6;
    if (is_extrapolated)
      parameters.max_steps = std::min(
          parameters.max_steps, std::max(usual, 2 * last_step->linearisations));
    const unsigned int sweeps = state.settings.refinement.relaxation_sweeps;
    if (abut_law_needs_open_start(state.method.options.law))
      parameters.relaxation_sweeps = std::max(1u, sweeps);
    else if (model.relaxes() && pressure != nullptr)
      parameters.relaxation_sweeps = sweeps;
    return parameters;
  }

  template <int dim> HostProblem ContactRun<dim>::host_problem()
  {
    HostProblem problem;
    problem.residual = [this](const la::Vector &u, la::Vector &residual)
    { model.residual(u, residual); };
    problem.tangent = [this](const la::Vector &u) -> const la::Matrix &
    { return model.tangent(u); };
    problem.linear = model.problem().is_linear();
    problem.residual_is_cheap = problem.linear;
    return problem;
  }

  template <int dim> SolverEvents ContactRun<dim>::solver_events()
  {
    SolverEvents events;
    events.phase = [this](const SolvePhase phase)
    {
      section.reset();
      // What a search has found is of interest once there is an answer: bodies
      // may be out of reach in the first.
      if (phase == SolvePhase::check)
        model.look_at_rows(state.is_last_mesh());
      if (phase == SolvePhase::solve)
      {
        ++state.n_searches;
        section.emplace(report.times, "solve");
      }
      else if (phase != SolvePhase::end)
        section.emplace(report.times, model.rows_section());
    };
    events.stepped = [this](const LinearReport &cost, const la::Vector &step)
    { note_step(cost, step); };
    events.moved = [this](const NewtonStep &step)
    { steps.add(report, state.present.load_step, state.present.level, step); };
    events.excess = [this](const la::Vector &, const la::Vector &residual)
    { return wants_balance() ? imbalance(residual) / visible_imbalance : 0.; };
    events.refuse = [this](const la::Vector &, const unsigned int search)
    { return refuse(search); };
    events.missed = [this](const std::size_t n_nodes)
    {
      report.detail("  " + std::to_string(n_nodes)
                    + " nodes have penetrated without a constraint: "
                    + "searching again");
    };
    return events;
  }

  template <int dim>
  void ContactRun<dim>::count_layers(const std::int64_t n_active)
  {
    const std::int64_t change = last_active < 0 ? 0 : n_active - last_active;
    last_active = n_active;
    if (change == 0)
      return;
    n_layers = change * direction >= 0 ? n_layers + 1 : 1;
    direction = change;
  }

  template <int dim>
  void ContactRun<dim>::note_step(const LinearReport &cost,
                                  const la::Vector &increment)
  {
    if (is_starting)
      return;
    ContactResult &present = state.present;
    count_layers(state.contact.iteration().progress.n_active);
    present.linear += cost;
    present.steps += cost.n_systems;
    steps.add(report, present.level, present.steps,
              state.contact.iteration().progress, cost);
    if (state.control.is_on())
      state.control.note_step(model.problem().energy_norm(increment),
                              cost.tolerance);
    stop_if_asked();
  }

  /* Without contact Newton's method has looked. Coarser meshes are solved
   * roughly on purpose, and with a target error all are; and not every variant
   * of Nitsche's method balances forces. */
  template <int dim> bool ContactRun<dim>::wants_balance() const
  {
    const MethodParameters &method = state.method;
    return model.has_contact() && state.is_last_mesh()
           && !state.settings.refinement.has_target()
           && !(abut_law_needs_stress(method.options.law)
                && method.nitsche_theta != 0.);
  }

  template <int dim>
  double ContactRun<dim>::imbalance(const la::Vector &residual) const
  {
    // A load that passes zero leaves round-off of those before.
    const double small =
        std::max(model.small_force(), round_off_of_loads * largest_load);
    const ContactChecks<dim> &checks = state.contact.checks();
    const double result = checks.imbalance(residual, small);
    // The first touch of bodies in flight is as soft as chance will have it:
    // what solvers promise is a part of all forces that there are.
    return model.has_inertia() ? std::min(result, checks.imbalance(residual))
                               : result;
  }

  template <int dim> bool ContactRun<dim>::is_balanced(Message &why)
  {
    if (!wants_balance())
      return true;
    la::Vector residual = model.problem().vector();
    model.residual(state.u, residual);
    const ContactChecks<dim> &checks = state.contact.checks();
    const SolvedBy by = {
        !model.problem().is_linear(),
        state.present.linear.method.compare(0, 6, "direct") == 0,
        checks.imbalance(
            residual,
            checks.size_of_forces(model.problem().stiffness, state.u).norm)
            <= round_off_of_forces};
    return diagnose_balance(report, imbalance(residual),
                            state.contact.iteration().progress.penalty, by,
                            why);
  }

  template <int dim> Message ContactRun<dim>::refuse(const unsigned int search)
  {
    Message why = model.refuse();
    if (!why.empty())
      return why;
    const bool is_cold = !state.settings.refinement.nested && search == 1
                         && state.load_steps.n_accepted() == 0
                         && abut_law_solves_once(state.method.options.law);
    diagnose_iteration(report, state.contact.iteration().progress, is_cold,
                       n_layers);
    return is_balanced(why) ? Message() : why;
  }

  template <int dim>
  Message ContactRun<dim>::failure_of(const NewtonResult &result) const
  {
    if (model.has_inertia()
        && result.explanation.failure == ABUT_FAILURE_FLOATING_BODY)
      return coded(ABUT_FAILURE_FLOATING_BODY, inertia_vanishes);
    const IterationReport contact = state.contact.iteration();
    switch (result.reason)
    {
    case NewtonReason::contact:
      return coded(
          contact.failure,
          "The contact iteration ended without a solution after "
              + counted(state.present.steps, "linear system", "linear systems")
              + ": " + contact.explanation + ".");
    case NewtonReason::linear_solve:
      return diagnose_solver_failure(result.explanation,
                                     contact.progress.penalty);
    default:
      return coded(result.explanation.failure, uncoded(result.explanation));
    }
  }

  template <int dim>
  std::string ContactRun<dim>::instability(const abut_failure code) const
  {
    const bool is_nonlinear =
        !model.problem().is_linear() || state.contact.points_move();
    return code == ABUT_FAILURE_CYCLE && is_nonlinear && !model.has_inertia()
               ? " The equilibrium may be unstable from this load on (limit "
                 "point, as in snap-through). Prescribe displacements instead "
                 "of forces, or use a Time stepping/Scheme with inertia."
               : "";
  }

  template <int dim> std::string ContactRun<dim>::time_step() const
  {
    const LoadSteps &steps = state.load_steps;
    return model.has_inertia() ? " That was in the step from time "
                                     + short_number(steps.time(), 6) + " to "
                                     + short_number(steps.target(), 6) + "."
                               : "";
  }

  template <int dim> bool ContactRun<dim>::solve_with_contact()
  {
    if (!model.places_obstacles())
      return solve_at_place();
    // Forces are as good as the linear systems that they come of, or as
    // Newton's method leaves them.
    double tolerance =
        ten_times * present_method().options.final_linear_tolerance;
    if (!model.problem().is_linear() || state.contact.points_move())
      tolerance = std::max(tolerance, model.newton_parameters().tolerance);
    model.begin_places(tolerance);
    using Placing = typename ContactModel<dim>::Placing;
    la::Vector good(state.u);
    for (;;)
    {
      const bool solved = solve_at_place();
      (solved ? good : state.u) = solved ? state.u : good;
      const Placing placing = model.place_obstacles(solved, failure);
      if (placing != Placing::again)
        return placing == Placing::settled;
    }
  }

  /* An obstacle that a step has taken past a surface into a body is no mistake
   * of the scene: a shorter step may keep it out. */
  template <int dim> bool ContactRun<dim>::solve_at_place()
  {
    if (is_starting || !model.has_inertia())
      return solve_contact_problem();
    try
    {
      return solve_contact_problem();
    }
    catch (const InputError &error)
    {
      const bool by_force = error.message().failure == ABUT_FAILURE_WRONG_SIDE
                            && model.places_obstacles();
      if (!by_force && error.message().failure != ABUT_FAILURE_NO_PARTNER)
        throw;
      section.reset();
      // Reports want rows; there are those that the step began with.
      model.set_contact(state.contact, state.load_steps.time());
      name_parameter(model, [&] { state.contact.detect(model.last_place()); });
      failure =
          by_force ? coded(
              ABUT_FAILURE_NO_PARTNER,
              "Within a step forces drive an obstacle through the surface of a "
              "body. Use a smaller Time stepping/Step size, or smaller forces.")
                   : without_pair(error.message());
      return false;
    }
  }

  template <int dim> bool ContactRun<dim>::solve_contact_problem()
  {
    begin_contact();
    last_active = -1;
    direction = 0;
    n_layers = 0;
    ContactSolver<dim> solver(state.contact, model.problem().constraints,
                              host_problem(), newton_parameters(),
                              solver_events());
    NewtonResult result;
    name_parameter(model, [&] { result = solver.solve(state.u); });
    state.n_repeated_searches += std::max(1u, result.n_searches) - 1;
    state.present.linearisations += result.n_steps;
    if (!result.converged())
      failure = failure_of(result);
    return result.converged();
  }

  template <int dim> bool ContactRun<dim>::solve_without_contact()
  {
    SectionTimes::Scope scope(report.times, "solve");
    const DiscreteProblem<dim> &problem = model.problem();
    la::Vector residual = problem.vector();
    problem.constraints.distribute(state.u);
    model.residual(state.u, residual);
    residual *= -1.;
    solve::Mask nothing;
    nothing.held.assign(la::n_owned(state.u), 0);
    la::Vector load(problem.load);
    problem.constraints.set_zero(load);
    la::Vector increment = problem.vector();
    const double tolerance =
        state.control.method().options.final_linear_tolerance;
    try
    {
      state.present.linear += linear_solver->solve(
          nothing, residual, tolerance * load.l2_norm(), increment, true);
    }
    catch (const SolverFailure &error)
    {
      failure = diagnose_solver_failure(error.message(), 0.);
      return false;
    }
    state.u += increment;
    if (state.control.is_on())
      state.control.note_step(problem.energy_norm(increment), tolerance);
    problem.constraints.distribute(state.u);
    ++state.present.steps;
    return true;
  }

  template <int dim>
  bool ContactRun<dim>::solve_problem(const bool has_new_tangent)
  {
    if (has_new_tangent && linear_solver)
      linear_solver->reinit(model.tangent(state.u));
    return model.has_contact() || !model.problem().is_linear()
               ? solve_with_contact()
               : solve_without_contact();
  }

  template <int dim> bool ContactRun<dim>::solve()
  {
    state.present = ContactResult();
    state.present.load_step = state.load_steps.n_accepted() + 1;
    state.present.time = state.load_steps.target();
    state.present.level = state.mesh_number;
    model.assemble();
    bool solved = solve_problem(model.begin_solve(state.u));
    while (solved && model.next_solve(state.u))
      solved = solve_problem(true);
    if (solved || model.reports_failures())
      finish_result();
    return solved;
  }

  template <int dim> std::optional<bool> ContactRun<dim>::follow_target()
  {
    for (;;)
    {
      const ErrorTarget::Step step =
          state.control.next(state.present.progress.penalty);
      if (step == ErrorTarget::Step::stop)
        return true;
      if (step == ErrorTarget::Step::refine)
        break;
      if (model.has_contact())
        pressure = std::make_shared<const la::Vector>(
            state.contact.results().pressure());
      contact_is_ready = false;
      if (!solve())
        return false;
    }
    if (!state.is_last_mesh())
      return {};
    missed_target = state.control.failure();
    return true;
  }

  template <int dim> bool ContactRun<dim>::can_pass_over() const
  {
    constexpr abut_failure of_iterations[] = {
        ABUT_FAILURE_CYCLE,      ABUT_FAILURE_LINEAR_SOLVER,
        ABUT_FAILURE_STEP_LIMIT, ABUT_FAILURE_STICK_SLIP,
        ABUT_FAILURE_NEWTON,     ABUT_FAILURE_PARTNERS};
    const RefinementParameters &levels = state.settings.refinement;
    return model.has_contact() && !model.reports_failures()
           && !state.settings.all_levels && !state.control.is_on()
           && !state.is_last_mesh() && !levels.is_adaptive(state.mesh_number)
           && std::find(std::begin(of_iterations), std::end(of_iterations),
                        failure.failure)
                  != std::end(of_iterations);
  }

  template <int dim> void ContactRun<dim>::begin_anew()
  {
    state.u = model.start();
    contact_is_ready = false;
    pressure.reset();
    solve_start();
  }

  template <int dim> bool ContactRun<dim>::solve_on_hierarchy()
  {
    for (;;)
    {
      if (!solve())
      {
        if (!can_pass_over())
          return false;
        report.detail("mesh " + std::to_string(state.mesh_number + 1)
                      + " has no solution; the next one starts without it: "
                      + failure.text);
        set_refine_flags();
        refine();
        begin_anew();
        continue;
      }
      const std::optional<bool> met =
          state.control.is_on() ? follow_target() : std::optional<bool>();
      if (met)
      {
        model.look_at_rows(true);
        return *met;
      }
      if (state.is_last_mesh())
        return true;
      set_refine_flags();
      if (is_too_fine())
      {
        missed_target = "Cells of level " + std::to_string(deepest_level<dim>)
                        + " cannot be refined further: the error estimate does "
                          "not decrease there. Check for data that jump, or "
                          "use a larger Refinement/Target error.";
        return true;
      }
      if (state.settings.all_levels)
        model.write_fields();
      refine();
      pass();
    }
  }

  template <int dim> void ContactRun<dim>::set_refine_flags()
  {
    SectionTimes::Scope scope(report.times, "mesh");
    const RefinementParameters &levels = state.settings.refinement;
    if (!levels.is_adaptive(state.mesh_number))
    {
      for (const auto &cell : model.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          cell->set_refine_flag();
      return;
    }
    const double fraction = state.control.is_on()
                                ? state.control.refine_fraction()
                                : levels.refine_fraction;
    if (model.has_simplices())
      flag_fraction(state.squared_estimate, fraction, model.triangulation);
    else
      dealii::parallel::distributed::GridRefinement::
          refine_and_coarsen_fixed_fraction(model.adaptive_mesh(),
                                            state.squared_estimate, fraction,
                                            levels.coarsen_fraction);
    // No cell becomes larger than on the first mesh, which the user has chosen
    // for the shape of bodies and for their data.
    const int first = static_cast<int>(levels.first_level());
    for (const auto &cell : model.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->coarsen_flag_set()
          && cell->level() <= first + model.further_levels(cell->material_id()))
        cell->clear_coarsen_flag();
    model.flag_more_cells();
  }

  template <int dim> bool ContactRun<dim>::is_too_fine()
  {
    double largest = 0.;
    for (const auto &cell : model.triangulation.active_cell_iterators())
      largest = std::max(largest, cell->diameter());
    // Of cells without levels sizes tell, as all ranks have all of them.
    const double least = std::ldexp(largest, -deepest_level<dim>);
    bool found = false;
    for (const auto &cell : model.triangulation.active_cell_iterators())
      found =
          found
          || (cell->is_locally_owned() && cell->refine_flag_set()
              && (model.has_simplices() ? cell->diameter() <= least
                                        : cell->level() >= deepest_level<dim>));
    return dealii::Utilities::MPI::logical_or(found, state.communicator);
  }

  template <int dim> void ContactRun<dim>::refine()
  {
    DiscreteProblem<dim> &problem = model.problem();
    check_memory_of_flags(
        model.triangulation, problem.elements[0].degree,
        state.control.is_on() ? "Refinement/Target error"
        : state.settings.refinement.is_adaptive(state.mesh_number)
            ? "Refinement/Adaptive cycles"
            : "Refinement/Level",
        problem.n_components());
    std::vector<la::Vector> fields;
    if (model.has_simplices())
      fields = bisect();
    else
    {
      fields = {problem.ghosted(state.u)};
      if (model.has_contact())
        fields.push_back(
            problem.ghosted_field(state.contact.results().pressure()));
      fields = refine_mesh<dim>(
          model.triangulation, problem.dof_handler, fields,
          [this] { setup_mesh(); }, report.times);
    }
    state.u = fields[0];
    if (model.has_contact())
      pressure = std::make_shared<const la::Vector>(std::move(fields[1]));
    ++state.mesh_number;
    la::Vector start(state.u);
    problem.constraints.distribute(start);
    state.control.begin_mesh(start);
  }

  template <int dim> std::vector<la::Vector> ContactRun<dim>::bisect()
  {
    DiscreteProblem<dim> &problem = model.problem();
    std::vector<la::Vector> fields = {state.u};
    if (model.has_contact())
      fields.push_back(state.contact.results().pressure());
    std::vector<unsigned int> origin;
    std::unique_ptr<SimplexTransfer<dim>> transfer;
    {
      SectionTimes::Scope scope(report.times, "mesh");
      transfer =
          std::make_unique<SimplexTransfer<dim>>(problem.dof_handler, fields);
      origin = model.bisect(gather_flags(model.triangulation));
    }
    setup_mesh();
    SectionTimes::Scope scope(report.times, "transfer");
    return transfer->interpolate(problem.dof_handler, origin);
  }

  template <int dim> bool ContactRun<dim>::is_hard() const
  {
    return !model.problem().is_linear()
           && 2 * state.present.linearisations
                  > model.newton_parameters().max_steps;
  }

  template <int dim> bool ContactRun<dim>::is_written() const
  {
    const LoadSteps &steps = state.load_steps;
    return (steps.n_accepted() + 1) % state.settings.every == 0
           || steps.target() >= state.settings.load_steps.end_time;
  }

  template <int dim> void ContactRun<dim>::roll_back()
  {
    if (!model.has_contact())
      return;
    state.contact.rollback();
    // Nor are the preconditioners of the step that failed kept.
    set_parameters();
  }

  template <int dim> bool ContactRun<dim>::is_nonlinear() const
  {
    return !model.problem().is_linear()
           || (model.has_contact() && state.contact.points_move());
  }

  template <int dim>
  void ContactRun<dim>::note_load_step(const la::Vector &before)
  {
    last_step.reset();
    const LoadSteps &steps = state.load_steps;
    if (!state.settings.extrapolate || model.has_inertia() || !is_nonlinear()
        || steps.target() >= state.settings.load_steps.end_time)
      return;
    last_step = {state.u, steps.target() - steps.time(),
                 state.present.linearisations};
    // The first one may have begun on another mesh.
    last_step->increment -= steps.n_accepted() == 0 ? model.start() : before;
  }

  template <int dim>
  std::optional<la::Vector> ContactRun<dim>::extrapolated() const
  {
    if (!last_step)
      return {};
    // Part of an increment that a prescribed displacement may differ by.
    constexpr double same_direction = 0.5;
    const DiscreteProblem<dim> &problem = model.problem();
    const LoadSteps &steps = state.load_steps;
    la::Vector increment(last_step->increment);
    increment *= (steps.target() - steps.time()) / last_step->length;
    la::Vector result(state.u);
    result += increment;
    la::Vector change(result);
    problem.constraints.distribute(change);
    change -= result;
    if (problem.at_supports(change).linfty_norm()
        > same_direction * problem.at_supports(increment).linfty_norm())
      return {};
    return result;
  }

  template <int dim>
  bool ContactRun<dim>::solve_load_step(const la::Vector &before)
  {
    if (state.load_steps.n_accepted() == 0)
      return solve_on_hierarchy();
    const std::optional<la::Vector> start = extrapolated();
    if (start)
    {
      state.u = *start;
      is_extrapolated = true;
      const bool solved = solve();
      is_extrapolated = false;
      if (solved)
        return true;
      report.detail("no answer from where the last load step leads; again from "
                    "where it has ended");
      state.u = before;
      roll_back();
    }
    return solve();
  }

  template <int dim> bool ContactRun<dim>::take_load_step()
  {
    LoadSteps &load_steps = state.load_steps;
    const la::Vector before(state.u);
    model.set_time(load_steps.target());
    const bool is_first = load_steps.n_accepted() == 0;
    if (solve_load_step(before))
    {
      largest_load = std::max(largest_load, model.problem().load.linfty_norm());
      largest_motion = std::max(largest_motion, state.u.linfty_norm());
      if (is_written())
        model.write_fields();
      if (model.has_contact())
        state.contact.commit(state.u);
      const Message why = model.commit();
      note_load_step(before);
      load_steps.accept(is_hard());
      if (!why.empty())
      {
        report.warn(why);
        return false;
      }
      return examine();
    }
    const abut_failure code = failure.failure;
    const bool floats = code == ABUT_FAILURE_FLOATING_BODY;
    const Message slides =
        model.has_contact() && code != ABUT_FAILURE_FREE_SLIDING
            ? model.sliding()
            : Message();
    const Message moves =
        floats || code == ABUT_FAILURE_NEWTON || code == ABUT_FAILURE_PARTNERS
            ? free_motion()
            : Message();
    // What no row can hold no load step holds either.
    const bool is_hopeless = floats && !moves.empty() && moves.numbers.empty();
    if (!slides.empty() && !is_hopeless)
      failure = slides;
    else if (!moves.empty() && (is_hopeless || !floats))
      failure = moves;
    const std::string where = time_step();
    const bool goes_on = load_steps.reject() && !is_hopeless;
    const bool is_same = failure.text == told;
    if (goes_on)
      report.detail("load step cut back to time "
                    + short_number(load_steps.target(), 6) + ": "
                    + (is_same ? "for the same reason" : failure.text));
    else
    {
      // Perhaps the reason.
      model.look_at_rows(true);
      const bool is_of_matrix = code == ABUT_FAILURE_FLOATING_BODY
                                || code == ABUT_FAILURE_LINEAR_SOLVER;
      report.warn(
          failure + where + instability(code)
          + (is_same && !model.has_inertia() && !is_of_matrix
                 ? " Smaller load steps failed as well; they do not reduce "
                   "loads and motions without t. Multiply such "
                   "formulas by t."
                 : ""));
    }
    told = failure.text;
    if (!goes_on && model.reports_failures())
    {
      model.write_fields();
      return false;
    }
    if (is_first)
    {
      // Nothing was committed: begin again, on the mesh that there is now.
      begin_anew();
      return goes_on;
    }
    state.u = before;
    last_step.reset();
    roll_back();
    return goes_on;
  }

  template <int dim> void ContactRun<dim>::begin()
  {
    model.declare_tables();
    if (state.options.restart != nullptr && state.options.restart->is_resumed())
      restore();
    else
    {
      prepare();
      report.print("  " + model.description() + "; "
                   + std::to_string(model.problem().dof_handler.n_dofs())
                   + " unknowns"
                   + (state.is_last_mesh() ? "" : " on the first mesh"));
      if (state.settings.refinement.adaptive_cycles > 0
          && state.settings.load_steps.steps > 1)
        report.print("  the mesh is adapted to the first load step and kept "
                     "for the others");
      solve_start();
      if (model.has_contact())
        diagnose_penalty(report, state.settings.method);
    }
    mark();
  }

  template <int dim> bool ContactRun<dim>::take_load_steps()
  {
    bool converged = true;
    while (converged && missed_target.empty()
           && !state.load_steps.is_finished())
    {
      converged = take_load_step();
      if (converged && !state.load_steps.is_finished())
        pass();
    }
    return converged;
  }

  template <int dim> Outcome ContactRun<dim>::run()
  {
    begin();
    bool converged = false;
    try
    {
      converged = take_load_steps();
    }
    catch (const Stopped &)
    {
      section.reset();
      return Outcome::stopped;
    }
    steps.write(state.communicator, state.options.output_folder);
    model.finish();
    if (!missed_target.empty())
      report.warn(missed_target);
    const bool has_digits = largest_load == 0. || largest_load > least_load
                            || largest_motion > least_load;
    if (!has_digits)
      report.warn("Forces at nodes are " + short_number(largest_load, 3)
                  + " at most, and squares of such numbers are 0. Choose other "
                    "units of loads and stiffness.");
    for (const BodyMotion &motion : examination.motions)
      report.detail(motion.text);
    for (const ContactFinding &finding : examination.findings)
      report.warn(finding);
    for (const std::string &lost : model.written_numbers().lost())
      report.warn(lost);
    converged =
        converged && missed_target.empty() && has_digits && model.is_usable();
    model.report_result(converged);
    model.report_model();
    return converged ? Outcome::converged : Outcome::unusable;
  }

  template class ContactRun<2>;
  template class ContactRun<3>;
} // namespace abut::app
