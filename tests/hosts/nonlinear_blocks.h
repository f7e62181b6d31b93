// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_NONLINEAR_BLOCKS_H
#define ABUT_TESTS_NONLINEAR_BLOCKS_H

#include "patch.h"

#include <abut/dealii/contact_solver.h>
#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <array>
#include <limits>
#include <optional>

namespace abut::hosts
{
  /** stress = (lambda + c tr^2) tr I + 2 mu strain. */
  struct Stiffening
  {
    double lambda, mu, c;

    /** With the strain e along one axis alone. */
    double uniaxial(const double e) const
    {
      return (lambda + 2. * mu) * e + c * e * e * e;
    }
  };

  constexpr std::array<Stiffening, 2> stiffening = {
      {{3., 2., 60.}, {1., 4., 20.}}};
  constexpr double distance = 0.05, shortening = 0.2;

  /** What two blocks are made of and how they are held. */
  struct BlocksOptions
  {
    std::array<Stiffening, 2> materials = stiffening;
    bool top_is_held = true;
    bool tied = false; ///< at the distance that they have
    /** Prescribed at the top. */
    double top = -distance - shortening;
    /** Prescribed at the surface of the lower block. */
    std::optional<double> die;
    /** Whether the residual is not a number where a point is shortened to
     * nothing, as that of a body in finite strain is. */
    bool has_limit = false;
  };

  /** The pressure at which both blocks are as short as they have to be. */
  inline double
  exact_pressure(const std::array<Stiffening, 2> &materials = stiffening)
  {
    double low = 0., high = shortening;
    for (int i = 0; i < 100; ++i)
    {
      const double e = 0.5 * (low + high);
      (materials[0].uniaxial(e) < materials[1].uniaxial(shortening - e)
           ? low
           : high) = e;
    }
    return materials[0].uniaxial(low);
  }

  /** Two blocks of unit size, a distance apart, held sideways. */
  class Blocks
  {
  public:
    explicit Blocks(const BlocksOptions &options = BlocksOptions())
        : options_(options),
          triangulation_(MPI_COMM_WORLD),
          fe_(dealii::FE_Q<2>(1), 2),
          mapping_(1),
          dof_handler_(triangulation_),
          contact(MPI_COMM_WORLD)
    {
      make_mesh();
      setup();
      ContactPair<2> pair;
      pair.name = "interface";
      pair.secondary = {upper_interface};
      pair.primary = {lower_interface};
      pair.reach = 2. * distance;
      pair.tied = options_.tied;
      contact.set_pairs({pair});
      reinit_contact();
    }

    void reinit_contact()
    {
      contact.reinit(mapping_, dof_handler_, constraints);
    }

    /** New unknowns and constraints on a finer mesh; contact is not told. */
    void refine()
    {
      triangulation_.refine_global(1);
      setup();
    }

    HostProblem problem()
    {
      HostProblem problem;
      problem.residual = [this](const la::Vector &at, la::Vector &residual)
      { assemble(at, nullptr, &residual); };
      problem.tangent = [this](const la::Vector &at) -> const la::Matrix &
      {
        assemble(at, &tangent_, nullptr);
        return tangent_;
      };
      return problem;
    }

    /** Prescribe another value at the top; contact is not told. */
    void move_top(const double top)
    {
      options_.top = top;
      make_constraints();
    }

    /** The same for the surface of the lower block, a die. */
    void move_die(const double height)
    {
      options_.die = height;
      make_constraints();
    }

    /** Uniform shortening of the lower and the upper block. */
    la::Vector uniform(const double lower, const double upper) const
    {
      la::Vector result(u);
      const auto points =
          abut::versions::support_points(mapping_, dof_handler_);
      for (const auto dof : owned_)
      {
        const double y = points.at(dof)[1];
        if (sideways_.is_element(dof))
          result(dof) = 0.;
        else
          result(dof) = y < -0.5 * distance ? -lower * (y + 1. + distance)
                                            : options_.top - upper * (y - 1.);
      }
      result.compress(dealii::VectorOperation::insert);
      return result;
    }

    dealii::AffineConstraints<double> constraints;
    la::Vector u;

  private:
    void make_mesh()
    {
      dealii::Triangulation<2> lower, upper, both;
      const auto block = [](dealii::Triangulation<2> &mesh,
                            const unsigned int n, const double from)
      {
        dealii::GridGenerator::subdivided_hyper_rectangle(
            mesh, {n, n}, dealii::Point<2>(0., from),
            dealii::Point<2>(1., from + 1.));
      };
      block(lower, 3, -1. - distance);
      block(upper, 4, 0.);
      for (const auto &cell : upper.active_cell_iterators())
        cell->set_material_id(1);
      dealii::GridGenerator::merge_triangulations(lower, upper, both);
      for (const auto &face : both.active_face_iterators())
        if (face->at_boundary())
        {
          const double y = face->center()[1];
          face->set_boundary_id(y < -0.999 - distance ? bottom
                                : std::abs(y + distance) < 1e-9
                                    ? lower_interface
                                : std::abs(y) < 1e-9 ? upper_interface
                                : y > 0.999          ? top
                                                     : free_side);
        }
      triangulation_.copy_triangulation(both);
      triangulation_.refine_global(1);
    }

