// SPDX-License-Identifier: LGPL-2.1-or-later
// A rigid ball pressed into an elasto-plastic cube: material, mesh and load of
// deal.II's tutorial program step-42, contact and the nonlinear iteration from
// Abut. Only the headers of Abut are needed to build it; the plugin is loaded
// when the program runs.
//
//     elasto-plastic PLUGIN [cycles] [options]
//       --cold        start each mesh from zero instead of the last solution
//       --tight       solve all linear systems to 1e-8
//       --fresh       make a new preconditioner for each linear system
//       --tolerance T error of the displacement at which Newton's method ends
//       --friction MU the ball comes from 0.05 aside, with Coulomb friction
#include "stress.h"

#include <abut/dealii/contact_solver.h>
#include <abut/dealii/distribute.h>
#include <abut/dealii/load_plugin.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/timer.h>
#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/error_estimator.h>
#include <deal.II/numerics/vector_tools.h>

#include <iostream>

using namespace dealii;
namespace la = abut::la;

namespace
{
  struct Settings
  {
    std::string plugin;
    unsigned int n_cycles = 3;
    bool cold = false, tight = false, fresh = false;
    double tolerance = 1e-6, friction = 0.;
  };

  /** The lower side of a ball of radius 0.6, pressed 0.01 into the cube. */
  class Ball : public Function<3>
  {
  public:
    double value(const Point<3> &p, const unsigned int = 0) const override
    {
      const double squared =
          0.36 - (p[0] - 0.5) * (p[0] - 0.5) - (p[1] - 0.5) * (p[1] - 0.5);
      return squared > 0. ? 1.59 - std::sqrt(squared) : 1000.;
    }
  };
} // namespace

class Indentation
{
public:
  explicit Indentation(const Settings &settings);
  void run();

private:
  void make_mesh();
  void set_contact();
  void setup();
  void assemble(const la::Vector &u, la::Matrix *matrix, la::Vector *residual);
  void solve();
  void refine();
  void report(unsigned int cycle) const;
  la::Vector with_ghosts(const la::Vector &vector) const;

  const Settings settings;
  parallel::distributed::Triangulation<3> triangulation;
  const FESystem<3> fe;
  const MappingQ<3> mapping;
  DoFHandler<3> dof_handler;
  IndexSet owned, relevant;
  AffineConstraints<double> constraints;
  la::Matrix tangent;
  la::Vector u, pressure;
  const PlasticMaterial material = PlasticMaterial();
  abut::Registry<3> registry;
  std::unique_ptr<abut::ContactAssembler<3>> contact;
  abut::NewtonResult result;
  TimerOutput timer;
};

Indentation::Indentation(const Settings &settings)
    : settings(settings),
      triangulation(MPI_COMM_WORLD),
      fe(FE_Q<3>(1), 3),
      mapping(1),
      dof_handler(triangulation),
      timer(MPI_COMM_WORLD, std::cout, TimerOutput::never,
            TimerOutput::cpu_times)
{
}

void
Indentation::make_mesh()
{
  GridGenerator::hyper_cube(triangulation, 0., 1., true);
  triangulation.refine_global(3);
}

void
Indentation::set_contact()
{
  abut::load_plugin(settings.plugin, registry);
  contact = registry.create("lagrange", MPI_COMM_WORLD);
  abut::HeightObstacle<3> height;
  height.height = std::make_shared<Ball>();
  height.axis = 2;
  height.material_above = true;
  abut::ContactPair<3> pair;
  pair.name = "cube under ball";
  pair.secondary = {5};
  pair.obstacle = registry.make_obstacle(height);
  if (settings.friction > 0.)
  {
    const auto friction = std::make_shared<abut::Friction<3>>();
    friction->coefficient = [mu = settings.friction](const Point<3> &)
    { return mu; };
    pair.friction = friction;
    // The ball comes from aside.
    pair.first_pose = pair.obstacle->pose();
    pair.first_pose->translation[0] -= 0.05;
  }
  contact->set_pairs({pair});
}

