// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NEW_SCENE_H
#define ABUT_APP_NEW_SCENE_H

#include <filesystem>
#include <string>

namespace abut::app
{
  /** Write a commented scene to begin with, one of prm/templates, into
   * @p file, or into `KIND.prm` if that is empty; returns the file. Throws
   * InputError for a kind that there is not, and where the file exists. Not
   * collective. */
  std::filesystem::path write_new_scene(const std::string &kind,
                                        const std::filesystem::path &file);
} // namespace abut::app

#endif
