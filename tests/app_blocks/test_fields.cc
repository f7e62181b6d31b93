// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Estimator, error norms, energy, rasters, field files and pictures.

#include "app/adapt/estimator.h"
#include "app/input/expression.h"
#include "app/physics/error_norms.h"
#include "app/pictures/field_output.h"
#include "app/pictures/picture_parts.h"
#include "app/pictures/pictures.h"
#include "app/pictures/raster.h"
#include "app/pictures/zero_line.h"
#include "app/report/report.h"

#include "expect.h"
#include "problem.h"
#include "run_checks.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/numerics/vector_tools.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace abut;
using namespace abut::app;
using dealii::Point;

namespace
{
  std::filesystem::path folder;

  /** Errors of the nodal interpolant of x^2, exactly: on a cell of side h the
   * error is (x-a)(x-b), its square integrates to h^5/30 and that of its
   * derivative to h^3/3. */
  void norms()
  {
    Problem<2> problem(1);
    unit_cube(problem, 3);
    const la::Vector u = problem.interpolate("x^2");
    const double h = 1. / 8;
    for (const char *gradient : {"2*x; 0", ""})
    {
      const ErrorNorms errors = error_norms(
          problem.mapping, problem.dof_handler, u,
          ExactSolution<2>("x^2", "Exact/Solution", gradient, "Exact/G"));
      Expect::near(errors.l2, h * h / std::sqrt(30.), 1e-14, "L2 error");
      Expect::near(errors.h1_seminorm, h / std::sqrt(3.), 1e-9, "H1 error");
      Expect::near(errors.largest_node, 0, 1e-15, "nodal error");
    }
    const ErrorNorms shifted = error_norms(
        problem.mapping, problem.dof_handler, problem.interpolate("x^2+y"),
        ExactSolution<2>("x^2", "Exact/Solution", "2*x; 0", "Exact/G"));
    Expect::near(shifted.largest_node, 1, 1e-15, "shifted nodal error");
  }

  /** u = x, k = 3, f = 2, flux 5 on x = 1: 3/2 - 2/2 - 5. */
  template <int dim> void energy()
  {
    Problem<dim> problem(1);
    unit_cube(problem, 2);
    refine_corner(problem);
    const Expression<dim> k("3", "k");
    const Expression<dim> f("2", "f");
    const Expression<dim> flux("5", "t");
    Expect::near(membrane_energy(problem.mapping, problem.dof_handler,
                                 problem.interpolate("x"), f, &k, {{1, &flux}}),
                 -4.5, 1e-13, "energy");
  }

  /** The estimate, and that the cells' parts sum up to it. */
  template <int dim> double estimate(const EstimatorInput<dim> &input)
  {
    dealii::Vector<float> squared;
    return expect_sum(input.dof_handler, squared,
                      estimate_error(input, squared));
  }

  /** Functions that the elements represent have no residual at all. */
  template <int dim> void estimator_is_consistent()
  {
    for (const unsigned int degree : {1U, 2U})
    {
      Problem<dim> problem(degree);
      unit_cube(problem, 2);
      refine_corner(problem);
      const bool quadratic = degree == 2;
      const la::Vector u = problem.interpolate(quadratic ? "x^2" : "x");
      const Expression<dim> k("1 + x", "k");
      const Expression<dim> f(quadratic ? "-2 - 4*x" : "-1", "f");
      const Expression<dim> flux(quadratic ? "4" : "2", "t");
      EstimatorInput<dim> input{problem.mapping, problem.dof_handler, u, f};
      input.coefficient = &k;
      input.neumann = {{1, &flux}};
      input.dirichlet = {0};
      // the derivative of the formula k is a difference: 1e-10
      Expect::near(estimate(input), 0, 1e-8, "estimate of an exact solution");
      input.dirichlet = {};
      input.neumann = {{1, &flux}};
      const double missing = quadratic ? 0. : -1.;
      Expect::near(estimate(input) > 1e-3 ? 1 : 0, missing == 0 ? 0 : 1, 0,
                   "flux at x = 0 is seen");
    }
  }

