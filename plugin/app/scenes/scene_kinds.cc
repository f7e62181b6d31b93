// SPDX-License-Identifier: LGPL-2.1-or-later
/* The list of scenes: one line each, in the order of the reference. */
#include "app/scenes/obstacle/obstacle_scene.h"
#include "app/scenes/point_mass/point_mass.h"
#include "app/scenes/search/search_scene.h"
#include "app/scenes/solid/solid_scene.h"
#include "scene.h"

namespace abut::app
{
  const std::vector<SceneKind> &scene_kinds()
  {
    static const std::vector<SceneKind> kinds = {
        {"obstacle",
         "a membrane over obstacles, in the volume or on its boundary",
         {2, 3},
         create_obstacle_scene},
        {"point mass",
         "point masses on springs with constraints: small dense problems",
         {0},
         make_point_mass},
        {"chain of masses",
         "masses in a row on a rigid plane with friction, in load steps",
         {2, 3},
         make_chain},
        {"motion",
         "point masses and bars in time, above a rigid plane they may meet",
         {1, 2, 3},
         make_motion},
        {"search",
         "contact search between two surfaces (or one and itself), by itself",
         {3, 2},
         create_search_scene},
        {"solid", "elastic bodies", {2, 3}, create_solid_scene}};
    return kinds;
  }
} // namespace abut::app
