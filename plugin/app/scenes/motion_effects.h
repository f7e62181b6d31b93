// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MOTION_EFFECTS_H
#define ABUT_APP_MOTION_EFFECTS_H

#include "method_effects.h"

namespace abut::app
{
  /** Whether Time stepping/Scheme has inertia. */
  bool has_motion(const SceneValues &values);

  /** Whether a scene has several load steps, or time steps. */
  bool has_steps(const SceneValues &values);

  /** The reason why data of dynamics have no effect; @p first is the scheme to
   * begin with. */
  std::string is_at_rest(const std::string &first);

  /** Parameters of time schemes. */
  EffectRules scheme_effects(Weight weight);

  /** Section `Time stepping` of scenes with meshes, and what a motion changes
   * in others.
   * @param data_of_motion parameters without effect at rest
   * @param first the scheme to begin with */
  EffectRules motion_effects(const std::vector<std::string> &data_of_motion,
                             const std::string &first);
} // namespace abut::app

#endif
