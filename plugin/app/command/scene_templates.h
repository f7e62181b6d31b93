// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SCENE_TEMPLATES_H
#define ABUT_APP_SCENE_TEMPLATES_H

#include <vector>

namespace abut::app
{
  /** A file of prm/templates. */
  struct SceneTemplate
  {
    const char *kind; ///< name of the file without its ending
    const char *text;
  };

  /** All of them. The build makes the source of this function. */
  const std::vector<SceneTemplate> &scene_templates();
} // namespace abut::app

#endif
