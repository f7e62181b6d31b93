// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_EFFECT_RULES_H
#define ABUT_APP_EFFECT_RULES_H

/** @file
 * Values that a scene sets and that change nothing: who wrote them believes
 * something that is not so. Each kind of scene has a list of rules, data that
 * say when a parameter has an effect; whoever gives a value an effect deletes
 * its rule.
 */

#include "parameters.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** The values of all parameters of a scene, as text, by path. */
  class SceneValues
  {
  public:
    /** Those of @p parameters; @p file tells which came from the command
     * line. Both are kept by reference. */
    SceneValues(const std::vector<DeclaredParameter> &parameters,
                const ParameterFile &file);

    /** The value of @p path; empty if there is no such parameter. */
    std::string operator()(const std::string &path) const;

    /** The number that @p path is. */
    double number(const std::string &path) const;

    /** Whether @p path is true. */
    bool is_true(const std::string &path) const;

    /** Whether @p path has another value than its default. */
    bool is_set(const std::string &path) const;

    /** Whether @p path was given by `--set`. */
    bool is_from_command_line(const std::string &path) const;

    /** Paths that fit @p pattern, in which `*` is any run of characters, in
     * order of declaration. */
    std::vector<std::string> matching(const std::string &pattern) const;

  private:
    const ParameterFile &file;
    const std::vector<DeclaredParameter> &parameters;
  };

  /** What a parameter without effect is. */
  enum class Weight
  {
    data,    /**< of the problem: the answer is not what was meant, an error */
    setting, /**< of a method that the run does not use: listed under "not
                  used", and an error if it was given by `--set` */
    addition /**< says more of what is there already, as of a mesh: listed */
  };

  /** When the parameters of a name do something. */
  struct EffectRule
  {
    /** Paths; `*` is any run of characters. */
    std::string parameters;
    Weight weight;
    /** Why the parameter at @p path, which is set, has no effect, as a
     * sentence that says what to do; empty if it has one. */
    std::function<std::string(const SceneValues &values,
                              const std::string &path)>
        without_effect;
    /** Whether they never have one in scenes of this kind, whose reference
     * leaves them out. */
    bool never = false;
  };

  /** The section of a path. */
  std::string section_of(const std::string &path);

  /** A rule of parameters that have an effect when @p condition holds, with
   * the sentence to say when not. */
  EffectRule
  effective_if(const std::string &parameters, Weight weight,
               std::function<bool(const SceneValues &values)> condition,
               const std::string &otherwise);

  /** A rule of parameters without effect in any scene of a kind. */
  EffectRule never_effective(const std::string &parameters, Weight weight,
                             const std::string &why);

  /** Whether @p path is @p pattern, in which `*` is any run of characters. */
  bool fits(const std::string &pattern, const std::string &path);

  /** Rules of formulas that time does not move, those at @p parameters. */
  EffectRule without_time(const std::string &parameters,
                          const std::string &why);

  /** Look at all rules. Throws InputError for the first value that must have
   * an effect and has none; returns the others as `Section/Name: why`. */
  std::vector<std::string>
  values_without_effect(const std::vector<EffectRule> &rules,
                        const SceneValues &values);
} // namespace abut::app

#endif
