// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SEARCH_SCENE_H
#define ABUT_APP_SEARCH_SCENE_H

#include "app/scenes/scene.h"

#include <memory>

namespace abut::app
{
  /** The scene `search`: contact search between two surfaces, without
   * bodies. */
  std::unique_ptr<Scene> create_search_scene(unsigned int dimension);
} // namespace abut::app

#endif
