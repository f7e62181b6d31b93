// SPDX-License-Identifier: LGPL-2.1-or-later
// A host in the style of step-44: its own neo-Hookean block, its own Newton
// loop, and a rigid parabola or circle that is pressed deep into it, with
// points that move. Figures are those of two programs that share no code with
// this one or with each other, to 4e-12 (Q1, 2 x 2 Gauss, plane strain).
#include "expect.h"

#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <string>
#include <vector>

using namespace abut;
using namespace dealii;

namespace
{
  using hosts::expect;
  using hosts::is_first_rank;

  void expect_near(const double value, const double exact, const double bound,
                   const std::string &what)
  {
    expect(std::abs(value - exact) <= bound,
           what + " is " + std::to_string(value) + ", off by "
               + std::to_string((value - exact) / bound) + " times the bound");
  }

  /** psi = mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2 at one point. */
  template <int dim> class NeoHooke
  {
  public:
    explicit NeoHooke(const Tensor<2, dim> &gradient)
        : F(unit_symmetric_tensor<dim>() + gradient),
          inverse(transpose(invert(F))),
          log_J(std::log(determinant(F)))
    {
    }

    double energy() const
    {
      return 0.5 * mu * (F.norm_square() + 3. - dim - 3. - 2. * log_J)
             + 0.5 * lambda * log_J * log_J;
    }

    Tensor<2, dim> stress() const
    {
      return mu * (F - inverse) + lambda * log_J * inverse;
    }

    Tensor<2, dim> stress_change(const Tensor<2, dim> &change) const
    {
      return mu * change
             + (mu - lambda * log_J) * inverse * transpose(change) * inverse
             + lambda * scalar_product(inverse, change) * inverse;
    }

  private:
    static constexpr double mu = 1. / 2.6, lambda = 0.3 / (1.3 * 0.4);
    const Tensor<2, dim> F, inverse;
    const double log_J;
  };

  /** The block (0, 1)^2, in 3D one cell deep and without motion along z: all
   * that is here is the host's, and knows nothing of contact. */
  template <int dim> class Block
  {
  public:
    Block(const unsigned int n, const unsigned int degree)
        : triangulation(MPI_COMM_WORLD),
          fe(FE_Q<dim>(degree), dim),
          dofs(triangulation)
    {
      std::vector<unsigned int> cells(dim, n);
      Point<dim> end;
      end[0] = end[1] = 1.;
      if (dim == 3)
      {
        cells[2] = 1;
        end[2] = depth;
      }
      GridGenerator::subdivided_hyper_rectangle(triangulation, cells,
                                                Point<dim>(), end, true);
      dofs.distribute_dofs(fe);
      hold();
      const IndexSet &owned = dofs.locally_owned_dofs();
      DynamicSparsityPattern pattern(relevant);
      DoFTools::make_sparsity_pattern(dofs, pattern, constraints, false);
      SparsityTools::distribute_sparsity_pattern(pattern, owned, MPI_COMM_WORLD,
                                                 relevant);
      tangent.reinit(owned, owned, pattern, MPI_COMM_WORLD);
      u.reinit(owned, MPI_COMM_WORLD);
      residual.reinit(u);
    }

    /** Internal forces, and the tangent unless that is not wanted. */
    void assemble(const bool with_tangent)
    {
      la::Vector ghosted(dofs.locally_owned_dofs(), relevant, MPI_COMM_WORLD);
      ghosted = u;
      residual = 0.;
      if (with_tangent)
        tangent = 0.;
      energy = 0.;
      const QGauss<dim> rule(fe.degree + 1);
      FEValues<dim> values(mapping, fe, rule,
                           update_gradients | update_JxW_values);
      const unsigned int n = fe.n_dofs_per_cell();
      FullMatrix<double> matrix(n, n);
      Vector<double> vector(n);
      std::vector<Tensor<2, dim>> gradients(rule.size()), shape(n);
      std::vector<types::global_dof_index> indices(n);
      for (const auto &cell : dofs.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        values.reinit(cell);
        values[FEValuesExtractors::Vector(0)].get_function_gradients(ghosted,
                                                                     gradients);
        matrix = 0.;
        vector = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const NeoHooke<dim> material(gradients[q]);
          energy += material.energy() * values.JxW(q);
          for (unsigned int i = 0; i < n; ++i)
            shape[i] = values[FEValuesExtractors::Vector(0)].gradient(i, q);
          for (unsigned int i = 0; i < n; ++i)
          {
            vector[i] +=
                scalar_product(material.stress(), shape[i]) * values.JxW(q);
            if (!with_tangent)
              continue;
            const auto change = material.stress_change(shape[i]);
            for (unsigned int j = 0; j < n; ++j)
              matrix(i, j) += scalar_product(change, shape[j]) * values.JxW(q);
          }
        }
        cell->get_dof_indices(indices);
        if (with_tangent)
          constraints.distribute_local_to_global(matrix, vector, indices,
                                                 tangent, residual);
        else
          abut::versions::distribute_local_to_global(constraints, vector,
                                                     indices, residual);
      }
      tangent.compress(VectorOperation::add);
      residual.compress(VectorOperation::add);
      energy = dealii::Utilities::MPI::sum(energy, MPI_COMM_WORLD);
    }

