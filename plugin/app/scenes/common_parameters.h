// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_COMMON_PARAMETERS_H
#define ABUT_APP_COMMON_PARAMETERS_H

#include "app/input/parameters.h"
#include "scene.h"

#include <abut/dealii/method_parameters.h>

namespace abut::app
{
  /** The kind of scene that a file asks for by `set Scene`. */
  const SceneKind &scene_kind(const ParameterFile &file);

  /** The dimension that a file asks for by `set Dimension`. */
  unsigned int scene_dimension(const ParameterFile &file,
                               const SceneKind &kind);

  /** Declare what all scenes have in common, then the parameters of
   * @p scene. */
  void declare_all(dealii::ParameterHandler &prm, const SceneKind &kind,
                   const Scene &scene);

  /** Declare the parameters of sections `Exact solution` and `Output` that all
   * scenes with meshes have. */
  void declare_mesh_results(dealii::ParameterHandler &prm);

  /** Steps whose fields are written: `Output/Every`. */
  struct FieldSteps
  {
    FieldSteps() = default;

    /** Of the entered section, in a motion of @p n_steps steps. */
    FieldSteps(const dealii::ParameterHandler &prm, unsigned int n_steps);

    /** A part of the description of a run, if steps are left out without the
     * user's word. */
    std::string in_words() const;

    unsigned int every = 1;
    bool is_automatic = false;
  };

  /** The words with @p separator between them. */
  std::string joined(const std::vector<std::string> &words,
                     const std::string &separator);

  /** Read `Output/Expected`: figures and formulas, "energy: 2*pi; active: 3".
   */
  std::vector<ExpectedFigure> parse_expected(const std::string &text);

  /** Throw InputError for laws that need the stress of elastic bodies: for
   * scenes without any. */
  void require_law_without_stress(const MethodParameters &method);
} // namespace abut::app

#endif
