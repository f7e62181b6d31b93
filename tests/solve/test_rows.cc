// SPDX-License-Identifier: LGPL-2.1-or-later
// Random rows, with columns of other ranks, against a dense solution: every
// back-end, every kind of law, ranks without rows or without unknowns.
#include "../app_blocks/run_checks.h"
#include "../hosts/jacobi_host.h"
#include "dense_problem.h"
#include "solve/gap_substitution.h"
#include "solve/make_row_solver.h"
#include "solve/preconditioner_keeper.h"
#include "solve/row_stiffness.h"

using namespace abut;
using namespace abut::tests;
using app::Expect;

namespace
{
  const MPI_Comm communicator = MPI_COMM_WORLD;

  enum class Laws
  {
    hard,    ///< constraints and open rows
    penalty, ///< penalties and open rows
    mixed,   ///< constraints, penalties, interior points and open rows
    interior ///< slopes over many orders of magnitude
  };

  enum class Shape
  {
    own_unknown, ///< each row has an unknown that no other touches
    overlapping, ///< all unknowns of a row occur in others
    nodal        ///< one owned unknown, different ones
  };

  const std::map<Laws, std::string> law_names = {{Laws::hard, "hard"},
                                                 {Laws::penalty, "penalty"},
                                                 {Laws::mixed, "mixed"},
                                                 {Laws::interior, "interior"}};
  const std::map<Shape, std::string> shape_names = {
      {Shape::own_unknown, "own unknown"},
      {Shape::overlapping, "overlapping"},
      {Shape::nodal, "nodal"}};

  /** Partitions of the unknowns; in the last two a rank has nothing. */
  std::vector<std::vector<int>> partitions()
  {
    switch (dealii::Utilities::MPI::n_mpi_processes(communicator))
    {
    case 1:
      return {{60}};
    case 2:
      return {{31, 29}, {60, 0}, {0, 60}};
    default:
      return {{20, 23, 17}, {25, 0, 35}, {0, 40, 20}};
    }
  }

  int owner(const Problem &problem, int unknown)
  {
    int rank = 0;
    while (unknown >= problem.n_owned[rank])
      unknown -= problem.n_owned[rank++];
    return rank;
  }

  /** Rows at every fourth unknown, which other rows touch or not. */
  void add_rows(Problem &problem, const Shape shape, std::mt19937 &random)
  {
    const int n = problem.size();
    std::uniform_real_distribution<double> uniform(0.2, 1.);
    std::uniform_int_distribution<int> any(0, n / 4 - 1);
    std::uniform_int_distribution<int> rank(
        0, static_cast<int>(problem.n_owned.size()) - 1);
    for (int i = 0; i < n; i += 4)
    {
      Row row;
      // Rows on single unknowns belong to the owner.
      row.rank = shape == Shape::overlapping ? rank(random) : owner(problem, i);
      row.weight = uniform(random);
      row.entries[i] = uniform(random);
      if (shape != Shape::nodal)
        for (int k = 0; k < 3; ++k)
          row.entries[4 * any(random) + (k == 0 ? 1 : 2)] = -uniform(random);
      if (shape == Shape::overlapping && i > 0)
        row.entries[i - 4] = -0.3 * uniform(random);
      if (shape == Shape::overlapping && i + 4 < n)
        row.entries[i + 4] = -0.3 * uniform(random);
      problem.rows.push_back(row);
    }
  }

  void set_laws(Problem &problem, const Laws laws, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> uniform(0.2, 1.);
    int k = static_cast<int>(random() % 4);
    for (Row &row : problem.rows)
    {
      row.pressure = uniform(random);
      row.c = uniform(random) - 0.6;
      const int kind = k++ % 4;
      row.a = 1.;
      row.b = 0.;
      if (laws == Laws::interior)
      {
        row.a = std::pow(10., -3. + 2. * kind) * uniform(random);
        row.b = std::pow(10., 3. - 2. * kind) * uniform(random);
      }
      else if (kind == 0 || (laws == Laws::hard && kind == 1))
      {
        row.b = 1.;
        row.a = laws == Laws::penalty ? 0.02 : 0.;
      }
      else if (kind == 1 || (laws == Laws::mixed && kind == 2))
      {
        row.a = 0.1 * uniform(random);
        row.b = 1.;
      }
    }
  }

