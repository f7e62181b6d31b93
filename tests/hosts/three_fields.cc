// SPDX-License-Identifier: LGPL-2.1-or-later
// A host in the style of deal.II's step-44: displacement u, pressure p and
// dilatation J are fields of one element, with a material and a Newton loop of
// its own,
//
//     psi = mu/2 (tr C - 3 - 2 ln det F) + lambda/2 (ln J)^2 + p (det F - J) .
//
// Contact is the part between "contact" and "end of contact" alone: bodies that
// slide over many facets. Of p and J it knows nothing.
//
//     three_fields press|slide dgq|dgp
//
// dgq: p and J have as many values in a cell as there are points of quadrature,
// where J is det F then: the same answer as of a displacement alone. dgp: they
// are constants in each cell, of an element without support points. Prints
// time, force on the block, energy and linearisations of each step.
#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_dgp.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

using namespace dealii;

namespace
{
  constexpr int dim = 2;

  enum Side : types::boundary_id
  {
    block_bottom = 2,
    block_top = 3,
    die_bottom = 12,
    die_top = 13
  };

  /** What is pressed on what. */
  struct Task
  {
    bool slides;
    std::vector<unsigned int> block_cells, die_cells;
    double width, die_width, die_height, die_radius, die_stiffness;
    unsigned int n_steps;
    double end;

    /** Displacement of the die's top. */
    Tensor<1, dim> way(const double t) const
    {
      Tensor<1, dim> u;
      u[0] = slides && t > 1. ? 2. * (t - 1.) : 0.;
      u[1] = slides ? -0.15 * std::min(2. * t, 1.) : -0.3 * t;
      return u;
    }
  };

  /** A block of height 1 below a die of equal width, all of which is pressed
   * flat, or one with an arc that slides. */
  Task make_task(const bool slides)
  {
    if (slides)
      return {true, {40, 10}, {12, 5}, 4., 1.2, 0.6, 1., 10., 44, 2.};
    return {false, {3, 3}, {4, 3}, 1., 1., 1., 0., 1., 3, 1.};
  }

  std::unique_ptr<FiniteElement<dim>> make_field(const bool has_support_points)
  {
    if (has_support_points)
      return std::make_unique<FE_DGQ<dim>>(1);
    return std::make_unique<FE_DGP<dim>>(0);
  }

  class Host
  {
  public:
    Host(const Task &task, const bool has_support_points)
        : task(task),
          triangulation(MPI_COMM_WORLD),
          field(make_field(has_support_points)),
          fe(FE_Q<dim>(1), dim, *field, 1, *field, 1),
          dofs(triangulation),
          contact(MPI_COMM_WORLD)
    {
      make_mesh();
      dofs.distribute_dofs(fe);
      hold();
      const IndexSet &owned = dofs.locally_owned_dofs();
      DynamicSparsityPattern pattern(relevant);
      DoFTools::make_sparsity_pattern(dofs, pattern, constraints, false);
      SparsityTools::distribute_sparsity_pattern(pattern, owned, MPI_COMM_WORLD,
                                                 relevant);
      tangent.reinit(owned, owned, pattern, MPI_COMM_WORLD);
      solution.reinit(owned, MPI_COMM_WORLD);
      residual.reinit(solution);
      start();

      // contact
      abut::MethodParameters method;
      method.kinematics = ABUT_KINEMATICS_CURRENT;
      abut::SolverParameters solver;
      solver.linear = abut::SolverParameters::Linear::direct;
      abut::ContactPair<dim> pair;
      pair.name = "die on block";
      pair.secondary = {block_top};
      pair.primary = {die_bottom};
      contact.set_parameters(method, solver);
      contact.set_pairs({pair});
      contact.reinit(mapping, dofs, constraints);
      // end of contact
    }

    /** One step of Newton's method after the other; returns their number. */
    unsigned int solve(const double t)
    {
      move_to(t);
      // contact
      contact.detect(solution);
      abut::la::Vector step(solution), forces(solution);
      unsigned int n = 0;
      double error = 1.;
      while (error > 1e-11 && n < 30)
      {
        assemble(true);
        contact.linearise(solution);
        contact.solve_linearised(tangent, residual, step);
        solution += step;
        assemble(false);
        const double defect = contact.evaluate(solution, forces);
        constraints.set_zero(forces);
        forces -= residual;
        error = forces.l2_norm() + defect;
        ++n;
      }
      AssertThrow(error <= 1e-11, ExcMessage("no convergence"));
      contact.follow(solution);
      contact.commit(solution);
      force = contact.results().pairs()[0].secondary_force;
      // end of contact
      return n;
    }

