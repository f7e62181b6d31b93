// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef EXAMPLE_STRESS_H
#define EXAMPLE_STRESS_H

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

/** The total-strain plasticity of deal.II's step-42 with linear isotropic
 * hardening: the deviatoric stress s = 2 mu dev(strain) is shortened to
 *     (gamma + (1 - gamma) sigma_0 / |s|) s    where |s| > sigma_0. */
class PlasticMaterial
{
public:
  /** What is known of a quadrature point. */
  struct Point
  {
    dealii::SymmetricTensor<2, 3> stress;
    double shear = 0.;                       ///< a in the tangent below
    double drop = 0.;                        ///< b
    dealii::SymmetricTensor<2, 3> direction; ///< n = s / |s|
  };

  Point evaluate(const dealii::SymmetricTensor<2, 3> &strain) const
  {
    Point point;
    const dealii::SymmetricTensor<2, 3> s = 2. * mu * deviator(strain);
    const double norm = s.norm();
    double part = 1.;
    point.shear = mu;
    if (norm > sigma_0)
    {
      const double beta = (1. - gamma) * sigma_0 / norm;
      part = gamma + beta;
      point.shear = part * mu;
      point.drop = 2. * mu * beta;
      point.direction = s / norm;
    }
    point.stress =
        part * s + kappa * trace(strain) * dealii::unit_symmetric_tensor<3>();
    return point;
  }

  /** Derivative of the force at a node by the displacement of another, whose
   * shape functions have the gradients g and h, with the tangent
   *     kappa I I + 2 a (identity - I I / 3) - b n n. */
  dealii::Tensor<2, 3> stiffness(const Point &point,
                                 const dealii::Tensor<1, 3> &g,
                                 const dealii::Tensor<1, 3> &h) const
  {
    const double volume = kappa - 2. / 3. * point.shear;
    const double product = point.shear * (g * h);
    dealii::Tensor<2, 3> k;
    for (unsigned int c = 0; c < 3; ++c)
    {
      for (unsigned int d = 0; d < 3; ++d)
        k[c][d] = volume * g[c] * h[d] + point.shear * h[c] * g[d];
      k[c][c] += product;
    }
    if (point.drop > 0.)
      k -= point.drop * outer_product(point.direction * g, point.direction * h);
    return k;
  }

private:
  static constexpr double young = 200000., poisson = 0.3;
  static constexpr double kappa = young / (3. * (1. - 2. * poisson));
  static constexpr double mu = young / (2. * (1. + poisson));
  static constexpr double sigma_0 = 400., gamma = 0.01;
};

#endif
