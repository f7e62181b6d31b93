// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_PARAMETERS_H
#define ABUT_APP_SOLID_PARAMETERS_H

#include "app/adapt/refinement_parameters.h"
#include "app/input/parameters.h"
#include "app/mesh/body_parameters.h"
#include "app/mesh/rigid_obstacle_parameters.h"
#include "app/physics/material.h"
#include "app/scenes/common_parameters.h"
#include "app/scenes/inertia_parameters.h"
#include "app/scenes/load_step_parameters.h"
#include "app/scenes/pair_parameters.h"

#include <string>
#include <vector>

namespace abut::app
{
  /** How many numbered sections a scene `solid` has. */
  struct SolidCounts
  {
    unsigned int bodies = 1;
    unsigned int pairs = 1;
    unsigned int obstacles = 1;

    /** Take them from `Solid/Bodies` and so on. Throws InputError. */
    static SolidCounts read(const ParameterFile &file);
  };

  /** All parameters of the scene `solid` but those of the methods. */
  struct SolidParameters
  {
    unsigned int degree = 1;         ///< of quadrilaterals and hexahedra
    unsigned int simplex_degree = 2; ///< of triangles and tetrahedra
    bool has_degree = false;         ///< given by the file
    PlaneModel plane = PlaneModel::strain;
    bool large_strain = false;         ///< allowed
    bool solve_known_failures = false; ///< pairs that are known to fail
    std::string gravity;
    std::vector<BodyParameters> bodies;
    std::vector<PairParameters> pairs;
    std::vector<RigidObstacleParameters> obstacles;
    LoadStepParameters load_steps; ///< those of the motion, if there is one
    InertiaParameters time;
    RefinementParameters refinement;

    // Exact solution
    std::string exact_displacement, exact_gradient;
    double exact_energy = 0.;

    // Output
    bool fields = true;
    FieldSteps field_steps;
    bool extrapolate = true; ///< load steps
    bool all_levels = false;
    bool nodal_values = false;
    std::string points;

    static void declare(dealii::ParameterHandler &prm,
                        const SolidCounts &counts);
    void parse(dealii::ParameterHandler &prm, const SolidCounts &counts);

    /** Make all fit meshes of triangles (2D) or tetrahedra, which some bodies
     * have; throws InputError for what they do not have. After parse().
     * @param of_simplices [bodies] */
    void begin_simplices(unsigned int dim,
                         const std::vector<bool> &of_simplices);

    /** Whether bodies are of materials for large strain. */
    bool has_large_strain() const
    {
      return bodies.front().material->large_strain;
    }

  private:
    /** Whether all bodies are of small strain, or of large, and nothing is
     * asked for that large strain does not have. Throws InputError. */
    void check_materials() const;
    void check_element(const BodyParameters &body) const;

    /** Make all else fit a motion; throws InputError for what does not. */
    void begin_motion();
  };
} // namespace abut::app

#endif
