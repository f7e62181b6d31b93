// SPDX-License-Identifier: LGPL-2.1-or-later
#include "linear_stiffness.h"

#include "shim/cell_quadrature.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>

#include <array>

namespace abut::app
{
  namespace
  {
    template <int dim> class RecoveredGradients
    {
    public:
      RecoveredGradients(const dealii::Mapping<dim> &mapping,
                         const dealii::DoFHandler<dim> &dof_handler,
                         const la::Vector &displacement,
                         const Materials<dim> &materials)
          : dof_handler(dof_handler),
            displacement(displacement),
            materials(materials),
            points(mapping, dof_handler.get_fe(),
                   shim::gauss(dof_handler.get_fe(), 2),
                   dealii::update_values | dealii::update_gradients
                       | dealii::update_quadrature_points
                       | dealii::update_JxW_values),
            scalar(dof_handler.get_triangulation()),
            u(points.n_quadrature_points),
            gradient(points.n_quadrature_points)
      {
        scalar.distribute_dofs(dealii::FE_SimplexP<dim>(1));
        dofs.resize(scalar.get_fe().n_dofs_per_cell());
        recover();
      }

      /** Energies of this rank: of the difference, and of the solution. */
      std::array<double, 2> energies()
      {
        const auto &fe = scalar.get_fe();
        const std::vector<dealii::Point<dim>> &unit =
            points.get_quadrature().get_points();
        std::array<double, 2> result = {{0., 0.}};
        for_each_cell(
            [&](const Material<dim> &material)
            {
              for (unsigned int q = 0; q < unit.size(); ++q)
              {
                dealii::Tensor<2, dim> difference(-gradient[q]);
                for (unsigned int v = 0; v < dofs.size(); ++v)
                  for (unsigned int i = 0; i < dim; ++i)
                    for (unsigned int j = 0; j < dim; ++j)
                      difference[i][j] += fe.shape_value(v, unit[q])
                                          * sums[dim * i + j](dofs[v])
                                          / sums.back()(dofs[v]);
                const dealii::Point<dim> &x = points.quadrature_point(q);
                const double weight = points.JxW(q) * material.measure(x);
                result[0] += weight * material.energy(difference, {}, x);
                result[1] += weight * material.energy(gradient[q], u[q], x);
              }
            });
        return result;
      }

    private:
      /** Call @p action with the material of each cell of this rank, with the
       * other members those of the cell. */
      template <class Action> void for_each_cell(const Action &action)
      {
        const dealii::FEValuesExtractors::Vector field(0);
        for (const auto &cell : dof_handler.active_cell_iterators())
        {
          if (!cell->is_locally_owned())
            continue;
          points.reinit(cell);
          points[field].get_function_values(displacement, u);
          points[field].get_function_gradients(displacement, gradient);
          typename dealii::DoFHandler<dim>::active_cell_iterator(
              &scalar.get_triangulation(), cell->level(), cell->index(),
              &scalar)
              ->get_dof_indices(dofs);
          action(*materials.at(cell->material_id()));
        }
      }

      /** Sums over cells at vertices: volume times gradient, volume last. */
      void recover()
      {
        const dealii::IndexSet relevant =
            dealii::DoFTools::extract_locally_relevant_dofs(scalar);
        const MPI_Comm communicator = versions::communicator(scalar);
        std::vector<la::Vector> open(dim * dim + 1);
        for (la::Vector &sum : open)
          sum.reinit(scalar.locally_owned_dofs(), relevant, communicator, true);
        for_each_cell(
            [&](const Material<dim> &)
            {
              for (unsigned int q = 0; q < gradient.size(); ++q)
                for (const auto dof : dofs)
                {
                  for (unsigned int i = 0; i < dim; ++i)
                    for (unsigned int j = 0; j < dim; ++j)
                      open[dim * i + j](dof) +=
                          points.JxW(q) * gradient[q][i][j];
                  open.back()(dof) += points.JxW(q);
                }
            });
        for (la::Vector &sum : open)
        {
          sum.compress(dealii::VectorOperation::add);
          la::Vector owned(scalar.locally_owned_dofs(), communicator);
          owned = sum;
          sums.emplace_back(scalar.locally_owned_dofs(), relevant,
                            communicator);
          sums.back() = owned;
        }
      }

      const dealii::DoFHandler<dim> &dof_handler;
      const la::Vector &displacement;
      const Materials<dim> &materials;
      dealii::FEValues<dim> points;
      dealii::DoFHandler<dim> scalar;
      std::vector<dealii::Tensor<1, dim>> u;
      std::vector<dealii::Tensor<2, dim>> gradient;
      std::vector<dealii::types::global_dof_index> dofs;
      std::vector<la::Vector> sums;
    };
  } // namespace

  template <int dim>
  double linear_stiffness_error(const dealii::Mapping<dim> &mapping,
                                const dealii::DoFHandler<dim> &dof_handler,
                                const la::Vector &displacement,
                                const Materials<dim> &materials)
  {
    const std::array<double, 2> energies =
        RecoveredGradients<dim>(mapping, dof_handler, displacement, materials)
            .energies();
    const MPI_Comm communicator = versions::communicator(dof_handler);
    const double error = dealii::Utilities::MPI::sum(energies[0], communicator),
                 all = dealii::Utilities::MPI::sum(energies[1], communicator);
    return error > 0. ? error / (error + all) : 0.;
  }

  template double linear_stiffness_error(const dealii::Mapping<2> &,
                                         const dealii::DoFHandler<2> &,
                                         const la::Vector &,
                                         const Materials<2> &);
  template double linear_stiffness_error(const dealii::Mapping<3> &,
                                         const dealii::DoFHandler<3> &,
                                         const la::Vector &,
                                         const Materials<3> &);
} // namespace abut::app
