// SPDX-License-Identifier: LGPL-2.1-or-later
#include "gap_substitution.h"

#include "ask_ranks.h"

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    using Index = dealii::types::global_dof_index;
    using LineByMotion = std::map<Index, double>;

    /** A row of R and of C = B + R, with its motion, a column of E. */
    struct Row
    {
      LineByMotion rest, whole;
      std::vector<std::pair<Index, double>> motion;
    };

    /** The motion is along the row, and its product with B is 1. */
    Row make_row(const PointOperator &rows, const GapLine &line)
    {
      Row result;
      for (std::size_t k = 0; k < line.column.size(); ++k)
        result.rest[line.column[k]] += line.value[k];
      result.whole = result.rest;
      double squares = 0.;
      for (auto e = rows.begin(line.row); e < rows.end(line.row); ++e)
      {
        const Index column = rows.global_column(rows.column(e));
        const double b = rows.coefficient(e);
        result.whole[column] += b;
        if (rows.column(e) < rows.n_owned()
            && std::count(line.own.begin(), line.own.end(), column) > 0)
        {
          result.motion.emplace_back(column, b);
          squares += b * b;
        }
      }
      for (auto &entry : result.motion)
        entry.second /= squares;
      return result;
    }

    /** A matrix of lines, by unknowns of this rank. Collective. */
    template <typename Lines>
    la::Matrix assemble(const dealii::IndexSet &owned,
                        const MPI_Comm communicator, const Lines &lines)
    {
      return la::assemble(owned, dealii::IndexSet(owned.size()), communicator,
                          [&](const auto &visit)
                          {
                            std::vector<Index> columns;
                            std::vector<double> values;
                            for (const auto &[row, line] : lines)
                            {
                              columns.clear();
                              values.clear();
                              for (const auto &[column, value] : line)
                              {
                                columns.push_back(column);
                                values.push_back(value);
                              }
                              visit(row, columns, values);
                            }
                          });
    }

    /** The entries of a line above round-off of the next linearisation. */
    std::vector<std::pair<Index, double>>
    without_negligible(const LineByMotion &line)
    {
      constexpr double negligible = 1e-4;
      double largest = 0.;
      for (const auto &entry : line)
        largest = std::max(largest, std::abs(entry.second));
      std::vector<std::pair<Index, double>> result;
      for (const auto &entry : line)
        if (std::abs(entry.second) > negligible * largest)
          result.push_back(entry);
      return result;
    }

    /** Adds up entries by small numbers. */
    class SparseSum
    {
    public:
      explicit SparseSum(const std::size_t n) : place_(n, nowhere)
      {
      }

      void add(const std::size_t number, const double value)
      {
        if (place_[number] == nowhere)
        {
          place_[number] = entries_.size();
          entries_.emplace_back(number, 0.);
        }
        entries_[place_[number]].second += value;
      }

      /** The sum, which is empty afterwards. */
      std::vector<std::pair<std::size_t, double>> release()
      {
        for (const auto &entry : entries_)
          place_[entry.first] = nowhere;
        return std::exchange(entries_, {});
      }

    private:
      static constexpr std::size_t nowhere = -1;
      std::vector<std::size_t> place_;
      std::vector<std::pair<std::size_t, double>> entries_;
    };

    double by_motion(const LineByMotion &line, const Row &of)
    {
      double sum = 0.;
      for (const auto &[column, motion] : of.motion)
        if (const auto at = line.find(column); at != line.end())
          sum += at->second * motion;
      return sum;
    }

    /** The matrix C E of this rank's rows. */
    class Couplings
    {
    public:
      explicit Couplings(const std::vector<Row> &rows) : line_(rows.size())
      {
        std::unordered_map<Index, std::size_t> moved_by;
        for (std::size_t i = 0; i < rows.size(); ++i)
          for (const auto &entry : rows[i].motion)
            moved_by[entry.first] = i;
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
          for (const auto &entry : rows[i].whole)
            if (const auto at = moved_by.find(entry.first);
                at != moved_by.end())
              line_[i][at->second] = by_motion(rows[i].whole, rows[at->second]);
          const double own = line_[i][i];
          for (auto at = line_[i].begin(); at != line_[i].end();)
            at = at->first != i && std::abs(at->second) < negligible * own
                     ? line_[i].erase(at)
                     : std::next(at);
        }
      }

      /** Row @p i of the inverse, of the block of it and its neighbours. */
      std::vector<std::pair<std::size_t, double>>
      inverse(const std::size_t i) const
      {
        std::vector<std::pair<std::size_t, double>> result;
        for (const auto &entry : line_[i])
          result.emplace_back(entry.first, 0.);
        const auto n = static_cast<unsigned int>(result.size());
        dealii::FullMatrix<double> block(n, n);
        unsigned int own = 0;
        for (unsigned int r = 0; r < n; ++r)
        {
          own = result[r].first == i ? r : own;
          for (unsigned int c = 0; c < n; ++c)
            if (const auto at = line_[result[r].first].find(result[c].first);
                at != line_[result[r].first].end())
              block(r, c) = at->second;
        }
        block.gauss_jordan();
        for (unsigned int c = 0; c < n; ++c)
          result[c].second = block(own, c);
        return result;
      }

    private:
      static constexpr double negligible = 1e-3;
      std::vector<std::map<std::size_t, double>> line_;
    };
  } // namespace

  GapSubstitution::GapSubstitution(const PointOperator &rows,
                                   const std::vector<GapLine> &lines)
      : communicator_(rows.communicator())
  {
    std::vector<Row> all;
    for (const GapLine &line : lines)
    {
      constexpr double least = 0.3;
      Row row = make_row(rows, line);
      // A row whose own lever nearly cancels the change would move too far.
      if (!row.motion.empty() && by_motion(row.whole, row) > least)
        all.push_back(std::move(row));
    }
    const Couplings couplings(all);
    std::map<Index, Line> whole;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      LineByMotion sum;
      for (const auto &[k, factor] : couplings.inverse(i))
        for (const auto &[column, value] : all[k].rest)
          sum[column] -= factor * value;
      Line line = without_negligible(sum);
      for (const auto &[unknown, motion] : all[i].motion)
      {
        lines_.of[unknown] = {lines_.line.size(), motion};
        for (const auto &[column, value] : line)
          whole[unknown].emplace_back(column, motion * value);
      }
      lines_.line.push_back(std::move(line));
    }
    z_ = std::make_unique<la::Matrix>(
        assemble(rows.owned(), communicator_, whole));
  }

  GapSubstitution::Lines
  GapSubstitution::lines_of(const la::Matrix &matrix) const
  {
    Lines result(lines_);
    if (MPI::n_mpi_processes(communicator_) == 1)
      return result;
    const auto ends = la::row_ends(matrix);
    const la::LocalRows rows = la::local_rows(matrix);
    WordMail questions;
    for (int k = rows.n_rows; k < rows.n_columns; ++k)
    {
      const Index column = la::global_column(matrix, k);
      questions[std::upper_bound(ends.begin(), ends.end(), column)
                - ends.begin()]
          .push_back(column);
    }
    const auto answer = [&](const Words &question)
    {
      Words words;
      for (const Index unknown : question)
      {
        const auto at = lines_.of.find(unknown);
        if (at == lines_.of.end())
          continue;
        const auto &[number, motion] = at->second;
        const Line &line = lines_.line[number];
        words.insert(words.end(), {unknown, to_word(motion), line.size()});
        for (const auto &[column, value] : line)
          words.insert(words.end(), {column, to_word(value)});
      }
      return words;
    };
    for (const auto &[rank, words] :
         ask_ranks(communicator_, questions, answer))
      for (auto word = words.begin(); word != words.end();)
      {
        result.of[word[0]] = {result.line.size(), to_value(word[1])};
        Line &line = result.line.emplace_back();
        auto n = word[2];
        for (word += 3; n > 0; --n, word += 2)
          line.emplace_back(word[0], to_value(word[1]));
      }
    return result;
  }

  MatrixLines GapSubstitution::product(const la::Matrix &matrix) const
  {
    const Lines lines = lines_of(matrix);
    const la::LocalRows rows = la::local_rows(matrix);
    std::vector<const std::pair<std::size_t, double> *> of(rows.n_columns);
    for (int k = 0; k < rows.n_columns; ++k)
      if (const auto at = lines.of.find(la::global_column(matrix, k));
          at != lines.of.end())
        of[k] = &at->second;
    // Columns of the lines by numbers of their own.
    std::map<Index, std::size_t> number;
    for (const Line &line : lines.line)
      for (const auto &entry : line)
        number.try_emplace(entry.first, number.size());
    std::vector<std::vector<std::size_t>> place(lines.line.size());
    for (std::size_t l = 0; l < place.size(); ++l)
      for (const auto &entry : lines.line[l])
        place[l].push_back(number[entry.first]);
    std::vector<Index> column(number.size());
    for (const auto &[index, k] : number)
      column[k] = index;

    SparseSum factor(place.size()), sum(number.size());
    MatrixLines result;
    std::vector<Index> columns;
    std::vector<double> values;
    for (int i = 0; i < rows.n_rows; ++i)
    {
      for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
        if (const auto *const line = of[rows.column[k]];
            line != nullptr && rows.value[k] != 0.)
          factor.add(line->first, rows.value[k] * line->second);
      for (const auto &[l, each] : factor.release())
        for (std::size_t k = 0; k < place[l].size(); ++k)
          sum.add(place[l][k], each * lines.line[l][k].second);
      columns.clear();
      values.clear();
      for (const auto &[k, value] : sum.release())
      {
        columns.push_back(column[k]);
        values.push_back(value);
      }
      if (!columns.empty())
        result.add(la::global_column(matrix, i), columns, values);
    }
    return result;
  }

  void GapSubstitution::apply(la::Vector &v) const
  {
    const la::Vector from(v);
    z_->vmult_add(v, from);
  }
} // namespace abut::solve
