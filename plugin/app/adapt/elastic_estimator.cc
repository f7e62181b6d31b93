// SPDX-License-Identifier: LGPL-2.1-or-later

#include "elastic_estimator.h"

#include "residual_estimator.h"

#include "app/physics/cell_volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace abut::app
{
  namespace
  {
    /** Of values 1 at all nodes. */
    constexpr double round_off = 1e-6;

    template <int dim> class ElasticResidual : public ResidualTerms<dim, dim>
    {
    public:
      using Base = ResidualTerms<dim, dim>;
      using Cell = typename Base::Cell;
      using Flux = typename Base::Flux;
      using Vectors = std::vector<dealii::Tensor<1, dim>>;

      explicit ElasticResidual(const ElasticEstimatorInput<dim> &input)
          : input(input),
            materials(input.mapping, input.dof_handler, input.solution,
                      input.materials),
            displacement(0)
      {
      }

      bool is_held(const Cell &) const override
      {
        return false;
      }

      double interior(const dealii::FEValues<dim> &points) const override
      {
        const auto &places = points.get_quadrature_points();
        const Material<dim> &material = material_at(points);
        Vectors values(places.size());
        std::vector<dealii::Tensor<2, dim>> gradients(places.size());
        std::vector<dealii::Tensor<3, dim>> hessians(places.size());
        const auto &u = points[displacement];
        u.get_function_values(input.solution, values);
        u.get_function_gradients(input.solution, gradients);
        u.get_function_hessians(input.solution, hessians);
        const auto force =
            input.body_force.find(points.get_cell()->material_id());
        double sum = 0;
        for (unsigned int q = 0; q < places.size(); ++q)
        {
          auto residual = material.stress_divergence(hessians[q], gradients[q],
                                                     values[q], places[q]);
          if (force != input.body_force.end())
            for (unsigned int d = 0; d < dim; ++d)
              residual[d] += force->second->value(places[q], d);
          sum += residual.norm_square() * points.JxW(q)
                 * material.measure(places[q]);
        }
        return sum / material.stiffness();
      }

      void fluxes(const dealii::FEFaceValuesBase<dim> &points,
                  std::vector<Flux> &flux,
                  std::vector<double> &stiffness) const override
      {
        const Material<dim> &material = material_at(points);
        Vectors values(flux.size());
        std::vector<dealii::Tensor<2, dim>> gradients(flux.size());
        points[displacement].get_function_values(input.solution, values);
        points[displacement].get_function_gradients(input.solution, gradients);
        for (unsigned int q = 0; q < flux.size(); ++q)
          flux[q] = material
                        .nominal_stress(gradients[q], values[q],
                                        points.quadrature_point(q))
                        .tensor
                    * points.normal_vector(q);
        std::fill(stiffness.begin(), stiffness.end(), material.stiffness());
      }

      void boundary_residual(const dealii::FEFaceValues<dim> &points,
                             const dealii::types::boundary_id id,
                             std::vector<Flux> &flux) const override
      {
        Vectors asked(flux.size());
        if (input.contact_traction != nullptr && input.contact.count(id) > 0)
          points[displacement].get_function_values(*input.contact_traction,
                                                   asked);
        add_loads(points, id, asked);
        const auto support = input.supports.find(id);
        for (unsigned int q = 0; q < flux.size(); ++q)
          for (unsigned int d = 0; d < dim; ++d)
            if (support != input.supports.end() && support->second[d])
              flux[q][d] = 0.;
            else
              flux[q][d] = asked[q][d] - flux[q][d];
      }

      double contact_term(const dealii::FEFaceValues<dim> &points,
                          const dealii::types::boundary_id id,
                          const double h) const override
      {
        if (input.pressure == nullptr || input.gap == nullptr
            || input.secondary.count(id) == 0)
          return 0.;
        const unsigned int n = points.n_quadrature_points;
        Vectors pressures(n);
        Vectors gaps(n);
        points[displacement].get_function_values(*input.pressure, pressures);
        points[displacement].get_function_values(*input.gap, gaps);
        const Material<dim> &material = material_at(points);
        double sum = 0;
        for (unsigned int q = 0; q < n; ++q)
        {
          // Where a node of the facet has no constraint the gap is unknown.
          if (std::abs(gaps[q][1] - 1.) > round_off)
            continue;
          const double p = pressures[q] * points.normal_vector(q);
          const double g = gaps[q][0];
          const double term =
              g < 0. ? material.stiffness() / h * g * g : std::max(p, 0.) * g;
          sum += term * points.JxW(q) * measure(points, q);
        }
        return sum;
      }

      double measure(const dealii::FEFaceValuesBase<dim> &points,
                     const unsigned int q) const override
      {
        return material_at(points).measure(points.quadrature_point(q));
      }

    private:
      const Material<dim> &
      material_at(const dealii::FEValuesBase<dim> &points) const
      {
        return materials.at(points.get_cell());
      }

      void add_loads(const dealii::FEFaceValues<dim> &points,
                     const dealii::types::boundary_id id, Vectors &asked) const
      {
        const auto traction = input.traction.find(id);
        const auto pressure = input.pressure_load.find(id);
        for (unsigned int q = 0; q < asked.size(); ++q)
        {
          const dealii::Point<dim> &place = points.quadrature_point(q);
          if (traction != input.traction.end())
            for (unsigned int d = 0; d < dim; ++d)
              asked[q][d] += traction->second->value(place, d);
          if (pressure != input.pressure_load.end())
            asked[q] -=
                pressure->second->value(place) * points.normal_vector(q);
        }
      }

      const ElasticEstimatorInput<dim> &input;
      const CellMaterials<dim> materials;
      const dealii::FEValuesExtractors::Vector displacement;
    };
  } // namespace

  template <int dim>
  double estimate_elastic_error(const ElasticEstimatorInput<dim> &input,
                                dealii::Vector<float> &squared)
  {
    return estimate_residual(input.mapping, input.dof_handler,
                             ElasticResidual<dim>(input), squared);
  }

  template double estimate_elastic_error<2>(const ElasticEstimatorInput<2> &,
                                            dealii::Vector<float> &);
  template double estimate_elastic_error<3>(const ElasticEstimatorInput<3> &,
                                            dealii::Vector<float> &);
} // namespace abut::app
