// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cell_volume.h"
#include "finite_strain.h"

#include <optional>

namespace abut::app
{
  namespace
  {
    /** psi = mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2: compressible
     * neo-Hooke. By the volume of cells J is their mean in the last term. */
    template <int dim>
    class NeoHooke : public FiniteStrain<dim>, public CellVolume<dim>
    {
      using typename FiniteStrain<dim>::Gradient;
      using typename FiniteStrain<dim>::Displacement;
      using typename FiniteStrain<dim>::Point;
      using typename FiniteStrain<dim>::Matrix;
      using typename FiniteStrain<dim>::Linearised;
      using FiniteStrain<dim>::lambda;
      using FiniteStrain<dim>::mu;

    public:
      explicit NeoHooke(const MaterialData &data)
          : FiniteStrain<dim>(data), volume(data.volume)
      {
      }

      const CellVolume<dim> *cell_volume() const override
      {
        return volume == VolumeChange::of_cell ? this : nullptr;
      }

      /** J - 1. */
      double change(const Gradient &gradient, const Displacement &displacement,
                    const Point &point) const override
      {
        const double j =
            determinant(this->deformation(gradient, displacement, point));
        return j > 0. ? j - 1. : this->nan;
      }

      NominalStress<dim> change_slope(const Gradient &gradient,
                                      const Displacement &displacement,
                                      const Point &point) const override
      {
        const Matrix f = this->deformation(gradient, displacement, point);
        return this->nominal(determinant(f) * transpose(invert(f)));
      }

      double bulk_tangent(const double mean_change) const override
      {
        const double j = 1. + mean_change;
        return lambda * (1. - std::log(j)) / (j * j);
      }

      std::shared_ptr<const Material<dim>>
      held_at(const double mean_change) const override
      {
        auto result = std::make_shared<NeoHooke<dim>>(*this);
        result->volume = VolumeChange::of_point;
        result->held = 1. + mean_change;
        return result;
      }

    private:
      double energy_of(const Matrix &f) const override
      {
        const double j = determinant(f), mean = held ? *held : j;
        return 0.5 * mu * (f.norm_square() - 3. - 2. * std::log(j))
               + 0.5 * lambda * std::log(mean) * std::log(mean)
               + (held ? pressure(mean) * (j - mean) : 0.);
      }

      Matrix piola_of(const Matrix &f) const override
      {
        const double j = determinant(f);
        const double factor = held ? pressure(*held) * j : lambda * std::log(j);
        return mu * f + (factor - mu) * transpose(invert(f));
      }

      Linearised linearised_at(const Matrix &f) const override
      {
        const double j = determinant(f);
        const double constant = held ? pressure(*held) * j : 0.;
        return {f, invert(f), held ? constant : lambda,
                mu - (held ? constant : lambda * std::log(j))};
      }

      Matrix piola_change(const Linearised &at, const Matrix &df) const override
      {
        const Matrix &inverse = at.derived;
        const Matrix relative = inverse * df;
        return mu * df
               + transpose(at.volume * trace(relative) * inverse
                           + at.shape * relative * inverse);
      }

      /** lambda ln(J) / J, which J is multiplied by in the stress. */
      double pressure(const double volume_ratio) const
      {
        return lambda * std::log(volume_ratio) / volume_ratio;
      }

      VolumeChange volume;
      std::optional<double> held; ///< J of the cell
    };
  } // namespace

  extern const MaterialKind neo_hooke_kind = {
      "neo-hooke",
      "finite strain, rubber; loads per area and volume of the reference "
      "configuration.",
      true,
      false,
      nullptr,
      nullptr,
      nullptr,
      elastic_constants,
      make_material<NeoHooke, 2>,
      make_material<NeoHooke, 3>};
} // namespace abut::app
