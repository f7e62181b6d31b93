// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pivots.h"

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <cmath>

namespace abut::solve
{
  namespace
  {
    /** A pivot smaller than this part of a row's largest entry would spoil
     * the condition of the condensed matrix. */
    constexpr double smallest_pivot = 0.05;
  } // namespace

  bool choose_pivots(const PointOperator &rows,
                     const std::vector<std::uint8_t> &wanted,
                     std::vector<std::int64_t> &pivot)
  {
    la::Vector count(rows.owned(), rows.communicator());
    rows.add_counts(wanted.data(), count);
    const double *const n_rows = la::data(count);

    pivot.assign(rows.n_rows(), Condensate::none);
    bool complete = true;
    for (int i = 0; i < rows.n_rows(); ++i)
    {
      if (!wanted[i])
        continue;
      double largest = 0., chosen = 0.;
      for (std::int64_t e = rows.begin(i); e < rows.end(i); ++e)
      {
        const double size = std::abs(rows.coefficient(e));
        largest = std::max(largest, size);
        const int j = rows.column(e);
        if (j < rows.n_owned() && n_rows[j] == 1. && size > chosen)
        {
          chosen = size;
          pivot[i] = e;
        }
      }
      complete = complete && chosen > smallest_pivot * largest;
    }
    return dealii::Utilities::MPI::min(complete ? 1 : 0, rows.communicator())
           == 1;
  }

  namespace
  {
    /** A column that may be a pivot, with what the constraints of the point
     * have there. */
    struct Candidate
    {
      std::int64_t entry;
      std::array<double, 3> trial, test;
    };

    /** The constraints of one point. */
    struct Held
    {
      int first = 0, k = 0; ///< rows of the point
      std::int64_t at = 0;
      std::vector<int> row; ///< of these, those held; at most 3
    };

    Held held_rows(const LocalElimination &local, const int block)
    {
      const RowBlocks &blocks = local.blocks();
      Held result;
      result.first = blocks.first[block];
      result.k = blocks.size(block);
      result.at = blocks.at[block];
      for (int r = 0; r < result.k; ++r)
        if (local.is_held(result.first + r))
          result.row.push_back(r);
      return result;
    }

    std::vector<Candidate> candidates(const PointOperator &rows,
                                      const LocalElimination &local,
                                      const Held &held,
                                      const double *const n_points)
    {
      std::vector<Candidate> result;
      for (int c = 0; c < held.k; ++c)
        for (auto e = rows.begin(held.first + c); e < rows.end(held.first + c);
             ++e)
        {
          const int j = rows.column(e);
          if (j >= rows.n_owned() || n_points[j] != 1.)
            continue;
          auto found = std::find_if(result.begin(), result.end(),
                                    [&](const Candidate &other)
                                    { return rows.column(other.entry) == j; });
          if (found == result.end())
            found = result.insert(result.end(), Candidate{e, {}, {}});
          for (std::size_t h = 0; h < held.row.size(); ++h)
          {
            const auto number = held.at + held.row[h] * held.k + c;
            found->trial[h] += local.trial()[number] * rows.coefficient(e);
            found->test[h] += local.test()[number] * rows.coefficient(e);
          }
        }
      return result;
    }

    /** Gauss's elimination of all constraints at once, with the largest pivot
     * each: the rest of a candidate must not be small compared with its first
     * value. */
    bool pick(std::vector<Candidate> all, const int n,
              std::vector<std::int64_t> &entry)
    {
      entry.assign(n, Condensate::none);
      double largest = 0.;
      for (const Candidate &c : all)
        for (int h = 0; h < n; ++h)
          largest = std::max(largest, std::abs(c.trial[h] * c.test[h]));
      for (int step = 0; step < n; ++step)
      {
        const Candidate *best = nullptr;
        int best_row = 0;
        double size = smallest_pivot * smallest_pivot * largest;
        for (const Candidate &c : all)
          for (int h = 0; h < n; ++h)
            if (entry[h] == Condensate::none
                && std::abs(c.trial[h] * c.test[h]) > size)
            {
              size = std::abs(c.trial[h] * c.test[h]);
              best = &c;
              best_row = h;
            }
        if (best == nullptr)
          return false;
        entry[best_row] = best->entry;
        const Candidate pivot = *best;
        for (Candidate &c : all)
        {
          const double trial = c.trial[best_row] / pivot.trial[best_row],
                       test = c.test[best_row] / pivot.test[best_row];
          for (int h = 0; h < n; ++h)
            if (h != best_row)
            {
              c.trial[h] -= trial * pivot.trial[h];
              c.test[h] -= test * pivot.test[h];
            }
        }
      }
      return true;
    }

