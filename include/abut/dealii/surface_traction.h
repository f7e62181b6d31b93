// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_SURFACE_TRACTION_H
#define ABUT_DEALII_SURFACE_TRACTION_H

/** @file
 * Data of the host's material for Nitsche's method. */

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace abut
{
  /** Traction sigma(u)n of a linear elastic body at its surface. Derive a class
   * from this one, see ContactAssembler::set_surface_traction(). */
  template <int dim> class SurfaceTraction
  {
  public:
    virtual ~SurfaceTraction() = default;

    /** Its derivatives by the unknowns of a cell.
     * @param cell a locally owned cell
     * @param unit_point points of the unit cell, on its boundary
     * @param normal [points] outward unit normals
     * @param derivative [points * dim][dofs_per_cell] out, has its size: row
     *   q * dim + d is component d of the traction at point q, stress per
     *   length; along the normal it is positive in tension
     * Not collective. */
    virtual void
    evaluate(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
             const std::vector<dealii::Point<dim>> &unit_point,
             const std::vector<dealii::Tensor<1, dim>> &normal,
             dealii::FullMatrix<double> &derivative) const = 0;
  };
} // namespace abut

#endif
