// SPDX-License-Identifier: LGPL-2.1-or-later
//
// With H = T + T Z, rank by rank:
//   1  lines of Z for the pivots of other ranks that this rank's rows of T
//      have entries for are fetched from their owners;
//   2  lines of T Z for all rows of T on this rank, and of H for its pivots;
//   3  lines of Z^T H for all unknowns that its rows tie pivots to, which may
//      belong to other ranks and are sent there at the end.
// Each line is added up in a dense array over the columns that occur here.
#include "elimination.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace abut::solve
{
  using dealii::types::global_dof_index;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Line over a rank's own numbering of columns. */
    struct SparseLine
    {
      std::vector<int> column;
      std::vector<double> value;

      bool empty() const
      {
        return column.empty();
      }
    };

    /** Numbers for the columns that occur on this rank: those of the matrix,
     * then others as they come. */
    class Columns
    {
    public:
      explicit Columns(const la::Matrix &matrix)
          : first_(la::row_range(matrix).first),
            n_owned_(la::local_rows(matrix).n_rows)
      {
        const int n = la::local_rows(matrix).n_columns;
        for (int k = n_owned_; k < n; ++k)
          add(la::global_column(matrix, k));
      }

      int add(const global_dof_index global)
      {
        if (global >= first_ && global - first_ < n_owned_)
          return static_cast<int>(global - first_);
        const auto inserted = number_.try_emplace(global, size());
        if (inserted.second)
          others_.push_back(global);
        return inserted.first->second;
      }

      int size() const
      {
        return static_cast<int>(n_owned_ + others_.size());
      }

      global_dof_index global(const int column) const
      {
        return static_cast<global_dof_index>(column) < n_owned_
                   ? first_ + column
                   : others_[column - n_owned_];
      }

    private:
      const global_dof_index first_, n_owned_;
      std::vector<global_dof_index> others_;
      std::unordered_map<global_dof_index, int> number_;
    };

    /** Adds up one line. */
    class LineSum
    {
    public:
      explicit LineSum(const int n_columns) : place_(n_columns, -1)
      {
      }

      void add(const int column, const double value)
      {
        int &place = place_[column];
        if (place < 0)
        {
          place = static_cast<int>(line_.column.size());
          line_.column.push_back(column);
          line_.value.push_back(0.);
        }
        line_.value[place] += value;
      }

      void add(const SparseLine &line, const double factor)
      {
        for (std::size_t k = 0; k < line.column.size(); ++k)
          add(line.column[k], factor * line.value[k]);
      }

      /** The sum, which is empty afterwards. */
      SparseLine release()
      {
        for (const int column : line_.column)
          place_[column] = -1;
        return std::exchange(line_, SparseLine());
      }

    private:
      std::vector<int> place_;
      SparseLine line_;
    };

    /** Lines of Z of this rank's pivots, by local unknown. */
    std::vector<SparseLine> own_lines(const PointOperator &rows,
                                      const std::vector<std::int64_t> &pivot,
                                      Columns &columns)
    {
      std::vector<SparseLine> lines(columns.size());
      for (int i = 0; i < rows.n_rows(); ++i)
      {
        if (pivot[i] == Condensate::none)
          continue;
        SparseLine &line = lines[rows.column(pivot[i])];
        for (auto e = rows.begin(i); e < rows.end(i); ++e)
        {
          line.column.push_back(
              columns.add(rows.global_column(rows.column(e))));
          line.value.push_back(e == pivot[i]
                                   ? -1.
                                   : -rows.coefficient(e)
                                         / rows.coefficient(pivot[i]));
        }
      }
      return lines;
    }

    /** The same for points with friction, by the map @p map of the
     * condensate. */
    std::vector<SparseLine> mapped_lines(const PointOperator &rows,
                                         const Condensate &condensate,
                                         const std::vector<double> &map,
                                         Columns &columns)
    {
      std::vector<SparseLine> lines(columns.size());
      const RowBlocks &blocks = condensate.blocks;
      for (int block = 0; block < blocks.n_blocks(); ++block)
      {
        const int first = blocks.first[block], k = blocks.size(block);
        std::vector<int> pivots;
        for (int r = 0; r < k; ++r)
          if (condensate.pivot[first + r] != Condensate::none)
            pivots.push_back(rows.column(condensate.pivot[first + r]));
        for (int r = 0; r < k; ++r)
        {
          if (condensate.pivot[first + r] == Condensate::none)
            continue;
          std::map<int, double> sum;
          for (int c = 0; c < k; ++c)
            for (auto e = rows.begin(first + c); e < rows.end(first + c); ++e)
              sum[rows.column(e)] -=
                  map[blocks.at[block] + r * k + c] * rows.coefficient(e);
          const int own = rows.column(condensate.pivot[first + r]);
          for (const int q : pivots)
            sum.erase(q);
          sum[own] = -1.;
          SparseLine line;
          for (const auto &[column, value] : sum)
          {
            line.column.push_back(columns.add(rows.global_column(column)));
            line.value.push_back(value);
          }
          lines[own] = std::move(line);
        }
      }
      return lines;
    }

    using PackedLines = std::vector<std::pair<global_dof_index, double>>;

    /** Each rank's pivots go to the ranks whose rows have entries for them:
     * with a symmetric pattern, the owners of the pivots' neighbours. A line is
     * sent as its pivot with its length, then its entries. */
    void import_lines(const la::Matrix &matrix, Columns &columns,
                      std::vector<SparseLine> &lines)
    {
      const MPI_Comm communicator = matrix.get_mpi_communicator();
      if (MPI::n_mpi_processes(communicator) == 1)
        return;
      const auto ends = la::row_ends(matrix);
      const la::LocalRows rows = la::local_rows(matrix);
      std::map<unsigned int, PackedLines> send;
      for (int i = 0; i < rows.n_rows; ++i)
      {
        if (lines[i].empty())
          continue;
        std::vector<unsigned int> ranks;
        for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
          if (rows.column[k] >= rows.n_rows)
            ranks.push_back(std::upper_bound(ends.begin(), ends.end(),
                                             columns.global(rows.column[k]))
                            - ends.begin());
        std::sort(ranks.begin(), ranks.end());
        ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
        for (const unsigned int rank : ranks)
        {
          PackedLines &message = send[rank];
          message.emplace_back(columns.global(i), lines[i].column.size());
          for (std::size_t k = 0; k < lines[i].column.size(); ++k)
            message.emplace_back(columns.global(lines[i].column[k]),
                                 lines[i].value[k]);
        }
      }
      for (const auto &[rank, message] : MPI::some_to_some(communicator, send))
        for (auto entry = message.begin(); entry != message.end();)
        {
          const int pivot = columns.add(entry->first);
          const auto end = entry + 1 + static_cast<long>(entry->second);
          lines.resize(std::max<std::size_t>(lines.size(), columns.size()));
          for (++entry; entry != end; ++entry)
          {
            lines[pivot].column.push_back(columns.add(entry->first));
            lines[pivot].value.push_back(entry->second);
          }
        }
    }

    /** Which entry of which pivot's line touches an unknown, by unknowns that
     * are touched. */
    std::map<int, std::vector<std::pair<int, double>>>
    users_of(const std::vector<SparseLine> &lines, const int n_owned)
    {
      std::map<int, std::vector<std::pair<int, double>>> result;
      for (int q = 0; q < n_owned; ++q)
        for (std::size_t k = 0; k < lines[q].column.size(); ++k)
          result[lines[q].column[k]].emplace_back(q, lines[q].value[k]);
      return result;
    }

    /** Rows with entries for pivots, whose lines are @p z. The pattern need not
     * be symmetric: what partners of moving points add to a tangent is not. */
    std::vector<int> rows_of_pivots(const la::LocalRows &t,
                                    const std::vector<SparseLine> &z)
    {
      std::vector<std::uint8_t> is_pivot(t.n_columns, 0);
      for (int c = 0; c < t.n_columns; ++c)
        is_pivot[c] = !z[c].empty();
      std::vector<int> result;
      for (int i = 0; i < t.n_rows; ++i)
      {
        int k = t.start[i];
        while (k < t.start[i + 1]
               && (is_pivot[t.column[k]] == 0 || t.value[k] == 0.))
          ++k;
        if (k < t.start[i + 1])
          result.push_back(i);
      }
      return result;
    }
  } // namespace

  void for_each_elimination_term(const la::Matrix &matrix,
                                 const PointOperator &rows,
                                 const Condensate &condensate,
                                 const VisitLine &visit)
  {
    Columns columns(matrix);
    const bool has_blocks = !condensate.blocks.empty();
    std::vector<SparseLine> z =
        has_blocks ? mapped_lines(rows, condensate, condensate.trial, columns)
                   : own_lines(rows, condensate.pivot, columns);
    std::vector<SparseLine> y;
    if (has_blocks)
      y = mapped_lines(rows, condensate, condensate.test, columns);
    import_lines(matrix, columns, z);
    z.resize(columns.size());

    const la::LocalRows t = la::local_rows(matrix);
    LineSum sum(columns.size());
    std::vector<global_dof_index> places;
    const auto pass_on = [&](const int row, const SparseLine &line)
    {
      places.clear();
      for (const int column : line.column)
        places.push_back(columns.global(column));
      if (!line.empty())
        visit(columns.global(row), places, line.value);
    };
    std::map<int, SparseLine> h;
    for (const int i : rows_of_pivots(t, z))
    {
      for (int k = t.start[i]; k < t.start[i + 1]; ++k)
        if (t.value[k] != 0.)
          sum.add(z[t.column[k]], t.value[k]);
      const SparseLine line = sum.release();
      if (!z[i].empty())
      {
        sum.add(line, 1.);
        for (int k = t.start[i]; k < t.start[i + 1]; ++k)
          if (t.value[k] != 0.)
            sum.add(t.column[k], t.value[k]);
        h[i] = sum.release();
      }
      pass_on(i, line);
    }
    for (const auto &[j, entries] : users_of(has_blocks ? y : z, t.n_rows))
    {
      for (const auto &[q, value] : entries)
        if (const auto line = h.find(q); line != h.end())
          sum.add(line->second, value);
      pass_on(j, sum.release());
    }
  }
} // namespace abut::solve
