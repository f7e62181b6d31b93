// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_INERTIA_PARAMETERS_H
#define ABUT_APP_INERTIA_PARAMETERS_H

#include "app/adapt/refinement_parameters.h"
#include "time_parameters.h"

#include <string>

namespace abut::app
{
  /** Section `Time stepping` of scenes with meshes. */
  struct InertiaParameters : TimeParameters
  {
    abut_time_mass mass = ABUT_TIME_MASS_MODIFIED;
    double mass_damping = 0., stiffness_damping = 0.;

    /** @param schemes as those of TimeParameters
     * @param failing_steps a sentence about them */
    static void declare(dealii::ParameterHandler &prm,
                        const std::string &schemes,
                        const std::string &failing_steps);
    void parse(dealii::ParameterHandler &prm);

    /** Have a motion begin on the mesh that it ends on. Throws InputError where
     * meshes are to change. */
    void fit(RefinementParameters &refinement) const;

  private:
    /** Throws InputError for what the scheme cannot do. */
    void check() const;
  };
} // namespace abut::app

#endif
