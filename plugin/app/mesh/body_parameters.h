// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BODY_PARAMETERS_H
#define ABUT_APP_BODY_PARAMETERS_H

#include "app/physics/material_kind.h"
#include "mesh.h"

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace abut::app
{
  /** A section `Body N` of a scene: shape, material, supports and loads. */
  struct BodyParameters
  {
    std::string section; ///< "Body 1"
    std::string name;    ///< empty: that of its mesh file, or none
    MeshParameters mesh;
    unsigned int refinements = 0;
    const MaterialKind *material = nullptr;
    std::vector<double> numbers; ///< of the material
    VolumeChange volume = VolumeChange::of_point;
    double density = 0.;
    std::string support, traction, pressure, body_force;
    std::string initial_displacement, initial_velocity;

    /** Declare the section of this name. */
    static void declare(dealii::ParameterHandler &prm,
                        const std::string &section);

    /** Read it; throws InputError for an element that the material does not
     * have. */
    void parse(dealii::ParameterHandler &prm, const std::string &section);

    /** Full name of a parameter, for messages. */
    std::string parameter(const std::string &name) const
    {
      return section + "/" + name;
    }
  };
} // namespace abut::app

#endif
