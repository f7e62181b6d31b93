// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hooke.h"

#include "material_kind.h"
#include "nodal_places.h"

namespace abut::app
{
  template <int dim>
  Hooke<dim>::Hooke(const double young_modulus, const double poisson_ratio,
                    const PlaneModel plane, const VolumeChange volume)
      : Material<dim>(plane),
        young_modulus_(young_modulus),
        poisson_ratio_(poisson_ratio),
        volume_(volume)
  {
  }

  template <int dim> double Hooke<dim>::mu() const
  {
    return young_modulus_ / (2. * (1. + poisson_ratio_));
  }

  template <int dim> double Hooke<dim>::lambda() const
  {
    const double nu = poisson_ratio_;
    const double below =
        dim == 2 && this->plane == PlaneModel::stress ? 1. - nu : 1. - 2. * nu;
    return young_modulus_ * nu / ((1. + nu) * below);
  }

  template <int dim>
  Stress<dim> Hooke<dim>::stress(const dealii::Tensor<2, dim> &gradient,
                                 const dealii::Tensor<1, dim> &displacement,
                                 const dealii::Point<dim> &point) const
  {
    const double hoop = this->hoop_strain(gradient, displacement, point);
    return stress_of(gradient, hoop, held_ ? *held_ : trace(gradient) + hoop);
  }

  template <int dim>
  Stress<dim> Hooke<dim>::stress_of(const dealii::Tensor<2, dim> &gradient,
                                    const double hoop,
                                    const double volume_change) const
  {
    const double mu = this->mu(), pressure = lambda() * volume_change;
    Stress<dim> result;
    result.tensor = 2. * mu * symmetrize(gradient);
    for (unsigned int d = 0; d < dim; ++d)
      result.tensor[d][d] += pressure;
    if (dim == 2 && this->plane != PlaneModel::stress)
      result.out_of_plane = pressure + 2. * mu * hoop;
    return result;
  }

  template <int dim>
  double Hooke<dim>::energy(const dealii::Tensor<2, dim> &gradient,
                            const dealii::Tensor<1, dim> &displacement,
                            const dealii::Point<dim> &point) const
  {
    const Stress<dim> s = Hooke<dim>::stress(gradient, displacement, point);
    const double half =
        0.5
        * (s.tensor * symmetrize(gradient)
           + s.out_of_plane * this->hoop_strain(gradient, displacement, point));
    if (!held_)
      return half;
    return half
           + 0.5 * lambda() * *held_
                 * (this->dilation(gradient, displacement, point) - *held_);
  }

  template <int dim>
  NominalStress<dim> Hooke<dim>::change_slope(const dealii::Tensor<2, dim> &,
                                              const dealii::Tensor<1, dim> &,
                                              const dealii::Point<dim> &) const
  {
    NominalStress<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result.tensor[d][d] = 1.;
    result.out_of_plane = this->is_axisymmetric() ? 1. : 0.;
    return result;
  }

  template <int dim>
  std::shared_ptr<const Material<dim>>
  Hooke<dim>::held_at(const double mean_change) const
  {
    auto held = std::make_shared<Hooke<dim>>(*this);
    held->volume_ = VolumeChange::of_point;
    held->held_ = mean_change;
    return held;
  }

  template <int dim>
  NominalStress<dim>
  Hooke<dim>::nominal_stress(const dealii::Tensor<2, dim> &gradient,
                             const dealii::Tensor<1, dim> &displacement,
                             const dealii::Point<dim> &point) const
  {
    const Stress<dim> s = Hooke<dim>::stress(gradient, displacement, point);
    return {s.tensor, s.out_of_plane};
  }

  template <int dim>
  NominalStress<dim>
  Hooke<dim>::tangent(const dealii::Tensor<2, dim> &,
                      const dealii::Tensor<1, dim> &,
                      const dealii::Point<dim> &point,
                      const dealii::Tensor<2, dim> &gradient_change,
                      const dealii::Tensor<1, dim> &displacement_change) const
  {
    const double hoop =
        this->hoop_strain(gradient_change, displacement_change, point);
    const Stress<dim> s = stress_of(gradient_change, hoop,
                                    held_ ? 0. : trace(gradient_change) + hoop);
    return {s.tensor, s.out_of_plane};
  }

