// SPDX-License-Identifier: LGPL-2.1-or-later
// A host without a matrix (elastic_blocks.h), whose own multigrid preconditions
// contact: the same answers as from the assembled matrix, which Abut factorises
// or preconditions itself; and the exact ones where they are known.
#include "elastic_blocks.h"
#include "expect.h"
#include "jacobi_host.h"

#include <abut/dealii/contact_solver.h>
#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/timer.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <string>

using namespace abut;
using hosts::BlockCase;
using hosts::ElasticBlocks;
namespace block_side = hosts::block_side;

namespace
{
  using hosts::expect;
  using hosts::is_first_rank;

  void expect_at_most(const double value, const double bound,
                      const std::string &what)
  {
    expect(value <= bound, what + " is " + std::to_string(value)
                               + ", allowed are " + std::to_string(bound));
  }

  template <int dim> struct Answer
  {
    la::Vector displacement;
    double force = 0.;
    std::int64_t n_active = 0;
    LinearReport cost;
  };

  template <int dim>
  Answer<dim> answer_of(ContactAssembler<dim> &contact, const la::Vector &u,
                        const LinearReport &cost)
  {
    Answer<dim> result{u, contact.results().measures().force,
                       contact.iteration().progress.n_active, cost};
    expect(contact.iteration().reason == ABUT_REASON_CONVERGED,
           "converged: " + contact.iteration().explanation);
    return result;
  }

  /** The loop of doc/your-program.md. */
  template <int dim>
  Answer<dim> press(const ElasticBlocks<dim> &blocks,
                    const ContactPair<dim> &pair, const Tangent &tangent,
                    const MethodParameters &method = {},
                    const SolverParameters &solver = {})
  {
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    contact.set_parameters(method, solver);
    contact.set_pairs({pair});
    contact.assume_constant_matrix(true);
    contact.reinit(blocks.mapping, blocks.dof_handler, blocks.constraints);
    la::Vector u = blocks.start(), residual(u), increment(u);
    contact.detect(u);
    LinearReport cost;
    do
    {
      blocks.residual(u, residual);
      cost += contact.solve(tangent, residual, increment);
      u += increment;
      blocks.constraints.distribute(u);
    } while (contact.update(u));
    return answer_of(contact, u, cost);
  }

  /** The same by ContactSolver. */
  template <int dim>
  Answer<dim> solve(const ElasticBlocks<dim> &blocks,
                    const ContactPair<dim> &pair)
  {
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    contact.set_pairs({pair});
    HostProblem problem;
    problem.residual = [&](const la::Vector &u, la::Vector &residual)
    { blocks.residual(u, residual); };
    problem.tangent = [&](const la::Vector &) -> HostOperator &
    { return *blocks.stiffness; };
    problem.linear = true;
    contact.reinit(blocks.mapping, blocks.dof_handler, blocks.constraints);
    ContactSolver<dim> solver(contact, blocks.constraints, problem);
    la::Vector u = blocks.start();
    const NewtonResult result = solver.solve(u);
    expect(result.converged(), "ContactSolver: " + result.explanation);
    return answer_of(contact, u, result.linear);
  }

  /** Of two answers, relative. */
  template <int dim>
  void expect_equal(const Answer<dim> &answer, const Answer<dim> &other,
                    const std::string &name)
  {
    la::Vector difference(answer.displacement);
    difference -= other.displacement;
    expect_at_most(difference.linfty_norm(),
                   1e-7 * other.displacement.linfty_norm(),
                   name + ", difference of displacements");
    expect_at_most(std::abs(answer.force - other.force), 1e-7 * other.force,
                   name + ", of forces");
    expect(answer.n_active == other.n_active,
           name + ", " + std::to_string(answer.n_active) + " and "
               + std::to_string(other.n_active) + " in contact");
    expect(other.n_active > 0, name + ", some are in contact");
  }

  template <int dim> ContactPair<dim> blocks_on_each_other()
  {
    ContactPair<dim> pair;
    pair.name = "blocks";
    pair.secondary = {block_side::upper_interface};
    pair.primary = {block_side::lower_interface};
    return pair;
  }

