// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_AUTOMATIC_LAW_H
#define ABUT_APP_AUTOMATIC_LAW_H

/** @file
 * Which law `Method/Enforcement = auto` takes. The rules follow the charts of
 * doc/charts.md; doc/methods.md has them in words. Where the file names a law,
 * nothing is changed.
 */

#include <abut/dealii/method_parameters.h>

namespace abut::app
{
  /** For elastic bodies. @param tied whether some surfaces are glued, which
   * not all laws can do
   * @param large_strain which not all can, either */
  void choose_law_of_bodies(MethodParameters &method, bool tied,
                            bool large_strain);

  /** For contact all over a mesh or on a part of its boundary.
   * @param cold whether the solve starts from displacement 0
   * @param nodes_across in one direction of a domain that may touch
   * everywhere; 0 if only the boundary may */
  void choose_law_of_membrane(MethodParameters &method, bool cold,
                              double nodes_across);
} // namespace abut::app

#endif
