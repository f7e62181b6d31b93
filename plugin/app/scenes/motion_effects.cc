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
          "Time stepping/" + name, Weight::data,
          [scheme](const SceneValues &values)
          { return values("Time stepping/Scheme") == scheme; },
          "it belongs to Time stepping/Scheme = " + scheme + ".");
    }
  } // namespace

  bool has_motion(const SceneValues &values)
  {
    return values("Time stepping/Scheme") != "quasi-static";
  }

  EffectRules motion_effects(const std::vector<std::string> &data_of_motion,
                             const std::string &first)
  {
    const std::string at_rest =
        "it belongs to dynamics, and Time stepping/Scheme is quasi-static. "
        + first + " is a good first choice.";
    EffectRules rules = {
        of_scheme("HHT alpha", "hht"),
        of_scheme("Generalised alpha spectral radius", "generalised alpha"),
        of_scheme("Newmark beta", "newmark"),
        of_scheme("Newmark gamma", "newmark"),
        effective_if("Output/Every", Weight::setting, has_motion, at_rest)};
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
