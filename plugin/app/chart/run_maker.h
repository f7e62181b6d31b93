// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHART_RUN_MAKER_H
#define ABUT_APP_CHART_RUN_MAKER_H

/** @file
 * Runs of a scene in processes of their own.
 */

#include "run_store.h"

#include "app/scenes/loaded_scene.h"

#include <string>
#include <vector>

namespace abut::app
{
  /** A scene with settings. */
  struct RunSetting
  {
    std::vector<Assignment> overrides;
    /** All values, the contents of files that they name, and the program: two
     * runs with the same text give the same results. */
    std::string text;
  };

  class RunMaker
  {
  public:
    /** @param scene_file is run from the present folder */
    explicit RunMaker(const std::string &scene_file);

    /** The scene with @p overrides. Throws InputError, its place in the
     * message, where a parameter does not exist or a value is not legal. */
    LoadedScene load(const std::vector<Assignment> &overrides) const;

    /** The setting of a scene loaded with @p overrides. */
    RunSetting setting(const LoadedScene &scene,
                       const std::vector<Assignment> &overrides) const;

    /** The run of @p setting, made now unless @p store has it already.
     * @param repeat number of the run among equal ones
     * @param limit processor seconds that it may take
     * @param made is set to whether it was made now */
    RunRecord run(const RunStore &store, const RunSetting &setting,
                  unsigned int repeat, double limit, bool &made) const;

  private:
    RunRecord make(const RunStore &store, const RunSetting &setting,
                   unsigned int repeat, double limit) const;

    std::string scene_file;
    std::string identity; /**< of the program */
    std::vector<std::string> environment;
  };
} // namespace abut::app

#endif
