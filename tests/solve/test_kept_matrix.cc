// SPDX-License-Identifier: LGPL-2.1-or-later
// Sums of random matrices and lines in a pattern that is kept, against dense
// sums. Rows may be empty but for their diagonal, ranks without rows and lines,
// and lines in the rows of other ranks; patterns change from sum to sum.
#include "solve/kept_matrix.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <random>

using namespace abut;
namespace mpi = dealii::Utilities::MPI;

namespace
{
  using Index = solve::MatrixLines::Index;
  using Dense = std::map<std::pair<Index, Index>, double>;

  constexpr Index n = 23;
  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    if (!holds)
      std::cout << "FAILED: " << what << std::endl;
    good = good && holds;
  }

  /** Rows of a rank: the last one of several has none. */
  dealii::IndexSet own_rows()
  {
    const unsigned int rank = mpi::this_mpi_process(MPI_COMM_WORLD),
                       ranks = mpi::n_mpi_processes(MPI_COMM_WORLD),
                       parts = std::max(1u, ranks - 1);
    dealii::IndexSet result(n);
    if (rank < parts)
      result.add_range(n * rank / parts, n * (rank + 1) / parts);
    return result;
  }

  /** Lines with the same numbers on all ranks, each taken by one of them. */
  solve::MatrixLines draw(std::mt19937 &random, const int n_lines,
                          const bool of_own_rows, Dense &sum)
  {
    const unsigned int ranks = mpi::n_mpi_processes(MPI_COMM_WORLD);
    const dealii::IndexSet owned = own_rows();
    solve::MatrixLines result;
    for (int line = 0; line < n_lines; ++line)
    {
      const Index row = random() % n;
      std::vector<Index> columns;
      std::vector<double> values;
      for (auto k = random() % 6; k > 0; --k)
      {
        columns.push_back(random() % n);
        values.push_back(static_cast<double>(random() % 1000) - 500.);
        sum[{row, columns.back()}] += values.back();
      }
      const bool is_mine =
          of_own_rows
              ? owned.is_element(row)
              : random() % ranks == mpi::this_mpi_process(MPI_COMM_WORLD);
      if (of_own_rows)
        random();
      if (is_mine)
        result.add(row, columns, values);
    }
    return result;
  }

  la::Matrix draw_matrix(std::mt19937 &random, Dense &sum)
  {
    solve::MatrixLines lines = draw(random, 30, true, sum);
    for (Index i = 0; i < n; ++i)
    {
      sum[{i, i}] += 1.;
      if (own_rows().is_element(i))
        lines.add(i, {i}, {1.});
    }
    return la::assemble(own_rows(), dealii::IndexSet(n), MPI_COMM_WORLD,
                        [&](const auto &visit) { lines.for_each(visit); });
  }

  /** The largest difference of a row's entries, none of which may be missing.
   */
  double difference(const la::Matrix &matrix, const Dense &sum)
  {
    const la::LocalRows rows = la::local_rows(matrix);
    double result = 0.;
    Dense own;
    for (int i = 0; i < rows.n_rows; ++i)
      for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
        own[{la::global_column(matrix, i),
             la::global_column(matrix, rows.column[k])}] += rows.value[k];
    for (const auto &[at, value] : sum)
      if (own_rows().is_element(at.first))
        result = std::max(result, std::abs(value - own[at]));
    for (const auto &[at, value] : own)
      if (sum.count(at) == 0)
        result = std::max(result, std::abs(value));
    return result;
  }

  /** Sums of matrices and lines whose patterns change. */
  void random_sums()
  {
    std::mt19937 random(1);
    solve::KeptMatrix kept;
    for (int trial = 0; trial < 40; ++trial)
    {
      Dense sum;
      kept.set(draw_matrix(random, sum));
      expect(difference(kept.matrix(), sum) == 0., "a matrix");
      for (int part = 0; part < 3; ++part)
      {
        kept.add(draw(random, 8, false, sum));
        expect(difference(kept.matrix(), sum) == 0., "a sum");
      }
    }
  }

  /** A sum that is made twice has the same pattern the second time, and so has
   * a part of it. */
  void kept_patterns()
  {
    std::mt19937 random(2);
    Dense sum, part;
    const la::Matrix matrix = draw_matrix(random, sum);
    part = sum;
    const solve::MatrixLines lines = draw(random, 20, false, sum);
    solve::KeptMatrix kept;
    kept.set(matrix);
    const unsigned int first = kept.pattern();
    kept.add(lines);
    const unsigned int second = kept.pattern();
    expect(second != first, "lines beside a pattern change it");
    kept.set(matrix);
    expect(difference(kept.matrix(), part) == 0., "a part of a sum");
    kept.add(lines);
    expect(kept.pattern() == second, "the same sum has the same pattern");
    expect(difference(kept.matrix(), sum) == 0., "the same sum again");
  }
} // namespace

int
main(int argc, char **argv)
{
  const mpi::MPI_InitFinalize init(argc, argv, 1);
  random_sums();
  kept_patterns();
  return mpi::logical_or(!good, MPI_COMM_WORLD) ? 1 : 0;
}
