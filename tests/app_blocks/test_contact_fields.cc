// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Stresses and contact fields in files, and meshes that follow contact.

#include "app/adapt/refine_mesh.h"
#include "app/physics/hooke.h"
#include "app/physics/stress_output.h"
#include "app/pictures/contact_line.h"
#include "app/pictures/contact_output.h"
#include "app/pictures/field_output.h"

#include "expect.h"
#include "problem.h"
#include "run_checks.h"

#include <abut/dealii/contact_refinement.h>
#include <abut/dealii/versions.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace abut;
using namespace abut::app;
using dealii::Point;

namespace
{
  std::filesystem::path folder;

  template <int dim> void scalar_dofs(dealii::DoFHandler<dim> &scalar)
  {
    scalar.distribute_dofs(dealii::FE_Q<dim>(1));
  }

  /** One material for all. */
  template <int dim>
  Materials<dim> hooke(const double e, const double nu,
                       const PlaneModel plane = PlaneModel::strain)
  {
    return {{0, std::make_shared<Hooke<dim>>(e, nu, plane)}};
  }

  /** A quadratic displacement has linear stresses, which nodal means of a
   * uniform mesh reproduce inside, and a linear one constant stresses. */
  void nodal_stresses()
  {
    const double e = 7;
    const double nu = 0.3;
    const Materials<2> materials = hooke<2>(e, nu, PlaneModel::stress);
    Problem<2> problem(2, 2);
    unit_cube(problem, 2);
    refine_corner(problem);
    dealii::DoFHandler<2> scalar(problem.mesh);
    scalar_dofs(scalar);
    const auto fields = [&](const std::string &u)
    {
      return nodal_stress(problem.mapping, problem.dof_handler,
                          problem.interpolate(u), materials, scalar);
    };
    // tension 3 along x and shear 1
    const auto constant =
        fields(std::to_string(3 / e) + "*x; " + std::to_string(2 * (1 + nu) / e)
               + "*x - " + std::to_string(3 * nu / e) + "*y");
    Expect::that(constant.size() == 5, "xx, yy, xy, zz, von Mises");
    const double expected[] = {3, 0, 1, 0, std::sqrt(12.)};
    for (unsigned int c = 0; c < 5; ++c)
      for (const auto dof : scalar.locally_owned_dofs())
        Expect::near(constant[c](dof), expected[c], 1e-5, "constant stress");
    // bending: sigma_xx = 2 x from u = (x^2/E, -2 nu x y/E)
    const auto linear = fields("x^2/7; -2*0.3/7*x*y");
    const auto places = abut::versions::support_points(problem.mapping, scalar);
    for (const auto dof : scalar.locally_owned_dofs())
      Expect::near(linear[0](dof), 2 * places.at(dof)[0], 1e-12,
                   "linear stress, the same from all sides");

    Problem<3> cube(1, 3);
    unit_cube(cube, 1);
    dealii::DoFHandler<3> nodes(cube.mesh);
    scalar_dofs(nodes);
    const auto space =
        nodal_stress(cube.mapping, cube.dof_handler,
                     cube.interpolate("0; 0; y"), hooke<3>(e, nu), nodes);
    Expect::that(space.size() == 7, "xx, yy, zz, xy, xz, yz, von Mises");
    for (const auto dof : nodes.locally_owned_dofs())
    {
      Expect::near(space[5](dof), e / (2 * (1 + nu)), 1e-13, "shear yz");
      Expect::near(space[4](dof), 0, 1e-13, "shear xz");
    }
  }

