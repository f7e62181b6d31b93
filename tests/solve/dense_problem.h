// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_DENSE_PROBLEM_H
#define ABUT_TESTS_DENSE_PROBLEM_H

/** @file
 * A small linearised contact problem that every rank knows as a whole: a
 * dense solution to compare with, and each rank's share for the solvers.
 */

#include "row_laws.h"
#include "solve/node_map.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/points.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace abut::tests
{
  /** One row with its linearised law a dp + b dg = -c. */
  struct Row
  {
    unsigned int rank = 0; ///< where it is stored
    double weight = 1.;
    std::map<std::int64_t, double> entries;
    double a = 0., b = 0., c = 0., pressure = 0.;
  };

  /** K, R and rows. */
  struct Problem
  {
    dealii::FullMatrix<double> stiffness;
    std::vector<double> residual;
    std::vector<Row> rows;
    std::vector<int> n_owned; ///< [ranks] unknowns of each rank

    int size() const
    {
      return static_cast<int>(residual.size());
    }
  };

  /** du and dp of a problem by elimination with pivoting of the whole:
   *     K du - B^T W dp = -R + B^T W p,   a dp + b B du = -c. */
  inline void solve_densely(const Problem &problem, std::vector<double> &du,
                            std::vector<double> &dp)
  {
    const int n = problem.size();
    const int m = static_cast<int>(problem.rows.size());
    dealii::FullMatrix<double> matrix(n + m, n + m);
    dealii::Vector<double> right(n + m), solution(n + m);
    for (int i = 0; i < n; ++i)
    {
      right(i) = -problem.residual[i];
      for (int j = 0; j < n; ++j)
        matrix(i, j) = problem.stiffness(i, j);
    }
    for (int k = 0; k < m; ++k)
    {
      const Row &row = problem.rows[k];
      for (const auto &[j, value] : row.entries)
      {
        matrix(j, n + k) -= row.weight * value;
        matrix(n + k, j) += row.b * value;
        right(j) += row.weight * row.pressure * value;
      }
      matrix(n + k, n + k) = row.a;
      right(n + k) = -row.c;
    }
    matrix.gauss_jordan();
    matrix.vmult(solution, right);
    du.assign(solution.begin(), solution.begin() + n);
    dp.assign(solution.begin() + n, solution.end());
  }

  /** The share of one rank, in the form that solvers take. */
  class Share : public RowLaws
  {
  public:
    Share(const Problem &problem, const MPI_Comm communicator)
        : first(0), owned(problem.size())
    {
      const unsigned int me =
          dealii::Utilities::MPI::this_mpi_process(communicator);
      for (unsigned int r = 0; r < me; ++r)
        first += problem.n_owned[r];
      n = problem.n_owned[me];
      owned.add_range(first, first + n);
      owned.compress();
      build_matrix(problem, communicator);
      residual.reinit(owned, communicator);
      increment.reinit(owned, communicator);
      for (int i = 0; i < n; ++i)
        la::data(residual)[i] = problem.residual[first + i];
      build_rows(problem, me);
    }

    /** Take the matrix of @p problem, which has entries where that before had
     * some. */
    void set_matrix(const Problem &problem)
    {
      for (int i = first; i < first + n; ++i)
        for (int j = 0; j < problem.size(); ++j)
          if (i == j || problem.stiffness(i, j) != 0.)
            matrix.set(i, j, problem.stiffness(i, j));
      matrix.compress(dealii::VectorOperation::insert);
    }

    /** Take the laws of @p problem, whose rows are the same otherwise. */
    void set_laws(const Problem &problem)
    {
      for (std::size_t i = 0; i < number.size(); ++i)
      {
        const Row &row = problem.rows[number[i]];
        a[i] = row.a;
        b[i] = row.b;
        c[i] = row.c;
        pressure[i] = row.pressure;
        state[i] =
            row.a == 0. || row.b != 0. ? ABUT_STATE_CLOSED : ABUT_STATE_OPEN;
      }
    }

    int first, n = 0;
    dealii::IndexSet owned;
    la::Matrix matrix;
    la::Vector residual, increment;
    std::vector<int> number;    ///< of each row of this rank in the whole
    abut_points_view view = {}; ///< nodes are unknowns
    solve::NodeMap nodes = solve::NodeMap::numbered(0);

  private:
    void build_matrix(const Problem &problem, const MPI_Comm communicator)
    {
      dealii::DynamicSparsityPattern pattern(problem.size(), problem.size(),
                                             owned);
      for (int i = first; i < first + n; ++i)
        for (int j = 0; j < problem.size(); ++j)
          if (i == j || problem.stiffness(i, j) != 0.)
            pattern.add(i, j);
      matrix.reinit(owned, owned, pattern, communicator);
      set_matrix(problem);
    }

    void build_rows(const Problem &problem, const unsigned int me)
    {
      start.push_back(0);
      component.push_back(0);
      for (std::size_t k = 0; k < problem.rows.size(); ++k)
      {
        const Row &row = problem.rows[k];
        if (row.rank != me)
          continue;
        number.push_back(static_cast<int>(k));
        id.push_back(static_cast<std::int64_t>(k));
        weight.push_back(row.weight);
        for (const auto &[j, value] : row.entries)
        {
          node.push_back(j);
          coefficient.push_back(value);
        }
        start.push_back(static_cast<std::int64_t>(node.size()));
        n_secondary.push_back(static_cast<std::int32_t>(row.entries.size()));
        component.push_back(static_cast<std::int32_t>(number.size()));
      }
      const std::size_t m = number.size();
      resize_laws(m);
      gap.assign(m, 0.);
      frame.assign(m, -1.);
      kind.assign(m, ABUT_POINT_CONTACT);
      set_laws(problem);
      view.struct_size = sizeof(view);
      view.dimension = 1;
      view.n_points = view.n_components = static_cast<std::int32_t>(m);
      view.id = view.component_id = id.data();
      view.kind = view.bilateral = kind.data();
      view.weight = view.component_weight = weight.data();
      view.component_start = component.data();
      view.frame = frame.data();
      view.gap = gap.data();
      view.n_secondary = n_secondary.data();
      view.start = start.data();
      view.node = node.data();
      view.coefficient = coefficient.data();
    }

    std::vector<std::int64_t> id, start;
    std::vector<std::int32_t> component, n_secondary, node;
    std::vector<double> weight, frame, coefficient, gap;
    std::vector<std::uint8_t> kind;
  };

  /** The largest differences of a share from the dense solution, relative to
   * the largest value of that. */
  struct Difference
  {
    double du = 0., dp = 0., dg = 0.;
  };

  inline Difference difference(const Problem &problem, const Share &share,
                               const MPI_Comm communicator)
  {
    std::vector<double> du, dp;
    solve_densely(problem, du, dp);
    const auto largest = [](const std::vector<double> &values)
    {
      double result = 1e-300;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    };
    // NaN counts as infinite: std::max would drop it.
    const auto add = [](double &sum, const double value)
    { sum = std::isfinite(value) ? std::max(sum, value) : INFINITY; };
    Difference result;
    for (int i = 0; i < share.n; ++i)
      add(result.du,
          std::abs(la::data(share.increment)[i] - du[share.first + i])
              / largest(du));
    for (std::size_t i = 0; i < share.number.size(); ++i)
    {
      const Row &row = problem.rows[share.number[i]];
      double dg = 0.;
      for (const auto &[j, value] : row.entries)
        dg += value * du[j];
      add(result.dp, std::abs(share.dp[i] - dp[share.number[i]]) / largest(dp));
      add(result.dg, std::abs(share.dg[i] - dg) / largest(du));
    }
    for (double *value : {&result.du, &result.dp, &result.dg})
      *value = dealii::Utilities::MPI::max(*value, communicator);
    return result;
  }

  /** A field on a line, each unknown tied to its neighbours up to 3 away:
   * symmetric and positive definite. */
  inline Problem make_problem(const std::vector<int> &n_owned,
                              const unsigned int seed)
  {
    Problem problem;
    problem.n_owned = n_owned;
    int n = 0;
    for (const int part : n_owned)
      n += part;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.2, 1.);
    problem.stiffness.reinit(n, n);
    for (int i = 0; i < n; ++i)
      problem.stiffness(i, i) = 0.05;
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < std::min(n, i + 4); ++j)
      {
        const double k = uniform(random);
        problem.stiffness(i, i) += k;
        problem.stiffness(j, j) += k;
        problem.stiffness(i, j) -= k;
        problem.stiffness(j, i) -= k;
      }
    for (int i = 0; i < n; ++i)
      problem.residual.push_back(uniform(random) - 0.6);
    return problem;
  }
} // namespace abut::tests

#endif
