// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MODELLED_H
#define ABUT_APP_MODELLED_H

/** @file
 * Lines of "What was modelled" that all scenes with meshes have.
 */

#include "app/adapt/refinement_parameters.h"
#include "app/report/report.h"

#include <abut/dealii/solver_parameters.h>

namespace abut::app
{
  /** Where a solve starts from, and where meshes are refined. */
  void model_meshes(Report &report, const RefinementParameters &refinement);

  /** How many linear systems, and what solved the last of them, which stands in
   * the summary, too: what was asked for is not always possible. */
  void model_linear_systems(Report &report, const std::string &how_many,
                            const LinearReport &last);

  /** Fields and pictures. */
  void model_files(Report &report, bool are_written);
} // namespace abut::app

#endif