  std::string content(const std::filesystem::path &file)
  {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  /** Numbers of a field as the postprocessor computes them at two points. */
  template <int dim>
  std::vector<double>
  evaluated(const dealii::DataPostprocessorScalar<dim> &postprocessor,
            const std::vector<std::vector<double>> &values)
  {
    dealii::DataPostprocessorInputs::Vector<dim> inputs;
    dealii::Tensor<1, dim> up;
    up[dim - 1] = 1;
    for (const auto &value : values)
    {
      inputs.solution_values.emplace_back(value.begin(), value.end());
      inputs.normals.push_back(up);
    }
    std::vector<dealii::Vector<double>> results(values.size(),
                                                dealii::Vector<double>(1));
    postprocessor.evaluate_vector_field(inputs, results);
    std::vector<double> numbers;
    for (const auto &result : results)
      numbers.push_back(result[0]);
    return numbers;
  }

  template <int dim> void files()
  {
    const Materials<dim> materials = {
        {0, std::make_shared<Hooke<dim>>(7., 0.3)}};
    const SignedLength<dim> pressure("pressure", -1.);
    const FirstComponent<dim> status("status");
    const std::vector<std::vector<double>> vectors =
        dim == 2 ? std::vector<std::vector<double>>{{3, 4}, {3, -4}}
                 : std::vector<std::vector<double>>{{3, 0, 4}, {0, 3, -4}};
    Expect::that(evaluated(pressure, vectors) == std::vector<double>{-5, 5},
                 "traction out of the body is a negative pressure");
    Expect::that(evaluated(status, vectors)
                     == std::vector<double>{vectors[0][0], vectors[1][0]},
                 "first component");
    const std::vector<double> gaps =
        evaluated(GapOfRows<dim>("gap"), {{2, 1, 2}, {2, 0.5, 2}});
    Expect::that(gaps[0] == 2 && std::isnan(gaps[1]),
                 "no gap at a hanging node with one row");

    const std::string kind = std::to_string(dim);
    for (const unsigned int degree : {1U, 2U})
    {
      Problem<dim> problem(degree, dim);
      unit_cube(problem, 1);
      const la::Vector u = problem.interpolate(dim == 2 ? "x; y" : "x; y; x*z");
      Fields<dim> fields{
          problem.mapping, problem.dof_handler, {{"displacement", &u}}, {}};
      const CellMaterials<dim> at(problem.mapping, problem.dof_handler, u,
                                  materials);
      const StressPostprocessor<dim> stresses(at);
      fields.derived = {{&u, &stresses}};
      const std::string name = "bodies-" + kind + "-" + std::to_string(degree);
      FieldSeries(folder, name, MPI_COMM_WORLD).write(0., fields);
      Fields<dim> sides{
          problem.mapping, problem.dof_handler, {{"displacement", &u}}, {}};
      sides.derived = {{&u, &pressure}, {&u, &status}};
      sides.faces = {1};
      FieldSeries(folder, name + "-faces", MPI_COMM_WORLD).write(0., sides);
      MPI_Barrier(MPI_COMM_WORLD);
      const std::string volume = content(folder / (name + "_0000.pvtu"));
      for (const char *field :
           {"\"displacement\"", "\"stress\"", "\"von_mises_stress\""})
        Expect::that(volume.find(field) != std::string::npos,
                     std::string("field ") + field);
      Expect::that((volume.find("\"stress_out_of_plane\"") != std::string::npos)
                       == (dim == 2),
                   "out-of-plane stress in two dimensions");
      const std::string surface = content(folder / (name + "-faces_0000.pvtu"));
      for (const char *field : {"\"pressure\"", "\"status\""})
        Expect::that(surface.find(field) != std::string::npos,
                     std::string("field ") + field);
      // one side of the cube: 2^(dim-1) faces, lines in as many pieces as the
      // degree says
      const std::string cells = content(folder / (name + "-faces_0000.0.vtu"));
      Expect::that(cells.find("NumberOfCells=\""
                              + std::to_string(dim == 2 ? 2 * degree : 4)
                              + "\"")
                       != std::string::npos,
                   "number of faces");
    }
  }

  /** Largest and smallest x of flagged cells, and their number, on all ranks.
   */
  struct Flags
  {
    unsigned int n = 0;
    double from = 1e9, to = -1e9;
  };

  Flags flags(const Problem<2> &problem)
  {
    Flags result;
    for (const auto &cell : problem.mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->refine_flag_set())
      {
        ++result.n;
        result.from = std::min(result.from, cell->center()[0]);
        result.to = std::max(result.to, cell->center()[0]);
      }
    result.n = dealii::Utilities::MPI::sum(result.n, MPI_COMM_WORLD);
    result.from = dealii::Utilities::MPI::min(result.from, MPI_COMM_WORLD);
    result.to = dealii::Utilities::MPI::max(result.to, MPI_COMM_WORLD);
    return result;
  }

  /** Contact for x < 0.3 on y = 0; no rows beyond 0.8. */
  void border()
  {
    Problem<2> problem(1, 2);
    unit_cube(problem, 3);
    const la::Vector status =
        problem.interpolate("if(x > 0.8, -1, if(x < 0.3, 1, 0)); 7");
    flag_contact_border(problem.dof_handler, status, {2});
    Flags found = flags(problem);
    Expect::that(found.n == 1, "one cell at the border of contact");
    Expect::near(found.from, 0.3125, 1e-12, "its centre");
    for (const auto &cell : problem.mesh.active_cell_iterators())
    {
      cell->clear_refine_flag();
      if (cell->is_locally_owned())
        cell->set_coarsen_flag();
    }
    const unsigned int n = dealii::Utilities::MPI::sum(
        flag_contact_border(problem.dof_handler, status, {2}), MPI_COMM_WORLD);
    Expect::that(n == 1, "number of new flags");
    Expect::that(flags(problem).n == 1, "coarsening gives way");
    flag_contact_border(problem.dof_handler, status, {1});
    Expect::that(flags(problem).n == 1, "other sides do not count");
    for (const auto &cell : problem.mesh.active_cell_iterators())
      cell->clear_refine_flag();
    flag_contact_border(
        problem.dof_handler,
        problem.interpolate("if(x > 0.8, -1, if(x < 0.3, 2, 1)); 7"), {2});
    found = flags(problem);
    Expect::that(found.n == 1, "one cell between stick and slip");
    Expect::near(found.from, 0.3125, 1e-12, "the centre of that cell");
  }

  /** Two bodies of 1 and of @p n cells along their common line y = 0. */
  void two_bodies(Problem<2> &problem, const unsigned int n)
  {
    dealii::Triangulation<2> below, above, both;
    dealii::GridGenerator::subdivided_hyper_rectangle(
        below, {1, 1}, Point<2>(0, -1), Point<2>(1, 0));
    dealii::GridGenerator::subdivided_hyper_rectangle(
        above, {n, 1}, Point<2>(0, 0.001), Point<2>(1, 1));
    dealii::GridGenerator::merge_triangulations(below, above, both);
    problem.mesh.copy_triangulation(both);
    // bottom 2, line 3 and 12, top 13
    for (const auto &cell : problem.mesh.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
      {
        const double y = cell->face(f)->center()[1];
        if (cell->face(f)->at_boundary())
          cell->face(f)->set_boundary_id(y < -0.9             ? 2
                                         : std::abs(y) < 1e-9 ? 3
                                         : y < 0.01           ? 12
                                         : y > 0.9            ? 13
                                                              : 0);
      }
    problem.distribute();
  }

  void size_ratio()
  {
    const std::vector<ContactSides> pairs = {{{12}, {3}}};
    for (const bool swapped : {false, true})
    {
      const std::vector<ContactSides> sides =
          swapped ? std::vector<ContactSides>{{{3}, {12}}} : pairs;
      Problem<2> four(1, 2);
      two_bodies(four, 4);
      Expect::that(limit_size_ratio(four.mesh, sides) == 0, "1 : 4 may be");
      Problem<2> five(1, 2);
      two_bodies(five, 5);
      Expect::that(limit_size_ratio(five.mesh, sides) == 1, "1 : 5 may not");
      Expect::that(flags(five).n == 1, "one cell flagged");
      Problem<2> next(1, 2);
      two_bodies(next, 4);
      for (const auto &cell : next.mesh.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center()[1] > 0
            && cell->center()[0] < 0.25)
          cell->set_refine_flag();
      Expect::that(limit_size_ratio(next.mesh, sides) == 1,
                   "sizes are those after refinement");
      Expect::that(flags(next).n == 2, "both sides are flagged");
    }
    Problem<2> apart(1, 2);
    two_bodies(apart, 5);
    Expect::that(limit_size_ratio(apart.mesh, {{{13}, {2}}}) == 0,
                 "faces far apart do not count");
  }

  /** A linear field is the same function on the new mesh. */
  template <int dim> void transfer()
  {
    Problem<dim> problem(1, dim);
    unit_cube(problem, 2);
    const std::string text = dim == 2 ? "x; 3*y" : "x; 3*y; x - z";
    for (const auto &cell : problem.mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[0] < 0.5)
        cell->set_refine_flag();
    SectionTimes times;
    const std::vector<la::Vector> fields = refine_mesh<dim>(
        problem.mesh, problem.dof_handler,
        {problem.interpolate(text),
         problem.interpolate(dim == 2 ? "1; y" : "1; y; 0")},
        [&] { problem.distribute(); }, times);
    Expect::that(times.sections().size() == 2, "sections");
    Expect::that(fields.size() == 2, "two fields");
    const la::Vector u = problem.interpolate(text);
    const la::Vector second =
        problem.interpolate(dim == 2 ? "1; y" : "1; y; 0");
    for (const auto dof : problem.owned)
    {
      Expect::near(fields[0](dof), u(dof), 1e-14, "first field");
      Expect::near(fields[1](dof), second(dof), 1e-14, "second field");
    }
  }

  /** The lower side and the right one of a square as one line, p = 1 + x and
   * 3, with hanging nodes inside and nodes of degree @p degree. */
  void lines(const unsigned int degree)
  {
    Problem<2> problem(degree, 2);
    unit_cube(problem, 1);
    refine_corner(problem);
    const la::Vector traction =
        problem.interpolate("if(x > 1 - 1e-9, -3, 0); if(y < 1e-9, 1 + x, 0)");
    const la::Vector gap = problem.interpolate("x; if(x < 0.6, 1, 0)");
    const la::Vector status = problem.interpolate("x; x");
    const std::vector<ContactLine> both =
        contact_lines(problem.mapping, problem.dof_handler, {1, 2},
                      {traction, nullptr, nullptr});
    const std::vector<ContactLine> two =
        contact_lines(problem.mapping, problem.dof_handler, {0, 1},
                      {traction, &gap, &status});
    const std::vector<ContactLine> below = contact_lines(
        problem.mapping, problem.dof_handler, {2}, {traction, &gap, &status});
    const std::vector<ContactLine> all =
        contact_lines(problem.mapping, problem.dof_handler, {0, 1, 2, 3},
                      {traction, nullptr, nullptr});
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
    {
      Expect::that(both.empty() && all.empty(), "result on rank 0");
      return;
    }
    Expect::that(both.size() == 1 && two.size() == 2 && below.size() == 1
                     && all.size() == 1,
                 "number of lines");
    Expect::near(both[0].back().arc, 2, 1e-14, "length around a corner");
    Expect::near(both[0].back().place.distance(Point<2>(1, 1)), 0, 1e-14,
                 "begins at the smaller x");
    Expect::near(all[0].back().arc, 4, 1e-14, "closed line");
    Expect::near(all[0].back().place.distance(all[0].front().place), 0, 1e-14,
                 "ends where it begins");
    // 2 fine faces and 1 coarse one
    Expect::that(below[0].size() == 3 * degree + 1, "nodes");
    for (const ContactLineNode &node : below[0])
      if (node.place[0] < 1 - 1e-9)
      {
        Expect::near(node.arc, node.place[0], 1e-14, "arc");
        Expect::near(node.pressure, 1 + node.place[0], 1e-14, "pressure");
        if (node.place[0] < 0.6)
          Expect::near(node.gap, node.place[0], 1e-14, "gap");
        else
          Expect::that(std::isnan(node.gap), "no gap without a row");
        Expect::near(node.status, node.place[0], 1e-14, "status");
      }
    write_contact_lines(folder / "line.csv", two);
    std::istringstream table(content(folder / "line.csv"));
    std::string row;
    std::getline(table, row);
    Expect::that(row == "line,arc,x,y,pressure,gap,status,friction,slip",
                 "columns");
    unsigned int rows = 0;
    while (std::getline(table, row))
      ++rows;
    Expect::that(rows == two[0].size() + two[1].size(), "rows");
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(argc, argv,
                    [](const std::filesystem::path &given)
                    {
                      folder = given;
                      nodal_stresses();
                      files<2>();
                      files<3>();
                      border();
                      size_ratio();
                      transfer<2>();
                      transfer<3>();
                      lines(1);
                      lines(2);
                    });
}
