// SPDX-License-Identifier: LGPL-2.1-or-later
// ContactSolver with a nonlinear material: two blocks of different material and
// mesh, held sideways, pressed together. Strain and stress are uniform in each,
// and follow from one scalar equation. What cannot be solved is told apart.
#include "nonlinear_blocks.h"

#include <abut/dealii/load_steps.h>

#include <functional>

using namespace abut;
using hosts::Blocks;
using hosts::exact_pressure;

namespace
{
  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    if (!holds && hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << std::endl;
    good = good && holds;
  }

  /** The error of the force, and that of the pressure at all nodes. */
  void check_answer(const std::string &law, const double bound)
  {
    Blocks blocks;
    SolverParameters direct;
    direct.linear = SolverParameters::Linear::direct;
    blocks.contact.set_parameters(hosts::method(law, std::nullopt), direct);
    NewtonParameters parameters;
    parameters.tolerance = 1e-8;
    parameters.relaxation_sweeps = law == "barrier" ? 1 : 0;
    ContactSolver<2> solver(blocks.contact, blocks.constraints,
                            blocks.problem(), parameters);
    const NewtonResult result = solver.solve(blocks.u);
    const PairResult<2> pair = blocks.contact.results().pairs()[0];
    const double exact = exact_pressure();
    const double force = std::abs(pair.secondary_force[1]) / exact - 1.;
    const double pressure = pair.pressure / exact - 1.;
    if (hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << law << ": " << result.n_steps << " linearisations, "
                << result.n_systems << " systems, " << result.n_residuals
                << " residuals; error of the force " << force
                << ", of the largest pressure " << pressure << ", estimated "
                << result.error << ", residual " << result.residual
                << std::endl;
    expect(result.converged(), law + ": " + result.explanation);
    expect(std::abs(force) <= bound, law + ": force");
    expect(std::abs(pressure) <= bound, law + ": pressure");
    expect(result.n_steps <= 8, law + ": number of linearisations");
    expect(pair.n_active == pair.n_rows, law + ": all rows in contact");

    // From its own answer there is nothing left to do; a barrier begins with
    // open gaps again.
    if (law == "barrier")
      return;
    const NewtonResult again = solver.solve(blocks.u);
    expect(again.converged() && again.n_steps == 1, law + ": warm start");
  }

  /** A linear problem takes one linearisation and one look at the residual
   * after it, and tells of each system. */
  void check_linear()
  {
    Blocks blocks;
    const HostProblem nonlinear = blocks.problem();
    HostProblem problem = nonlinear;
    const la::Vector zero(blocks.u);
    problem.linear = true;
    problem.residual = [&](const la::Vector &u, la::Vector &r)
    {
      nonlinear.tangent(zero).vmult(r, u);
      // The prescribed values act through the nonlinear residual of u = 0.
      la::Vector prescribed(u);
      prescribed = 0.;
      blocks.constraints.distribute(prescribed);
      la::Vector rest(u);
      rest = 0.;
      nonlinear.residual(prescribed, rest);
      r += rest;
      blocks.constraints.set_zero(r);
    };
    problem.tangent = [&](const la::Vector &)
    { return nonlinear.tangent(zero); };
    unsigned int n_systems = 0;
    problem.monitor = [&](const LinearReport &cost)
    { n_systems += cost.n_systems; };
    const NewtonResult result =
        ContactSolver<2>(blocks.contact, blocks.constraints, problem)
            .solve(blocks.u);
    expect(result.converged() && result.n_steps == 1 && result.n_residuals == 2
               && result.n_systems == n_systems && n_systems > 1,
           "linear problem: " + result.explanation);
  }

  NewtonResult fails(const std::function<void(Blocks &, HostProblem &)> &spoil,
                     const NewtonParameters &parameters = {})
  {
    Blocks blocks;
    HostProblem problem = blocks.problem();
    spoil(blocks, problem);
    return ContactSolver<2>(blocks.contact, blocks.constraints, problem,
                            parameters)
        .solve(blocks.u);
  }

  double norm_of_imbalance(Blocks &blocks, la::Vector &residual,
                           const la::Vector &forces)
  {
    residual -= forces;
    blocks.constraints.set_zero(residual);
    return residual.l2_norm();
  }

  /** A host's own loop, of pieces: the same answer as ContactSolver's. */
  void check_own_loop()
  {
    Blocks blocks;
    const HostProblem problem = blocks.problem();
    ContactAssembler<2> &contact = blocks.contact;
    la::Vector &u = blocks.u;
    la::Vector residual(u), step(u), forces(u);
    blocks.constraints.distribute(u);
    contact.assume_constant_matrix(true);
    contact.detect(u);
    // The y of 7 nodes below and of 9 above: no force acts along the surfaces.
    expect(dealii::Utilities::MPI::sum(
               contact.results().candidate_nodes().n_elements(), MPI_COMM_WORLD)
               == 16,
           "candidates for contact");
    double imbalance = 1., defect = 1.;
    unsigned int n_steps = 0;
    for (; n_steps < 10 && imbalance > 1e-9; ++n_steps)
    {
      residual = 0.;
      problem.residual(u, residual);
      contact.linearise(u, 1e-10);
      contact.solve_linearised(problem.tangent(u), residual, step);
      expect(contact.iteration().reason == ABUT_REASON_CONVERGED,
             "own loop: contact");
      u += step;
      residual = 0.;
      problem.residual(u, residual);
      defect = contact.evaluate(u, forces);
      imbalance = norm_of_imbalance(blocks, residual, forces);
    }
    const double force = contact.results().pairs()[0].secondary_force[1];
    expect(imbalance <= 1e-9 && n_steps <= 8, "own loop: balance of forces");
    expect(defect <= 1e-9, "own loop: defect of the law");
    expect(std::abs(std::abs(force) / exact_pressure() - 1.) <= 1e-7,
           "own loop: force");

    // The forces are those that add_forces() adds; the defect grows as
    // the gap that opens in rows that are held closed.
    la::Vector added(u);
    added = 0.;
    contact.results().add_forces(added);
    added -= forces;
    expect(added.linfty_norm() == 0., "forces of evaluate()");
    const dealii::IndexSet nodes = contact.results().candidate_nodes();
    la::Vector opened(u);
    const auto open_by = [&](const double way)
    {
      opened = u;
      la::Vector push(u);
      push = 0.;
      contact.results().add_forces(push);
      for (const auto dof : nodes)
        opened(dof) += way * (push(dof) > 0. ? 1. : 0.);
      opened.compress(dealii::VectorOperation::add);
      return contact.evaluate(opened, forces);
    };
    const double once = open_by(1e-3), twice = open_by(2e-3);
    expect(once > 1e-4 && std::abs(twice / once - 2.) <= 1e-5,
           "defect of gaps that are not closed");
  }

  /** Depth by pressure of a penalty is the inverse of the stiffness that it is
   * a multiple of: a matrix twice as stiff halves it.
   * @param factor on the tangent at u = 0 as reference; 0: none is named */
  double softness_of_penalty(const double factor)
  {
    Blocks blocks;
    SolverParameters direct;
    direct.linear = SolverParameters::Linear::direct;
    blocks.contact.set_parameters(hosts::method("penalty", std::nullopt),
                                  direct);
    la::Matrix reference;
    la::copy(blocks.problem().tangent(blocks.u).matrix(), reference);
    reference *= factor;
    if (factor > 0.)
      blocks.contact.set_reference_stiffness(reference);
    const NewtonResult result =
        ContactSolver<2>(blocks.contact, blocks.constraints, blocks.problem())
            .solve(blocks.u);
    expect(result.converged(), "penalty: " + result.explanation);
    const PairResult<2> pair = blocks.contact.results().pairs()[0];
    return pair.penetration / pair.pressure;
  }

  void check_scales()
  {
    const double soft = softness_of_penalty(1.);
    expect(std::abs(soft / softness_of_penalty(2.) - 2.) <= 1e-6,
           "reference stiffness");
    // The tangent at the end is several times as stiff as that at the start.
    expect(std::abs(softness_of_penalty(0.) / soft - 1.) <= 1e-6,
           "a penalty is that of the first linearisation");

    // Gaps are closed to a part of the length.
    Blocks blocks;
    const MethodParameters method =
        hosts::method("augmented lagrangian", std::nullopt);
    blocks.contact.set_parameters(method, SolverParameters());
    blocks.contact.set_length_scale(1e-4);
    const NewtonResult result =
        ContactSolver<2>(blocks.contact, blocks.constraints, blocks.problem())
            .solve(blocks.u);
    expect(result.converged()
               && blocks.contact.results().measures().penetration
                      <= 1e-4 * method.options.gap_tolerance,
           "length scale: " + result.explanation);
    expect(blocks.contact.length_scale(blocks.u) == 1e-4,
           "length scale as it was set");
    // Of 8 facets on the side of length 1, or of what has moved less.
    blocks.contact.set_length_scale(0.);
    expect(std::abs(blocks.contact.length_scale(blocks.u) - 0.125) <= 1e-14,
           "length scale of bodies that travel");
    blocks.u *= 1e-3;
    expect(blocks.contact.length_scale(blocks.u) == blocks.u.linfty_norm(),
           "length scale of small displacements");
  }

  /** Phases in their order, and an answer that the host refuses. */
  void check_events()
  {
    Blocks blocks;
    std::string phases;
    unsigned int n_stepped = 0;
    SolverEvents events;
    events.phase = [&](const SolvePhase phase)
    { phases += "dsce"[static_cast<int>(phase)]; };
    events.stepped = [&](const LinearReport &cost, const la::Vector &)
    { n_stepped += cost.n_systems; };
    events.refuse = [](const la::Vector &, const unsigned int search)
    { return "not this one, of search " + std::to_string(search); };
    const NewtonResult result =
        ContactSolver<2>(blocks.contact, blocks.constraints, blocks.problem(),
                         NewtonParameters(), events)
            .solve(blocks.u);
    expect(result.reason == NewtonReason::refused
               && result.explanation.text == "not this one, of search 1",
           "an answer that is refused: " + result.explanation);
    expect(phases == "dsce", "phases: " + phases);
    expect(n_stepped == result.n_systems && n_stepped > 1, "events of systems");
  }

  /** Two load steps of a material that cannot be shortened to nothing: values
   * prescribed at the top, two cells wide each time, come with the increment.
   */
  void check_prescribed_values()
  {
    hosts::BlocksOptions options;
    options.has_limit = true;
    options.top = -hosts::distance;
    Blocks blocks(options);
    ContactSolver<2> solver(blocks.contact, blocks.constraints,
                            blocks.problem());
    for (const double part : {0.5, 1.})
    {
      blocks.move_top(-hosts::distance - part * hosts::shortening);
      const NewtonResult result = solver.solve(blocks.u);
      expect(result.converged() && result.n_steps <= 6,
             "prescribed values: " + result.explanation);
    }
    la::Vector there(blocks.u);
    blocks.constraints.distribute(there);
    there -= blocks.u;
    expect(there.linfty_norm() <= 1e-15, "prescribed values in the answer");
    expect(std::abs(
               std::abs(blocks.contact.results().pairs()[0].secondary_force[1])
                   / exact_pressure()
               - 1.)
               <= 1e-5,
           "prescribed values: force");
  }

  /** Times in eighths: two steps asked for, the first fails twice. */
  void check_load_steps()
  {
    LoadStepOptions options;
    options.steps = 2;
    options.smallest_step = 0.125;
    LoadSteps steps(options);
    expect(steps.target() == 0.5 && steps.reject() && steps.target() == 0.25
               && steps.reject() && steps.target() == 0.125,
           "load steps that are cut back");
    steps.accept();
    expect(steps.target() == 0.25, "load steps that stay short");
    steps.accept();
    expect(steps.target() == 0.5, "load steps that grow again");
    steps.accept();
    steps.accept();
    expect(steps.time() == 0.75 && steps.target() == 1.,
           "load steps that end where they should");
    steps.accept();
    expect(steps.is_finished() && steps.n_accepted() == 5
               && steps.n_rejected() == 2,
           "load steps at the end");
    LoadSteps shortest(options);
    expect(shortest.reject() && shortest.reject() && !shortest.reject(),
           "load steps that are too short");
    options.cut_back = false;
    expect(!LoadSteps(options).reject(), "load steps without cut-back");
  }

  void check_failures()
  {
    NewtonParameters few;
    few.max_steps = 2;
    NewtonResult result = fails([](Blocks &, HostProblem &) {}, few);
    expect(result.reason == NewtonReason::step_limit && result.n_steps == 2
               && result.error > 1e-6,
           "step limit: " + result.explanation);

    result = fails(
        [](Blocks &, HostProblem &problem)
        {
          const auto residual = problem.residual;
          problem.residual = [=](const la::Vector &u, la::Vector &r)
          {
            la::Vector other(u);
            other *= -1.;
            residual(other, r);
          };
        });
    expect(result.reason == NewtonReason::line_search,
           "a tangent of the wrong sign: " + result.explanation);

    result = fails(
        [](Blocks &, HostProblem &problem)
        {
          const auto residual = problem.residual;
          bool first = true;
          problem.residual = [=](const la::Vector &u, la::Vector &r) mutable
          {
            residual(u, r);
            if (!std::exchange(first, false))
              r(*r.locally_owned_elements().begin()) =
                  std::numeric_limits<double>::quiet_NaN();
          };
        });
    expect(result.reason == NewtonReason::not_finite,
           "a residual that is not a number: " + result.explanation);

    result = fails(
        [](Blocks &blocks, HostProblem &)
        {
          MethodParameters method;
          method.options.max_steps = 1;
          blocks.contact.set_parameters(method, SolverParameters());
        });
    expect(result.reason == NewtonReason::contact,
           "one system for each contact problem: " + result.explanation);

    hosts::BlocksOptions unheld;
    unheld.top_is_held = false;
    Blocks floating(unheld);
    HostProblem pulled = floating.problem();
    pulled.residual =
        [&, residual = pulled.residual](const la::Vector &u, la::Vector &r)
    {
      residual(u, r);
      for (int i = 0; i < la::n_owned(r); ++i)
        if (!floating.constraints.is_constrained(r.local_range().first + i))
          la::data(r)[i] -= 1e-3;
    };
    result = ContactSolver<2>(floating.contact, floating.constraints, pulled)
                 .solve(floating.u);
    expect(result.reason == NewtonReason::linear_solve
               && result.explanation.text.find("Bodies without supports")
                      != std::string::npos,
           "a body that nothing holds: " + result.explanation);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_answer("lagrange", 1e-7);
  check_answer("augmented lagrangian", 1e-4);
  check_answer("interior point", 1e-4);
  check_answer("barrier", 1e-4);
  check_linear();
  check_own_loop();
  check_scales();
  check_events();
  check_prescribed_values();
  check_load_steps();
  check_failures();
  return good ? 0 : 1;
}
