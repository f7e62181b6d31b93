// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CONTACT_RUN_STATE_H
#define ABUT_APP_CONTACT_RUN_STATE_H

#include "app/adapt/target_control.h"
#include "contact_result.h"
#include "load_step_parameters.h"
#include "scene.h"

#include <abut/dealii/contact_assembler.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace abut::app
{
  /** What a scene says about a run. The references must outlive it. */
  struct ContactRunSettings
  {
    const RefinementParameters &refinement;
    const MethodParameters &method;
    const SolverParameters &solver;
    LoadStepOptions load_steps;
    bool all_levels;    ///< fields of all meshes, each solved to the end
    unsigned int every; ///< steps between two sets of fields
    bool extrapolate;   ///< the last load step, for the start of the next
  };

  /** Where a run stands: what ContactRun changes, and models read. */
  template <int dim> struct ContactRunState
  {
    ContactRunState(const ContactRunSettings &settings,
                    const RunOptions &options, Report &report)
        : settings(settings),
          options(options),
          report(report),
          communicator(options.communicator),
          method(settings.method),
          contact(communicator),
          control(settings.refinement, settings.method),
          load_steps(settings.load_steps),
          mesh_number(settings.refinement.first_level())
    {
    }

    /** Whether no finer mesh follows. */
    bool is_last_mesh() const
    {
      return mesh_number >= settings.refinement.last_mesh();
    }

    const ContactRunSettings settings;
    const RunOptions &options;
    Report &report;
    const MPI_Comm communicator;

    MethodParameters method; ///< with the law that was chosen
    ContactAssembler<dim> contact;
    TargetControl control;
    LoadSteps load_steps;
    unsigned int mesh_number;

    la::Vector u; ///< displacement, owned
    dealii::Vector<float> squared_estimate;
    ContactResult present;
    std::vector<ContactResult> results;
    unsigned int n_searches = 0, n_repeated_searches = 0;
    DetectionReport detection; ///< of this process, up to the last result
  };
} // namespace abut::app

#endif
