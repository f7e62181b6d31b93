// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rigid_obstacle_parameters.h"

#include "app/input/expression.h"
#include "app/input/input_error.h"
#include "app/input/parameters.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>
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
      /** Patterns are copied. */
      Entry(const char *name, const char *default_value,
            const std::vector<std::string> &kinds,
            const Patterns::PatternBase &pattern, const parameter::Note &note,
            const char *text)
          : name(name),
            default_value(default_value),
            kinds(kinds),
            pattern(pattern.clone()),
            note(note),
            text(text)
      {
      }

      std::string name, default_value;
      std::vector<std::string> kinds;
      std::shared_ptr<Patterns::PatternBase> pattern;
      parameter::Note note;
      std::string text;
    };

    const std::vector<Entry> &entries()
    {
      static const std::vector<Entry> all = {
          {"Point",
           "",
           {"plane", "cone"},
           TextPattern::number_vector(),
           parameter::basic("length", "0, -1"),
           "Point of a plane, or tip of a cone. Empty: the origin."},
          {"Normal",
           "",
           {"plane"},
           TextPattern::number_vector(),
           parameter::basic("1", "0, 1"),
           "Normal of a plane, out of the material, of any length. Empty: "
           "along the last coordinate axis."},
          {"Centre",
           "",
           {"sphere", "cylinder", "box"},
           TextPattern::number_vector(),
           parameter::basic("length", "0, 8"),
           "Centre of a sphere, cylinder or box. Empty: the origin."},
          {"Radius",
           "1",
           {"sphere", "cylinder"},
           TextPattern("a number above 0"),
           parameter::basic("length", "8"),
           "Radius of a sphere or cylinder."},
          {"Axis",
           "",
           {"cylinder", "cone", "height"},
           TextPattern::number_vector(),
           parameter::basic("1", "0, 0, -1"),
           "Direction, of any length. Cylinder: its axis. Cone or wedge: from "
           "the tip into the material. Height: a coordinate axis, out of the "
           "material. Empty: the last coordinate axis."},
          {"Length",
           "infinite",
           {"cylinder", "cone"},
           OrWord(TextPattern("a number above 0"), "infinite"),
           parameter::advanced("length", "20"),
           "Length of a cylinder or cone along its axis."},
          {"Size",
           "1",
           {"box"},
           TextPattern::numbers(),
           parameter::advanced("length", "2, 1"),
           "Length of the edges of a box, or one length per direction."},
          {"Angle",
           "45",
           {"cone"},
           TextPattern("a number between 0 and 90"),
           parameter::advanced("degrees", "30"),
           "Angle between axis and side of a cone or wedge."},
          {"Expression",
           "",
           {"height", "distance"},
           TextPattern::formula(),
           parameter::advanced("length", "0.1*x^2 - t"),
           "Formula in x, y, z, t. Kind height: coordinate of the surface "
           "along `Axis`. Kind distance: zero on the surface and positive "
           "outside the material; it is divided by the length of its "
           "gradient."},
          {"Gradient",
           "",
           {"height", "distance"},
           TextPattern::vector(),
           parameter::expert("1", "0.2*x, 0"),
           "Derivatives of `Expression` along x, y, z. Empty: by finite "
           "differences."},
          {"Limit",
           "infinite",
           {"surface"},
           OrWord(TextPattern("a number above 0"), "infinite"),
           parameter::expert("length", "0.5"),
           "Distance up to which the nearest facet is looked for. Points "
           "farther away count as outside of the obstacle."},
          {"Motion",
           "",
           {},
           TextPattern::vector(),
           parameter::basic("length", "0, -0.1*t"),
           "Displacement of the obstacle: a formula in t for each direction. "
           "Empty: 0."},
          {"Free directions",
           "",
           {},
           TextPattern("a list of directions"),
           parameter::advanced("", "y"),
           "Directions in which the obstacle is a rigid body driven by forces: "
           "`Force`, weight, contact and, in dynamics, inertia of `Mass`. It "
           "does not rotate. `Motion` must be 0 in these directions. Empty: "
           "none."},
          {"Force",
           "",
           {},
           TextPattern::vector(),
           parameter::advanced("force", "0, -5*t"),
           "Force on the obstacle in its `Free directions`: a formula in t for "
           "each direction. Axisymmetric: total force of the full circle. With "
           "symmetry planes: force on the modelled part. Empty: 0."},
          {"Initial velocity",
           "",
           {},
           TextPattern::number_vector(),
           parameter::advanced("length/time", "0, -1"),
           "Velocity at the start of a motion, in the `Free directions`. "
           "Empty: 0."},
          {"Rotation angle",
           "",
           {},
           TextPattern::formula(),
           parameter::advanced("degrees", "90*t"),
           "Rotation of the obstacle about `Rotation centre`, applied before "
           "`Motion`: a formula in t. Empty: 0."},
          {"Rotation centre",
           "",
           {},
           TextPattern::number_vector(),
           parameter::advanced("length", "0, 8"),
           "Centre of `Rotation angle`. Empty: the origin."},
          {"Rotation axis",
           "0, 0, 1",
           {},
           TextPattern::number_vector(),
           parameter::advanced("1", "0, 1, 0"),
           "Axis of `Rotation angle` in 3D, of any length."},
      };
      return all;
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
          throw InputError(parameter,
                           "'" + word
                               + "' is not one of the directions x, y, z.");
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
                         "has no effect for an obstacle of kind '"
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
    parameter::declare(
        prm, "Kind", "plane", Patterns::Selection(kind_names()),
        parameter::basic(),
        "Shape of the obstacle. plane (2D: half plane), sphere (disc), "
        "cylinder (3D), box (rectangle), cone (wedge); height: a formula over "
        "the plane orthogonal to `Axis`; distance: a signed distance as a "
        "formula; surface: the boundary of a mesh or triangles of a file, by "
        "the parameters from Generator to Map.");
    parameter::declare(prm, "Hollow", "false", Patterns::Bool(),
                       parameter::advanced(),
                       "Whether the material is outside of the shape.");
    for (const Entry &entry : entries())
      parameter::declare(prm, entry.name, entry.default_value, *entry.pattern,
                         entry.note, entry.text);
    parameter::declare(
        prm, "Mass", "0", NumberPattern::between(0., largest_value),
        parameter::advanced("mass", "2.5"),
        "Mass of an obstacle with `Free directions`. Gives weight with "
        "`Solid/Gravity` and inertia with `Time stepping/Scheme`. 0: forces on "
        "the obstacle are in equilibrium at all times.");
    parameter::declare(prm, "Gap along", "axis",
                       Patterns::Selection("axis|normal"),
                       parameter::advanced(),
                       "Kind height: direction of gap and contact force, along "
                       "the axis or normal to the surface. Always normal where "
                       "contact points follow the deformation (`Method/Contact "
                       "geometry = current`, or auto at finite strain).");
    parameter::declare(prm, "Open surface", "false", Patterns::Bool(),
                       parameter::expert(),
                       "Kind surface: whether the surface may have borders, "
                       "like a sheet with the material behind it.");
    SurfaceParameters::declare(prm);
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
    {
      const std::string value = prm.get(entry.name);
      values[entry.name] = value == "infinite" ? "0" : value;
    }
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
