// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_HOOKE_H
#define ABUT_APP_HOOKE_H

#include "material.h"

namespace abut::app
{
  /** Hooke's law of small strain, for isotropic bodies. */
  template <int dim> class Hooke : public Material<dim>
  {
  public:
    /** @param young_modulus E > 0, stress
     * @param poisson_ratio -1 < nu < 1/2 */
    Hooke(double young_modulus, double poisson_ratio,
          PlaneModel plane = PlaneModel::strain);

    bool is_linear() const override
    {
      return true;
    }

    Stress<dim> stress(const dealii::Tensor<2, dim> &gradient,
                       const dealii::Tensor<1, dim> &displacement,
                       const dealii::Point<dim> &point) const override;

    NominalStress<dim>
    nominal_stress(const dealii::Tensor<2, dim> &gradient,
                   const dealii::Tensor<1, dim> &displacement,
                   const dealii::Point<dim> &point) const override;

    double energy(const dealii::Tensor<2, dim> &gradient,
                  const dealii::Tensor<1, dim> &displacement,
                  const dealii::Point<dim> &point) const override;

    NominalStress<dim>
    tangent(const dealii::Tensor<2, dim> &gradient,
            const dealii::Tensor<1, dim> &displacement,
            const dealii::Point<dim> &point,
            const dealii::Tensor<2, dim> &gradient_change,
            const dealii::Tensor<1, dim> &displacement_change) const override;

    dealii::Tensor<1, dim>
    stress_divergence(const dealii::Tensor<3, dim> &hessian,
                      const dealii::Tensor<2, dim> &gradient,
                      const dealii::Tensor<1, dim> &displacement,
                      const dealii::Point<dim> &point) const override;

    /** The stiffness matrix
     *
     *     K_(i,a)(j,b) = int lambda d_a phi_i d_b phi_j + mu d_b phi_i d_a
     *                    phi_j + mu delta_ab grad phi_i . grad phi_j
     *
     * and for axisymmetric bodies the terms of the hoop strain, with 2 pi r in
     * the integral. */
    void cell_tangent(const dealii::FEValues<dim> &values,
                      const dealii::FiniteElement<dim> &fe,
                      const CellState<dim> &state,
                      dealii::FullMatrix<double> &result) const override;

    /** At most 3/2 times 2 mu, which bounds it below, however large lambda is.
     */
    double stiffness() const override
    {
      return young_modulus_;
    }

    double dilation_stiffness() const override
    {
      return lambda();
    }

    double poisson_ratio() const override
    {
      return poisson_ratio_;
    }

    /** Shear modulus E / (2 (1 + nu)). */
    double mu() const;

    /** lambda of sigma = lambda tr(eps) I + 2 mu eps with the strains of dim
     * directions; for plane stress 2 mu lambda / (lambda + 2 mu). */
    double lambda() const;

  private:
    double young_modulus_, poisson_ratio_;
  };
} // namespace abut::app

#endif
