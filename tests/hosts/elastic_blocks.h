// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_ELASTIC_BLOCKS_H
#define ABUT_TESTS_ELASTIC_BLOCKS_H

/** @file
 * A host without a matrix: one elastic block, or two. */

#include "matrix_free_elasticity.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/function.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <map>
#include <set>

namespace abut::hosts
{
  using dealii::Tensor;

  /** Boundary ids; the sides have 0. */
  namespace block_side
  {
    constexpr dealii::types::boundary_id bottom = 1, lower_interface = 2,
                                         upper_interface = 3, top = 4;
  }

  /** What is varied. */
  struct BlockCase
  {
    unsigned int degree = 1, n_refinements = 2;
    /** Cells along each axis before refinement, of one block or of two. */
    std::vector<unsigned int> cells = {2};
    std::vector<Lame> materials = {{1., 1.}, {3., 2.}};
    /** Where displacements are prescribed. */
    std::set<dealii::types::boundary_id> fixed = {block_side::bottom,
                                                  block_side::top};
    bool heeds_holding = true;
  };

  /** The unit block, and maybe a second one on top, not connected to it. */
  template <int dim> class ElasticBlocks
  {
  public:
    explicit ElasticBlocks(const BlockCase &run)
        : triangulation(MPI_COMM_WORLD, smoothing,
                        Mesh::construct_multigrid_hierarchy),
          fe(dealii::FE_Q<dim>(run.degree), dim),
          dof_handler(triangulation),
          run_(run)
    {
      make_mesh();
      dof_handler.distribute_dofs(fe);
      dof_handler.distribute_mg_dofs();
      relevant = dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
      make_constraints();
      load.reinit(dof_handler.locally_owned_dofs(), MPI_COMM_WORLD);
      stiffness = std::make_unique<ElasticOperator<dim>>(
          mapping, dof_handler, constraints, run.materials, run.heeds_holding);
    }

    /** Prescribe another displacement on a boundary that is fixed. */
    void move(const dealii::types::boundary_id side,
              const Tensor<1, dim> &displacement)
    {
      displacements_[side] = displacement;
      make_constraints();
    }

    /** Displacement 0 but for what is prescribed. */
    la::Vector start() const
    {
      la::Vector u(load);
      u = 0.;
      constraints.distribute(u);
      return u;
    }

    /** Internal forces of @p u less the load, 0 where constrained. */
    void residual(const la::Vector &u, la::Vector &result) const
    {
      stiffness->multiply(result, u);
      result -= load;
      constraints.set_zero(result);
    }

    /** The same stiffness as a matrix, and what it must be given besides the
     * load: matrix * u = rhs + load but where displacements are prescribed. */
    void assemble(la::Matrix &matrix, la::Vector &rhs) const
    {
      const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
      dealii::DynamicSparsityPattern pattern(relevant);
      dealii::DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints,
                                              false);
      dealii::SparsityTools::distribute_sparsity_pattern(
          pattern, owned, MPI_COMM_WORLD, relevant);
      matrix.reinit(owned, owned, pattern, MPI_COMM_WORLD);
      rhs.reinit(owned, MPI_COMM_WORLD);
      const dealii::QGauss<dim> rule(fe.degree + 1);
      dealii::FEValues<dim> values(mapping, fe, rule,
                                   dealii::update_gradients
                                       | dealii::update_JxW_values);
      std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
      const dealii::Vector<double> no_force(dofs.size());
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell->get_dof_indices(dofs);
          constraints.distribute_local_to_global(
              cell_matrix(values, run_.materials.at(cell->material_id())),
              no_force, dofs, matrix, rhs);
        }
      matrix.compress(dealii::VectorOperation::add);
      rhs.compress(dealii::VectorOperation::add);
    }

    using Mesh = dealii::parallel::distributed::Triangulation<dim>;

    Mesh triangulation;
    const dealii::MappingQ<dim> mapping{1};
    const dealii::FESystem<dim> fe;
    dealii::DoFHandler<dim> dof_handler;
    dealii::IndexSet relevant;
    dealii::AffineConstraints<double> constraints;
    /** Given forces, 0 at first. */
    la::Vector load;
    std::unique_ptr<ElasticOperator<dim>> stiffness;

  private:
    static constexpr auto smoothing =
        dealii::Triangulation<dim>::limit_level_difference_at_vertices;

    void make_mesh()
    {
      dealii::Triangulation<dim> mesh;
      for (unsigned int block = 0; block < run_.cells.size(); ++block)
      {
        // Smoothing is copied with the mesh.
        dealii::Triangulation<dim> part(smoothing);
        dealii::GridGenerator::subdivided_hyper_cube(part, run_.cells[block]);
        dealii::GridTools::shift(
            Tensor<1, dim>(dealii::Point<dim>::unit_vector(dim - 1))
                * double(block),
            part);
        for (const auto &cell : part.active_cell_iterators())
          cell->set_material_id(block);
        // With a tolerance of 0 they are not glued.
        dealii::GridGenerator::merge_triangulations(mesh, part, mesh, 0.);
      }
      triangulation.copy_triangulation(mesh);
      name_sides();
      triangulation.refine_global(run_.n_refinements);
    }

    void name_sides()
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
          {
            const double height = face->center()[dim - 1] - cell->material_id();
            const bool upper = cell->material_id() == 1;
            if (std::abs(height) < 1e-12)
              face->set_boundary_id(upper ? block_side::upper_interface
                                          : block_side::bottom);
            if (std::abs(height - 1.) < 1e-12)
              face->set_boundary_id(upper ? block_side::top
                                          : block_side::lower_interface);
          }
    }

    void make_constraints()
    {
      abut::versions::reinit(constraints, dof_handler.locally_owned_dofs(),
                             relevant);
      for (const auto side : run_.fixed)
      {
        const Tensor<1, dim> &displacement = displacements_[side];
        dealii::VectorTools::interpolate_boundary_values(
            mapping, dof_handler, side,
            dealii::Functions::ConstantFunction<dim>(&displacement[0], dim),
            constraints);
      }
      constraints.close();
    }

    static dealii::FullMatrix<double>
    cell_matrix(const dealii::FEValues<dim> &values, const Lame &material)
    {
      const unsigned int n = values.dofs_per_cell;
      const auto &displacement = values[dealii::FEValuesExtractors::Vector(0)];
      dealii::FullMatrix<double> matrix(n, n);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            matrix(i, j) +=
                values.JxW(q)
                * (material.lambda * displacement.divergence(i, q)
                       * displacement.divergence(j, q)
                   + 2. * material.mu
                         * (displacement.symmetric_gradient(i, q)
                            * displacement.symmetric_gradient(j, q)));
      return matrix;
    }

    const BlockCase run_;
    std::map<dealii::types::boundary_id, Tensor<1, dim>> displacements_;
  };
} // namespace abut::hosts

#endif
