// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_description.h"

#include <deal.II/grid/grid_tools.h>

#include <tuple>

namespace abut::app
{
  template <int dim>
  MeshDescription<dim> describe(const dealii::Triangulation<dim> &mesh)
  {
    MeshDescription<dim> result;
    std::tie(result.vertices, result.cells, result.faces) =
        dealii::GridTools::get_coarse_mesh_description(mesh);
    result.faces.boundary_lines.clear();
    result.faces.boundary_quads.clear();
    for (const auto &face : mesh.active_face_iterators())
    {
      const bool curved =
          face->manifold_id() != dealii::numbers::flat_manifold_id;
      if (!face->at_boundary() && !curved)
        continue;
      dealii::CellData<dim - 1> data(face->n_vertices());
      for (const unsigned int v : face->vertex_indices())
        data.vertices[v] = face->vertex_index(v);
      data.boundary_id = face->boundary_id();
      data.manifold_id = face->manifold_id();
      if constexpr (dim == 2)
        result.faces.boundary_lines.push_back(data);
      else
        result.faces.boundary_quads.push_back(data);
    }
    if constexpr (dim == 3)
    {
      std::vector<bool> seen(mesh.n_raw_lines(), false);
      for (const auto &face : mesh.active_face_iterators())
        for (unsigned int l = 0; l < face->n_lines(); ++l)
        {
          const auto line = face->line(l);
          // Boundary edges take the id of a boundary face.
          if (seen[line->index()]
              || (line->at_boundary()
                      ? !face->at_boundary()
                      : line->manifold_id()
                            == dealii::numbers::flat_manifold_id))
            continue;
          seen[line->index()] = true;
          dealii::CellData<1> data;
          data.vertices = {line->vertex_index(0), line->vertex_index(1)};
          data.boundary_id =
              line->at_boundary() ? face->boundary_id() : line->boundary_id();
          data.manifold_id = line->manifold_id();
          result.faces.boundary_lines.push_back(data);
        }
    }
    return result;
  }

  template MeshDescription<2> describe(const dealii::Triangulation<2> &);
  template MeshDescription<3> describe(const dealii::Triangulation<3> &);
} // namespace abut::app
