// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_POINT_MASS_H
#define ABUT_APP_POINT_MASS_H

#include "app/scenes/scene.h"

namespace abut::app
{
  /** The scene `point mass`: minimise 1/2 u'Ku - f'u under g = g0 + B u >= 0
   * or = 0, all given as numbers, by the same methods that large scenes use.
   * @p dimension is not used. */
  std::unique_ptr<Scene> make_point_mass(unsigned int dimension);

  /** The scene `chain of masses`: masses in a row on a rigid plane, held and
   * drawn by springs, with friction, in load steps. */
  std::unique_ptr<Scene> make_chain(unsigned int dimension);

  /** The scene `motion`: point masses and bars in time, above a rigid plane. */
  std::unique_ptr<Scene> make_motion(unsigned int dimension);
} // namespace abut::app

#endif
