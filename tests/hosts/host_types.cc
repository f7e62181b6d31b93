// SPDX-License-Identifier: LGPL-2.1-or-later
// The same contact problem through each kind of matrix and vector that a host
// may have, by the same lines; and what is refused. One set of values goes into
// all of them; the answers of other types are compared with those of Abut's
// own.
#include "elastic_blocks.h"
#include "expect.h"

#include <abut/dealii/contact_solver.h>

#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/lac/block_sparse_matrix.h>
#include <deal.II/lac/block_vector.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>
#include <deal.II/lac/vector.h>
#ifdef DEAL_II_WITH_PETSC
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>
#endif

#include <iostream>
#include <limits>
#include <string>

using namespace abut;
using dealii::types::global_dof_index;

namespace
{
  constexpr int dim = 2;
  using Blocks = hosts::ElasticBlocks<dim>;
  using Serial = dealii::Vector<double>;
  using Distributed = dealii::LinearAlgebra::distributed::Vector<double>;

  bool all_good = true;

  void note(const std::string &name, const double error, const double tolerance)
  {
    const bool good = error <= tolerance;
    all_good = all_good && good;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << (good ? "" : "FAILED: ") << name << ": " << error
                << ", at most " << tolerance << std::endl;
  }

  /** The problem as Abut's own types have it: matrix u = rhs. */
  struct Problem
  {
    Problem(const bool by_component, const bool add)
        : blocks(hosts::BlockCase{1, 2, {2, 3}, {{1., 1.}, {3., 2.}}})
    {
      if (by_component)
        dealii::DoFRenumbering::component_wise(blocks.dof_handler);
      blocks.move(hosts::block_side::top,
                  dealii::Tensor<1, dim>({0.02, -0.03}));
      blocks.assemble(matrix, rhs);
      ContactAssembler<dim> contact(MPI_COMM_WORLD);
      start(contact, add);
      contact.detect(blocks.start());
      // With places for what add() adds.
      const dealii::IndexSet &owned = blocks.dof_handler.locally_owned_dofs();
      pattern.reinit(owned.size(), owned.size(), blocks.relevant);
      dealii::DoFTools::make_sparsity_pattern(blocks.dof_handler, pattern,
                                              blocks.constraints, false);
      contact.add_to_sparsity(pattern);
      dealii::SparsityTools::distribute_sparsity_pattern(
          pattern, owned, MPI_COMM_WORLD, blocks.relevant);
      la::Matrix wider;
      wider.reinit(owned, owned, pattern, MPI_COMM_WORLD);
      copy_values(wider);
      la::copy(wider, matrix);
    }

    /** Pressed and pushed aside, with friction. */
    void set(ContactAssembler<dim> &contact, const bool add,
             const SolverParameters::Linear linear =
                 SolverParameters::Linear::direct) const
    {
      MethodParameters method;
      if (add)
        method.options.law = abut_law_find("penalty");
      SolverParameters solver;
      solver.linear = linear;
      contact.set_parameters(method, solver);
      ContactPair<dim> pair;
      pair.name = "blocks";
      pair.secondary = {hosts::block_side::lower_interface};
      pair.primary = {hosts::block_side::upper_interface};
      pair.friction = std::make_shared<Friction<dim>>(
          Friction<dim>{[](const dealii::Point<dim> &) { return 0.3; }, {}});
      contact.set_pairs({pair});
    }

    void start(ContactAssembler<dim> &contact, const bool add,
               const SolverParameters::Linear linear =
                   SolverParameters::Linear::direct) const
    {
      set(contact, add, linear);
      contact.reinit(blocks.mapping, blocks.dof_handler, blocks.constraints);
    }

    template <typename M> void copy_values(M &target) const
    {
      for (const global_dof_index i : blocks.dof_handler.locally_owned_dofs())
        for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
          target.set(i, entry->column(), entry->value());
      if constexpr (la::internal::Has<la::internal::Compressible, M>::value)
        target.compress(dealii::VectorOperation::insert);
    }

