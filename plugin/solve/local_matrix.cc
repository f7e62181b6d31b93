// SPDX-License-Identifier: LGPL-2.1-or-later
#include "local_matrix.h"

#include <algorithm>

namespace abut::solve
{
  void LocalMatrix::add(const Index row, const std::vector<Index> &columns,
                        const std::vector<double> &values)
  {
    for (std::size_t k = 0; k < columns.size(); ++k)
      entries_.push_back({row, columns[k], values[k]});
  }

  std::vector<LocalMatrix::Index> LocalMatrix::unknowns() const
  {
    std::vector<Index> result;
    for (const Entry &entry : entries_)
    {
      if (result.empty() || result.back() != entry.row)
        result.push_back(entry.row);
      result.push_back(entry.column);
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  void LocalMatrix::sum_up(const int n_rows)
  {
    start.assign(n_rows + std::size_t(1), 0);
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry &a, const Entry &b) {
                       return a.row != b.row ? a.row < b.row
                                             : a.column < b.column;
                     });
    int last = -1;
    for (const Entry &entry : entries_)
    {
      const int row = static_cast<int>(entry.row);
      if (row == last && static_cast<int>(entry.column) == column.back())
      {
        value.back() += entry.value;
        continue;
      }
      last = row;
      column.push_back(static_cast<int>(entry.column));
      value.push_back(entry.value);
      ++start[row + 1];
    }
    for (std::size_t i = 1; i < start.size(); ++i)
      start[i] += start[i - 1];
    entries_ = {};
  }
} // namespace abut::solve
