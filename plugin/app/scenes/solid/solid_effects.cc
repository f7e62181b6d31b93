// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_effects.h"

#include "app/physics/material_kind.h"
#include "app/scenes/motion_effects.h"

namespace abut::app
{
  namespace
  {
    /** Data whose effect a condition on the whole scene decides. */
    EffectRule data(const std::string &parameters,
                    std::function<bool(const SceneValues &)> condition,
                    const std::string &otherwise)
    {
      return effective_if(parameters, Weight::data, std::move(condition),
                          otherwise);
    }

    EffectRule setting(const std::string &parameters,
                       std::function<bool(const SceneValues &)> condition,
                       const std::string &otherwise)
    {
      return effective_if(parameters, Weight::setting, std::move(condition),
                          otherwise);
    }

    bool any_has_weight(const SceneValues &values)
    {
      for (const char *masses : {"Body */Density", "Obstacle */Mass"})
        for (const std::string &path : values.matching(masses))
          if (values.number(path) > 0.)
            return true;
      return false;
    }

    bool has_gravity(const SceneValues &values)
    {
      return !values("Solid/Gravity").empty();
    }

    bool has_pairs(const SceneValues &values)
    {
      return values.number("Solid/Pairs") > 0.;
    }

    /** Whether any pair fits. */
    bool any_pair(const SceneValues &values,
                  const std::function<bool(const std::string &section)> &fits)
    {
      for (const std::string &path : values.matching("Pair */Secondary"))
        if (fits(section_of(path)))
          return true;
      return false;
    }

    bool has_large_strain(const SceneValues &values)
    {
      return find_material(values("Body 1/Material")).large_strain;
    }

    bool has_nonlinear_material(const SceneValues &values)
    {
      for (const std::string &path : values.matching("Body */Material"))
        if (!find_material(values(path)).linear)
          return true;
      return false;
    }

    /** Whether points follow the deformed bodies, unless the method forbids
     * it. */
    bool points_may_move(const SceneValues &values)
    {
      const std::string sliding = values("Method/Contact geometry");
      return sliding == "current"
             || (sliding != "start of step" && has_large_strain(values));
    }

    bool has_two_bodies_in_contact(const SceneValues &values)
    {
      return any_pair(values, [&](const std::string &section)
                      { return !values(section + "/Primary").empty(); });
    }

    /** A parameter of pairs that has no effect where @p is_without says so. */
    EffectRule
    of_pairs(const std::string &name,
             const std::function<bool(const SceneValues &values,
                                      const std::string &section)> &is_without,
             const std::string &why)
    {
      return {
          "Pair */" + name, Weight::data,
          [is_without, why](const SceneValues &values, const std::string &path)
          { return is_without(values, section_of(path)) ? why : ""; }};
    }

    std::string unused_obstacle(const SceneValues &values, const std::string &)
    {
      const int n = static_cast<int>(values.number("Solid/Obstacles"));
      for (int obstacle = 1; obstacle <= n; ++obstacle)
      {
        const std::string number = std::to_string(obstacle);
        if (!any_pair(values, [&](const std::string &section)
                      { return values(section + "/Obstacle") == number; }))
          return "no pair is against obstacle " + number
                 + ": name it in 'Pair N/Obstacle', with Solid/Pairs = N or "
                   "more.";
      }
      return "";
    }

    EffectRules of_loads()
    {
      return {data("Solid/Gravity", any_has_weight,
                   "no body has a weight: set Body 1/Density."),
              setting(
                  "Body */Density",
                  [](const SceneValues &values)
                  { return has_gravity(values) || has_motion(values); },
                  "Solid/Gravity is empty, and Time stepping/Scheme is "
                  "quasi-static."),
              data(
                  "Solid/Plane",
                  [](const SceneValues &values)
                  { return values("Dimension") == "2"; },
                  "it belongs to scenes in 2 dimensions.")};
    }

    EffectRules of_contact()
    {
      const auto without_friction =
          [](const SceneValues &values, const std::string &section)
      { return !values.is_set(section + "/Friction"); };
      const auto is_tied =
          [](const SceneValues &values, const std::string &section)
      { return values.is_true(section + "/Tied"); };
      const std::string tied =
          "the pair is tied at the positions of the meshes.";
      const auto without_formulas =
          [](const SceneValues &values, const std::string &section)
      {
        return !values.is_set(section + "/Closed form of pressure")
               && !values.is_set(section + "/Closed form of friction");
      };
      const auto in_space = [](const SceneValues &values, const std::string &)
      { return values("Dimension") == "3"; };
      const std::string plane = "it is drawn along lines of contact, which "
                                "scenes in 3 dimensions do not have.";
      return {
          {"Solid/Obstacles", Weight::data, unused_obstacle},
          of_pairs(
              "Closed form", without_formulas,
              "the name of a closed form needs its formula: set Closed form "
              "of pressure or Closed form of friction."),
          of_pairs("Closed form of pressure", in_space, plane),
          of_pairs("Closed form of friction", in_space, plane),
          of_pairs("Initial gap", is_tied, tied),
          of_pairs("Use mesh gap", is_tied, tied),
          of_pairs("Friction", is_tied, tied),
          of_pairs("Largest friction", without_friction,
                   "the pair has no friction: set Friction, perhaps to a "
                   "large coefficient.")};
    }

