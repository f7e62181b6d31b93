// SPDX-License-Identifier: LGPL-2.1-or-later
#include "method_effects.h"

namespace abut::app
{
  namespace
  {
    /** A setting of the laws for which @p holds is true. */
    EffectRule of_laws(const std::string &name, const std::string &laws,
                       const std::function<bool(const abut_law &law)> &holds)
    {
      return effective_if(
          "Method/" + name, Weight::setting,
          [holds](const SceneValues &values)
          { return law_may_be(values, holds); },
          "it belongs to Method/Enforcement = " + laws + ".");
    }

    bool has_penalty(const abut_law &law)
    {
      return abut_law_has_penalty(&law);
    }

    bool needs_stress(const abut_law &law)
    {
      return abut_law_needs_stress(&law);
    }

    bool updates_multipliers(const abut_law &law)
    {
      return abut_law_updates_multipliers(&law);
    }

    bool has_continuation(const abut_law &law)
    {
      return abut_law_needs_open_start(&law);
    }

    bool is_interior(const abut_law &law)
    {
      return abut_law_is_interior(&law);
    }

    /** Whether the penalty is raised on the way. */
    bool grows(const abut_law &law)
    {
      return has_penalty(law) && !abut_law_solves_once(&law);
    }

    EffectRule setting(const std::string &parameters,
                       std::function<bool(const SceneValues &)> condition,
                       const std::string &otherwise)
    {
      return effective_if(parameters, Weight::setting, std::move(condition),
                          otherwise);
    }

    /** In pairs of bodies, or of a chain of masses. */
    bool has_friction(const SceneValues &values)
    {
      for (const std::string &path : values.matching("Pair */Friction"))
        if (values.is_set(path))
          return true;
      for (const std::string &path : values.matching("Friction/Coefficient"))
        return values(path) != "0";
      return false;
    }

    bool may_iterate(const SceneValues &values)
    {
      return values("Solver/Linear solver") != "direct";
    }

    bool is_nested(const SceneValues &values)
    {
      return values.is_true("Refinement/Nested iteration");
    }

    bool has_target(const SceneValues &values)
    {
      return values.number("Refinement/Target error") > 0.;
    }

    bool is_adaptive(const SceneValues &values)
    {
      return has_target(values)
             || values.number("Refinement/Adaptive cycles") > 0.;
    }

    bool has_several_meshes(const SceneValues &values)
    {
      return is_adaptive(values)
             || (is_nested(values)
                 && values.number("Refinement/Level")
                        > values.number("Refinement/Coarsest level"));
    }
  } // namespace

  bool law_may_be(const SceneValues &values,
                  const std::function<bool(const abut_law &law)> &holds)
  {
    const abut_law *law = abut_law_find(values("Method/Enforcement").c_str());
    return law == nullptr || holds(*law);
  }

  EffectRules law_effects(const bool may_have_friction)
  {
    const auto is_user = [](const SceneValues &values)
    { return values("Method/Enforcement") == "user"; };
    const std::string user = "it belongs to Method/Enforcement = user.";
    return {
        setting("Method/Law *", is_user, user),
        may_have_friction
            ? setting("Method/Friction *", has_friction,
                      "there is no friction.")
            : never_effective("Method/Friction *", Weight::setting,
                              "there is no friction."),
        setting(
            "Method/Friction parameters",
            [](const SceneValues &values)
            { return values.is_set("Method/Friction file"); },
            "they belong to a friction law of your own: set Method/Friction "
            "file."),
        of_laws("Penalty factor",
                "penalty, quadratic penalty, augmented lagrangian or nitsche",
                has_penalty),
        of_laws("Nitsche theta", "nitsche", needs_stress),
        of_laws("Penalty growth", "quadratic penalty",
                [](const abut_law &law)
                { return grows(law) && !updates_multipliers(law); }),
        of_laws("Penalty cap", "quadratic penalty or augmented lagrangian",
                grows),
        of_laws("Allowed penetration", "penalty or quadratic penalty",
                [](const abut_law &law)
                {
                  return has_penalty(law) && !needs_stress(law)
                         && !updates_multipliers(law);
                }),
        of_laws("Adaptive penalty", "augmented lagrangian",
                updates_multipliers),
        of_laws("Pressure tolerance", "augmented lagrangian",
                updates_multipliers),
        of_laws("Barrier start", "barrier", has_continuation),
        of_laws("Barrier factor", "barrier", has_continuation),
        of_laws("Barrier end", "barrier or interior point", is_interior),
    };
  }

  EffectRules no_discretisation(const std::string &instead)
  {
    EffectRules rules = {
        never_effective("Method/Multiplier degree", Weight::data, instead)};
    for (const char *name : {"Discretisation", "Quadrature degree", "Segments",
                             "Contact geometry", "Geometric contact tangent"})
      rules.push_back(never_effective(std::string("Method/") + name,
                                      Weight::setting, instead));
    return rules;
  }