    Blocks blocks;
    dealii::DynamicSparsityPattern pattern;
    la::Matrix matrix;
    la::Vector rhs;
  };

  struct Answer
  {
    la::Vector u;
    dealii::Tensor<1, dim> force;
    unsigned int systems = 0;
  };

  template <typename M, typename V>
  void multiply(const M &K, V &product, const V &u)
  {
    K.vmult(product, u);
  }

  /** deal.II 9.8 has no product of a Tpetra matrix with these vectors. */
  void multiply(const la::Matrix &K, Distributed &product, const Distributed &u)
  {
    la::Vector of(u.locally_owned_elements(), MPI_COMM_WORLD), result(of);
    la::copy(u, of);
    K.vmult(result, of);
    la::copy(result, product);
  }

  template <typename M, typename V>
  void find_residual(const Problem &problem, const M &K, const V &rhs,
                     const V &u, V &R)
  {
    multiply(K, R, u);
    R -= rhs;
    problem.blocks.constraints.set_zero(R);
  }

  /** The lines of a host, the same for all types: from no displacement to
   * @p u, with the products of @p K; @p tangent is what contact is given. */
  template <typename M, typename Given, typename V>
  void iterate(const Problem &problem, ContactAssembler<dim> &contact,
               const M &K, Given &tangent, const V &rhs, V &u)
  {
    V R(rhs), du(rhs);
    la::copy(problem.blocks.start(), u);
    contact.detect(u);
    do
    {
      find_residual(problem, K, rhs, u, R);
      contact.solve(tangent, R, du);
      u += du;
      problem.blocks.constraints.distribute(u);
    } while (contact.update(u));
    AssertThrow(contact.iteration().reason == ABUT_REASON_CONVERGED,
                dealii::ExcMessage(contact.iteration().explanation));
  }

  template <typename M, typename V>
  Answer solve(const Problem &problem, const M &K, const V &rhs)
  {
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    problem.start(contact, false);
    V u(rhs), R(rhs), forces(rhs), pressure(rhs);
    iterate(problem, contact, K, K, rhs, u);
    find_residual(problem, K, rhs, u, R);
    forces = 0.;
    contact.results().add_forces(forces);
    forces -= R;
    note("contact forces", forces.l2_norm() / R.l2_norm(), 1e-10);
    note("balance", contact.checks().imbalance(R), 1e-10);
    note("examination", contact.checks().examine(u, R).imbalance, 1e-10);
    la::copy(contact.results().pressure(), pressure);
    contact.commit(u);
    return {contact.copy_of(la::VectorView(u)),
            contact.results().pairs()[0].secondary_force,
            contact.results().effort().linear.n_systems};
  }

  /** The same by the loop that comes with Abut. */
  template <typename M, typename V>
  Answer solve_by_newton(const Problem &problem, const M &K, const V &rhs)
  {
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    problem.start(contact, false);
    const V like(rhs);
    const HostProblem host = host_problem(
        like, [&](const V &u, V &R) { find_residual(problem, K, rhs, u, R); },
        [&](const V &) -> const M & { return K; });
    ContactSolver<dim> solver(contact, problem.blocks.constraints, host);
    V u(rhs);
    la::copy(problem.blocks.start(), u);
    const NewtonResult result = solver.solve(u);
    AssertThrow(result.converged(), dealii::ExcMessage(result.explanation));
    return {contact.copy_of(la::VectorView(u)),
            contact.results().pairs()[0].secondary_force, result.n_systems};
  }

  double distance(const Answer &a, const Answer &b)
  {
    la::Vector difference(a.u);
    difference -= b.u;
    return std::max(difference.linfty_norm() / b.u.linfty_norm(),
                    (a.force - b.force).norm() / b.force.norm());
  }

