// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MESH_DESCRIPTION_H
#define ABUT_APP_MESH_DESCRIPTION_H

#include "app/physics/middle_nodes.h"

#include <abut/dealii/vertex_origin.h>

#include <deal.II/grid/tria.h>
#include <deal.II/grid/tria_description.h>

#include <vector>

namespace abut::app
{
  /** Vertices, cells and marked faces of one level, as deal.II builds
   * meshes from. */
  template <int dim> struct MeshDescription
  {
    std::vector<dealii::Point<dim>> vertices;
    std::vector<dealii::CellData<dim>> cells;
    dealii::SubCellData faces;
    EdgeMiddles<dim> middles; ///< of triangles and tetrahedra
    /** Of the vertices, as far as it is known: the others are of the coarsest
     * mesh. */
    std::vector<VertexOrigin> origins;
  };

  /** The description of a mesh of one level, with all boundary faces, and in 3D
   * all boundary edges and curved inner faces. */
  template <int dim>
  MeshDescription<dim> describe(const dealii::Triangulation<dim> &mesh);
} // namespace abut::app

#endif
