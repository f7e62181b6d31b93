// SPDX-License-Identifier: LGPL-2.1-or-later
#include "motion_effects.h"

namespace abut::app
{
  namespace
  {
    /** A number of a time scheme. */
    EffectRule of_scheme(const std::string &name, const std::string &scheme)
    {
      return effective_if(
          "Time/" + name, Weight::data,
          [scheme](const SceneValues &values)
          { return values("Time/Scheme") == scheme; },
          "it belongs to Time/Scheme = " + scheme + ".");
    }
  } // namespace

  bool has_motion(const SceneValues &values)
  {
    return values("Time/Scheme") != "none";
  }

  EffectRules motion_effects(const std::vector<std::string> &data_of_motion,
                             const std::string &first)
  {
    const std::string at_rest = "nothing moves: Time/Scheme is none. " + first
                                + " is the one to begin with.";
    EffectRules rules = {
        of_scheme("Alpha", "hht"),
        of_scheme("Rho infinity", "generalised alpha"),
        of_scheme("Beta", "newmark"), of_scheme("Gamma", "newmark"),
        effective_if("Output/Every", Weight::setting, has_motion, at_rest)};
    std::vector<std::string> names = {"Time/Step", "Time/End", "Time/Mass*",
                                      "Time/Stiffness damping"};
    names.insert(names.end(), data_of_motion.begin(), data_of_motion.end());
    for (const std::string &name : names)
      rules.push_back(effective_if(name, Weight::data, has_motion, at_rest));
    for (const char *name :
         {"Refinement/Nested iteration", "Refinement/Coarsest level",
          "Refinement/Coarse level tolerance"})
      rules.push_back(effective_if(
          name, Weight::setting,
          [](const SceneValues &values) { return !has_motion(values); },
          "a motion begins on the mesh that it ends on."));
    return rules;
  }
} // namespace abut::app