  /** All entries of a matrix and a vector after add(), as one of Abut's. */
  template <typename M, typename V>
  void compare_addition(const std::string &name, const Problem &problem, M &K,
                        const V &rhs)
  {
    la::Matrix reference;
    la::copy(problem.matrix, reference);
    la::Vector expected(problem.rhs);
    V found(rhs);
    for (const bool own : {true, false})
    {
      ContactAssembler<dim> contact(MPI_COMM_WORLD);
      problem.start(contact, true);
      V u(rhs);
      la::copy(problem.blocks.start(), u);
      contact.detect(u);
      if (own)
        contact.add(reference, expected);
      else
        contact.add(K, found);
    }
    double largest = 0., error = 0.;
    for (const global_dof_index i :
         problem.blocks.dof_handler.locally_owned_dofs())
      for (auto entry = reference.begin(i); entry != reference.end(i); ++entry)
      {
        largest = std::max(largest, std::abs(entry->value()));
        error = std::max(error,
                         std::abs(K.el(i, entry->column()) - entry->value()));
      }
    note(name + ": matrix of add()",
         dealii::Utilities::MPI::max(error / largest, MPI_COMM_WORLD), 1e-13);
    la::Vector residual(expected);
    la::copy(found, residual);
    residual -= expected;
    note(name + ": residual of add()",
         residual.linfty_norm() / expected.linfty_norm(), 1e-13);
    note(name + ": add() adds something", expected.linfty_norm() > 0. ? 0. : 1.,
         0.);
  }

  template <typename M, typename V>
  void compare(const std::string &name, const Problem &problem, M &K,
               const V &rhs)
  {
    const Answer expected = solve(problem, problem.matrix, problem.rhs);
    note(name + ": answer", distance(solve(problem, K, rhs), expected), 1e-10);
    note(name + ": answer by ContactSolver",
         distance(solve_by_newton(problem, K, rhs), expected), 1e-9);
  }

  /** That a call throws on all ranks, with these words in what it says. */
  template <typename Call>
  void refuses(const std::string &words, const Call &call)
  {
    std::string said = "nothing";
    try
    {
      call();
    }
    catch (const std::exception &error)
    {
      said = error.what();
    }
    const bool good = said.find(words) != std::string::npos;
    if (!good)
      std::cout << "FAILED: expected '" << words << "', but it said " << said
                << std::endl;
    all_good = all_good && good;
  }

  using Sparse = dealii::SparseMatrix<double>;

  void check_serial()
  {
    const Problem problem(false, true);
    dealii::SparsityPattern pattern;
    pattern.copy_from(problem.pattern);
    Sparse K(pattern);
    problem.copy_values(K);
    Serial rhs(problem.rhs.size());
    la::copy(problem.rhs, rhs);
    compare("SparseMatrix", problem, K, rhs);

    // A pattern that changes, and one that lacks what is needed.
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    problem.start(contact, false);
    Serial u(rhs), du(rhs);
    la::copy(problem.blocks.start(), u);
    contact.detect(u);
    dealii::SparsityPattern small(rhs.size(), rhs.size(), 1);
    small.compress();
    Sparse diagonal(small);
    for (unsigned int i = 0; i < rhs.size(); ++i)
      diagonal.set(i, i, K.diag_element(i));
    contact.solve(diagonal, rhs, du);
    note("a diagonal matrix solves", du.linfty_norm() > 0. ? 0. : 1., 0.);
    const double value = K(3, 3);
    K.set(3, 3, std::numeric_limits<double>::infinity());
    refuses("not finite in row 3", [&] { contact.solve(K, rhs, du); });
    K.set(3, 3, std::numeric_limits<double>::quiet_NaN());
    refuses("matrix given to solve()", [&] { contact.solve(K, rhs, du); });
    K.set(3, 3, value);
    const Serial longer(rhs.size() + 1), none;
    Serial nothing;
    refuses("increment given to solve() is of 0 unknowns",
            [&] { contact.solve(K, rhs, nothing); });
    refuses("residual given to solve() is of 0 unknowns",
            [&] { contact.solve(K, none, du); });
    refuses("displacement given to detect()", [&] { contact.detect(none); });
    const Sparse empty;
    refuses("matrix given to solve() is of 0 unknowns",
            [&] { contact.solve(empty, rhs, du); });
    // Boundary values that are not in the matrix.
    const auto eliminated =
        problem.blocks.constraints.get_lines().begin()->index;
    dealii::DynamicSparsityPattern wide(rhs.size());
    for (const auto &entry : problem.pattern)
      wide.add(entry.row(), entry.column());
    wide.add(eliminated, (eliminated + 1) % rhs.size());
    dealii::SparsityPattern compressed;
    compressed.copy_from(wide);
    Sparse coupled(compressed);
    problem.copy_values(coupled);
    coupled.set(eliminated, (eliminated + 1) % rhs.size(), 1.);
    refuses("off-diagonal entries", [&] { contact.solve(coupled, rhs, du); });
    refuses("in row " + std::to_string(eliminated) + ".",
            [&] { contact.solve(coupled, rhs, du); });
    refuses("residual given to solve()", [&] { contact.solve(K, longer, du); });
    refuses("displacement given to detect()", [&] { contact.detect(longer); });
    dealii::SparsityPattern other(rhs.size() + 1, rhs.size() + 1, 1);
    other.compress();
    const Sparse larger(other);
    refuses("matrix given to solve()", [&] { contact.solve(larger, rhs, du); });

    compare_addition("SparseMatrix", problem, K, rhs);
  }

