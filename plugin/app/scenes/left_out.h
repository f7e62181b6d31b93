// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LEFT_OUT_H
#define ABUT_APP_LEFT_OUT_H

/** @file
 * What a run could have done without, with the evidence that it saw:
 * `abut run --explain`. Each function adds its lines to the report.
 */

#include "app/adapt/refinement_parameters.h"
#include "app/adapt/target_control.h"
#include "app/report/report.h"

#include <abut/dealii/method_parameters.h>

namespace abut::app
{
  /** Parts of the error that are far below the target: mesh, law, linear
   * systems. Without a target all digits are taken to be wanted, which is said.
   */
  void explain_accuracy(Report &report, const RefinementParameters &refinement,
                        const TargetControl &control);

  /** Steps that another start or law would not have made.
   * @param n_steps linear systems of all meshes, @p n_meshes of them */
  void explain_steps(Report &report, const RefinementParameters &refinement,
                     const MethodParameters &method, unsigned int n_steps,
                     unsigned int n_meshes);

  /** Time that went into files and error norms. */
  void explain_output(Report &report);
} // namespace abut::app

#endif
