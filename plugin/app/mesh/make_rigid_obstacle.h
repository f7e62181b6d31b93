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
   * finite. Not collective: each rank makes its own. */
  template <int dim>
  std::shared_ptr<RigidObstacle<dim>>
  make_rigid_obstacle(const RigidObstacleParameters &parameters,
                      const RunOptions &options);
} // namespace abut::app

#endif
