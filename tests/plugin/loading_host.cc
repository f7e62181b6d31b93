// SPDX-License-Identifier: LGPL-2.1-or-later
/* A deal.II program that knows Abut by its headers only. It is given the
 * plugin and parameters of the contact method on the command line:
 *
 *     loading_host PLUGIN... ["Method/Enforcement=penalty"]...
 *
 * or "method=by hand" for parameters from C++ instead of a ParameterHandler. It
 * takes the first plugin that fits; a line on the standard error output tells
 * why another did not. With "cycles=N" all is done N times, with a refined mesh
 * as well, and the memory that the last nine tenths have left behind is shown.
 *
 * An elastic block of width 2 and height 1 stands on a rigid plane without
 * friction, and its top is moved down by 0.01. In plane strain its vertical
 * stress is E / (1 - nu^2) * 0.01, and its displacement is linear, so that the
 * contact force is known. Exit code: 1 failed, 2 no plugin that fits. */
#include <abut/dealii/load_plugin.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <malloc.h>
#include <optional>

using namespace dealii;
namespace la = abut::la;

namespace
{
  constexpr int dim = 2;
  constexpr double young = 7., poisson = 0.3, shortening = 0.01, width = 2.;
  enum Side
  {
    left = 0,
    bottom = 2,
    top = 3
  };

  class Block
  {
  public:
    Block()
        : triangulation(MPI_COMM_WORLD),
          fe(FE_Q<dim>(1), dim),
          mapping(1),
          dof_handler(triangulation)
    {
      GridGenerator::subdivided_hyper_rectangle(triangulation, {8, 4},
                                                Point<dim>(0., 0.),
                                                Point<dim>(width, 1.), true);
      set_up();
    }