  template <int dim>
  dealii::Tensor<1, dim>
  Hooke<dim>::stress_divergence(const dealii::Tensor<3, dim> &hessian,
                                const dealii::Tensor<2, dim> &gradient,
                                const dealii::Tensor<1, dim> &displacement,
                                const dealii::Point<dim> &point) const
  {
    const double lambda = held_ ? 0. : this->lambda(), mu = this->mu();
    dealii::Tensor<1, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        result[i] += (lambda + mu) * hessian[j][j][i] + mu * hessian[i][j][j];
    if (this->is_axisymmetric())
    {
      const double r = point[0];
      const double hoop = displacement[0] / r;
      const Stress<dim> s = Hooke<dim>::stress(gradient, displacement, point);
      // lambda grad(u_r/r), then what the turning base vectors add.
      result[0] += lambda * (gradient[0][0] - hoop) / r
                   + (s.tensor[0][0] - s.out_of_plane) / r;
      result[1] += lambda * gradient[0][1] / r + s.tensor[0][1] / r;
    }
    return result;
  }

  template <int dim>
  void Hooke<dim>::cell_tangent(const dealii::FEValues<dim> &values,
                                const dealii::FiniteElement<dim> &fe,
                                const CellState<dim> &,
                                dealii::FullMatrix<double> &result) const
  {
    if (cell_volume() == nullptr)
    {
      pointwise_tangent(values, fe, held_ ? 0. : lambda(), result);
      return;
    }
    CellState<dim> undeformed;
    undeformed.value.resize(values.n_quadrature_points);
    undeformed.gradient.resize(values.n_quadrature_points);
    pointwise_tangent(values, fe, 0., result);
    this->add_volume_stiffness(values, fe, undeformed, result);
  }

  template <int dim>
  void Hooke<dim>::pointwise_tangent(const dealii::FEValues<dim> &values,
                                     const dealii::FiniteElement<dim> &fe,
                                     const double lambda,
                                     dealii::FullMatrix<double> &result) const
  {
    const double mu = this->mu();
    const bool rings = this->is_axisymmetric();
    const NodalPlaces<dim> places(fe);
    for (unsigned int i = 0; i < places.n_nodes(); ++i)
      for (unsigned int j = 0; j <= i; ++j)
      {
        dealii::Tensor<2, dim> product;
        // Hoop strain with div u: (i, j), (j, i); with itself.
        dealii::Tensor<1, dim> hoop_i, hoop_j;
        double hoop = 0.;
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          const double weight =
              values.JxW(q) * this->measure(values.quadrature_point(q));
          product +=
              weight
              * outer_product(values.shape_grad(i, q), values.shape_grad(j, q));
          if (rings)
          {
            const double r = values.quadrature_point(q)[0];
            hoop_i +=
                weight * values.shape_value(i, q) / r * values.shape_grad(j, q);
            hoop_j +=
                weight * values.shape_value(j, q) / r * values.shape_grad(i, q);
            hoop += weight * values.shape_value(i, q) * values.shape_value(j, q)
                    / (r * r);
          }
        }
        const double trace_of = trace(product);
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
          {
            double entry = lambda * product[a][b] + mu * product[b][a]
                           + (a == b ? mu * trace_of : 0.);
            if (rings)
              entry +=
                  lambda
                      * ((a == 0 ? hoop_i[b] : 0.) + (b == 0 ? hoop_j[a] : 0.))
                  + (a == 0 && b == 0 ? (lambda + 2. * mu) * hoop : 0.);
            const unsigned int row = places(a, i);
            const unsigned int column = places(b, j);
            result(row, column) = entry;
            result(column, row) = entry;
          }
      }
  }

  template class Hooke<2>;
  template class Hooke<3>;

  namespace
  {
    template <int dim>
    std::shared_ptr<const Material<dim>> make_hooke(const MaterialData &data)
    {
      return std::make_shared<Hooke<dim>>(data.numbers[0], data.numbers[1],
                                          data.plane, data.volume);
    }
  } // namespace

  extern const MaterialKind hooke_kind = {
      "hooke", "small strain.",   false,         true,         nullptr, nullptr,
      nullptr, elastic_constants, make_hooke<2>, make_hooke<3>};
} // namespace abut::app
