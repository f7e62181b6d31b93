// SPDX-License-Identifier: LGPL-2.1-or-later
#include "membrane_effects.h"

#include "app/scenes/motion_effects.h"

namespace abut::app
{
  namespace
  {
    EffectRules of_height_maps()
    {
      const auto has_map = [](const SceneValues &values)
      { return !values("Contact/Height map").empty(); };
      return {effective_if("Contact/Height map *", Weight::data, has_map,
                           "Contact/Height map names no image.")};
    }

    EffectRules of_time()
    {
      EffectRules rules = {
          without_time("Membrane/Conductivity",
                       "the tension of a membrane is constant in time."),
          without_time("Membrane/Density", "mass is constant in time."),
          without_time("Membrane/Initial*", "it is the state at time 0.")};
      for (const char *parameters :
           {"Membrane/*", "Contact/Obstacle", "Contact/Upper obstacle",
            "Exact solution/*"})
      {
        EffectRule rule = without_time(
            parameters, "t is always 0: Time stepping/Scheme is quasi-static.");
        rule.without_effect =
            [at_rest = rule.without_effect](const SceneValues &values,
                                            const std::string &path)
        { return has_motion(values) ? std::string() : at_rest(values, path); };
        rules.push_back(rule);
      }
      return rules;
    }

    EffectRules of_search()
    {
      return {
          never_effective(
              "Search/*", Weight::setting,
              "the obstacle of a membrane is a function: there is no search."),
          effective_if(
              "Refinement/Relaxation sweeps", Weight::setting,
              [](const SceneValues &values)
              { return values.is_true("Refinement/Nested iteration"); },
              "it belongs to Refinement/Nested iteration = true.")};
    }
  } // namespace

  EffectRules membrane_effects()
  {
    return joined({of_time(), of_height_maps(), mesh_effects("Mesh"),
                   law_effects(false),
                   no_discretisation("the obstacle of a membrane acts at "
                                     "nodes."),
                   solver_effects(), refinement_effects(), of_search(),
                   motion_effects({"Time stepping/End time", "Membrane/Density",
                                   "Membrane/Initial*"},
                                  "contact stabilised"),
                   result_effects()});
  }
} // namespace abut::app