void
Indentation::setup()
{
  const TimerOutput::Scope scope(timer, "unknowns and pattern");
  dof_handler.distribute_dofs(fe);
  owned = dof_handler.locally_owned_dofs();
  relevant = DoFTools::extract_locally_relevant_dofs(dof_handler);
  abut::versions::reinit(constraints, owned, relevant);
  DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  const Functions::ZeroFunction<3> zero(3);
  VectorTools::interpolate_boundary_values(mapping, dof_handler, 4, zero,
                                           constraints);
  for (const types::boundary_id side : {0, 1, 2, 3})
    VectorTools::interpolate_boundary_values(
        mapping, dof_handler, side, zero, constraints,
        ComponentMask(std::vector<bool>{true, true, false}));
  constraints.close();
  DynamicSparsityPattern pattern(relevant);
  DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
  SparsityTools::distribute_sparsity_pattern(pattern, owned, MPI_COMM_WORLD,
                                             relevant);
  tangent.reinit(owned, owned, pattern, MPI_COMM_WORLD);
  u.reinit(owned, MPI_COMM_WORLD);
  pressure.reinit(owned, MPI_COMM_WORLD);
}

/** Internal forces at u, their derivative, or both. */
void
Indentation::assemble(const la::Vector &u, la::Matrix *matrix,
                      la::Vector *residual)
{
  const TimerOutput::Scope scope(timer,
                                 matrix ? "tangent" : "residual seconds");
  const FiniteElement<3> &scalar = fe.base_element(0);
  const QGauss<3> quadrature(fe.degree + 1);
  FEValues<3> values(mapping, scalar, quadrature,
                     update_gradients | update_JxW_values);
  const unsigned int n_nodes = scalar.n_dofs_per_cell(), n = 3 * n_nodes;
  FullMatrix<double> cell_matrix(n, n);
  Vector<double> cell_residual(n);
  std::vector<types::global_dof_index> dofs(n);
  std::vector<Tensor<1, 3>> node_u(n_nodes), gradient(n_nodes);
  const la::Vector ghosted = with_ghosts(u);
  std::vector<std::array<unsigned int, 3>> numbers(n_nodes);
  for (unsigned int i = 0; i < n; ++i)
    numbers[fe.system_to_component_index(i).second]
           [fe.system_to_component_index(i).first] = i;
  const auto place = [&](const unsigned int a, const unsigned int c)
  { return numbers[a][c]; };
  if (matrix)
    *matrix = 0.;
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    values.reinit(Triangulation<3>::cell_iterator(cell));
    cell->get_dof_indices(dofs);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        node_u[a][c] = ghosted(dofs[place(a, c)]);
    cell_matrix = 0.;
    cell_residual = 0.;
    for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      Tensor<2, 3> grad_u;
      for (unsigned int a = 0; a < n_nodes; ++a)
      {
        gradient[a] = values.shape_grad(a, q);
        grad_u += outer_product(node_u[a], gradient[a]);
      }
      const PlasticMaterial::Point point =
          material.evaluate(symmetrize(grad_u));
      const double dx = values.JxW(q);
      if (residual)
        for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const Tensor<1, 3> force = point.stress * gradient[a] * dx;
          for (unsigned int c = 0; c < 3; ++c)
            cell_residual(place(a, c)) += force[c];
        }
      if (matrix)
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int b = 0; b <= a; ++b)
          {
            const Tensor<2, 3> k =
                material.stiffness(point, gradient[a], gradient[b]) * dx;
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                cell_matrix(place(a, c), place(b, d)) += k[c][d];
          }
    }
    if (matrix)
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < a; ++b)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              cell_matrix(place(b, d), place(a, c)) =
                  cell_matrix(place(a, c), place(b, d));
      constraints.distribute_local_to_global(cell_matrix, dofs, *matrix);
    }
    if (residual)
      abut::versions::distribute_local_to_global(constraints, cell_residual,
                                                 dofs, *residual);
  }
  if (matrix)
    matrix->compress(VectorOperation::add);
  if (residual)
  {
    residual->compress(VectorOperation::add);
    constraints.set_zero(*residual);
  }
}

void
Indentation::solve()
{
  const TimerOutput::Scope scope(timer, "solve");
  contact->reinit(mapping, dof_handler, constraints);
  contact->state().set_pressure(pressure);
  abut::HostProblem problem;
  problem.residual = [&](const la::Vector &at, la::Vector &residual)
  { assemble(at, nullptr, &residual); };
  problem.tangent = [&](const la::Vector &at) -> const la::Matrix &
  {
    assemble(at, &tangent, nullptr);
    return tangent;
  };
  abut::NewtonParameters parameters;
  parameters.tolerance = settings.tolerance;
  if (settings.tight)
    parameters.linear_tolerance = 1e-8;
  abut::ContactSolver<3> solver(*contact, constraints, problem, parameters);
  contact->assume_constant_matrix(!settings.fresh);
  result = solver.solve(u);
  AssertThrow(result.converged(), ExcMessage(result.explanation));
  pressure = contact->results().pressure();
}