    /** Displacement at a corner of the plane z = 0. */
    Tensor<1, dim> at(const double x, const double y) const
    {
      Tensor<1, dim> found;
      for (const auto &[dof, point] :
           abut::versions::support_points(mapping, dofs))
        if (dofs.locally_owned_dofs().is_element(dof)
            && std::abs(point[0] - x) + std::abs(point[1] - y) < 1e-12
            && (dim == 2 || std::abs(point[dim - 1]) < 1e-12))
          found[component_of(dof)] = u(dof);
      for (unsigned int d = 0; d < dim; ++d)
        found[d] = dealii::Utilities::MPI::sum(found[d], MPI_COMM_WORLD);
      return found;
    }

    static constexpr double depth = 0.25;
    parallel::distributed::Triangulation<dim> triangulation;
    const MappingQ<dim> mapping{1};
    const FESystem<dim> fe;
    DoFHandler<dim> dofs;
    IndexSet relevant;
    AffineConstraints<double> constraints;
    la::Matrix tangent;
    la::Vector u, residual;
    double energy = 0.;

  private:
    unsigned int component_of(const types::global_dof_index dof) const
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        ComponentMask mask(dim, false);
        mask.set(d, true);
        if (DoFTools::extract_dofs(dofs, mask).is_element(dof))
          return d;
      }
      return 0;
    }

    /** The bottom is held, the left side slides, nothing moves along z. */
    void hold()
    {
      relevant = DoFTools::extract_locally_relevant_dofs(dofs);
      abut::versions::reinit(constraints, dofs.locally_owned_dofs(), relevant);
      const Functions::ZeroFunction<dim> zero(dim);
      ComponentMask x(dim, false);
      x.set(0, true);
      VectorTools::interpolate_boundary_values(mapping, dofs, 2, zero,
                                               constraints);
      VectorTools::interpolate_boundary_values(mapping, dofs, 0, zero,
                                               constraints, x);
      if (dim == 3)
      {
        ComponentMask z(dim, false);
        z.set(2, true);
        for (const types::boundary_id side : {4, 5})
          VectorTools::interpolate_boundary_values(mapping, dofs, side, zero,
                                                   constraints, z);
      }
      constraints.close();
    }
  };

  /** 1 + x^2 / 2 - time. */
  template <int dim> class Parabola : public Function<dim>
  {
  public:
    double value(const Point<dim> &p, const unsigned int) const override
    {
      return 1. + 0.5 * p[0] * p[0] - this->get_time();
    }

    Tensor<1, dim> gradient(const Point<dim> &p,
                            const unsigned int) const override
    {
      Tensor<1, dim> slope;
      slope[0] = p[0];
      return slope;
    }
  };

  template <int dim> std::shared_ptr<RigidObstacle<dim>> make_parabola()
  {
    HeightObstacle<dim> height;
    height.height = std::make_shared<Parabola<dim>>();
    height.axis = 1;
    height.material_above = true;
    return std::make_shared<RigidObstacle<dim>>(height);
  }

  /** Of radius 1 about (0, 2 - time). */
  template <int dim> std::shared_ptr<RigidObstacle<dim>> make_circle()
  {
    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    shape.dimension = dim;
    shape.kind = dim == 2 ? ABUT_OBSTACLE_SPHERE : ABUT_OBSTACLE_CYLINDER;
    shape.point[1] = 2.;
    const auto circle = std::make_shared<RigidObstacle<dim>>(shape);
    circle->set_motion(
        [](const double time)
        {
          RigidPose<dim> pose;
          pose.rotation = unit_symmetric_tensor<dim>();
          pose.translation[1] = -time;
          return pose;
        });
    return circle;
  }

  struct Settings
  {
    unsigned int n = 8, degree = 1;
    bool parabola = true;
    std::string law = "lagrange";
    std::optional<abut_discretisation> discretisation;
  };

  /** Errors that are small enough, and those that are but round-off. */
  constexpr double enough = 1e-11, round_off = 1e-13;

  /** The block pressed to a depth in steps. */
  template <int dim> class Press
  {
  public:
    explicit Press(const Settings &settings)
        : block(settings.n, settings.degree),
          obstacle(settings.parabola ? make_parabola<dim>()
                                     : make_circle<dim>())
    {
      // All that contact needs to be told, and the loop below.
      MethodParameters method;
      method.options.law = abut_law_find(settings.law.c_str());
      method.discretisation = settings.discretisation;
      method.kinematics = ABUT_KINEMATICS_CURRENT;
      SolverParameters solver;
      solver.linear = SolverParameters::Linear::direct;
      ContactPair<dim> pair;
      pair.name = "press";
      pair.secondary = {3};
      pair.obstacle = obstacle;
      pair.reach = 1.;
      contact.set_parameters(method, solver);
      contact.set_pairs({pair});
      contact.reinit(block.mapping, block.dofs, block.constraints);
    }

    /** Forces out of balance and what the law is off by, of each iterate. */
    std::vector<double> step_to(const double depth)
    {
      obstacle->set_time(depth);
      contact.detect(block.u);
      la::Vector step(block.u), forces(block.u);
      std::vector<double> errors;
      for (unsigned int k = 0; k < 20; ++k)
      {
        block.assemble(true);
        contact.linearise(block.u);
        contact.solve_linearised(block.tangent, block.residual, step);
        block.u += step;
        block.assemble(false);
        const double defect = contact.evaluate(block.u, forces);
        block.constraints.set_zero(forces);
        forces -= block.residual;
        errors.push_back(forces.l2_norm() + defect);
        if (errors.back() < enough)
          break;
      }
      expect(errors.back() < enough,
             "no convergence at " + std::to_string(depth));
      contact.follow(block.u);
      contact.commit(block.u);
      return errors;
    }

    Block<dim> block;
    std::shared_ptr<RigidObstacle<dim>> obstacle;
    ContactAssembler<dim> contact{MPI_COMM_WORLD};
  };

  /** Order of convergence of the last three iterates above round-off; 0 where
   * there are fewer. */
  double order_of(const std::vector<double> &errors)
  {
    std::vector<double> seen;
    for (const double e : errors)
      if (e > round_off)
        seen.push_back(e);
    const std::size_t n = seen.size();
    return n < 3 ? 0.
                 : std::log(seen[n - 1] / seen[n - 2])
                       / std::log(seen[n - 2] / seen[n - 3]);
  }

  // Order 2; sqrt(2) where the gap is a distance to first order only, see
  // abut_obstacle_gap().
  const double of_distance = 1.8, of_height = 1.4;

  /** In two steps that are so large that at least one of them shows the order.
   */
  template <int dim>
  void press(Press<dim> &run, const double depth, const double least_order)
  {
    double best = 0.;
    for (const double present : {0.5 * depth, depth})
    {
      const std::vector<double> errors = run.step_to(present);
      const double order = order_of(errors);
      best = std::max(best, order);
      if (is_first_rank())
      {
        std::cout << "  depth " << present << ", order " << order << ":";
        for (const double e : errors)
          std::cout << " " << e;
        std::cout << std::endl;
      }
      expect(errors.size() <= 6, "Newton steps at " + std::to_string(present));
    }
    expect(best >= least_order || depth < 0.1, "order " + std::to_string(best));
  }

  struct Figures
  {
    double depth;
    unsigned int n;
    unsigned int active;
    double Fy, Fx, W, ux, uy;
  };

  template <int dim> void check(const bool parabola, const Figures &exact)
  {
    Settings settings;
    settings.n = exact.n;
    settings.parabola = parabola;
    Press<dim> run(settings);
    const std::string name = std::string(parabola ? "parabola" : "circle")
                             + ", n = " + std::to_string(exact.n) + ", "
                             + std::to_string(dim) + "D";
    if (is_first_rank())
      std::cout << name << std::endl;
    press(run, exact.depth, parabola ? of_height : of_distance);
    const PairResult<dim> result = run.contact.results().pairs()[0];
    const double width = dim == 3 ? Block<dim>::depth : 1.;
    const auto corner = run.block.at(1., 1.), middle = run.block.at(0., 1.);
    expect(result.n_active == exact.active * (dim - 1),
           name + ": active " + std::to_string(result.n_active));
    expect_near(-result.secondary_force[1] / width, exact.Fy, 1e-8,
                name + " Fy");
    expect_near(result.secondary_force[0] / width, exact.Fx, 1e-8,
                name + " Fx");
    expect_near(run.block.energy / width, exact.W, 1e-8, name + " W");
    expect_near(corner[0], exact.ux, 1e-8, name + " ux");
    expect_near(corner[1], exact.uy, 1e-8, name + " uy");
    expect_near(middle[1], -exact.depth, 1e-12, name + " depth");
  }

  /** Without figures of others: the force is what the energy changes by, and no
   * node is in the obstacle. */
  template <int dim> void check_energy(const unsigned int degree)
  {
    Settings settings;
    settings.n = 4;
    settings.degree = degree;
    settings.parabola = false;
    Press<dim> run(settings);
    press(run, 0.2, of_distance);
    const std::string name = "degree " + std::to_string(degree);
    const double force = -run.contact.results().pairs()[0].secondary_force[1];
    expect(run.contact.results().pairs()[0].penetration <= 1e-13,
           name + ": penetration");
    double energy[2];
    for (int side = 0; side < 2; ++side)
    {
      run.step_to(0.2 + (side == 0 ? -1e-4 : 1e-4));
      energy[side] = run.block.energy;
    }
    expect_near((energy[1] - energy[0]) / 2e-4 / force, 1., 1e-6,
                name + ": change of energy by force");
  }

  /** Laws with a penalty: as fast, and what multipliers say in the limit. */
  void check_law(const std::string &law,
                 const std::optional<abut_discretisation> discretisation,
                 const double bound)
  {
    Settings settings;
    settings.law = law;
    settings.discretisation = discretisation;
    Press<2> run(settings);
    if (is_first_rank())
      std::cout << law << std::endl;
    press(run, 0.1, of_height);
    expect_near(-run.contact.results().pairs()[0].secondary_force[1],
                0.048037653521, bound * 0.048, law + ": force");
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout.precision(3);
  // All of them on one rank; on several it is the same code that counts.
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
  {
    check<2>(true, {0.02, 32, 5, 0.006113801914, 2.978195468e-4, 5.569548468e-5,
                    -2.760927018e-4, 1.797503909e-4});
    check<2>(true, {0.1, 16, 6, 0.048438522673, 6.371997423e-3, 2.083453614e-3,
                    -1.895571079e-3, 2.468397340e-4});
    check<2>(true, {0.1, 32, 11, 0.048389013033, 6.377070521e-3, 2.085694668e-3,
                    -1.999438153e-3, 2.907189010e-4});
    check<2>(false, {0.3, 16, 10, 0.231471831793, 5.869286909e-2,
                     2.832230012e-2, 1.033466613e-2, -1.891778481e-2});
    check<3>(false, {0.3, 8, 5, 0.231077758117, 5.827736258e-2, 2.826428626e-2,
                     1.124833916e-2, -1.879305808e-2});
    check_energy<2>(2);
    check_law("augmented lagrangian", std::nullopt, 1e-4);
    check_law("penalty", ABUT_DISCRETISATION_QUADRATURE_POINT, 0.1);
  }
  check<2>(true, {0.1, 8, 3, 0.048037653521, 6.059548693e-3, 2.076926431e-3,
                  -1.906636221e-3, 4.129433877e-4});
  check<2>(false, {0.3, 8, 5, 0.231077758117, 5.827736258e-2, 2.826428626e-2,
                   1.124833916e-2, -1.879305808e-2});
  check<3>(true, {0.1, 8, 3, 0.048037653521, 6.059548693e-3, 2.076926431e-3,
                  -1.906636221e-3, 4.129433877e-4});
  check_law("penalty", std::nullopt, 0.05);
  return hosts::good ? 0 : 1;
}
