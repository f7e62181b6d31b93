// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_ELASTIC_BODIES_H
#define ABUT_TESTS_ELASTIC_BODIES_H

/** @file
 * A host for bodies of triangles or tetrahedra that are lists of cells: linear
 * elasticity, or St. Venant and Kirchhoff's material. Each rank solves alone.
 */

#include <abut/dealii/contact_solver.h>
#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <functional>
#include <map>
#include <vector>

namespace abut::hosts
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::types::boundary_id;

  /** Vertices and cells of some bodies, which share none. */
  template <int dim> struct CellList
  {
    std::vector<Point<dim>> vertices;
    std::vector<dealii::CellData<dim>> cells;

    void add_cell(const std::array<unsigned int, dim + 1> &corners)
    {
      dealii::CellData<dim> cell(dim + 1);
      std::copy(corners.begin(), corners.end(), cell.vertices.begin());
      cells.push_back(cell);
    }

    /** A box of @p n cells along each axis that are cut into simplices, those
     * with their middle where @p is_hole is true left out. */
    void add_box(const Point<dim> &low, const Point<dim> &high,
                 const std::vector<unsigned int> &n,
                 const std::function<bool(const Point<dim> &)> &is_hole = {})
    {
      dealii::Triangulation<dim> box;
      dealii::GridGenerator::subdivided_hyper_rectangle_with_simplices(
          box, n, low, high);
      std::map<unsigned int, unsigned int> number;
      for (const auto &cell : box.active_cell_iterators())
      {
        if (is_hole && is_hole(cell->center()))
          continue;
        std::array<unsigned int, dim + 1> corners;
        for (const unsigned int v : cell->vertex_indices())
        {
          const auto [it, is_new] =
              number.emplace(cell->vertex_index(v), vertices.size());
          if (is_new)
            vertices.push_back(cell->vertex(v));
          corners[v] = it->second;
        }
        add_cell(corners);
      }
    }
  };

  /** What is varied. */
  struct Solid
  {
    unsigned int degree = 1;
    double young = 1000., poisson = 0.3;
    bool large_strain = false;
  };

  template <int dim> class ElasticBodies
  {
  public:
    /** @p side names boundary faces by their middle. */
    ElasticBodies(const CellList<dim> &list, const Solid &solid,
                  const std::function<boundary_id(const Point<dim> &)> &side)
        : fe(dealii::FE_SimplexP<dim>(solid.degree), dim),
          dof_handler(triangulation),
          solid_(solid)
    {
      triangulation.create_triangulation(list.vertices, list.cells, {});
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(side(face->center()));
      dof_handler.distribute_dofs(fe);
      owned_ = dof_handler.locally_owned_dofs();
      dealii::DynamicSparsityPattern pattern(owned_);
      abut::versions::reinit(constraints, owned_, owned_);
      dealii::DoFTools::make_sparsity_pattern(dof_handler, pattern);
      tangent_.reinit(owned_, owned_, pattern, MPI_COMM_SELF);
      load.reinit(owned_, MPI_COMM_SELF);
    }

    /** Prescribe a component on a side. */
    void fix(const boundary_id side, const unsigned int component,
             const double value = 0.)
    {
      dealii::ComponentMask mask(dim, false);
      mask.set(component, true);
      dealii::VectorTools::interpolate_boundary_values(
          mapping, dof_handler, side,
          dealii::Functions::ConstantFunction<dim>(value, dim), constraints,
          mask);
    }

    /** Pressure 1 on the deformed faces of a side, whose corners @p u
     * displaces; linear elements. */
    void press(const boundary_id side, const la::Vector &u)
    {
      load = 0.;
      for (const auto &cell : dof_handler.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == side)
          {
            std::array<Point<dim>, dim> corner;
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int d = 0; d < dim; ++d)
                corner[k][d] =
                    face->vertex(k)[d] + u(face->vertex_dof_index(k, d));
            Tensor<1, dim> area;
            if constexpr (dim == 2)
              area = dealii::cross_product_2d(corner[1] - corner[0]);
            else
              area = 0.5
                     * dealii::cross_product_3d(corner[1] - corner[0],
                                                corner[2] - corner[0]);
            if (area * (face->center() - cell->center()) < 0.)
              area *= -1.;
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int d = 0; d < dim; ++d)
                load(face->vertex_dof_index(k, d)) -= area[d] / dim;
          }
      load.compress(dealii::VectorOperation::add);
      constraints.set_zero(load);
    }

    /** What contact is told; constraints are complete. */
    void prepare(ContactAssembler<dim> &contact, const MethodParameters &method,
                 const ContactPair<dim> &pair)
    {
      constraints.close();
      SolverParameters solver;
      solver.linear = SolverParameters::Linear::direct;
      contact.set_parameters(method, solver);
      contact.set_pairs({pair});
      contact.reinit(mapping, dof_handler, constraints);
    }

    la::Vector zero() const
    {
      return la::Vector(owned_, MPI_COMM_SELF);
    }

    NewtonResult solve(ContactAssembler<dim> &contact, la::Vector &u)
    {
      HostProblem problem;
      problem.linear = !solid_.large_strain;
      problem.residual = [this](const la::Vector &at, la::Vector &residual)
      { assemble(at, nullptr, residual); };
      problem.tangent = [this](const la::Vector &at) -> const la::Matrix &
      {
        la::Vector residual(at);
        assemble(at, &tangent_, residual);
        return tangent_;
      };
      NewtonParameters parameters;
      parameters.tolerance = 1e-8;
      return ContactSolver<dim>(contact, constraints, problem, parameters)
          .solve(u);
    }

    dealii::Triangulation<dim> triangulation;
    const dealii::MappingFE<dim> mapping{dealii::FE_SimplexP<dim>(1)};
    const dealii::FESystem<dim> fe;
    dealii::DoFHandler<dim> dof_handler;
    dealii::AffineConstraints<double> constraints;
    la::Vector load;

  private:
    /** First Piola-Kirchhoff stress at a gradient of the displacement, and what
     * it changes by. */
    struct StressAt
    {
      double lambda, mu;
      bool is_large;
      Tensor<2, dim> F, S;

      StressAt(const Solid &solid, const Tensor<2, dim> &gradient)
          : lambda(solid.young * solid.poisson
                   / ((1. + solid.poisson) * (1. - 2. * solid.poisson))),
            mu(solid.young / (2. * (1. + solid.poisson))),
            is_large(solid.large_strain)
      {
        for (unsigned int d = 0; d < dim; ++d)
          F[d][d] = 1.;
        Tensor<2, dim> strain = 0.5 * (gradient + transpose(gradient));
        if (is_large)
        {
          F += gradient;
          strain += 0.5 * transpose(gradient) * gradient;
        }
        S = hooke(strain);
      }

      Tensor<2, dim> hooke(const Tensor<2, dim> &strain) const
      {
        Tensor<2, dim> result = 2. * mu * strain;
        for (unsigned int d = 0; d < dim; ++d)
          result[d][d] += lambda * trace(strain);
        return result;
      }

      Tensor<2, dim> stress() const
      {
        return F * S;
      }

      Tensor<2, dim> change(const Tensor<2, dim> &gradient) const
      {
        const Tensor<2, dim> half = transpose(F) * gradient;
        Tensor<2, dim> result = F * hooke(0.5 * (half + transpose(half)));
        if (is_large)
          result += gradient * S;
        return result;
      }
    };

    void assemble(const la::Vector &u, la::Matrix *matrix, la::Vector &residual)
    {
      const dealii::QGaussSimplex<dim> rule(solid_.degree + 1);
      dealii::FEValues<dim> values(mapping, fe, rule,
                                   dealii::update_gradients
                                       | dealii::update_JxW_values);
      const dealii::FEValuesExtractors::Vector displacement(0);
      const unsigned int n = fe.n_dofs_per_cell();
      dealii::FullMatrix<double> k(n, n);
      dealii::Vector<double> r(n);
      std::vector<Tensor<2, dim>> gradient(rule.size());
      std::vector<dealii::types::global_dof_index> dofs(n);
      residual = 0.;
      if (matrix != nullptr)
        *matrix = 0.;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        values[displacement].get_function_gradients(u, gradient);
        k = 0.;
        r = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const StressAt at(solid_, gradient[q]);
          for (unsigned int i = 0; i < n; ++i)
          {
            const auto e = values[displacement].gradient(i, q);
            r(i) += scalar_product(at.stress(), e) * values.JxW(q);
            if (matrix == nullptr)
              continue;
            const auto change = at.change(e);
            for (unsigned int j = 0; j < n; ++j)
              k(i, j) +=
                  scalar_product(change, values[displacement].gradient(j, q))
                  * values.JxW(q);
          }
        }
        cell->get_dof_indices(dofs);
        if (matrix != nullptr)
          constraints.distribute_local_to_global(k, dofs, *matrix);
        abut::versions::distribute_local_to_global(constraints, r, dofs,
                                                   residual);
      }
      if (matrix != nullptr)
        matrix->compress(dealii::VectorOperation::add);
      residual.compress(dealii::VectorOperation::add);
      residual -= load;
      constraints.set_zero(residual);
    }

    const Solid solid_;
    dealii::IndexSet owned_;
    la::Matrix tangent_;
  };
} // namespace abut::hosts

#endif
