// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rigid_obstacle_parameters.h"

#include "app/input/expression.h"
#include "app/input/formula_pattern.h"
#include "app/input/input_error.h"
#include "app/input/parameters.h"

#include <abut/dealii/number_pattern.h>
#include <abut/obstacle.h>

#include <algorithm>
#include <memory>
#include <set>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;

    /** The core's shapes, and what a scene can make of formulas and meshes. */
    std::string kind_names()
    {
      std::string names;
      for (int i = 0; i < ABUT_OBSTACLE_N_KINDS; ++i)
        if (const auto kind = static_cast<abut_obstacle_kind>(i);
            abut_obstacle_fields(kind) != 0)
          names += abut_obstacle_name(kind) + std::string("|");
      return names + "height|distance|surface";
    }

    /** A parameter, and the kinds that it has a meaning for (empty: all). */
    struct Entry
    {
      const char *name;
      const char *default_value;
      std::vector<std::string> kinds;
      const char *documentation;
    };

    const std::vector<Entry> &entries()
    {
      static const std::vector<Entry> all = {
          {"Point",
           "",
           {"plane", "cone"},
           "plane: a point of it; cone: its tip. Empty: the origin."},
          {"Normal",
           "",
           {"plane"},
           "Normal out of the material, of any length. Empty: along the last "
           "coordinate axis."},
          {"Centre",
           "",
           {"sphere", "cylinder", "box"},
           "Centre of a sphere or box, middle of a cylinder. Empty: the "
           "origin."},
          {"Radius", "1", {"sphere", "cylinder"}, "Radius, positive."},
          {"Axis",
           "",
           {"cylinder", "cone", "height"},
           "cylinder: direction of its axis; cone (2D: wedge): from the tip "
           "into the material; height: along a coordinate axis, out of the "
           "material, such as `0, 0, -1` for a die above the body. Of any "
           "length. Empty: the last coordinate axis."},
          {"Length",
           "0",
           {"cylinder", "cone"},
           "Length along the axis; 0: without end."},
          {"Size", "1", {"box"}, "Length of the edges, or one per direction."},
          {"Angle",
           "45",
           {"cone"},
           "Degrees between axis and side, between 0 and 90."},
          {"Expression",
           "",
           {"height", "distance"},
           "A formula in x, y, z, t. height: the coordinate of the surface "
           "along `Axis`, from the others. distance: zero on the surface, "
           "positive outside the material; a signed distance, or any other "
           "function, which is divided by the length of its gradient and so "
           "becomes one near the surface."},
          {"Gradient",
           "",
           {"height", "distance"},
           "Formulas of the derivatives of `Expression` along x, y, z, "
           "separated by commas. Empty: by differences."},
          {"Limit",
           "0",
           {"surface"},
           "Distance up to which the nearest facet is looked for; points "
           "farther away count as outside. 0: no limit."},
          {"Motion",
           "",
           {},
           "Displacement of the obstacle as formulas in t, one per direction, "
           "separated by commas: `0, 0, -0.1*t`. Empty: none."},
          {"Free directions",
           "",
           {},
           "Directions in which the obstacle is a rigid body that forces move, "
           "such as `z` or `x, y`: it goes where `Force`, its weight, contact "
           "and, in time, the inertia of `Mass` are in balance, by "
           "translations. In the others it follows `Motion`, which must be 0 "
           "in these. Empty: none."},
          {"Force",
           "",
           {},
           "Force on the obstacle as formulas in t, one per direction; those "
           "of `Free directions` count. Around an axis that on the whole "
           "turn, of a part of what is symmetric that on the part. Empty: "
           "none."},
          {"Initial velocity",
           "",
           {},
           "Velocity at the start of a motion along `Free directions`, one "
           "number per direction. Empty: 0."},
          {"Rotation angle",
           "",
           {},
           "Degrees by which the obstacle is turned before `Motion`, as a "
           "formula in t. Empty: none."},
          {"Rotation centre",
           "",
           {},
           "Point about which `Rotation angle` turns. Empty: the origin."},
          {"Rotation axis",
           "0, 0, 1",
           {},
           "Direction about which `Rotation angle` turns in 3D."}};
      return all;
    }

    std::unique_ptr<Patterns::PatternBase>
    entry_pattern(const std::string &name)
    {
      if (name == "Expression" || name == "Rotation angle")
        return FormulaPattern::one().clone();
      if (name == "Gradient" || name == "Motion" || name == "Force")
        return FormulaPattern::vector().clone();
      return Patterns::Anything().clone();
    }

    /** The directions of a list of names; throws InputError. */
    std::vector<unsigned int> parse_directions(const std::string &text,
                                               const std::string &parameter)
    {
      std::set<unsigned int> directions;
      for (const std::string &word : split_list(text, ','))
      {
        const std::size_t d = std::string("xyz").find(word);
        if (word.size() != 1 || d == std::string::npos)
          throw InputError(parameter, "'" + word
                                          + "' is none of the directions x, "
                                            "y, z.");
        directions.insert(static_cast<unsigned int>(d));
      }
      return {directions.begin(), directions.end()};
    }

    /** Those that belong to surfaces alone; Rotate and Move place all kinds. */
    const std::vector<std::string> &of_surfaces()
    {
      static const std::vector<std::string> names = {
          "Generator",    "Arguments",   "File",        "Scale",
          "Boundary ids", "Refinements", "Surface ids", "Map"};
      return names;
    }

    /** A value that differs from its default was meant to be used. */
    void refuse_without_meaning(const RigidObstacleParameters &parameters,
                                ParameterHandler &prm)
    {
      ParameterHandler defaults;
      RigidObstacleParameters::declare(defaults);
      const auto refuse =
          [&](const std::string &name, const std::vector<std::string> &used_by)
      {
        if (used_by.empty()
            || std::count(used_by.begin(), used_by.end(), parameters.kind) > 0
            || prm.get(name) == defaults.get(name))
          return;
        std::string words;
        for (const std::string &kind : used_by)
          words += (words.empty() ? "" : ", ") + kind;
        throw InputError(parameters.parameter(name),
                         "has no meaning for an obstacle of kind '"
                             + parameters.kind + "', only for: " + words + ".");
      };
      for (const Entry &entry : entries())
        refuse(entry.name, entry.kinds);
      for (const std::string &name : of_surfaces())
        refuse(name, {"surface"});
      refuse("Open surface", {"surface"});
      refuse("Gap along", {"height"});
    }
  } // namespace

  bool RigidObstacleParameters::has(const std::string &name) const
  {
    for (const Entry &entry : entries())
      if (entry.name == name)
        return std::count(entry.kinds.begin(), entry.kinds.end(), kind) > 0;
    return false;
  }

  void RigidObstacleParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Kind", "plane", Patterns::Selection(kind_names()),
                      "plane (2D: half plane), sphere (disc), cylinder (3D), "
                      "box (rectangle), cone (wedge), height over the plane "
                      "orthogonal to an axis, signed distance as a formula, "
                      "or surface: the boundary of a mesh or the triangles of "
                      "a file, described by the parameters from Generator to "
                      "Map.");
    prm.declare_entry("Hollow", "false", Patterns::Bool(),
                      "The material is outside of the shape.");
    for (const Entry &entry : entries())
      prm.declare_entry(entry.name, entry.default_value,
                        *entry_pattern(entry.name), entry.documentation);
    prm.declare_entry("Mass", "0", NumberPattern::between(0., largest_value),
                      "Mass of the obstacle: it has the weight of "
                      "`Solid/Gravity`, and in time inertia along `Free "
                      "directions`. 0: in time, too, forces on it are in "
                      "equilibrium.");
    prm.declare_entry("Gap along", "axis", Patterns::Selection("axis|normal"),
                      "height: whether the gap is measured along the axis, "
                      "and the contact force acts along it, or normal to the "
                      "surface. Normal in any case where points move "
                      "(`Method/Sliding = large`, `auto` at large strain).");
    prm.declare_entry("Open surface", "false", Patterns::Bool(),
                      "surface: it may have borders, like a sheet with the "
                      "material behind it.");
    SurfaceParameters::declare(prm);
    prm.declare_entry("Rotate", "", Patterns::Anything(),
                      "Angle in degrees about the origin (2D), or three "
                      "angles about x, then y, then z (3D), applied after "
                      "Scale, before any motion.");
    prm.declare_entry("Move", "", Patterns::Anything(),
                      "Shift, applied after Rotate, before any motion.");
  }

  void RigidObstacleParameters::parse(ParameterHandler &prm,
                                      const std::string &section_name)
  {
    section = section_name;
    kind = prm.get("Kind");
    hollow = prm.get_bool("Hollow");
    open = prm.get_bool("Open surface");
    along_axis = prm.get("Gap along") == "axis";
    surface.parse(prm, section);
    for (const Entry &entry : entries())
      values[entry.name] = prm.get(entry.name);
    free = parse_directions(values["Free directions"],
                            parameter("Free directions"));
    mass = prm.get_double("Mass");
    initial_velocity = parse_numbers(values["Initial velocity"],
                                     parameter("Initial velocity"));
    refuse_without_meaning(*this, prm);
    if ((kind == "height" || kind == "distance")
        && values["Expression"].empty())
      throw InputError(parameter("Expression"),
                       "an obstacle of kind '" + kind + "' needs a formula.");
  }
} // namespace abut::app