  /** Each term alone, in closed form. */
  void estimator_terms()
  {
    Problem<2> problem(1);
    unit_cube(problem, 3);
    const double h = 1. / 8;
    const Expression<2> zero("0", "f");
    const Expression<2> three("3", "f");
    const Expression<2> k("2", "k");
    const la::Vector parabola = problem.interpolate("x^2");
    const la::Vector line = problem.interpolate("x");

    // jumps 2h of the slope over (n-1) n faces: 1/2 (h + h) (2h)^2 h each
    EstimatorInput<2> jumps{problem.mapping, problem.dof_handler, parabola,
                            zero};
    jumps.dirichlet = all_sides<2>();
    Expect::near(estimate(jumps), 2 * h * std::sqrt(1 - h), 1e-13, "jumps");
    jumps.coefficient = &k;
    Expect::near(estimate(jumps), 2 * h * std::sqrt(2 * (1 - h)), 1e-13,
                 "jumps times k");

    // f alone: h^2/k 9 on all cells but the held ones, x < 1/2
    EstimatorInput<2> cells{problem.mapping, problem.dof_handler, line, three};
    cells.dirichlet = all_sides<2>();
    cells.coefficient = &k;
    Expect::near(estimate(cells), 3 * h / std::sqrt(2.), 1e-13, "cells");
    const la::Vector active = problem.interpolate("if(x < 0.51, 1, 0)");
    cells.active = &active;
    Expect::near(estimate(cells), 3 * h / 2, 1e-13, "cells not held");

    // flux 2 where 5 is asked for on x = 1: h/2 (5-2)^2
    const Expression<2> flux("5", "t");
    EstimatorInput<2> sides{problem.mapping, problem.dof_handler, line, zero};
    sides.coefficient = &k;
    sides.dirichlet = {0, 2, 3};
    sides.neumann = {{1, &flux}};
    Expect::near(estimate(sides), 3 * std::sqrt(h / 2), 1e-13, "flux");
    // contact pressure -3 makes up for the difference, on its side only
    const la::Vector pressure = problem.interpolate("-3");
    sides.pressure = &pressure;
    Expect::near(estimate(sides), 3 * std::sqrt(h / 2), 1e-13,
                 "pressure elsewhere");
    sides.contact = {1};
    Expect::near(estimate(sides), 0, 1e-13, "pressure on the side");
  }

  /** k u' continuous over a jump of k that follows the mesh: u = x, then
   * 1/2 + (x - 1/2)/4, k = 1, then 4. */
  void estimator_coefficient_jump()
  {
    Problem<2> problem(1);
    unit_cube(problem, 3);
    const la::Vector u =
        problem.interpolate("if(x < 0.5, x, 0.5 + (x - 0.5)/4)");
    const Expression<2> k("if(x < 0.5, 1, 4)", "k");
    const Expression<2> zero("0", "f");
    EstimatorInput<2> input{problem.mapping, problem.dof_handler, u, zero};
    input.coefficient = &k;
    input.dirichlet = {0, 1};
    Expect::near(estimate(input), 0, 1e-13, "continuous flux");
  }

  /** Stiffness and load of a cell of Poisson's equation. */
  template <int dim>
  void cell_system(const dealii::FEValues<dim> &points,
                   const Expression<dim> &f, dealii::FullMatrix<double> &a,
                   dealii::Vector<double> &b)
  {
    for (const unsigned int q : points.quadrature_point_indices())
      for (unsigned int i = 0; i < b.size(); ++i)
      {
        b[i] += f.value(points.quadrature_point(q)) * points.shape_value(i, q)
                * points.JxW(q);
        for (unsigned int j = 0; j < b.size(); ++j)
          a(i, j) +=
              points.shape_grad(i, q) * points.shape_grad(j, q) * points.JxW(q);
      }
  }

  /** Estimate over error of a smooth problem: bounded, and the same on finer
   * and on locally refined meshes. */
  template <int dim>
  void effectivity(const unsigned int degree, const unsigned int level)
  {
    const std::string u =
        dim == 2 ? "sin(pi*x)*sin(pi*y)" : "sin(pi*x)*sin(pi*y)*sin(pi*z)";
    const ExactSolution<dim> exact(u, "Exact/Solution", "", "");
    const Expression<dim> f(std::to_string(dim) + "*pi^2*" + u, "f");
    check_effectivity<dim>(
        degree, 1, level, 0.05, "",
        [&](const Problem<dim> &problem)
        {
          const la::Vector solution = solve_linear<dim>(
              problem,
              [&](const dealii::FEValues<dim> &points,
                  dealii::FullMatrix<double> &a, dealii::Vector<double> &b)
              { cell_system(points, f, a, b); });
          EstimatorInput<dim> input{problem.mapping, problem.dof_handler,
                                    solution, f};
          input.dirichlet = all_sides<dim>();
          const double error =
              error_norms(problem.mapping, problem.dof_handler, solution, exact)
                  .h1_seminorm;
          return estimate(input) / error;
        });
  }

