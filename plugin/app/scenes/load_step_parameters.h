// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LOAD_STEP_PARAMETERS_H
#define ABUT_APP_LOAD_STEP_PARAMETERS_H

#include <abut/dealii/load_steps.h>

#include <deal.II/base/parameter_handler.h>

namespace abut::app
{
  /** Declare `End time` in the open section. */
  void declare_end_time(dealii::ParameterHandler &prm);

  /** Section `Time stepping`: the way from time 0 to the end. */
  struct LoadStepParameters : LoadStepOptions
  {
    /** Linearisations of a step of large strain after which it has failed. */
    unsigned int newton_steps = 20;
    /** Their error relative to the displacement, in the energy norm. */
    double newton_tolerance = 1e-8;

    static void declare(dealii::ParameterHandler &prm);
    void parse(dealii::ParameterHandler &prm);
  };
} // namespace abut::app

#endif
