// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CELL_GEOMETRY_H
#define ABUT_APP_CELL_GEOMETRY_H

/** @file
 * Volume and orientation of cells of mesh files.
 */

#include "file_mesh.h"

namespace abut::app
{
  using Place = std::array<double, 3>;

  enum class Orientation
  {
    positive,
    reversed, /**< the order of the corners is that of the mirrored cell */
    none      /**< no volume, folded or concave */
  };

  /** Orientation by the edges at each corner. In two dimensions z is not looked
   * at. Corners at the same place make it none. */
  Orientation orientation_of(CellShape shape,
                             const std::vector<Place> &corners);

  /** Mirror the order of the corners. */
  void reverse_corners(CellShape shape, std::vector<unsigned int> &corners);

  /** Least determinant of the derivative of a quadratic simplex at its nodes,
   * divided by that of the straight one. @p middles are those of the edges in
   * the order of ShapeInfo. */
  double least_quadratic_jacobian(CellShape shape,
                                  const std::vector<Place> &corners,
                                  const std::vector<Place> &middles);

  double distance(const Place &a, const Place &b);

  Place middle_of(const Place &a, const Place &b);
} // namespace abut::app

#endif
