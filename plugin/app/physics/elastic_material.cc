// SPDX-License-Identifier: LGPL-2.1-or-later

#include "elastic_material.h"

#include <deal.II/base/numbers.h>

#include <cmath>

namespace abut::app
{
  double ElasticMaterial::mu() const
  {
    return young_modulus / (2. * (1. + poisson_ratio));
  }

  template <int dim> double ElasticMaterial::lambda() const
  {
    const double nu = poisson_ratio;
    const double below =
        dim == 2 && plane == PlaneModel::stress ? 1. - nu : 1. - 2. * nu;
    return young_modulus * nu / ((1. + nu) * below);
  }

  template <int dim>
  double ElasticMaterial::measure(const dealii::Point<dim> &point) const
  {
    return is_axisymmetric<dim>() ? 2. * dealii::numbers::PI * point[0] : 1.;
  }

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

  namespace
  {
    /** u_x / x, whose limit on the axis is du_x/dx. */
    template <int dim>
    double hoop_strain(const ElasticMaterial &material,
                       const dealii::Tensor<2, dim> &gradient,
                       const dealii::Tensor<1, dim> &displacement,
                       const dealii::Point<dim> &point)
    {
      if (!material.is_axisymmetric<dim>())
        return 0.;
      return point[0] > 0. ? displacement[0] / point[0] : gradient[0][0];
    }
  } // namespace

  template <int dim>
  Stress<dim> stress(const ElasticMaterial &material,
                     const dealii::Tensor<2, dim> &gradient,
                     const dealii::Tensor<1, dim> &displacement,
                     const dealii::Point<dim> &point)
  {
    const double lambda = material.lambda<dim>();
    const double mu = material.mu();
    const double hoop = hoop_strain(material, gradient, displacement, point);
    const double pressure = lambda * (trace(gradient) + hoop);
    Stress<dim> result;
    result.tensor = 2. * mu * symmetrize(gradient);
    for (unsigned int d = 0; d < dim; ++d)
      result.tensor[d][d] += pressure;
    if (dim == 2 && material.plane != PlaneModel::stress)
      result.out_of_plane = pressure + 2. * mu * hoop;
    return result;
  }

  template <int dim>
  double strain_product(const ElasticMaterial &material,
                        const dealii::Tensor<2, dim> &gradient,
                        const dealii::Tensor<1, dim> &displacement,
                        const dealii::Point<dim> &point)
  {
    const Stress<dim> s = stress(material, gradient, displacement, point);
    return s.tensor * symmetrize(gradient)
           + s.out_of_plane
                 * hoop_strain(material, gradient, displacement, point);
  }

  template <int dim>
  dealii::Tensor<1, dim>
  stress_divergence(const ElasticMaterial &material,
                    const dealii::Tensor<3, dim> &hessian,
                    const dealii::Tensor<2, dim> &gradient,
                    const dealii::Tensor<1, dim> &displacement,
                    const dealii::Point<dim> &point)
  {
    const double lambda = material.lambda<dim>();
    const double mu = material.mu();
    dealii::Tensor<1, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        result[i] += (lambda + mu) * hessian[j][j][i] + mu * hessian[i][j][j];
    if (material.is_axisymmetric<dim>())
    {
      const double r = point[0];
      const double hoop = displacement[0] / r;
      const Stress<dim> s = stress(material, gradient, displacement, point);
      // lambda grad(u_r/r), then what the turning base vectors add.
      result[0] += lambda * (gradient[0][0] - hoop) / r
                   + (s.tensor[0][0] - s.out_of_plane) / r;
      result[1] += lambda * gradient[0][1] / r + s.tensor[0][1] / r;
    }
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template double ElasticMaterial::lambda<dim>() const;                        \
  template double ElasticMaterial::measure<dim>(const dealii::Point<dim> &)    \
      const;                                                                   \
  template struct Stress<dim>;                                                 \
  template Stress<dim> stress<dim>(                                            \
      const ElasticMaterial &, const dealii::Tensor<2, dim> &,                 \
      const dealii::Tensor<1, dim> &, const dealii::Point<dim> &);             \
  template double strain_product<dim>(                                         \
      const ElasticMaterial &, const dealii::Tensor<2, dim> &,                 \
      const dealii::Tensor<1, dim> &, const dealii::Point<dim> &);             \
  template dealii::Tensor<1, dim> stress_divergence<dim>(                      \
      const ElasticMaterial &, const dealii::Tensor<3, dim> &,                 \
      const dealii::Tensor<2, dim> &, const dealii::Tensor<1, dim> &,          \
      const dealii::Point<dim> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app
