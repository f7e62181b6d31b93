// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_PROBLEM_H
#define ABUT_TESTS_PROBLEM_H

/** @file
 * Meshes of the unit cube with nodal fields, for tests.
 */

#include "app/input/expression.h"

#include "expect.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** A mesh of (0,1)^dim with sides of ids 0, 1, ... and nodal values. */
  template <int dim> struct Problem
  {
    explicit Problem(const unsigned int degree,
                     const unsigned int n_components = 1)
        : mesh(MPI_COMM_WORLD),
          element(n_components == 1
                      ? dealii::FE_Q<dim>(degree).clone()
                      : std::make_unique<dealii::FESystem<dim>>(
                          dealii::FE_Q<dim>(degree), n_components)),
          fe(*element),
          dof_handler(mesh),
          mapping(1)
    {
    }

    void distribute()
    {
      dof_handler.distribute_dofs(fe);
      owned = dof_handler.locally_owned_dofs();
      relevant = dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
      abut::versions::reinit(constraints, owned, relevant);
      dealii::DoFTools::make_hanging_node_constraints(dof_handler, constraints);
      constraints.close();
    }

    la::Vector interpolate(const std::string &text) const
    {
      la::Vector distributed(owned, MPI_COMM_WORLD);
      dealii::VectorTools::interpolate(
          mapping, dof_handler, Expression<dim>(text, "u", fe.n_components()),
          distributed);
      constraints.distribute(distributed);
      return ghosted(distributed);
    }

    la::Vector ghosted(const la::Vector &distributed) const
    {
      la::Vector result(owned, relevant, MPI_COMM_WORLD);
      result = distributed;
      return result;
    }

    dealii::parallel::distributed::Triangulation<dim> mesh;
    std::unique_ptr<dealii::FiniteElement<dim>> element;
    const dealii::FiniteElement<dim> &fe;
    dealii::DoFHandler<dim> dof_handler;
    dealii::MappingQ<dim> mapping;
    dealii::IndexSet owned;
    dealii::IndexSet relevant;
    dealii::AffineConstraints<double> constraints;
  };

  /** Solution that vanishes on the boundary of the linear problem whose cell
   * matrix and right hand side @p cell_system puts in place. */
  template <int dim>
  la::Vector
  solve_linear(const Problem<dim> &problem,
               const std::function<void(const dealii::FEValues<dim> &,
                                        dealii::FullMatrix<double> &,
                                        dealii::Vector<double> &)> &cell_system)
  {
    dealii::AffineConstraints<double> constraints;
    abut::versions::reinit(constraints, problem.owned, problem.relevant);
    dealii::DoFTools::make_hanging_node_constraints(problem.dof_handler,
                                                    constraints);
    dealii::DoFTools::make_zero_boundary_constraints(problem.dof_handler,
                                                     constraints);
    constraints.close();
    dealii::DynamicSparsityPattern pattern(problem.relevant);
    dealii::DoFTools::make_sparsity_pattern(problem.dof_handler, pattern,
                                            constraints, false);
    dealii::SparsityTools::distribute_sparsity_pattern(
        pattern, problem.owned, MPI_COMM_WORLD, problem.relevant);
    la::Matrix matrix;
    matrix.reinit(problem.owned, problem.owned, pattern, MPI_COMM_WORLD);
    la::Vector rhs(problem.owned, MPI_COMM_WORLD);
    la::Vector u(problem.owned, MPI_COMM_WORLD);
    dealii::FEValues<dim> points(
        problem.mapping, problem.fe, dealii::QGauss<dim>(problem.fe.degree + 2),
        dealii::update_values | dealii::update_gradients
            | dealii::update_quadrature_points | dealii::update_JxW_values);
    const unsigned int n = problem.fe.n_dofs_per_cell();
    dealii::FullMatrix<double> a(n, n);
    dealii::Vector<double> b(n);
    std::vector<dealii::types::global_dof_index> dofs(n);
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        points.reinit(cell);
        a = 0;
        b = 0;
        cell_system(points, a, b);
        cell->get_dof_indices(dofs);
        constraints.distribute_local_to_global(a, b, dofs, matrix, rhs);
      }
    matrix.compress(dealii::VectorOperation::add);
    rhs.compress(dealii::VectorOperation::add);
    dealii::SolverControl control(2000, 1e-11 * rhs.l2_norm());
    dealii::SolverCG<la::Vector> solver(control);
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
    multigrid.initialize(matrix);
    solver.solve(matrix, u, rhs, multigrid);
    constraints.distribute(u);
    return problem.ghosted(u);
  }

  template <int dim>
  void unit_cube(Problem<dim> &problem, const unsigned int refinements)
  {
    dealii::GridGenerator::hyper_cube(problem.mesh, 0, 1, true);
    problem.mesh.refine_global(refinements);
    problem.distribute();
  }

  /** Refine the cells near the origin once more. */
  template <int dim> void refine_corner(Problem<dim> &problem)
  {
    for (const auto &cell : problem.mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().norm() < 0.6)
        cell->set_refine_flag();
    problem.mesh.execute_coarsening_and_refinement();
    problem.distribute();
    Expect::that(dealii::Utilities::MPI::sum(
                     problem.constraints.n_constraints(), MPI_COMM_WORLD)
                     > 0,
                 "hanging nodes");
  }

  /** A check that estimate over error is bounded, and the same on a finer mesh;
   * @p ratio: that of a problem. Prints the ratios after @p what. */
  template <int dim>
  void
  check_effectivity(const unsigned int degree, const unsigned int n_components,
                    const unsigned int level, const double tolerance,
                    const std::string &what,
                    const std::function<double(const Problem<dim> &)> &ratio)
  {
    std::vector<double> ratios;
    for (const bool local : {false, true})
      for (unsigned int finer = 0; finer < (local ? 1U : 2U); ++finer)
      {
        Problem<dim> problem(degree, n_components);
        unit_cube(problem, level + finer);
        if (local)
          refine_corner(problem);
        ratios.push_back(ratio(problem));
        Expect::that(ratios.back() > 1 && ratios.back() < 10,
                     "effectivity " + std::to_string(ratios.back()));
      }
    Expect::near(ratios[1] / ratios[0], 1, tolerance,
                 "effectivity when refined");
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "effectivity, dimension " << dim << what << ", degree "
                << degree << ": " << ratios[0] << ' ' << ratios[1]
                << ", locally refined " << ratios[2] << std::endl;
  }

  /** The boundary ids of the cube. */
  template <int dim> std::set<dealii::types::boundary_id> all_sides()
  {
    std::set<dealii::types::boundary_id> ids;
    for (unsigned int i = 0; i < 2 * dim; ++i)
      ids.insert(i);
    return ids;
  }

  /** Check that the cells' parts of an estimate sum up to it; returns it. */
  template <int dim>
  double expect_sum(const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::Vector<float> &squared, const double total)
  {
    double sum = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        sum += squared[cell->active_cell_index()];
      else
        Expect::that(squared[cell->active_cell_index()] == 0, "foreign cell");
    sum = dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    Expect::near(std::sqrt(sum), total, 1e-5 * total + 1e-12, "sum of cells");
    return total;
  }
} // namespace abut::app

#endif
