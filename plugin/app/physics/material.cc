// SPDX-License-Identifier: LGPL-2.1-or-later
#include "material.h"

#include "cell_volume.h"
#include "nodal_places.h"

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
  double Material<dim>::dilation(const dealii::Tensor<2, dim> &gradient,
                                 const dealii::Tensor<1, dim> &displacement,
                                 const dealii::Point<dim> &point) const
  {
    return trace(gradient) + hoop_strain(gradient, displacement, point);
  }

  template <int dim>
  dealii::Tensor<1, dim>
  Material<dim>::stress_divergence(const dealii::Tensor<3, dim> &hessian,
                                   const dealii::Tensor<2, dim> &gradient,
                                   const dealii::Tensor<1, dim> &displacement,
                                   const dealii::Point<dim> &point) const
  {
    const double hoop = hoop_strain(gradient, displacement, point);
    dealii::Tensor<1, dim> result;
    for (unsigned int j = 0; j < dim; ++j)
    {
      dealii::Tensor<2, dim> along;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int k = 0; k < dim; ++k)
          along[i][k] = hessian[i][k][j];
      // The displacement whose hoop strain changes as that of the state does.
      dealii::Tensor<1, dim> radial;
      if (is_axisymmetric())
        radial[0] = gradient[0][j] - (j == 0 ? hoop : 0.);
      const NominalStress<dim> change =
          tangent(gradient, displacement, point, along, radial);
      for (unsigned int i = 0; i < dim; ++i)
        result[i] += change.tensor[i][j];
    }
    if (is_axisymmetric())
    {
      // What the turning base vectors add.
      const NominalStress<dim> s =
          nominal_stress(gradient, displacement, point);
      result[0] += (s.tensor[0][0] - s.out_of_plane) / point[0];
      result[1] += s.tensor[1][0] / point[0];
    }
    return result;
  }

  template <int dim>
  NominalStress<dim>
  Material<dim>::Moduli::change(const unsigned int component,
                                const dealii::Tensor<1, dim> &shape_gradient,
                                const double shape_value) const
  {
    NominalStress<dim> result;
    const auto add = [&](const double factor, const NominalStress<dim> &part)
    {
      result.tensor += factor * part.tensor;
      result.out_of_plane += factor * part.out_of_plane;
    };
    for (unsigned int d = 0; d < dim; ++d)
      add(shape_gradient[d], of_gradient[component][d]);
    if (component == 0 && has_radius)
      add(shape_value, of_radius);
    return result;
  }

  template <int dim>
  typename Material<dim>::Moduli
  Material<dim>::moduli(const dealii::Tensor<2, dim> &gradient,
                        const dealii::Tensor<1, dim> &displacement,
                        const dealii::Point<dim> &point) const
  {
    return moduli_by(
        [&](const dealii::Tensor<2, dim> &gradient_change,
            const dealii::Tensor<1, dim> &displacement_change)
        {
          return tangent(gradient, displacement, point, gradient_change,
                         displacement_change);
        });
  }

  template <int dim>
  void Material<dim>::cell_tangent(const dealii::FEValues<dim> &values,
                                   const dealii::FiniteElement<dim> &fe,
                                   const CellState<dim> &state,
                                   dealii::FullMatrix<double> &result) const
  {
    result = 0.;
    const NodalPlaces<dim> places(fe);
    CellState<dim> undeformed;
    if (is_linear())
    {
      undeformed.value.resize(values.n_quadrature_points);
      undeformed.gradient.resize(values.n_quadrature_points);
    }
    const CellState<dim> &at = is_linear() ? undeformed : state;
    const auto material = in_cell(values, at);
    for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    {
      const dealii::Point<dim> &x = values.quadrature_point(q);
      const double weight = values.JxW(q) * measure(x);
      const Moduli moduli = material->moduli(at.gradient[q], at.value[q], x);
      for (unsigned int column = 0; column < fe.n_dofs_per_cell(); ++column)
      {
        const auto [component, node] = fe.system_to_component_index(column);
        const NominalStress<dim> change = moduli.change(
            component, values.shape_grad(node, q), values.shape_value(node, q));
        for (unsigned int i = 0; i < places.n_nodes(); ++i)
        {
          const auto force = nodal_force(values, change, i, q);
          for (unsigned int c = 0; c < dim; ++c)
            result(places(c, i), column) += weight * force[c];
        }
      }
    }
    add_volume_stiffness(values, fe, at, result);
  }

  template <int dim>
  void Material<dim>::add_volume_stiffness(
      const dealii::FEValues<dim> &values, const dealii::FiniteElement<dim> &fe,
      const CellState<dim> &state, dealii::FullMatrix<double> &result) const
  {
    const CellVolume<dim> *of_cell = cell_volume();
    if (of_cell == nullptr)
      return;
    // Derivative of the cell's volume by its values.
    const NodalPlaces<dim> places(fe);
    dealii::Vector<double> slope(fe.n_dofs_per_cell());
    double volume = 0.;
    for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    {
      const dealii::Point<dim> &x = values.quadrature_point(q);
      const double weight = values.JxW(q) * measure(x);
      volume += weight;
      add_nodal_forces(
          values, places,
          of_cell->change_slope(state.gradient[q], state.value[q], x), q,
          weight, slope);
    }
    const double factor =
        of_cell->bulk_tangent(of_cell->mean_change(*this, values, state))
        / volume;
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      for (unsigned int j = 0; j < fe.n_dofs_per_cell(); ++j)
        result(i, j) += factor * slope(i) * slope(j);
  }

  template <int dim>
  std::shared_ptr<const Material<dim>>
  Material<dim>::in_cell(const dealii::FEValues<dim> &values,
                         const CellState<dim> &state) const
  {
    if (const CellVolume<dim> *of_cell = cell_volume())
      return of_cell->held_at(of_cell->mean_change(*this, values, state));
    return {std::shared_ptr<const Material<dim>>(), this};
  }

  template <int dim>
  dealii::Tensor<1, dim> Material<dim>::nodal_force(
      const dealii::FEValues<dim> &values, const NominalStress<dim> &stress,
      const unsigned int node, const unsigned int q) const
  {
    dealii::Tensor<1, dim> force = stress.tensor * values.shape_grad(node, q);
    if (is_axisymmetric())
      force[0] += stress.out_of_plane * values.shape_value(node, q)
                  / values.quadrature_point(q)[0];
    return force;
  }

  template <int dim>
  void Material<dim>::cell_forces(const dealii::FEValues<dim> &values,
                                  const dealii::FiniteElement<dim> &fe,
                                  const CellState<dim> &state,
                                  dealii::Vector<double> &forces) const
  {
    forces = 0.;
    const NodalPlaces<dim> places(fe);
    const auto material = in_cell(values, state);
    for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    {
      const dealii::Point<dim> &x = values.quadrature_point(q);
      add_nodal_forces(
          values, places,
          material->nominal_stress(state.gradient[q], state.value[q], x), q,
          values.JxW(q) * measure(x), forces);
    }
  }

  template <int dim>
  void Material<dim>::add_nodal_forces(const dealii::FEValues<dim> &values,
                                       const NodalPlaces<dim> &places,
                                       const NominalStress<dim> &stress,
                                       const unsigned int q,
                                       const double volume,
                                       dealii::Vector<double> &forces) const
  {
    for (unsigned int i = 0; i < places.n_nodes(); ++i)
    {
      const auto force = nodal_force(values, stress, i, q);
      for (unsigned int c = 0; c < dim; ++c)
        forces(places(c, i)) += volume * force[c];
    }
  }

  template struct Stress<2>;
  template struct Stress<3>;
  template class Material<2>;
  template class Material<3>;
} // namespace abut::app
