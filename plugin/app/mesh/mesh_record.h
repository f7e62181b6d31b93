// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MESH_RECORD_H
#define ABUT_APP_MESH_RECORD_H

/** @file
 * A mesh made of the contents of a file: one kind of cells, positively
 * oriented, boundary facets by id, names. Plain C++, nothing of deal.II.
 */

#include "file_mesh.h"

#include <map>
#include <set>

namespace abut::app
{
  struct RecordCell
  {
    std::vector<unsigned int> corners; /**< vertices, in the order of VTK */
    unsigned int material = 0;         /**< id of its first set; 0: no set */
  };

  struct RecordFacet
  {
    std::vector<unsigned int> corners;
    unsigned int boundary_id;
  };

  /** The facets or cells with a name, or with a number only. Facets of several
   * sets have boundary ids of their own, so that a set may have several. */
  struct RecordSet
  {
    std::string name; /**< empty: it has a number only */
    unsigned int id;
    std::set<unsigned int> ids; /**< boundary or material ids of its parts */
  };

  struct MeshRecord
  {
    CellShape shape;
    unsigned int degree; /**< 1 or 2 */
    /** Corners of cells in the order of the file. */
    std::vector<std::array<double, 3>> vertices;
    std::vector<RecordCell> cells; /**< in the order of the file */
    /** Boundary facets with ids other than 0. */
    std::vector<RecordFacet> facets;
    /** Nodes at the middle of edges by the vertices at the ends, the smaller
     * one first. Empty if all edges are straight. */
    std::map<std::pair<unsigned int, unsigned int>, std::array<double, 3>>
        middles;
    std::vector<RecordSet> boundary_sets, materials;
    std::vector<std::string> body_names; /**< of sets with all cells */
    /** Sets by whose names no part of the boundary can be meant, and why. */
    std::map<std::string, std::string> other_sets;
    std::vector<std::string> warnings;
  };

  /** Check the contents of a file and make a mesh of dimension @p dim of them.
   *
   * @param part name of the file's part, or of a set whose cells alone make the
   * mesh; empty: all cells
   *
   * Elements of dimension dim are cells, those of dimension dim - 1 facets;
   * others of less dimensions are left out. Nodes that are no corner of a cell
   * are left out. Cells with reversed order are turned around. Facets within
   * the mesh are left out. Nodes at the same place stay apart, which is what
   * bodies that touch need, with a warning where facets that face each other
   * belong to no set.
   *
   * Throws MeshFileError that names element, node and line for: numbers that
   * stand twice, nodes that do not exist, several kinds or degrees of cells,
   * cells without volume, folded or turned inside out by their middle nodes,
   * curved quadrilaterals and hexahedra of degree 2, cells that overlap at a
   * face, facets of no cell. */
  MeshRecord make_mesh_record(const FileMesh &file, unsigned int dim,
                              const std::string &part = "");
} // namespace abut::app

#endif