void
Indentation::refine()
{
  const TimerOutput::Scope scope(timer, "refinement");
  const la::Vector old_u = with_ghosts(u), old_pressure = with_ghosts(pressure);
  Vector<float> error(triangulation.n_active_cells());
  KellyErrorEstimator<3>::estimate(mapping, dof_handler,
                                   QGauss<2>(fe.degree + 2), {}, old_u, error);
  // Symmetric cells have equal errors: without this, round-off would choose
  // between those at the limit.
  for (float &e : error)
  {
    const double digit = std::pow(10., std::floor(std::log10(e)) - 2.);
    e = static_cast<float>(std::round(e / digit) * digit);
  }
  parallel::distributed::GridRefinement::refine_and_coarsen_fixed_number(
      triangulation, error, 0.3, 0.03);
  triangulation.prepare_coarsening_and_refinement();
  abut::versions::SolutionTransfer<3, la::Vector> transfer(dof_handler);
  transfer.prepare_for_coarsening_and_refinement(
      std::vector<const la::Vector *>{&old_u, &old_pressure});
  triangulation.execute_coarsening_and_refinement();
  setup();
  std::vector<la::Vector *> both = {&u, &pressure};
  transfer.interpolate(both);
  if (settings.cold)
  {
    u = 0.;
    pressure = 0.;
  }
}

void
Indentation::report(const unsigned int cycle) const
{
  const abut::PairResult<3> pair = contact->results().pairs()[0];
  const double gap = contact->results().measures().complementarity;
  auto times = timer.get_summary_data(TimerOutput::total_cpu_time);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return;
  std::cout << "{\"cycle\": " << cycle
            << ", \"cells\": " << triangulation.n_global_active_cells()
            << ", \"dofs\": " << dof_handler.n_dofs()
            << ", \"active\": " << pair.n_active
            << ", \"force\": " << std::setprecision(10)
            << -pair.secondary_force[2]
            << ", \"friction\": " << pair.friction_force
            << ", \"slipping\": " << pair.n_slipping << std::setprecision(4)
            << ", \"penetration\": " << pair.penetration
            << ", \"complementarity\": " << gap
            << ", \"residual\": " << result.residual
            << ", \"error\": " << result.error
            << ", \"steps\": " << result.n_steps
            << ", \"systems\": " << result.n_systems
            << ", \"linear_iterations\": " << result.linear.n_iterations
            << ", \"setups\": " << result.linear.n_setups
            << ", \"residuals\": " << result.n_residuals
            << ", \"setup_seconds\": " << result.linear.setup_seconds
            << ", \"solve_seconds\": " << result.linear.solve_seconds;
  for (const auto &[name, seconds] : times)
    std::cout << ", \"" << name << "\": " << seconds;
  std::cout << "}" << std::endl;
}

la::Vector
Indentation::with_ghosts(const la::Vector &vector) const
{
  la::Vector result(owned, relevant, MPI_COMM_WORLD);
  result = vector;
  return result;
}

void
Indentation::run()
{
  set_contact();
  make_mesh();
  setup();
  for (unsigned int cycle = 0; cycle < settings.n_cycles; ++cycle)
  {
    if (cycle > 0)
    {
      timer.reset();
      refine();
    }
    solve();
    report(cycle);
  }
}

int
main(int argc, char **argv)
{
  // deal.II starts PETSc too, which would take our words for its own.
  int n_names = 1;
  char *name[] = {argv[0], nullptr};
  char **names = name;
  const Utilities::MPI::MPI_InitFinalize mpi(n_names, names, 1);
  Settings settings;
  const std::vector<std::string> words(argv + 1, argv + argc);
  AssertThrow(!words.empty(), ExcMessage("elasto-plastic PLUGIN [cycles]"));
  settings.plugin = words[0];
  for (std::size_t i = 1; i < words.size(); ++i)
    if (words[i] == "--cold")
      settings.cold = true;
    else if (words[i] == "--tight")
      settings.tight = true;
    else if (words[i] == "--fresh")
      settings.fresh = true;
    else if (words[i] == "--friction" && i + 1 < words.size())
      settings.friction = std::stod(words[++i]);
    else if (words[i] == "--tolerance" && i + 1 < words.size())
      settings.tolerance = std::stod(words[++i]);
    else
      settings.n_cycles = std::stoi(words[i]);
  Indentation(settings).run();
}
