// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pair_parameters.h"

#include "app/input/formula_pattern.h"
#include "app/input/input_error.h"

#include <abut/dealii/number_pattern.h>

namespace abut::app
{
  namespace
  {
    /** The search takes squares and volumes of its reach. */
    constexpr double largest_reach = 1e40;
  } // namespace

  void PairParameters::declare(dealii::ParameterHandler &prm,
                               const std::string &section)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection(section);
    prm.declare_entry("Secondary", "", Patterns::Anything(),
                      "The surface that carries the constraints, usually the "
                      "finer and softer one: a body and its boundary ids, `1: "
                      "3, 4`; several bodies are separated by ';'. Names may "
                      "stand for both: `plate: top`.");
    prm.declare_entry("Primary", "", Patterns::Anything(),
                      "The surface that it may touch, written like "
                      "`Secondary`; empty with an obstacle. The same as "
                      "`Secondary`: a surface that may touch itself.");
    prm.declare_entry("Obstacle", "0", Patterns::Integer(0),
                      "Number of the rigid obstacle (section `Obstacle N`) "
                      "that takes the place of a primary surface; 0: none.");
    prm.declare_entry("Initial gap", "0", FormulaPattern::one(),
                      "Added to the gap of the meshes: a length or a formula "
                      "in t. Positive: clearance, negative: interference. Of "
                      "an obstacle of kind height it is along the axis where "
                      "its gap is. A clearance must leave something of a "
                      "bounded obstacle and of the bodies of a pair: it is "
                      "smaller than half of what the first and than what the "
                      "second are thick.");
    prm.declare_entry("Mesh gap", "true", Patterns::Bool(),
                      "Whether the gap between the meshes counts. If not, "
                      "`Initial gap` is all of it: for curved surfaces that "
                      "fit, whose facets do not, and that slide a little "
                      "(`Method/Sliding = small`).");
    prm.declare_entry("Tied", "false", Patterns::Bool(),
                      "Glue the surfaces together where they are opposite to "
                      "each other.");
    prm.declare_entry("Friction", "0", FormulaPattern::one(),
                      "Coefficient of Coulomb friction: a number or a formula "
                      "of the undeformed place (with `Method/Sliding = step`, "
                      "as of what flies, of that at the beginning of the step) "
                      "and t; 0: none.");
    prm.declare_entry("Largest friction", "", FormulaPattern::one(),
                      "Bound of the traction along the surface, force per "
                      "area, a number or a formula like `Friction`; with a "
                      "large coefficient this is Tresca's law. Empty: none.");
    prm.declare_entry("Reach", "0", NumberPattern::between(0., largest_reach),
                      "Distance within which the surfaces look for each other; "
                      "0: half a facet, or more when they move more, or when "
                      "nothing nearer stops bodies without supports.");
    prm.declare_entry("Closed form", "", Patterns::Anything(),
                      "Name of a solution from theory, such as `Hertz`, that "
                      "pictures of a plane scene show beside the computed "
                      "tractions.");
    prm.declare_entry("Closed form of pressure", "", Patterns::Anything(),
                      "Its pressure at the points of the secondary surface, "
                      "force per area: a formula in x, y, t and the forces of "
                      "the run on the secondary surface, Fx, Fy in all and Qx, "
                      "Qy of friction. Empty: none.");
    prm.declare_entry("Closed form of friction", "", Patterns::Anything(),
                      "Its traction along the surface, likewise.");
    prm.leave_subsection();
  }

  void PairParameters::parse(dealii::ParameterHandler &prm,
                             const std::string &section_name,
                             const unsigned int n_obstacles)
  {
    section = section_name;
    prm.enter_subsection(section);
    secondary = prm.get("Secondary");
    primary = prm.get("Primary");
    obstacle = prm.get_integer("Obstacle");
    gap = prm.get("Initial gap");
    friction = prm.get("Friction");
    friction_cap = prm.get("Largest friction");
    closed_form = prm.get("Closed form");
    closed_pressure = prm.get("Closed form of pressure");
    closed_friction = prm.get("Closed form of friction");
    mesh_gap = prm.get_bool("Mesh gap");
    tied = prm.get_bool("Tied");
    reach = prm.get_double("Reach");
    prm.leave_subsection();
    if (secondary.empty())
      throw InputError(parameter("Secondary"),
                       "the pair has no secondary surface: name a body and its "
                       "boundary ids, such as '1: 3'.");
    if (primary.empty() && obstacle == 0)
      throw InputError(parameter("Primary"),
                       "the pair has neither a primary surface nor an "
                       "obstacle: give one of the two.");
    if (!primary.empty() && obstacle > 0)
      throw InputError(parameter("Obstacle"),
                       "the pair has a primary surface too: give one of the "
                       "two, or make two pairs.");
    if (obstacle > n_obstacles)
      throw InputError(parameter("Obstacle"),
                       "there is no obstacle " + std::to_string(obstacle)
                           + ": 'Solid/Obstacles' says "
                           + std::to_string(n_obstacles) + ".");
  }
} // namespace abut::app