    void prescribe(const dealii::types::boundary_id side, const unsigned int c,
                   const double value)
    {
      dealii::ComponentMask mask(2, false);
      mask.set(c, true);
      dealii::VectorTools::interpolate_boundary_values(
          mapping_, dof_handler_, side,
          dealii::Functions::ConstantFunction<2>(value, 2), constraints, mask);
    }

    void make_constraints()
    {
      constraints.clear();
      abut::versions::reinit(constraints, owned_, relevant_);
      prescribe(free_side, 0, 0.);
      prescribe(bottom, 1, 0.);
      if (options_.top_is_held)
        prescribe(top, 1, options_.top);
      if (options_.die)
        prescribe(lower_interface, 1, *options_.die);
      constraints.close();
    }

    void setup()
    {
      dof_handler_.distribute_dofs(fe_);
      owned_ = dof_handler_.locally_owned_dofs();
      relevant_ = dealii::DoFTools::extract_locally_relevant_dofs(dof_handler_);
      sideways_ = dealii::DoFTools::extract_dofs(
          dof_handler_, dealii::ComponentMask(std::vector<bool>{true, false}));
      make_constraints();
      dealii::DynamicSparsityPattern pattern(relevant_);
      dealii::DoFTools::make_sparsity_pattern(dof_handler_, pattern,
                                              constraints, false);
      dealii::SparsityTools::distribute_sparsity_pattern(
          pattern, owned_, MPI_COMM_WORLD, relevant_);
      tangent_.reinit(owned_, owned_, pattern, MPI_COMM_WORLD);
      u.reinit(owned_, MPI_COMM_WORLD);
    }

    void assemble(const la::Vector &at, la::Matrix *matrix,
                  la::Vector *residual)
    {
      const dealii::QGauss<2> quadrature(2);
      dealii::FEValues<2> values(mapping_, fe_, quadrature,
                                 dealii::update_gradients
                                     | dealii::update_JxW_values);
      const dealii::FEValuesExtractors::Vector displacement(0);
      const unsigned int n = fe_.n_dofs_per_cell();
      dealii::FullMatrix<double> k(n, n);
      dealii::Vector<double> r(n);
      std::vector<dealii::types::global_dof_index> dofs(n);
      std::vector<dealii::SymmetricTensor<2, 2>> strain(quadrature.size());
      la::Vector ghosted(owned_, relevant_, MPI_COMM_WORLD);
      ghosted = at;
      if (matrix != nullptr)
        *matrix = 0.;
      for (const auto &cell : dof_handler_.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          const Stiffening &m = options_.materials[cell->material_id()];
          values.reinit(cell);
          values[displacement].get_function_symmetric_gradients(ghosted,
                                                                strain);
          k = 0.;
          r = 0.;
          for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const double t = trace(strain[q]);
            if (options_.has_limit && strain[q][1][1] <= -1.)
              r(0) = std::numeric_limits<double>::quiet_NaN();
            for (unsigned int i = 0; i < n; ++i)
            {
              const auto e = values[displacement].symmetric_gradient(i, q);
              r(i) += ((m.lambda + m.c * t * t) * t * trace(e)
                       + 2. * m.mu * (strain[q] * e))
                      * values.JxW(q);
              for (unsigned int j = 0; j < n; ++j)
              {
                const auto f = values[displacement].symmetric_gradient(j, q);
                k(i, j) += ((m.lambda + 3. * m.c * t * t) * trace(e) * trace(f)
                            + 2. * m.mu * (e * f))
                           * values.JxW(q);
              }
            }
          }
          cell->get_dof_indices(dofs);
          if (matrix != nullptr)
            constraints.distribute_local_to_global(k, dofs, *matrix);
          if (residual != nullptr)
            abut::versions::distribute_local_to_global(constraints, r, dofs,
                                                       *residual);
        }
      if (matrix != nullptr)
        matrix->compress(dealii::VectorOperation::add);
      if (residual != nullptr)
      {
        residual->compress(dealii::VectorOperation::add);
        constraints.set_zero(*residual);
      }
    }

    BlocksOptions options_;
    dealii::parallel::distributed::Triangulation<2> triangulation_;
    const dealii::FESystem<2> fe_;
    const dealii::MappingQ<2> mapping_;
    dealii::DoFHandler<2> dof_handler_;
    dealii::IndexSet owned_, relevant_, sideways_;
    la::Matrix tangent_;

  public:
    ContactAssembler<2> contact;
  };
} // namespace abut::hosts

#endif
