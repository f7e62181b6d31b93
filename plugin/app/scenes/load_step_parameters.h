// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LOAD_STEP_PARAMETERS_H
#define ABUT_APP_LOAD_STEP_PARAMETERS_H

#include <deal.II/base/parameter_handler.h>

namespace abut::app
{
  /** Section `Load steps`: the way from time 0 to the end. */
  struct LoadStepParameters
  {
    unsigned int steps = 1;
    double end_time = 1.;
    bool cut_back = true;
    double smallest_step = 1e-3;

    static void declare(dealii::ParameterHandler &prm);
    void parse(dealii::ParameterHandler &prm);
  };

  /** Chooses the length of load steps: those asked for, halved when one fails,
   * and doubled again up to these after two good ones. */
  class LoadSteps
  {
  public:
    explicit LoadSteps(const LoadStepParameters &parameters);

    /** Whether the end is reached. */
    bool is_finished() const;

    /** Time that the next step aims at. */
    double target() const;

    /** Time that has been reached. */
    double time() const
    {
      return reached;
    }

    /** The step to target() succeeded. */
    void accept();

    /** It failed: try half of it. Returns false when that would be shorter
     * than allowed. */
    bool reject();

    /** Number of steps that succeeded, and that failed. */
    unsigned int n_accepted = 0, n_rejected = 0;

  private:
    LoadStepParameters parameters;
    double reached = 0.;
    double length;
    unsigned int n_good = 0; ///< since the last failure or doubling
  };
} // namespace abut::app

#endif
