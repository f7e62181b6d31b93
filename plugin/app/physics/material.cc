// SPDX-License-Identifier: LGPL-2.1-or-later
#include "material.h"

#include <deal.II/base/numbers.h>

#include <cmath>

namespace abut::app
{
  template <int dim> double Stress<dim>::von_mises() const
  {
    const double mean = (trace(tensor) + out_of_plane) / 3.;
    double sum = dim == 2 ? (out_of_plane - mean) * (out_of_plane - mean) : 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
      {
        const double s = tensor[i][j] - (i == j ? mean : 0.);
        sum += s * s;
      }
    return std::sqrt(1.5 * sum);
  }

  template <int dim>
  double Material<dim>::measure(const dealii::Point<dim> &point) const
  {
    return is_axisymmetric() ? 2. * dealii::numbers::PI * point[0] : 1.;
  }

  template <int dim>
  double Material<dim>::hoop_strain(const dealii::Tensor<2, dim> &gradient,
                                    const dealii::Tensor<1, dim> &displacement,
                                    const dealii::Point<dim> &point) const
  {
    if (!is_axisymmetric())
      return 0.;
    return point[0] > 0. ? displacement[0] / point[0] : gradient[0][0];
  }

  template <int dim>
  void Material<dim>::cell_forces(const dealii::FEValues<dim> &values,
                                  const dealii::FiniteElement<dim> &fe,
                                  const CellState<dim> &state,
                                  dealii::Vector<double> &forces) const
  {
    forces = 0.;
    const unsigned int n_nodes = fe.base_element(0).n_dofs_per_cell();
    for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    {
      const dealii::Point<dim> &x = values.quadrature_point(q);
      const double weight = values.JxW(q) * measure(x);
      const Stress<dim> s = stress(state.gradient[q], state.value[q], x);
      for (unsigned int i = 0; i < n_nodes; ++i)
      {
        dealii::Tensor<1, dim> force = s.tensor * values.shape_grad(i, q);
        if (is_axisymmetric())
          force[0] += s.out_of_plane * values.shape_value(i, q) / x[0];
        for (unsigned int c = 0; c < dim; ++c)
          forces(fe.component_to_system_index(c, i)) += weight * force[c];
      }
    }
  }

  template struct Stress<2>;
  template struct Stress<3>;
  template class Material<2>;
  template class Material<3>;
} // namespace abut::app
