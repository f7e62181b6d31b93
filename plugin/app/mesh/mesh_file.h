// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MESH_FILE_H
#define ABUT_APP_MESH_FILE_H

/** @file
 * Mesh files, read by deal.II, with the reason where one cannot be read.
 */

#include <deal.II/grid/tria.h>

#include <filesystem>
#include <string>

namespace abut::app
{
  /** Read a mesh file of the kind that its ending names. Throws InputError that
   * names @p parameter, with the line of the file where one is to blame. */
  template <int dim>
  void read_mesh_file(const std::filesystem::path &path,
                      const std::string &parameter,
                      dealii::Triangulation<dim> &triangulation);

  /** A sentence about the largest number in a mesh file and its line, after a
   * blank, if it is beyond what coordinates are; else empty. For meshes whose
   * cells are wrong. */
  std::string large_number_hint(const std::filesystem::path &path);
} // namespace abut::app

#endif