    void run()
    {
      for (unsigned int k = 1; k <= task.n_steps; ++k)
      {
        const double t = task.end * k / task.n_steps;
        const unsigned int n = solve(t);
        if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          std::cout << t << " " << force[0] << " " << force[1] << " " << energy
                    << " " << n << std::endl;
      }
    }

  private:
    void make_mesh()
    {
      Triangulation<dim> block, die;
      GridGenerator::subdivided_hyper_rectangle(
          block, task.block_cells, Point<dim>(0., 0.),
          Point<dim>(task.width, 1.), true);
      GridGenerator::subdivided_hyper_rectangle(
          die, task.die_cells, Point<dim>(0., 0.), Point<dim>(1., 1.), true);
      for (const auto &cell : die.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            face->set_boundary_id(10 + face->boundary_id());
      // Its lowest point, in the middle or everywhere, is on the block.
      GridTools::transform([&](const Point<dim> &p) { return place(p); }, die);
      // Bodies share no vertices, not even where they touch.
      auto [vertices, cells, sides] =
          GridTools::get_coarse_mesh_description(block);
      const auto [more, other, its] =
          GridTools::get_coarse_mesh_description(die);
      const auto first = static_cast<unsigned int>(vertices.size());
      vertices.insert(vertices.end(), more.begin(), more.end());
      for (auto cell : other)
      {
        for (unsigned int &v : cell.vertices)
          v += first;
        cells.push_back(cell);
      }
      for (auto side : its.boundary_lines)
      {
        for (unsigned int &v : side.vertices)
          v += first;
        sides.boundary_lines.push_back(side);
      }
      triangulation.create_triangulation(vertices, cells, sides);
    }

    Point<dim> place(const Point<dim> &p) const
    {
      const double r = task.die_radius, w = task.die_width,
                   middle =
                       task.slides ? task.width / 2. - 1. : task.width / 2.;
      Point<dim> low((p[0] - 0.5) * w, 0.);
      if (r > 0.)
      {
        const double angle = std::asin(w / 2. / r) * (2. * p[0] - 1.);
        low = Point<dim>(r * std::sin(angle), r * (1. - std::cos(angle)));
      }
      const Point<dim> high((p[0] - 0.5) * w, task.die_height);
      Point<dim> result = low + p[1] * (high - low);
      result[0] += middle;
      result[1] += 1.;
      return result;
    }

    /** The block stands on its bottom, and the die hangs at its top: in the
     * press they may grow sideways there. */
    void hold()
    {
      relevant = DoFTools::extract_locally_relevant_dofs(dofs);
      abut::versions::reinit(constraints, dofs.locally_owned_dofs(), relevant);
      ComponentMask held(dim + 2, false);
      held.set(0, task.slides);
      held.set(1, true);
      const Functions::ZeroFunction<dim> zero(dim + 2);
      for (const Side side : {block_bottom, die_top})
        VectorTools::interpolate_boundary_values(mapping, dofs, side, zero,
                                                 constraints, held);
      ComponentMask x(dim + 2, false);
      x.set(0, true);
      if (!task.slides)
        for (const types::boundary_id side : {0, 10})
          VectorTools::interpolate_boundary_values(mapping, dofs, side, zero,
                                                   constraints, x);
      constraints.close();
    }

    /** J = 1. */
    void start()
    {
      // Of both elements the constant function has all or the first of its
      // coefficients 1.
      const unsigned int n =
          field->has_support_points() ? field->dofs_per_cell : 1;
      std::vector<types::global_dof_index> indices(fe.dofs_per_cell);
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (fe.system_to_component_index(i).first == dim + 1
                && fe.system_to_component_index(i).second < n)
              solution(indices[i]) = 1.;
        }
      solution.compress(VectorOperation::insert);
    }

