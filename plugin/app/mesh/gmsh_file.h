// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_GMSH_FILE_H
#define ABUT_APP_GMSH_FILE_H

#include "file_mesh.h"

namespace abut::app
{
  /** Read a text file of gmsh, formats 2 and 4: nodes, elements of degree 1 and
   * 2, physical groups with their names as sets. Sections that are not needed
   * are passed over. Throws MeshFileError. */
  FileMesh read_gmsh(const std::filesystem::path &file);
} // namespace abut::app

#endif
