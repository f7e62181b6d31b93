// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Readers of mesh files: the same meshes in all formats of gmsh and in Abaqus'
// words, their volumes, sides and names, and the mesh that deal.II makes of
// them, vertex by vertex the same as deal.II's own reader makes where it can.
// With files on the command line: their errors.

#include "app/mesh/abaqus_file.h"
#include "app/mesh/cell_geometry.h"
#include "app/mesh/gmsh_file.h"
#include "app/mesh/mesh_file.h"

#include "expect.h"
#include "run_checks.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <filesystem>
#include <fstream>

using namespace abut::app;

namespace
{
  using Numbers = std::set<unsigned int>;

  constexpr double pi = 3.14159265358979323846;

  std::filesystem::path folder, files;

  MeshRecord read(const std::string &name, const unsigned int dim)
  {
    return make_mesh_record(read_gmsh(files / (name + ".msh")), dim);
  }

  Place corner(const MeshRecord &mesh, const unsigned int vertex)
  {
    return mesh.vertices[vertex];
  }

  double triple(const Place &o, const Place &a, const Place &b, const Place &c)
  {
    double m[3][3];
    for (unsigned int d = 0; d < 3; ++d)
    {
      m[0][d] = a[d] - o[d];
      m[1][d] = b[d] - o[d];
      m[2][d] = c[d] - o[d];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
           - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
           + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }

  /** Signed volume or area of a cell: of hexahedra that are boxes or sheared.
   */
  double volume(const MeshRecord &mesh, const RecordCell &cell)
  {
    const auto x = [&](const unsigned int c)
    { return corner(mesh, cell.corners[c]); };
    const Place up = {{x(0)[0], x(0)[1], x(0)[2] + 1.}};
    switch (mesh.shape)
    {
    case CellShape::triangle:
      return triple(x(0), x(1), x(2), up) / 2.;
    case CellShape::quadrilateral:
      return (triple(x(0), x(1), x(2), up) + triple(x(0), x(2), x(3), up)) / 2.;
    case CellShape::tetrahedron:
      return triple(x(0), x(1), x(2), x(3)) / 6.;
    default:
      return triple(x(0), x(1), x(3), x(4));
    }
  }

  /** Sum over cells; each must be positive. */
  double volume(const MeshRecord &mesh)
  {
    double sum = 0.;
    for (const RecordCell &cell : mesh.cells)
    {
      const double part = volume(mesh, cell);
      Expect::that(part > 0., "a positive cell");
      sum += part;
    }
    return sum;
  }

  const RecordSet &set(const MeshRecord &mesh, const std::string &name)
  {
    static const RecordSet none{"", 0, {}};
    for (const RecordSet &each : mesh.boundary_sets)
      if (each.name == name)
        return each;
    Expect::that(false, "a set " + name);
    return none;
  }

  /** Length or area of the facets of a set; triangles and parallelograms. */
  double area(const MeshRecord &mesh, const std::string &name)
  {
    const RecordSet &wanted = set(mesh, name);
    double sum = 0.;
    for (const RecordFacet &facet : mesh.facets)
    {
      if (wanted.ids.count(facet.boundary_id) == 0)
        continue;
      const Place a = corner(mesh, facet.corners[0]),
                  b = corner(mesh, facet.corners[1]),
                  c = corner(mesh, facet.corners[2 % facet.corners.size()]);
      double square = 0.;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const unsigned int e = (d + 1) % 3;
        const double normal =
            (b[d] - a[d]) * (c[e] - b[e]) - (b[e] - a[e]) * (c[d] - b[d]);
        square += normal * normal;
      }
      sum += facet.corners.size() == 2   ? distance(a, b)
             : facet.corners.size() == 3 ? std::sqrt(square) / 2.
                                         : std::sqrt(square);
    }
    return sum;
  }

  void squares()
  {
    for (const char *name :
         {"quads-2.2", "quads-4.0", "quads-4.1", "quads-degree-2"})
    {
      const MeshRecord mesh = read(name, 2);
      const std::string what = std::string(" of ") + name;
      Expect::that(mesh.shape == CellShape::quadrilateral
                       && mesh.degree == (name[6] == 'd' ? 2 : 1)
                       && mesh.middles.empty(),
                   "quadrilaterals" + what);
      Expect::near(double(mesh.cells.size()), 8, 0, "cells" + what);
      Expect::near(double(mesh.vertices.size()), 15, 0, "vertices" + what);
      Expect::near(volume(mesh), 2, 1e-14, "area" + what);
      Expect::near(area(mesh, "bottom"), 2, 1e-14, "bottom" + what);
      Expect::near(area(mesh, "right side"), 1, 1e-14, "side" + what);
      Expect::that(set(mesh, "top").id == 3
                       && set(mesh, "right side").ids == Numbers{6}
                       && mesh.facets.size() == 10,
                   "ids" + what);
      Expect::that(mesh.body_names == std::vector<std::string>({"plate"}),
                   "name of the cells" + what);
    }
  }

