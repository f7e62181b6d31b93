// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHECKPOINT_PARAMETERS_H
#define ABUT_APP_CHECKPOINT_PARAMETERS_H

#include <deal.II/base/parameter_handler.h>

namespace abut::app
{
  /** Section `Checkpoint`: how often a run keeps what it has reached. */
  struct CheckpointParameters
  {
    unsigned int every_steps = 0; ///< 0: not by steps
    double every_minutes = 10.;   ///< 0: not by time

    static void declare(dealii::ParameterHandler &prm);
    void parse(dealii::ParameterHandler &prm);
  };
} // namespace abut::app

#endif
