// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_PROBLEM_H
#define ABUT_TESTS_PROBLEM_H

/** @file
 * Meshes of the unit cube with nodal fields, for tests.
 */

#include "app/expression.h"

#include "expect.h"

#include <abut/dealii/linear_algebra.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <memory>
#include <set>
#include <string>

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
      dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
      constraints.reinit(relevant);
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
