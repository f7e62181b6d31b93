// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_POINTS_H
#define ABUT_APP_SOLID_POINTS_H

#include "app/mesh/bodies.h"
#include "app/physics/elasticity.h"

#include <string>
#include <vector>

namespace abut::app
{
  /** A place of `Output/Points`. */
  template <int dim> struct OutputPoint
  {
    unsigned int body;        ///< from 0
    dealii::Point<dim> place; ///< without load
  };

  /** The points that @p text names, `1: 0, 0; 2: 1, 0.5`. Throws InputError
   * for bodies that do not exist and for wrong numbers of coordinates. */
  template <int dim>
  std::vector<OutputPoint<dim>> read_points(const std::string &text,
                                            const Bodies<dim> &bodies);

  /** Throw InputError for points outside of their body. Collective. */
  template <int dim>
  void check_points(const std::vector<OutputPoint<dim>> &points,
                    const Elasticity<dim> &elasticity);
} // namespace abut::app

#endif
