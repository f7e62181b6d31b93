// SPDX-License-Identifier: LGPL-2.1-or-later
#include "outline.h"

#include "app/input/collective.h"
#include "app/report/json.h"
#include "app/restart/disk.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/manifold.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <type_traits>

namespace abut::app
{
  namespace
  {
    /** Faces of the coarse mesh beyond which surfaces are left out, and up to
     * which curved ones are drawn in pieces. */
    constexpr std::size_t most_faces = 20000, few_faces = 1000;

    /** Pieces of a curved edge. */
    constexpr unsigned int n_pieces = 8;

    struct Surface
    {
      SurfaceName name;
      std::vector<double> points, facets;
      std::size_t points_of_facet = 0;
    };

    template <typename Point>
    double add_point(const Point &point, std::vector<double> &points)
    {
      const std::size_t number = points.size() / Point::dimension;
      for (unsigned int d = 0; d < Point::dimension; ++d)
        points.push_back(point[d]);
      return double(number);
    }

    /** The point of a face at @p s of a unit line or square. */
    template <typename Face, int dim>
    dealii::Point<dim> point_of(const Face &face, const double (&s)[2],
                                const dealii::Point<dim> &)
    {
      std::vector<dealii::Point<dim>> vertices;
      std::vector<double> weights;
      for (const unsigned int v : face->vertex_indices())
      {
        double weight = v % 2 == 0 ? 1. - s[0] : s[0];
        if (face->n_vertices() == 4)
          weight *= v < 2 ? 1. - s[1] : s[1];
        vertices.push_back(face->vertex(v));
        weights.push_back(weight);
      }
      return face->get_manifold().get_new_point(
          dealii::make_array_view(vertices.begin(), vertices.end()),
          dealii::make_array_view(weights.begin(), weights.end()));
    }

    /** Append a face in n by n pieces, in the plane n. Corners of triangles
     * are taken as they are. */
    template <int dim, typename Face>
    void add_face(const Face &face, const unsigned int n, Surface &surface)
    {
      surface.points_of_facet = face->n_vertices();
      if (face->n_vertices() == 3)
      {
        for (const unsigned int v : face->vertex_indices())
          surface.facets.push_back(add_point(face->vertex(v), surface.points));
        return;
      }
      const unsigned int rows = dim == 2 ? 0 : n;
      std::vector<double> numbers;
      for (unsigned int j = 0; j <= rows; ++j)
        for (unsigned int i = 0; i <= n; ++i)
        {
          const double s[2] = {double(i) / n, rows == 0 ? 0. : double(j) / n};
          numbers.push_back(add_point(point_of(face, s, dealii::Point<dim>()),
                                      surface.points));
        }
      for (unsigned int j = 0; j < std::max(1u, rows); ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          const double *const first = &numbers[j * (n + 1) + i];
          surface.facets.insert(surface.facets.end(), {first[0], first[1]});
          if (rows > 0)
            surface.facets.insert(surface.facets.end(),
                                  {first[n + 2], first[n + 1]});
        }
    }

    template <int dim>
    std::map<std::string, Surface> surfaces_of(
        const dealii::Triangulation<dim> &mesh,
        const std::function<SurfaceName(dealii::types::boundary_id)> &name)
    {
      std::size_t n_faces = 0;
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
          n_faces += cell->face(f)->at_boundary();
      std::map<std::string, Surface> surfaces;
      if (n_faces > most_faces)
        return surfaces;
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
        {
          const auto face = cell->face(f);
          if (!face->at_boundary())
            continue;
          const SurfaceName called = name(face->boundary_id());
          const bool is_flat = dynamic_cast<const dealii::FlatManifold<dim> *>(
                                   &face->get_manifold())
                               != nullptr;
          // Triangles and quadrilaterals of one id are two surfaces.
          Surface &surface = surfaces[std::to_string(called.body) + ":"
                                      + std::to_string(called.id)
                                      + (face->n_vertices() == 3 ? ":3" : "")];
          surface.name = called;
          add_face<dim>(face,
                        is_flat || n_faces > few_faces ? 1
                        : dim == 2                     ? n_pieces
                                                       : n_pieces / 2,
                        surface);
        }
      return surfaces;
    }

    template <int dim>
    std::string
    outline(const dealii::Triangulation<dim> &mesh,
            const std::function<SurfaceName(dealii::types::boundary_id)> &name)
    {
      std::ostringstream out;
      JsonWriter json(out);
      json.begin();
      json.value("dimension", std::int64_t(dim));
      json.begin("surfaces");
      for (const auto &[key, surface] : surfaces_of(mesh, name))
      {
        json.begin(key);
        json.value("body", std::int64_t(surface.name.body));
        json.value("id", std::int64_t(surface.name.id));
        json.value("names", surface.name.names);
        json.value("points_of_facet", std::int64_t(surface.points_of_facet));
        json.value("points", surface.points);
        json.value("facets", surface.facets);
        json.end();
      }
      json.end();
      json.end();
      return out.str();
    }
  } // namespace

  template <int dim>
  void write_outline(
      const std::filesystem::path &folder, const MPI_Comm communicator,
      const dealii::Triangulation<dim> &mesh,
      const std::function<SurfaceName(dealii::types::boundary_id)> &name)
  {
    collective(communicator,
               [&]
               {
                 if (dealii::Utilities::MPI::this_mpi_process(communicator)
                     == 0)
                   write_file(folder / "outline.json", outline(mesh, name));
               });
  }

  template void write_outline<2>(
      const std::filesystem::path &, MPI_Comm, const dealii::Triangulation<2> &,
      const std::function<SurfaceName(dealii::types::boundary_id)> &);
  template void write_outline<3>(
      const std::filesystem::path &, MPI_Comm, const dealii::Triangulation<3> &,
      const std::function<SurfaceName(dealii::types::boundary_id)> &);
} // namespace abut::app
