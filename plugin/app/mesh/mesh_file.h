// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MESH_FILE_H
#define ABUT_APP_MESH_FILE_H

/** @file
 * Mesh files, those of gmsh and Abaqus by readers of our own, others by
 * deal.II, with the reason where one cannot be read.
 */

#include "app/input/boundary_names.h"
#include "mesh_description.h"
#include "mesh_record.h"

#include <filesystem>
#include <string>

namespace abut::app
{
  /** The mesh of a record in deal.II's order of corners: vertices and cells in
   * the order of the file, simplices positively oriented, quadrilaterals and
   * hexahedra with edges in the same direction in all cells where possible. */
  template <int dim> MeshDescription<dim> describe(const MeshRecord &record);

  /** Contents of a mesh file beside the mesh. */
  template <int dim> struct MeshFileExtras
  {
    std::vector<BoundaryNames::Set> sets;
    std::map<std::string, std::string> other_names; /**< see BoundaryNames */
    std::vector<std::string> body_names; /**< of sets with all its cells */
    unsigned int degree = 1;             /**< of the cells in the file */
    EdgeMiddles<dim> middles;            /**< none: all edges are straight */
    /** Of the mesh, with the names of the parameters that they are about. */
    std::vector<std::pair<std::string, std::string>> warnings;
  };

  /** Read a mesh file, of gmsh or Abaqus by its content, else of the kind that
   * its ending names; all of it, or the @p part of this name. Throws InputError
   * that names @p parameter, with the line of the file where one is to blame.
   */
  template <int dim>
  MeshFileExtras<dim> read_mesh_file(const std::filesystem::path &path,
                                     const std::string &parameter,
                                     const std::string &part,
                                     dealii::Triangulation<dim> &triangulation);

  /** A sentence about the largest number in a mesh file and its line, after a
   * blank, if it is beyond what coordinates are; else empty. For meshes whose
   * cells are wrong. */
  std::string large_number_hint(const std::filesystem::path &path);
} // namespace abut::app

#endif