  void operators()
  {
    for (const std::vector<int> &partition : partitions())
    {
      std::mt19937 random(3);
      Problem problem = make_problem(partition, 5);
      add_rows(problem, Shape::overlapping, random);
      Share share(problem, communicator);
      const solve::PointOperator rows(share.owned, share.view, share.nodes,
                                      communicator);

      la::Vector u(share.owned, communicator);
      for (int i = 0; i < share.n; ++i)
        la::data(u)[i] = std::sin(1. + share.first + i);
      std::vector<double> dg(rows.n_rows()), factor(rows.n_rows());
      rows.times(u, dg.data());
      for (int i = 0; i < rows.n_rows(); ++i)
      {
        double expected = 0.;
        for (const auto &[j, value] : problem.rows[share.number[i]].entries)
          expected += value * std::sin(1. + j);
        Expect::near(dg[i], expected, 1e-13, "B u");
        factor[i] = std::cos(1. + share.number[i]);
      }
      la::Vector force(u), squares(u);
      rows.add_transposed(factor.data(), force);
      rows.add_squares(factor.data(), squares);
      for (int i = 0; i < share.n; ++i)
      {
        double expected[2] = {la::data(u)[i], la::data(u)[i]};
        for (std::size_t k = 0; k < problem.rows.size(); ++k)
        {
          const auto &entries = problem.rows[k].entries;
          const auto found = entries.find(share.first + i);
          const double b = found == entries.end() ? 0. : found->second;
          expected[0] += std::cos(1. + k) * b;
          expected[1] += std::cos(1. + k) * b * b;
        }
        Expect::near(la::data(force)[i], expected[0], 1e-13, "B^T f");
        Expect::near(la::data(squares)[i], expected[1], 1e-13, "diagonal");
      }
    }
  }

  /** Rows of gaps that change by more than their rows say: by unknowns of all
   * ranks and, two by two, by each other's. */
  std::vector<std::map<std::int64_t, double>>
  rest_of_gaps(const Problem &problem, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> uniform(-0.3, 0.3);
    std::uniform_int_distribution<int> any(0, problem.size() / 4 - 1);
    std::vector<std::map<std::int64_t, double>> result;
    for (std::size_t k = 0; k < problem.rows.size(); ++k)
    {
      const std::size_t other = k % 2 == 0 ? k + 1 : k - 1;
      result.emplace_back();
      if (k % 5 == 4)
        continue;
      for (const int j : {4 * any(random) + 1, 4 * any(random) + 3})
        result[k][j] = uniform(random);
      const double own = 0.5 * uniform(random);
      result[k][4 * k] = own * problem.rows[k].entries.at(4 * k);
      if (other < problem.rows.size()
          && problem.rows[other].rank == problem.rows[k].rank)
        result[k][4 * other] = uniform(random);
    }
    return result;
  }

  void substitutions()
  {
    for (const std::vector<int> &partition : partitions())
    {
      std::mt19937 random(5);
      Problem problem = make_problem(partition, 5);
      add_rows(problem, Shape::own_unknown, random);
      const auto rest = rest_of_gaps(problem, random);
      Share share(problem, communicator);
      const solve::PointOperator rows(share.owned, share.view, share.nodes,
                                      communicator);
      std::vector<solve::GapLine> lines(rows.n_rows());
      for (int i = 0; i < rows.n_rows(); ++i)
      {
        lines[i].row = i;
        lines[i].own.push_back(4 * share.number[i]);
        for (const auto &[j, value] : rest[share.number[i]])
        {
          lines[i].column.push_back(j);
          lines[i].value.push_back(value);
        }
      }
      const solve::GapSubstitution substitution(rows, lines);

      la::Vector v(share.owned, communicator);
      for (int i = 0; i < share.n; ++i)
        la::data(v)[i] = std::sin(1. + share.first + i);
      la::Vector u(v), way(v), forces(v), expected(v);
      substitution.apply(u);
      way = u;
      way -= v;
      const solve::MatrixLines product = substitution.product(share.matrix);
      la::assemble(share.owned, dealii::IndexSet(share.owned.size()),
                   communicator,
                   [&](const auto &visit) { product.for_each(visit); })
          .vmult(forces, v);
      share.matrix.vmult(expected, way);
      expected -= forces;
      Expect::near(expected.linfty_norm(), 0., 1e-13, "K Z");
      Expect::that(way.linfty_norm() > 0.1, "the substitution does something");
      std::vector<double> all(problem.size(), 0.);
      std::copy_n(la::data(u), share.n, all.begin() + share.first);
      dealii::Utilities::MPI::sum(all, communicator, all);
      for (int i = 0; i < rows.n_rows(); ++i)
      {
        double difference = 0.;
        for (const auto &[j, value] : problem.rows[share.number[i]].entries)
          difference += value * (all[j] - std::sin(1. + j));
        for (const auto &[j, value] : rest[share.number[i]])
          difference += value * all[j];
        Expect::near(difference, 0., 1e-13, "C u = B v");
      }
    }
  }

