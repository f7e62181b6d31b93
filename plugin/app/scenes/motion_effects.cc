// SPDX-License-Identifier: LGPL-2.1-or-later
#include "motion_effects.h"

namespace abut::app
{
  bool has_motion(const SceneValues &values)
  {
    return values("Time stepping/Scheme") != "quasi-static";
  }

  bool has_steps(const SceneValues &values)
  {
    const char *const n_steps = "Time stepping/Number of steps";
    return has_motion(values)
           || (!values(n_steps).empty() && values.number(n_steps) > 1.);
  }

  std::string is_at_rest(const std::string &first)
  {
    return "it belongs to dynamics, and Time stepping/Scheme is quasi-static. "
           + first + " is a good first choice.";
  }

  EffectRules scheme_effects(const Weight weight)
  {
    const std::pair<std::string, std::string> all[] = {
        {"HHT alpha", "hht"},
        {"Generalised alpha spectral radius", "generalised alpha"},
        {"Newmark beta", "newmark"},
        {"Newmark gamma", "newmark"},
        {"Restitution", "velocity level"}};
    EffectRules rules;
    for (const auto &[name, scheme] : all)
      rules.push_back(effective_if(
          "Time stepping/" + name, weight,
          [scheme = scheme](const SceneValues &values)
          { return values("Time stepping/Scheme") == scheme; },
          "it belongs to Time stepping/Scheme = " + scheme + "."));
    return rules;
  }

  EffectRules motion_effects(const std::vector<std::string> &data_of_motion,
                             const std::string &first)
  {
    const std::string at_rest = is_at_rest(first);
    EffectRules rules = scheme_effects(Weight::data);
    rules.push_back(effective_if("Output/Every", Weight::setting, has_steps,
                                 "the run has one step."));
    std::vector<std::string> names = {
        "Time stepping/Step size", "Time stepping/Mass *",
        "Time stepping/Mass matrix", "Time stepping/Stiffness damping"};
    names.insert(names.end(), data_of_motion.begin(), data_of_motion.end());
    for (const std::string &name : names)
      rules.push_back(effective_if(name, Weight::data, has_motion, at_rest));
    for (const char *name :
         {"Refinement/Nested iteration", "Refinement/Coarsest level",
          "Refinement/Coarse level tolerance"})
      rules.push_back(effective_if(
          name, Weight::setting,
          [](const SceneValues &values) { return !has_motion(values); },
          "dynamics uses one mesh."));
    return rules;
  }
} // namespace abut::app
