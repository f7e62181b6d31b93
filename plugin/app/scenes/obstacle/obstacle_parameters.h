// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_OBSTACLE_PARAMETERS_H
#define ABUT_APP_OBSTACLE_PARAMETERS_H

#include "app/adapt/refinement_parameters.h"
#include "app/input/height_map.h"
#include "app/mesh/mesh.h"
#include "app/scenes/common_parameters.h"
#include "app/scenes/inertia_parameters.h"

#include <abut/dealii/contact_assembler.h>

namespace abut::app
{
  /** All parameters of the scene `obstacle` but those of the methods. */
  struct ObstacleParameters
  {
    MeshParameters mesh;

    // Membrane
    unsigned int degree = 1;
    std::string conductivity, load, dirichlet, neumann;
    std::string density, initial_displacement, initial_velocity;

    // Contact
    std::string obstacle, upper_obstacle, boundary_ids;
    HeightMapParameters height_map;

    InertiaParameters time;
    LoadStepOptions load_steps; ///< those of the motion, or one
    RefinementParameters refinement;

    // Exact solution
    std::string exact_displacement, exact_gradient;
    double exact_energy = 0., exact_force = 0.;

    // Output
    bool fields = true;
    FieldSteps field_steps;
    bool all_levels = false;
    bool nodal_values = false;
    unsigned int linear_solves = 0;

    static void declare(dealii::ParameterHandler &prm);
    void parse(dealii::ParameterHandler &prm);

  private:
    /** Make all else fit a motion; throws InputError for what does not. */
    void begin_motion();
  };
} // namespace abut::app

#endif
