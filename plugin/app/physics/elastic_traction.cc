// SPDX-License-Identifier: LGPL-2.1-or-later
#include "elastic_traction.h"

#include "cell_volume.h"
#include "shim/cell_quadrature.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

namespace abut::app
{
  namespace
  {
    /** The material for each value of a cell being 1 and the others 0. */
    template <int dim>
    std::vector<std::shared_ptr<const Material<dim>>> by_values(
        const dealii::Mapping<dim> &mapping,
        const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
        const Material<dim> &material)
    {
      const dealii::Quadrature<dim> quadrature = shim::gauss(
          cell->get_fe(),
          material.cell_volume() != nullptr ? cell->get_fe().degree + 1 : 1);
      dealii::FEValues<dim> points(
          mapping, cell->get_fe(), quadrature,
          dealii::update_values | dealii::update_gradients
              | dealii::update_quadrature_points | dealii::update_JxW_values);
      points.reinit(cell);
      const dealii::FEValuesExtractors::Vector displacement(0);
      CellState<dim> state;
      state.value.resize(quadrature.size());
      state.gradient.resize(quadrature.size());
      std::vector<std::shared_ptr<const Material<dim>>> result;
      for (unsigned int k = 0; k < points.dofs_per_cell; ++k)
      {
        for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          state.value[q] = points[displacement].value(k, q);
          state.gradient[q] = points[displacement].gradient(k, q);
        }
        result.push_back(material.in_cell(points, state));
      }
      return result;
    }
  } // namespace

  template <int dim>
  void ElasticTraction<dim>::evaluate(
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
      const std::vector<dealii::Point<dim>> &unit_point,
      const std::vector<dealii::Tensor<1, dim>> &normal,
      dealii::FullMatrix<double> &derivative) const
  {
    dealii::FEValues<dim> values(
        mapping_, cell->get_fe(), dealii::Quadrature<dim>(unit_point),
        dealii::update_values | dealii::update_gradients
            | dealii::update_quadrature_points);
    values.reinit(cell);
    const auto materials =
        by_values<dim>(mapping_, cell, *materials_.at(cell->material_id()));
    const dealii::FEValuesExtractors::Vector displacement(0);
    for (unsigned int q = 0; q < unit_point.size(); ++q)
      for (unsigned int k = 0; k < values.dofs_per_cell; ++k)
      {
        const Stress<dim> part = materials[k]->stress(
            values[displacement].gradient(k, q),
            values[displacement].value(k, q), values.quadrature_point(q));
        const dealii::Tensor<1, dim> traction = part.tensor * normal[q];
        for (unsigned int d = 0; d < dim; ++d)
          derivative(q * dim + d, k) = traction[d];
      }
  }

  template class ElasticTraction<2>;
  template class ElasticTraction<3>;
} // namespace abut::app
