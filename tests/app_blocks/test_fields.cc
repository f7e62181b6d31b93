// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Estimator, error norms, energy and field files.

#include "app/adapt/estimator.h"
#include "app/input/expression.h"
#include "app/physics/error_norms.h"
#include "app/pictures/field_output.h"

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
                      field_files();
                    });
}