  void rasters()
  {
    Problem<2> problem(1);
    unit_cube(problem, 2);
    dealii::GridTools::transform(
        [](const Point<2> &x)
        { return Point<2>(2 * x[0] + 0.3 * x[0] * x[1], x[1]); },
        problem.mesh);
    const la::Vector u = problem.interpolate("3*x - y");
    const la::Vector kind = problem.interpolate("if(y < 0.4, 1, 2)");
    const Raster raster = sample_raster(problem.mapping, problem.dof_handler,
                                        {{&u}, {&kind, true}}, 46);
    Expect::that(raster.nx == 46 && raster.ny == 20, "size of the raster");
    Expect::near(raster.x_max, 2.3, 1e-13, "bounding box");
    double worst = 0;
    bool inside = true;
    bool kinds = true;
    for (std::size_t j = 0; j < raster.ny; ++j)
      for (std::size_t i = 0; i < raster.nx; ++i)
      {
        const double value = raster.fields[0][j * raster.nx + i];
        const double x = raster.x(i);
        const double y = raster.y(j);
        const bool in = x < 2 + 0.3 * y;
        if (std::abs(x - 2 - 0.3 * y) > 1e-6)
          inside = inside && in == !std::isnan(value);
        if (std::isnan(value))
          continue;
        worst = std::max(worst, std::abs(value - (3 * x - y)));
        // nodes at 0.25 and 0.5: the border lies half-way
        if (std::abs(y - 0.375) > 1e-6)
          kinds =
              kinds
              && raster.fields[1][j * raster.nx + i] == (y < 0.375 ? 1. : 2.);
      }
    Expect::near(worst, 0, 1e-12, "linear function on the raster");
    Expect::that(inside, "outside is not a number");
    Expect::that(kinds, "nearest nodes");

    Problem<3> cube(2);
    unit_cube(cube, 1);
    const la::Vector v = cube.interpolate("x*y + z^2");
    const Raster middle =
        sample_raster(cube.mapping, cube.dof_handler, {{&v}}, 10);
    Expect::near(middle.z, 0.5, 0, "plane");
    Expect::near(middle.fields[0][23], 0.35 * 0.25 + 0.25, 1e-13, "3D");
    const Raster top =
        sample_raster(cube.mapping, cube.dof_handler, {{&v}}, 10, 0.9);
    Expect::near(top.fields[0][23], 0.35 * 0.25 + 0.81, 1e-13, "3D, top");
  }

