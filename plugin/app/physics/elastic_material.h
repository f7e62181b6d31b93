// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ELASTIC_MATERIAL_H
#define ABUT_APP_ELASTIC_MATERIAL_H

/** @file
 * Hooke's law of small strain, in the plane, around an axis and in space.
 */

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <map>

namespace abut::app
{
  /** What a two-dimensional model says of the third direction. Axisymmetric
   * models have radius x >= 0 and axis x = 0. */
  enum class PlaneModel
  {
    strain,      /**< no strain along z */
    stress,      /**< no stress along z */
    axisymmetric /**< hoop strain u_x / x */
  };

  /** An isotropic linear elastic material. */
  struct ElasticMaterial
  {
    double young_modulus = 1.; /**< E > 0, stress */
    double poisson_ratio = 0.; /**< -1 < nu < 1/2 */
    /** Without meaning in three dimensions. */
    PlaneModel plane = PlaneModel::strain;

    /** Shear modulus E / (2 (1 + nu)). */
    double mu() const;

    /** lambda of sigma = lambda tr(eps) I + 2 mu eps with the strains of dim
     * directions; for plane stress 2 mu lambda / (lambda + 2 mu). */
    template <int dim> double lambda() const;

    /** Whether volumes are those of rings. */
    template <int dim> bool is_axisymmetric() const
    {
      return dim == 2 && plane == PlaneModel::axisymmetric;
    }

    /** What a volume or an area of the mesh is multiplied by: 2 pi x for
     * axisymmetric bodies, else 1. */
    template <int dim> double measure(const dealii::Point<dim> &point) const;
  };

  /** The materials of a mesh by material id of its cells. */
  using ElasticMaterials =
      std::map<dealii::types::material_id, ElasticMaterial>;

  /** Stress at a point, positive in tension. */
  template <int dim> struct Stress
  {
    dealii::SymmetricTensor<2, dim> tensor;
    /** Normal stress along z, or around the axis; 0 in three dimensions. */
    double out_of_plane = 0.;

    /** sqrt(3/2 s:s) with the deviator s of all three directions. */
    double von_mises() const;
  };

  /** Stress of a displacement with the given value (of meaning for
   * axisymmetric bodies only, as @p point) and gradient
   * gradient[i][j] = du_i/dx_j. */
  template <int dim>
  Stress<dim> stress(const ElasticMaterial &material,
                     const dealii::Tensor<2, dim> &gradient,
                     const dealii::Tensor<1, dim> &displacement,
                     const dealii::Point<dim> &point);

  /** Strain energy density sigma:eps (without the factor 1/2) of the same. */
  template <int dim>
  double strain_product(const ElasticMaterial &material,
                        const dealii::Tensor<2, dim> &gradient,
                        const dealii::Tensor<1, dim> &displacement,
                        const dealii::Point<dim> &point);

  /** Divergence of the stress, a force per volume; hessian[i][j][k] =
   * d^2 u_i / dx_j dx_k. Not on the axis of an axisymmetric body. */
  template <int dim>
  dealii::Tensor<1, dim>
  stress_divergence(const ElasticMaterial &material,
                    const dealii::Tensor<3, dim> &hessian,
                    const dealii::Tensor<2, dim> &gradient,
                    const dealii::Tensor<1, dim> &displacement,
                    const dealii::Point<dim> &point);
} // namespace abut::app

#endif