  /** @p dp_tolerance: pressures of springs 1e6 times stiffer than the matrix
   * come out of a gap with 6 digits less. */
  void compare(solve::RowSolver &solver, const Problem &problem, Share &share,
               const double dp_tolerance, const std::string &what)
  {
    const LinearReport report = solver.solve(
        share.residual, share.request(1e-13), 1e-14, share.increment);
    const Difference error = difference(problem, share, communicator);
    Expect::near(error.du, 0., 1e-10, what + ": du");
    Expect::near(error.dp, 0., dp_tolerance, what + ": dp");
    Expect::near(error.dg, 0., 1e-10, what + ": dg");
    Expect::that(report.n_iterations < 200, what + ": iterations");
  }

  void policy()
  {
    using solve::PreconditionerKeeper;
    PreconditionerKeeper keeper(0.5);
    Expect::that(keeper.must_build(), "nothing is built at first");
    keeper.record_reuse();
    Expect::that(!keeper.is_kept(), "nothing is kept at first");
    keeper.record_build();
    keeper.record_speed(4., 8);
    Expect::that(keeper.patience() == 44, "patience after 8 iterations");
    Expect::that(!keeper.must_build() && !keeper.is_kept(), "new");
    keeper.record_reuse();
    keeper.record_speed(4., 16);
    Expect::that(!keeper.must_build() && keeper.is_kept(), "half as fast");
    keeper.record_speed(4., 17);
    Expect::that(keeper.must_build(), "less than half as fast");
    keeper.record_build();
    Expect::that(!keeper.must_build() && !keeper.is_kept(), "built anew");
    keeper.forget();
    Expect::that(keeper.must_build(), "forgotten");

    PreconditionerKeeper never = PreconditionerKeeper::never();
    never.record_build();
    Expect::that(never.must_build(), "some keep nothing");

    for (const double factor : {2.9, 3.1})
      for (const double ratio : {factor, 1. / factor})
        Expect::that(PreconditionerKeeper::is_change(ratio, false)
                         == (factor > 3.),
                     "a spring changes by a factor of 3");
    Expect::that(PreconditionerKeeper::is_change(1.001, true)
                     && !PreconditionerKeeper::is_change(1., true),
                 "a factorisation is exact");
    const unsigned int me =
        dealii::Utilities::MPI::this_mpi_process(communicator);
    for (const double first : {8., 9.})
      Expect::that(PreconditionerKeeper::are_too_many(me == 0 ? first : 8.,
                                                      100., false, communicator)
                       == (first > 8.),
                   "8 % may change, over all ranks");
    Expect::that(PreconditionerKeeper::are_too_many(me == 0 ? 1. : 0., 100.,
                                                    true, communicator),
                 "one change spoils a factorisation, on all ranks");
  }

  /** K with unknowns of other units: another matrix of the same pattern. */
  void scale_unknowns(Problem &problem)
  {
    const auto scale = [](const int i) { return 1. + 0.2 * std::sin(i); };
    for (int i = 0; i < problem.size(); ++i)
      for (int j = 0; j < problem.size(); ++j)
        problem.stiffness(i, j) *= scale(i) * scale(j);
  }