  std::string content(const std::filesystem::path &file)
  {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  void field_files()
  {
    Problem<2> problem(2);
    unit_cube(problem, 2);
    const la::Vector u = problem.interpolate("x^2");
    dealii::Vector<float> cells(problem.mesh.n_active_cells());
    FieldSeries series(folder, "solution", MPI_COMM_WORLD);
    for (const double time : {0.5, 1.5})
    {
      series.write<2>(time, {problem.mapping,
                             problem.dof_handler,
                             {{"displacement", &u}, {"gap", &u}},
                             {{"error", &cells}}});
      MPI_Barrier(MPI_COMM_WORLD);
      const std::string pvd = content(folder / "solution.pvd");
      Expect::that(pvd.find("</VTKFile>") != std::string::npos,
                   "the list is complete after each step");
      Expect::that((pvd.find("solution_0001.pvtu") != std::string::npos)
                       == (time > 1),
                   "the list has the steps so far");
      MPI_Barrier(MPI_COMM_WORLD);
    }
    const std::string pvtu = content(folder / "solution_0001.pvtu");
    for (const char *name : {"\"displacement\"", "\"gap\"", "\"error\""})
      Expect::that(pvtu.find(name) != std::string::npos,
                   std::string("field ") + name);
    Expect::that(std::filesystem::file_size(folder / "solution_0001.0.vtu")
                     > 1000,
                 "data file");
  }

  void pictures()
  {
    Problem<2> problem(1);
    dealii::GridGenerator::hyper_cube(problem.mesh, -1.5, 1.5);
    problem.mesh.refine_global(5);
    problem.distribute();
    const la::Vector u = problem.interpolate(
        "if(x^2+y^2 > 1, (x^2+y^2-1)/2 - log(x^2+y^2)/2, 0)");
    const la::Vector status = problem.interpolate("if(x^2+y^2 > 1, 0, 1)");
    const Raster raster = sample_raster(problem.mapping, problem.dof_handler,
                                        {{&u}, {&status, true}}, 200);
    Report report(MPI_COMM_WORLD, Verbosity::quiet);
    const bool root =
        dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    Expect::that(draw_solution(report, folder, "solution", raster, 0,
                               "Membrane's height")
                     || !root,
                 "solution is drawn");
    draw_status(report, folder, "active", raster, 1,
                {{2, "none"}, {0, "open"}, {1, "contact"}}, "Active set");
    draw_convergence(
        report, folder, "convergence",
        {{"L2 error", {{100, 1e-1}, {400, 2.5e-2}, {1600, 6e-3}, {6400, 0}}},
         {"H1 error", {{100, 1}, {400, 0.5}, {1600, 0.25}, {6400, 0.125}}}},
        {{"active-set steps", {{100, 3}, {400, 4}, {1600, 3}, {6400, 4}}}},
        "Convergence");
    // a mesh that leaves part of its bounding box free
    Problem<2> disc(1);
    dealii::GridGenerator::hyper_ball(disc.mesh);
    disc.mesh.refine_global(4);
    disc.distribute();
    const la::Vector cap = disc.interpolate("1 - x^2 - y^2");
    const Raster round = sample_raster(disc.mapping, disc.dof_handler,
                                       {{&cap}, {&cap, true}}, 160);
    Expect::that(std::isnan(round.fields[0][0]), "the corner is free");
    Expect::that(draw_solution(report, folder, "disc", round, 0, "Disc")
                     || !root,
                 "disc is drawn");
    Expect::that(draw_status(report, folder, "disc-status", round, 1,
                             {{0, "low"}, {1, "high"}}, "Disc")
                     || !root,
                 "status of the disc is drawn");

    MPI_Barrier(MPI_COMM_WORLD);
    for (const char *name :
         {"solution", "active", "convergence", "disc", "disc-status"})
    {
      const std::string svg = content(folder / (std::string(name) + ".svg"));
      Expect::that(svg.find("</svg>") != std::string::npos,
                   std::string(name) + ".svg is complete");
      Expect::that(svg.size() < 300000, std::string(name) + ".svg is small: "
                                            + std::to_string(svg.size()));
    }
    Expect::that(content(folder / "convergence.svg").find("slope -0.50")
                     != std::string::npos,
                 "slope of the H1 error");
  }

  /** The number that stands behind a word of a script. */
  double number_after(const std::string &script, const std::string &word)
  {
    const std::size_t place = script.find(word);
    return place == std::string::npos
               ? std::nan("")
               : std::stod(script.substr(place + word.size()));
  }

  void axes()
  {
    // whole numbers: whole ticks, and a range a little wider than they are
    const std::string levels = fitted_axis('x', {4, 2, 3}, false);
    Expect::that(levels.find("set xtics 1\n") != std::string::npos, levels);
    Expect::near(number_after(levels, "xrange ["), 1.92, 1e-12, "left end");
    Expect::that(fitted_axis('x', {0, 1000}, false).find("xtics 100\n")
                     != std::string::npos,
                 "ticks at hundreds");
    Expect::that(fitted_axis('x', {0.5, 2}, false).find("xtics autofreq")
                     != std::string::npos,
                 "ticks of other numbers");
    // logarithmic: not up to the next power of ten, zeros left out
    const std::string errors =
        fitted_axis('y', {0.02, 0, std::nan(""), 0.2}, true);
    Expect::near(number_after(errors, "yrange ["), 0.02 / std::pow(10., 0.04),
                 1e-9, "lower end");
    Expect::that(errors.find("set ytics (0.02, 0.05, 0.1, 0.2)")
                     != std::string::npos,
                 errors);
    Expect::that(fitted_axis('y', {1, 1.1}, true).find("ytics (1, 1.05, 1.1)")
                     != std::string::npos,
                 "ticks of a short axis: " + fitted_axis('y', {1, 1.1}, true));
    Expect::that(fitted_axis('y', {0, -1}, true).empty(), "nothing to show");
  }

  /** The circle x^2 + y^2 = 1, to the second order of the grid. */
  void round_line()
  {
    Raster frame;
    frame.x_min = frame.y_min = -2;
    frame.x_max = frame.y_max = 2;
    const auto rows =
        zero_line(frame, 81, [](const Point<2> &x) { return x.norm() - 1.; });
    double length = 0.;
    for (std::size_t i = 0; i < rows.size(); i += 3)
    {
      const Point<2> a(rows[i][0], rows[i][1]),
          b(rows[i + 1][0], rows[i + 1][1]);
      Expect::near(a.norm(), 1., 2e-3, "on the circle");
      length += a.distance(b);
    }
    Expect::near(length, 2 * 3.14159265, 0.01, "length of the circle");
    Expect::that(
        zero_line(frame, 11, [](const Point<2> &) { return 1.; }).empty(),
        "no line");
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(argc, argv,
                    [](const std::filesystem::path &given)
                    {
                      folder = given;
                      norms();
                      energy<2>();
                      energy<3>();
                      estimator_is_consistent<2>();
                      estimator_is_consistent<3>();
                      estimator_terms();
                      estimator_coefficient_jump();
                      effectivity<2>(1, 4);
                      effectivity<2>(2, 3);
                      effectivity<3>(1, 2);
                      rasters();
                      field_files();
                      axes();
                      round_line();
                      pictures();
                    });
}
