// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_FINITE_STRAIN_H
#define ABUT_APP_FINITE_STRAIN_H

/** @file
 * Isotropic hyperelastic materials for strains and rotations of any size, in
 * the undeformed body (total Lagrangian).
 *
 * F = I + grad u with three rows and columns: plane strain has F_zz = 1, bodies
 * of revolution F_zz = 1 + u_x / x. C = F^T F, E = (C - I) / 2, J = det F.
 * Stress follows from the energy psi per undeformed volume: P = d psi / d F by
 * undeformed area, sigma = P F^T / J by deformed area. Both have Hooke's law
 * with the same E and nu for small strain. Where J <= 0 all is nan.
 */

#include "material_kind.h"

#include <cmath>
#include <limits>
#include <optional>

namespace abut::app
{
  /** What all of them share: the third direction, and what E and nu mean. */
  template <int dim> class FiniteStrain : public Material<dim>
  {
  protected:
    using Gradient = dealii::Tensor<2, dim>;
    using Displacement = dealii::Tensor<1, dim>;
    using Point = dealii::Point<dim>;
    using Matrix = dealii::Tensor<2, 3>;

  public:
    /** Of elastic_constants, not in plane stress. */
    explicit FiniteStrain(const MaterialData &data)
        : Material<dim>(data.plane),
          young_modulus(data.numbers[0]),
          nu(data.numbers[1]),
          mu(young_modulus / (2. * (1. + nu))),
          lambda(young_modulus * nu / ((1. + nu) * (1. - 2. * nu)))
    {
    }

    bool is_linear() const override
    {
      return false;
    }

    Stress<dim> stress(const Gradient &gradient,
                       const Displacement &displacement,
                       const Point &point) const override
    {
      const Matrix f = deformation(gradient, displacement, point);
      const double j = determinant(f);
      const Matrix cauchy =
          j > 0. ? piola_of(f) * transpose(f) / j : nan * Matrix();
      const NominalStress<dim> part = nominal(cauchy);
      return {symmetrize(part.tensor), part.out_of_plane};
    }

    NominalStress<dim> nominal_stress(const Gradient &gradient,
                                      const Displacement &displacement,
                                      const Point &point) const override
    {
      const Matrix f = deformation(gradient, displacement, point);
      return nominal(determinant(f) > 0. ? piola_of(f) : nan * Matrix());
    }

    double energy(const Gradient &gradient, const Displacement &displacement,
                  const Point &point) const override
    {
      const Matrix f = deformation(gradient, displacement, point);
      return determinant(f) > 0. ? energy_of(f) : nan;
    }

    NominalStress<dim>
    tangent(const Gradient &gradient, const Displacement &displacement,
            const Point &point, const Gradient &gradient_change,
            const Displacement &displacement_change) const override
    {
      return change(linearised(deformation(gradient, displacement, point)),
                    gradient_change, displacement_change, point);
    }

    double stiffness() const override
    {
      return young_modulus;
    }

    double dilation_stiffness() const override
    {
      return lambda;
    }

    double poisson_ratio() const override
    {
      return nu;
    }

    /** ln J. */
    double dilation(const Gradient &gradient, const Displacement &displacement,
                    const Point &point) const override
    {
      return std::log(determinant(deformation(gradient, displacement, point)));
    }

  protected:
    /** F, and what else a material has the change of P from; no F: J <= 0. */
    struct Linearised
    {
      std::optional<Matrix> f;
      Matrix derived;
      double volume = 0., shape = 0.; ///< factors
    };

    /** psi, P and the change of P with F, for J > 0. */
    virtual double energy_of(const Matrix &f) const = 0;
    virtual Matrix piola_of(const Matrix &f) const = 0;
    virtual Linearised linearised_at(const Matrix &f) const = 0;
    virtual Matrix piola_change(const Linearised &at,
                                const Matrix &df) const = 0;

    typename Material<dim>::Moduli moduli(const Gradient &gradient,
                                          const Displacement &displacement,
                                          const Point &point) const override
    {
      const Linearised at =
          linearised(deformation(gradient, displacement, point));
      return this->moduli_by(
          [&](const Gradient &gradient_change,
              const Displacement &displacement_change)
          { return change(at, gradient_change, displacement_change, point); });
    }

    /** F. */
    Matrix deformation(const Gradient &gradient,
                       const Displacement &displacement,
                       const Point &point) const
    {
      return with_third(gradient,
                        this->hoop_strain(gradient, displacement, point), 1.);
    }

    /** The part of a tensor that the model has. */
    static NominalStress<dim> nominal(const Matrix &piola)
    {
      NominalStress<dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result.tensor[i][j] = piola[i][j];
      if (dim == 2)
        result.out_of_plane = piola[2][2];
      return result;
    }

    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double young_modulus, nu, mu, lambda;

  private:
    Linearised linearised(const Matrix &f) const
    {
      return determinant(f) > 0. ? linearised_at(f) : Linearised();
    }

    NominalStress<dim> change(const Linearised &at,
                              const Gradient &gradient_change,
                              const Displacement &displacement_change,
                              const Point &point) const
    {
      const Matrix df = with_third(
          gradient_change,
          this->hoop_strain(gradient_change, displacement_change, point), 0.);
      return nominal(at.f ? piola_change(at, df) : nan * Matrix());
    }

    /** A tensor of the model with what is along the third direction; @p first
     * is added to the diagonal. */
    static Matrix with_third(const Gradient &gradient, const double third,
                             const double first)
    {
      Matrix result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] = gradient[i][j];
      if (dim == 2)
        result[2][2] = third;
      for (unsigned int i = 0; i < 3; ++i)
        result[i][i] += first;
      return result;
    }
  };
} // namespace abut::app

#endif