  EffectRules iteration_effects()
  {
    EffectRules rules;
    for (const char *name : {"Maximum iterations", "Aggregation threshold",
                             "Smoother sweeps", "Contact filter"})
      rules.push_back(
          setting(std::string("Solver/") + name, may_iterate,
                  "it belongs to Solver/Linear solver = iterative or auto."));
    return rules;
  }

  EffectRules solver_effects()
  {
    return joined(
        {{setting(
              "Solver/Direct limit",
              [](const SceneValues &values)
              { return values("Solver/Linear solver") == "auto"; },
              "it belongs to Solver/Linear solver = auto."),
          setting(
              "Solver/Saddle point augmentation",
              [](const SceneValues &values)
              {
                return may_iterate(values)
                       && values("Method/System") != "condensed"
                       && law_may_be(values, [](const abut_law &law)
                                     { return abut_law_is_exact(&law); });
              },
              "it belongs to iterative solvers of saddle point systems.")},
         iteration_effects()});
  }

  EffectRules refinement_effects()
  {
    const std::string target = "it belongs to Refinement/Target error.";
    return {
        setting(
            "Refinement/Coarsest level",
            [](const SceneValues &values)
            { return is_nested(values) || has_target(values); },
            "it belongs to Refinement/Nested iteration = true."),
        setting(
            "Refinement/Level",
            [](const SceneValues &values) { return !has_target(values); },
            "with Refinement/Target error meshes start at Refinement/Coarsest "
            "level."),
        setting(
            "Refinement/Adaptive cycles",
            [](const SceneValues &values) { return !has_target(values); },
            "Refinement/Target error determines their number."),
        setting("Refinement/Coarse level tolerance", has_several_meshes,
                "there is one mesh."),
        setting("Refinement/Refine fraction", is_adaptive,
                "it belongs to Refinement/Adaptive cycles or Target error."),
        setting("Refinement/Coarsen fraction", is_adaptive,
                "it belongs to Refinement/Adaptive cycles or Target error."),
        setting("Refinement/Target quantity", has_target, target),
        setting("Refinement/Maximum meshes", has_target, target),
    };
  }

  EffectRules result_effects()
  {
    return {setting(
        "Exact solution/Gradient",
        [](const SceneValues &values)
        { return !values("Exact solution/Displacement").empty(); },
        "it is the gradient of Exact solution/Displacement, which "
        "is empty.")};
  }

  EffectRules mesh_effects(const std::string &section)
  {
    const std::string why = "meshes are created once, at t = 0.";
    EffectRules rules = {without_time(section + "/Boundary ids", why),
                         without_time(section + "/Map", why)};
    for (const char *name : {"/Generator", "/Arguments"})
      rules.push_back({section + name, Weight::setting,
                       [](const SceneValues &values, const std::string &path)
                       {
                         const std::string file = section_of(path) + "/File";
                         return values(file).empty() || values(path).empty()
                                    ? std::string()
                                    : "the mesh is read from the file that "
                                          + file + " names.";
                       }});
    rules.push_back({section + "/Curved sides", Weight::addition,
                     [](const SceneValues &values, const std::string &path)
                     {
                       // Surfaces have their own number of refinements beside
                       // this one; bodies are refined with the scene, and
                       // before by their own.
                       const std::string section = section_of(path),
                                         own = values(section + "/Refinements");
                       const bool refined =
                           own.empty()
                               ? is_adaptive(values)
                                     || values.number("Refinement/Level") > 0.
                                     || values.number(section_of(section)
                                                      + "/Refinements")
                                            > 0.
                               : values.number(section + "/Refinements") > 0.;
                       const std::string by =
                           own.empty() ? "Refinement/Level" : "Refinements";
                       return refined ? std::string()
                                      : "the mesh is not refined and keeps "
                                        "straight facets: refine it ("
                                            + by + ").";
                     }});
    return rules;
  }

  EffectRules bucket_effects()
  {
    const auto is_adaptive_search = [](const SceneValues &values)
    { return values("Search/Algorithm") == "adaptive buckets"; };
    const auto has_buckets = [](const SceneValues &values)
    { return values("Search/Algorithm") != "all pairs"; };
    return {setting("Search/Bucket capacity", is_adaptive_search,
                    "it belongs to Search/Algorithm = adaptive buckets."),
            setting("Search/Bucket size", has_buckets,
                    "it belongs to Search/Algorithm = uniform buckets or "
                    "adaptive buckets.")};
  }

  EffectRules joined(const std::vector<EffectRules> &lists)
  {
    EffectRules all;
    for (const EffectRules &list : lists)
      all.insert(all.end(), list.begin(), list.end());
    return all;
  }
} // namespace abut::app
