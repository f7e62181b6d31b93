// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MOTION_EFFECTS_H
#define ABUT_APP_MOTION_EFFECTS_H

#include "method_effects.h"

namespace abut::app
{
  /** Whether Time stepping/Scheme has what has mass move. */
  bool has_motion(const SceneValues &values);

  /** Section `Time stepping` of scenes with meshes, and what a motion changes
   * in others.
   * @param data_of_motion parameters without effect at rest
   * @param first the scheme to begin with */
  EffectRules motion_effects(const std::vector<std::string> &data_of_motion,
                             const std::string &first);
} // namespace abut::app

#endif