    /** map = P^-1 rows for the n constraints, P what they have at the pivots.
     */
    void make_map(const PointOperator &rows, const Held &held,
                  const std::vector<std::int64_t> &entry,
                  const std::vector<double> &direction,
                  std::vector<double> &map)
    {
      const int n = static_cast<int>(held.row.size());
      dealii::FullMatrix<double> at_pivots(n, n);
      for (int h = 0; h < n; ++h)
        for (int c = 0; c < held.k; ++c)
          for (auto e = rows.begin(held.first + c);
               e < rows.end(held.first + c); ++e)
            for (int q = 0; q < n; ++q)
              if (rows.column(e) == rows.column(entry[q]))
                at_pivots(h, q) += direction[held.at + held.row[h] * held.k + c]
                                   * rows.coefficient(e);
      at_pivots.gauss_jordan();
      for (int q = 0; q < n; ++q)
        for (int c = 0; c < held.k; ++c)
        {
          double sum = 0.;
          for (int h = 0; h < n; ++h)
            sum +=
                at_pivots(q, h) * direction[held.at + held.row[h] * held.k + c];
          map[held.at + held.row[q] * held.k + c] = sum;
        }
    }
  } // namespace

  namespace
  {
    /** Rows that constraints of their point have a part of, or that forces of
     * constraints act on. */
    std::vector<std::uint8_t> rows_of_constraints(const LocalElimination &local)
    {
      const RowBlocks &blocks = local.blocks();
      std::vector<std::uint8_t> result(local.held());
      for (int block = 0; block < blocks.n_blocks(); ++block)
        for (int h = 0, k = blocks.size(block); h < k; ++h)
          for (int c = 0; c < k && local.is_held(blocks.first[block] + h); ++c)
          {
            const auto number = blocks.at[block] + h * k + c;
            if (local.trial()[number] != 0. || local.test()[number] != 0.)
              result[blocks.first[block] + c] = 1;
          }
      return result;
    }
  } // namespace

  bool choose_pivots(const PointOperator &rows, const LocalElimination &local,
                     Condensate &condensate)
  {
    const RowBlocks &blocks = local.blocks();
    la::Vector count(rows.owned(), rows.communicator());
    rows.add_group_counts(rows_of_constraints(local).data(), blocks.first,
                          count);
    condensate.blocks = blocks;
    condensate.stiffness = local.spring();
    condensate.spring = local.spring_blocks();
    condensate.pivot.assign(rows.n_rows(), Condensate::none);
    condensate.trial.assign(blocks.n_numbers(), 0.);
    condensate.test.assign(blocks.n_numbers(), 0.);
    bool complete = true;
    std::vector<std::int64_t> entry;
    for (int block = 0; block < blocks.n_blocks(); ++block)
    {
      const Held held = held_rows(local, block);
      if (held.row.empty())
        continue;
      if (!pick(candidates(rows, local, held, la::data(count)),
                static_cast<int>(held.row.size()), entry))
      {
        complete = false;
        continue;
      }
      for (std::size_t h = 0; h < held.row.size(); ++h)
        condensate.pivot[held.first + held.row[h]] = entry[h];
      make_map(rows, held, entry, local.trial(), condensate.trial);
      make_map(rows, held, entry, local.test(), condensate.test);
    }
    return dealii::Utilities::MPI::min(complete ? 1 : 0, rows.communicator())
           == 1;
  }
} // namespace abut::solve
