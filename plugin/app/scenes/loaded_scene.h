// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LOADED_SCENE_H
#define ABUT_APP_LOADED_SCENE_H

#include "app/restart/run_identity.h"
#include "scene.h"

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace abut::app
{
  /** A scene read from its file. The constructor takes the values of the file
   * over, in which each must be legal by itself; parse() makes sense of them.
   * Both throw InputError and are to be called inside collective(). */
  class LoadedScene
  {
  public:
    explicit LoadedScene(ParameterFile file);

    /** Read the parameters into the scene. */
    void parse();

    /** Write what is known before the solve. */
    void describe(Report &report) const;

    /** Write what is known after it: settings that it did not use. */
    void describe_solution(Report &report) const;

    /** The scene with all its parameters: value and default of each, and where
     * the value is from. */
    std::string parameters_json() const;

    /** What a run must have in common with one that it goes on with: program,
     * parameters, and content of the files that these name. */
    RunIdentity identity() const;

    /** Name of the kind of the scene. */
    const char *kind() const;

    /** Value of a parameter of section @p section. */
    std::string get(const std::string &section, const std::string &name);

    ParameterFile file;
    std::unique_ptr<Scene> scene;

  private:
    /** @p message about the parameter whose name it begins with, if any. */
    InputError blamed(const std::string &message) const;

    /** As other files of a scene the user's own law may stand beside it. */
    void find_law();

    const SceneKind &scene_kind;
    std::vector<std::string> not_used;  ///< values that this run does not use
    std::vector<std::string> old_words; ///< given, with those of today
    std::vector<ExpectedFigure> expected;
    unsigned int dimension;
    dealii::ParameterHandler prm;
    std::vector<DeclaredParameter> declared; ///< with their values
  };
} // namespace abut::app

#endif
