// SPDX-License-Identifier: LGPL-2.1-or-later
// A deal.II program with a time loop of its own: an elastic bar flies against a
// wall. Mesh, stiffness and mass are the program's; the scheme's coefficients
// and updates come from abut/time.h, contact from ContactSolver. HHT with the
// consistent mass, E = 900, density 1, length 10 in 50 elements, velocity -10,
// the wall 5 away, time step h / c; discrete values of this very scheme by two
// other programs.
#include <abut/dealii/contact_solver.h>
#include <abut/dealii/rigid_obstacle.h>
#include <abut/time.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <iostream>

using namespace abut;

namespace
{
  constexpr int dim = 2;
  constexpr double young = 900., velocity = -10., distance = 5.;

  struct Bar
  {
    Bar();
    void assemble();
    void fly(unsigned int n_steps, double dt);
    double energy() const;
    la::Vector vector() const
    {
      return la::Vector(dof_handler.locally_owned_dofs(), MPI_COMM_WORLD);
    }

    dealii::parallel::distributed::Triangulation<dim> triangulation;
    dealii::FESystem<dim> fe;
    dealii::MappingQ<dim> mapping;
    dealii::DoFHandler<dim> dof_handler;
    dealii::AffineConstraints<double> constraints;
    la::Matrix stiffness, mass, tangent;
    la::Vector u, v, a;
    ContactAssembler<dim> contact;
    double impulse = 0.;
    unsigned int last_contact = 0; ///< step
  };

  Bar::Bar()
      : triangulation(MPI_COMM_WORLD),
        fe(dealii::FE_Q<dim>(1), dim),
        mapping(1),
        dof_handler(triangulation),
        contact(MPI_COMM_WORLD)
  {
    dealii::GridGenerator::subdivided_hyper_rectangle(
        triangulation, {50, 1}, dealii::Point<dim>(), {10., 1.}, true);
    dof_handler.distribute_dofs(fe);
    constraints.close();
    u = v = a = vector();
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int vertex : cell->vertex_indices())
          if (const auto dof = cell->vertex_dof_index(vertex, 0);
              dof_handler.locally_owned_dofs().is_element(dof))
            v(dof) = velocity;
    v.compress(dealii::VectorOperation::insert);
    assemble();

    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    shape.dimension = dim;
    shape.kind = ABUT_OBSTACLE_PLANE;
    shape.point[0] = -distance;
    shape.axis[0] = 1.;
    shape.axis[1] = shape.axis[2] = 0.;
    ContactPair<dim> pair;
    pair.name = "bar on wall";
    pair.secondary = {0};
    pair.obstacle = std::make_shared<RigidObstacle<dim>>(shape);
    pair.may_be_apart = true;
    contact.set_pairs({pair});
    MethodParameters method;
    method.options.final_linear_tolerance = 1e-12;
    contact.set_parameters(method, SolverParameters());
    contact.reinit(mapping, dof_handler, constraints);
  }

  /** Stress is E strain: Poisson's ratio is 0. */
  void Bar::assemble()
  {
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    dealii::DynamicSparsityPattern pattern(relevant);
    dealii::DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints,
                                            false);
    dealii::SparsityTools::distribute_sparsity_pattern(
        pattern, owned, MPI_COMM_WORLD, relevant);
    for (la::Matrix *matrix : {&stiffness, &mass, &tangent})
      matrix->reinit(owned, owned, pattern, MPI_COMM_WORLD);
    const dealii::QGauss<dim> quadrature(2);
    dealii::FEValues<dim> values(mapping, fe, quadrature,
                                 dealii::update_values
                                     | dealii::update_gradients
                                     | dealii::update_JxW_values);
    const dealii::FEValuesExtractors::Vector all(0);
    const unsigned int n = fe.n_dofs_per_cell();
    dealii::FullMatrix<double> k(n, n), m(n, n);
    std::vector<dealii::types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      values.reinit(cell);
      k = m = 0.;
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
          {
            k(i, j) += young * values.JxW(q)
                       * (values[all].symmetric_gradient(i, q)
                          * values[all].symmetric_gradient(j, q));
            m(i, j) += values.JxW(q)
                       * (values[all].value(i, q) * values[all].value(j, q));
          }
      cell->get_dof_indices(dofs);
      constraints.distribute_local_to_global(k, dofs, stiffness);
      constraints.distribute_local_to_global(m, dofs, mass);
    }
    stiffness.compress(dealii::VectorOperation::add);
    mass.compress(dealii::VectorOperation::add);
  }

  /** The time loop. */
  void Bar::fly(const unsigned int n_steps, const double dt)
  {
    abut_time_scheme scheme;
    abut_time_scheme_make(nullptr, &scheme); // hht, alpha -0.1
    abut_time_weights weights;
    abut_time_weigh(&scheme, dt, ABUT_TIME_STEP, &weights);
    tangent = 0.;
    tangent.add(weights.stiffness, stiffness);
    tangent.add(weights.mass, mass);
    contact.set_reference_stiffness(stiffness); // penalties without inertia
    la::Vector inertia = vector(), elastic = vector(), force = vector();
    for (unsigned int step = 1; step <= n_steps; ++step)
    {
      const abut_time_state state = {sizeof(state),  &scheme,     dt,
                                     la::n_owned(u), la::data(u), la::data(v),
                                     la::data(a),    nullptr};
      la::Vector next = vector();
      abut_time_begin(&state, la::data(next));
      HostProblem problem;
      problem.linear = true;
      problem.tangent = [&](const la::Vector &) -> const la::Matrix &
      { return tangent; };
      problem.residual = [&](const la::Vector &w, la::Vector &residual)
      {
        const abut_time_arguments arguments = {
            sizeof(arguments), la::data(inertia), nullptr, la::data(elastic)};
        abut_time_evaluate(&state, la::data(w), &arguments);
        stiffness.vmult(residual, elastic);
        mass.vmult_add(residual, inertia);
      };
      NewtonParameters parameters;
      parameters.useless_imbalance = 0.; // in flight all forces are round-off
      ContactSolver<dim> solver(contact, constraints, problem, parameters);
      const NewtonResult result = solver.solve(next);
      AssertThrow(result.converged(), dealii::ExcMessage(result.explanation));
      contact.commit(next);
      abut_time_end(&state, la::data(next)); // u, v, a are those of now
      force = 0.;
      contact.results().add_forces(force);
      const double pressing = force.mean_value() * double(force.size());
      impulse += dt * pressing;
      last_contact = pressing > 1e-7 ? step : last_contact;
    }
  }

  double Bar::energy() const
  {
    la::Vector product = vector();
    mass.vmult(product, v);
    double twice = product * v;
    stiffness.vmult(product, u);
    twice += product * u;
    return 0.5 * twice;
  }

  bool is(const double value, const double expected, const double relative,
          const char *const what)
  {
    const bool good = std::abs(value / expected - 1.) <= relative;
    if (!good && dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << ": " << value << " instead of "
                << expected << std::endl;
    return good;
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Bar bar;
  bool good = is(bar.energy(), 500., 1e-12, "energy at the start");
  bar.fly(300, 1. / 150.);
  good = is(bar.energy(), 486.5982833, 1e-7, "energy at the end") && good;
  good = is(bar.impulse, 197.53624841, 1e-7, "impulse") && good;
  good = is(bar.last_contact, 176., 0., "last step in contact") && good;
  return good ? 0 : 1;
}
