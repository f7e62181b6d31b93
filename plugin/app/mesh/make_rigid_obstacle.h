// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MAKE_RIGID_OBSTACLE_H
#define ABUT_APP_MAKE_RIGID_OBSTACLE_H

#include "rigid_obstacle_parameters.h"

#include <abut/dealii/rigid_obstacle.h>

#include <memory>

namespace abut::app
{
  /** Create the obstacle of a section, at time 0; RigidObstacle::set_time()
   * moves it. Throws InputError that names the parameter for numbers out of
   * range, formulas that cannot be read, and files that are missing or no
   * surface of a body. Formulas throw it later, for points where they are not
   * finite. Not collective: each rank makes its own.
   * @param half_extent of what it touches, for differences of formulas, read
   * whenever they are taken: it may become known later. Null: 1 */
  template <int dim>
  std::shared_ptr<RigidObstacle<dim>>
  make_rigid_obstacle(const RigidObstacleParameters &parameters,
                      const RunOptions &options,
                      std::shared_ptr<const double> half_extent = nullptr);

  /** What `Rotation angle` is about, at time 0. */
  template <int dim>
  dealii::Point<dim>
  centre_of_rotation(const RigidObstacleParameters &parameters);
} // namespace abut::app

#endif
