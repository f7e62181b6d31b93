// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RASTER_H
#define ABUT_APP_RASTER_H

/** @file
 * Finite element fields sampled on a regular raster, for pictures.
 */

#include <abut/dealii/linear_algebra.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace abut::app
{
  /** Values at the centres of nx times ny rectangles that cover the mesh's
   * bounding box. */
  struct Raster
  {
    std::size_t nx = 0;
    std::size_t ny = 0;
    double x_min = 0;
    double x_max = 0;
    double y_min = 0;
    double y_max = 0;
    /** Height of the plane in 3D, NaN in 2D. */
    double z = std::numeric_limits<double>::quiet_NaN();
    /** One array per field, x fastest; NaN outside the mesh. */
    std::vector<std::vector<double>> fields;

    double x(std::size_t i) const
    {
      return x_min + (x_max - x_min) * (double(i) + 0.5) / double(nx);
    }
    double y(std::size_t j) const
    {
      return y_min + (y_max - y_min) * (double(j) + 0.5) / double(ny);
    }
  };

  /** A field to be sampled. */
  struct RasterField
  {
    const la::Vector *values; /**< ghosted */
    /** Take the value of the nearest node instead of interpolating: for what
     * is a number of a kind, such as a contact status. */
    bool nearest = false;
  };

  /** Sample scalar fields: the longer side of the bounding box gets @p n
   * points. In 3D on the plane at height @p z (default: half height). Each
   * rank looks at its own cells; all ranks get the result. A point between
   * cells gets the larger value. Collective.
   * Cost: one pass over the cells plus one mapping inversion per point. */
  template <int dim>
  Raster sample_raster(const dealii::Mapping<dim> &mapping,
                       const dealii::DoFHandler<dim> &dof_handler,
                       const std::vector<RasterField> &fields, unsigned int n,
                       double z = std::numeric_limits<double>::quiet_NaN());
} // namespace abut::app

#endif
