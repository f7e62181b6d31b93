// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_STIFFENING_H
#define ABUT_TESTS_STIFFENING_H

#include "app/physics/hooke.h"

#include <cmath>

namespace abut::app
{
  /** Hooke's law and a pressure of c times the cube of the dilation: as little
   * as a nonlinear material can bring, energy, stress and tangent at a point.
   */
  template <int dim> class Stiffening : public Hooke<dim>
  {
  public:
    using Gradient = dealii::Tensor<2, dim>;
    using Displacement = dealii::Tensor<1, dim>;

    Stiffening(const double young_modulus, const double poisson_ratio,
               const double c, const PlaneModel plane = PlaneModel::strain)
        : Hooke<dim>(young_modulus, poisson_ratio, plane), c(c)
    {
    }

    bool is_linear() const override
    {
      return false;
    }

    Stress<dim> stress(const Gradient &gradient,
                       const Displacement &displacement,
                       const dealii::Point<dim> &point) const override
    {
      const double volume = this->dilation(gradient, displacement, point);
      return sum(Hooke<dim>::stress(gradient, displacement, point),
                 c * volume * volume * volume);
    }

    NominalStress<dim>
    nominal_stress(const Gradient &gradient, const Displacement &displacement,
                   const dealii::Point<dim> &point) const override
    {
      return nominal(stress(gradient, displacement, point));
    }

    double energy(const Gradient &gradient, const Displacement &displacement,
                  const dealii::Point<dim> &point) const override
    {
      return Hooke<dim>::energy(gradient, displacement, point)
             + 0.25 * c
                   * std::pow(this->dilation(gradient, displacement, point), 4);
    }

    NominalStress<dim>
    tangent(const Gradient &gradient, const Displacement &displacement,
            const dealii::Point<dim> &point, const Gradient &gradient_change,
            const Displacement &displacement_change) const override
    {
      const double volume = this->dilation(gradient, displacement, point);
      return nominal(sum(
          Hooke<dim>::stress(gradient_change, displacement_change, point),
          3. * c * volume * volume
              * this->dilation(gradient_change, displacement_change, point)));
    }

    dealii::Tensor<1, dim>
    stress_divergence(const dealii::Tensor<3, dim> &hessian,
                      const Gradient &gradient,
                      const Displacement &displacement,
                      const dealii::Point<dim> &point) const override
    {
      return Material<dim>::stress_divergence(hessian, gradient, displacement,
                                              point);
    }

    void cell_tangent(const dealii::FEValues<dim> &values,
                      const dealii::FiniteElement<dim> &fe,
                      const CellState<dim> &state,
                      dealii::FullMatrix<double> &result) const override
    {
      Material<dim>::cell_tangent(values, fe, state, result);
    }

  private:
    Stress<dim> sum(Stress<dim> stress, const double pressure) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        stress.tensor[d][d] += pressure;
      if (dim == 2 && this->plane != PlaneModel::stress)
        stress.out_of_plane += pressure;
      return stress;
    }

    /** Strains are small. */
    static NominalStress<dim> nominal(const Stress<dim> &stress)
    {
      return {stress.tensor, stress.out_of_plane};
    }

    const double c;
  };
} // namespace abut::app

#endif