  /** A rigid paraboloid above the lower block, pressed into it. */
  template <int dim> ContactPair<dim> bump(const bool along_axis)
  {
    HeightObstacle<dim> height;
    const std::string x = dim == 2 ? "(x-0.5)^2" : "(x-0.5)^2+(y-0.4)^2";
    height.height = std::make_shared<dealii::FunctionParser<dim>>(
        "0.98+" + x, "", dim == 2 ? "x,y" : "x,y,z", 1e-6);
    height.material_above = true;
    height.along_axis = along_axis;
    ContactPair<dim> pair;
    pair.name = "bump";
    pair.secondary = {block_side::lower_interface};
    pair.obstacle = std::make_shared<RigidObstacle<dim>>(height);
    return pair;
  }

  MethodParameters with_law(const std::string &law)
  {
    MethodParameters method;
    method.options.law = abut_law_find(law.c_str());
    return method;
  }

  BlockCase two_blocks(const unsigned int n_refinements)
  {
    BlockCase run;
    run.cells = {2, 3};
    run.n_refinements = n_refinements;
    return run;
  }

  template <int dim> void move_top(ElasticBlocks<dim> &blocks)
  {
    dealii::Tensor<1, dim> way;
    way[dim - 1] = -0.01;
    blocks.move(block_side::top, way);
  }

  /** Without lateral strain the stress is uniform: springs in a row. */
  template <int dim> void patch()
  {
    BlockCase run = two_blocks(1);
    run.materials = {{0., 2.}, {0., 1.}};
    ElasticBlocks<dim> blocks(run);
    move_top(blocks);
    const Answer<dim> answer =
        press(blocks, blocks_on_each_other<dim>(), *blocks.stiffness);
    const double exact = 0.01 / (1. / 4. + 1. / 2.);
    const std::string name = "patch in " + std::to_string(dim) + "D";
    expect_at_most(std::abs(answer.force - exact), 1e-9 * exact,
                   name + ", error of the force");
  }

  template <int dim>
  void compare(const ElasticBlocks<dim> &blocks, const ContactPair<dim> &pair,
               const std::string &law, const std::string &name)
  {
    la::Matrix matrix;
    la::Vector unused;
    blocks.assemble(matrix, unused);
    const MethodParameters method = with_law(law);
    const Answer<dim> answer = press(blocks, pair, *blocks.stiffness, method);
    expect_equal(answer, press(blocks, pair, matrix, method), name);
    if (is_first_rank())
      std::cout << name << ", " << matrix.m()
                << " unknowns: " << answer.cost.n_iterations
                << " iterations for " << answer.cost.n_systems << " systems, "
                << answer.cost.method << std::endl;
    if (law == "lagrange" && pair.friction == nullptr)
      expect_equal(solve(blocks, pair), answer, name + ", ContactSolver");
  }

  template <int dim> void compare_all()
  {
    const std::string in = " in " + std::to_string(dim) + "D";
    ElasticBlocks<dim> two(two_blocks(dim == 2 ? 2 : 1));
    move_top(two);
    ContactPair<dim> pair = blocks_on_each_other<dim>();
    for (const std::string law :
         {"lagrange", "penalty", "augmented lagrangian"})
      compare(two, pair, law, law + ", blocks" + in);
    auto friction = std::make_shared<Friction<dim>>();
    friction->coefficient = [](const dealii::Point<dim> &) { return 0.2; };
    pair.friction = friction;
    compare(two, pair, "lagrange", "friction, blocks" + in);

    BlockCase run;
    run.n_refinements = 2;
    run.fixed = {block_side::bottom};
    const ElasticBlocks<dim> one(run);
    compare(one, bump<dim>(true), "lagrange", "bump along an axis" + in);
    compare(one, bump<dim>(false), "lagrange", "bump" + in);
    compare(one, bump<dim>(false), "interior point",
            "bump, interior point" + in);
  }

  /** Iterations of the last of all systems, which is solved to the end. */
  template <int dim>
  unsigned int n_iterations(const ContactPair<dim> &pair, const bool heeds,
                            const unsigned int n_refinements)
  {
    BlockCase run;
    run.fixed = {block_side::bottom};
    run.heeds_holding = heeds;
    run.n_refinements = n_refinements;
    const ElasticBlocks<dim> blocks(run);
    const Answer<dim> answer = press(blocks, pair, *blocks.stiffness);
    return answer.cost.n_iterations;
  }

  /** A preconditioner that holds what contact holds does not get slower with
   * finer meshes. */
  void holding()
  {
    for (unsigned int l = 2; l < 5; ++l)
    {
      const unsigned int heeds = n_iterations(bump<2>(true), true, l),
                         ignores = n_iterations(bump<2>(true), false, l);
      if (is_first_rank())
        std::cout << "level " << l << ": " << heeds << " iterations, "
                  << ignores << " if what is held is ignored" << std::endl;
      expect(heeds < ignores, "holding helps");
      expect_at_most(heeds, 18, "iterations with what is held");
    }
  }