  void groups()
  {
    for (const char *name : {"overlap-2.2", "overlap-4.1"})
    {
      const MeshRecord mesh = read(name, 2);
      const std::string what = std::string(" of ") + name;
      Expect::near(volume(mesh), 2, 1e-14, "area" + what);
      Expect::near(area(mesh, "around"), 6, 1e-14, "around" + what);
      Expect::near(area(mesh, "ends"), 2, 1e-14, "ends" + what);
      Expect::that(set(mesh, "around").ids == Numbers{1, 2}
                       && set(mesh, "ends").ids == Numbers{2}
                       && mesh.body_names.size() == 2,
                   "ids of groups that overlap" + what);
    }
    const MeshRecord all = read("all-2.2", 2);
    Expect::near(volume(all), 2, 1e-14, "area of a file without groups");
    Expect::that(all.facets.empty() && all.boundary_sets.empty(),
                 "no ids without groups");
    const MeshRecord mesh = read("inside-4.1", 2);
    Expect::near(area(mesh, "left"), 1, 1e-14, "left");
    Expect::that(mesh.facets.size() == 2 && mesh.boundary_sets.size() == 1
                     && mesh.other_sets.count("middle") == 1
                     && mesh.materials.size() == 2 && mesh.body_names.empty(),
                 "a curve within the mesh");
  }

  void boxes()
  {
    for (const char *name :
         {"hexes-2.2", "hexes-4.1", "hexes-degree-2", "tets-4.0", "tets-4.1"})
    {
      const MeshRecord mesh = read(name, 3);
      const std::string what = std::string(" of ") + name;
      Expect::near(double(mesh.cells.size()), name[0] == 't' ? 96 : 16, 0,
                   "cells" + what);
      Expect::near(double(mesh.vertices.size()), 45, 0, "vertices" + what);
      Expect::near(volume(mesh), 2, 1e-13, "volume" + what);
      Expect::near(area(mesh, "top"), 2, 1e-14, "top" + what);
      Expect::near(area(mesh, "bottom"), 2, 1e-14, "bottom" + what);
      Expect::that(mesh.middles.empty(), "straight edges" + what);
    }
  }

  void curved()
  {
    for (const char *name : {"ring-4.1", "ring-degree-2"})
    {
      const MeshRecord mesh = read(name, 2);
      const bool is_quadratic = mesh.degree == 2;
      Expect::that(mesh.shape == CellShape::triangle, "triangles");
      Expect::near(volume(mesh), 3. * pi / 4., 0.05, "area of a ring");
      Expect::that(mesh.middles.empty() == !is_quadratic, "curved edges");
      for (const RecordFacet &facet : mesh.facets)
        if (is_quadratic)
        {
          const auto ends = std::minmax(facet.corners[0], facet.corners[1]);
          const double radius =
              set(mesh, "outside").ids.count(facet.boundary_id) > 0 ? 2. : 1.;
          Expect::near(distance(mesh.middles.at(ends), {}), radius, 1e-12,
                       "radius of a middle node");
        }
    }
    const MeshRecord ball = read("ball-degree-2", 3);
    Expect::that(ball.shape == CellShape::tetrahedron && ball.degree == 2,
                 "tetrahedra of degree 2");
    Expect::that(area(ball, "sphere") > 0.7 * 4. * pi, "area of the ball");
    unsigned int n = 0;
    for (const RecordFacet &facet : ball.facets)
      for (unsigned int c = 0; c < 3; ++c, ++n)
      {
        const auto ends =
            std::minmax(facet.corners[c], facet.corners[(c + 1) % 3]);
        Expect::near(distance(ball.middles.at(ends), {}), 1., 1e-6,
                     "radius of a middle node of the ball");
      }
    Expect::that(n > 50, "edges of the ball");
  }

  /** Copy a file of format 2.2 with all cells of @p n corners the other way
   * round. */
  std::filesystem::path reversed(const std::string &name, const std::size_t n)
  {
    std::ifstream in(files / (name + ".msh"));
    const std::filesystem::path path = folder / "reversed.msh";
    std::ofstream out(path);
    const std::string type = n == 4 ? "3" : "5";
    for (std::string line; std::getline(in, line); out << '\n')
    {
      std::istringstream words(line);
      std::vector<std::string> all;
      for (std::string word; words >> word;)
        all.push_back(word);
      const bool is_cell = all.size() == 5 + n && all[1] == type;
      for (std::size_t i = 0; is_cell && i < n / 2; ++i)
        std::swap(all[5 + i], all[n == 4 ? 8 - i : 9 + i]);
      for (const std::string &word : all)
        out << word << ' ';
    }
    return path;
  }

