// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_METHOD_EFFECTS_H
#define ABUT_APP_METHOD_EFFECTS_H

/** @file
 * When parameters that several kinds of scenes share have an effect.
 */

#include "app/input/effect_rules.h"

#include <abut/law.h>

namespace abut::app
{
  using EffectRules = std::vector<EffectRule>;

  /** Whether the law that the scene names may be one for which @p holds is
   * true: `auto` and `user` may be any. */
  bool law_may_be(const SceneValues &values,
                  const std::function<bool(const abut_law &law)> &holds);

  /** Section `Method`, by law. */
  EffectRules law_effects(bool may_have_friction = true);

  /** Section `Method`: how contact between surfaces is written down, in scenes
   * that have none; @p instead says how contact acts there. */
  EffectRules no_discretisation(const std::string &instead);

  /** Section `Solver`: what iterative solvers alone use. */
  EffectRules iteration_effects();

  /** Section `Solver`. */
  EffectRules solver_effects();

  /** Section `Refinement`. */
  EffectRules refinement_effects();

  /** Sections `Exact solution` and `Output` of scenes with meshes. */
  EffectRules result_effects();

  /** Meshes in section @p section, which may hold a `*`: what a file makes
   * superfluous, and conditions on the place. */
  EffectRules mesh_effects(const std::string &section);

  /** Sizes of buckets. */
  EffectRules bucket_effects();

  /** All rules of @p lists, one after the other. */
  EffectRules joined(const std::vector<EffectRules> &lists);
} // namespace abut::app

#endif
