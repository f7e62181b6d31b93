// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_EFFECTS_H
#define ABUT_APP_SOLID_EFFECTS_H

#include "app/scenes/method_effects.h"

namespace abut::app
{
  /** When the parameters of the scene `solid` have an effect. */
  EffectRules solid_effects();
} // namespace abut::app

#endif
