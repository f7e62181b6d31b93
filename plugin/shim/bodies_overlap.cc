// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bodies_overlap.h"

#include "bodies.h"
#include "by_element.h"
#include "reference_faces.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <vector>

namespace abut::shim
{
  namespace
  {
    /** A point that is nearer to the surface, in a cell of size 1, touches it.
     */
    constexpr double near_surface = 0.01;

    template <int dim> struct PlacedNode
    {
      dealii::Point<dim> place;
      unsigned int body = 0;

      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &place &body;
      }

      bool operator<(const PlacedNode &other) const
      {
        return place[0] < other.place[0];
      }
    };

    /** Corners of facets with these ids on all ranks, sorted by x. */
    template <int dim>
    std::vector<PlacedNode<dim>>
    corners_of(const dealii::DoFHandler<dim> &dof_handler,
               const BodyNumbers<dim> &bodies,
               const std::set<dealii::types::boundary_id> &ids)
    {
      std::vector<PlacedNode<dim>> mine, all;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
              for (const unsigned int v : face->vertex_indices())
                mine.push_back({face->vertex(v), bodies.of(cell)});
      for (const auto &part : dealii::Utilities::MPI::all_gather(
               versions::communicator(dof_handler), mine))
        all.insert(all.end(), part.begin(), part.end());
      std::sort(all.begin(), all.end());
      return all;
    }

    /** [vertices of the mesh] Whether this rank knows a face of the surface at
     * it. */
    template <int dim>
    std::vector<bool>
    surface_vertices(const dealii::DoFHandler<dim> &dof_handler)
    {
      std::vector<bool> result(dof_handler.get_triangulation().n_vertices());
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial() && cell->at_boundary())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              for (const unsigned int v : face->vertex_indices())
                result[face->vertex_index(v)] = true;
      return result;
    }

    /** As of deepest_inside(). */
    template <int dim>
    double depth_in(const dealii::Mapping<dim> &mapping,
                    const ReferenceFaces<dim> &faces,
                    const typename dealii::DoFHandler<dim>::cell_iterator &cell,
                    const std::vector<bool> &at_surface,
                    const dealii::Point<dim> &place)
    {
      dealii::Point<dim> unit;
      try
      {
        unit = mapping.transform_real_to_unit_cell(cell, place);
      }
      catch (const typename dealii::Mapping<dim>::ExcTransformationFailed &)
      {
        return 0.;
      }
      if (!faces.is_inside(unit))
        return 0.;
      double part = 1.;
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          part = std::min(part, faces.height(f, unit));
      for (const unsigned int v : cell->vertex_indices())
        if (at_surface[cell->vertex_index(v)])
          part = std::min(part, unit.distance(faces.vertex(v)));
      return part < near_surface ? 0. : part * cell->minimum_vertex_distance();
    }

    /** The deepest of @p corners in cells of this rank, of bodies with facets
     * of these ids. */
    template <int dim>
    NodeInside<dim>
    deepest_corner(const dealii::Mapping<dim> &mapping,
                   const dealii::DoFHandler<dim> &dof_handler,
                   const BodyNumbers<dim> &bodies,
                   const std::vector<bool> &at_surface,
                   const std::vector<PlacedNode<dim>> &corners,
                   const std::set<dealii::types::boundary_id> &ids)
    {
      const std::vector<int> has_facets = bodies_with(dof_handler, bodies, ids);
      const ByElement faces_of(dof_handler,
                               [](const dealii::FiniteElement<dim> &fe) {
                                 return ReferenceFaces<dim>(fe.base_element(0));
                               });
      PlacedNode<dim> low;
      NodeInside<dim> deepest;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        const unsigned int body = bodies.of(cell);
        if (!cell->is_locally_owned() || has_facets[body] == 0)
          continue;
        const dealii::BoundingBox<dim> box = mapping.get_bounding_box(cell);
        low.place = box.get_boundary_points().first;
        const double high = box.get_boundary_points().second[0];
        for (auto corner =
                 std::lower_bound(corners.begin(), corners.end(), low);
             corner != corners.end() && corner->place[0] <= high; ++corner)
          if (corner->body != body && box.point_inside(corner->place))
          {
            const double depth = depth_in<dim>(mapping, faces_of.of(cell), cell,
                                               at_surface, corner->place);
            if (depth > deepest.depth)
              deepest = {depth, corner->place};
          }
      }
      return deepest;
    }
  } // namespace

  template <int dim>
  NodeInside<dim>
  deepest_inside(const dealii::Mapping<dim> &mapping,
                 const dealii::DoFHandler<dim> &dof_handler,
                 const std::set<dealii::types::boundary_id> &one,
                 const std::set<dealii::types::boundary_id> &other)
  {
    const BodyNumbers<dim> bodies(dof_handler.get_triangulation());
    const std::vector<bool> at_surface = surface_vertices(dof_handler);
    NodeInside<dim> result;
    for (const bool swapped : {false, true})
    {
      const std::set<dealii::types::boundary_id> &nodes = swapped ? other : one,
                                                 &of = swapped ? one : other;
      const NodeInside<dim> mine =
          deepest_corner(mapping, dof_handler, bodies, at_surface,
                         corners_of(dof_handler, bodies, nodes), of);
      for (const auto &[depth, place] : dealii::Utilities::MPI::all_gather(
               versions::communicator(dof_handler),
               std::make_pair(mine.depth, mine.place)))
        if (depth > result.depth)
          result = {depth, place};
    }
    return result;
  }

  template NodeInside<2>
  deepest_inside(const dealii::Mapping<2> &, const dealii::DoFHandler<2> &,
                 const std::set<dealii::types::boundary_id> &,
                 const std::set<dealii::types::boundary_id> &);
  template NodeInside<3>
  deepest_inside(const dealii::Mapping<3> &, const dealii::DoFHandler<3> &,
                 const std::set<dealii::types::boundary_id> &,
                 const std::set<dealii::types::boundary_id> &);
} // namespace abut::shim
