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

#include "cell_volume.h"

#include <memory>
#include <optional>

namespace abut::app
{
  /** What all of them share: the third direction, and what E and nu mean. */
  template <int dim> class FiniteStrain : public Material<dim>
  {
  public:
    /** @param young_modulus E > 0, stress
     * @param poisson_ratio -1 < nu < 1/2
     * @param plane not PlaneModel::stress */
    FiniteStrain(double young_modulus, double poisson_ratio, PlaneModel plane);

    bool is_linear() const override
    {
      return false;
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

    double stiffness() const override
    {
      return young_modulus_;
    }

    double dilation_stiffness() const override
    {
      return lambda_;
    }

    double poisson_ratio() const override
    {
      return poisson_ratio_;
    }

    /** ln J. */
    double dilation(const dealii::Tensor<2, dim> &gradient,
                    const dealii::Tensor<1, dim> &displacement,
                    const dealii::Point<dim> &point) const override;

  protected:
    using Matrix = dealii::Tensor<2, 3>;

    /** F. */
    Matrix deformation(const dealii::Tensor<2, dim> &gradient,
                       const dealii::Tensor<1, dim> &displacement,
                       const dealii::Point<dim> &point) const;

    /** psi, P and the change of P with F, for J > 0. */
    virtual double energy_of(const Matrix &f) const = 0;
    virtual Matrix piola_of(const Matrix &f) const = 0;
    virtual Matrix piola_change(const Matrix &f, const Matrix &df) const = 0;

    double mu() const
    {
      return mu_;
    }
    double lambda() const
    {
      return lambda_;
    }

  private:
    double young_modulus_, poisson_ratio_, mu_, lambda_;
  };

  /** psi = mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2: compressible
   * neo-Hooke. By the volume of cells J is their mean in the last term. */
  template <int dim>
  class NeoHooke : public FiniteStrain<dim>, public CellVolume<dim>
  {
  public:
    /** @param volume which J is in the last term */
    NeoHooke(double young_modulus, double poisson_ratio, PlaneModel plane,
             VolumeChange volume = VolumeChange::of_point)
        : FiniteStrain<dim>(young_modulus, poisson_ratio, plane),
          volume_(volume)
    {
    }

    const CellVolume<dim> *cell_volume() const override
    {
      return volume_ == VolumeChange::of_cell ? this : nullptr;
    }

    /** J - 1. */
    double change(const dealii::Tensor<2, dim> &gradient,
                  const dealii::Tensor<1, dim> &displacement,
                  const dealii::Point<dim> &point) const override;
    NominalStress<dim>
    change_slope(const dealii::Tensor<2, dim> &gradient,
                 const dealii::Tensor<1, dim> &displacement,
                 const dealii::Point<dim> &point) const override;
    double bulk_tangent(double mean_change) const override;
    std::shared_ptr<const Material<dim>>
    held_at(double mean_change) const override;

  private:
    using typename FiniteStrain<dim>::Matrix;

    /** lambda ln(J) / J, which J is multiplied by in the stress. */
    double pressure(double volume_ratio) const;

    VolumeChange volume_;
    std::optional<double> held_; ///< J of the cell
    double energy_of(const Matrix &f) const override;
    Matrix piola_of(const Matrix &f) const override;
    Matrix piola_change(const Matrix &f, const Matrix &df) const override;
  };

  /** psi = lambda/2 (tr E)^2 + mu E:E: Hooke's law in large rotations, after
   * St. Venant and Kirchhoff. It softens under compression, and a bar can be
   * squeezed to nothing by finite forces, so that there is an end to its use.
   */
  template <int dim> class StVenantKirchhoff : public FiniteStrain<dim>
  {
  public:
    using FiniteStrain<dim>::FiniteStrain;

    /** A compression by a fifth, where a bar has lost half of its stiffness. */
    double least_stretch() const override
    {
      return 0.8;
    }

  private:
    using typename FiniteStrain<dim>::Matrix;
    double energy_of(const Matrix &f) const override;
    Matrix piola_of(const Matrix &f) const override;
    Matrix piola_change(const Matrix &f, const Matrix &df) const override;
  };
} // namespace abut::app

#endif