  /** Laplace's operator of all cells. */
  void assemble_laplacian(const dealii::DoFHandler<2> &dof_handler,
                          const dealii::AffineConstraints<double> &constraints,
                          const std::function<double(double)> &force,
                          la::Matrix &matrix, la::Vector &load)
  {
    const dealii::QGauss<2> rule(2);
    dealii::FEValues<2> values(dof_handler.get_fe(), rule,
                               dealii::update_values | dealii::update_gradients
                                   | dealii::update_quadrature_points
                                   | dealii::update_JxW_values);
    const unsigned int n = values.dofs_per_cell;
    std::vector<dealii::types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      values.reinit(cell);
      dealii::FullMatrix<double> cell_matrix(n, n);
      dealii::Vector<double> cell_load(n);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int i = 0; i < n; ++i)
        {
          cell_load(i) += values.shape_value(i, q) * values.JxW(q)
                          * force(values.quadrature_point(q)[0]);
          for (unsigned int j = 0; j < n; ++j)
            cell_matrix(i, j) += values.shape_grad(i, q)
                                 * values.shape_grad(j, q) * values.JxW(q);
        }
      cell->get_dof_indices(dofs);
      constraints.distribute_local_to_global(cell_matrix, dofs, matrix);
      abut::versions::distribute_local_to_global(constraints, cell_load, dofs,
                                                 load);
    }
    matrix.compress(dealii::VectorOperation::add);
    load.compress(dealii::VectorOperation::add);
  }

  /** A membrane between two obstacles, each of which it is pressed on. */
  void membrane()
  {
    dealii::parallel::distributed::Triangulation<2> mesh(MPI_COMM_WORLD);
    dealii::GridGenerator::hyper_cube(mesh, 0., 1., true);
    mesh.refine_global(4);
    const dealii::FE_Q<2> fe(1);
    dealii::DoFHandler<2> dof_handler(mesh);
    dof_handler.distribute_dofs(fe);
    const dealii::MappingQ<2> mapping(1);
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    dealii::AffineConstraints<double> constraints;
    abut::versions::reinit(constraints, dof_handler.locally_owned_dofs(),
                           relevant);
    for (const dealii::types::boundary_id side : {0, 1})
      dealii::VectorTools::interpolate_boundary_values(
          mapping, dof_handler, side,
          dealii::Functions::ConstantFunction<2>(0.3 * side), constraints);
    constraints.close();
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    dealii::DynamicSparsityPattern pattern(relevant);
    dealii::DoFTools::make_sparsity_pattern(dof_handler, pattern);
    dealii::SparsityTools::distribute_sparsity_pattern(
        pattern, owned, MPI_COMM_WORLD, relevant);
    la::Matrix whole, matrix;
    whole.reinit(owned, owned, pattern, MPI_COMM_WORLD);
    matrix.reinit(owned, owned, pattern, MPI_COMM_WORLD);
    la::Vector load(owned, MPI_COMM_WORLD), unused(load);
    const auto force = [](const double x) { return -40. * std::cos(3. * x); };
    dealii::AffineConstraints<double> none;
    abut::versions::reinit(none, dof_handler.locally_owned_dofs(), relevant);
    none.close();
    assemble_laplacian(dof_handler, none, force, whole, load);
    assemble_laplacian(dof_handler, constraints, force, matrix, unused);

    Obstacle<2> obstacle;
    obstacle.lower =
        std::make_shared<dealii::Functions::ConstantFunction<2>>(-0.2);
    obstacle.upper =
        std::make_shared<dealii::Functions::ConstantFunction<2>>(0.4);
    tests::JacobiHost host(matrix);
    const auto solve_with = [&](const Tangent &tangent)
    {
      ContactAssembler<2> contact(MPI_COMM_WORLD);
      contact.set_obstacle(obstacle);
      contact.reinit(mapping, dof_handler, constraints);
      la::Vector u(load), residual(load), increment(load);
      u = 0.;
      constraints.distribute(u);
      contact.detect(u);
      LinearReport cost;
      do
      {
        whole.vmult(residual, u);
        residual -= load;
        constraints.set_zero(residual);
        cost += contact.solve(tangent, residual, increment);
        u += increment;
      } while (contact.update(u));
      return answer_of(contact, u, cost);
    };
    expect_equal(solve_with(host), solve_with(matrix), "membrane");
  }

  template <typename Function>
  void expect_error(const std::string &words, const Function &function)
  {
    std::string message = "nothing was thrown";
    try
    {
      function();
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    expect(message.find(words) != std::string::npos,
           "'" + words + "' is said, not: " + message);
  }

  /** Products that forget what is prescribed. */
  class Forgetful : public hosts::ElasticOperator<2>
  {
  public:
    using ElasticOperator::ElasticOperator;

    void vmult(la::Vector &dst, const la::Vector &src) const override
    {
      multiply(dst, src);
    }
  };

  void errors()
  {
    ElasticBlocks<2> blocks(two_blocks(1));
    move_top(blocks);
    HostOperator &host = *blocks.stiffness;
    const ContactPair<2> pair = blocks_on_each_other<2>();
    const auto expect_need = [&](const std::string &what,
                                 const MethodParameters &method,
                                 const SolverParameters &solver = {})
    {
      expect_error(what + " needs the matrix",
                   [&] { press(blocks, pair, host, method, solver); });
    };
    MethodParameters method;
    method.system = System::saddle_point;
    expect_need("Method/System = saddle point", method);
    method = MethodParameters();
    method.kinematics = ABUT_KINEMATICS_CURRENT;
    expect_need("Contact with Method/Contact geometry = current", method);
    SolverParameters solver;
    solver.linear = SolverParameters::Linear::direct;
    expect_need("Solver/Linear solver = direct", {}, solver);

    BlockCase run = two_blocks(1);
    Forgetful forgetful(blocks.mapping, blocks.dof_handler, blocks.constraints,
                        run.materials, false);
    expect_error("displacements of prescribed ones",
                 [&] { press(blocks, pair, forgetful); });

    run.fixed = {block_side::bottom};
    ElasticBlocks<2> loose(run);
    expect_error("Bodies without supports",
                 [&] { press(loose, pair, *loose.stiffness); });
  }
} // namespace

