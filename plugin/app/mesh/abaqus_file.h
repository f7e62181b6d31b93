// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ABAQUS_FILE_H
#define ABUT_APP_ABAQUS_FILE_H

#include "file_mesh.h"

namespace abut::app
{
  /** Read the mesh of an input file of Abaqus or CalculiX: nodes, elements,
   * sets and surfaces, without parts or of one part with one instance. Other
   * keywords are passed over, but for those that would change the mesh.
   * @param part which one of several parts is read; without effect if none has
   * this name and there is one only
   *
   * Throws MeshFileError. */
  FileMesh read_abaqus(const std::filesystem::path &file,
                       const std::string &part = "");
} // namespace abut::app

#endif
