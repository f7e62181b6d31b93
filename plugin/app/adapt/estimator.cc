// SPDX-License-Identifier: LGPL-2.1-or-later

#include "estimator.h"

#include "residual_estimator.h"

#include <algorithm>
#include <vector>

namespace abut::app
{
  namespace
  {
    template <int dim> class MembraneResidual : public ResidualTerms<dim, 1>
    {
    public:
      using Base = ResidualTerms<dim, 1>;
      using Cell = typename Base::Cell;
      using Flux = typename Base::Flux;

      explicit MembraneResidual(const EstimatorInput<dim> &input) : input(input)
      {
      }

      bool is_held(const Cell &cell) const override
      {
        if (input.active == nullptr)
          return false;
        std::vector<dealii::types::global_dof_index> dofs(
            cell->get_fe().n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        return std::all_of(dofs.begin(), dofs.end(),
                           [this](const dealii::types::global_dof_index dof)
                           { return (*input.active)(dof) != 0; });
      }

      double interior(const dealii::FEValues<dim> &points) const override
      {
        const auto &places = points.get_quadrature_points();
        std::vector<double> divergence(places.size());
        std::vector<double> loads(places.size());
        std::vector<double> coefficients(places.size(), 1.);
        points.get_function_laplacians(input.solution, divergence);
        input.load.value_list(places, loads);
        if (input.coefficient != nullptr)
        {
          std::vector<dealii::Tensor<1, dim>> gradients(places.size());
          points.get_function_gradients(input.solution, gradients);
          input.coefficient->value_list(places, coefficients);
          for (unsigned int q = 0; q < places.size(); ++q)
            divergence[q] =
                coefficients[q] * divergence[q]
                + input.coefficient->gradient(places[q]) * gradients[q];
        }
        double sum = 0;
        for (unsigned int q = 0; q < places.size(); ++q)
        {
          const double residual = loads[q] + divergence[q];
          sum += residual * residual / coefficients[q] * points.JxW(q);
        }
        return sum;
      }

      /** The coefficient is taken a little inside the cell, where a jump that
       * follows the mesh has its value of this side. */
      void fluxes(const dealii::FEFaceValuesBase<dim> &points,
                  std::vector<Flux> &flux,
                  std::vector<double> &stiffness) const override
      {
        std::vector<dealii::Tensor<1, dim>> gradients(flux.size());
        points.get_function_gradients(input.solution, gradients);
        std::fill(stiffness.begin(), stiffness.end(), 1.);
        if (input.coefficient != nullptr)
        {
          auto inner_points = points.get_quadrature_points();
          const dealii::Point<dim> center = points.get_cell()->center();
          for (dealii::Point<dim> &point : inner_points)
            point += 1e-10 * (center - point);
          input.coefficient->value_list(inner_points, stiffness);
        }
        for (unsigned int q = 0; q < flux.size(); ++q)
          flux[q][0] = stiffness[q] * (gradients[q] * points.normal_vector(q));
      }

      void boundary_residual(const dealii::FEFaceValues<dim> &points,
                             const dealii::types::boundary_id id,
                             std::vector<Flux> &flux) const override
      {
        if (input.dirichlet.count(id) > 0)
        {
          std::fill(flux.begin(), flux.end(), Flux());
          return;
        }
        std::vector<double> asked(flux.size(), 0.);
        const auto traction = input.neumann.find(id);
        if (traction != input.neumann.end())
          traction->second->value_list(points.get_quadrature_points(), asked);
        std::vector<double> pressure(flux.size(), 0.);
        if (input.pressure != nullptr && input.contact.count(id) > 0)
          points.get_function_values(*input.pressure, pressure);
        for (unsigned int q = 0; q < flux.size(); ++q)
          flux[q][0] = asked[q] + pressure[q] - flux[q][0];
      }

    private:
      const EstimatorInput<dim> &input;
    };
  } // namespace

  template <int dim>
  double estimate_error(const EstimatorInput<dim> &input,
                        dealii::Vector<float> &squared)
  {
    return estimate_residual(input.mapping, input.dof_handler,
                             MembraneResidual<dim>(input), squared);
  }

  template double estimate_error<2>(const EstimatorInput<2> &,
                                    dealii::Vector<float> &);
  template double estimate_error<3>(const EstimatorInput<3> &,
                                    dealii::Vector<float> &);
} // namespace abut::app
