// SPDX-License-Identifier: LGPL-2.1-or-later
/* The list of scenes: one line each, in the order of the reference. */
#include "obstacle_scene.h"
#include "point_mass.h"
#include "scene.h"
#include "search_scene.h"
#include "solid_scene.h"

namespace abut::app
{
  std::filesystem::path RunOptions::input_file(const std::string &name) const
  {
    const std::filesystem::path beside = scene_file.parent_path() / name;
    return std::filesystem::exists(beside) ? beside
                                           : std::filesystem::path(name);
  }

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
        {"search",
         "contact search between two surfaces (or one and itself), by itself",
         {3, 2},
         create_search_scene},
        {"solid", "elastic bodies", {2, 3}, create_solid_scene}};
    return kinds;
  }
} // namespace abut::app
