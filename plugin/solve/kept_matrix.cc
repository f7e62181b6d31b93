// SPDX-License-Identifier: LGPL-2.1-or-later
#include "kept_matrix.h"

#include <algorithm>
#include <map>

namespace abut::solve
{
  using Index = MatrixLines::Index;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Patterns of sliding bodies grow with each facet that they pass. */
    constexpr unsigned int most_growths = 10;

    /** Call visit(line, first entry, one after the last) with the entries of
     * its row marked in @p place. */
    template <typename Visit>
    void for_each_line(const la::LocalRows &to, const LocalLines &lines,
                       std::vector<int> &place, const Visit &visit)
    {
      int marked = -1;
      const auto mark = [&](const int row, const bool is_on)
      {
        for (int k = row < 0 ? 0 : to.start[row],
                 end = row < 0 ? 0 : to.start[row + 1];
             k < end; ++k)
          place[to.column[k]] = is_on ? k : -1;
      };
      for (int i = 0; i < lines.n_lines; ++i)
      {
        const std::size_t begin =
            lines.start != nullptr ? lines.start[i] : lines.first[i];
        const std::size_t end =
            lines.start != nullptr ? lines.start[i + 1] : lines.first[i + 1];
        const int row = lines.row != nullptr ? lines.row[i] : i;
        if (begin == end)
          continue;
        if (row != marked)
        {
          mark(marked, false);
          mark(row, true);
          marked = row;
        }
        if (!visit(begin, end))
          break;
      }
      mark(marked, false);
    }

    int column_of(const LocalLines &lines, const std::size_t k)
    {
      const int column = lines.column[k];
      return lines.number != nullptr ? lines.number[column] : column;
    }

    /** Lines of this rank's rows, those of @p lines that are of other ranks'
     * rows being sent there. Collective. */
    MatrixLines own_lines(const MatrixLines &lines, const la::Matrix &matrix)
    {
      using Message = std::vector<std::pair<Index, double>>;
      const auto ends = la::row_ends(matrix);
      const auto [first, end] = la::row_range(matrix);
      std::map<unsigned int, Message> send;
      MatrixLines result;
      lines.for_each(
          [&, first = first, end = end](const Index row, const auto &columns,
                                        const auto &values)
          {
            if (row >= first && row < end)
            {
              result.add(row, columns, values);
              return;
            }
            Message &message =
                send[std::upper_bound(ends.begin(), ends.end(), row)
                     - ends.begin()];
            message.emplace_back(row, columns.size());
            for (std::size_t k = 0; k < columns.size(); ++k)
              message.emplace_back(columns[k], values[k]);
          });
      for (const auto &[rank, message] :
           MPI::some_to_some(matrix.get_mpi_communicator(), send))
        for (auto entry = message.begin(); entry != message.end();)
        {
          const Index row = entry->first;
          std::vector<Index> columns;
          std::vector<double> values;
          auto n = static_cast<std::size_t>(entry->second);
          for (++entry; n > 0; --n, ++entry)
          {
            columns.push_back(entry->first);
            values.push_back(entry->second);
          }
          result.add(row, columns, values);
        }
      return result;
    }
  } // namespace

  bool has_places(const la::LocalRows &to, const LocalLines &lines,
                  std::vector<int> &place)
  {
    bool result = true;
    for_each_line(to, lines, place,
                  [&](const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t k = begin; k < end && result; ++k)
                    {
                      const int column = column_of(lines, k);
                      result = column >= 0 && place[column] >= 0;
                    }
                    return result;
                  });
    return result;
  }

  void add_lines(const la::LocalRows &to, const LocalLines &lines,
                 std::vector<int> &place)
  {
    for_each_line(to, lines, place,
                  [&](const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t k = begin; k < end; ++k)
                      to.value[place[column_of(lines, k)]] += lines.value[k];
                    return true;
                  });
  }

  void KeptMatrix::replace(la::Matrix &&matrix)
  {
    matrix_ = std::make_unique<la::Matrix>(std::move(matrix));
    rows_ = la::local_rows(*matrix_);
    first_ = la::row_range(*matrix_).first;
    ghosts_.clear();
    for (int k = rows_.n_rows; k < rows_.n_columns; ++k)
      ghosts_.emplace_back(la::global_column(*matrix_, k), k);
    std::sort(ghosts_.begin(), ghosts_.end());
    place_.assign(rows_.n_columns, -1);
    ++pattern_;
  }

  int KeptMatrix::number(const Index column) const
  {
    if (column >= first_ && column - first_ < static_cast<Index>(rows_.n_rows))
      return static_cast<int>(column - first_);
    const auto at = std::lower_bound(ghosts_.begin(), ghosts_.end(),
                                     std::make_pair(column, 0));
    return at != ghosts_.end() && at->first == column ? at->second : -1;
  }

  void KeptMatrix::set(const la::Matrix &matrix)
  {
    const MPI_Comm communicator = matrix.get_mpi_communicator();
    const la::LocalRows from = la::local_rows(matrix);
    const bool is_other = matrix_ == nullptr || matrix_->m() != matrix.m()
                          || rows_.n_rows != from.n_rows
                          || la::row_range(matrix).first != first_;
    if (n_growths_ >= most_growths || MPI::logical_or(is_other, communicator))
    {
      n_growths_ = 0;
      la::Matrix copied;
      la::copy(matrix, copied);
      replace(std::move(copied));
      return;
    }
    std::vector<int> numbers;
    for (int k = 0; from.n_columns > from.n_rows && k < from.n_columns; ++k)
      numbers.push_back(k < from.n_rows ? k
                                        : number(la::global_column(matrix, k)));
    LocalLines lines;
    lines.n_lines = from.n_rows;
    lines.first = from.start;
    lines.column = from.column;
    lines.number = numbers.empty() ? nullptr : numbers.data();
    lines.value = from.value;
    const bool lacks = !has_places(rows_, lines, place_);
    std::fill_n(rows_.value, rows_.start[rows_.n_rows], 0.);
    if (MPI::logical_or(lacks, communicator))
    {
      ++n_growths_;
      replace(la::sum(matrix, *matrix_));
    }
    else
      add_lines(rows_, lines, place_);
  }

  void KeptMatrix::forget_pattern()
  {
    n_growths_ = most_growths;
  }

  void KeptMatrix::add(const MatrixLines &all)
  {
    const MPI_Comm communicator = matrix_->get_mpi_communicator();
    const bool is_shared = MPI::n_mpi_processes(communicator) > 1;
    const MatrixLines others =
        is_shared ? own_lines(all, *matrix_) : MatrixLines();
    const MatrixLines &own = is_shared ? others : all;
    std::vector<int> row, column;
    for (const Index r : own.row)
      row.push_back(static_cast<int>(r - first_));
    for (const Index c : own.column)
      column.push_back(number(c));
    LocalLines lines;
    lines.n_lines = static_cast<int>(row.size());
    lines.row = row.data();
    lines.start = own.start.data();
    lines.column = column.data();
    lines.value = own.value.data();
    if (!MPI::logical_or(!has_places(rows_, lines, place_), communicator))
    {
      add_lines(rows_, lines, place_);
      return;
    }
    ++n_growths_;
    const dealii::IndexSet owned = la::owned_rows(*matrix_);
    replace(la::sum(
        *matrix_,
        la::assemble(owned, dealii::IndexSet(owned.size()), communicator,
                     [&](const auto &visit) { own.for_each(visit); })));
  }
} // namespace abut::solve
