// SPDX-License-Identifier: LGPL-2.1-or-later
#include "quadratic_nodes.h"

#include <deal.II/fe/fe.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria.h>

namespace abut::shim
{
  namespace
  {
    constexpr unsigned int no_part = dealii::numbers::invalid_unsigned_int;

    /** Where a node of the element sits in a cell. */
    struct NodePlace
    {
      std::vector<unsigned int> vertices; ///< that it is in the middle of
      unsigned int line = no_part, face = no_part;
    };

    /** Place of each node of the scalar element: first those of vertices, then
     * of lines, in space of faces, and of the cell. */
    template <int dim>
    std::vector<NodePlace>
    node_places(const dealii::FiniteElement<dim> &element)
    {
      const dealii::ReferenceCell cell = element.reference_cell();
      const unsigned int n_vertices = cell.n_vertices();
      std::vector<NodePlace> result;
      for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
      {
        const dealii::Point<dim> point = element.unit_support_point(i);
        NodePlace place;
        for (unsigned int v = 0; v < n_vertices; ++v)
          if (cell.d_linear_shape_function(point, v) > 0.1)
            place.vertices.push_back(v);
        if (place.vertices.size() == 2)
          place.line = i - n_vertices;
        if (dim == 3 && place.vertices.size() == 4)
          place.face = i - n_vertices - cell.n_lines();
        result.push_back(std::move(place));
      }
      return result;
    }

    /** Lines and faces that are parts of those of coarser neighbours. */
    template <int dim> class HangingParts
    {
    public:
      explicit HangingParts(const dealii::Triangulation<dim> &triangulation)
          : lines_(triangulation.n_raw_lines(), false)
      {
        if constexpr (dim == 3)
          faces_.resize(triangulation.n_raw_quads(), false);
        // Lines and faces of artificial cells may be refined elsewhere.
        for (const auto &cell : triangulation.active_cell_iterators())
        {
          if (cell->is_artificial())
            continue;
          for (const unsigned int line : cell->line_indices())
            mark_line(cell->line(line));
          if constexpr (dim == 3)
            for (const unsigned int face : cell->face_indices())
              mark_face(cell->face(face));
        }
      }

      /** Whether the node at a place of a cell, which is no vertex, hangs. */
      template <typename Cell>
      bool has(const Cell &cell, const NodePlace &place) const
      {
        if (place.line != no_part)
          return lines_[cell->line_index(place.line)];
        return place.face != no_part && faces_[cell->face_index(place.face)];
      }

    private:
      template <typename Line> void mark_line(const Line &line)
      {
        for (unsigned int c = 0; line->has_children() && c < 2; ++c)
          lines_[line->child(c)->index()] = true;
      }

      template <typename Face> void mark_face(const Face &face)
      {
        for (unsigned int c = 0; face->has_children() && c < 4; ++c)
        {
          const auto child = face->child(c);
          faces_[child->index()] = true;
          for (unsigned int line = 0; line < 4; ++line)
            lines_[child->line(line)->index()] = true;
        }
      }

      std::vector<bool> lines_, faces_;
    };
  } // namespace

  template <int dim>
  std::vector<QuadraticNode>
  own_quadratic_nodes(const dealii::DoFHandler<dim> &dof_handler,
                      const std::vector<std::uint8_t> &hangs)
  {
    const dealii::FiniteElement<dim> &fe = dof_handler.get_fe();
    const std::vector<NodePlace> places = node_places(fe.base_element(0));
    const HangingParts<dim> hanging(dof_handler.get_triangulation());
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    std::vector<unsigned int> number(owned.n_elements(), no_part);
    std::vector<QuadraticNode> found;
    std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      cell->get_dof_indices(dofs);
      for (unsigned int b = 0; b < places.size(); ++b)
      {
        const auto first = dofs[fe.component_to_system_index(0, b)];
        if (!owned.is_element(first))
          continue;
        unsigned int &at = number[owned.index_within_set(first)];
        if (at != no_part)
          continue;
        at = found.size();
        QuadraticNode node;
        for (const unsigned int v : places[b].vertices)
          node.vertex[node.n_vertices++] = cell->vertex_index(v);
        for (unsigned int c = 0; c < fe.n_components(); ++c)
          node.unknown[c] = dofs[fe.component_to_system_index(c, b)];
        node.hangs = node.n_vertices == 1 ? hangs[node.vertex[0]] != 0
                                          : hanging.has(cell, places[b]);
        found.push_back(node);
      }
    }
    std::vector<QuadraticNode> result;
    result.reserve(found.size());
    for (const unsigned int at : number)
      if (at != no_part)
        result.push_back(found[at]);
    return result;
  }

  template std::vector<QuadraticNode>
  own_quadratic_nodes(const dealii::DoFHandler<2> &,
                      const std::vector<std::uint8_t> &);
  template std::vector<QuadraticNode>
  own_quadratic_nodes(const dealii::DoFHandler<3> &,
                      const std::vector<std::uint8_t> &);
} // namespace abut::shim