  /** Every back-end solves four systems in a row that differ in their laws,
   * the last two also in their matrix, so that what it keeps from one to the
   * next is checked too. */
  void solvers()
  {
    for (const std::vector<int> &partition : partitions())
      for (const auto &[shape, shape_name] : shape_names)
        for (const auto &[laws, law_name] : law_names)
          for (const System system : {System::automatic, System::saddle_point})
            for (const auto linear : {SolverParameters::Linear::iterative,
                                      SolverParameters::Linear::direct})
            {
              if (laws == Laws::interior && system == System::saddle_point)
                continue;
              std::mt19937 random(7);
              Problem problem = make_problem(partition, 11);
              add_rows(problem, shape, random);
              set_laws(problem, laws, random);
              Share share(problem, communicator);
              SolverParameters parameters;
              parameters.linear = linear;
              const solve::PointOperator rows(share.owned, share.view,
                                              share.nodes, communicator);
              const auto solver =
                  solve::make_row_solver(system, parameters, rows);
              solver->reinit(share.matrix, rows,
                             solve::row_stiffness(share.matrix, rows));
              for (int repetition = 0; repetition < 4; ++repetition)
              {
                std::ostringstream what;
                what << shape_name << " rows, " << law_name << " laws, "
                     << (system == System::automatic ? "auto" : "saddle point")
                     << (linear == SolverParameters::Linear::direct
                             ? ", direct, "
                             : ", iterative, ")
                     << partition[0] << " unknowns on rank 0, solve "
                     << repetition;
                try
                {
                  compare(*solver, problem, share,
                          laws == Laws::interior ? 1e-9 : 1e-10, what.str());
                }
                catch (const std::exception &error)
                {
                  Expect::that(false, what.str() + ": " + error.what());
                }
                set_laws(problem, laws, random);
                share.set_laws(problem);
                if (repetition == 0)
                  continue;
                scale_unknowns(problem);
                share.set_matrix(problem);
                solver->renew(share.matrix, rows,
                              solve::row_stiffness(share.matrix, rows));
              }
            }
  }
  /** What may be wrong with a host, and what it is told. */
  class Host : public JacobiHost
  {
  public:
    using JacobiHost::JacobiHost;

    void diagonal(la::Vector &result) const override
    {
      JacobiHost::diagonal(result);
      result *= factor;
    }

    void precondition(la::Vector &dst, const la::Vector &src) const override
    {
      JacobiHost::precondition(dst, src);
      for (int i = 1; is_lopsided && i < la::n_owned(src); ++i)
        la::data(dst)[i] += 0.3 * la::data(src)[i - 1];
    }

    void constrain(const std::vector<std::uint8_t> &now) override
    {
      held = now;
    }

    double factor = 1.;       ///< of the diagonal, which is wrong then
    bool is_lopsided = false; ///< the preconditioner
    std::vector<std::uint8_t> held;
  };

  /** Pivots that rows of single unknowns hold are told, and no others. */
  void check_held(const Host &host, const Problem &problem, const Share &share,
                  const Shape shape)
  {
    bool right = true;
    std::vector<std::uint8_t> expected(share.n, 0);
    for (const Row &row : problem.rows)
      for (const auto &[j, value] : row.entries)
        if (shape == Shape::nodal && row.a == 0. && row.b != 0.
            && j >= share.first && j < share.first + share.n)
          expected[j - share.first] = 1;
    for (int i = 0; i < share.n; ++i)
      right = right && host.held[i] == expected[i];
    Expect::that(right, shape_names.at(shape) + " rows: what is held");
  }

  /** Without a matrix: three systems in a row with other laws, the last two
   * also with another K. */
  void hosts()
  {
    for (const std::vector<int> &partition : partitions())
      for (const Shape shape : {Shape::own_unknown, Shape::nodal})
        for (const auto &[laws, law_name] : law_names)
        {
          std::mt19937 random(7);
          Problem problem = make_problem(partition, 11);
          add_rows(problem, shape, random);
          set_laws(problem, laws, random);
          Share share(problem, communicator);
          const solve::PointOperator rows(share.owned, share.view, share.nodes,
                                          communicator);
          Host host(share.matrix);
          const solve::Stiffness stiffness(host, share.owned, communicator);
          const auto solver = solve::make_row_solver(
              System::automatic, SolverParameters(), rows, false);
          solver->reinit(stiffness, rows,
                         solve::row_stiffness(stiffness, rows));
          for (int repetition = 0; repetition < 3; ++repetition)
          {
            const std::string what = shape_names.at(shape) + " rows, "
                                     + law_name
                                     + " laws, without a matrix, solve "
                                     + std::to_string(repetition);
            compare(*solver, problem, share,
                    laws == Laws::interior ? 1e-9 : 1e-10, what);
            check_held(host, problem, share, shape);
            set_laws(problem, laws, random);
            share.set_laws(problem);
            scale_unknowns(problem);
            share.set_matrix(problem);
            solver->renew(stiffness, rows,
                          solve::row_stiffness(stiffness, rows));
          }
        }
  }

