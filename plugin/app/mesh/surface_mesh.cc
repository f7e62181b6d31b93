// SPDX-License-Identifier: LGPL-2.1-or-later

#include "surface_mesh.h"

#include "app/input/boundary_expressions.h"
#include "app/input/expression.h"
#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "memory_check.h"
#include "shim/reference_faces.h"
#include "stl.h"

#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

namespace abut::app
{
  namespace
  {
    using Ids = std::set<dealii::types::boundary_id>;

    bool is_stl(const std::string &file)
    {
      return lower_case(std::filesystem::path(file).extension().string())
             == ".stl";
    }

    template <int dim, typename Cell>
    bool at_surface(const Cell &cell, const Ids &ids)
    {
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary()
            && ids.count(cell->face(f)->boundary_id()) > 0)
          return true;
      return false;
    }

    /** Refine the cells at the surface only: their number stays in proportion
     * to that of the facets. */
    template <int dim>
    void refine(const SurfaceParameters &parameters, const Ids &ids,
                dealii::Triangulation<dim> &triangulation)
    {
      double n_surface = 0;
      for (const auto &cell : triangulation.active_cell_iterators())
        n_surface += at_surface<dim>(cell, ids) ? 1 : 0;
      const double finest =
          n_surface * std::pow(2., (dim - 1.) * parameters.refinements);
      check_memory(dim, triangulation.n_active_cells() + 3 * finest, 1,
                   MPI_COMM_SELF, parameters.mesh.section + "/Refinements");
      for (unsigned int i = 0; i < parameters.refinements; ++i)
      {
        for (const auto &cell : triangulation.active_cell_iterators())
          if (at_surface<dim>(cell, ids))
            cell->set_refine_flag();
        triangulation.execute_coarsening_and_refinement();
      }
    }

    /** Positions of all vertices of cells, then of the @p middles of edges,
     * mapped. */
    template <int dim>
    std::vector<dealii::Point<dim>>
    mapped_nodes(const SurfaceParameters &parameters,
                 const dealii::Triangulation<dim> &triangulation,
                 const std::vector<dealii::Point<dim>> &middles)
    {
      std::vector<dealii::Point<dim>> points = triangulation.get_vertices();
      points.insert(points.end(), middles.begin(), middles.end());
      if (parameters.map.empty())
        return points;
      const Expression<dim> map(parameters.map,
                                parameters.mesh.section + "/Map", dim);
      std::vector<bool> used = triangulation.get_used_vertices();
      used.resize(points.size(), true);
      std::vector<dealii::Point<dim>> chosen;
      for (std::size_t i = 0; i < points.size(); ++i)
        if (used[i])
          chosen.push_back(points[i]);
      for (unsigned int d = 0; d < dim; ++d)
      {
        const std::vector<double> values = map.evaluate(chosen, d);
        for (std::size_t i = 0, k = 0; i < points.size(); ++i)
          if (used[i])
            points[i][d] = values[k++];
      }
      return points;
    }

