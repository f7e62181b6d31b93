// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_HOOKE_H
#define ABUT_APP_HOOKE_H

#include "cell_volume.h"

#include <optional>

namespace abut::app
{
  /** Hooke's law of small strain, for isotropic bodies. By the volume of cells
   * tr(eps) is their mean where lambda multiplies it. */
  template <int dim> class Hooke : public Material<dim>, public CellVolume<dim>
  {
  public:
    /** @param young_modulus E > 0, stress
     * @param poisson_ratio -1 < nu < 1/2
     * @param volume of_cell: not in plane stress */
    Hooke(double young_modulus, double poisson_ratio,
          PlaneModel plane = PlaneModel::strain,
          VolumeChange volume = VolumeChange::of_point);

    bool is_linear() const override
    {
      return !held_;
    }

    const CellVolume<dim> *cell_volume() const override
    {
      return volume_ == VolumeChange::of_cell ? this : nullptr;
    }

    /** tr(eps). */
    double change(const dealii::Tensor<2, dim> &gradient,
                  const dealii::Tensor<1, dim> &displacement,
                  const dealii::Point<dim> &point) const override
    {
      return this->dilation(gradient, displacement, point);
    }

    NominalStress<dim>
    change_slope(const dealii::Tensor<2, dim> &gradient,
                 const dealii::Tensor<1, dim> &displacement,
                 const dealii::Point<dim> &point) const override;

    double bulk_tangent(double) const override
    {
      return lambda();
    }

    std::shared_ptr<const Material<dim>>
    held_at(double mean_change) const override;

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
     * the integral. By the volume of cells lambda times the squared integral of
     * the divergence, divided by the volume, takes the place of the first term.
     */
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
    /** With a given tr(eps) in the first term. */
    Stress<dim> stress_of(const dealii::Tensor<2, dim> &gradient, double hoop,
                          double volume_change) const;

    /** cell_tangent() with this lambda at each point. */
    void pointwise_tangent(const dealii::FEValues<dim> &values,
                           const dealii::FiniteElement<dim> &fe, double lambda,
                           dealii::FullMatrix<double> &result) const;

    double young_modulus_, poisson_ratio_;
    VolumeChange volume_;
    std::optional<double> held_; ///< tr(eps) of the cell
  };
} // namespace abut::app

#endif
