// SPDX-License-Identifier: LGPL-2.1-or-later
// Inf-sup constants: closed forms, dense references, and families of meshes
// with multipliers that are offered and with some that are not.
#include "../app_blocks/run_checks.h"
#include "dense_problem.h"
#include "inf_sup.h"
#include "two_blocks.h"

#include <deal.II/lac/lapack_full_matrix.h>

using namespace abut;
using namespace abut::tests;
using app::Expect;

namespace
{
  const MPI_Comm communicator = MPI_COMM_WORLD;
  constexpr double pi = 3.14159265358979323846;

  /** n unknowns over the ranks, the last of which may have less. */
  std::vector<int> spread(const int n)
  {
    const int ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    std::vector<int> owned(ranks, n / ranks);
    owned[0] += n % ranks;
    return owned;
  }

  Problem unconnected(const int n, const double stiffness)
  {
    Problem problem;
    problem.n_owned = spread(n);
    problem.residual.assign(n, 0.);
    problem.stiffness.reinit(n, n);
    for (int i = 0; i < n; ++i)
      problem.stiffness(i, i) = stiffness;
    return problem;
  }

  /** A string of n unknowns; free: not held at its ends. */
  Problem string(const int n, const bool is_free)
  {
    Problem problem = unconnected(n, 2.);
    for (int i = 0; i + 1 < n; ++i)
      problem.stiffness(i, i + 1) = problem.stiffness(i + 1, i) = -1.;
    if (is_free)
      problem.stiffness(0, 0) = problem.stiffness(n - 1, n - 1) = 1.;
    return problem;
  }

  void add_row(Problem &problem, const double weight,
               const std::map<std::int64_t, double> &entries)
  {
    Row row;
    row.rank = problem.rows.size()
               % dealii::Utilities::MPI::n_mpi_processes(communicator);
    row.weight = weight;
    row.entries = entries;
    problem.rows.push_back(row);
  }

  void add_nodal_rows(Problem &problem, const double weight)
  {
    for (int i = 0; i < problem.size(); ++i)
      add_row(problem, weight, {{i, 1.}});
  }

  double constant_of(const Problem &problem)
  {
    const Share share(problem, communicator);
    const solve::PointOperator rows(share.owned, share.view, share.nodes,
                                    communicator);
    return solve::inf_sup_constant(share.matrix, rows, SolverParameters(),
                                   solve::NearNullSpace())
        .constant;
  }

  void closed_forms()
  {
    for (const int n : {1, 2, 7, 40})
    {
      Problem nodal = unconnected(n, 7.);
      add_nodal_rows(nodal, 0.3);
      Expect::near(constant_of(nodal), 1., 1e-3, "unknowns of their own");

      // Means of two neighbours: the matrix with 1/2, 1, 1/2 along its
      // diagonals, whose smallest eigenvalue is 2 sin^2(pi/(2 (n+1))).
      Problem means = unconnected(n + 1, 7.);
      for (int i = 0; i < n; ++i)
        add_row(means, 0.3, {{i, 0.5}, {i + 1, 0.5}});
      const double expected = std::sqrt(2.) * std::sin(pi / (2. * (n + 1)));
      Expect::near(constant_of(means) / expected, 1., 1e-3,
                   "means of neighbours");

      // Twice the inverse of the string's matrix: its largest eigenvalue is
      // 2 + 2 cos(pi/(n+1)).
      Problem held = string(n, false);
      add_nodal_rows(held, 0.3);
      Expect::near(constant_of(held),
                   1. / std::sqrt(1. + std::cos(pi / (n + 1))), 1e-3,
                   "held string");
      if (n == 1)
        continue;

      // Scaled by its diagonal the matrix of a free string has the largest
      // eigenvalue 2, as that of any graph that has two colours.
      Problem loose = string(n, true);
      add_nodal_rows(loose, 0.3);
      Expect::near(constant_of(loose), std::sqrt(0.5), 1e-3, "free string");

      // What is there twice, and what has no unknown.
      held.rows.push_back(held.rows[n / 2]);
      Expect::near(constant_of(held), 0., 1e-3, "a row twice");
      add_row(loose, 0.3, {});
      Expect::near(constant_of(loose), std::sqrt(0.5), 1e-3, "an empty row");
    }
    Problem none = string(5, false);
    Expect::near(constant_of(none), 0., 0., "no rows");
  }