    /** A map that mirrors or folds the body would turn its surface inside
     * out. */
    template <int dim>
    void check_cell(
        const SurfaceParameters &parameters,
        const std::vector<dealii::Point<dim>> &vertices,
        const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
    {
      std::vector<unsigned int> indices;
      for (const unsigned int v : cell->vertex_indices())
        indices.push_back(cell->vertex_index(v));
      if (!(dealii::GridTools::cell_measure<dim>(
                vertices,
                dealii::make_array_view(indices.begin(), indices.end()))
            > 0))
        throw InputError(
            parameters.mesh.section + "/Map",
            "'" + parameters.map
                + "' mirrors or folds the body (at the cell "
                  "around "
                + dealii::Patterns::Tools::to_string(cell->center())
                + " before the map).");
    }

    /** Vertices of face @p f of a cell in the order of abut/facet.h, outward.
     */
    template <int dim, typename Cell>
    std::vector<unsigned int>
    outward_face(const shim::ReferenceFaces<dim> &faces,
                 const abut_facet_kind kind, const Cell &cell,
                 const unsigned int f)
    {
      std::vector<unsigned int> vertices;
      for (const unsigned int k : faces.outward_order(kind, f))
        vertices.push_back(cell->vertex_index(faces.vertices(f)[k]));
      return vertices;
    }

    /** The middles of the edges of faces, curved or not, of a mesh with curved
     * ones. */
    template <int dim> class FaceMiddles
    {
    public:
      FaceMiddles(const dealii::Triangulation<dim> &triangulation,
                  const EdgeMiddles<dim> &curved)
      {
        if (curved.empty())
          return;
        for (const auto &cell : triangulation.active_cell_iterators())
          for (unsigned int l = 0; cell->at_boundary() && l < cell->n_lines();
               ++l)
          {
            const auto line = cell->line(l);
            const std::pair<unsigned int, unsigned int> edge =
                std::minmax(line->vertex_index(0), line->vertex_index(1));
            if (!number_of.emplace(edge, places.size()).second)
              continue;
            const auto middle = curved.find(edge);
            places.push_back(middle != curved.end() ? middle->second
                                                    : line->center());
          }
      }

      bool empty() const
      {
        return places.empty();
      }

      /** By number. */
      const std::vector<dealii::Point<dim>> &all() const
      {
        return places;
      }

      /** Append to the vertices of a face the middles of its edges in the order
       * of abut/facet.h; they are numbered from @p first. */
      void append_to(std::vector<unsigned int> &nodes,
                     const unsigned int first) const
      {
        const std::size_t n = nodes.size();
        for (std::size_t i = 0; i < (dim == 2 ? 1 : n); ++i)
          nodes.push_back(
              first + number_of.at(std::minmax(nodes[i], nodes[(i + 1) % n])));
      }

    private:
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> number_of;
      std::vector<dealii::Point<dim>> places;
    };

    abut_facet_kind facet_kind(const int dim, const bool are_simplices,
                               const bool are_curved)
    {
      if (dim == 2)
        return are_curved ? ABUT_FACET_LINE3 : ABUT_FACET_LINE2;
      if (are_simplices)
        return are_curved ? ABUT_FACET_TRI6 : ABUT_FACET_TRI3;
      return ABUT_FACET_QUAD4;
    }

    template <int dim>
    void extract(const SurfaceParameters &parameters, const Ids &ids,
                 const dealii::Triangulation<dim> &triangulation,
                 const EdgeMiddles<dim> &curved, SurfaceArrays &surface)
    {
      const FaceMiddles<dim> middles(triangulation, curved);
      const auto first_middle =
          static_cast<unsigned int>(triangulation.get_vertices().size());
      const std::vector<dealii::Point<dim>> vertices =
          mapped_nodes(parameters, triangulation, middles.all());
      const bool are_simplices =
          triangulation.all_reference_cells_are_simplex();
      const shim::ReferenceFaces<dim> faces =
          are_simplices ? shim::ReferenceFaces<dim>(dealii::FE_SimplexP<dim>(1))
                        : shim::ReferenceFaces<dim>(dealii::FE_Q<dim>(1));
      const abut_facet_kind straight = facet_kind(dim, are_simplices, false);
      surface.kind = facet_kind(dim, are_simplices, !middles.empty());
      std::vector<std::int32_t> node(vertices.size(), -1);
      std::int32_t n_nodes = 0;
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        if (!cell->at_boundary() || !at_surface<dim>(cell, ids))
          continue;
        if (!parameters.map.empty())
          check_cell<dim>(parameters, vertices, cell);
        for (const unsigned int f : cell->face_indices())
        {
          const auto face = cell->face(f);
          if (!face->at_boundary() || ids.count(face->boundary_id()) == 0)
            continue;
          surface.group.push_back(
              static_cast<std::int32_t>(face->boundary_id()));
          std::vector<unsigned int> nodes =
              outward_face(faces, straight, cell, f);
          if (!middles.empty())
            middles.append_to(nodes, first_middle);
          for (const unsigned int v : nodes)
          {
            if (node[v] < 0)
            {
              node[v] = n_nodes++;
              for (unsigned int d = 0; d < dim; ++d)
                surface.position.push_back(vertices[v][d]);
            }
            surface.connectivity.push_back(node[v]);
          }
        }
      }
    }

    template <int dim>
    SurfaceArrays boundary_of_mesh(const SurfaceParameters &parameters,
                                   const RunOptions &options)
    {
      const MeshParameters &mesh = parameters.mesh;
      dealii::Triangulation<dim> triangulation;
      const MeshFileExtras<dim> extras =
          create_mesh<dim>(mesh, options, triangulation);
      const Ids ids = parse_boundary_ids(parameters.surface_ids,
                                         mesh.section + "/Surface ids",
                                         names_of(extras, triangulation));
      if (parameters.refinements > 0)
        require_cubes(triangulation, mesh, "surfaces with Refinements");
      refine<dim>(parameters, ids, triangulation);
      SurfaceArrays surface;
      surface.dimension = dim;
      surface.origin = mesh.file.empty()
                           ? "generator " + mesh.generator
                           : "file " + options.input_file(mesh.file).string();
      surface.parameter =
          mesh.section + (mesh.file.empty() ? "/Arguments" : "/File");
      extract<dim>(parameters, ids, triangulation, extras.middles, surface);
      return surface;
    }

