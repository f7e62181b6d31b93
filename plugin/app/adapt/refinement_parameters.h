// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_REFINEMENT_PARAMETERS_H
#define ABUT_APP_REFINEMENT_PARAMETERS_H

#include "error_target.h"

#include <abut/dealii/method_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace abut::app
{
  /** Section `Refinement` of the scenes that solve on a hierarchy of meshes. */
  struct RefinementParameters
  {
    unsigned int level = 0;
    unsigned int coarsest_level = 0;
    bool nested = true;
    double coarse_tolerance = 1e-3;
    unsigned int relaxation_sweeps = 3;
    bool renumber = false;
    unsigned int adaptive_cycles = 0;
    double refine_fraction = 0.6;
    double coarsen_fraction = 0.02;
    double target_error = 0.; ///< 0: none
    TargetQuantity target_quantity = TargetQuantity::energy_norm;

    /** Declare the section with these defaults of `Level` and `Coarsest
     * level`. */
    static void declare(dealii::ParameterHandler &prm,
                        const std::string &default_level,
                        const std::string &default_coarsest_level);

    /** Read the section; throws InputError for values that contradict each
     * other. */
    void parse(dealii::ParameterHandler &prm);

    /** Level of the first mesh that is solved on. */
    unsigned int first_level() const
    {
      return nested ? coarsest_level : level;
    }

    /** Number of the last mesh: levels, then adaptive cycles. */
    unsigned int last_mesh() const
    {
      return level + adaptive_cycles;
    }

    /** Whether the error on a mesh of this number decides where to refine. */
    bool is_adaptive(const unsigned int mesh) const
    {
      return mesh >= level && adaptive_cycles > 0;
    }

    /** Whether the error decides when to stop. */
    bool has_target() const
    {
      return target_error > 0.;
    }

    /** The method with the tolerances that the target needs, at first. */
    MethodParameters for_target(const MethodParameters &method) const;

    /** The method with the tolerances that are enough on a mesh whose results
     * are only a start for the next one. */
    MethodParameters loosened(const MethodParameters &method) const;
  };
} // namespace abut::app

#endif
