// SPDX-License-Identifier: LGPL-2.1-or-later
#include "locking.h"
#include "shim/cell_quadrature.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <array>

namespace abut::app
{
  namespace
  {
    /** Energies of the solution, of varying volume, of varying shear. */
    using Energies = std::array<double, 3>;

    /** Strains of a cell that moves by its diameter without deformation. */
    constexpr double rigid_strain = 1e-9;

    template <int dim> class LockingOfCell
    {
    public:
      LockingOfCell(const dealii::FEValues<dim> &points,
                    const la::Vector &displacement,
                    const Material<dim> &material, const bool large_strain)
          : points(points), material(material), large_strain(large_strain)
      {
        const dealii::FEValuesExtractors::Vector field(0);
        const unsigned int n = points.n_quadrature_points;
        state.value.resize(n);
        state.gradient.resize(n);
        points[field].get_function_values(displacement, state.value);
        points[field].get_function_gradients(displacement, state.gradient);
        for (unsigned int q = 0; q < n; ++q)
          weights.push_back(points.JxW(q)
                            * material.measure(points.quadrature_point(q)));
      }

      void add_to(Energies &energies) const
      {
        const auto in_cell = material.in_cell(points, state);
        double energy = 0., of_round_off = 0.;
        for (unsigned int q = 0; q < weights.size(); ++q)
        {
          energy += weights[q]
                    * in_cell->energy(state.gradient[q], state.value[q],
                                      points.quadrature_point(q));
          of_round_off +=
              weights[q] * material.stiffness()
              * (state.value[q] * rigid_strain / points.get_cell()->diameter())
                    .norm_square();
        }
        energies[0] += energy;
        if (energy <= of_round_off)
          return;
        if (material.cell_volume() == nullptr)
          energies[1] += of_volume();
        energies[2] += of_shear();
      }

    private:
      double of_volume() const
      {
        double volume = 0., first = 0., second = 0.;
        for (unsigned int q = 0; q < weights.size(); ++q)
        {
          const double dilation = material.dilation(
              state.gradient[q], state.value[q], points.quadrature_point(q));
          volume += weights[q];
          first += weights[q] * dilation;
          second += weights[q] * dilation * dilation;
        }
        return material.dilation_stiffness() / 2.
               * std::max(0., second - first * first / volume);
      }

      double of_shear() const
      {
        // Strains between fixed directions, those of the edges in the mean: so
        // a constant strain does not vary in distorted cells.
        dealii::Tensor<2, dim> edges;
        for (unsigned int q = 0; q < weights.size(); ++q)
          edges +=
              dealii::Tensor<2, dim>(dealii::transpose(points.jacobian(q)));
        for (unsigned int i = 0; i < dim; ++i)
          edges[i] /= edges[i].norm();
        std::vector<dealii::Tensor<2, dim>> strain, varying(weights.size());
        for (const dealii::Tensor<2, dim> &gradient : state.gradient)
        {
          dealii::Tensor<2, dim> here = gradient + dealii::transpose(gradient);
          if (large_strain)
            here += dealii::transpose(gradient) * gradient;
          strain.push_back(0.5 * edges * here * dealii::transpose(edges));
        }
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < i; ++j)
          {
            // Along the third direction it varies in torsion.
            const auto layer = [&](const unsigned int q)
            { return dim == 3 ? q >> (3 - i - j) & 1 : 0; };
            std::array<double, 2> volume{}, sum{};
            for (unsigned int q = 0; q < weights.size(); ++q)
            {
              volume[layer(q)] += weights[q];
              sum[layer(q)] += weights[q] * strain[q][i][j];
            }
            for (unsigned int q = 0; q < weights.size(); ++q)
              varying[q][i][j] = varying[q][j][i] =
                  strain[q][i][j] - sum[layer(q)] / volume[layer(q)];
          }
        const dealii::Tensor<2, dim> back = dealii::invert(edges);
        double energy = 0.;
        for (unsigned int q = 0; q < weights.size(); ++q)
          energy +=
              weights[q]
              * material.energy(back * varying[q] * dealii::transpose(back), {},
                                points.quadrature_point(q));
        return energy;
      }

      const dealii::FEValues<dim> &points;
      const Material<dim> &material;
      const bool large_strain;
      CellState<dim> state;
      std::vector<double> weights;
    };
  } // namespace

  template <int dim>
  Locking locking(const dealii::Mapping<dim> &mapping,
                  const dealii::DoFHandler<dim> &dof_handler,
                  const la::Vector &displacement,
                  const Materials<dim> &materials, const bool large_strain)
  {
    const auto points_of = shim::cell_values(
        mapping, dof_handler, shim::mass_rule<dim>,
        dealii::update_values | dealii::update_gradients
            | dealii::update_jacobians | dealii::update_quadrature_points
            | dealii::update_JxW_values);
    Energies energies{};
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && !shim::is_simplex(cell->get_fe()))
      {
        dealii::FEValues<dim> &points = points_of.of(cell);
        points.reinit(cell);
        LockingOfCell<dim>(points, displacement,
                           *materials.at(cell->material_id()), large_strain)
            .add_to(energies);
      }
    for (double &energy : energies)
      energy = dealii::Utilities::MPI::sum(energy,
                                           versions::communicator(dof_handler));
    if (energies[0] <= 0.)
      return {};
    return {energies[1] / energies[0], energies[2] / energies[0]};
  }

  template Locking locking(const dealii::Mapping<2> &,
                           const dealii::DoFHandler<2> &, const la::Vector &,
                           const Materials<2> &, bool);
  template Locking locking(const dealii::Mapping<3> &,
                           const dealii::DoFHandler<3> &, const la::Vector &,
                           const Materials<3> &, bool);
} // namespace abut::app