namespace
{
  /** A line of doc/develop/solvers.md: iterations and seconds with the
   * operator, which heeds what is held or not, and with the matrix. */
  template <int dim>
  void print_line(BlockCase run, const ContactPair<dim> &pair,
                  const std::string &name)
  {
    std::ostringstream text;
    for (const bool heeds : {true, false})
    {
      run.heeds_holding = heeds;
      ElasticBlocks<dim> blocks(run);
      if (run.cells.size() > 1)
        move_top(blocks);
      dealii::Timer timer;
      Answer<dim> answer = press(blocks, pair, *blocks.stiffness);
      text << " | " << answer.cost.n_iterations << " in "
           << answer.cost.n_systems << " | " << timer.wall_time();
      if (heeds)
        continue;
      la::Matrix matrix;
      la::Vector unused;
      timer.restart();
      blocks.assemble(matrix, unused);
      const double assembly = timer.wall_time();
      timer.restart();
      SolverParameters solver;
      solver.linear = SolverParameters::Linear::geometric;
      answer = press(blocks, pair, matrix, {}, solver);
      text << " | " << answer.cost.n_iterations << " in "
           << answer.cost.n_systems << " | " << timer.wall_time() << " + "
           << assembly;
      std::cout << "| " << name << " | " << matrix.m() << text.str() << " |"
                << std::endl;
    }
  }

  void print_table(const unsigned int finest)
  {
    for (unsigned int l = 1; l <= finest; ++l)
    {
      BlockCase one;
      one.fixed = {block_side::bottom};
      one.n_refinements = l;
      for (const unsigned int degree : {1, 2})
      {
        one.degree = degree;
        const std::string q = "Q" + std::to_string(degree);
        print_line<3>(one, bump<3>(true), q + ", rows of single unknowns");
        print_line<3>(one, bump<3>(false), q + ", normals of the obstacle");
        BlockCase two = two_blocks(l - 1);
        two.degree = degree;
        print_line<3>(two, blocks_on_each_other<3>(), q + ", two blocks");
      }
    }
  }
} // namespace

/** Without an argument the tests; with a number, the table to that level. */
int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc > 1)
  {
    print_table(std::stoi(argv[1]));
    return 0;
  }
  patch<2>();
  patch<3>();
  compare_all<2>();
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    compare_all<3>();
  holding();
  membrane();
  errors();
  return hosts::good ? 0 : 1;
}