    /** The die as a whole goes where its top is. */
    void move_to(const double t)
    {
      const Tensor<1, dim> increment = task.way(t) - task.way(time);
      time = t;
      std::vector<types::global_dof_index> indices(fe.dofs_per_cell);
      abut::la::Vector moved(solution);
      for (const auto &cell : dofs.active_cell_iterators())
        if (!cell->is_artificial() && cell->center()[1] > 1.)
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const unsigned int c = fe.system_to_component_index(i).first;
            if (c < dim && relevant.is_element(indices[i])
                && constraints.is_constrained(indices[i])
                && cell_is_at_top(cell, i))
              constraints.set_inhomogeneity(indices[i], task.way(t)[c]);
            if (c < dim && dofs.locally_owned_dofs().is_element(indices[i]))
              moved(indices[i]) = solution(indices[i]) + increment[c];
          }
        }
      moved.compress(VectorOperation::insert);
      solution = moved;
      constraints.distribute(solution);
    }

    /** Whether an unknown of the displacement is one of a node at y = 1 of the
     * cell. */
    template <typename Cell>
    bool cell_is_at_top(const Cell &cell, const unsigned int i) const
    {
      const unsigned int v = fe.system_to_component_index(i).second;
      return cell->vertex(v)[1] > 1. + task.die_height - 1e-10;
    }

    /** Internal forces, and the tangent unless that is not wanted. */
    void assemble(const bool with_tangent)
    {
      constexpr double mu = 1. / 2.6, lambda = 0.3 / (1.3 * 0.4);
      abut::la::Vector ghosted(dofs.locally_owned_dofs(), relevant,
                               MPI_COMM_WORLD);
      ghosted = solution;
      residual = 0.;
      if (with_tangent)
        tangent = 0.;
      energy = 0.;
      const QGauss<dim> rule(2);
      FEValues<dim> values(mapping, fe, rule,
                           update_values | update_gradients
                               | update_JxW_values);
      const FEValuesExtractors::Vector of_u(0);
      const FEValuesExtractors::Scalar of_p(dim), of_J(dim + 1);
      const unsigned int n = fe.dofs_per_cell;
      FullMatrix<double> matrix(n, n);
      Vector<double> vector(n);
      std::vector<Tensor<2, dim>> gradients(rule.size()), grad(n);
      std::vector<double> pressures(rule.size()), dilatations(rule.size());
      std::vector<types::global_dof_index> indices(n);
      for (const auto &cell : dofs.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        values.reinit(cell);
        values[of_u].get_function_gradients(ghosted, gradients);
        values[of_p].get_function_values(ghosted, pressures);
        values[of_J].get_function_values(ghosted, dilatations);
        const double E = cell->center()[1] > 1. ? task.die_stiffness : 1.;
        matrix = 0.;
        vector = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Tensor<2, dim> F =
              Tensor<2, dim>(unit_symmetric_tensor<dim>()) + gradients[q];
          const Tensor<2, dim> G = transpose(invert(F));
          const double det = determinant(F), p = pressures[q],
                       J = dilatations[q], w = values.JxW(q);
          const Tensor<2, dim> P = E * mu * (F - G) + p * det * G;
          energy +=
              w * E
              * (0.5 * mu * (F.norm_square() + 1. - 3. - 2. * std::log(det))
                 + 0.5 * lambda * std::log(J) * std::log(J));
          for (unsigned int i = 0; i < n; ++i)
            grad[i] = values[of_u].gradient(i, q);
          for (unsigned int i = 0; i < n; ++i)
          {
            const double pi = values[of_p].value(i, q),
                         Ji = values[of_J].value(i, q),
                         by_i = det * scalar_product(G, grad[i]);
            vector[i] += w
                         * (scalar_product(P, grad[i]) + pi * (det - J)
                            + Ji * (E * lambda * std::log(J) / J - p));
            const Tensor<2, dim> dP =
                E * mu * grad[i]
                + (E * mu - p * det) * (G * transpose(grad[i]) * G)
                + p * by_i * G;
            for (unsigned int j = 0; j < n && with_tangent; ++j)
            {
              const double pj = values[of_p].value(j, q),
                           Jj = values[of_J].value(j, q),
                           by_j = det * scalar_product(G, grad[j]);
              matrix(i, j) +=
                  w
                  * (scalar_product(dP, grad[j]) + pi * (by_j - Jj)
                     + pj * (by_i - Ji)
                     + Ji * Jj * E * lambda * (1. - std::log(J)) / (J * J));
            }
          }
        }
        cell->get_dof_indices(indices);
        if (with_tangent)
          constraints.distribute_local_to_global(matrix, indices, tangent);
        abut::versions::distribute_local_to_global(constraints, vector, indices,
                                                   residual);
      }
      tangent.compress(VectorOperation::add);
      residual.compress(VectorOperation::add);
      energy = dealii::Utilities::MPI::sum(energy, MPI_COMM_WORLD);
    }

    const Task task;
    parallel::distributed::Triangulation<dim> triangulation;
    const MappingQ<dim> mapping{1};
    const std::unique_ptr<FiniteElement<dim>> field;
    const FESystem<dim> fe;
    DoFHandler<dim> dofs;
    IndexSet relevant;
    AffineConstraints<double> constraints;
    abut::la::Matrix tangent;
    abut::la::Vector solution, residual;
    double energy = 0., time = 0.;
    Tensor<1, dim> force;
    abut::ContactAssembler<dim> contact;
  };
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 3)
    return 2;
  std::cout.precision(15);
  Host host(make_task(std::string(argv[1]) == "slide"),
            std::string(argv[2]) == "dgq");
  host.run();
  return 0;
}
