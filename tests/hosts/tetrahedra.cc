// SPDX-License-Identifier: LGPL-2.1-or-later
// A host in the style of step-8 with tetrahedra of degree 1 or 2
// and deal.II's own matrix and vectors: two cubes of one material, with free
// sides, are pressed together by a tenth. The force is E times .05.
#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/contact_solver.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools.h>

#include <cstdlib>
#include <iostream>

using namespace dealii;

template <int dim> class Blocks
{
public:
  /** @param n_refinements of tetrahedra, by deal.II */
  Blocks(const unsigned int degree, const unsigned int n_refinements)
      : contact(MPI_COMM_WORLD),
        fe(FE_SimplexP<dim>(degree), dim),
        dof_handler(triangulation)
  {
    Triangulation<dim> lower, upper;
    Point<dim> from, to(1., 1., 1.);
    GridGenerator::subdivided_hyper_rectangle_with_simplices(lower, {2, 2, 2},
                                                             from, to);
    from[2] = 1.;
    to[2] = 2.;
    GridGenerator::subdivided_hyper_rectangle_with_simplices(upper, {3, 3, 3},
                                                             from, to);
    for (const auto &cell : upper.active_cell_iterators())
      cell->set_material_id(1);
    // With a tolerance of 0 they are not glued.
    GridGenerator::merge_triangulations(lower, upper, triangulation, 0.);
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(side(face->center(), cell->material_id()));
    triangulation.refine_global(n_refinements);
    dof_handler.distribute_dofs(fe);
    for (unsigned int d = 0; d < dim; ++d)
      prescribe(1 + d, d, 0.);
    prescribe(4, 2, -0.1);
    constraints.close();
  }

  /** Returns the contact force. */
  double run(const abut::SolverParameters &parameters = {})
  {
    contact.set_parameters({}, parameters);
    DynamicSparsityPattern pattern(dof_handler.n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
    sparsity.copy_from(pattern);
    matrix.reinit(sparsity);
    solution.reinit(dof_handler.n_dofs());
    assemble();
    abut::ContactPair<dim> pair;
    pair.name = "interface";
    pair.secondary = {6};
    pair.primary = {5};
    contact.set_pairs({pair});
    contact.reinit(mapping, dof_handler, constraints);
    abut::HostProblem problem = abut::host_problem(
        solution,
        [&](const Vector<double> &u, Vector<double> &residual)
        {
          whole.vmult(residual, u);
          constraints.set_zero(residual);
        },
        [&](const auto &) -> const auto & { return matrix; });
    problem.linear = true;
    abut::ContactSolver<dim> solver(contact, constraints, problem);
    const abut::NewtonResult result = solver.solve(solution);
    AssertThrow(result.converged(), ExcMessage(result.explanation));
    return contact.results().pairs()[0].secondary_force.norm();
  }

  /** Largest difference of the nodal pressures on the secondary surface, those
   * between corners included, from a uniform one. */
  double pressure_error(const double uniform) const
  {
    const abut::la::Vector pressure = contact.results().pressure();
    ComponentMask normal(dim, false);
    normal.set(dim - 1, true);
    double largest = 0.;
    for (const auto dof :
         DoFTools::extract_boundary_dofs(dof_handler, normal, {6}))
      largest = std::max(largest, std::abs(std::abs(pressure(dof)) - uniform));
    return largest;
  }

  std::string linear_solver() const
  {
    return contact.results().effort().linear.method;
  }

private:
  static types::boundary_id side(const Point<dim> &x, const unsigned int block)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(x[d]) < 1e-9)
        return 1 + d;
    if (std::abs(x[2] - 2.) < 1e-9)
      return 4;
    return std::abs(x[2] - 1.) < 1e-9 ? 5 + block : 0;
  }

  void prescribe(const types::boundary_id id, const unsigned int component,
                 const double value)
  {
    ComponentMask mask(dim, false);
    mask.set(component, true);
    VectorTools::interpolate_boundary_values(
        mapping, dof_handler, id, Functions::ConstantFunction<dim>(value, dim),
        constraints, mask);
  }

  /** The matrix, and one whose rows have prescribed unknowns, too. */
  void assemble()
  {
    constexpr double young = 1000., poisson = 0.3;
    const double mu = young / (2. * (1. + poisson)),
                 lambda =
                     young * poisson / ((1. + poisson) * (1. - 2. * poisson));
    DynamicSparsityPattern pattern(dof_handler.n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, pattern);
    whole_sparsity.copy_from(pattern);
    whole.reinit(whole_sparsity);
    const QGaussSimplex<dim> rule(fe.degree + 1);
    FEValues<dim> values(mapping, fe, rule,
                         update_gradients | update_JxW_values);
    const FEValuesExtractors::Vector u(0);
    const unsigned int n = fe.n_dofs_per_cell();
    FullMatrix<double> k(n, n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      k = 0.;
      for (unsigned int q = 0; q < rule.size(); ++q)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            k(i, j) += (lambda * values[u].divergence(i, q)
                            * values[u].divergence(j, q)
                        + 2. * mu
                              * (values[u].symmetric_gradient(i, q)
                                 * values[u].symmetric_gradient(j, q)))
                       * values.JxW(q);
      cell->get_dof_indices(dofs);
      constraints.distribute_local_to_global(k, dofs, matrix);
      whole.add(dofs, k);
    }
  }

  abut::ContactAssembler<dim> contact;
  Triangulation<dim> triangulation;
  const MappingFE<dim> mapping{FE_SimplexP<dim>(1)};
  const FESystem<dim> fe;
  DoFHandler<dim> dof_handler;
  AffineConstraints<double> constraints;
  SparsityPattern sparsity, whole_sparsity;
  SparseMatrix<double> matrix, whole;
  Vector<double> solution;
};

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool good = true;
  for (const unsigned int degree : {1, 2})
  {
    Blocks<3> blocks(degree, 0);
    const double force = blocks.run(),
                 pressure_error = blocks.pressure_error(50.);
    std::cout << "degree " << degree << ": force " << force
              << ", error of pressures " << pressure_error << std::endl;
    good = good && std::abs(force - 50.) < 1e-5 && pressure_error < 1e-4;
    Blocks<3> refined(degree, 1);
    abut::SolverParameters parameters;
    parameters.linear = abut::SolverParameters::Linear::geometric;
    const double refined_force = refined.run(parameters);
    std::cout << "refined: force " << refined_force << ", "
              << refined.linear_solver() << std::endl;
    good = good && std::abs(refined_force - 50.) < 1e-5
           && refined.linear_solver().find(", geometric multigrid")
                  != std::string::npos;
  }
  return good ? 0 : 1;
}