  void check_blocks()
  {
    const Problem problem(true, true);
    const global_dof_index half = problem.rhs.size() / dim;
    dealii::BlockDynamicSparsityPattern pattern(dim, dim);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        pattern.block(i, j).reinit(half, half);
    pattern.collect_sizes();
    for (const auto &entry : problem.pattern)
      pattern.add(entry.row(), entry.column());
    dealii::BlockSparsityPattern compressed;
    compressed.copy_from(pattern);
    dealii::BlockSparseMatrix<double> K(compressed);
    problem.copy_values(K);
    dealii::BlockVector<double> rhs(dim, half);
    la::copy(problem.rhs, rhs);
    compare("BlockSparseMatrix", problem, K, rhs);
    compare_addition("BlockSparseMatrix", problem, K, rhs);
  }

  /** A value of the native type that is not finite, on the last rank. */
  void check_native()
  {
    const Problem problem(false, false);
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    problem.start(contact, false);
    la::Vector u(problem.blocks.start()), du(problem.rhs);
    contact.detect(u);
    la::Matrix K;
    K.reinit(problem.matrix);
    K.copy_from(problem.matrix);
    const global_dof_index last = K.m() - 1;
    for (const double value : {std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()})
    {
      if (K.in_local_range(last))
        K.set(last, last, value);
      K.compress(dealii::VectorOperation::insert);
      refuses("matrix given to solve() has a value that is not finite in row "
                  + std::to_string(last),
              [&] { contact.solve(K, problem.rhs, du); });
    }
    dealii::DynamicSparsityPattern pattern(K.m());
    for (global_dof_index i = 0; i < K.m(); ++i)
      pattern.add(i, i == last ? 0 : i);
    la::Matrix lacking;
    lacking.reinit(K.locally_owned_range_indices(), pattern, MPI_COMM_WORLD);
    refuses("diagonal", [&] { contact.solve(lacking, problem.rhs, du); });
  }

