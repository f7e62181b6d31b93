// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pair_parameters.h"

#include "app/input/input_error.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

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
    parameter::declare(
        prm, "Secondary", "", TextPattern("a list of surfaces"),
        parameter::basic("", "1: 3, 4"),
        "Surface that carries the constraints (slave), usually the softer "
        "one: body and boundary ids, by number or name. Several bodies are "
        "separated by semicolons.");
    parameter::declare(prm, "Primary", "", TextPattern("a list of surfaces"),
                       parameter::basic("", "plate: top"),
                       "Surface that must not be penetrated (master), in the "
                       "form of `Secondary`. Empty with an obstacle. The same "
                       "as `Secondary`: self contact.");
    parameter::declare(prm, "Obstacle", "none",
                       OrWord(Patterns::Integer(1), "none"),
                       parameter::basic("1", "1"),
                       "Number N of the rigid obstacle (section `Obstacle N`) "
                       "that replaces the primary surface.");
    parameter::declare(
        prm, "Initial gap", "0", TextPattern::formula(),
        parameter::basic("length", "-0.01*t"),
        "Length that is added to the gap of the meshes, a formula in t. "
        "Positive: clearance; negative: interference. A clearance must be "
        "smaller than half of the thickness of a bounded obstacle, and than "
        "the thickness of the bodies. Obstacles of kind height: along `Gap "
        "along`.");
    parameter::declare(
        prm, "Use mesh gap", "true", Patterns::Bool(), parameter::advanced(),
        "Whether the gap between the meshes counts. false: the gap is `Initial "
        "gap` alone, for curved surfaces that fit in the reference "
        "configuration although their facets do not. Needs `Method/Contact "
        "geometry = reference`.");
    parameter::declare(
        prm, "Tied", "false", Patterns::Bool(), parameter::basic(),
        "Whether the surfaces are glued together where they are opposite "
        "to each other.");
    parameter::declare(
        prm, "Friction", "0", TextPattern::formula(),
        parameter::basic("1", "0.3"),
        "Coefficient of Coulomb friction: a number, or a formula in x, y, z, t "
        "(reference coordinates; with `Method/Contact geometry = start of "
        "step` those at the start of the step). 0: frictionless.");
    parameter::declare(prm, "Largest friction", "", TextPattern::formula(),
                       parameter::advanced("force/length^2", "50"),
                       "Limit of the tangential traction: a number, or a "
                       "formula like `Friction`. With a large coefficient this "
                       "is Tresca friction. Empty: none.");
    parameter::declare(
        prm, "Reach", "auto",
        OrWord(NumberPattern::between(0., largest_reach), "auto"),
        parameter::advanced("length", "0.2"),
        "Distance within which the surfaces are paired. auto: half a facet; "
        "more if the surfaces move farther, or if nothing nearer stops a body "
        "without supports.");
    parameter::declare(prm, "Closed form", "", TextPattern("a name"),
                       parameter::advanced("", "Hertz"),
                       "Name of the exact solution that pictures of a plane "
                       "scene show next to the computed tractions.");
    parameter::declare(
        prm, "Closed form of pressure", "", TextPattern::formula(),
        parameter::advanced("force/length^2", "4*Fy/pi*sqrt(max(0, 1 - x^2))"),
        "Its pressure on the secondary surface: a formula in x, y, t and the "
        "forces of the run on that surface, Fx, Fy in all and Qx, Qy of "
        "friction. Empty: none.");
    parameter::declare(
        prm, "Closed form of friction", "", TextPattern::formula(),
        parameter::advanced("force/length^2", "0.3*Fy/pi"),
        "Its tangential traction, a formula like `Closed form of pressure`.");
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
    obstacle =
        static_cast<unsigned int>(parameter::number_or_zero(prm, "Obstacle"));
    gap = prm.get("Initial gap");
    friction = prm.get("Friction");
    friction_cap = prm.get("Largest friction");
    closed_form = prm.get("Closed form");
    closed_pressure = prm.get("Closed form of pressure");
    closed_friction = prm.get("Closed form of friction");
    mesh_gap = prm.get_bool("Use mesh gap");
    tied = prm.get_bool("Tied");
    reach = parameter::number_or_zero(prm, "Reach");
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
                       "the pair has a primary surface as well: give one of "
                       "the two, or use two pairs.");
    if (obstacle > n_obstacles)
      throw InputError(parameter("Obstacle"),
                       "there is no obstacle " + std::to_string(obstacle)
                           + ": Solid/Obstacles is "
                           + std::to_string(n_obstacles) + ".");
  }
} // namespace abut::app
