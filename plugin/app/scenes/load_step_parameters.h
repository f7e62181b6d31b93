// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LOAD_STEP_PARAMETERS_H
#define ABUT_APP_LOAD_STEP_PARAMETERS_H

#include <abut/dealii/load_steps.h>

#include <deal.II/base/parameter_handler.h>

namespace abut::app
{
  /** Section `Load steps`: the way from time 0 to the end. */
  struct LoadStepParameters : LoadStepOptions
  {
    static void declare(dealii::ParameterHandler &prm);
    void parse(dealii::ParameterHandler &prm);
  };
} // namespace abut::app

#endif
