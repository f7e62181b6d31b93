// SPDX-License-Identifier: LGPL-2.1-or-later
// What takes the place of step-41's functions solve(),
// update_solution_and_constraints() and run(): contact from Abut.
namespace Step41
{
  template <int dim> void ObstacleProblem<dim>::run()
  {
    make_grid();
    setup_system();
    assemble_system();

    abut::Obstacle<dim> obstacle;
    obstacle.lower = std::make_shared<Obstacle<dim>>();
    contact.set_obstacle(obstacle);
    contact.assume_constant_matrix(true);
    contact.reinit(mapping, dof_handler, constraints);
    contact.detect(solution);

    TrilinosWrappers::MPI::Vector residual(solution), increment(solution);
    unsigned int n_steps = 0;
    do
    {
      system_matrix.vmult(residual, solution);
      residual -= system_rhs;
      contact.solve(system_matrix, residual, increment);
      solution += increment;
      ++n_steps;
    } while (contact.update(solution));
    std::cout << std::setprecision(12) << n_steps
              << " steps, size of active set: "
              << contact.results().measures().n_active
              << ", contact force: " << contact.results().measures().force
              << ", unknowns: " << dof_handler.n_dofs() << ". "
              << contact.iteration().explanation << std::endl;

    const TrilinosWrappers::MPI::Vector status = contact.results().status();
    for (unsigned int i = 0; i < dof_handler.n_dofs(); ++i)
      if (status(i) == 1.)
        active_set.add_index(i);
    contact_force = contact.results().pressure();
    output_results(0);
  }
} // namespace Step41
