// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MEMBRANE_EFFECTS_H
#define ABUT_APP_MEMBRANE_EFFECTS_H

#include "app/scenes/method_effects.h"

namespace abut::app
{
  /** When the parameters of the scene `obstacle` have an effect. */
  EffectRules membrane_effects();
} // namespace abut::app

#endif
