// SPDX-License-Identifier: LGPL-2.1-or-later
#include "linear_stiffness.h"

#include "nodal_means.h"
#include "scalar_field.h"
#include "shim/by_element.h"
#include "shim/cell_quadrature.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <array>

namespace abut::app
{
  namespace
  {
    template <int dim> class RecoveredStrains
    {
    public:
      RecoveredStrains(const dealii::Mapping<dim> &mapping,
                       const dealii::DoFHandler<dim> &dof_handler,
                       const la::Vector &displacement,
                       const Materials<dim> &materials, const bool large_strain)
          : dof_handler(dof_handler),
            displacement(displacement),
            materials(materials),
            large_strain(large_strain),
            points(mapping, simplex_element(dof_handler),
                   shim::gauss(simplex_element(dof_handler), 2),
                   dealii::update_values | dealii::update_gradients
                       | dealii::update_quadrature_points
                       | dealii::update_JxW_values),
            scalar(dof_handler.get_triangulation()),
            u(points.n_quadrature_points),
            gradient(points.n_quadrature_points)
      {
        distribute_linear(dof_handler, scalar);
      }

      /** Energies of this rank: of the difference, and of the solution.
       * Collective. */
      std::array<double, 2> energies()
      {
        NodalMeans<dim> means(scalar, dim * dim);
        for_each_cell(
            [&](const auto &cell)
            {
              for (const auto node : means.nodes(cell))
                for (unsigned int q = 0; q < gradient.size(); ++q)
                  means.add(node, points.JxW(q),
                            components(strain(gradient[q])));
            });
        std::vector<la::Vector> recovered;
        for (const la::Vector &mean : means.means())
          recovered.push_back(means.ghosted(mean));
        const auto &fe = simplex_element(scalar);
        std::array<double, 2> result = {{0., 0.}};
        for_each_cell(
            [&](const auto &cell)
            {
              const Material<dim> &material =
                  *materials.at(cell->material_id());
              const auto &nodes = means.nodes(cell);
              for (unsigned int q = 0; q < gradient.size(); ++q)
              {
                dealii::Tensor<2, dim> difference(-strain(gradient[q]));
                for (unsigned int v = 0; v < nodes.size(); ++v)
                  for (unsigned int c = 0; c < recovered.size(); ++c)
                    difference[c / dim][c % dim] +=
                        fe.shape_value(v, points.get_quadrature().point(q))
                        * recovered[c](nodes[v]);
                const dealii::Point<dim> &x = points.quadrature_point(q);
                const double weight = points.JxW(q) * material.measure(x);
                result[0] += weight * material.energy(difference, {}, x);
                result[1] += weight * material.energy(gradient[q], u[q], x);
              }
            });
        return result;
      }

    private:
      static const dealii::FiniteElement<dim> &
      simplex_element(const dealii::DoFHandler<dim> &field)
      {
        const auto all = shim::elements(field);
        return **std::find_if(all.begin(), all.end(),
                              [](const auto *fe)
                              { return shim::is_simplex(*fe); });
      }

      static std::vector<double>
      components(const dealii::Tensor<2, dim> &strain)
      {
        std::vector<double> result;
        for (unsigned int c = 0; c < dim * dim; ++c)
          result.push_back(strain[c / dim][c % dim]);
        return result;
      }

      /** Small strain or Green's. */
      dealii::Tensor<2, dim>
      strain(const dealii::Tensor<2, dim> &gradient) const
      {
        dealii::Tensor<2, dim> result =
            0.5 * (gradient + dealii::transpose(gradient));
        if (large_strain)
          result += 0.5 * (dealii::transpose(gradient) * gradient);
        return result;
      }

      /** Call @p action with each cell of this rank, with points, u and
       * gradient those of the cell. */
      template <class Action> void for_each_cell(const Action &action)
      {
        const dealii::FEValuesExtractors::Vector field(0);
        for (const auto &cell : dof_handler.active_cell_iterators())
        {
          if (!cell->is_locally_owned() || !shim::is_simplex(cell->get_fe()))
            continue;
          points.reinit(cell);
          points[field].get_function_values(displacement, u);
          points[field].get_function_gradients(displacement, gradient);
          action(cell);
        }
      }

      const dealii::DoFHandler<dim> &dof_handler;
      const la::Vector &displacement;
      const Materials<dim> &materials;
      const bool large_strain;
      dealii::FEValues<dim> points;
      dealii::DoFHandler<dim> scalar;
      std::vector<dealii::Tensor<1, dim>> u;
      std::vector<dealii::Tensor<2, dim>> gradient;
    };
  } // namespace

  template <int dim>
  double linear_stiffness_error(const dealii::Mapping<dim> &mapping,
                                const dealii::DoFHandler<dim> &dof_handler,
                                const la::Vector &displacement,
                                const Materials<dim> &materials,
                                const bool large_strain)
  {
    const std::array<double, 2> energies =
        RecoveredStrains<dim>(mapping, dof_handler, displacement, materials,
                              large_strain)
            .energies();
    const MPI_Comm communicator = versions::communicator(dof_handler);
    const double error = dealii::Utilities::MPI::sum(energies[0], communicator),
                 all = dealii::Utilities::MPI::sum(energies[1], communicator);
    return error > 0. ? error / (error + all) : 0.;
  }

  template double linear_stiffness_error(const dealii::Mapping<2> &,
                                         const dealii::DoFHandler<2> &,
                                         const la::Vector &,
                                         const Materials<2> &, bool);
  template double linear_stiffness_error(const dealii::Mapping<3> &,
                                         const dealii::DoFHandler<3> &,
                                         const la::Vector &,
                                         const Materials<3> &, bool);
} // namespace abut::app