  /** An element with another field behind the displacement, of which the host
   * gives the displacement's block alone. */
  void check_displacement_block()
  {
    const Problem problem(false, false);
    const Answer expected = solve(problem, problem.matrix, problem.rhs);
    const Blocks &blocks = problem.blocks;
    const dealii::FESystem<dim> fe(dealii::FE_Q<dim>(1), dim,
                                   dealii::FE_DGQ<dim>(0), 1);
    dealii::DoFHandler<dim> dofs(blocks.triangulation);
    dofs.distribute_dofs(fe);
    dealii::DoFRenumbering::component_wise(dofs, {0, 0, 1});
    const dealii::ComponentMask displacement({true, true, false});
    dealii::AffineConstraints<double> constraints;
    for (const auto side : {hosts::block_side::bottom, hosts::block_side::top})
    {
      const bool is_top = side == hosts::block_side::top;
      dealii::VectorTools::interpolate_boundary_values(
          blocks.mapping, dofs, side,
          dealii::Functions::ConstantFunction<dim>(
              std::vector<double>{is_top ? 0.02 : 0., is_top ? -0.03 : 0., 0.}),
          constraints, displacement);
    }
    constraints.close();
    const unsigned int n = problem.rhs.size();
    dealii::DynamicSparsityPattern pattern(dofs.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dofs, pattern);
    dealii::DynamicSparsityPattern block(n);
    for (const auto &entry : pattern)
      if (entry.row() < n && entry.column() < n)
        block.add(entry.row(), entry.column());
    dealii::SparsityPattern compressed;
    compressed.copy_from(block);
    Sparse K(compressed);
    // The unknowns of both elements, by cell and place in it.
    std::vector<global_dof_index> mine(fe.n_dofs_per_cell()),
        theirs(blocks.fe.n_dofs_per_cell()), number(n);
    auto other = blocks.dof_handler.begin_active();
    for (const auto &cell : dofs.active_cell_iterators())
    {
      cell->get_dof_indices(mine);
      other->get_dof_indices(theirs);
      for (unsigned int i = 0; i < theirs.size(); ++i)
      {
        const auto at = blocks.fe.system_to_component_index(i);
        number[theirs[i]] =
            mine[fe.component_to_system_index(at.first, at.second)];
      }
      ++other;
    }
    Serial rhs(n), u(n), R(n), du(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      for (auto entry = problem.matrix.begin(i); entry != problem.matrix.end(i);
           ++entry)
        K.set(number[i], number[entry->column()], entry->value());
      rhs(number[i]) = problem.rhs(i);
      u(number[i]) = problem.blocks.start()(i);
    }
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    problem.set(contact, false);
    contact.reinit(blocks.mapping, dofs, constraints);
    contact.detect(u);
    do
    {
      K.vmult(R, u);
      R -= rhs;
      for (const auto &line : constraints.get_lines())
        R(line.index) = 0.;
      contact.solve(K, R, du);
      u += du;
    } while (contact.update(u));
    double error = 0.;
    for (unsigned int i = 0; i < n; ++i)
      error = std::max(error, std::abs(u(number[i]) - expected.u(i)));
    note("block of the displacement", error / expected.u.linfty_norm(), 1e-10);
    note("force by the block of the displacement",
         (contact.results().pairs()[0].secondary_force - expected.force).norm(),
         1e-10);
  }

  /** Products with distributed vectors, and Jacobi's preconditioner. */
  void check_operator()
  {
    const Problem problem(false, false);
    const Answer expected = solve(problem, problem.matrix, problem.rhs);
    const dealii::IndexSet &owned =
        problem.blocks.dof_handler.locally_owned_dofs();
    Distributed rhs(owned, MPI_COMM_WORLD);
    la::copy(problem.rhs, rhs);
    const auto diagonal = [&](Distributed &result)
    {
      for (const global_dof_index i : owned)
        result(i) = problem.matrix.diag_element(i);
    };
    HostOperatorOf<Distributed> K(
        rhs,
        [&](Distributed &dst, const Distributed &src)
        { multiply(problem.matrix, dst, src); },
        diagonal,
        [&](Distributed &dst, const Distributed &src)
        {
          diagonal(dst);
          for (const global_dof_index i : owned)
            dst(i) = src(i) / dst(i);
        });
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    problem.start(contact, false, SolverParameters::Linear::iterative);
    Distributed u(rhs);
    iterate(problem, contact, problem.matrix, K, rhs, u);
    note("products with distributed vectors",
         distance({contact.copy_of(la::VectorView(u)),
                   contact.results().pairs()[0].secondary_force, 0},
                  expected),
         1e-6);
  }