    /** What has no meaning for a file of triangles must not be given. */
    void refuse_mesh_parameters(const SurfaceParameters &parameters)
    {
      const std::string &section = parameters.mesh.section;
      const auto refuse = [&section](const char *name)
      {
        throw InputError(section + "/" + name,
                         "has no effect for a file of triangles (STL).");
      };
      if (parameters.refinements > 0)
        refuse("Refinements");
      if (!parameters.mesh.boundary_ids.empty())
        refuse("Boundary ids");
      if (parameters.surface_ids != "*")
        refuse("Surface ids");
    }

    SurfaceArrays triangles_of_file(const SurfaceParameters &parameters,
                                    const RunOptions &options)
    {
      const MeshParameters &mesh = parameters.mesh;
      refuse_mesh_parameters(parameters);
      const std::filesystem::path file = options.input_file(mesh.file);
      Triangles triangles = read_stl(file, mesh.section + "/File");
      SurfaceArrays surface;
      surface.kind = ABUT_FACET_TRI3;
      surface.origin = "file " + file.string();
      surface.parameter = mesh.section + "/File";
      surface.connectivity = std::move(triangles.connectivity);
      surface.group.assign(surface.connectivity.size() / 3, 0);
      const Placement<3> placement = make_placement<3>(mesh);
      std::vector<dealii::Point<3>> points;
      for (const std::array<double, 3> &x : triangles.vertices)
        points.push_back(placement.place(dealii::Point<3>(x[0], x[1], x[2])));
      std::unique_ptr<Expression<3>> map;
      if (!parameters.map.empty())
        map = std::make_unique<Expression<3>>(parameters.map,
                                              mesh.section + "/Map", 3);
      surface.position.resize(3 * points.size());
      for (unsigned int d = 0; d < 3; ++d)
      {
        const std::vector<double> values =
            map ? map->evaluate(points, d) : std::vector<double>();
        for (std::size_t i = 0; i < points.size(); ++i)
          surface.position[3 * i + d] = map ? values[i] : points[i][d];
      }
      return surface;
    }
  } // namespace

  void SurfaceParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    MeshParameters::declare(prm);
    parameter::declare(prm, "File", "", TextPattern::file(),
                       parameter::advanced("", "sphere.stl"),
                       "File of a mesh whose boundary is the surface (msh, "
                       "inp, ucd, vtk, vtu, unv, xda), or of triangles in 3D "
                       "(stl, text or binary), read instead of generating a "
                       "mesh. A relative name is relative to the scene file.");
    parameter::declare(prm, "Refinements", "0", Integer(0, 30),
                       parameter::advanced("1", "3"),
                       "Number of refinements of the cells at the surface. "
                       "Cells inside are not refined.");
    parameter::declare(
        prm, "Surface ids", "*", TextPattern("a list of boundary ids"),
        parameter::advanced("", "0, 2"),
        "Boundary ids that make up the surface; * is the whole boundary.");
    parameter::declare(
        prm, "Map", "", TextPattern::vector(),
        parameter::advanced("length", "x; y; z + 0.1*sin(x)"),
        "New coordinates of each node as formulas in x, y, z, separated by "
        "semicolons. Applied last. Empty: no change.");
  }

  void SurfaceParameters::parse(dealii::ParameterHandler &prm,
                                const std::string &section)
  {
    mesh.parse(prm, section);
    refinements = static_cast<unsigned int>(prm.get_integer("Refinements"));
    surface_ids = prm.get("Surface ids");
    map = prm.get("Map");
  }

  template <int dim>
  SurfaceArrays make_surface(const SurfaceParameters &parameters,
                             const RunOptions &options)
  {
    if (!is_stl(parameters.mesh.file))
      return boundary_of_mesh<dim>(parameters, options);
    if (dim == 2)
      throw InputError(parameters.mesh.section + "/File",
                       "triangles (STL) exist in 3 dimensions only.");
    return triangles_of_file(parameters, options);
  }

  template SurfaceArrays make_surface<2>(const SurfaceParameters &,
                                         const RunOptions &);
  template SurfaceArrays make_surface<3>(const SurfaceParameters &,
                                         const RunOptions &);
} // namespace abut::app
