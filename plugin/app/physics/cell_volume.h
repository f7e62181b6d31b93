// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CELL_VOLUME_H
#define ABUT_APP_CELL_VOLUME_H

/** @file
 * Bodies that hardly change their volume: mean dilatation.
 */

#include "material.h"

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::app
{
  /** Mean dilatation: the energy of a cell of volume V is
   *
   *     int S(F) + V U(e),  e = int v(F) / V
   *
   * with a change of volume v, J - 1 or its linear part, and U as it is of the
   * point where v is not averaged. It is that of Simo, Taylor and Pister
   * (Comput. Methods Appl. Mech. Engrg. 51, 1985) with a pressure and a
   * dilatation in each cell, both eliminated: U'(e) is the pressure. So there
   * is an energy, and the tangent is symmetric; of small strain it is the
   * method B-bar. Cells of degree 1 do not lock with it. What a material has to
   * say: */
  template <int dim> class CellVolume
  {
  public:
    virtual ~CellVolume() = default;

    /** v, and its derivative by the gradient. */
    virtual double change(const dealii::Tensor<2, dim> &gradient,
                          const dealii::Tensor<1, dim> &displacement,
                          const dealii::Point<dim> &point) const = 0;
    virtual NominalStress<dim>
    change_slope(const dealii::Tensor<2, dim> &gradient,
                 const dealii::Tensor<1, dim> &displacement,
                 const dealii::Point<dim> &point) const = 0;

    /** U''(e). */
    virtual double bulk_tangent(double mean_change) const = 0;

    /** The material with energy S(F) + U(e) + U'(e) (v(F) - e), e being held:
     * its stress is that of the points of a cell. */
    virtual std::shared_ptr<const Material<dim>>
    held_at(double mean_change) const = 0;

    /** e of a state at the points of @p values; nan if a point has none. */
    double mean_change(const Material<dim> &material,
                       const dealii::FEValuesBase<dim> &values,
                       const CellState<dim> &state) const;
  };

  /** The materials as the points of the cells of a mesh have them, at a
   * displacement: those for which nothing but the point matters as they are,
   * others by the mean change of volume of the cell. */
  template <int dim> class CellMaterials
  {
  public:
    /** @p displacement with ghosts; @p materials must outlive this object.
     * Costs a pass over the cells if a material asks for their volumes. Not
     * collective. */
    CellMaterials(const dealii::Mapping<dim> &mapping,
                  const dealii::DoFHandler<dim> &dof_handler,
                  const la::Vector &displacement,
                  const Materials<dim> &materials);

    /** Of an owned or ghost cell of the mesh. */
    template <typename Cell> const Material<dim> &at(const Cell &cell) const
    {
      if (!of_cell_.empty())
        if (const auto &own = of_cell_[cell->active_cell_index()])
          return *own;
      return *materials_.at(cell->material_id());
    }

  private:
    const Materials<dim> &materials_;
    /** By active cell; empty if there is none, null where it does not matter.
     */
    std::vector<std::shared_ptr<const Material<dim>>> of_cell_;
  };
} // namespace abut::app

#endif
