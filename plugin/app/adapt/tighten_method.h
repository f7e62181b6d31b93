// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_TIGHTEN_METHOD_H
#define ABUT_APP_TIGHTEN_METHOD_H

#include <abut/dealii/method_parameters.h>

namespace abut::app
{
  /** Make what the law leaves open smaller by about @p factor > 1: stiffer
   * penalties, a smaller last barrier, smaller tolerances of multipliers.
   * @param present_penalty that the last solve ended with. Returns false where
   * penalties have reached their cap. */
  bool tighten_law(MethodParameters &method, double factor,
                   double present_penalty);

  /** Make the tolerances of linear systems smaller by @p factor > 1. */
  void tighten_solver(MethodParameters &method, double factor);
} // namespace abut::app

#endif
