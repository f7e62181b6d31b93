// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RIGID_OBSTACLE_PARAMETERS_H
#define ABUT_APP_RIGID_OBSTACLE_PARAMETERS_H

/** @file
 * Rigid obstacles of a scene file.
 */

#include "surface_mesh.h"

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace abut::app
{
  /** A section of a scene that describes a rigid obstacle. */
  struct RigidObstacleParameters
  {
    std::string section; ///< "Obstacle 1"
    std::string kind;    ///< plane, sphere, ...
    bool hollow = false;
    bool open = false;      ///< surface: may have borders
    bool along_axis = true; ///< height: where the gap is measured
    /** Directions in which forces move it, ascending; empty: it goes where its
     * motion says. */
    std::vector<unsigned int> free;
    double mass = 0.;
    std::vector<double> initial_velocity; ///< by direction; empty: 0
    SurfaceParameters surface;
    /** The other parameters as they were given, by name. */
    std::map<std::string, std::string> values;

    /** Declare the parameters in the present section of @p prm. */
    static void declare(dealii::ParameterHandler &prm);

    /** Read them; @p section is the present section's full name. Throws
     * InputError for a parameter that was given although it has no meaning for
     * the kind. */
    void parse(dealii::ParameterHandler &prm, const std::string &section);

    /** Whether the kind has a parameter of its own with this name. */
    bool has(const std::string &name) const;

    /** Whether contact with it begins in a point or a line and grows: not with
     * flat sides. */
    bool is_curved() const
    {
      return kind != "plane" && kind != "box";
    }

    /** Full name of a parameter, for messages. */
    std::string parameter(const std::string &name) const
    {
      return section + "/" + name;
    }
  };
} // namespace abut::app

#endif