  /** deal.II's own reader, vertex by vertex. */
  template <int dim> void same_as_dealii(const std::filesystem::path &path)
  {
    const std::string name = path.stem();
    dealii::Triangulation<dim> ours, theirs;
    const auto extras = read_mesh_file(path, "File", "", ours);
    std::ifstream in(path);
    dealii::GridIn<dim>(theirs).read_msh(in);
    Expect::that(ours.get_vertices() == theirs.get_vertices(),
                 "vertices of " + name);
    Expect::that(ours.n_active_cells() == theirs.n_active_cells(),
                 "cells of " + name);
    auto cell = theirs.begin_active();
    bool is_same = true;
    for (const auto &own : ours.active_cell_iterators())
    {
      for (const unsigned int v : own->vertex_indices())
        is_same = is_same && own->vertex_index(v) == cell->vertex_index(v);
      for (const unsigned int f : own->face_indices())
        is_same =
            is_same
            && own->face(f)->boundary_id() == cell->face(f)->boundary_id();
      ++cell;
    }
    Expect::that(is_same && (name == "all-2.2") == extras.sets.empty(),
                 "the mesh of " + name);
    Expect::near(dealii::GridTools::volume(ours), 2., 1e-13,
                 "deal.II's volume of " + name);
  }

  /** Simplices in deal.II's order: right boundary ids and volume. */
  void simplices_in_dealii()
  {
    dealii::Triangulation<3> mesh;
    read_mesh_file(files / "tets-4.1.msh", "File", "", mesh);
    double volume = 0., top = 0.;
    for (const auto &cell : mesh.active_cell_iterators())
    {
      volume += cell->measure();
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == 2)
          top += cell->face(f)->measure();
    }
    Expect::near(volume, 2., 1e-13, "volume of tetrahedra");
    Expect::near(top, 2., 1e-13, "area of their top");
    dealii::Triangulation<2> ring;
    const auto extras =
        read_mesh_file(files / "ring-degree-2.msh", "File", "", ring);
    Expect::that(extras.degree == 2, "degree of a file");
    unsigned int n_on_circles = 0;
    for (const auto &face : ring.active_face_iterators())
    {
      const auto middle = extras.middles.find(
          std::minmax(face->vertex_index(0), face->vertex_index(1)));
      const bool is_round = face->at_boundary() && face->boundary_id() > 0;
      Expect::that((middle != extras.middles.end()) == is_round,
                   "edges on circles, and no others, are curved");
      if (!is_round)
        continue;
      ++n_on_circles;
      Expect::near(middle->second.norm(), face->boundary_id() == 1 ? 2. : 1.,
                   1e-12, "middle of an edge of deal.II");
    }
    Expect::that(n_on_circles > 6, "edges on circles");
  }

  MeshRecord from_text(const std::string &text, const unsigned int dim)
  {
    const std::filesystem::path path = folder / "text.inp";
    std::ofstream(path) << text;
    return make_mesh_record(
        text[0] == '$' ? read_gmsh(path) : read_abaqus(path), dim);
  }

  void abaqus()
  {
    const char *const nodes = "*NODE\n1,0,0\n2,1,0\n3,2.D0,0\n4,0,1.\n5,1,1\n"
                              "6,2,1\n";
    // One cell the other way round; a node of no cell; sets that overlap.
    const MeshRecord quads = from_text(
        std::string(nodes)
            + "*element, type=cps4r, elset=All\n1, 1, 2, 5, 4\n2, 2, 5, 6, 3\n"
              "*nset, nset=Low, generate\n1, 3\n*Surface, name=Side\nAll\n"
              "*NODE\n99, 7, 7, 7\n*surface, name=LeftS\n1, s4\n*NSET, "
              "NSET=point\n2\n",
        2);
    Expect::near(volume(quads), 2, 1e-14, "area of Abaqus' quadrilaterals");
    Expect::that(quads.vertices.size() == 6, "a node of no cell");
    Expect::near(area(quads, "Low"), 2, 1e-14, "a node set");
    Expect::near(area(quads, "Side"), 6, 1e-14, "all free faces");
    Expect::near(area(quads, "LeftS"), 1, 1e-14, "a face of an element");
    Expect::that(set(quads, "Side").ids.size() == 3
                     && set(quads, "Low").ids.size() == 1
                     && quads.other_sets.count("point") == 1
                     && quads.body_names == std::vector<std::string>({"All"}),
                 "ids of Abaqus' sets");
    // Faces S1 to S4 of a tetrahedron of degree 2, by their middle.
    std::string text = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n"
                       "5,.5,0,0\n6,.5,.5,0\n7,0,.5,0\n8,0,0,.5\n"
                       "9,.5,0,.5\n10,0,.5,.5\n"
                       "*ELEMENT, TYPE=C3D10M\n7, 1,2,3,4, 5,6,\n7,8,9,10\n";
    for (int side = 1; side <= 4; ++side)
      text += "*SURFACE, NAME=F" + std::to_string(side) + ", TYPE=ELEMENT\n7, S"
              + std::to_string(side) + "\n";
    const MeshRecord tet = from_text(text, 3);
    Expect::that(tet.degree == 2 && tet.middles.empty()
                     && tet.facets.size() == 4,
                 "Abaqus' tetrahedron");
    const Place centres[] = {{{1. / 3., 1. / 3., 0.}},
                             {{1. / 3., 0., 1. / 3.}},
                             {{1. / 3., 1. / 3., 1. / 3.}},
                             {{0., 1. / 3., 1. / 3.}}};
    for (unsigned int side = 0; side < 4; ++side)
      for (const RecordFacet &facet : tet.facets)
        if (set(tet, "F" + std::to_string(side + 1))
                .ids.count(facet.boundary_id))
        {
          Place centre{};
          for (const unsigned int c : facet.corners)
            for (unsigned int d = 0; d < 3; ++d)
              centre[d] += corner(tet, c)[d] / 3.;
          Expect::near(distance(centre, centres[side]), 0, 1e-14,
                       "centre of a face of the tetrahedron");
        }
  }

  /** Hexahedra: each face of Abaqus by its plane. */
  void faces_of_hexahedra()
  {
    std::string text = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n"
                       "6,1,0,1\n7,1,1,1\n8,0,1,1\n*ELEMENT, TYPE=C3D8R\n"
                       "1, 1,2,3,4,5,6,7,8\n";
    for (int side = 1; side <= 6; ++side)
      text += "*SURFACE, NAME=F" + std::to_string(side) + "\n1, S"
              + std::to_string(side) + "\n";
    const MeshRecord mesh = from_text(text, 3);
    const Place centres[] = {{{.5, .5, 0.}}, {{.5, .5, 1.}}, {{.5, 0., .5}},
                             {{1., .5, .5}}, {{.5, 1., .5}}, {{0., .5, .5}}};
    for (const RecordFacet &facet : mesh.facets)
    {
      const auto side =
          std::find_if(mesh.boundary_sets.begin(), mesh.boundary_sets.end(),
                       [&](const RecordSet &each)
                       { return each.ids.count(facet.boundary_id) > 0; })
          - mesh.boundary_sets.begin();
      Place centre{};
      for (const unsigned int c : facet.corners)
        for (unsigned int d = 0; d < 3; ++d)
          centre[d] += corner(mesh, c)[d] / 4.;
      Expect::near(distance(centre, centres[side]), 0, 1e-14,
                   "centre of a face of the hexahedron");
    }
    Expect::near(double(mesh.facets.size()), 6, 0, "faces of the hexahedron");
  }

  /** Print the error of each file, `DIMENSION:FILE`, in one line. */
  template <int dim> void print_error(const std::string &file)
  {
    std::cout << file << ": ";
    try
    {
      dealii::Triangulation<dim> made;
      read_mesh_file(file, "File", "", made);
      std::cout << "no error";
    }
    catch (const InputError &error)
    {
      std::cout << error.what();
    }
    std::cout << std::endl;
  }

  /** For the table in tests/app/check_mesh_files.py. */
  void print_errors(const int n_files, char **words)
  {
    for (int i = 0; i < n_files; ++i)
    {
      const std::string word = words[i], file = word.substr(2);
      if (word[0] == '2')
        print_error<2>(file);
      else
        print_error<3>(file);
    }
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(argc, argv,
                    [argc, argv](const std::filesystem::path &own)
                    {
                      if (argc > 2)
                      {
                        print_errors(argc - 2, argv + 2);
                        return;
                      }
                      folder = own;
                      files = ABUT_MESH_FILES;
                      squares();
                      groups();
                      boxes();
                      curved();
                      for (const std::string name :
                           {"quads-2.2", "quads-4.1", "quads-4.0", "all-2.2"})
                        same_as_dealii<2>(files / (name + ".msh"));
                      for (const std::string name : {"hexes-2.2", "hexes-4.1"})
                        same_as_dealii<3>(files / (name + ".msh"));
                      same_as_dealii<2>(reversed("quads-2.2", 4));
                      same_as_dealii<3>(reversed("hexes-2.2", 8));
                      simplices_in_dealii();
                      abaqus();
                      faces_of_hexahedra();
                    });
}
