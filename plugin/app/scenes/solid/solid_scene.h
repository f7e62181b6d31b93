// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_SCENE_H
#define ABUT_APP_SOLID_SCENE_H

#include "app/scenes/scene.h"

namespace abut::app
{
  /** The scene `solid`: elastic bodies. */
  std::unique_ptr<Scene> create_solid_scene(unsigned int dimension);
} // namespace abut::app

#endif