  template <typename Error, typename Function>
  void expect_error(const std::string &words, const Function &function)
  {
    std::string message = "nothing was thrown";
    try
    {
      function();
    }
    catch (const Error &error)
    {
      message = error.what();
    }
    Expect::that(message.find(words) != std::string::npos,
                 "'" + words + "' is said, not: " + message);
  }

  /** What a host has got wrong is told. */
  void hosts_at_fault()
  {
    std::mt19937 random(7);
    Problem problem = make_problem(partitions()[0], 11);
    add_rows(problem, Shape::own_unknown, random);
    set_laws(problem, Laws::hard, random);
    Share share(problem, communicator);
    const solve::PointOperator rows(share.owned, share.view, share.nodes,
                                    communicator);
    SolverParameters parameters;
    parameters.max_iterations = 2;
    solve::NearNullSpace space;
    const auto solve_with = [&](Host &host)
    {
      const solve::Stiffness stiffness(host, share.owned, communicator);
      const auto solver =
          solve::make_row_solver(System::automatic, parameters, rows, false);
      solver->set_near_null_space(space);
      solver->reinit(stiffness, rows, solve::row_stiffness(share.matrix, rows));
      solver->solve(share.residual, share.request(1e-13), 1e-14,
                    share.increment);
    };
    Host host(share.matrix);
    expect_error<SolverFailure>("ended after 2 iterations",
                                [&] { solve_with(host); });
    host.is_lopsided = true;
    expect_error<SolverFailure>("precondition() is not symmetric",
                                [&] { solve_with(host); });
    host.is_lopsided = false;
    host.factor = 2.;
    expect_error<std::invalid_argument>("where vmult() of its unit vector",
                                        [&] { solve_with(host); });
    host.factor = -1.;
    expect_error<std::invalid_argument>("must be positive",
                                        [&] { solve_with(host); });
    // No row and column is only its diagonal.
    host.factor = 1.;
    space.prescribed.change().assign(share.n, 0);
    if (share.n > 0)
      space.prescribed.change()[0] = 1;
    expect_error<std::invalid_argument>("displacements of prescribed ones",
                                        [&] { solve_with(host); });
  }

  /** A saddle point needs a matrix. */
  void hosts_of_saddle_points()
  {
    std::mt19937 random(7);
    Problem problem = make_problem(partitions()[0], 11);
    add_rows(problem, Shape::overlapping, random);
    set_laws(problem, Laws::hard, random);
    for (Row &row : problem.rows)
    {
      row.a = 0.;
      row.b = 1.;
    }
    Share share(problem, communicator);
    const solve::PointOperator rows(share.owned, share.view, share.nodes,
                                    communicator);
    Host host(share.matrix);
    const solve::Stiffness stiffness(host, share.owned, communicator);
    const auto solver = solve::make_row_solver(System::automatic,
                                               SolverParameters(), rows, false);
    solver->reinit(stiffness, rows, solve::row_stiffness(stiffness, rows));
    expect_error<SolverFailure>("needs a matrix",
                                [&]
                                {
                                  solver->solve(share.residual,
                                                share.request(1e-13), 1e-14,
                                                share.increment);
                                });
  }
} // namespace

int
main(int argc, char **argv)
{
  return app::run_checks(argc, argv,
                         [](const std::filesystem::path &)
                         {
                           operators();
                           substitutions();
                           policy();
                           solvers();
                           hosts();
                           hosts_at_fault();
                           hosts_of_saddle_points();
                         });
}