  void check_distributed()
  {
    const Problem problem(false, false);
    const dealii::IndexSet &owned =
        problem.blocks.dof_handler.locally_owned_dofs();
    Distributed rhs(owned, MPI_COMM_WORLD);
    la::copy(problem.rhs, rhs);
    compare("distributed::Vector", problem, problem.matrix, rhs);

    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    problem.start(contact, false);
    Distributed ghosted(owned, problem.blocks.relevant, MPI_COMM_WORLD);
    ghosted.update_ghost_values();
    refuses("displacement given to detect() has ghost entries",
            [&] { contact.detect(ghosted); });
    la::Vector own_ghosted(owned, problem.blocks.relevant, MPI_COMM_WORLD);
    const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    if (n_ranks == 1)
      return;
    refuses("displacement given to detect() has ghost entries",
            [&] { contact.detect(own_ghosted); });
    // All on the last rank.
    dealii::IndexSet last(owned.size());
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) + 1 == n_ranks)
      last.add_range(0, owned.size());
    const Distributed elsewhere(last, MPI_COMM_WORLD);
    refuses("displacement given to detect() is not distributed",
            [&] { contact.detect(elsewhere); });
    const Serial whole(owned.size());
    refuses("displacement given to detect() is not distributed",
            [&] { contact.detect(whole); });
    Distributed u(rhs), du(rhs);
    u = 0.;
    contact.detect(u);
    dealii::SparsityPattern pattern(owned.size(), owned.size(), 1);
    pattern.compress();
    const Sparse K(pattern);
    refuses("matrix given to solve() is not square, or its rows are not",
            [&] { contact.solve(K, u, du); });
  }

#ifdef DEAL_II_WITH_PETSC
  void check_petsc()
  {
    const Problem problem(false, true);
    const dealii::IndexSet &owned =
        problem.blocks.dof_handler.locally_owned_dofs();
    dealii::PETScWrappers::MPI::SparseMatrix K;
    K.reinit(owned, owned, problem.pattern, MPI_COMM_WORLD);
    problem.copy_values(K);
    dealii::PETScWrappers::MPI::Vector rhs(owned, MPI_COMM_WORLD);
    la::copy(problem.rhs, rhs);
    compare("PETSc", problem, K, rhs);

    // A row without a diagonal entry.
    dealii::DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
    for (const global_dof_index i : owned)
      pattern.add(i, i == 5 ? 6 : i);
    dealii::PETScWrappers::MPI::SparseMatrix lacking;
    lacking.reinit(owned, owned, pattern, MPI_COMM_WORLD);
    for (const global_dof_index i : owned)
      lacking.set(i, i == 5 ? 6 : i, 1.);
    lacking.compress(dealii::VectorOperation::insert);
    ContactAssembler<dim> contact(MPI_COMM_WORLD);
    problem.start(contact, false);
    dealii::PETScWrappers::MPI::Vector u(rhs);
    u = 0.;
    contact.detect(u);
    refuses("matrix given to solve() has no entry on the diagonal",
            [&] { contact.solve(lacking, rhs, u); });
    refuses("in row 5", [&] { contact.solve(lacking, rhs, u); });
    compare_addition("PETSc", problem, K, rhs);
  }
#endif
} // namespace

int
main(int argc, char **argv)
{
  refuses("dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);",
          [] { ContactAssembler<dim> contact(MPI_COMM_WORLD); });
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
  {
    check_serial();
    check_blocks();
    check_displacement_block();
  }
  check_native();
  check_distributed();
  check_operator();
#ifdef DEAL_II_WITH_PETSC
  check_petsc();
#endif
  return all_good ? 0 : 1;
}
