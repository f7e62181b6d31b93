// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Expressions, boundary lists, height maps, meshes, the memory check.

#include "app/input/boundary_expressions.h"
#include "app/input/expression.h"
#include "app/input/height_map.h"
#include "app/mesh/memory_check.h"
#include "app/mesh/mesh.h"

#include "expect.h"
#include "run_checks.h"

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_out.h>
#include <deal.II/grid/grid_tools.h>

#include <filesystem>
#include <fstream>

using namespace abut::app;
using dealii::Point;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  std::filesystem::path folder;

  void expressions()
  {
    Expression<2> f("x^2 + sin(pi*y) + t", "Obstacle/Height");
    f.set_time(2);
    Expect::near(f.value({3, 0.5}), 12, 1e-14, "x^2 + sin(pi y) + t");
    Expect::that(!f.is_constant() && f.depends_on_time(), "varies in time");
    const auto gradient = f.gradient({3, 0.25});
    Expect::near(gradient[0], 6, 1e-9, "d/dx");
    Expect::near(gradient[1], pi * std::sqrt(0.5), 1e-8, "d/dy");

    const Expression<3> g("if(z > 0, x, -x); 2*exp(0)*pi; 1.5e-3", "A", 3);
    Expect::near(g.value({2, 0, 1}, 0), 2, 0, "if then");
    Expect::near(g.value({2, 0, -1}, 0), -2, 0, "if else");
    Expect::that(!g.is_constant(0) && g.is_constant(1) && g.is_constant(2)
                     && !g.depends_on_time(),
                 "constants are seen component by component");
    std::vector<double> values(2);
    g.value_list({Point<3>(1, 1, 1), Point<3>(2, 2, 2)}, values, 1);
    Expect::near(values[1], 2 * pi, 1e-15, "constant list");
    // x in the name of a function or the e of a number are no variables
    Expect::that(Expression<2>("max(1, 2) + 2e3", "A").is_constant(),
                 "max(1, 2) is constant");
    Expect::that(Expression<2>("exp(1)", "A").is_constant(), "exp(1)");
    Expect::that(!Expression<2>("2e-3*x", "A").is_constant(), "2e-3*x");
    Expect::that(!Expression<2>("rand()", "A").is_constant(), "rand()");

    Expect::input_error([]() { Expression<2>("x + foo(2)", "Load/Force"); },
                        "Load/Force", {"x + foo(2)", "foo", "position 4"});
    Expect::input_error([]() { Expression<2>("x + z", "P"); }, "P",
                        {"'x + z'", "z", "x, y, t"});
    Expect::input_error([]() { Expression<2>("2 * (x", "P"); }, "P",
                        {"arenthesis"});
    Expect::input_error([]() { Expression<2>("", "P"); }, "P", {"a formula"});
    Expect::input_error([]() { Expression<2>("1; 2", "P", 3); }, "P",
                        {"3 formulas"});
    Expect::input_error(
        []()
        {
          Expression<2>("1/x", "Load/Force")
              .evaluate({Point<2>(1, 0), Point<2>(0, 0.5)});
        },
        "Load/Force", {"(0, 0.5)", "infinite"});
    Expect::input_error(
        []() { Expression<2>("sqrt(-1)", "L").evaluate({Point<2>(1, 0)}); },
        "L", {"not a number"});
  }

  void boundary_lists()
  {
    dealii::Triangulation<2> mesh;
    dealii::GridGenerator::hyper_cube(mesh, 0, 1, true);
    const auto ids = mesh.get_boundary_ids();
    const BoundaryExpressions<2> values("1, 3: x^2; *: if(y>0, 1, 2)", "BC");
    const auto map = values.functions(ids);
    Expect::near(double(map.size()), 4, 0, "number of ids");
    Expect::near(map.at(3)->value({3, 1}), 9, 0, "value on 3");
    Expect::near(map.at(0)->value({3, -1}), 2, 0, "value on 0");
    Expect::near(double(values.functions(ids, {0}).size()), 3, 0,
                 "number of ids without 0");
    const BoundaryExpressions<2> vectors("0: x, y; 1: 0, 5", "BC", 2);
    Expect::near(vectors.functions(ids).at(1)->value({0, 0}, 1), 5, 0,
                 "second component on 1");
    const BoundaryExpressions<2> supports("0: max(x, y), free; *: 0, 0", "BC",
                                          2, true);
    const auto conditions =
        supports.conditions(std::vector<dealii::types::boundary_id>{0, 1});
    Expect::that(conditions.at(0).components[0]
                     && !conditions.at(0).components[1]
                     && conditions.at(1).components[1],
                 "components that are free");
    Expect::near(conditions.at(0).function->value({3, 7}), 7, 0,
                 "commas within parentheses");
    Expect::input_error([]() { BoundaryExpressions<2>("0: 1", "BC", 2); }, "BC",
                        {"2 formulas separated by commas"});
    Expect::input_error([]() { BoundaryExpressions<2>("0: 1, free", "BC", 2); },
                        "BC", {"free"});
    Expect::that(BoundaryExpressions<2>(" ", "BC").empty(), "empty list");
    Expect::that(parse_boundary_ids("0, 2", "B", ids).size() == 2
                     && parse_boundary_ids("*", "B", ids).size() == 4
                     && parse_boundary_ids("", "B", ids).empty(),
                 "lists of ids");

    Expect::input_error(
        [&]() { BoundaryExpressions<2>("7: 0", "BC").functions(ids); }, "BC",
        {"no boundary id 7", "0, 1, 2, 3"});
    Expect::input_error([]() { BoundaryExpressions<2>("x", "BC"); }, "BC",
                        {"id: formula"});
    Expect::input_error(
        [&]() { BoundaryExpressions<2>("a: 1", "BC").functions(ids); }, "BC",
        {"'a' is not a boundary id"});
    Expect::input_error([]() { BoundaryExpressions<2>("-1: 1", "BC"); }, "BC",
                        {"'-1' is not a boundary id"});
    // Names of sets, one of two ids.
    const BoundaryNames names(
        {0, 1, 2, 3}, {{"Top", 3, {3, 2}}, {"left", 5, {0}}, {"gone", 7, {9}}},
        {{"bar", "is a node set"}});
    const BoundaryExpressions<2> worded("top: 1; left: 2; *: 3", "BC");
    const auto by_name = worded.conditions(names);
    Expect::near(by_name.at(2).function->value({0, 0}), 1, 0, "value on top");
    Expect::near(by_name.at(0).function->value({0, 0}), 2, 0, "value left");
    Expect::near(by_name.at(1).function->value({0, 0}), 3, 0, "value of *");
    using Ids = std::set<dealii::types::boundary_id>;
    Expect::that(parse_boundary_ids("3, 5", "B", names) == Ids{0, 2, 3}
                     && parse_boundary_ids("2", "B", names) == Ids{2},
                 "numbers of sets and of ids");
    Expect::that(names.names_of(2) == "'Top'" && names.names_of(1).empty(),
                 "names of ids");
    Expect::input_error(
        [&]()
        { BoundaryExpressions<2>("Top: 1; 2: 0", "BC").conditions(names); },
        "BC", {"'Top' and '2'", "id 2"});
    Expect::input_error([&]() { names.find("tap", "B"); }, "B",
                        {"no boundary 'tap'", "Names: Top, left", "'Top'"});
    Expect::input_error([&]() { names.find("bar", "B"); }, "B",
                        {"is a node set", "has 0, 1, 2, 3"});
    Expect::input_error([&]() { names.find("gone", "B"); }, "B",
                        {"no facet is left"});
    Expect::input_error([]() { BoundaryExpressions<2>("0: 1; 0: 2", "BC"); },
                        "BC", {"twice"});
    Expect::input_error([]() { BoundaryExpressions<2>("0: sin(", "BC"); }, "BC",
                        {"sin("});
    Expect::input_error([&]() { parse_boundary_ids("9", "B", ids); }, "B",
                        {"no boundary id 9"});
  }

  std::filesystem::path write_file(const std::string &name,
                                   const std::string &content)
  {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
  }

  void height_maps()
  {
    HeightMapParameters parameters;
    parameters.parameter = "Obstacle/Height map";
    parameters.lower = {-1, 0};
    parameters.upper = {1, 1};
    parameters.lowest = 10;
    parameters.highest = 20;
    // rows from the top: y = 1 has 0 5 10, y = 0 has 10 0 10
    const auto text =
        write_file("a.pgm", "P2 # three by two\n3 2\n10\n0 5 10\n10 0 10\n");
    const HeightMap<2> map(parameters, text);
    Expect::near(map.value({-1, 1}), 10, 1e-14, "upper left");
    Expect::near(map.value({0, 1}), 15, 1e-14, "upper middle");
    Expect::near(map.value({1, 0}), 20, 1e-14, "lower right");
    Expect::near(map.value({0.5, 0.5}), 16.25, 1e-13, "middle of four");
    Expect::near(map.value({9, -7}), 20, 1e-14, "outside");
    const HeightMap<3> map3(parameters, text);
    Expect::near(map3.value({0.5, 0.5, 8}), 16.25, 1e-13, "in 3D");

    using std::string;
    const HeightMap<2> bytes(
        parameters,
        write_file("b.pgm", string("P5\n2 1\n255\n") + '\0' + '\xff'));
    Expect::near(bytes.value({0.5, 0}), 17.5, 1e-13, "8 bits");
    const HeightMap<2> words(
        parameters, write_file("c.pgm", string("P5\n1 2\n65535\n") + "\x80"
                                            + '\0' + string(2, '\0')));
    Expect::near(words.value({0, 1}), 10 + 10 * 32768. / 65535, 1e-13,
                 "16 bits");
    const auto fails = [](const std::filesystem::path &file,
                          const std::vector<std::string> &expected)
    { Expect::input_error([&]() { read_pgm(file, "M"); }, "M", expected); };
    fails(folder / "none.pgm", {"none.pgm", "cannot be opened"});
    fails(folder, {"cannot be opened"});
    fails(write_file("d.pgm", "P6\n1 1\n255\nabc"), {"not a PGM"});
    fails(write_file("e.pgm", "P5\n4 4\n255\nabc"), {"3 of 16 bytes"});
    fails(write_file("f.pgm", "P2\n2 2\n255\n1 2 3"), {"ends before"});
    fails(write_file("g.pgm", "P2\n2 x\n255\n1 2 3"), {"height"});
    fails(write_file("h.pgm", "P2\n1 1\n255\n256"), {"above 255"});
  }

  MeshParameters mesh_parameters(const std::string &generator,
                                 const std::string &arguments)
  {
    MeshParameters parameters;
    parameters.generator = generator;
    parameters.arguments = arguments;
    parameters.section = "Mesh";
    return parameters;
  }

  template <int dim>
  using Mesh = dealii::parallel::distributed::Triangulation<dim>;

  RunOptions run_options()
  {
    RunOptions options;
    options.communicator = MPI_COMM_WORLD;
    options.scene_file = folder / "scene.prm";
    return options;
  }

  void placed_meshes()
  {
    MeshParameters parameters = mesh_parameters("subdivided_hyper_rectangle",
                                                "2, 1 : 0, 0 : 2, 1 : true");
    parameters.scale = {3};
    parameters.rotate = {90};
    parameters.move = {1, 2};
    Mesh<2> mesh(MPI_COMM_WORLD);
    create_mesh(parameters, run_options(), mesh);
    Expect::near(double(mesh.n_global_active_cells()), 2, 0, "cells");
    Expect::near(dealii::GridTools::volume(mesh), 18, 1e-12, "area");
    // (x, y) -> (1 - 3 y, 2 + 3 x); id 1 was the side x = 2
    for (const auto &face : mesh.active_face_iterators())
      if (face->at_boundary() && face->boundary_id() == 1)
        Expect::near(face->center().distance({-0.5, 8}), 0, 1e-13, "side 1");
  }

  /** Largest distance of boundary vertices of own cells from the ellipsoid
   * with the given centre and half axes (as | |scaled x| - 1 |). */
  template <int dim>
  double largest_distance(const Mesh<dim> &mesh, const Point<dim> &center,
                          const Point<dim> &axes)
  {
    double largest = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            for (const unsigned int v : face->vertex_indices())
            {
              double square = 0;
              for (unsigned int d = 0; d < dim; ++d)
                square +=
                    std::pow((face->vertex(v)[d] - center[d]) / axes[d], 2);
              largest = std::max(largest, std::abs(std::sqrt(square) - 1));
            }
    return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }

  void curved_meshes()
  {
    MeshParameters parameters =
        mesh_parameters("hyper_ball", "0, 0 : 1 : false");
    parameters.scale = {2, 3};
    parameters.move = {5, -1};
    Mesh<2> ellipse(MPI_COMM_WORLD);
    create_mesh(parameters, run_options(), ellipse);
    ellipse.refine_global(3);
    Expect::near(largest_distance(ellipse, {5, -1}, {2, 3}), 0, 1e-13,
                 "distance from the ellipse");
    // the chord error of the area is of fourth order with quadratic sides
    Expect::near(dealii::GridTools::volume(ellipse, dealii::MappingQ<2>(3)),
                 6 * pi, 1e-5, "area of the ellipse");

    // a transfinite manifold inside, which refers to its mesh
    MeshParameters balanced =
        mesh_parameters("hyper_ball_balanced", "0, 0, 0 : 1");
    balanced.move = {0, 0, 4};
    balanced.rotate = {10, 20, 30};
    Mesh<3> ball(MPI_COMM_WORLD);
    create_mesh(balanced, run_options(), ball);
    ball.refine_global(2);
    Expect::near(largest_distance(ball, {0, 0, 4}, {1, 1, 1}), 0, 1e-13,
                 "distance from the sphere");
    Expect::near(dealii::GridTools::volume(ball, dealii::MappingQ<3>(3)),
                 4 * pi / 3, 1e-3, "volume of the ball");

    // a cube whose sides are named as parts of the sphere through its corners
    MeshParameters named = mesh_parameters("hyper_cube", "-1 : 1 : false");
    named.move = {0, 2, 0};
    named.curved_sides = "0: sphere: 0, 2, 0";
    Mesh<3> blown(MPI_COMM_WORLD);
    create_mesh(named, run_options(), blown);
    blown.refine_global(1);
    for (const auto &cell : blown.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[0] > 0)
        cell->set_refine_flag();
    blown.execute_coarsening_and_refinement();
    const double radius = std::sqrt(3.);
    Expect::near(largest_distance(blown, {0, 2, 0}, {radius, radius, radius}),
                 0, 1e-13, "distance from the sphere that was named");
  }

  void mesh_files()
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      dealii::Triangulation<2> mesh;
      dealii::GridGenerator::hyper_rectangle(mesh, {0, 0}, {2, 1}, true);
      mesh.refine_global(1);
      dealii::GridOut out;
      dealii::GridOutFlags::Msh flags(true);
      out.set_flags(flags);
      std::ofstream msh(folder / "good.msh");
      out.write_msh(mesh, msh);
      out.set_flags(dealii::GridOutFlags::Ucd(false, true));
      std::ofstream ucd(folder / "good.inp");
      out.write_ucd(mesh, ucd);
      std::ofstream vtk(folder / "good.vtk");
      out.write_vtk(mesh, vtk);
      std::ofstream(folder / "triangle.msh")
          << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n"
             "1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n"
             "1 2 2 0 0 1 2 3\n$EndElements\n";
      std::ofstream(folder / "broken.msh") << "$MeshFormat\n2.2";
      std::ofstream(folder / "empty.inp");
      std::ofstream(folder / "mesh.xyz") << "?";
    }
    MPI_Barrier(MPI_COMM_WORLD);

    MeshParameters parameters = mesh_parameters("hyper_cube", "");
    for (const char *name : {"good.msh", "good.inp", "good.vtk"})
    {
      parameters.file = name;
      Mesh<2> mesh(MPI_COMM_WORLD);
      create_mesh(parameters, run_options(), mesh);
      Expect::near(double(mesh.n_global_active_cells()), 4, 0,
                   std::string("cells of ") + name);
      Expect::near(dealii::GridTools::volume(mesh), 2, 1e-12,
                   std::string("area of ") + name);
      Expect::that(mesh.get_boundary_ids().size() == 4,
                   std::string("boundary ids of ") + name);
    }
    const auto fails =
        [&parameters](const char *name, const std::vector<std::string> &words)
    {
      parameters.file = name;
      Expect::input_error(
          [&]()
          {
            Mesh<2> mesh(MPI_COMM_WORLD);
            create_mesh(parameters, run_options(), mesh);
          },
          "Mesh/File", words);
    };
    fails("none.msh", {"none.msh", "cannot be opened"});
    fails("mesh.xyz", {"mesh.xyz", "unknown ending", "msh"});
    fails("triangle.msh", {"triangles"});
    fails("broken.msh", {"broken.msh", "2 dimensions"});
    fails("empty.inp", {"empty.inp"});
    for (const char *name : {"good.msh", "good.inp", "good.vtk"})
    {
      parameters.file = name;
      Expect::input_error(
          [&]()
          {
            Mesh<3> mesh(MPI_COMM_WORLD);
            create_mesh(parameters, run_options(), mesh);
          },
          "Mesh/File", {name, "3 dimensions"});
    }
  }

  template <int dim>
  void mesh_fails(const MeshParameters &parameters,
                  const std::string &parameter,
                  const std::vector<std::string> &words)
  {
    Expect::input_error(
        [&]()
        {
          Mesh<dim> mesh(MPI_COMM_WORLD);
          create_mesh(parameters, run_options(), mesh);
        },
        parameter, words);
  }

  void wrong_meshes()
  {
    mesh_fails<2>(mesh_parameters("hyper_cub", "0 : 1 : false"),
                  "Mesh/Generator", {"'hyper_cub'", "hyper_cube"});
    mesh_fails<2>(mesh_parameters("torus", "2 : 1 : 6 : 0"), "Mesh/Generator",
                  {"torus", "2 dimensions"});
    mesh_fails<2>(mesh_parameters("hyper_cube", "0 : 1"), "Mesh/Arguments",
                  {"'0 : 1'", "hyper_cube"});
    mesh_fails<2>(mesh_parameters("hyper_cube", "a : 1 : false"),
                  "Mesh/Arguments", {"'a : 1 : false'"});
    mesh_fails<2>(
        mesh_parameters("general_cell", "0, 0; 0, 1; 1, 0; 1, 1 : false"),
        "Mesh/Arguments", {});
    mesh_fails<2>(mesh_parameters("hyper_ball", "0, 0, 0 : 1 : false"),
                  "Mesh/Arguments", {"hyper_ball"});
    MeshParameters parameters = mesh_parameters("hyper_cube", "0 : 1 : false");
    parameters.move = {1};
    mesh_fails<2>(parameters, "Mesh/Move", {"2 numbers"});
    parameters.move = {};
    parameters.rotate = {1, 2};
    mesh_fails<3>(parameters, "Mesh/Rotate", {"three angles"});
    parameters.rotate = {};
    parameters.boundary_ids = "1: y > 2";
    mesh_fails<2>(parameters, "Mesh/Boundary ids", {"y > 2"});
    parameters.boundary_ids = "left: y > 2";
    mesh_fails<2>(parameters, "Mesh/Boundary ids", {});

    parameters.boundary_ids = "4: y > 0.9; 5: abs(x) < 1e-6";
    Mesh<2> mesh(MPI_COMM_WORLD);
    create_mesh(parameters, run_options(), mesh);
    Expect::that(mesh.get_boundary_ids()
                     == std::vector<dealii::types::boundary_id>({0, 4, 5}),
                 "ids by condition");
  }

  void memory()
  {
    Expect::near(estimated_bytes(2, 2e6, 1) / estimated_bytes(2, 1e6, 1), 2,
                 1e-12, "memory is linear in cells");
    // measured peak memory of runs, bytes per unknown
    const double measured[2][2] = {{1155, 1070}, {2100, 2360}};
    for (const unsigned int dim : {2U, 3U})
      for (const unsigned int degree : {1U, 2U})
        Expect::near(estimated_bytes(dim, 1, degree) / std::pow(degree, dim)
                         / measured[dim - 2][degree - 1],
                     1, 0.2, "memory per unknown");
    check_memory(2, 1e4, 1, MPI_COMM_WORLD, "P");
    Expect::input_error([]()
                        { check_memory(3, 8e8, 1, MPI_COMM_WORLD, "R/L"); },
                        "R/L", {"8e+08 cells", "GiB", "available"});
    Expect::input_error([]()
                        { check_memory(2, 1e10, 2, MPI_COMM_WORLD, "R/L"); },
                        "R/L", {"4e+10 unknowns", "2^31"});
    Expect::that(available_bytes(MPI_COMM_WORLD) > 1e6, "memory is there");
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(
      argc, argv,
      [](const std::filesystem::path &shared)
      {
        // each rank has files of its own where it writes them itself
        folder = shared;
        expressions();
        boundary_lists();
        folder = shared
                 / std::to_string(
                     dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
        std::filesystem::create_directories(folder);
        height_maps();
        folder = shared;
        placed_meshes();
        curved_meshes();
        mesh_files();
        wrong_meshes();
        memory();
      });
}
