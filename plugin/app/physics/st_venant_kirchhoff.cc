// SPDX-License-Identifier: LGPL-2.1-or-later
#include "finite_strain.h"

namespace abut::app
{
  namespace
  {
    /** psi = lambda/2 (tr E)^2 + mu E:E: Hooke's law in large rotations, after
     * St. Venant and Kirchhoff. It softens under compression, and a bar can be
     * squeezed to nothing by finite forces, so that there is an end to its use.
     */
    template <int dim> class StVenantKirchhoff : public FiniteStrain<dim>
    {
      using typename FiniteStrain<dim>::Matrix;
      using typename FiniteStrain<dim>::Linearised;
      using FiniteStrain<dim>::lambda;
      using FiniteStrain<dim>::mu;

    public:
      using FiniteStrain<dim>::FiniteStrain;

      /** A compression by a fifth, where a bar has lost half of its stiffness.
       */
      double least_stretch() const override
      {
        return 0.8;
      }

    private:
      double energy_of(const Matrix &f) const override
      {
        const Matrix e = green(f);
        return 0.5 * lambda * trace(e) * trace(e) + mu * e.norm_square();
      }

      Matrix piola_of(const Matrix &f) const override
      {
        return f * hooke(green(f));
      }

      Linearised linearised_at(const Matrix &f) const override
      {
        return {f, hooke(green(f))};
      }

      Matrix piola_change(const Linearised &at, const Matrix &df) const override
      {
        const Matrix half = 0.5 * transpose(*at.f) * df;
        return df * at.derived + *at.f * hooke(half + transpose(half));
      }

      static Matrix unit()
      {
        return Matrix(dealii::unit_symmetric_tensor<3>());
      }

      /** E = (F^T F - I) / 2. */
      static Matrix green(const Matrix &f)
      {
        return 0.5 * (transpose(f) * f - unit());
      }

      /** lambda tr(E) I + 2 mu E. */
      Matrix hooke(const Matrix &e) const
      {
        return lambda * trace(e) * unit() + 2. * mu * e;
      }
    };
  } // namespace

  extern const MaterialKind st_venant_kirchhoff_kind = {
      "st venant-kirchhoff",
      "Hooke's law with large rotations, for compression up to 20 %; loads per "
      "area and volume of the reference configuration.",
      true,
      false,
      "the energy of st venant-kirchhoff has no volumetric part for mean "
      "dilatation",
      "it softens in compression",
      "neo-hooke",
      elastic_constants,
      make_material<StVenantKirchhoff, 2>,
      make_material<StVenantKirchhoff, 3>};
} // namespace abut::app