    EffectRules of_obstacles()
    {
      const auto turns = [](const SceneValues &values, const std::string &path)
      {
        const std::string angle = section_of(path) + "/Rotation angle";
        return values(angle).empty() ? angle + " is empty." : "";
      };
      const auto is_driven =
          [](const SceneValues &values, const std::string &path)
      {
        const std::string free = section_of(path) + "/Free directions";
        return values(free).empty() ? free
                                          + " is empty: the obstacle follows "
                                            "its Motion, independent of forces."
                                    : "";
      };
      return {
          {"Obstacle */Force", Weight::data, is_driven},
          {"Obstacle */Mass", Weight::data,
           [is_driven](const SceneValues &values, const std::string &path)
           {
             const std::string why = is_driven(values, path);
             return !why.empty() || has_motion(values) || has_gravity(values)
                        ? why
                        : "Time stepping/Scheme is quasi-static, and "
                          "Solid/Gravity is empty.";
           }},
          {"Obstacle */Initial velocity", Weight::data,
           [is_driven](const SceneValues &values, const std::string &path)
           {
             if (!has_motion(values))
               return is_at_rest("hht");
             const std::string why = is_driven(values, path),
                               mass = section_of(path) + "/Mass";
             return !why.empty() || values.number(mass) > 0.
                        ? why
                        : mass
                              + " is 0: without mass the obstacle is in "
                                "equilibrium at all times.";
           }},
          {"Obstacle */Gradient", Weight::data,
           [](const SceneValues &values, const std::string &path)
           {
             const std::string section = section_of(path);
             return values(section + "/Kind") == "height"
                            && values(section + "/Gap along") == "axis"
                            && !points_may_move(values)
                        ? "gap and force are along the axis (" + section
                              + "/Gap along), independent of the slope."
                        : "";
           }},
          {"Obstacle */Rotation centre", Weight::data, turns},
          {"Obstacle */Rotation axis", Weight::data,
           [turns](const SceneValues &values, const std::string &path)
           {
             return values("Dimension") == "2"
                        ? "in 2 dimensions obstacles rotate in the plane."
                        : turns(values, path);
           }},
      };
    }

    EffectRules of_search()
    {
      EffectRules rules = {
          never_effective("Search/Extension", Weight::data,
                          "it belongs to scenes of kind 'search'."),
          never_effective(
              "Search/Self contact", Weight::data,
              "it belongs to scenes of kind 'search'. Self contact of bodies: "
              "the same surface as Primary and Secondary."),
          data(
              "Refinement/Relaxation sweeps",
              [](const SceneValues &values)
              {
                return law_may_be(values, [](const abut_law &law)
                                  { return abut_law_needs_open_start(&law); });
              },
              "it belongs to scenes of kind 'obstacle' and to "
              "Method/Enforcement = barrier."),
          data(
              "Method/Multiplier degree",
              [](const SceneValues &values)
              {
                return values("Method/Discretisation") == "mortar"
                       && values("Solid/Degree") != "1";
              },
              "it belongs to Method/Discretisation = mortar on elements of "
              "Solid/Degree = 2.")};
      const std::string no_partner = "no pair is between bodies.";
      rules.push_back(
          data("Search/Thickness", has_two_bodies_in_contact, no_partner));
      for (const char *name : {"Search/Algorithm", "Search/Bucket*",
                               "Search/Skin", "Method/Segments"})
        rules.push_back(setting(name, has_two_bodies_in_contact, no_partner));
      rules.push_back(
          setting("Method/Geometric contact tangent", points_may_move,
                  "it belongs to Method/Contact geometry = current."));
      const std::string no_contact = "there is no contact: Solid/Pairs is 0.";
      rules.push_back(
          {"Method/*", Weight::setting,
           [no_contact](const SceneValues &values, const std::string &path)
           {
             return has_pairs(values) || path == "Method/Final linear tolerance"
                        ? ""
                        : no_contact;
           }});
      return rules;
    }

    /** Numbers have an effect in the materials that list them. */
    EffectRules of_materials()
    {
      EffectRules rules;
      for (const MaterialNumber &number : material_numbers())
        rules.push_back({std::string("Body */") + number.name, Weight::data,
                         [name = number.name](const SceneValues &values,
                                              const std::string &path)
                         {
                           const std::string word =
                               values(section_of(path) + "/Material");
                           return find_material(word).has(name)
                                      ? ""
                                      : "Material = " + word + " has none.";
                         }});
      return rules;
    }

    EffectRules of_load_steps()
    {
      return {setting(
                  "Time stepping/Smallest step",
                  [](const SceneValues &values)
                  { return values.is_true("Time stepping/Cut back"); },
                  "it belongs to Time stepping/Cut back = true."),
              setting("Time stepping/*Newton*", has_nonlinear_material,
                      "the materials of all bodies are linear."),
              setting(
                  "Solid/Accept strains beyond linear theory",
                  [](const SceneValues &values)
                  { return !has_large_strain(values); },
                  "Body 1/Material is at finite strain.")};
    }

    EffectRules of_motion()
    {
      const auto in_steps = [](const SceneValues &values)
      { return !has_motion(values); };
      const auto iterates = [](const SceneValues &values)
      {
        return has_steps(values) && !has_motion(values)
               && (has_nonlinear_material(values) || points_may_move(values));
      };
      return {data("Time stepping/Number of steps", in_steps,
                   "dynamics has steps of Time stepping/Step size."),
              setting("Time stepping/Extrapolate", iterates,
                      "it belongs to several load steps of finite strain, or "
                      "with Method/Contact geometry = current.")};
    }
  } // namespace

  EffectRules solid_effects()
  {
    return joined({of_loads(), of_materials(), of_contact(), of_obstacles(),
                   of_search(), bucket_effects(), mesh_effects("Body */Mesh"),
                   mesh_effects("Obstacle *"), law_effects(), solver_effects(),
                   refinement_effects(), of_load_steps(), of_motion(),
                   motion_effects({"Body */Initial*"}, "hht"),
                   result_effects()});
  }
} // namespace abut::app
