// SPDX-License-Identifier: LGPL-2.1-or-later
#include "elastic_traction.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe_values.h>

namespace abut::app
{
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
    const Material<dim> &material = *materials_.at(cell->material_id());
    const dealii::FEValuesExtractors::Vector displacement(0);
    for (unsigned int q = 0; q < unit_point.size(); ++q)
      for (unsigned int k = 0; k < values.dofs_per_cell; ++k)
      {
        const Stress<dim> part = material.stress(
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
