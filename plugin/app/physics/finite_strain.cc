// SPDX-License-Identifier: LGPL-2.1-or-later
#include "finite_strain.h"

#include <cmath>
#include <limits>

namespace abut::app
{
  namespace
  {
    using Matrix3 = dealii::Tensor<2, 3>;

    /** A tensor of the model with what is along the third direction; @p first
     * is added to the diagonal. */
    template <int dim>
    Matrix3 with_third(const dealii::Tensor<2, dim> &gradient,
                       const double third, const double first)
    {
      Matrix3 result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] = gradient[i][j];
      if (dim == 2)
        result[2][2] = third;
      for (unsigned int i = 0; i < 3; ++i)
        result[i][i] += first;
      return result;
    }

    template <int dim> NominalStress<dim> without_third(const Matrix3 &piola)
    {
      NominalStress<dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result.tensor[i][j] = piola[i][j];
      if (dim == 2)
        result.out_of_plane = piola[2][2];
      return result;
    }

    Matrix3 no_stress()
    {
      Matrix3 result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i][j] = std::numeric_limits<double>::quiet_NaN();
      return result;
    }

    Matrix3 unit()
    {
      return Matrix3(dealii::unit_symmetric_tensor<3>());
    }

    /** E = (F^T F - I) / 2. */
    Matrix3 green(const Matrix3 &f)
    {
      return 0.5 * (transpose(f) * f - unit());
    }

    /** lambda tr(E) I + 2 mu E. */
    Matrix3 hooke(const double lambda, const double mu, const Matrix3 &e)
    {
      return lambda * trace(e) * unit() + 2. * mu * e;
    }
  } // namespace

  template <int dim>
  FiniteStrain<dim>::FiniteStrain(const double young_modulus,
                                  const double poisson_ratio,
                                  const PlaneModel plane)
      : Material<dim>(plane),
        young_modulus_(young_modulus),
        poisson_ratio_(poisson_ratio),
        mu_(young_modulus / (2. * (1. + poisson_ratio))),
        lambda_(young_modulus * poisson_ratio
                / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio)))
  {
  }

  template <int dim>
  typename FiniteStrain<dim>::Matrix
  FiniteStrain<dim>::deformation(const dealii::Tensor<2, dim> &gradient,
                                 const dealii::Tensor<1, dim> &displacement,
                                 const dealii::Point<dim> &point) const
  {
    return with_third(gradient,
                      this->hoop_strain(gradient, displacement, point), 1.);
  }

  template <int dim>
  NominalStress<dim>
  FiniteStrain<dim>::nominal_stress(const dealii::Tensor<2, dim> &gradient,
                                    const dealii::Tensor<1, dim> &displacement,
                                    const dealii::Point<dim> &point) const
  {
    const Matrix f = deformation(gradient, displacement, point);
    return without_third<dim>(determinant(f) > 0. ? piola_of(f) : no_stress());
  }

  template <int dim>
  Stress<dim>
  FiniteStrain<dim>::stress(const dealii::Tensor<2, dim> &gradient,
                            const dealii::Tensor<1, dim> &displacement,
                            const dealii::Point<dim> &point) const
  {
    const Matrix f = deformation(gradient, displacement, point);
    const double j = determinant(f);
    const Matrix cauchy = j > 0. ? piola_of(f) * transpose(f) / j : no_stress();
    const NominalStress<dim> part = without_third<dim>(cauchy);
    return {symmetrize(part.tensor), part.out_of_plane};
  }

  template <int dim>
  double FiniteStrain<dim>::energy(const dealii::Tensor<2, dim> &gradient,
                                   const dealii::Tensor<1, dim> &displacement,
                                   const dealii::Point<dim> &point) const
  {
    const Matrix f = deformation(gradient, displacement, point);
    return determinant(f) > 0. ? energy_of(f)
                               : std::numeric_limits<double>::quiet_NaN();
  }

  template <int dim>
  NominalStress<dim> FiniteStrain<dim>::tangent(
      const dealii::Tensor<2, dim> &gradient,
      const dealii::Tensor<1, dim> &displacement,
      const dealii::Point<dim> &point,
      const dealii::Tensor<2, dim> &gradient_change,
      const dealii::Tensor<1, dim> &displacement_change) const
  {
    const Matrix f = deformation(gradient, displacement, point);
    const Matrix df = with_third(
        gradient_change,
        this->hoop_strain(gradient_change, displacement_change, point), 0.);
    return without_third<dim>(determinant(f) > 0. ? piola_change(f, df)
                                                  : no_stress());
  }

  template <int dim>
  double FiniteStrain<dim>::dilation(const dealii::Tensor<2, dim> &gradient,
                                     const dealii::Tensor<1, dim> &displacement,
                                     const dealii::Point<dim> &point) const
  {
    return std::log(determinant(deformation(gradient, displacement, point)));
  }

  template <int dim>
  double NeoHooke<dim>::change(const dealii::Tensor<2, dim> &gradient,
                               const dealii::Tensor<1, dim> &displacement,
                               const dealii::Point<dim> &point) const
  {
    const double j =
        determinant(this->deformation(gradient, displacement, point));
    return j > 0. ? j - 1. : std::numeric_limits<double>::quiet_NaN();
  }

  template <int dim>
  NominalStress<dim>
  NeoHooke<dim>::change_slope(const dealii::Tensor<2, dim> &gradient,
                              const dealii::Tensor<1, dim> &displacement,
                              const dealii::Point<dim> &point) const
  {
    const Matrix f = this->deformation(gradient, displacement, point);
    return without_third<dim>(determinant(f) * transpose(invert(f)));
  }

  template <int dim>
  double NeoHooke<dim>::bulk_tangent(const double mean_change) const
  {
    const double j = 1. + mean_change;
    return this->lambda() * (1. - std::log(j)) / (j * j);
  }

  template <int dim>
  std::shared_ptr<const Material<dim>>
  NeoHooke<dim>::held_at(const double mean_change) const
  {
    auto held = std::make_shared<NeoHooke<dim>>(*this);
    held->volume_ = VolumeChange::of_point;
    held->held_ = 1. + mean_change;
    return held;
  }

  template <int dim>
  double NeoHooke<dim>::pressure(const double volume_ratio) const
  {
    return this->lambda() * std::log(volume_ratio) / volume_ratio;
  }

  template <int dim> double NeoHooke<dim>::energy_of(const Matrix &f) const
  {
    const double j = determinant(f), mean = held_ ? *held_ : j;
    return 0.5 * this->mu() * (f.norm_square() - 3. - 2. * std::log(j))
           + 0.5 * this->lambda() * std::log(mean) * std::log(mean)
           + (held_ ? pressure(mean) * (j - mean) : 0.);
  }

  template <int dim>
  typename NeoHooke<dim>::Matrix NeoHooke<dim>::piola_of(const Matrix &f) const
  {
    const double j = determinant(f);
    const double factor =
        held_ ? pressure(*held_) * j : this->lambda() * std::log(j);
    return this->mu() * f + (factor - this->mu()) * transpose(invert(f));
  }

  template <int dim>
  typename NeoHooke<dim>::Matrix
  NeoHooke<dim>::piola_change(const Matrix &f, const Matrix &df) const
  {
    const Matrix inverse = invert(f), relative = inverse * df;
    const double j = determinant(f);
    const double held = held_ ? pressure(*held_) * j : 0.;
    const double factor =
        this->mu() - (held_ ? held : this->lambda() * std::log(j));
    return this->mu() * df
           + transpose((held_ ? held : this->lambda()) * trace(relative)
                           * inverse
                       + factor * relative * inverse);
  }

  template <int dim>
  double StVenantKirchhoff<dim>::energy_of(const Matrix &f) const
  {
    const Matrix e = green(f);
    return 0.5 * this->lambda() * trace(e) * trace(e)
           + this->mu() * e.norm_square();
  }

  template <int dim>
  typename StVenantKirchhoff<dim>::Matrix
  StVenantKirchhoff<dim>::piola_of(const Matrix &f) const
  {
    return f * hooke(this->lambda(), this->mu(), green(f));
  }

  template <int dim>
  typename StVenantKirchhoff<dim>::Matrix
  StVenantKirchhoff<dim>::piola_change(const Matrix &f, const Matrix &df) const
  {
    const Matrix half = 0.5 * transpose(f) * df;
    return df * hooke(this->lambda(), this->mu(), green(f))
           + f * hooke(this->lambda(), this->mu(), half + transpose(half));
  }

  template class FiniteStrain<2>;
  template class FiniteStrain<3>;
  template class NeoHooke<2>;
  template class NeoHooke<3>;
  template class StVenantKirchhoff<2>;
  template class StVenantKirchhoff<3>;
} // namespace abut::app