  /** The same by all eigenvalues of a dense matrix. */
  double dense_constant(const Problem &problem)
  {
    const unsigned int n = problem.size(), m = problem.rows.size();
    dealii::FullMatrix<double> inverse(problem.stiffness);
    inverse.gauss_jordan();
    dealii::FullMatrix<double> b(m, n);
    for (unsigned int i = 0; i < m; ++i)
    {
      double softness = 0.;
      for (const auto &[j, value] : problem.rows[i].entries)
        softness += value * value / problem.stiffness(j, j);
      for (const auto &[j, value] : problem.rows[i].entries)
        b(i, j) = value / std::sqrt(softness);
    }
    dealii::FullMatrix<double> product(m, n), schur(m, m);
    b.mmult(product, inverse);
    product.mTmult(schur, b);
    dealii::LAPACKFullMatrix<double> matrix(m, m);
    matrix = schur;
    dealii::Vector<double> values;
    dealii::FullMatrix<double> vectors;
    matrix.compute_eigenvalues_symmetric(-1., 1e12, 0., values, vectors);
    return std::sqrt(values[0]);
  }

  void random_rows()
  {
    for (unsigned int seed = 1; seed <= 8; ++seed)
    {
      Problem problem = make_problem(spread(60), seed);
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> uniform(-1., 1.);
      for (int i = 0; i < 20; ++i)
      {
        std::map<std::int64_t, double> entries;
        for (int k = 0; k < 4; ++k)
          entries[random() % 60] = uniform(random);
        add_row(problem, 0.1 + std::abs(uniform(random)), entries);
      }
      Expect::near(constant_of(problem) / dense_constant(problem), 1., 2e-3,
                   "random rows, seed " + std::to_string(seed));
    }
  }

  template <int dim> double blocks_constant(const TwoBlocksOptions &options)
  {
    const TwoBlocks<dim> blocks(communicator, options);
    return solve::inf_sup_constant(blocks.stiffness, blocks.operation,
                                   SolverParameters(), blocks.space)
        .constant;
  }

  /** Refined meshes: constants of multipliers that are offered stay, those of
   * constants per facet that match on both sides fall like h. */
  void families()
  {
    std::vector<double> last(3, 0.);
    for (unsigned int level = 1; level <= 4; ++level)
    {
      TwoBlocksOptions options;
      options.refinements = level;
      const auto now = [&](const abut_discretisation discretisation)
      {
        options.discretisation = discretisation;
        return blocks_constant<2>(options);
      };
      std::vector<double> present = {now(ABUT_DISCRETISATION_DUAL_MORTAR),
                                     now(ABUT_DISCRETISATION_MORTAR)};
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      {
        options.constants = true;
        options.n_upper = options.n_lower;
        present.push_back(blocks_constant<2>(options));
      }
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        std::cout << "level " << level << ':';
        for (const double value : present)
          std::cout << ' ' << value;
        std::cout << std::endl;
      }
      for (std::size_t i = 0; i < present.size() && level > 1; ++i)
        Expect::near(present[i] / last[i], i < 2 ? 1. : 0.5, 0.1,
                     "refined, case " + std::to_string(i));
      for (const std::size_t i : {0, 1})
        Expect::that(present[i] > 0.3,
                     "constant " + std::to_string(present[i]));
      last = present;
    }
  }

  /** A block that neither supports nor rows hold sideways. */
  void floating()
  {
    TwoBlocksOptions options;
    options.support = TwoBlocksOptions::Support::free;
    std::string message;
    try
    {
      blocks_constant<2>(options);
    }
    catch (const SolverFailure &error)
    {
      message = error.what();
    }
    Expect::that(message.find("upper block") != message.npos,
                 "a block that slides: " + message);
    options.support = TwoBlocksOptions::Support::slide;
    Expect::that(blocks_constant<2>(options) > 0.3, "held by its rows");
  }
} // namespace

int
main(int argc, char **argv)
{
  return app::run_checks(argc, argv,
                         [](const std::filesystem::path &)
                         {
                           closed_forms();
                           random_rows();
                           families();
                           floating();
                         });
}