    /** Smaller cells at the floor. */
    void refine()
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary(bottom)
            && cell->center()[0] < 0.5 * width)
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
      set_up();
    }

    /** Solve with contact; returns the contact force. */
    double solve(abut::ContactAssembler<dim> &contact)
    {
      contact.reinit(mapping, dof_handler, constraints);
      la::Vector u(owned, MPI_COMM_WORLD), residual(u), increment(u);
      constraints.distribute(u);
      contact.detect(u);
      do
      {
        stiffness.vmult(residual, u);
        residual -= load;
        constraints.set_zero(residual);
        contact.solve(stiffness, residual, increment);
        u += increment;
        constraints.distribute(u);
      } while (contact.update(u));
      if (contact.iteration().reason != ABUT_REASON_CONVERGED)
        throw std::runtime_error(contact.iteration().explanation);
      return contact.results().measures().force;
    }

  private:
    void set_up()
    {
      dof_handler.distribute_dofs(fe);
      owned = dof_handler.locally_owned_dofs();
      relevant = DoFTools::extract_locally_relevant_dofs(dof_handler);
      prescribe();
      DynamicSparsityPattern pattern(relevant);
      DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
      SparsityTools::distribute_sparsity_pattern(pattern, owned, MPI_COMM_WORLD,
                                                 relevant);
      stiffness.reinit(owned, owned, pattern, MPI_COMM_WORLD);
      load.reinit(owned, MPI_COMM_WORLD);
      assemble();
    }

    void prescribe()
    {
      abut::versions::reinit(constraints, owned, relevant);
      DoFTools::make_hanging_node_constraints(dof_handler, constraints);
      ComponentMask horizontal(dim, false), vertical(dim, false);
      horizontal.set(0, true);
      vertical.set(1, true);
      VectorTools::interpolate_boundary_values(
          mapping, dof_handler, left, Functions::ZeroFunction<dim>(dim),
          constraints, horizontal);
      VectorTools::interpolate_boundary_values(
          mapping, dof_handler, top,
          Functions::ConstantFunction<dim>(-shortening, dim), constraints,
          vertical);
      constraints.close();
    }

    void assemble()
    {
      const double mu = young / (2. * (1. + poisson));
      const double lambda = 2. * mu * poisson / (1. - 2. * poisson);
      const QGauss<dim> quadrature(2);
      FEValues<dim> values(mapping, fe, quadrature,
                           update_gradients | update_JxW_values);
      const FEValuesExtractors::Vector displacement(0);
      const unsigned int n = fe.n_dofs_per_cell();
      FullMatrix<double> cell_matrix(n, n);
      Vector<double> cell_load(n);
      std::vector<types::global_dof_index> dofs(n);
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell->get_dof_indices(dofs);
          cell_matrix = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
              {
                const auto &v = values[displacement];
                cell_matrix(i, j) +=
                    (lambda * v.divergence(i, q) * v.divergence(j, q)
                     + 2. * mu
                           * (v.symmetric_gradient(i, q)
                              * v.symmetric_gradient(j, q)))
                    * values.JxW(q);
              }
          constraints.distribute_local_to_global(cell_matrix, cell_load, dofs,
                                                 stiffness, load);
        }
      stiffness.compress(VectorOperation::add);
      load.compress(VectorOperation::add);
    }

    parallel::distributed::Triangulation<dim> triangulation;
    const FESystem<dim> fe;
    const MappingQ<dim> mapping;
    DoFHandler<dim> dof_handler;
    IndexSet owned, relevant;
    AffineConstraints<double> constraints;
    la::Matrix stiffness;
    la::Vector load;
  };

  /** Fill the registry from the first plugin that fits. */
  bool load(const std::vector<std::string> &plugins,
            abut::Registry<dim> &registry)
  {
    for (const std::string &plugin : plugins)
      try
      {
        abut::load_plugin(plugin, registry);
        return true;
      }
      catch (const abut::PluginError &error)
      {
        const bool is_loaded =
            dlopen(plugin.c_str(), RTLD_NOW | RTLD_NOLOAD) != nullptr;
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          std::cerr << error.what() << (is_loaded ? " [loaded]" : "")
                    << std::endl;
      }
    return false;
  }

  /** The assembler for the block on the floor, with parameters from the command
   * line. */
  std::unique_ptr<abut::ContactAssembler<dim>>
  create(const abut::Registry<dim> &registry,
         const std::vector<std::string> &parameters)
  {
    ParameterHandler prm;
    registry.declare_parameters(prm);
    std::optional<abut::MethodParameters> by_hand;
    for (const std::string &word : parameters)
    {
      if (word == "method=by hand")
      {
        by_hand.emplace();
        by_hand->options.gap_tolerance = 1e-8;
        continue;
      }
      const std::size_t slash = word.find('/'), equals = word.find('=');
      prm.enter_subsection(word.substr(0, slash));
      prm.set(word.substr(slash + 1, equals - slash - 1),
              word.substr(equals + 1));
      prm.leave_subsection();
    }
    abut_obstacle_shape plane = abut_obstacle_shape_defaults();
    plane.dimension = dim;
    plane.axis[1] = 1.;
    abut::ContactPair<dim> pair;
    pair.name = "floor";
    pair.secondary = {bottom};
    pair.obstacle = registry.make_obstacle(plane);
    auto contact = registry.create(prm, MPI_COMM_WORLD);
    if (by_hand)
      contact->set_parameters(*by_hand, abut::SolverParameters());
    contact->set_pairs({pair});
    return contact;
  }

  /** Relative error of the force; prints it. */
  void report(const double force)
  {
    const double expected =
        width * young / (1. - poisson * poisson) * shortening;
    std::cout.precision(17);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "force " << force << " error "
                << std::abs(force / expected - 1.) << std::endl;
  }

  /** Load, solve, refine and solve again and again. */
  int run_cycles(const std::vector<std::string> &plugins,
                 const std::vector<std::string> &parameters, const int n)
  {
    std::size_t before = 0;
    double force = 0.;
    for (int cycle = 0; cycle < n; ++cycle)
    {
      if (cycle == n / 10)
        before = mallinfo2().uordblks;
      abut::Registry<dim> registry;
      if (!load(plugins, registry))
        return 2;
      const auto contact = create(registry, parameters);
      Block block;
      for (int mesh = 0; mesh < 3; ++mesh)
      {
        if (mesh > 0)
          block.refine();
        force = block.solve(*contact);
      }
    }
    const double growth =
        static_cast<double>(mallinfo2().uordblks) - static_cast<double>(before);
    report(force);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "growth " << growth / (n - n / 10) << " bytes per cycle"
                << std::endl;
    return 0;
  }

  int run(const std::vector<std::string> &words)
  {
    const auto first =
        std::find_if(words.begin(), words.end(),
                     [](const std::string &word)
                     { return word.find('=') != std::string::npos; });
    const std::vector<std::string> plugins(words.begin(), first);
    std::vector<std::string> parameters(first, words.end());
    if (!parameters.empty() && parameters[0].rfind("cycles=", 0) == 0)
    {
      const int n = std::stoi(parameters[0].substr(7));
      parameters.erase(parameters.begin());
      return run_cycles(plugins, parameters, n);
    }
    abut::Registry<dim> registry;
    if (!load(plugins, registry))
      return 2;
    const auto contact = create(registry, parameters);
    report(Block().solve(*contact));
    return 0;
  }
} // namespace

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try
  {
    return run({argv + 1, argv + argc});
  }
  catch (const std::exception &error)
  {
    std::cerr << error.what() << std::endl;
    return 1;
  }
}
