// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact with friction added to the host's matrix, which a factorisation of
// the host's solves: the same displacement as by ContactAssembler::solve(), and
// where all of the interface slips friction and pressure are in the ratio mu.
#include "patch.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_solver.h>

using namespace abut;

namespace
{
  constexpr double mu = 0.1;

  /** How far the top is moved aside: some of the interface slips, or all of
   * it does. */
  constexpr double some = 0.2, all = 0.5;

  template <int dim> ContactPair<dim> frictional(ContactPair<dim> pair)
  {
    auto friction = std::make_shared<Friction<dim>>();
    friction->coefficient = [](const dealii::Point<dim> &) { return mu; };
    pair.friction = friction;
    return pair;
  }

  template <int dim> class Blocks
  {
  public:
    explicit Blocks(const hosts::Case &run) : blocks_(run)
    {
      blocks_.prepare({frictional(blocks_.pair())});
      u_ = blocks_.start();
      contact().detect(u_);
    }

    ContactAssembler<dim> &contact()
    {
      return blocks_.contact();
    }

    const la::Vector &solution() const
    {
      return u_;
    }

    /** Let contact solve. */
    void solve()
    {
      la::Vector increment(u_);
      do
      {
        contact().solve(blocks_.stiffness(), residual(), increment);
        u_ += increment;
        blocks_.constraints().distribute(u_);
      } while (contact().update(u_));
    }

    /** Add contact to the matrix and factorise that. */
    void add()
    {
      la::Matrix matrix;
      make_matrix(matrix);
      bool goes_on = true;
      while (goes_on)
      {
        la::Vector right = residual(), increment(u_);
        matrix = 0.;
        add_stiffness(matrix);
        contact().add(matrix, right);
        right *= -1.;
        dealii::SolverControl control;
        dealii::TrilinosWrappers::SolverDirect direct(control);
        direct.solve(matrix, increment, right);
        u_ += increment;
        blocks_.constraints().distribute(u_);
        goes_on = contact().update(u_);
      }
    }

  private:
    /** Internal minus external forces. */
    la::Vector residual() const
    {
      la::Vector result(u_);
      blocks_.stiffness().vmult(result, u_);
      result -= blocks_.load();
      blocks_.constraints().set_zero(result);
      return result;
    }

    void make_matrix(la::Matrix &matrix)
    {
      const auto &dofs = blocks_.dof_handler();
      const dealii::IndexSet owned = dofs.locally_owned_dofs();
      const dealii::IndexSet all = dealii::complete_index_set(dofs.n_dofs());
      dealii::DynamicSparsityPattern pattern(dofs.n_dofs(), dofs.n_dofs(), all);
      dealii::DoFTools::make_sparsity_pattern(dofs, pattern,
                                              blocks_.constraints(), false);
      contact().add_to_sparsity(pattern);
      dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned,
                                                         MPI_COMM_WORLD, all);
      matrix.reinit(owned, owned, pattern, MPI_COMM_WORLD);
    }

    void add_stiffness(la::Matrix &matrix) const
    {
      const la::Matrix &stiffness = blocks_.stiffness();
      for (const auto row : stiffness.locally_owned_range_indices())
        for (auto entry = stiffness.begin(row); entry != stiffness.end(row);
             ++entry)
          matrix.add(row, entry->column(), entry->value());
      matrix.compress(dealii::VectorOperation::add);
    }

    hosts::TwoBlocks<dim> blocks_;
    la::Vector u_;
  };

  template <int dim>
  bool agrees(const std::string &law, const abut_discretisation way,
              const double aside)
  {
    hosts::Case run;
    run.method = hosts::method(law, way);
    run.aside = aside;
    run.method.segments = way != ABUT_DISCRETISATION_QUADRATURE_POINT;
    run.name = std::to_string(dim) + "D, " + law + ", "
               + discretisation_name(way) + (aside == all ? ", slides" : "");
    Blocks<dim> solved(run), added(run);
    solved.solve();
    added.add();
    la::Vector difference(added.solution());
    difference -= solved.solution();
    const double error =
        difference.linfty_norm() / solved.solution().linfty_norm();
    const PairResult<dim> result = added.contact().results().pairs()[0];
    if (hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << run.name << ": " << result.n_slipping << " of "
                << result.n_active << " slip, T/N "
                << result.friction_force / result.normal_force
                << ", difference " << error << std::endl;
    bool good = true;
    const auto check =
        [&](const double value, const double bound, const char *const what)
    { good = hosts::is_at_most(value, bound, run.name + ": " + what) && good; };
    check(added.contact().iteration().reason == ABUT_REASON_CONVERGED ? 0. : 1.,
          0., "failure to converge");
    check(error, 1e-8, "difference of the displacements");
    check(result.n_slipping > 0 ? 0. : 1., 0., "lack of slip");
    if (aside == all)
      check(std::abs(result.friction_force / (mu * result.normal_force) - 1.),
            1e-9, "friction other than mu times the pressure");
    else
      check(result.n_slipping < result.n_active ? 0. : 1., 0., "lack of stick");
    return good;
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool good = true;
  good = agrees<2>("penalty", ABUT_DISCRETISATION_DUAL_MORTAR, some) && good;
  for (const std::string law : {"quadratic penalty", "augmented lagrangian"})
    good = agrees<2>(law, ABUT_DISCRETISATION_DUAL_MORTAR, all) && good;
  good =
      agrees<2>("penalty", ABUT_DISCRETISATION_QUADRATURE_POINT, some) && good;
  good = agrees<3>("penalty", ABUT_DISCRETISATION_DUAL_MORTAR, some) && good;
  return good ? 0 : 1;
}
