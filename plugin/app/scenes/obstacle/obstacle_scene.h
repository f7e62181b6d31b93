// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_OBSTACLE_SCENE_H
#define ABUT_APP_OBSTACLE_SCENE_H

#include "app/scenes/scene.h"

namespace abut::app
{
  /** The scene `obstacle`: a membrane -div(k grad u) = f over obstacles. */
  std::unique_ptr<Scene> create_obstacle_scene(unsigned int dimension);
} // namespace abut::app

#endif
