// SPDX-License-Identifier: LGPL-2.1-or-later
#include "new_scene.h"

#include "app/input/input_error.h"
#include "app/restart/disk.h"
#include "scene_templates.h"

#include <abut/dealii/nearest_word.h>

#include <vector>

namespace abut::app
{
  std::filesystem::path write_new_scene(const std::string &kind,
                                        const std::filesystem::path &given)
  {
    std::vector<std::string> kinds;
    std::string list;
    for (const SceneTemplate &each : scene_templates())
    {
      kinds.emplace_back(each.kind);
      list += (list.empty() ? "" : ", ") + kinds.back();
    }
    for (const SceneTemplate &each : scene_templates())
      if (kind == each.kind)
      {
        const std::filesystem::path file =
            given.empty() ? std::filesystem::path(kind + ".prm") : given;
        std::error_code error;
        if (std::filesystem::exists(file, error))
          throw InputError("", "'" + file.string()
                                   + "' exists and is not overwritten: name "
                                     "another file, abut new "
                                   + kind + " FILE.prm");
        write_file(file, each.text);
        return file;
      }
    throw InputError("", (kind.empty() ? "'new' needs a kind of scene"
                                       : "there is no scene '" + kind + "'")
                             + std::string(": one of ") + list + "."
                             + (kind.empty() ? "" : did_you_mean(kind, kinds)));
  }
} // namespace abut::app
