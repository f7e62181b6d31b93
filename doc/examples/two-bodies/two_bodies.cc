// SPDX-License-Identifier: LGPL-2.1-or-later
// Two elastic bodies in contact: a deal.II program in the usual shape, made to
// be copied from. A half ball (half disc in 2D) is pressed onto a block; both
// are meshed on their own, and the mesh is refined where the error is. What
// contact adds is marked by "contact:"; doc/your-program.md explains it.
//
//     two-bodies [dim] [cycles]
#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/error_estimator.h>
#include <deal.II/numerics/vector_tools.h>

#include <iostream>

using namespace dealii;
namespace la = abut::la;

namespace
{
  enum Side : types::boundary_id
  {
    free_side,
    pushed,    // the flat side of the ball, moved towards the block
    ball,      // the round side of the ball
    block_top, // what the ball meets
    held       // the far side of the block
  };
  constexpr double approach = 0.03, gap = 0.01; // lengths; the ball's radius: 1
  constexpr double poisson = 0.3;
  constexpr double young[] = {1000., 300.}; // ball and block, by material id
} // namespace

template <int dim> class TwoBodies
{
public:
  TwoBodies()
      : triangulation(MPI_COMM_WORLD),
        fe(FE_Q<dim>(1), dim),
        mapping(1),
        dof_handler(triangulation),
        contact(MPI_COMM_WORLD) // contact: the one new member
  {
  }

  void run(const unsigned int n_cycles)
  {
    make_mesh();
    setup();
    for (unsigned int cycle = 0; cycle < n_cycles; ++cycle)
    {
      if (cycle > 0)
        refine();
      solve();
      report(cycle);
    }
    write();
  }

private:
  void make_mesh()
  {
    Triangulation<dim> upper, lower, both;
    GridGenerator::half_hyper_ball(upper);
    Point<dim> from, to;
    for (int d = 1; d < dim; ++d)
    {
      from[d] = -2.;
      to[d] = 2.;
    }
    from[0] = 1. + gap;
    to[0] = 3. + gap;
    GridGenerator::hyper_rectangle(lower, from, to);
    lower.refine_global(2);
    // The gap keeps merge_triangulations() from gluing the bodies.
    Triangulation<dim> block;
    GridGenerator::flatten_triangulation(lower, block);
    for (const auto &cell : block.active_cell_iterators())
      cell->set_material_id(1);
    GridGenerator::merge_triangulations(upper, block, both, 1e-12, true);
    // contact: surfaces are told apart by boundary ids
    for (const auto &cell : both.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
        {
          const double x = face->center()[0];
          face->set_boundary_id(cell->material_id() == 0
                                    ? (x < 1e-9 ? pushed : ball)
                                : x < from[0] + 1e-9 ? block_top
                                : x > to[0] - 1e-9   ? held
                                                     : free_side);
        }
    triangulation.copy_triangulation(both);
    triangulation.set_manifold(0, SphericalManifold<dim>(Point<dim>()));
    triangulation.refine_global(2);
  }

  void setup()
  {
    dof_handler.distribute_dofs(fe);
    owned = dof_handler.locally_owned_dofs();
    relevant = DoFTools::extract_locally_relevant_dofs(dof_handler);
    abut::versions::reinit(constraints, owned, relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    std::vector<double> motion(dim, 0.);
    motion[0] = approach;
    VectorTools::interpolate_boundary_values(
        mapping, dof_handler, pushed, Functions::ConstantFunction<dim>(motion),
        constraints);
    VectorTools::interpolate_boundary_values(mapping, dof_handler, held,
                                             Functions::ZeroFunction<dim>(dim),
                                             constraints);
    constraints.close();
    DynamicSparsityPattern pattern(relevant);
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
    SparsityTools::distribute_sparsity_pattern(pattern, owned, MPI_COMM_WORLD,
                                               relevant);
    matrix.reinit(owned, owned, pattern, MPI_COMM_WORLD);
    residual.reinit(owned, MPI_COMM_WORLD);
    u.reinit(owned, MPI_COMM_WORLD);
    pressure.reinit(owned, MPI_COMM_WORLD);
  }

  /** K = dR/du and R = internal - external forces at u, without contact. */
  void assemble()
  {
    const QGauss<dim> quadrature(fe.degree + 1);
    FEValues<dim> values(mapping, fe, quadrature,
                         update_gradients | update_JxW_values);
    const FEValuesExtractors::Vector displacement(0);
    const unsigned int n = fe.n_dofs_per_cell();
    FullMatrix<double> cell_matrix(n, n);
    Vector<double> cell_residual(n);
    std::vector<types::global_dof_index> dofs(n);
    std::vector<SymmetricTensor<2, dim>> strain(quadrature.size()), e(n);
    const la::Vector ghosted = with_ghosts(u);
    matrix = 0.;
    residual = 0.;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const double E = young[cell->material_id()];
        const double mu = E / (2. * (1. + poisson));
        const double lambda = 2. * mu * poisson / (1. - 2. * poisson);
        values.reinit(cell);
        values[displacement].get_function_symmetric_gradients(ghosted, strain);
        cell_matrix = 0.;
        cell_residual = 0.;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const SymmetricTensor<2, dim> stress =
              2. * mu * strain[q]
              + lambda * trace(strain[q]) * unit_symmetric_tensor<dim>();
          for (unsigned int i = 0; i < n; ++i)
            e[i] = values[displacement].symmetric_gradient(i, q);
          for (unsigned int i = 0; i < n; ++i)
          {
            cell_residual(i) += e[i] * stress * values.JxW(q);
            for (unsigned int j = 0; j < n; ++j)
              cell_matrix(i, j) +=
                  (2. * mu * (e[i] * e[j]) + lambda * trace(e[i]) * trace(e[j]))
                  * values.JxW(q);
          }
        }
        cell->get_dof_indices(dofs);
        // One by one: together they would add boundary values, which are in u.
        constraints.distribute_local_to_global(cell_matrix, dofs, matrix);
        abut::versions::distribute_local_to_global(constraints, cell_residual,
                                                   dofs, residual);
      }
    matrix.compress(VectorOperation::add);
    residual.compress(VectorOperation::add);
    constraints.set_zero(residual);
  }

  void solve()
  {
    constraints.distribute(u);
    abut::ContactPair<dim> pair; // contact: what may touch what
    pair.name = "ball on block";
    pair.secondary = {ball};
    pair.primary = {block_top};
    pair.reach = 3. * approach;
    contact.set_pairs({pair});
    contact.assume_constant_matrix(true); // contact: linear materials only
    contact.reinit(mapping, dof_handler, constraints);
    contact.state().set_pressure(
        pressure); // contact: from the coarser mesh, or 0
    contact.detect(u);
    report_warnings();
    la::Vector increment(owned, MPI_COMM_WORLD);
    n_steps = 0;
    do
    {
      assemble();
      contact.solve(matrix, residual, increment); // contact: in place of CG
      u += increment;
      constraints.distribute(u);
      ++n_steps;
    } while (contact.update(u)); // contact: instead of a test of the residual
    AssertThrow(contact.iteration().reason == ABUT_REASON_CONVERGED,
                ExcMessage(contact.iteration().explanation));
    // contact: whether bodies have met where no constraint was
    AssertThrow(
        contact.checks()
            .penetrations(u, 1e-3 * contact.length_scale(u))
            .empty(),
        ExcMessage("Nodes penetrate without a constraint: use a larger reach"));
    pressure = contact.results().pressure();
  }

  /** contact: what looks wrong before anything is solved. */
  void report_warnings() const
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      for (const abut::PairCheck &check : contact.checks().pairs())
        for (const abut::Message &warning : check.warnings)
          std::cerr << warning.text << std::endl;
  }

  void refine()
  {
    Vector<float> error(triangulation.n_active_cells());
    const la::Vector old_u = with_ghosts(u),
                     old_pressure = with_ghosts(pressure);
    KellyErrorEstimator<dim>::estimate(
        mapping, dof_handler, QGauss<dim - 1>(fe.degree + 1), {}, old_u, error);
    parallel::distributed::GridRefinement::refine_and_coarsen_fixed_number(
        triangulation, error, 0.2, 0.);
    triangulation.prepare_coarsening_and_refinement();
    abut::versions::SolutionTransfer<dim, la::Vector> transfer(dof_handler);
    transfer.prepare_for_coarsening_and_refinement(
        std::vector<const la::Vector *>{&old_u, &old_pressure});
    triangulation.execute_coarsening_and_refinement();
    setup();
    std::vector<la::Vector *> result = {&u, &pressure};
    transfer.interpolate(result);
  }

  void report(const unsigned int cycle) const
  {
    const abut::PairResult<dim> result = contact.results().pairs()[0];
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "cycle " << cycle << ": " << dof_handler.n_dofs()
                << " unknowns, " << result.n_active << " of " << result.n_rows
                << " constraints active, " << n_steps << " steps, force "
                << std::setprecision(16) << result.primary_force[0]
                << std::setprecision(6) << ", forces differ by "
                << result.force_imbalance << std::endl;
  }

  void write() const
  {
    DataOut<dim> out;
    out.attach_dof_handler(dof_handler);
    const la::Vector ghosted_u = with_ghosts(u), p = with_ghosts(pressure);
    const std::vector<DataComponentInterpretation::DataComponentInterpretation>
        parts(dim, DataComponentInterpretation::component_is_part_of_vector);
    out.add_data_vector(ghosted_u,
                        std::vector<std::string>(dim, "displacement"),
                        DataOut<dim>::type_dof_data, parts);
    out.add_data_vector(p, std::vector<std::string>(dim, "pressure"),
                        DataOut<dim>::type_dof_data, parts);
    out.build_patches(mapping);
    out.write_vtu_in_parallel("two-bodies.vtu", MPI_COMM_WORLD);
  }

  la::Vector with_ghosts(const la::Vector &vector) const
  {
    la::Vector result(owned, relevant, MPI_COMM_WORLD);
    result = vector;
    return result;
  }

  parallel::distributed::Triangulation<dim> triangulation;
  const FESystem<dim> fe;
  const MappingQ<dim> mapping;
  DoFHandler<dim> dof_handler;
  IndexSet owned, relevant;
  AffineConstraints<double> constraints;
  la::Matrix matrix;
  la::Vector residual, u, pressure;
  abut::ContactAssembler<dim> contact;
  unsigned int n_steps = 0;
};

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int n_cycles = argc > 2 ? std::stoi(argv[2]) : 4;
  if (argc > 1 && std::string(argv[1]) == "3")
    TwoBodies<3>().run(n_cycles);
  else
    TwoBodies<2>().run(n_cycles);
}
